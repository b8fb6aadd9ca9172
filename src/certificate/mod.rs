//! The proof that a parametrised mesh is the prescribed cone surface, so that its parametrisation is a homeomorphism.
//!
//! The proof uses the result alone. This module shares no code with those that make the result but `mesh` (connectivity) and `math` (rigid
//! motions, elementary functions): its input is plain arrays, and it has its own tracer.
//!
//! # What is checked
//!
//! A closed mesh, each triangle with corners in its own plane, and a rigid motion across each edge; a base domain with an edge length
//! for each of its edges; for each base halfedge the corner and the direction in which it is claimed to start.
//!
//! 1. Every triangle is positively oriented: exactly, by an adaptive predicate on the stored numbers (Shewchuk 1997).
//! 2. Each edge has the same place in both planes: carried over by the rigid motion its ends agree to 1e-6 (the mesh has area 1).
//! 3. The angles around each vertex sum to 2 pi, those around each landmark to the cone angle of the base domain's triangles: to
//!    1e-6 rad. The sum of a wrong vertex differs by 2 pi or more, so this bound only has to be above rounding.
//! 4. The starts around each landmark are unit vectors, to 1e-9, and make the angles of the base domain's triangles, in the same
//!    order: to 1e-5 rad.
//! 5. Each base edge, followed straight from its start, ends at its landmark after its length, to 1e-6, in the direction in
//!    which its twin is claimed to start, to 1e-5 rad.
//! 6. Mesh and base domain are connected, with Euler characteristic 2, and no two landmarks share a vertex.
//! 7. No two of these lines cross. The tracer gives the edges that a line crosses and the places on them, once for both triangles of an
//!    edge; whether two lines cross in a triangle then depends only on the order of their ends along its border, and is decided without
//!    further rounding.
//!
//! # What follows
//!
//! By 1 to 3 the triangles glue to a closed flat surface with cones at the landmarks only. By 7 the lines draw the base domain on
//! it as an embedded graph, with the base domain's order around every landmark by 4. The surface is a sphere by 6 and the graph is
//! connected, so its faces are discs, those of the base domain. Each is flat inside, with three straight sides of the lengths
//! and the angles of its base triangle by 4 and 5: it develops onto that triangle. So the mesh is the cone surface, landmark on
//! landmark, and the parametrisation is a homeomorphism. Two meshes that are certified for one base domain are mapped onto each
//! other bijectively.
//!
//! Positive triangles alone prove nothing (double covers have them, too), nor does the total area.
//!
//! Checks 2 to 5 use floating point arithmetic with the bounds above. So no triangle is flipped and no lines cross, exactly; lengths and
//! angles hold up to the bounds, a millionth of the root of the area and 1e-5 rad.

mod crossings;
mod directions;
mod judged;
mod proof;
mod tracer;

pub use judged::{Judged, Prescribed, Start};
pub use proof::{Certificate, certify};
