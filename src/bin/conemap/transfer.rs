//! `conemap transfer`: attributes, motions, curves and shapes from one mesh to the other by a saved map.

use crate::arguments::TransferArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::outputs;
use crate::saved::SavedFiles;
use crate::told::say;
use conemap::export::vertex_image::Direction;
use conemap::export::{self, ply};
use conemap::io::{curve_file, picture, texture_coordinates, vertex_table};
use conemap::job::{OpenMap, OutputKind};
use conemap::landmarks::MeshSide;
use conemap::map_file::FileMesh;
use conemap::monitor::Stage;
use conemap::transfer::attributes::{AttributeOptions, attributes};
use conemap::transfer::deformation::DeformationTransfer;
use conemap::transfer::shape::shape_report;
use conemap::transfer::texture::{self, BakeOptions, GivenTexture};
use conemap::transfer::{MappedFiles, curves, frames};
use serde_json::json;
use std::path::{Path, PathBuf};

/// The meshes of `--shape`, and the file of its figures.
const SHAPES: [OutputKind; 2] = [OutputKind::SourceShapeObj, OutputKind::TargetShapeObj];
const SHAPE_REPORT: &str = "shape.json";

/// The file of a frame.
fn frame_name(number: usize) -> String {
    format!("frame-{number:03}.obj")
}

/// Brings over what was asked for.
pub fn run(arguments: &TransferArguments) -> Result<(), Failure> {
    let out = &arguments.out;
    // Asked before the work is done.
    let format = match (&arguments.attributes, &arguments.curves, &arguments.texture) {
        (Some(_), _, _) => ending(out, &["csv", "ply"])?,
        (_, Some(_), _) => ending(out, &["json", "csv", "obj"])?,
        (_, _, Some(_)) => ending(out, &["png"])?,
        _ if arguments.morph => ending(out, &["glb"])?,
        _ => "",
    };
    outputs::check(inputs(arguments), outputs_of(arguments))?;
    let files = SavedFiles::read(&arguments.saved)?;
    let open = files.open()?;
    let transfer = Transfer { arguments, files: &files, open: &open, direction: arguments.from.into() };
    if let Some(path) = &arguments.attributes {
        transfer.attributes(path, format)
    } else if let Some(path) = &arguments.curves {
        transfer.curves(path, format)
    } else if let Some(path) = &arguments.texture {
        transfer.texture(path)
    } else if arguments.shape {
        transfer.shapes()
    } else if arguments.morph {
        let bytes = open.taken().morph_glb(&mut Clock::start_only(Stage::Transfer))?;
        outputs::write(out, &bytes)
    } else {
        transfer.motions()
    }
}

/// The files that are read.
fn inputs(arguments: &TransferArguments) -> impl Iterator<Item = &PathBuf> {
    let TransferArguments { saved, attributes, frames, curves, texture, .. } = arguments;
    saved.files().into_iter().chain(attributes).chain(curves).chain(texture).chain(frames)
}

/// The files that are written.
fn outputs_of(arguments: &TransferArguments) -> Vec<PathBuf> {
    let out = &arguments.out;
    if arguments.shape {
        let kinds = SHAPES.iter().map(|kind| out.join(kind.file_name()));
        kinds.chain([out.join(SHAPE_REPORT)]).collect()
    } else if arguments.frames.is_empty() {
        vec![out.clone()]
    } else {
        (0..arguments.frames.len()).map(|number| out.join(frame_name(number))).collect()
    }
}

