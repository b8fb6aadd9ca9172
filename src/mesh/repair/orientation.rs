//! Faces are turned until neighbours agree.

use super::draft::{Draft, DraftFace, NONE, across, edges};
use super::refusal::RepairRefusal;
use crate::mesh::check::MeshFault;

/// Which faces have to be turned so that neighbours agree.
pub(super) struct Turns {
    /// Whether each face is to be turned: in each part faces stay as most of them lie, and in one-sided parts none is turned.
    pub turned: Vec<bool>,
    /// Halfedges across which one-sided parts cannot agree.
    pub seams: Vec<usize>,
}

/// Which faces have to be turned so that neighbours across edges with two faces agree.
pub(super) fn turns(draft: &Draft) -> Turns {
    let across = across(&draft.faces, &edges(&draft.faces));
    let mut turned: Vec<Option<bool>> = vec![None; draft.faces.len()];
    let mut seams = Vec::new();
    for root in 0..draft.faces.len() {
        if turned[root].is_some() {
            continue;
        }
        turned[root] = Some(false);
        let mut part = vec![root];
        let known = seams.len();
        let mut next = 0;
        while let Some(&f) = part.get(next) {
            next += 1;
            for h in 3 * f..3 * f + 3 {
                let other = across[h];
                if other == NONE {
                    continue;
                }
                let other = other as usize;
                let wanted = turned[f].map(|x| x != runs_alike(&draft.faces, h, other));
                match turned[other / 3] {
                    None => {
                        turned[other / 3] = wanted;
                        part.push(other / 3);
                    }
                    found if found != wanted => seams.push(h),
                    _ => {}
                }
            }
        }
        let count = part.iter().filter(|&&f| turned[f] == Some(true)).count();
        if seams.len() > known {
            part.iter().for_each(|&f| turned[f] = Some(false));
        } else if 2 * count > part.len() {
            part.iter().for_each(|&f| turned[f] = turned[f].map(|x| !x));
        }
    }
    Turns { turned: turned.into_iter().map(|turned| turned == Some(true)).collect(), seams }
}

/// The draft with faces turned as [`turns`] tells.
///
/// # Errors
/// [`MeshFault::NotOrientable`] where a part is one-sided.
pub(super) fn oriented(draft: Draft) -> Result<Draft, RepairRefusal> {
    let Turns { turned, seams } = turns(&draft);
    if let Some(&h) = seams.first() {
        let edge = draft.faces[h / 3].edge(h % 3).map(|v| draft.number(v));
        return Err(MeshFault::NotOrientable { edge }.into());
    }
    let mut draft = draft;
    for (face, _) in draft.faces.iter_mut().zip(turned).filter(|(_, turned)| *turned) {
        *face = face.turned();
    }
    Ok(draft)
}

/// Whether two halfedges of one edge run along it in the same direction.
fn runs_alike(faces: &[DraftFace], a: usize, b: usize) -> bool {
    faces[a / 3].corners[a % 3] == faces[b / 3].corners[b % 3]
}
