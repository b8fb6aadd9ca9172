//! Faceform Wrap's points (`.json`): `[[triangle, u, v], ...]` or `{"name": [triangle, u, v], ...}`, where a point of the triangle ABC is A
//! u + B v + C (1 - u - v). Wrap saves points in space in the same two forms: they are recognised by triangle numbers that are not whole.
//!
//! The triangles are those of Wrap, which cuts a polygon into a fan around its first corner. They are the mesh's own where all
//! its faces are triangles.

use super::content::{Mark, MarkList, Spot, SurfaceMark, SurfaceMarks};
use super::limits::MAX_POINTS;
use super::text::{json_problem, usable};
use crate::io::landmark_file::LandmarkPoint;
use crate::io::problem::{Place, Problem};
use crate::io::reading;
use crate::io::separated::one_line;
use glam::DVec3;
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::Number;
use std::fmt;

type Triple = [Number; 3];

/// The points of a file in their order, each with its name, empty for none.
struct Points(Vec<(String, Triple)>);

impl<'de> Deserialize<'de> for Points {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(PointsVisitor)
    }
}

struct PointsVisitor;

impl PointsVisitor {
    fn check<E: Error>(count: usize) -> Result<(), E> {
        if count > MAX_POINTS {
            Err(E::custom(format!("there are more than {MAX_POINTS} points")))
        } else {
            Ok(())
        }
    }
}

impl<'de> Visitor<'de> for PointsVisitor {
    type Value = Points;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("points [triangle, u, v], in a list or by their names")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Points, A::Error> {
        let mut points = Vec::new();
        while let Some(triple) = list.next_element::<Triple>()? {
            points.push((String::new(), triple));
            Self::check(points.len())?;
        }
        Ok(Points(points))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Points, A::Error> {
        let mut points = Vec::new();
        while let Some(entry) = map.next_entry::<String, Triple>()? {
            points.push(entry);
            Self::check(points.len())?;
        }
        Ok(Points(points))
    }
}

/// Whether this is JSON of one of the two forms, with a point at least.
pub(super) fn has_form(bytes: &[u8]) -> bool {
    serde_json::from_slice(bytes).is_ok_and(|Points(points)| !points.is_empty())
}

pub(super) fn read(bytes: &[u8]) -> Result<Vec<MarkList>, Problem> {
    let Points(points) = serde_json::from_str(&reading::text(bytes)?).map_err(|e| json_problem(&e))?;
    let on_triangles = points.iter().all(|(_, [triangle, ..])| triangle.is_u64());
    let mark = |(number, (label, triple)): (usize, (String, Triple))| {
        let spot = if on_triangles { on_triangle(&triple) } else { in_space(&triple) };
        let name = if label.is_empty() { format!("{}", number + 1) } else { one_line(&label) };
        let spot = spot.map_err(|problem| (Place::Header, format!("point {name}: {problem}")))?;
        Ok(Mark { label, spot: Some(spot) })
    };
    let marks = points.into_iter().enumerate().map(mark).collect::<Result<_, Problem>>()?;
    Ok(vec![MarkList { marks, ..MarkList::default() }])
}

fn on_triangle([triangle, u, v]: &Triple) -> Result<Spot, String> {
    let face = triangle.as_u64().and_then(|t| u32::try_from(t).ok());
    let face = face.ok_or_else(|| format!("there is no triangle {triangle}"))?;
    let (Some(a), Some(b)) = (u.as_f64(), v.as_f64()) else {
        return Err(format!("{u} and {v} are no weights"));
    };
    let point = LandmarkPoint::OnFace { face, barycentric: [a, b, 1.0 - a - b] };
    if point.is_sound() {
        Ok(Spot::OnMesh(point))
    } else {
        Err(format!("the weights u = {u} and v = {v} lie outside of the triangle"))
    }
}

fn in_space(numbers: &Triple) -> Result<Spot, String> {
    let [x, y, z] = numbers.each_ref().map(|n| n.as_f64().and_then(usable));
    let position = x.zip(y).zip(z).map(|((x, y), z)| DVec3::new(x, y, z));
    position.map(Spot::InSpace).ok_or_else(|| "it has no usable coordinates".to_owned())
}

/// Writes the points by their names where every point has a name of its own, and else as a list.
pub(super) fn write(side: &SurfaceMarks) -> Vec<u8> {
    let mut names = rustc_hash::FxHashSet::default();
    let is_named = side.marks.iter().all(|mark| !mark.label.is_empty() && names.insert(&mark.label));
    let entry = |mark: &SurfaceMark| {
        let [u, v, _] = mark.weights;
        let triple = format!("[{}, {}, {}]", mark.face, Json(u), Json(v));
        if is_named { format!("{}: {triple}", serde_json::Value::from(mark.label.as_str())) } else { triple }
    };
    let entries: Vec<_> = side.marks.iter().map(entry).collect();
    let [open, close] = if is_named { ["{", "}"] } else { ["[", "]"] };
    format!("{open}\n  {}\n{close}\n", entries.join(",\n  ")).into_bytes()
}

/// A weight with all its digits and a decimal point.
struct Json(f64);

impl fmt::Display for Json {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.0)
    }
}
