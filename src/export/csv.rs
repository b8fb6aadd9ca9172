//! Distortion as comma-separated values.

use crate::mesh::FaceId;
use crate::mesh::cap_faces::CapFaces;
use crate::pipeline::TriangleDistortion;
use std::fmt::Write;

/// One line per triangle of the overlay, numbered as in the textured GLB: `triangle,source_face,target_face,density,angle,
/// area`, and `on_skin` where a mesh has caps: 1 where the triangle lies on skin on both. `faces` gives a face of the mapped
/// meshes its number in the source's or the target's file.
pub fn distortion(
    triangles: &[TriangleDistortion],
    faces: [&dyn Fn(FaceId) -> FaceId; 2],
    caps: CapFaces<'_>,
) -> Vec<u8> {
    let has_caps = caps.any();
    let mut text = String::from("triangle,source_face,target_face,density,angle,area");
    text.push_str(if has_caps { ",on_skin\n" } else { "\n" });
    for (k, TriangleDistortion { source_face, target_face, local }) in triangles.iter().enumerate() {
        let (s, t) = (faces[0](*source_face).0, faces[1](*target_face).0);
        // Writing to a string does not fail.
        let mark = match caps.are_skin([*source_face, *target_face]) {
            _ if !has_caps => "",
            [true, true] => ",1",
            _ => ",0",
        };
        let _ = writeln!(text, "{k},{s},{t},{},{},{}{mark}", local.density, local.angle, local.area);
    }
    text.into_bytes()
}

/// One line per vertex of the source's file: `source_vertex,density`, the mean around it; empty where no face uses it.
pub fn vertex_distortion(densities: &[Option<f64>]) -> Vec<u8> {
    let mut text = String::from("source_vertex,density\n");
    for (v, density) in densities.iter().enumerate() {
        let _ = match density {
            Some(density) => writeln!(text, "{v},{density}"),
            None => writeln!(text, "{v},"),
        };
    }
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface_map::measures::distortion::LocalDistortion;
    use typed_index_collections::TiVec;

    #[test]
    fn distortions_name_the_files_faces() {
        let local = LocalDistortion { density: 1.25, angle: 1.5, area: 0.5 };
        let triangle = TriangleDistortion { source_face: FaceId(3), target_face: FaceId(4), local };
        let faces: [&dyn Fn(FaceId) -> FaceId; 2] = [&|f| f, &|f| FaceId(10 * f.0)];
        let text = distortion(&[triangle], faces, CapFaces::default());
        let text = String::from_utf8(text).unwrap();
        assert_eq!(text, "triangle,source_face,target_face,density,angle,area\n0,3,40,1.25,1.5,0.5\n");
        let target: TiVec<FaceId, bool> = (0..5).map(|f| f == 4).collect();
        let text = distortion(&[triangle], faces, CapFaces { source: None, target: Some(&target) });
        let text = String::from_utf8(text).unwrap();
        let line = "triangle,source_face,target_face,density,angle,area,on_skin\n0,3,40,1.25,1.5,0.5,0\n";
        assert_eq!(text, line);
        assert_eq!(vertex_distortion(&[None, Some(1.5)]), b"source_vertex,density\n0,\n1,1.5\n");
    }
}
