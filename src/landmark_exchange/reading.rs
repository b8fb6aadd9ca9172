//! One landmark file or two, brought onto the meshes and paired.

use super::pairing::{Partners, partners};
use super::problem::ExchangeError;
use super::projection::{SideLandmarks, place};
use super::remark::Remark;
use super::surface::Surface;
use crate::io::landmark_file::{self, LandmarkFile};
use crate::io::landmark_formats::{self, Content, LandmarkFormat, MarkList};
use crate::landmarks::MeshSide;

/// A landmark file as given.
#[derive(Clone, Copy, Debug)]
pub struct GivenFile<'a> {
    /// Its name, which decides where its content allows several formats.
    pub name: &'a str,
    /// Its contents.
    pub bytes: &'a [u8],
}

/// Landmarks of both meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct PairLandmarks {
    /// The pairs with the numbers of the meshes' files.
    pub file: LandmarkFile,
    /// The formats of the files that were read.
    pub formats: Vec<LandmarkFormat>,
    /// The distance of each given point of a pair from the surface, in the units of its mesh.
    pub distances: Vec<[f64; 2]>,
    /// Remarks on the landmarks.
    pub remarks: Vec<Remark>,
}

/// Reads the landmarks of both meshes: from one file that holds both, or from the source's file and the target's. Of the
/// program's own format, which has the meshes' own numbers, nothing is compared with the meshes.
///
/// # Errors
/// [`ExchangeError`] with the number of the file.
pub fn read_pairs(
    files: &[GivenFile<'_>],
    surfaces: [Surface<'_>; 2],
) -> Result<PairLandmarks, ExchangeError> {
    let [source, target] = surfaces;
    match files {
        [file] => match content(file, 0)? {
            (format, Content::Pairs(pairs)) => Ok(PairLandmarks {
                formats: vec![format],
                distances: vec![[0.0; 2]; pairs.pairs.len()],
                remarks: remarks_on(&pairs, file.bytes),
                file: pairs,
            }),
            (format, Content::Sides([a, b])) => {
                let sides =
                    [place(&a, source, MeshSide::Source, 0)?, place(&b, target, MeshSide::Target, 0)?];
                paired(sides, vec![format])
            }
            (_, Content::Side(_)) => Err(ExchangeError::OneMeshOnly),
        },
        [first, second] => {
            let (a, b) = (one_side(first, 0)?, one_side(second, 1)?);
            let sides =
                [place(&a.1, source, MeshSide::Source, 0)?, place(&b.1, target, MeshSide::Target, 1)?];
            paired(sides, vec![a.0, b.0])
        }
        _ => Err(ExchangeError::FileCount { count: files.len() }),
    }
}

/// Reads the landmarks of one mesh from a file that holds no more.
///
/// # Errors
/// [`ExchangeError`].
pub fn read_side(
    file: GivenFile<'_>,
    surface: Surface<'_>,
    side: MeshSide,
) -> Result<SideLandmarks, ExchangeError> {
    let (_, list) = one_side(&file, 0)?;
    place(&list, surface, side, 0)
}

fn content(file: &GivenFile<'_>, number: usize) -> Result<(LandmarkFormat, Content), ExchangeError> {
    landmark_formats::read(file.name, file.bytes).map_err(|error| ExchangeError::Read { file: number, error })
}

fn one_side(file: &GivenFile<'_>, number: usize) -> Result<(LandmarkFormat, MarkList), ExchangeError> {
    match content(file, number)? {
        (format, Content::Side(list)) => Ok((format, list)),
        _ => Err(ExchangeError::BothMeshes { file: number }),
    }
}

/// Remarks on a file of pairs in the meshes' own numbers, which need no mesh.
pub fn remarks_on(file: &LandmarkFile, bytes: &[u8]) -> Vec<Remark> {
    let pairs = file.pairs.len();
    let labels = file.labels.as_ref().map_or(pairs, Vec::len);
    let miscounted = (labels != pairs).then_some(Remark::LabelCount { labels, pairs });
    let names = landmark_file::unknown_entries(bytes);
    let unknown = (!names.is_empty()).then_some(Remark::UnknownEntries { names });
    miscounted.into_iter().chain(unknown).collect()
}

/// Pairs the landmarks; those without a point on one side are left out.
fn paired(sides: [SideLandmarks; 2], formats: Vec<LandmarkFormat>) -> Result<PairLandmarks, ExchangeError> {
    let [mut source, target] = sides;
    let Partners { numbers, labels_differ } = partners(&source.marks, &target.marks)?;
    let (mut pairs, mut labels, mut distances) = (Vec::new(), Vec::new(), Vec::new());
    for [a, b] in numbers {
        let marks = [&source.marks[a], &target.marks[b]];
        if let [Some(p), Some(q)] = marks.map(|mark| mark.point) {
            pairs.push([p, q]);
            distances.push(marks.map(|mark| mark.distance));
            let label = marks.into_iter().map(|mark| &mark.label).find(|label| !label.is_empty());
            labels.push(label.cloned().unwrap_or_default());
        }
    }
    let has_labels = labels.iter().any(|label| !label.is_empty());
    let file = LandmarkFile { pairs, labels: has_labels.then_some(labels), ..LandmarkFile::default() };
    landmark_file::check(&file)?;
    let mut remarks = std::mem::take(&mut source.remarks);
    remarks.extend(target.remarks);
    remarks.extend(labels_differ.then_some(Remark::PairedByOrder));
    Ok(PairLandmarks { file, formats, distances, remarks })
}
