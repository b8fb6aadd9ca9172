//! Rigid registration of patches between two poses of one body: where most of the surface moves rigidly, the fit of a patch
//! says where its centre belongs.

pub mod mean_fit;
pub mod patch_fit;
pub mod rigid_patches;
