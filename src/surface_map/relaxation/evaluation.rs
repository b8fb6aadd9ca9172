//! The energy of a map at one state, with the quantities from which its derivatives are computed.

use crate::math::quantile::{Weighted, quantile, sort_by_value};
use crate::math::rigid2;
use crate::math::scalar::{ln, min};
use crate::math::triangle::hat_gradients;
use crate::mesh::face_weights::{FaceWeights, PieceWeight, piece_weight};
use crate::mesh::{FaceId, VertexId};
use crate::surface_map::energy::density::Density;
use crate::surface_map::energy::map_energy::MapEnergy;
use crate::surface_map::energy::vertex_energy::VertexEnergy;
use crate::surface_map::overlay::Measure;
use crate::surface_map::overlay::location::Locations;
use crate::surface_map::parametrisation::embedding::Parametrised;
use crate::surface_map::parametrisation::problem::{FlatProblem, unrotate};
use crate::surface_map::parametrisation::rest_triangle::Corner;
use crate::surface_map::parametrisation::unknowns::Unknowns;
use glam::{DMat2, DVec2};
use typed_index_collections::TiVec;

/// The energy of a map, with the weights of the faces of the moving and of the fixed mesh.
#[derive(Clone, Copy)]
pub struct CountedEnergy<'a> {
    pub energy: MapEnergy,
    pub weights: [FaceWeights<'a>; 2],
}

/// The overlay and the energies at one state. The overlay's source is the moving mesh.
#[derive(Default)]
pub struct Evaluation {
    pub overlay: Measure,
    /// Jacobians of the moving faces, from their rest planes.
    pub jacobians: Vec<DMat2>,
    /// The Jacobian of each piece from the plane of the moving face to the rest plane of the fixed face.
    pub onto_rest: Vec<DMat2>,
    /// The weight of each piece in the energy.
    pub weights: Vec<PieceWeight>,
    /// The energy of the map, without the barrier and the constraints.
    pub energy: f64,
    /// The energy of the constraints.
    pub constrained: f64,
    /// Their gradients by unknown.
    pub constraint_slopes: Vec<(u32, DVec2)>,
    /// Their Hessians by unknown.
    pub constraint_hessians: Vec<(u32, DMat2)>,
    /// The energy, the constraints and the barrier.
    pub total: f64,
}

impl Evaluation {
    /// Computes the Jacobians and the energy of the overlay, whose moving mesh is at z.
    pub fn measure(
        &mut self,
        problem: &FlatProblem,
        z: &[DVec2],
        fixed_inverses: &TiVec<FaceId, DMat2>,
        counted: CountedEnergy<'_>,
    ) {
        self.jacobians.clear();
        self.jacobians.extend(problem.jacobians(z));
        self.onto_rest.clear();
        self.onto_rest.extend(
            self.overlay
                .pieces()
                .iter()
                .map(|piece| fixed_inverses[piece.target_face] * rigid2::turn(piece.rotation)),
        );
        let CountedEnergy { energy, weights } = counted;
        self.weights.clear();
        let pieces = self.overlay.pieces().iter();
        self.weights
            .extend(pieces.map(|piece| piece_weight(weights, [piece.source_face, piece.target_face])));
        self.energy = self.integral(energy);
    }

