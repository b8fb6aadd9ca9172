//! Landmark pairs that nobody gave: ends of limbs of two bodies matched, judged by coarse maps, and told with their doubts.

mod agreement;
mod between;
mod candidate;
mod candidates;
mod difference;
mod judge;
mod matching;
mod moves;
mod options;
mod persistence;
mod search;
mod shape;
mod sharpening;
mod verdict;

pub use candidate::{Candidate, CoarsePicture, MatchedPair, PairOrigin};
pub use difference::{Difference, DifferenceKind};
pub use matching::{LandmarkMatch, MatchError, MatchInput, MayMark, match_landmarks};
pub use options::MatchOptions;
pub use verdict::{Question, Verdict, VerdictLimits};
