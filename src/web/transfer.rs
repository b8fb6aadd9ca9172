//! Values, curves, textures, motions and shapes brought from one mesh to the other by a map file, in a worker of its own.

use super::compute::{Messenger, RunListener};
use super::failure;
use crate::export::vertex_image::Direction;
use crate::job::{MapFiles, OpenMap, ShapeOutput};
use crate::landmarks::MeshSide;
use crate::monitor::{Monitor, PlannedStage, Portion, Stage};
use crate::transfer::{
    Carrying, CurveFormat, FaultyFile, FileTransfer, GivenFile, GivenKind, MappedFiles, Raster,
    TransferError, ValueFormat, ValueOptions, frame_name, given_file,
};
use serde::{Deserialize, Serialize};
use serde_json::json;
use wasm_bindgen::prelude::*;

/// The possible contents of a file that is to be brought across.
#[derive(Serialize, tsify::Tsify)]
pub struct GivenFileReport {
    /// The kinds of content that the file may have, the likeliest first; at least one.
    kinds: Vec<GivenKind>,
    /// The names of the columns of values that it has.
    columns: Vec<String>,
}

/// The content that is to be brought across, and the method.
#[derive(Deserialize, tsify::Tsify)]
#[serde(deny_unknown_fields)]
pub struct TransferWish {
    /// The mesh that gives.
    from: MeshSide,
    what: TransferWhat,
}

/// Likewise, by what it is.
#[derive(Deserialize, tsify::Tsify)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum TransferWhat {
    /// Values of vertices.
    Values {
        /// The method to compute a value at a vertex from those of the other mesh.
        method: Carrying,
        /// Names of columns that are labels.
        labels: Vec<String>,
        /// Names of columns that are weights.
        weights: Vec<String>,
        /// The format in which the values are written.
        format: ValueFormat,
    },
    /// Curves.
    Curves {
        /// The format in which the curves are written.
        format: CurveFormat,
    },
    /// The giving mesh's texture.
    Texture {
        /// Texels in a row and in a column.
        size: u16,
    },
    /// Frames of the giving mesh.
    Frames,
    /// Each mesh in the shape of the other; no file is given.
    Shapes,
}

/// About the share of the time that goes by before the first frame is brought over.
const BEFORE_FRAMES: f64 = 0.2;

/// Tells what a file may hold: a [`GivenFileReport`] as JSON.
///
/// # Errors
/// `{"code": "transfer", "message"}` where nothing of it can be brought across.
#[wasm_bindgen(js_name = givenFile)]
pub fn given_file_report(bytes: &[u8]) -> Result<String, JsValue> {
    let GivenFile { kinds, columns } = given_file(bytes).map_err(|e| failure("transfer", e))?;
    let report = GivenFileReport { kinds, columns: columns.into_iter().map(|column| column.name).collect() };
    serde_json::to_string(&report).map_err(|e| failure("transfer", e))
}

/// The files that were brought across.
#[wasm_bindgen]
#[derive(Default)]
pub struct BroughtFiles {
    files: Vec<(String, Vec<u8>)>,
    remark: Option<String>,
}

#[wasm_bindgen]
impl BroughtFiles {
    /// The number of files.
    pub fn count(&self) -> usize {
        self.files.len()
    }

    /// The usual name of a file.
    pub fn name(&self, number: usize) -> String {
        self.files.get(number).map(|(name, _)| name.clone()).unwrap_or_default()
    }

    /// The contents of a file, which are given once.
    pub fn take(&mut self, number: usize) -> Vec<u8> {
        self.files.get_mut(number).map(|(_, bytes)| std::mem::take(bytes)).unwrap_or_default()
    }

    /// A remark on the files; `undefined` for none.
    pub fn remark(&self) -> Option<String> {
        self.remark.clone()
    }

    fn one(name: &str, bytes: Vec<u8>) -> Self {
        Self { files: vec![(name.to_owned(), bytes)], remark: None }
    }
}

