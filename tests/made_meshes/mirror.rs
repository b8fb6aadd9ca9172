//! Mirror planes of bodies that are symmetric by construction, in other triangles and with noise.

use crate::remeshing::remeshed;
use conemap::demo;
use conemap::landmark_suggestion::best_mirror;
use conemap::monitor::Silent;
use conemap::remesh::{Noise, Options, perturbed};
use glam::DVec3;

#[test]
fn other_triangles_and_noise_leave_the_plane_where_it_is() {
    let horse = demo::build("horse-cat").unwrap().source;
    let even = remeshed("horse", &horse, &Options::to_faces(4000)).mesh;
    let rough = perturbed(&even, Noise { tangential: 0.2, normal: 0.1, seed: 5 });
    for (mesh, limit) in [(&even, 0.002), (&rough, 0.004)] {
        let found = best_mirror(mesh, &mut Silent).unwrap().unwrap();
        assert!(found.fits() && found.misfit < 2.0 * limit, "{found:?}");
        assert!(found.plane.normal().cross(DVec3::Z).length() < limit, "{found:?}");
        assert!(found.plane.height(DVec3::ZERO).abs() < limit * mesh.area().sqrt(), "{found:?}");
    }
}
