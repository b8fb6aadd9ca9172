//! Defects are found.

use super::super::degenerate::{Additions, without_degenerate};
use super::super::draft::{Draft, DraftFace, Edge, NONE, across, edges, parts};
use super::super::duplicates::without_duplicates;
use super::super::joining::joined;
use super::super::options::RepairOptions;
use super::super::order::{drafted, handles_of};
use super::super::orientation::{Turns, oriented, turns};
use super::super::parts::areas;
use super::super::refusal::RepairRefusal;
use super::super::report::Handle;
use super::super::sheets::apart;
use super::chains::chains;
use super::defect::{Defect, DefectKind, Defects};
use crate::math::disjoint_sets::DisjointSets;
use crate::mesh::FileFrame;
use crate::mesh::check::is_degenerate;
use crate::mesh::soup::PolygonSoup;
use crate::monitor::Monitor;
use glam::DVec3;
use rustc_hash::FxHashSet;

/// Every place where a soup fails to be one closed, oriented surface of genus 0.
///
/// # Errors
/// [`RepairRefusal::Fault`] where there is nothing to look at, [`RepairRefusal::Stopped`].
pub fn defects(
    soup: &PolygonSoup,
    options: &RepairOptions,
    monitor: &mut dyn Monitor,
) -> Result<Defects, RepairRefusal> {
    let frame = FileFrame::of(soup);
    let soup = &*frame.soup(soup);
    let draft = joined(drafted(soup)?, options.join_within / frame.scale());
    let mut found = Defects {
        frame,
        positions: soup.positions.clone(),
        triangles: draft.faces.iter().map(|face| face.corners).collect(),
        file_vertices: soup.positions.len(),
        groups: Vec::new(),
    };
    let flat = without_area(&draft);
    let (draft, _) = without_degenerate(draft, Additions::Nothing);
    let before = draft.clone();
    let (draft, _) = without_duplicates(draft);
    let double = gone(&before, &draft);
    let edges = edges(&draft.faces);
    let turns = turns(&draft);
    for (face, _) in draft.faces.iter().zip(&turns.turned).filter(|(_, turned)| **turned) {
        if let Some(number) = face.number() {
            found.triangles[number].swap(1, 2);
        }
    }
    look_outwards(&mut found, &draft, &edges);
    found.add(DefectKind::OpenRim, lines(&edges, |edge| edge.halfedges.len() == 1));
    found.add(DefectKind::CrowdedEdges, lines(&edges, |edge| edge.halfedges.len() > 2));
    let torn: FxHashSet<[u32; 2]> = turns.seams.iter().map(|&h| ends_of(&draft.faces, h)).collect();
    found.add(DefectKind::OneSidedSeam, lines(&edges, |edge| torn.contains(&edge.ends)));
    found.add(DefectKind::TurnedPatch, patches(&draft, &edges, &turns));
    let pinched = pinched_vertices(&draft, &edges);
    let handles = if torn.is_empty() {
        handles_of(draft.clone(), soup, found.triangles.len(), monitor)?
    } else {
        Vec::new()
    };
    found.add(DefectKind::LoosePart, loose_parts(draft));
    let loops = handles.iter().map(|handle| loop_of(&mut found, handle)).collect();
    found.add(DefectKind::HandleLoop, loops);
    found.add(DefectKind::PinchedVertex, pinched);
    found.add(DefectKind::FaceWithoutArea, flat);
    found.add(DefectKind::DoubleFace, double);
    Ok(found)
}

/// Turns the triangles of whole parts that look inwards, by their volume about the middle of each; open ones have one nearly.
fn look_outwards(found: &mut Defects, draft: &Draft, edges: &[Edge]) {
    let part = parts(draft.faces.len(), &across(&draft.faces, edges));
    let count = part.iter().max().map_or(0, |last| last + 1);
    let numbers = || draft.faces.iter().zip(&part).filter_map(|(face, &p)| Some((face.number()?, p)));
    let corners = |found: &Defects, f: usize| found.triangles[f].map(|v| found.positions[v as usize]);
    let mut middle = vec![(DVec3::ZERO, 0.0); count];
    for (f, p) in numbers() {
        middle[p].0 += corners(found, f).into_iter().sum::<DVec3>();
        middle[p].1 += 3.0;
    }
    let mut volume = vec![0.0; count];
    for (f, p) in numbers() {
        let (sum, corners_of_part) = middle[p];
        let [a, b, c] = corners(found, f).map(|corner| corner - sum / corners_of_part);
        volume[p] += a.dot(b.cross(c));
    }
    for (f, p) in numbers() {
        if volume[p] < 0.0 {
            found.triangles[f].swap(1, 2);
        }
    }
}

/// Some edges as lines, each a defect.
fn lines(edges: &[Edge], is_one: impl Fn(&Edge) -> bool) -> Vec<Defect> {
    let edges: Vec<[u32; 2]> = edges.iter().filter(|edge| is_one(edge)).map(|edge| edge.ends).collect();
    chains(&edges).into_iter().map(|line| Defect { lines: vec![line], faces: Vec::new() }).collect()
}

fn ends_of(faces: &[DraftFace], h: usize) -> [u32; 2] {
    let [a, b] = faces[h / 3].edge(h % 3);
    [a.min(b), a.max(b)]
}

