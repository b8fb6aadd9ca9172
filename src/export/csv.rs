//! Vertex images as comma-separated values.

use crate::mesh::{FaceId, SurfacePoint};
use crate::pipeline::TriangleDistortion;
use std::fmt::Write;

/// One line per vertex of the source's file ([`crate::mesh::check::CheckedMesh::by_file_vertex`]):
/// `source_vertex,target_face,b0,b1,b2`; the last four are empty where there is no image.
pub fn vertex_images(images: &[Option<SurfacePoint>]) -> Vec<u8> {
    let mut text = String::from("source_vertex,target_face,b0,b1,b2\n");
    for (v, image) in images.iter().enumerate() {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{v},{}", fields(image.as_ref()));
    }
    text.into_bytes()
}

/// The same with a last field `in_cap`: 1 where the image lies in a cap of the target, which was made up to close a hole, 0 where
/// it lies on its skin; empty where there is no image.
pub fn vertex_images_with_caps(images: &[Option<SurfacePoint>], in_cap: &[bool]) -> Vec<u8> {
    let mut text = String::from("source_vertex,target_face,b0,b1,b2,in_cap\n");
    for (v, (image, &in_cap)) in images.iter().zip(in_cap).enumerate() {
        let mark = image.map_or("", |_| if in_cap { "1" } else { "0" });
        // Writing to a string does not fail.
        let _ = writeln!(text, "{v},{},{mark}", fields(image.as_ref()));
    }
    text.into_bytes()
}

/// `target_face,b0,b1,b2`.
fn fields(image: Option<&SurfacePoint>) -> String {
    match image {
        Some(SurfacePoint { face, barycentric: [a, b, c] }) => format!("{},{a},{b},{c}", face.0),
        None => ",,,".to_owned(),
    }
}

/// One line per triangle of the overlay, numbered as in the textured GLB: `triangle,source_face,target_face,density,angle,
/// area`. `faces` gives a face of the mapped meshes its number in the source's or the target's file.
pub fn distortion(triangles: &[TriangleDistortion], faces: [&dyn Fn(FaceId) -> FaceId; 2]) -> Vec<u8> {
    let mut text = String::from("triangle,source_face,target_face,density,angle,area\n");
    for (k, TriangleDistortion { source_face, target_face, local }) in triangles.iter().enumerate() {
        let (s, t) = (faces[0](*source_face).0, faces[1](*target_face).0);
        // Writing to a string does not fail.
        let _ = writeln!(text, "{k},{s},{t},{},{},{}", local.density, local.angle, local.area);
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

    #[test]
    fn numbers_come_back() {
        let point = SurfacePoint { face: FaceId(17), barycentric: [0.1, 0.2, 0.7] };
        let text = String::from_utf8(vertex_images(&[Some(point), None])).unwrap();
        assert_eq!(text, "source_vertex,target_face,b0,b1,b2\n0,17,0.1,0.2,0.7\n1,,,,\n");
        let capped = vertex_images_with_caps(&[Some(point), Some(point), None], &[true, false, false]);
        let lines = "0,17,0.1,0.2,0.7,1\n1,17,0.1,0.2,0.7,0\n2,,,,,\n";
        let text = String::from_utf8(capped).unwrap();
        assert_eq!(text, format!("source_vertex,target_face,b0,b1,b2,in_cap\n{lines}"));
    }
    #[test]
    fn distortions_name_the_files_faces() {
        let local = LocalDistortion { density: 1.25, angle: 1.5, area: 0.5 };
        let triangle = TriangleDistortion { source_face: FaceId(3), target_face: FaceId(4), local };
        let text = distortion(&[triangle], [&|f| f, &|f| FaceId(10 * f.0)]);
        let text = String::from_utf8(text).unwrap();
        assert_eq!(text, "triangle,source_face,target_face,density,angle,area\n0,3,40,1.25,1.5,0.5\n");
        assert_eq!(vertex_distortion(&[None, Some(1.5)]), b"source_vertex,density\n0,\n1,1.5\n");
    }
}
