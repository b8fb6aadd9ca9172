//! Isotropic remeshing of a closed surface (Botsch & Kobbelt 2004, "A remeshing approach to multiresolution modeling").
//!
//! The wanted number of faces says how long edges are to be. In every round edges longer than 4/3 of that are split, edges
//! shorter than 4/5 collapsed, edges flipped towards six neighbours a vertex, and vertices moved in their tangent planes to
//! the mean of their neighbours by area and put back onto the given surface. No such step turns a triangle over. The wanted length
//! follows the number of faces that a round ends with. Sharp edges stay: their vertices move along them only.
//!
//! All edges are of one length, so that what is smaller than an edge (a thin tail, fingers) is lost or becomes crude; the
//! report tells the distances. Intersections of the surface with itself, in the input or new, are not looked for.

mod carry;
mod creases;
mod flips;
mod lengths;
mod remeshing;
mod report;
mod smoothing;
mod tips;
mod variants;
mod working;

pub use carry::carried;
pub use remeshing::{Error, Options, Remeshed, USUAL_CREASE_ANGLE, remesh};
pub use report::{Distances, EdgeLengths, Report};
pub use variants::{Noise, decimated, perturbed};