    /// Computes the energy of the constraints on the moving mesh, the first one, whose vertices have been located.
    pub fn constrain(
        &mut self,
        [from, onto]: [Parametrised<'_>; 2],
        unknowns: &Unknowns<'_>,
        constraints: &[(VertexId, impl VertexEnergy)],
        locations: &Locations,
    ) {
        self.constrained = 0.0;
        self.constraint_slopes.clear();
        self.constraint_hessians.clear();
        for (v, constraint) in constraints {
            let at = &locations.by_vertex[*v];
            let Corner::Free(unknown, sight) = unknowns.sight(at.corner) else { continue };
            let q = at.motion.apply(from.embedding.corners[at.corner]);
            let p = onto.embedding.triangle(at.face);
            let hats = hat_gradients(p);
            let [second, third] = [1, 2].map(|k| (q - p[0]).dot(hats[k]));
            let barycentric = [1.0 - second - third, second, third];
            let turned = hats.map(|hat| unrotate(&sight, unrotate(&at.motion, hat)));
            let term = constraint.term(onto.mesh.corners(at.face), barycentric, turned);
            self.constrained += term.energy;
            self.constraint_slopes.push((unknown, term.gradient));
            self.constraint_hessians.push((unknown, term.hessian));
        }
    }

    /// The integral of an energy over both surfaces.
    pub fn integral(&self, energy: MapEnergy) -> f64 {
        self.of_pieces(energy).map(|(_, of_piece)| of_piece).sum()
    }

    /// The part of each moving face in that integral.
    pub fn by_face(&self, energy: MapEnergy) -> Vec<f64> {
        let mut sums = vec![0.0; self.jacobians.len()];
        self.of_pieces(energy).for_each(|(face, of_piece)| sums[face] += of_piece);
        sums
    }

    /// The energy of each piece, with the number of its moving face.
    fn of_pieces(&self, energy: MapEnergy) -> impl Iterator<Item = (usize, f64)> {
        let pieces = self.overlay.pieces().iter().zip(&self.onto_rest).zip(&self.weights);
        pieces.map(move |((piece, c), &counted)| {
            let face = piece.source_face.index();
            let a = &self.jacobians[face];
            (face, piece.area / a.determinant() * energy.of_piece(counted).density(&(*c * *a)))
        })
    }

    /// Half the sum of the weighted means of the density's logarithm over both surfaces. The area that its weight takes from a piece with
    /// a toll t counts t times (at most once), with the density 1 + t / 2: the energy of an isometry with that toll, relative to one
    /// without.
    pub fn mean_log(&self) -> f64 {
        let (mut sums, mut areas) = ([0.0; 2], [0.0; 2]);
        let pieces = self.overlay.pieces().iter().zip(&self.onto_rest).zip(&self.weights);
        for ((piece, c), counted) in pieces {
            let a = &self.jacobians[piece.source_face.index()];
            let j = *c * *a;
            let whole = piece.area / a.determinant();
            // With equal areas the distortion is the density.
            let log = ln(MapEnergy::POSES.distortion(&j));
            let PieceWeight { weight, toll } = *counted;
            let mut add = |weight: f64, log: f64| {
                let area = weight * whole;
                for (k, area) in [area, area * j.determinant()].into_iter().enumerate() {
                    sums[k] += log * area;
                    areas[k] += area;
                }
            };
            add(weight, log);
            if toll > 0.0 {
                add((1.0 - weight) * min(toll, 1.0), ln(1.0 + 0.5 * toll));
            }
        }
        0.5 * (sums[0] / areas[0] + sums[1] / areas[1])
    }

    /// The areas, on the moving and on the fixed mesh, of the pieces that are skin on both.
    pub fn skin_areas(&self) -> [f64; 2] {
        let mut areas = [0.0; 2];
        let pieces = self.overlay.pieces().iter().zip(&self.onto_rest).zip(&self.weights);
        for ((piece, c), _) in pieces.filter(|(_, counted)| counted.weight >= 0.5) {
            areas[0] += piece.area / self.jacobians[piece.source_face.index()].determinant();
            areas[1] += piece.area * c.determinant();
        }
        areas
    }

    /// The median distortion, each piece counted by its weight and its areas on both surfaces.
    pub fn median(&self, map_energy: MapEnergy) -> f64 {
        let pieces = self.overlay.pieces().iter().zip(&self.onto_rest).zip(&self.weights);
        let local = pieces.map(|((piece, c), counted)| {
            let a = &self.jacobians[piece.source_face.index()];
            let j = *c * *a;
            let weight = counted.weight * (piece.area / a.determinant() * (1.0 + j.determinant()));
            Weighted { value: map_energy.distortion(&j), weight }
        });
        let mut local: Vec<Weighted> = local.collect();
        sort_by_value(&mut local);
        quantile(&local, 0.5)
    }
}
