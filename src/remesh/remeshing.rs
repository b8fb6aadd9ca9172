//! The rounds of remeshing: splits, collapses, flips and smoothing until the number of faces is the wanted one.

use super::creases::Creases;
use super::report::Report;
use super::tips;
use super::working::Working;
use crate::math::scalar::{max, min};
use crate::mesh::SurfaceMesh;
use crate::mesh::check::MAX_FACES;
use crate::mesh::surface_index::SurfaceIndex;
use crate::monitor::{Cancelled, Monitor, Pulse, Rising, Stage, Step};
use std::f64::consts::FRAC_PI_4;

/// The crease angle where a user says nothing, in radians.
pub const USUAL_CREASE_ANGLE: f64 = FRAC_PI_4;

/// The options of remeshing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The wanted number of triangles, from 4 to [`MAX_FACES`].
    pub faces: usize,
    /// Edges whose faces' normals differ by more than this, in radians, stay sharp; none do where it is pi.
    pub crease_angle: f64,
    /// The number of rounds after which the number of faces must be near the wanted one.
    pub max_rounds: usize,
}

impl Options {
    /// The usual way to a number of triangles.
    pub fn to_faces(faces: usize) -> Self {
        Self { faces, crease_angle: USUAL_CREASE_ANGLE, max_rounds: 60 }
    }
}

/// The new mesh.
#[derive(Clone, Debug)]
pub struct Remeshed {
    /// The mesh, closed and manifold, of the given surface's genus and number of parts; its vertices lie on the given surface.
    pub mesh: SurfaceMesh,
    /// The quality of the mesh.
    pub report: Report,
}

/// Why there is no new mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// More triangles than a mesh may have.
    #[error("{wanted} faces were asked for; the limit is {MAX_FACES}")]
    TooManyFaces {
        /// The number of faces that was asked for.
        wanted: usize,
    },
    /// No closed surface has so few triangles, or none of this shape that the method finds.
    #[error(
        "{wanted} faces are too few for this shape: {} faces are left where no more edges can go",
        reached
    )]
    TooFewFaces {
        /// The number of faces that was asked for.
        wanted: usize,
        /// The number of faces with which the last round ended.
        reached: usize,
    },
    /// The number of faces did not come near the wanted one.
    #[error("the mesh has {reached} faces after {rounds} rounds, where {wanted} were asked for")]
    NotConverged {
        /// The number of faces that was asked for.
        wanted: usize,
        /// The number of faces with which the last round ended.
        reached: usize,
        /// The number of rounds.
        rounds: usize,
    },
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The monitor is asked after so many looks at an edge.
const ASKED_EVERY: usize = 1024;
/// The number of rounds that are made in any case: the first bring the lengths, the others regular triangles. Chosen by hand.
const LEAST_ROUNDS: usize = 10;
/// The number of rounds without splits and collapses at the end. Chosen by hand.
const LAST_ROUNDS: usize = 3;
/// The share of the wanted faces by which the result's number may differ from it. Chosen by hand.
const TOLERANCE: f64 = 0.05;
/// The share of the wanted faces within which no better number is waited for. Chosen by hand.
const AIM: f64 = 0.02;

/// Remeshes a closed surface.
///
/// # Errors
/// [`Error`] where the wanted number of faces is too large, the reached one is not within 5 % of the wanted one (or within one face) at the end, or on request.
pub fn remesh(
    surface: &SurfaceMesh,
    options: &Options,
    monitor: &mut impl Monitor,
) -> Result<Remeshed, Error> {
    // Questions within a round tell no progress.
    let monitor = &mut Rising::new(monitor);
    monitor.enter(Stage::Remeshing);
    let wanted = options.faces;
    if wanted < 4 {
        return Err(Error::TooFewFaces { wanted, reached: 4 });
    }
    if wanted > MAX_FACES {
        return Err(Error::TooManyFaces { wanted });
    }
    let original = SurfaceIndex::new(surface);
    // The length is that of equilateral triangles.
    let mut length = (4.0 * surface.area() / (3.0_f64.sqrt() * wanted as f64)).sqrt();
    let mut creases = Creases::find(surface, options.crease_angle, length);
    creases.hold(&tips::tips(surface, length, &mut Pulse::new(monitor, ASKED_EVERY))?);
    let mut working = Working::new(&original, creases);
    let mut rounds = 0;
    while rounds < options.max_rounds {
        let pulse = &mut Pulse::new(monitor, ASKED_EVERY);
        working.split_longer_than(4.0 / 3.0 * length, pulse)?;
        working.collapse_shorter_than(0.8 * length, 4.0 / 3.0 * length, pulse)?;
        working.flip_towards_six(pulse)?;
        working.smooth(length, pulse)?;
        rounds += 1;
        let ratio = working.face_count() as f64 / wanted as f64;
        monitor.step(Step { fraction: share_done(rounds, options), residual: Some((ratio - 1.0).abs()) })?;
        if rounds >= LEAST_ROUNDS && (ratio - 1.0).abs() < AIM {
            break;
        }
        length *= max(0.8, min(1.25, ratio.sqrt()));
    }
    check_count(working.face_count(), wanted, rounds)?;
    // Once there, they leave it no more; the last rounds repair the triangles that this may have turned over.
    working.put_onto_surface(&mut Pulse::new(monitor, ASKED_EVERY))?;
    for _ in 0..LAST_ROUNDS {
        let pulse = &mut Pulse::new(monitor, ASKED_EVERY);
        working.flip_towards_six(pulse)?;
        working.smooth(length, pulse)?;
        monitor.step(Step { fraction: 0.95, residual: None })?;
    }
    let mesh = working.into_mesh();
    let pulse = &mut Pulse::new(monitor, ASKED_EVERY);
    let report = Report::new(&mesh, &original, rounds + LAST_ROUNDS, pulse)?;
    Ok(Remeshed { mesh, report })
}

/// The share of the work that is done after some rounds, as most meshes take them.
fn share_done(rounds: usize, options: &Options) -> f64 {
    let expected = options.max_rounds.min(LEAST_ROUNDS + LAST_ROUNDS) as f64;
    min(0.9, rounds as f64 / expected)
}

fn check_count(reached: usize, wanted: usize, rounds: usize) -> Result<(), Error> {
    let allowed = max(1.0, TOLERANCE * wanted as f64);
    let excess = reached as f64 - wanted as f64;
    if excess > allowed {
        Err(Error::TooFewFaces { wanted, reached })
    } else if excess < -allowed {
        Err(Error::NotConverged { wanted, reached, rounds })
    } else {
        Ok(())
    }
}
