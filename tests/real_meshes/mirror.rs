//! Tests of the mirror planes of real animals: the known partners among their landmarks lie across from each other.

use crate::common;
use crate::shrec07;
use conemap::landmark_suggestion::{Mirror, Partner, best_mirror, partner};
use conemap::mesh::surface_index::SurfaceIndex;
use conemap::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use conemap::monitor::Silent;
use std::path::Path;

tests![known_partners_lie_across_from_each_other, poses_bent_to_one_side_have_no_plane];

/// The landmarks of the SHREC07 animals on the midline.
const MIDDLE: [usize; 5] = [0, 1, 12, 13, 14];

/// The largest distance of a landmark that was placed by hand from the mirror image of its partner, in units of the root of the area; some
/// of the animals walk.
const BY_HAND: f64 = 0.06;

fn best(mesh: &SurfaceMesh) -> Mirror {
    best_mirror(mesh, &mut Silent).unwrap().unwrap()
}

/// The distance of a point's partner across the plane from another point, in units of the root of the area; 0 for a point on the midline
/// and itself.
fn off(index: &SurfaceIndex<'_>, mirror: &Mirror, [from, to]: [VertexId; 2]) -> f64 {
    let mesh = index.mesh();
    let nearest = |place, normal| Some(index.nearest_facing(place, normal, FaceId(0)).point);
    let point = SurfacePoint::at_vertex(mesh, from);
    match partner(mesh, mirror.plane, point, nearest).unwrap() {
        Partner::Itself => mesh.positions()[from].distance(mesh.positions()[to]) / mesh.area().sqrt(),
        Partner::Across { point, .. } => {
            point.position(mesh).distance(mesh.positions()[to]) / mesh.area().sqrt()
        }
    }
}

fn known_partners_lie_across_from_each_other(data: &Path) {
    for name in ["381-383", "383-381", "385-381", "392-381", "397-400", "400-397"] {
        let [mesh, other] = [&name[..3], &name[4..]];
        let is_first = mesh < other;
        let pair = common::read_pair(data, &format!("shrec07-{}-{}", mesh.min(other), mesh.max(other)));
        let landmarks = common::landmarks(&pair);
        let (mesh, points) = if is_first {
            (&pair.source, &landmarks.source.raw)
        } else {
            (&pair.target, &landmarks.target.raw)
        };
        let mirror = best(mesh);
        assert!(mirror.fits() && mirror.misfit < 0.004, "{name}: {mirror:?}");
        let index = SurfaceIndex::new(mesh);
        for [left, right] in shrec07::PARTNERS.into_iter().chain(MIDDLE.map(|k| [k, k])) {
            for [from, to] in [[left, right], [right, left]] {
                let distance = off(&index, &mirror, [points[from], points[to]]);
                assert!(distance < BY_HAND, "{name}: {from} to {to} is {distance} off");
            }
        }
    }
}

fn poses_bent_to_one_side_have_no_plane(data: &Path) {
    for name in
        ["sumner/horse-pose01.off", "sumner/horse-pose05.off", "single/horse97k.off", "shrec07/394.off"]
    {
        let found = best(&common::read_mesh(&data.join(name)));
        assert!(!found.fits(), "{name}: {found:?}");
    }
    for name in ["sumner/horse.off", "sumner/cat.off", "tosca/cat0.off", "single/homer.off"] {
        let found = best(&common::read_mesh(&data.join(name)));
        assert!(found.fits() && found.plane.normal().x.abs() > 0.999, "{name}: {found:?}");
    }
}
