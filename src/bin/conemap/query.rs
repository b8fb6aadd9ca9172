//! `conemap query`.

use crate::arguments::QueryArguments;
use crate::input::{self, Failure};
use crate::outputs;
use crate::saved::{SavedFiles, write_or_print};
use conemap::export::vertex_image::{self, Direction};
use conemap::io::landmark_file::LandmarkPoint;
use conemap::io::point_table;
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

/// Reads the points of a file, and checks them against the mesh.
fn points(path: &Path, mesh: &FileMesh) -> Result<Vec<SurfacePoint>, Failure> {
    let name = path.display();
    let points = point_table::read(&input::bytes(path)?).map_err(|error| format!("{name}, {error}"))?;
    let on_mesh = |(line, given)| {
        point(given, mesh).map_err(|problem| format!("{name}, line {line}: {problem}").into())
    };
    points.into_iter().map(on_mesh).collect()
}

fn point(given: LandmarkPoint, mesh: &FileMesh) -> Result<SurfacePoint, String> {
    match given {
        LandmarkPoint::Vertex(number) => {
            let vertex = mesh.checked().numbered_vertex(number as usize).map_err(|none| none.to_string())?;
            Ok(mesh.on_file(SurfacePoint::at_vertex(mesh.mesh(), vertex)))
        }
        LandmarkPoint::OnFace { face, barycentric } => {
            let faces = mesh.mesh().face_count();
            if face as usize >= faces {
                return Err(format!("there is no face {face}: the mesh has {faces} faces"));
            }
            Ok(SurfacePoint::clamped(FaceId(face), barycentric))
        }
    }
}
