//! Images of vertices, as CSV and JSON.

use crate::mesh::SurfacePoint;
use crate::mesh_side::MeshSide;
use glam::DVec3;
use serde_json::json;
use std::fmt::Write;

/// The direction of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Vertices of the source, images on the target.
    SourceToTarget,
    /// Vertices of the target, and the points of the source that they come from.
    TargetToSource,
}

impl Direction {
    /// There and back.
    pub const BOTH: [Self; 2] = [Self::SourceToTarget, Self::TargetToSource];

    /// The mesh whose vertices are mapped, then the mesh of their images.
    pub fn names(self) -> [&'static str; 2] {
        match self {
            Self::SourceToTarget => ["source", "target"],
            Self::TargetToSource => ["target", "source"],
        }
    }

    /// The mesh whose vertices are mapped.
    pub fn side(self) -> MeshSide {
        match self {
            Self::SourceToTarget => MeshSide::Source,
            Self::TargetToSource => MeshSide::Target,
        }
    }
}

/// The image of a point, in the numbers of the file that holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointImage {
    /// The place of the image.
    pub point: SurfacePoint,
    /// Its position in space.
    pub position: DVec3,
    /// Whether it lies in a cap, which was made up to close a hole, or on the mesh's skin; `None` where the mesh has no caps.
    pub in_cap: Option<bool>,
}

/// One line per vertex of a mesh's file ([`crate::mesh::check::CheckedMesh::by_file_vertex`]): for the source
/// `source_vertex,target_face,b0,b1,b2,x,y,z`; all but the first are empty where there is no image. Where the mesh of the images has caps, a last field
/// `in_cap` is 1 for an image in one and 0 for one on the skin.
pub fn csv(direction: Direction, images: &[Option<PointImage>]) -> Vec<u8> {
    let [from, onto] = direction.names();
    lines(format!("{from}_vertex,{onto}_face,b0,b1,b2,x,y,z\n"), images)
}

/// One line per point that was asked for, numbered from 0: `point,target_face,b0,b1,b2,x,y,z`, or `source_face` for the way back.
pub fn points_csv(direction: Direction, images: &[Option<PointImage>]) -> Vec<u8> {
    lines(format!("point,{}_face,b0,b1,b2,x,y,z\n", direction.names()[1]), images)
}

/// One line per vertex of the source with its image in space: `source_vertex,x,y,z`.
pub fn places_csv(images: &[DVec3]) -> Vec<u8> {
    let mut text = "source_vertex,x,y,z\n".to_owned();
    for (v, p) in images.iter().enumerate() {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{v},{},{},{}", p.x, p.y, p.z);
    }
    text.into_bytes()
}

fn lines(mut text: String, images: &[Option<PointImage>]) -> Vec<u8> {
    let has_caps = images.iter().flatten().any(|image| image.in_cap.is_some());
    if has_caps {
        text.truncate(text.trim_end().len());
        text.push_str(",in_cap\n");
    }
    for (v, image) in images.iter().enumerate() {
        // Writing to a string does not fail.
        let _ = match image {
            Some(PointImage { point, position: p, in_cap }) => {
                let [a, b, c] = point.barycentric;
                let mark = in_cap.map_or("", |is| if is { ",1" } else { ",0" });
                writeln!(text, "{v},{},{a},{b},{c},{},{},{}{mark}", point.face.0, p.x, p.y, p.z)
            }
            None => writeln!(text, "{v},,,,,,,{}", if has_caps { "," } else { "" }),
        };
    }
    text.into_bytes()
}

/// The same as JSON: `{"from", "to", "images": [{"vertex", "face", "barycentric", "position"}]}`, without vertices that have no
/// image.
pub fn json(direction: Direction, images: &[Option<PointImage>]) -> Vec<u8> {
    let [from, to] = direction.names();
    let entry = |(vertex, image): (usize, &Option<PointImage>)| {
        let PointImage { point, position, in_cap } = (*image)?;
        let mut told = json!({
            "vertex": vertex, "face": point.face.0, "barycentric": point.barycentric, "position": position.to_array(),
        });
        if let Some(in_cap) = in_cap {
            told["in_cap"] = json!(in_cap);
        }
        Some(told)
    };
    let images: Vec<_> = images.iter().enumerate().filter_map(entry).collect();
    json!({ "from": from, "to": to, "images": images }).to_string().into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::FaceId;

    #[test]
    fn numbers_come_back() {
        let point = SurfacePoint { face: FaceId(17), barycentric: [0.1, 0.2, 0.7] };
        let images = [Some(PointImage { point, position: DVec3::new(1.0, -2.5, 0.125), in_cap: None }), None];
        let text = String::from_utf8(csv(Direction::SourceToTarget, &images)).unwrap();
        assert_eq!(
            text,
            "source_vertex,target_face,b0,b1,b2,x,y,z\n0,17,0.1,0.2,0.7,1,-2.5,0.125\n1,,,,,,,\n"
        );
        assert_eq!(places_csv(&[DVec3::new(1.0, -2.5, 0.125)]), b"source_vertex,x,y,z\n0,1,-2.5,0.125\n");
        assert!(csv(Direction::TargetToSource, &images).starts_with(b"target_vertex,source_face,b0"));
        let value: serde_json::Value =
            serde_json::from_slice(&json(Direction::TargetToSource, &images)).unwrap();
        assert_eq!((&value["from"], &value["to"]), (&json!("target"), &json!("source")));
        assert_eq!(
            value["images"],
            json!([{"vertex": 0, "face": 17, "barycentric": [0.1, 0.2, 0.7], "position": [1.0, -2.5, 0.125]}])
        );
    }

    #[test]
    fn images_in_caps_are_marked() {
        let point = SurfacePoint { face: FaceId(17), barycentric: [0.1, 0.2, 0.7] };
        let images =
            [Some(true), Some(false)].map(|in_cap| Some(PointImage { point, position: DVec3::X, in_cap }));
        let text = String::from_utf8(csv(Direction::SourceToTarget, &[images[0], images[1], None])).unwrap();
        let head = "source_vertex,target_face,b0,b1,b2,x,y,z,in_cap\n";
        assert_eq!(text, format!("{head}0,17,0.1,0.2,0.7,1,0,0,1\n1,17,0.1,0.2,0.7,1,0,0,0\n2,,,,,,,,\n"));
        let value: serde_json::Value =
            serde_json::from_slice(&json(Direction::SourceToTarget, &images)).unwrap();
        assert_eq!(value["images"][0]["in_cap"], json!(true));
    }
}
