//! The four-legged animals of SHREC07 and the meaning of their 21 landmarks, which their pair files do not name.
#![allow(dead_code, reason = "every test binary uses another part")]

/// The landmarks that are left and right partners.
pub const PARTNERS: [[usize; 2]; 8] =
    [[2, 3], [4, 10], [5, 11], [6, 8], [7, 9], [15, 16], [17, 18], [19, 20]];

/// The landmarks at the sides of the neck. No map can put them right on all animals, since they were set at 18 to 71 % of the way from eye
/// to shoulder.
pub const NECK: [usize; 2] = [2, 3];

/// Whether a pair of meshes, by its name in the data folder, is one of these animals.
pub fn is_of(pair: &str) -> bool {
    pair.starts_with("shrec07")
}