/// Faces without area, each with a place where it can be seen.
fn without_area(draft: &Draft) -> Vec<Defect> {
    let flat = draft.faces.iter().filter(|face| is_degenerate(&draft.positions, &face.corners));
    let defect = |face: &DraftFace| Defect { lines: vec![vec![face.corners[0]]], faces: number_of(face) };
    flat.map(defect).collect()
}

/// Faces that one draft has and the next has no more.
fn gone(before: &Draft, after: &Draft) -> Vec<Defect> {
    let kept: FxHashSet<usize> = after.faces.iter().filter_map(DraftFace::number).collect();
    let gone = before.faces.iter().filter(|face| face.number().is_some_and(|number| !kept.contains(&number)));
    gone.map(|face| Defect { lines: Vec::new(), faces: number_of(face) }).collect()
}

fn number_of(face: &DraftFace) -> Vec<u32> {
    face.number().map(|number| number as u32).into_iter().collect()
}

/// Faces that look the other way, those beside each other together, within their border.
fn patches(draft: &Draft, edges: &[Edge], turns: &Turns) -> Vec<Defect> {
    let mut across = across(&draft.faces, edges);
    let differs = |h: usize, other: u32| turns.turned[h / 3] != turns.turned[other as usize / 3];
    let border: Vec<bool> =
        across.iter().enumerate().map(|(h, &other)| other != NONE && differs(h, other)).collect();
    across.iter_mut().zip(&border).filter(|(_, is_border)| **is_border).for_each(|(other, _)| *other = NONE);
    let part = parts(draft.faces.len(), &across);
    let mut place = vec![usize::MAX; draft.faces.len()];
    let mut found: Vec<(Vec<u32>, Vec<[u32; 2]>)> = Vec::new();
    for (f, face) in draft.faces.iter().enumerate().filter(|(f, _)| turns.turned[*f]) {
        if place[part[f]] == usize::MAX {
            place[part[f]] = found.len();
            found.push(Default::default());
        }
        let (faces, halfedges) = &mut found[place[part[f]]];
        faces.extend(number_of(face));
        halfedges.extend((3 * f..3 * f + 3).filter(|&h| border[h]).map(|h| ends_of(&draft.faces, h)));
    }
    found.sort_by_key(|(faces, _)| std::cmp::Reverse(faces.len()));
    found.into_iter().map(|(faces, halfedges)| Defect { lines: chains(&halfedges), faces }).collect()
}

/// Vertices with several fans of faces, but for those on crowded edges.
fn pinched_vertices(draft: &Draft, edges: &[Edge]) -> Vec<Defect> {
    let mut fans = DisjointSets::new(3 * draft.faces.len());
    let corner = |h: u32, v: u32| {
        let f = h as usize / 3;
        3 * f + draft.faces[f].corners.iter().position(|&w| w == v).unwrap_or(0)
    };
    let mut is_crowded = vec![false; draft.positions.len()];
    for Edge { ends, halfedges } in edges {
        if let [a, b] = halfedges[..] {
            ends.iter().for_each(|&v| {
                fans.join(corner(a, v), corner(b, v));
            });
        } else if halfedges.len() > 2 {
            ends.iter().for_each(|&v| is_crowded[v as usize] = true);
        }
    }
    let mut count = vec![0_u32; draft.positions.len()];
    for c in (0..3 * draft.faces.len()).filter(|&c| fans.root(c) == c) {
        count[draft.faces[c / 3].corners[c % 3] as usize] += 1;
    }
    let pinched = (0..count.len()).filter(|&v| count[v] > 1 && !is_crowded[v]);
    pinched.map(|v| Defect { lines: vec![vec![v as u32]], faces: Vec::new() }).collect()
}

/// All parts but the largest, as the repair would find them, the largest of these first.
fn loose_parts(draft: Draft) -> Vec<Defect> {
    let sheets = oriented(draft.clone()).map(apart).map_or(draft, |(sheets, _)| sheets);
    let part = parts(sheets.faces.len(), &across(&sheets.faces, &edges(&sheets.faces)));
    let areas = areas(&sheets, &part);
    let mut faces: Vec<Vec<u32>> = vec![Vec::new(); areas.len()];
    for (face, &p) in sheets.faces.iter().zip(&part) {
        faces[p].extend(number_of(face));
    }
    let mut order: Vec<usize> = (0..areas.len()).collect();
    // Stable: of equal ones the first.
    order.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]));
    let loose = order.into_iter().skip(1);
    loose.map(|p| Defect { lines: Vec::new(), faces: std::mem::take(&mut faces[p]) }).collect()
}

/// The loop of a handle; where it passes over a cap, its vertices become positions.
fn loop_of(found: &mut Defects, handle: &Handle) -> Defect {
    let mut line = Vec::with_capacity(handle.vertices.len() + 1);
    for (&number, &place) in handle.vertices.iter().zip(&handle.places) {
        if number < found.file_vertices {
            line.push(number as u32);
        } else {
            line.push(found.positions.len() as u32);
            found.positions.push(place);
        }
    }
    line.extend(line.first().copied());
    Defect { lines: vec![line], faces: Vec::new() }
}
