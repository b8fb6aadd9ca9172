//! Rigid registration of patches. Between two poses of one body, and of two as alike as people are, most of the surface moves nearly rigidly, so
//! that the fit of a patch says where its centre belongs; on other bodies the mean fit tells better maps from worse.

pub mod mean_fit;
pub mod patch_fit;
pub mod rigid_patches;
