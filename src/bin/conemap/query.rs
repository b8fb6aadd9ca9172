//! `conemap query`.

use crate::arguments::QueryArguments;
use crate::input::{self, Failure};
use crate::outputs;
use crate::saved::{SavedFiles, write_or_print};
use conemap::export::vertex_image::{self, Direction};
use conemap::map_file::FileMesh;
use conemap::mesh::{FaceId, SurfacePoint};
use std::path::Path;

/// Answers images of points or of all vertices.
pub fn run(arguments: &QueryArguments) -> Result<(), Failure> {
    outputs::check(arguments.saved.files().into_iter().chain(&arguments.points), arguments.out.clone())?;
    let open = SavedFiles::read(&arguments.saved)?.open()?;
    let direction = if arguments.inverse { Direction::TargetToSource } else { Direction::SourceToTarget };
    let map = open.taken();
    let text = match &arguments.points {
        Some(path) => {
            let points = points(path, open.meshes()[direction.side()])?;
            let images: Vec<_> = map.images(direction, &points).into_iter().map(Some).collect();
            vertex_image::points_csv(direction, &images)
        }
        None => vertex_image::csv(direction, &map.vertex_images(direction)),
    };
    write_or_print(arguments.out.as_deref(), &text)
}

/// Reads lines `face,b0,b1,b2` or `vertex`; a first line of words and what follows `#` is left out.
fn points(path: &Path, mesh: &FileMesh) -> Result<Vec<SurfacePoint>, Failure> {
    let name = path.display();
    let text = String::from_utf8(input::bytes(path)?).map_err(|_| format!("{name}: it is not text"))?;
    let mut points = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let content = line.split('#').next().unwrap_or_default().trim();
        let is_heading = index == 0 && content.starts_with(|c: char| c.is_ascii_alphabetic());
        if content.is_empty() || is_heading {
            continue;
        }
        points
            .push(point(content, mesh).map_err(|problem| format!("{name}, line {}: {problem}", index + 1))?);
    }
    Ok(points)
}

fn point(content: &str, mesh: &FileMesh) -> Result<SurfacePoint, String> {
    let words: Vec<&str> = content.split(',').map(str::trim).collect();
    let expected = || format!("expected `face,b0,b1,b2` or `vertex`, found \"{content}\"");
    match words[..] {
        [vertex] => {
            let number: usize = vertex.parse().map_err(|_| expected())?;
            let known = mesh.checked().vertex_from_file.get(number).copied();
            let vertex = known.ok_or_else(|| format!("there is no vertex {number}"))?;
            let vertex = vertex.ok_or_else(|| format!("no face uses vertex {number}"))?;
            Ok(mesh.on_file(SurfacePoint::at_vertex(mesh.mesh(), vertex)))
        }
        [face, a, b, c] => {
            let face: u32 = face.parse().map_err(|_| expected())?;
            let faces = mesh.mesh().face_count();
            if face as usize >= faces {
                return Err(format!("there is no face {face}: the mesh has {faces} faces"));
            }
            let weight = |word: &str| word.parse::<f64>().map_err(|_| expected());
            let weights = [weight(a)?, weight(b)?, weight(c)?];
            let sum: f64 = weights.iter().sum();
            if !(weights.iter().all(|w| *w >= -1e-6) && (sum - 1.0).abs() < 1e-4) {
                return Err(format!("the weights {weights:?} are negative or do not sum to 1"));
            }
            Ok(SurfacePoint::clamped(FaceId(face), weights))
        }
        _ => Err(expected()),
    }
}
