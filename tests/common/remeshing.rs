//! Checks that every remeshed surface must pass.
#![allow(dead_code, reason = "every test binary uses another part")]

use conemap::mesh::SurfaceMesh;
use conemap::mesh::surface_index::SurfaceIndex;
use conemap::monitor::Silent;
use conemap::remesh::{Options, Remeshed, remesh};

/// Remeshes a surface and checks the properties that every result must have.
pub fn remeshed(name: &str, surface: &SurfaceMesh, options: &Options) -> Remeshed {
    let result = remesh(surface, options, &mut Silent).unwrap_or_else(|e| panic!("{name}: {e}"));
    let Remeshed { mesh, report } = &result;
    let positions = mesh.positions().iter().copied().collect();
    SurfaceMesh::from_triangles(positions, mesh.triangles().iter().copied().collect())
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(mesh.euler_characteristic(), surface.euler_characteristic(), "{name}");
    let (faces, wanted) = (mesh.face_count() as f64, options.faces as f64);
    assert!((faces - wanted).abs() <= 1.0_f64.max(0.05 * wanted), "{name}: {faces} of {wanted}");
    assert_eq!(report.faces, mesh.face_count());
    let index = SurfaceIndex::new(surface);
    let farthest = mesh.positions().iter().map(|p| index.nearest(*p).distance).fold(0.0, f64::max);
    assert!(farthest < 1e-9 * report.edge_length.mean, "{name}: a vertex is {farthest} off the surface");
    assert!(report.distance.to_original >= farthest, "{name}");
    result
}
