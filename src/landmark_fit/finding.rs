//! A doubt about landmark pairs, with its numbers, its sentence for the user and its repair.

use crate::landmarks::LandmarkId;
use crate::mesh::VertexId;
use std::fmt;

/// A doubt about landmark pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// The whole set is mirrored: left on one mesh is right on the other.
    Mirrored {
        /// Agreement of the orders around the landmarks and of their places in space, from -1 (all reversed) to 1.
        agreement: f64,
    },
    /// Two pairs have each other's target.
    Swapped {
        /// The pairs.
        pairs: [LandmarkId; 2],
        /// Vote of the other landmarks, from -1, where the targets fit exchanged, to 1, where they fit as they are.
        agreement: f64,
        /// Mean misfit of both pairs' distances (absolute log ratio) as it is and with the targets exchanged; of near
        /// pairs, such as eyes, it is small both ways.
        misfit: [f64; 2],
    },
    /// One pair's target is far from the place that fits the other pairs.
    Misplaced {
        /// The pair.
        pair: LandmarkId,
        /// Mean misfit of its distances (absolute log ratio) as it is and at the best place.
        misfit: [f64; 2],
        /// Distance of its target to the best place, in units of the root of the target's area.
        distance: f64,
        /// The best place: a vertex of the (coarse) target.
        place: VertexId,
        /// The pair whose target is nearest to that place, itself apart.
        near: LandmarkId,
    },
}

/// The repair that is offered for a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Repair {
    /// Exchange the targets of two pairs.
    Swap {
        /// The pairs.
        pairs: [LandmarkId; 2],
    },
    /// Mirror the target mesh, or exchange left and right in all pairs.
    MirrorTarget,
    /// Look at a pair.
    Check {
        /// The pair.
        pair: LandmarkId,
    },
}

impl Finding {
    /// The repair to offer.
    pub fn repair(&self) -> Repair {
        match *self {
            Self::Mirrored { .. } => Repair::MirrorTarget,
            Self::Swapped { pairs, .. } => Repair::Swap { pairs },
            Self::Misplaced { pair, .. } => Repair::Check { pair },
        }
    }

    /// One sentence for the user, with the pairs by name; pairs without a name are counted from 1.
    pub fn sentence(&self, labels: &[String]) -> String {
        let name = |pair: LandmarkId| match labels.get(pair.index()).filter(|label| !label.is_empty()) {
            Some(label) => format!("{} ({label})", pair.index() + 1),
            None => (pair.index() + 1).to_string(),
        };
        match *self {
            Self::Mirrored { .. } => {
                "The landmarks are mirrored: left on one mesh is right on the other. Mirror the \
                                      target, or exchange left and right."
                    .into()
            }
            Self::Swapped { pairs: [a, b], .. } => format!(
                "The targets of the pairs {} and {} look swapped: exchanged with each other they would fit the \
                 source. Exchange them.",
                name(a),
                name(b)
            ),
            Self::Misplaced { pair, near, .. } => format!(
                "Pair {} does not fit the others: its target is expected elsewhere, near that of pair {}.",
                name(pair),
                name(near)
            ),
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sentence(&[]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_name_pairs_and_repairs() {
        let labels = ["nose", "tail"].map(String::from);
        let pairs = [LandmarkId(0), LandmarkId(1)];
        let swapped = Finding::Swapped { pairs, agreement: -0.9, misfit: [0.5, 0.1] };
        assert_eq!(swapped.repair(), Repair::Swap { pairs });
        let sentence = swapped.sentence(&labels);
        assert!(sentence.contains("1 (nose)") && sentence.contains("2 (tail)"), "{sentence}");
        assert!(swapped.to_string().contains("pairs 1 and 2"), "{swapped}");
        let mirrored = Finding::Mirrored { agreement: -0.8 };
        assert_eq!(mirrored.repair(), Repair::MirrorTarget);
    }
}
