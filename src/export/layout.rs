//! The flat layout as a drawing (SVG), and each mesh cut along it with texture coordinates (OBJ).

use super::flat_sheet::FlatSheet;
use crate::mesh::FaceId;
use crate::surface_map::flat_layout::{FlatDrawing, FlatLayout};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use std::fmt::Write;

/// Side of the unit square in the SVG's units.
const SIZE: f64 = 1000.0;

/// Both meshes on the flat base domain: base faces, edges of the source and of the target, and the landmarks with their numbers
/// (from 1) as groups of these names.
pub fn svg(layout: &FlatLayout) -> Vec<u8> {
    let sheet = FlatSheet::new(layout);
    let paper = Paper { height: sheet.height * SIZE, sheet: &sheet };
    let (width, height) = (sheet.width * SIZE, paper.height);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.2} {height:.2}\" fill=\"none\" \
         stroke-linejoin=\"round\">\n<title>Flat layout: both meshes on the base domain</title>\n"
    );
    let charts = layout.base.mesh.faces();
    let outline = |f: FaceId| paper.path(&sheet.corners[f]);
    paper.group(
        &mut text,
        "base-faces",
        "fill=\"#f4f1ea\" stroke=\"#333333\" stroke-width=\"1.6\"",
        charts.map(outline),
    );
    for (name, style, drawing) in [
        ("source-edges", "stroke=\"#2f6db3\" stroke-width=\"0.3\"", &layout.drawings[0]),
        ("target-edges", "stroke=\"#c4571e\" stroke-width=\"0.3\"", &layout.drawings[1]),
    ] {
        let polygons = drawing.polygons.iter().map(|polygon| {
            let corner = |&v: &u32| sheet.at(polygon.chart, drawing.vertices[v as usize].weights);
            paper.path(&drawing.corners[polygon.corners.clone()].iter().map(corner).collect::<Vec<_>>())
        });
        paper.group(&mut text, name, style, polygons);
    }
    paper.landmarks(&mut text, layout);
    text.push_str("</svg>\n");
    text.into_bytes()
}

/// A sheet with its y axis downwards.
struct Paper<'a> {
    sheet: &'a FlatSheet,
    height: f64,
}

impl Paper<'_> {
    fn at(&self, p: DVec2) -> DVec2 {
        DVec2::new(p.x * SIZE, self.height - p.y * SIZE)
    }

    fn path(&self, corners: &[DVec2]) -> String {
        let mut path = String::new();
        for (k, &p) in corners.iter().enumerate() {
            let p = self.at(p);
            // Writing to a string does not fail.
            let _ = write!(path, "{}{:.2} {:.2}", if k == 0 { 'M' } else { 'L' }, p.x, p.y);
        }
        path + "Z"
    }

    fn group(&self, text: &mut String, name: &str, style: &str, paths: impl Iterator<Item = String>) {
        let _ = write!(text, "<g id=\"{name}\" {style}><path d=\"");
        paths.for_each(|path| text.push_str(&path));
        text.push_str("\"/></g>\n");
    }

    fn landmarks(&self, text: &mut String, layout: &FlatLayout) {
        text.push_str("<g id=\"landmarks\" fill=\"#111111\" font-family=\"sans-serif\" font-size=\"10\">\n");
        let mut drawn = std::collections::BTreeSet::new();
        for f in layout.base.mesh.faces() {
            for (k, v) in layout.base.mesh.triangles()[f].iter().enumerate() {
                let p = self.at(self.sheet.corners[f][k]);
                // A cone on the border of an island occurs several times, inside it once.
                let place = [p.x, p.y].map(|x| (x * 100.0).round() as i64);
                if drawn.insert((v.0, place)) {
                    let number = v.0 + 1;
                    let (x, y) = (p.x, p.y);
                    let _ = writeln!(
                        text,
                        "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3\"/><text x=\"{:.2}\" y=\"{:.2}\">{number}</text>",
                        x + 4.0,
                        y - 4.0
                    );
                }
            }
        }
        text.push_str("</g>\n");
    }
}

/// One of both meshes, cut along the edges of the base domain, with its texture coordinates on the sheet: where source and target
/// have the same, they correspond. `position` tells where a vertex of the drawing is in space, by its number.
pub fn obj(layout: &FlatLayout, drawing: &FlatDrawing, position: impl Fn(usize) -> DVec3) -> Vec<u8> {
    let sheet = FlatSheet::new(layout);
    let mut text = String::from("# Texture coordinates: the flat layout common to both meshes\n");
    let mut numbers = FxHashMap::default();
    let mut vertices = Vec::with_capacity(drawing.vertices.len());
    for (k, vertex) in drawing.vertices.iter().enumerate() {
        let next = numbers.len() + 1;
        let number = *numbers.entry(vertex.place.key()).or_insert(next);
        vertices.push(number);
        if number == next {
            let p = position(k);
            // Writing to a string does not fail.
            let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
        }
    }
    let mut charts = vec![FaceId(0); drawing.vertices.len()];
    for polygon in &drawing.polygons {
        drawing.corners[polygon.corners.clone()].iter().for_each(|&v| charts[v as usize] = polygon.chart);
    }
    for (vertex, &chart) in drawing.vertices.iter().zip(&charts) {
        let uv = sheet.at(chart, vertex.weights);
        let _ = writeln!(text, "vt {} {}", uv.x, uv.y);
    }
    for polygon in &drawing.polygons {
        let mut corners = drawing.corners[polygon.corners.clone()].to_vec();
        // Where an edge of the base domain runs through a vertex, corners of a polygon may be one point.
        corners.dedup_by_key(|v| vertices[*v as usize]);
        while corners.len() > 1
            && vertices[corners[0] as usize] == vertices[corners[corners.len() - 1] as usize]
        {
            corners.pop();
        }
        if corners.len() >= 3 {
            text.push('f');
            for v in corners {
                let _ = write!(text, " {}/{}", vertices[v as usize], v + 1);
            }
            text.push('\n');
        }
    }
    text.into_bytes()
}
