//! Landmark pairs without a user: ends of limbs of two bodies are matched and judged by coarse maps; the result says how certain it is.

mod agreement;
mod between;
mod candidate;
mod candidates;
mod difference;
mod heads;
mod input;
mod inversions;
mod judge;
mod likeness;
mod matching;
mod moves;
mod options;
mod orders;
mod pair;
mod parting;
mod persistence;
mod reflection;
mod relief;
mod rings;
mod roles;
mod search;
mod shape;
mod sharpening;
mod small_ends;
mod symmetry;
#[cfg(test)]
mod test_bodies;
mod verdict;

pub use candidate::{Candidate, CoarsePicture};
pub use difference::{Difference, DifferenceKind};
pub use input::{MatchInput, MayMark};
pub use matching::{LandmarkMatch, MatchError, match_landmarks};
pub use options::{MatchOptions, VerdictLimits};
pub use pair::{MatchedPair, PairOrigin};
pub use verdict::{Question, Verdict};
