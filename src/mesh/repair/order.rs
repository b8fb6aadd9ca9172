//! The order of the steps, and the way back to the numbers of the file.

use super::caps::{Capped, capped};
use super::degenerate::{Additions, Degenerate, without_degenerate};
use super::draft::{Draft, DraftFace, FaceOrigin};
use super::duplicates::without_duplicates;
use super::handles::{MOST_HANDLES, WithoutHandles, without_handles};
use super::joining::joined;
use super::options::{Handles, Parts, RepairOptions};
use super::orientation::oriented;
use super::parts::{DroppedParts, largest};
use super::refusal::RepairRefusal;
use super::report::{Change, Handle, RepairReport};
use super::sheets::{Sheets, apart};
use crate::mesh::check::{
    CheckedMesh, Elements, MeshFault, RepairedFaces, closed_genus_zero, closed_genus_zero_asking,
    triangulated,
};
use crate::mesh::soup::PolygonSoup;
use crate::mesh::{FaceId, FileFrame, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use typed_index_collections::TiVec;

/// A mesh that can be mapped, and how it came to be.
#[derive(Clone, Debug)]
pub struct RepairedMesh {
    /// The mesh.
    pub checked: CheckedMesh,
    /// The report on what was changed.
    pub report: RepairReport,
}

/// The largest share of the surface that caps may be: with more it would be an open sheet whose other side is made up. Chosen by
/// hand.
const MOST_CAP: f64 = 0.45;

/// Repairs a soup as far as it is not a closed surface of genus 0 already.
///
/// # Errors
/// [`RepairRefusal`].
pub fn repaired(
    soup: &PolygonSoup,
    options: &RepairOptions,
    monitor: &mut dyn Monitor,
) -> Result<RepairedMesh, RepairRefusal> {
    let mut ask = || Ok(monitor.step(Step::default())?);
    match closed_genus_zero_asking::<NotClosed>(soup, &mut ask) {
        Ok(checked) => {
            let report = RepairReport { changes: told_of_all(soup, &checked), ..RepairReport::default() };
            Ok(RepairedMesh { checked, report })
        }
        Err(NotClosed::Stopped(stop)) => Err(stop.into()),
        Err(NotClosed::Fault(
            fault @ (MeshFault::Empty | MeshFault::TooFewFaces { .. } | MeshFault::TooManyFaces { .. }),
        )) => Err(fault.into()),
        Err(NotClosed::Fault(fault)) => {
            let frame = FileFrame::of(soup);
            let mut repaired =
                steps(soup, &frame, options, fault, monitor).map_err(|refusal| match refusal {
                    RepairRefusal::Handles(mut handles) => {
                        to_file(&mut handles, &frame);
                        RepairRefusal::Handles(handles)
                    }
                    other => other,
                })?;
            for change in &mut repaired.report.changes {
                if let Change::CutHandles { handles, .. } = change {
                    to_file(&mut handles.first, &frame);
                }
            }
            Ok(repaired)
        }
    }
}

/// Why a soup was not taken as it is.
enum NotClosed {
    Fault(MeshFault),
    Stopped(Cancelled),
}

impl From<MeshFault> for NotClosed {
    fn from(fault: MeshFault) -> Self {
        Self::Fault(fault)
    }
}

impl From<Cancelled> for NotClosed {
    fn from(stop: Cancelled) -> Self {
        Self::Stopped(stop)
    }
}

/// Tells the places of handles in the file's coordinates.
fn to_file(handles: &mut [Handle], frame: &FileFrame) {
    handles.iter_mut().flat_map(|handle| &mut handle.places).for_each(|place| *place = frame.in_file(*place));
}

/// The steps, on the file's surface in usual coordinates: those of `frame`.
fn steps(
    soup: &PolygonSoup,
    frame: &FileFrame,
    options: &RepairOptions,
    fault: MeshFault,
    monitor: &mut dyn Monitor,
) -> Result<RepairedMesh, RepairRefusal> {
    let draft = drafted(&frame.soup(soup))?;
    let in_file = draft.faces.len();
    monitor.step(Step::default())?;
    let draft = joined(draft, options.join_within / frame.scale());
    let (draft, degenerate) = without_degenerate(draft, Additions::Nothing);
    monitor.step(Step::default())?;
    let (draft, doubled) = without_duplicates(draft);
    if draft.faces.is_empty() {
        let within = options.join_within;
        return Err(if within > 0.0 {
            RepairRefusal::JoinedAway { within }
        } else {
            RepairRefusal::NothingLeft
        });
    }
    let Closed { draft, sheets, dropped, caps, degenerate: closed, mut cap_share } =
        closed(draft, options.parts, monitor)?;
    let mut degenerate = degenerate.and(closed);
    let mut handles = None;
    let checked = match checked(soup, frame, &draft, in_file) {
        Err(MeshFault::Genus { genus }) => {
            let cut = cut_handles(draft, genus, options.handles, monitor)?;
            let (draft, closed) = without_degenerate(cut.draft, Additions::Vertices);
            degenerate = degenerate.and(closed);
            cap_share = cut.cap_share;
            handles = Some(Change::CutHandles {
                handles: cut.handles.into_iter().collect(),
                faces: cut.faces,
                area_share: cut.area_share,
            });
            checked(soup, frame, &draft, in_file)?
        }
        other => other.map_err(|left| cause(&fault, left))?,
    };
    let Sheets { edges, split, joined } = sheets;
    let mut changes = vec![
        Change::JoinedVertices(joined),
        Change::DegenerateFaces { dropped: degenerate.dropped, recut: degenerate.recut },
        Change::DuplicateFaces(doubled),
        Change::SplitEdges(edges),
        Change::SplitVertices(split),
    ];
    changes.extend(dropped.map(|DroppedParts { parts, faces, area_share }| Change::DroppedParts {
        parts,
        faces,
        area_share,
    }));
    changes.extend(caps.map(|Capped { holes, faces, area_share }| Change::CappedHoles {
        holes: holes.into_iter().collect(),
        faces,
        area_share,
    }));
    changes.extend(handles);
    changes.extend(told_of_all(soup, &checked));
    changes.retain(|change| change.count() > 0);
    Ok(RepairedMesh { checked, report: RepairReport { fault: Some(fault), changes, cap_share } })
}

/// The fault that the refusal names where one is left: all holes were capped, so an open edge comes from faces without area that were
/// dropped.
fn cause(given: &MeshFault, left: MeshFault) -> MeshFault {
    match (given, left) {
        (MeshFault::DegenerateFaces(_), MeshFault::OpenEdges(_)) => given.clone(),
        (_, left) => left,
    }
}

/// A surface without holes, whose handles are not looked for yet.
struct Closed {
    draft: Draft,
    sheets: Sheets,
    dropped: Option<DroppedParts>,
    caps: Option<Capped>,
    /// The faces without area among the caps.
    degenerate: Degenerate,
    /// The share of the area that is caps.
    cap_share: f64,
}

/// Turns, takes apart and closes a draft that has neither faces without area nor double ones.
fn closed(draft: Draft, parts: Parts, monitor: &mut dyn Monitor) -> Result<Closed, RepairRefusal> {
    monitor.step(Step::default())?;
    let (draft, sheets) = apart(oriented(draft)?);
    monitor.step(Step::default())?;
    let (draft, dropped) = largest(oriented(draft)?, parts)?;
    monitor.step(Step::default())?;
    let (draft, caps) = capped(draft, monitor)?;
    monitor.step(Step::default())?;
    // A corner on an edge without a face between leaves a hole without area, whose cap goes as such faces do.
    let (draft, degenerate) = without_degenerate(draft, Additions::Vertices);
    let cap_share = caps.as_ref().map_or(0.0, |caps| caps.area_share);
    if cap_share > MOST_CAP {
        return Err(RepairRefusal::OpenSheet { cap_share });
    }
    Ok(Closed { draft, sheets, dropped, caps, degenerate, cap_share })
}

/// The handles of the largest part of such a draft, made of a soup with so many triangles; none where it cannot be closed.
pub(super) fn handles_of(
    draft: Draft,
    soup: &PolygonSoup,
    in_file: usize,
    monitor: &mut dyn Monitor,
) -> Result<Vec<Handle>, Cancelled> {
    if draft.faces.is_empty() {
        return Ok(Vec::new());
    }
    let refusal = || -> Result<(), RepairRefusal> {
        let Closed { draft, .. } = closed(draft, Parts::LargestAlone, monitor)?;
        match checked(soup, &FileFrame::default(), &draft, in_file) {
            Err(MeshFault::Genus { genus }) => cut_handles(draft, genus, Handles::Refused, monitor).map(drop),
            _ => Ok(()),
        }
    };
    match refusal() {
        Err(RepairRefusal::Handles(handles)) => Ok(handles),
        Err(RepairRefusal::Stopped(stop)) => Err(stop),
        _ => Ok(Vec::new()),
    }
}

/// The draft without its handles, where they may be cut.
fn cut_handles(
    draft: Draft,
    genus: usize,
    allowed: Handles,
    monitor: &mut dyn Monitor,
) -> Result<WithoutHandles, RepairRefusal> {
    if genus > MOST_HANDLES {
        return Err(RepairRefusal::TooManyHandles { genus, most: MOST_HANDLES });
    }
    // The handles are cut even where they are refused, since the refusal lists them with their loops.
    let cut = without_handles(draft, genus, monitor)?;
    match allowed {
        Handles::Cut => Ok(cut),
        Handles::Refused => Err(RepairRefusal::Handles(cut.handles)),
    }
}

/// The changes that the check itself makes on every mesh.
fn told_of_all(soup: &PolygonSoup, checked: &CheckedMesh) -> Vec<Change> {
    let mut is_used = vec![false; soup.positions.len()];
    soup.polygons.iter().flatten().for_each(|v| is_used[*v as usize] = true);
    let stands_for = |v: usize| soup.joined_with.get(v).map_or(v, |first| *first as usize);
    let unused = (0..is_used.len()).filter(|&v| !is_used[stands_for(v)]).collect();
    let turned = checked.turned.iter_enumerated().filter(|(_, turned)| **turned);
    let turned = turned.map(|(f, _)| checked.file_from_face(f).index()).collect();
    let mut changes = vec![Change::TurnedFaces(turned), Change::UnusedVertices(unused)];
    changes.retain(|change| change.count() > 0);
    changes
}

pub(super) fn drafted(soup: &PolygonSoup) -> Result<Draft, MeshFault> {
    let (triangles, _) = triangulated(soup)?;
    let face = |(&corners, number): (&[u32; 3], u32)| DraftFace {
        corners,
        file_corners: corners,
        origin: FaceOrigin::File { number, turned: false },
    };
    Ok(Draft {
        positions: soup.positions.clone(),
        numbers: (0..soup.positions.len() as u32).map(Some).collect(),
        faces: triangles.iter().zip(0..).map(face).collect(),
    })
}

/// The draft judged as every mesh, with the numbers of the file. What is left of a file may be much smaller than the file, and far from
/// its middle: so it is judged where it lies in the file, and has a frame of its own.
fn checked(
    soup: &PolygonSoup,
    frame: &FileFrame,
    draft: &Draft,
    in_file: usize,
) -> Result<CheckedMesh, MeshFault> {
    let whole = PolygonSoup {
        positions: draft.positions.iter().map(|p| frame.in_file(*p)).collect(),
        polygons: draft.faces.iter().map(|face| face.corners.to_vec()).collect(),
        joined_with: Vec::new(),
    };
    let judged = closed_genus_zero(&whole).map_err(|fault| in_file_numbers(fault, draft))?;
    let faces = || draft.faces.iter().zip(judged.turned.iter());
    let turned = faces().map(|(face, &again)| match face.origin {
        FaceOrigin::File { turned, .. } => turned != again,
        FaceOrigin::Recut | FaceOrigin::Cap => false,
    });
    let mut next = in_file as u32;
    let number = |face: &DraftFace| {
        let made = next;
        next += u32::from(face.number().is_none());
        face.number().map_or(made, |number| number as u32)
    };
    let number: TiVec<FaceId, u32> = draft.faces.iter().map(number).collect();
    let is_cap = draft.faces.iter().map(|face| face.origin == FaceOrigin::Cap).collect();
    let is_the_files = number.len() == in_file && next as usize == in_file;
    Ok(CheckedMesh {
        frame: judged.frame,
        vertex_from_file: vertex_from_file(soup, draft, &judged),
        turned: turned.collect(),
        repaired_faces: (!is_the_files).then_some(RepairedFaces { in_file, number, is_cap }),
        mesh: judged.mesh,
    })
}

fn vertex_from_file(soup: &PolygonSoup, draft: &Draft, judged: &CheckedMesh) -> Vec<Option<VertexId>> {
    let mut vertices = vec![None; soup.positions.len()];
    for face in draft.faces.iter().filter(|face| face.origin != FaceOrigin::Cap) {
        for (&v, &from) in face.corners.iter().zip(&face.file_corners) {
            // Among the copies of a vertex the one that kept its number counts.
            if let Some(known) = vertices.get_mut(from as usize)
                && (known.is_none() || v == from)
            {
                *known = judged.vertex_from_file[v as usize];
            }
        }
    }
    for (v, first) in soup.joined_with.iter().enumerate().take(vertices.len()) {
        vertices[v] = vertices.get(*first as usize).copied().flatten();
    }
    vertices
}

/// A fault of the repaired surface with the numbers of the file where there are any.
fn in_file_numbers(fault: MeshFault, draft: &Draft) -> MeshFault {
    let vertex = |v: &usize| draft.number(*v as u32);
    let edges = |e: Elements<[usize; 2]>| Elements {
        first: e.first.iter().map(|edge| edge.each_ref().map(vertex)).collect(),
        ..e
    };
    match fault {
        MeshFault::NonManifoldEdges { edges: e, parts } => {
            MeshFault::NonManifoldEdges { edges: edges(e), parts }
        }
        MeshFault::OpenEdges(e) => MeshFault::OpenEdges(edges(e)),
        MeshFault::PinchedVertices(e) => {
            MeshFault::PinchedVertices(Elements { first: e.first.iter().map(vertex).collect(), ..e })
        }
        MeshFault::DegenerateFaces(e) => {
            let face = |f: &usize| draft.faces[*f].number().unwrap_or(*f);
            MeshFault::DegenerateFaces(Elements { first: e.first.iter().map(face).collect(), ..e })
        }
        MeshFault::NotOrientable { edge } => MeshFault::NotOrientable { edge: edge.each_ref().map(vertex) },
        other => other,
    }
}
