//! `conemap transfer`: attributes, motions, curves and shapes from one mesh to the other by a saved map.

use crate::arguments::TransferArguments;
use crate::clock::Clock;
use crate::input::{self, Failure};
use crate::outputs;
use crate::saved::SavedFiles;
use crate::told::say;
use conemap::export::vertex_image::Direction;
use conemap::job::{MapFiles, OpenMap, ShapeOutput};
use conemap::monitor::Stage;
use conemap::transfer::{
    CurveFormat, FaultyFile, FileTransfer, MappedFiles, Raster, TransferError, ValueFormat, ValueOptions,
    frame_name,
};
use std::path::{Path, PathBuf};

/// Brings over what is asked for.
pub fn run(arguments: &TransferArguments) -> Result<(), Failure> {
    let what = What::of(arguments)?;
    outputs::check(inputs(arguments), outputs_of(arguments))?;
    let files = SavedFiles::read(&arguments.saved)?;
    let open = files.open()?;
    let mapped = MappedFiles { files: open.meshes(), map: &open.taken().map().correspondence };
    let by = FileTransfer::new(mapped, arguments.from.into());
    let transfer = Transfer { arguments, files: &files, open: &open, by };
    match what {
        What::Values(path, format) => transfer.values(path, format),
        What::Curves(path, format) => transfer.curves(path, format),
        What::Texture(path) => transfer.texture(path),
        What::Shapes => transfer.shapes(),
        What::Morph => transfer.morph(),
        What::Frames => transfer.frames(),
    }
}

/// The content that is asked for, with the format of the output.
enum What<'a> {
    Values(&'a Path, ValueFormat),
    Curves(&'a Path, CurveFormat),
    Texture(&'a Path),
    Shapes,
    Morph,
    Frames,
}

impl<'a> What<'a> {
    /// The wish of a command line, before the work is done: the ending of the file's name says the format that is written.
    fn of(arguments: &'a TransferArguments) -> Result<Self, Failure> {
        let out = &arguments.out;
        Ok(match (&arguments.attributes, &arguments.curves, &arguments.texture) {
            (Some(path), _, _) => Self::Values(path, by_ending(out, &ValueFormat::ALL, |f| f.ending())?),
            (_, Some(path), _) => Self::Curves(path, by_ending(out, &CurveFormat::ALL, |f| f.ending())?),
            (_, _, Some(path)) => {
                by_ending(out, &["png"], |ending| ending)?;
                Self::Texture(path)
            }
            _ if arguments.shape => Self::Shapes,
            _ if arguments.morph => {
                by_ending(out, &["glb"], |ending| ending)?;
                Self::Morph
            }
            _ => Self::Frames,
        })
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
        ShapeOutput::file_names().map(|name| out.join(name)).to_vec()
    } else if arguments.frames.is_empty() {
        vec![out.clone()]
    } else {
        (0..arguments.frames.len()).map(|number| out.join(frame_name(number))).collect()
    }
}

/// The one of some formats that a name ends with.
fn by_ending<F: Copy>(out: &Path, known: &[F], of: impl Fn(F) -> &'static str) -> Result<F, Failure> {
    let ending = out.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    known.iter().copied().find(|format| of(*format).eq_ignore_ascii_case(ending)).ok_or_else(|| {
        let known = known.iter().map(|format| format!(".{}", of(*format))).collect::<Vec<_>>().join(", ");
        format!("{}: the name must end in one of {known}", out.display()).into()
    })
}

/// A saved map, and what is to be brought over by it.
struct Transfer<'a> {
    arguments: &'a TransferArguments,
    files: &'a SavedFiles<'a>,
    open: &'a OpenMap,
    by: FileTransfer<'a>,
}

impl Transfer<'_> {
    /// A sentence that names the file; `given` are those that are brought over.
    fn told(&self, error: &TransferError, given: &[&Path]) -> Failure {
        match error.file() {
            Some(FaultyFile::Given(number)) => match given.get(number) {
                Some(path) => format!("{}: {error}", path.display()).into(),
                None => error.to_string().into(),
            },
            Some(FaultyFile::Mesh(side)) => self.files.told(Some(side), error),
            None => error.to_string().into(),
        }
    }

    fn values(&self, path: &Path, format: ValueFormat) -> Result<(), Failure> {
        let bytes = input::bytes(path)?;
        let options = ValueOptions {
            carrying: self.arguments.method,
            labels: self.arguments.labels.clone(),
            weights: self.arguments.weights.clone(),
            format,
        };
        let mut clock = Clock::start_only(Stage::Transfer);
        let carried = self.by.values(&bytes, &options, &mut clock).map_err(|e| self.told(&e, &[path]))?;
        drop(clock);
        if !carried.left_out.is_empty() {
            say(format_args!("{}: lists are left out: {}", path.display(), carried.left_out.join(", ")));
        }
        outputs::write(&self.arguments.out, &carried.bytes)
    }

    /// The source on its way to the target's shape.
    fn morph(&self) -> Result<(), Failure> {
        let look = self.files.look(self.open);
        let bytes = self.open.taken().wearing(&look).morph_glb(&mut Clock::start_only(Stage::Transfer))?;
        outputs::write(&self.arguments.out, &bytes)
    }

    fn texture(&self, path: &Path) -> Result<(), Failure> {
        let bytes = input::bytes(path)?;
        let MapFiles { source, target, .. } = self.files.bytes();
        let raster = Raster { size: self.arguments.size.into(), border: self.arguments.border.into() };
        let mut clock = Clock::start_only(Stage::Transfer);
        let baked = self.by.texture(&bytes, [source, target], raster, &mut clock);
        outputs::write(&self.arguments.out, &baked.map_err(|e| self.told(&e, &[path]))?)
    }

    fn frames(&self) -> Result<(), Failure> {
        let paths: Vec<&Path> = self.arguments.frames.iter().map(PathBuf::as_path).collect();
        let told = |error: TransferError| self.told(&error, &paths);
        // All frames are looked at before the first is brought over.
        let mut shapes = Vec::new();
        for (number, path) in paths.iter().enumerate() {
            shapes.push(self.by.frame(number, &input::mesh_bytes(path)?).map_err(told)?);
        }
        let mut clock = Clock::start_only(Stage::Transfer);
        let mut motion = self.by.motion(&mut clock)?;
        for (number, shape) in shapes.iter().enumerate() {
            let bytes = motion.moved(number, shape, &mut clock).map_err(told)?;
            outputs::write(&self.arguments.out.join(frame_name(number)), &bytes)?;
        }
        Ok(())
    }

    fn shapes(&self) -> Result<(), Failure> {
        let out = &self.arguments.out;
        let mut shapes = Vec::new();
        for direction in Direction::BOTH {
            let mut clock = Clock::start_only(Stage::Transfer);
            let shape = self.open.shape(direction, &mut clock)?;
            drop(clock);
            say(format_args!("{}", shape.sentence()));
            outputs::write(&out.join(shape.file.name), &shape.file.bytes)?;
            shapes.push(shape);
        }
        let figures = ShapeOutput::figures(&shapes)?;
        outputs::write(&out.join(figures.name), &figures.bytes)
    }

    fn curves(&self, path: &Path, format: CurveFormat) -> Result<(), Failure> {
        let bytes = input::bytes(path)?;
        let mut clock = Clock::start_only(Stage::Transfer);
        let carried = self.by.curves(&bytes, format, &mut clock).map_err(|e| self.told(&e, &[path]))?;
        outputs::write(&self.arguments.out, &carried)
    }
}
