//! Landmark pairs that nobody gave: ends of limbs of two bodies matched, judged by coarse maps, and told with their doubts.

mod agreement;
mod between;
mod candidate;
mod candidates;
mod difference;
mod heads;
mod input;
mod judge;
mod matching;
mod moves;
mod options;
mod orders;
mod pair;
mod parting;
mod persistence;
mod reflection;
mod roles;
mod search;
mod shape;
mod sharpening;
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