/// Brings files of one mesh to the other by a map file that was made with both. `wish` is a [`TransferWish`] as JSON.
///
/// # Errors
/// `{"code", "message", "file"}`: the number of the given file at fault, `"source"` or `"target"` for a mesh's, else `null`.
#[wasm_bindgen(js_name = bringAcross)]
pub fn bring_across(
    map: &[u8],
    source: &[u8],
    target: &[u8],
    given: Vec<js_sys::Uint8Array>,
    wish: &str,
    listener: &RunListener,
) -> Result<BroughtFiles, JsValue> {
    let wish: TransferWish = serde_json::from_str(wish).map_err(|e| failure("transfer", e))?;
    if let TransferWhat::Texture { size } = wish.what
        && !(1..=Raster::LARGEST_SIZE).contains(&size)
    {
        let sentence = format!("{size} texels in a row: a texture has 1 to {}", Raster::LARGEST_SIZE);
        return Err(failure("transfer", sentence));
    }
    let mut messenger = Messenger::new(listener);
    messenger.plan(vec![PlannedStage { stage: Stage::Transfer, time: 1.0 }]);
    messenger.enter(Stage::Transfer);
    let files = MapFiles { map, source, target };
    let open = OpenMap::read(files).map_err(|e| faulty(e.code(), &e, json!(e.side())))?;
    let mapped = MappedFiles { files: open.meshes(), map: &open.taken().map().correspondence };
    let desk = Desk { open: &open, by: FileTransfer::new(mapped, wish.from.into()), files, given };
    desk.brought(&wish.what, &mut messenger).map_err(|error| {
        let file = match error.file() {
            Some(FaultyFile::Given(number)) => json!(number),
            Some(FaultyFile::Mesh(side)) => json!(side),
            None => json!(null),
        };
        faulty("transfer", &error, file)
    })
}

/// An error as the page takes it, with the file at fault.
fn faulty(code: &str, error: &dyn std::fmt::Display, file: serde_json::Value) -> JsValue {
    let value = json!({ "code": code, "message": error.to_string(), "file": file });
    JsValue::from_str(&value.to_string())
}

/// A map that is open, and the files that are to be brought over.
struct Desk<'a> {
    open: &'a OpenMap,
    by: FileTransfer<'a>,
    files: MapFiles<'a>,
    given: Vec<js_sys::Uint8Array>,
}

impl Desk<'_> {
    fn brought(&self, what: &TransferWhat, monitor: &mut dyn Monitor) -> Result<BroughtFiles, TransferError> {
        // Where no file is given none has anything to bring, and the readers say so.
        let first = || self.given.first().map(js_sys::Uint8Array::to_vec).unwrap_or_default();
        match what {
            TransferWhat::Values { method, labels, weights, format } => {
                let options = ValueOptions {
                    carrying: *method,
                    labels: labels.clone(),
                    weights: weights.clone(),
                    format: *format,
                };
                let carried = self.by.values(&first(), &options, monitor)?;
                let left_out = carried.left_out;
                let remark =
                    (!left_out.is_empty()).then(|| format!("lists are left out: {}", left_out.join(", ")));
                let name = format!("values.{}", format.ending());
                Ok(BroughtFiles { files: vec![(name, carried.bytes)], remark })
            }
            TransferWhat::Curves { format } => {
                let name = format!("curves.{}", format.ending());
                Ok(BroughtFiles::one(&name, self.by.curves(&first(), *format, monitor)?))
            }
            TransferWhat::Texture { size } => {
                let meshes = [self.files.source, self.files.target];
                let raster = Raster { size: (*size).into(), border: Raster::USUAL_BORDER.into() };
                Ok(BroughtFiles::one("texture.png", self.by.texture(&first(), meshes, raster, monitor)?))
            }
            TransferWhat::Frames => self.frames(monitor),
            TransferWhat::Shapes => self.shapes(monitor),
        }
    }

    fn frames(&self, monitor: &mut dyn Monitor) -> Result<BroughtFiles, TransferError> {
        // All frames are looked at before the first is brought over, one at a time in memory.
        let shapes =
            self.given.iter().enumerate().map(|(number, file)| self.by.frame(number, &file.to_vec()));
        let shapes = shapes.collect::<Result<Vec<_>, _>>()?;
        let mut motion = self.by.motion(&mut Portion::new(monitor, 0.0, BEFORE_FRAMES))?;
        let share = |number: usize| {
            BEFORE_FRAMES + (1.0 - BEFORE_FRAMES) * number as f64 / shapes.len().max(1) as f64
        };
        let mut files = Vec::new();
        for (number, shape) in shapes.iter().enumerate() {
            let part = &mut Portion::new(monitor, share(number), share(number + 1));
            files.push((frame_name(number), motion.moved(number, shape, part)?));
        }
        Ok(BroughtFiles { files, remark: None })
    }

    fn shapes(&self, monitor: &mut dyn Monitor) -> Result<BroughtFiles, TransferError> {
        let mut shapes = Vec::new();
        for (direction, [from, to]) in Direction::BOTH.into_iter().zip([[0.0, 0.5], [0.5, 1.0]]) {
            shapes.push(self.open.shape(direction, &mut Portion::new(monitor, from, to))?);
        }
        let sentences: Vec<String> = shapes.iter().map(ShapeOutput::sentence).collect();
        let figures = ShapeOutput::figures(&shapes)?;
        let files = shapes.into_iter().map(|shape| shape.file).chain([figures]);
        let files = files.map(|file| (file.name.to_owned(), file.bytes)).collect();
        Ok(BroughtFiles { files, remark: Some(sentences.join(". ")) })
    }
}
