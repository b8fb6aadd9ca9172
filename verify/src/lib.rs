//! A second opinion on finished maps: reads a map file and both meshes, and proves that the map is one-to-one.
//!
//! It shares no code with the program that makes maps, and reads nothing of a map file but its header and the sections
//! `vertices.*` and `pieces.*` (`docs/map-file.md` has the format). The meshes come as arrays ([`GivenMesh`]):
//! what has read and triangulated their files is trusted to have read them right. All else is checked here.
//!
//! # What is proved
//!
//! 1. Each mesh is the one that the map was made with: the SHA-256 of its arrays is that in the map file. It is closed, oriented,
//!    manifold, connected and has V - E + F = 2. (That it does not cut through itself is neither needed nor looked for.)
//! 2. The pieces are a sphere K: every side of a piece is run once the other way by another piece, pieces are connected across
//!    their sides, and V - E + F = 2. Pieces with two corners have no inside; they are left out and their neighbours glued.
//! 3. Every corner of a piece lies in the piece's face of S and in its face of T. So sides that pieces of different faces
//!    share lie on the faces' common edge, and the map f from K to S that takes corners to their places and is affine on triangles is
//!    continuous; so is g from K to T. Pieces with more than three corners are cut into triangles in the same way on both.
//! 4. Each of the triangles is turned the right way on S and on T: its three places have a positive determinant. A place is the
//!    point with the weights of the file divided by their sum; the sign of the determinant of the weights as they are is that of
//!    the area, and is found exactly ([`exact`]).
//! 5. So f is a covering that can branch at vertices only. A point of every face of S lies in exactly one of the triangles (the
//!    same signs), so the covering has one sheet, and f is a homeomorphism; so is g. Then g after the inverse of f is a
//!    homeomorphism from S onto T that keeps the orientation (reverses it, for a map to the mirror image): one-to-one,
//!    onto, continuous with its inverse, and the pieces tile every face of S and of T.
//! 6. Landmarks that are vertices of both meshes go to their partners exactly: they share a vertex of K. For landmarks inside
//!    faces the distances are reported.
//!
//! Points 1 to 3 are combinatorial, points 4 and 5 exact arithmetic, and 6 is both. The matrices of pieces, by which images of points are
//! answered, are f64 and carry f64 corners only nearly: how far they are from the homeomorphism is reported in f64 ([`Matrices`]), and
//! more than the format allows is refused.
//!
//! Where corners were rounded so that triangles have no area or a negative one of less than [`WITHIN_ROUNDING`] of a face, the
//! map is not proved ([`Proof::is_exact`]). Then the rest of the argument gives: outside of these triangles' images, whose area is
//! reported, each point has exactly one image.
//!
//! # What is not proved
//!
//! The texture, the flat layout, the report and the numbers in the header are not read. Which class of maps it is, which way
//! round a limb, is not a matter of right or wrong: a map of another class is proved likewise.

mod complex;
mod container;
pub mod exact;
mod header;
mod landmarks;
mod matrices;
mod mesh;
mod places;
mod refusal;
mod tiling;
mod verify;

pub use landmarks::Landmarks;
pub use matrices::Matrices;
pub use mesh::{GivenMesh, MeshProblem};
pub use refusal::{Refusal, Side};
pub use tiling::{Doubtful, WITHIN_ROUNDING};
pub use verify::{Proof, verify};
