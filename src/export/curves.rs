//! Curves on meshes, as OBJ, CSV and JSON.

use super::vertex_image::Direction;
use crate::mesh::SurfacePoint;
use glam::DVec3;
use serde_json::json;
use std::fmt::Write;

/// A curve on a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct CarriedCurve {
    /// Its name.
    pub name: String,
    /// Whether its last point is joined with its first.
    pub is_closed: bool,
    /// Its points; two that follow each other lie in one face.
    pub points: Vec<CarriedPoint>,
}

/// A point of a curve, in the numbers of the mesh's file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarriedPoint {
    /// The place of the point.
    pub point: SurfacePoint,
    /// Its position in space.
    pub position: DVec3,
}

/// Positions as vertices, and a line over them for each curve, for programs that show curves in space.
pub fn obj(curves: &[CarriedCurve]) -> Vec<u8> {
    let mut text = String::new();
    let mut first = 1;
    // Writing to a string does not fail.
    for curve in curves {
        let _ = writeln!(text, "o {}", one_line(&curve.name));
        for CarriedPoint { position: p, .. } in &curve.points {
            let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
        }
        let end = first + curve.points.len();
        if curve.points.len() > 1 {
            text.push('l');
            for v in first..end {
                let _ = write!(text, " {v}");
            }
            if curve.is_closed {
                let _ = write!(text, " {first}");
            }
            text.push('\n');
        }
        first = end;
    }
    text.into_bytes()
}

/// One line per point: `curve,target_face,b0,b1,b2,x,y,z`, or `source_face`. A closed curve ends with its first point.
pub fn csv(direction: Direction, curves: &[CarriedCurve]) -> Vec<u8> {
    let mut text = format!("curve,{}_face,b0,b1,b2,x,y,z\n", direction.names()[1]);
    for curve in curves {
        let name = one_line(&curve.name).replace([',', '#'], "_");
        let again = curve.points.first().filter(|_| curve.is_closed);
        for CarriedPoint { point, position: p } in curve.points.iter().chain(again) {
            let [a, b, c] = point.barycentric;
            let _ = writeln!(text, "{name},{},{a},{b},{c},{},{},{}", point.face.0, p.x, p.y, p.z);
        }
    }
    text.into_bytes()
}

/// `{"on", "curves": [{"name", "closed", "points": [{"face", "barycentric", "position"}]}]}`.
pub fn json(direction: Direction, curves: &[CarriedCurve]) -> Vec<u8> {
    let point = |p: &CarriedPoint| json!({ "face": p.point.face.0, "barycentric": p.point.barycentric, "position": p.position.to_array() });
    let curve = |curve: &CarriedCurve| {
        let points: Vec<_> = curve.points.iter().map(point).collect();
        json!({ "name": curve.name, "closed": curve.is_closed, "points": points })
    };
    let curves: Vec<_> = curves.iter().map(curve).collect();
    json!({ "on": direction.names()[1], "curves": curves }).to_string().into_bytes()
}

fn one_line(name: &str) -> String {
    name.split(char::is_control).collect::<Vec<_>>().join(" ").trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::curve_file::read;
    use crate::io::landmark_file::LandmarkPoint;
    use crate::mesh::FaceId;

    fn two_curves() -> Vec<CarriedCurve> {
        let point = |face: u32| CarriedPoint {
            point: SurfacePoint { face: FaceId(face), barycentric: [0.1, 0.2, 0.7] },
            position: DVec3::new(f64::from(face), 0.5, -1.0),
        };
        let curve = |name: &str, is_closed, faces: [u32; 3]| CarriedCurve {
            name: name.to_owned(),
            is_closed,
            points: faces.map(point).to_vec(),
        };
        vec![curve("belt", true, [3, 1, 4]), curve("seam", false, [1, 5, 9])]
    }

    #[test]
    fn tables_and_json_are_read_back() {
        let given = two_curves();
        for bytes in [csv(Direction::SourceToTarget, &given), json(Direction::SourceToTarget, &given)] {
            let back = read(&bytes, 100).unwrap();
            assert_eq!(back.len(), 2);
            for (a, b) in given.iter().zip(&back) {
                assert_eq!((&a.name, a.is_closed), (&b.name, b.is_closed));
                let points: Vec<_> = a
                    .points
                    .iter()
                    .map(|p| LandmarkPoint::OnFace { face: p.point.face.0, barycentric: p.point.barycentric })
                    .collect();
                assert_eq!(points, b.points);
            }
        }
    }

    #[test]
    fn lines_run_over_positions() {
        let text = String::from_utf8(obj(&two_curves())).unwrap();
        assert!(text.contains("o belt\nv 3 0.5 -1\n") && text.contains("\nl 1 2 3 1\n"), "{text}");
        assert!(text.ends_with("l 4 5 6\n"));
    }
}
