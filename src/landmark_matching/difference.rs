//! The difference of one candidate from another, in words for the user.

use super::pair::MatchedPair;
use crate::landmarks::MeshSide;
use crate::mesh::VertexId;

/// The kinds of differences of two candidates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum DifferenceKind {
    /// Left and right are exchanged for every limb that has a partner on the other side of its body.
    Mirrored,
    /// Left and right are exchanged for some limbs only.
    Sides,
    /// Most ends of limbs are assigned to other ends, not only to the other side: as with head and tail exchanged.
    Ends,
    /// Some ends of limbs are assigned to other ends.
    Places,
    /// The pairs are the same but for some that only one candidate has.
    Fewer,
}

/// The difference of a candidate from the best.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Its kind.
    pub kind: DifferenceKind,
    /// The pairs of this candidate that the best does not have.
    pub pairs: Vec<MatchedPair>,
    /// Share of the source's area whose images are farther than 0.15 of the root of the target's area from those of the best.
    pub share: f64,
}

impl Difference {
    /// Whether there is one: other pairs, or images elsewhere.
    pub(super) fn is_any(&self) -> bool {
        self.kind != DifferenceKind::Places || !self.pairs.is_empty() || self.share > 0.0
    }

    /// One sentence for the user. `number` gives the number of a vertex in the user's file.
    pub fn sentence(&self, number: impl Fn(MeshSide, VertexId) -> usize) -> String {
        let pairs: Vec<String> = self
            .pairs
            .iter()
            .take(NAMED)
            .map(|pair| {
                let [s, t] = [number(MeshSide::Source, pair.source), number(MeshSide::Target, pair.target)];
                format!("{s} to {t}")
            })
            .collect();
        let more = if self.pairs.len() > NAMED { " and more" } else { "" };
        let list = format!("{}{more}", pairs.join(", "));
        match self.kind {
            DifferenceKind::Mirrored => {
                format!("Left and right are exchanged: of the source's vertices it takes {list}.")
            }
            DifferenceKind::Sides => {
                format!(
                    "Some limbs go to the other side of the body: of the source's vertices it takes {list}."
                )
            }
            DifferenceKind::Ends => {
                format!(
                    "Most ends go elsewhere, as with head and tail exchanged: of the source's vertices it takes {list}."
                )
            }
            DifferenceKind::Places if self.pairs.is_empty() => {
                "The same pairs, but the map goes another way round the body.".to_owned()
            }
            DifferenceKind::Places => {
                format!("Other ends correspond: of the source's vertices it takes {list}.")
            }
            DifferenceKind::Fewer => "Some ends are left without a partner.".to_owned(),
        }
    }
}

/// Pairs that a sentence names, at most. Chosen by hand.
const NAMED: usize = 4;
