//! Vertex images as comma-separated values.

use crate::mesh::SurfacePoint;
use std::fmt::Write;

/// One line per source vertex: `source_vertex,target_face,b0,b1,b2`; the last four are empty where there is no image.
pub fn vertex_images(images: &[Option<SurfacePoint>]) -> Vec<u8> {
    let mut text = String::from("source_vertex,target_face,b0,b1,b2\n");
    for (v, image) in images.iter().enumerate() {
        // Writing to a string does not fail.
        let _ = match image {
            Some(SurfacePoint { face, barycentric: [a, b, c] }) => {
                writeln!(text, "{v},{},{a},{b},{c}", face.0)
            }
            None => writeln!(text, "{v},,,,"),
        };
    }
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::FaceId;

    #[test]
    fn numbers_come_back() {
        let point = SurfacePoint { face: FaceId(17), barycentric: [0.1, 0.2, 0.7] };
        let text = String::from_utf8(vertex_images(&[Some(point), None])).unwrap();
        assert_eq!(text, "source_vertex,target_face,b0,b1,b2\n0,17,0.1,0.2,0.7\n1,,,,\n");
    }
}