/// The one of some endings that a name has.
fn ending(out: &Path, known: &[&'static str]) -> Result<&'static str, Failure> {
    let ending = out.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    known.iter().find(|known| known.eq_ignore_ascii_case(ending)).copied().ok_or_else(|| {
        let known = known.iter().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ");
        format!("{}: the name must end in one of {known}", out.display()).into()
    })
}

/// A sentence that names the file.
fn of_file(path: &Path, error: &dyn std::fmt::Display) -> Failure {
    format!("{}: {error}", path.display()).into()
}

/// A saved map, and what is to be brought over by it.
struct Transfer<'a> {
    arguments: &'a TransferArguments,
    files: &'a SavedFiles<'a>,
    open: &'a OpenMap,
    direction: Direction,
}

impl<'a> Transfer<'a> {
    fn mapped(&self) -> MappedFiles<'a> {
        MappedFiles { files: self.open.meshes(), map: &self.open.taken().map().correspondence }
    }

    fn giver(&self) -> &'a FileMesh {
        self.open.meshes()[self.direction.side()]
    }

    fn receiver(&self) -> &'a FileMesh {
        self.open.meshes()[1 - self.direction.side()]
    }

    fn attributes(&self, path: &Path, format: &str) -> Result<(), Failure> {
        let bytes = input::bytes(path)?;
        let table =
            vertex_table::read(&bytes, self.giver().file_vertices()).map_err(|e| of_file(path, &e))?;
        if !table.left_out.is_empty() {
            say(format_args!("{}: lists are left out: {}", path.display(), table.left_out.join(", ")));
        }
        let options = AttributeOptions {
            direction: self.direction,
            carrying: self.arguments.method.into(),
            labels: self.arguments.labels.clone(),
            weights: self.arguments.weights.clone(),
        };
        let mut clock = Clock::start_only(Stage::Transfer);
        let carried =
            attributes(self.mapped(), &table, &options, &mut clock).map_err(|e| of_file(path, &e))?;
        let bytes = if format == "ply" {
            let receiver = self.receiver();
            let positions = frames::of_file(receiver, receiver.mesh().positions());
            ply::polygons_with(&positions, receiver.polygons(), &carried.columns)
        } else {
            export::vertex_table::csv(&carried)
        };
        outputs::write(&self.arguments.out, &bytes)
    }

    fn texture(&self, path: &Path) -> Result<(), Failure> {
        let picture = picture::read(&input::bytes(path)?).map_err(|e| of_file(path, &e))?;
        let [source, target] = self.open.meshes();
        let files = self.files.bytes();
        let uvs = |mesh: &FileMesh, bytes: &[u8], side: MeshSide| -> Result<_, Failure> {
            let corners = texture_coordinates::read(bytes).map_err(|e| self.files.told(Some(side), &e))?;
            texture::face_uvs(mesh, &corners).map_err(|e| self.files.told(Some(side), &e))
        };
        let uvs =
            [uvs(source, files.source, MeshSide::Source)?, uvs(target, files.target, MeshSide::Target)?];
        let given = GivenTexture { uvs: uvs.each_ref(), picture: &picture };
        let options = BakeOptions {
            direction: self.direction,
            size: self.arguments.size.into(),
            border: self.arguments.border.into(),
        };
        let mut clock = Clock::start_only(Stage::Transfer);
        let baked = texture::baked(self.mapped(), given, options, &mut clock)?;
        outputs::write(&self.arguments.out, &export::picture::png(&baked)?)
    }

    fn motions(&self) -> Result<(), Failure> {
        let paths = &self.arguments.frames;
        // All frames are looked at before the first is brought over.
        let mut shapes = Vec::new();
        for path in paths {
            let shape = frames::read(self.giver(), &input::mesh_bytes(path)?);
            shapes.push(shape.map_err(|e| of_file(path, &e))?);
        }
        let mut clock = Clock::start_only(Stage::Transfer);
        let mapped = self.mapped();
        let mut transfer = DeformationTransfer::new(mapped.meshes(), mapped.map, self.direction, &mut clock)?;
        for (number, (shape, path)) in shapes.iter().zip(paths).enumerate() {
            let moved = transfer.moved(shape, &mut clock).map_err(|e| of_file(path, &e))?;
            let positions = frames::of_file(self.receiver(), &moved);
            let bytes = export::obj::polygons(&positions, self.receiver().polygons());
            outputs::write(&self.arguments.out.join(frame_name(number)), &bytes)?;
        }
        Ok(())
    }

    fn shapes(&self) -> Result<(), Failure> {
        let out = &self.arguments.out;
        let mapped = self.mapped();
        let mut reports = serde_json::Map::new();
        for (direction, kind) in
            [Direction::SourceToTarget, Direction::TargetToSource].into_iter().zip(SHAPES)
        {
            let mut clock = Clock::start_only(Stage::Transfer);
            let report = shape_report(mapped.meshes(), mapped.map, direction, &mut clock)?;
            drop(clock);
            let [mesh, shape] = direction.names();
            say(format_args!("{mesh} in the {shape}'s shape: {}", report.sentence()));
            reports.insert(format!("{mesh}_in_{shape}_shape"), json!(report));
            outputs::write(&out.join(kind.file_name()), &self.open.taken().output(kind)?)?;
        }
        outputs::write(&out.join(SHAPE_REPORT), &serde_json::to_vec_pretty(&reports)?)
    }

    fn curves(&self, path: &Path, format: &str) -> Result<(), Failure> {
        let bytes = input::bytes(path)?;
        let given = curve_file::read(&bytes, self.giver().file_vertices()).map_err(|e| of_file(path, &e))?;
        let mut clock = Clock::start_only(Stage::Transfer);
        let carried = curves::of_files(self.mapped(), self.direction, &given, &mut clock)
            .map_err(|e| of_file(path, &e))?;
        let bytes = match format {
            "obj" => export::curves::obj(&carried),
            "csv" => export::curves::csv(self.direction, &carried),
            _ => export::curves::json(self.direction, &carried),
        };
        outputs::write(&self.arguments.out, &bytes)
    }
}
