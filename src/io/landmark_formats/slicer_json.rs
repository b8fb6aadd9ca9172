//! 3D Slicer's markups (`.mrk.json`): lists of control points in a named coordinate system. Planes and boxes are no landmarks
//! and are passed over.

use super::content::{Mark, MarkList, Space, Spot, SurfaceMarks};
use super::text::{check_count, json_problem, usable};
use crate::io::problem::{Place, Problem};
use crate::io::reading;
use crate::io::separated::one_line;
use glam::DVec3;
use serde::Deserialize;
use serde_json::{Value, json};

const SCHEMA: &str = "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json#";

#[derive(Deserialize)]
struct File {
    markups: Vec<Markup>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Markup {
    #[serde(default, rename = "type")]
    kind: String,
    #[serde(default)]
    name: String,
    #[serde(default)]
    coordinate_system: Space,
    #[serde(default)]
    control_points: Vec<ControlPoint>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ControlPoint {
    #[serde(default)]
    label: String,
    /// Numbers that are `null` were not known.
    #[serde(default)]
    position: Option<[Option<f64>; 3]>,
    #[serde(default)]
    position_status: Option<String>,
}

impl ControlPoint {
    fn mark(self) -> Result<Mark, Problem> {
        let is_placed = self.position_status.is_none_or(|status| status == "defined");
        let known = self.position.filter(|_| is_placed);
        let spot = match known {
            Some([Some(x), Some(y), Some(z)]) => {
                let numbers = [x, y, z].map(usable);
                let [Some(x), Some(y), Some(z)] = numbers else {
                    let problem =
                        format!("the control point \"{}\" has no usable coordinates", one_line(&self.label));
                    return Err((Place::Header, problem));
                };
                Some(Spot::InSpace(DVec3::new(x, y, z)))
            }
            _ => None,
        };
        Ok(Mark { label: self.label, spot })
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<Vec<MarkList>, Problem> {
    let file: File = serde_json::from_str(&reading::text(bytes)?).map_err(|e| json_problem(&e))?;
    let is_list = |markup: &Markup| {
        !matches!(markup.kind.as_str(), "Plane" | "ROI") && !markup.control_points.is_empty()
    };
    let lists = file.markups.into_iter().filter(is_list);
    lists
        .map(|markup| {
            check_count(markup.control_points.len(), 1)?;
            let marks =
                markup.control_points.into_iter().map(ControlPoint::mark).collect::<Result<_, _>>()?;
            Ok(MarkList { name: markup.name, space: Some(markup.coordinate_system), marks })
        })
        .collect()
}

pub(super) fn write(sides: &[SurfaceMarks]) -> Vec<u8> {
    let markups: Vec<_> = sides.iter().map(markup).collect();
    serde_json::to_vec_pretty(&json!({ "@schema": SCHEMA, "markups": markups })).unwrap_or_default()
}

fn markup(side: &SurfaceMarks) -> Value {
    let points: Vec<_> = (1..)
        .zip(&side.marks)
        .map(|(number, mark)| {
            json!({
                "id": number.to_string(),
                "label": mark.label,
                "position": mark.position.to_array(),
                "selected": true,
                "locked": false,
                "visibility": true,
                "positionStatus": "defined",
            })
        })
        .collect();
    json!({
        "type": "Fiducial",
        "name": side.name,
        "coordinateSystem": side.space,
        "controlPoints": points,
    })
}
