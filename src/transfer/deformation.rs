//! Deformation transfer (Sumner & Popovic 2004): one mesh moves as the other does.
//!
//! Every face of the receiving mesh gets the mean of the deformation gradients of the giving mesh's faces, by the area of the overlay
//! that they share with it. Positions whose gradients are nearest to these, by area, solve a Poisson system with the cotangent
//! Laplacian of the receiving mesh, which is that paper's system without its fourth vertices (Botsch, Sumner, Pauly & Gross 2006).
//! Solved are the displacements from the mean gradient's image, so that an affine motion leaves nothing to solve. The mean
//! gradient also says where the middle goes.

use super::cells::Cells;
use super::gradients::{centre, gradients};
use super::poisson::Poisson;
pub use super::poisson::{DeformationError, Shape};
use crate::export::vertex_image::Direction;
use crate::landmarks::MeshSide;
use crate::mesh::{FaceId, SurfaceMesh, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use crate::surface_map::correspondence::Correspondence;
use glam::{DMat3, DVec3};
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// The number of pieces after which progress is reported.
const PIECES_A_STEP: usize = 1 << 14;

/// The data that every frame needs: the overlay's shares, and the receiving mesh's linear system.
pub struct DeformationTransfer<'a> {
    giving: &'a SurfaceMesh,
    receiving: &'a SurfaceMesh,
    /// The place in `shares` at which the shares of each face of the receiving mesh begin, and the end.
    begins: Vec<u32>,
    /// Faces of the giving mesh with the share of the receiving face that they have.
    shares: Vec<(FaceId, f64)>,
    poisson: Poisson<'a>,
}

impl<'a> DeformationTransfer<'a> {
    /// The transfer from one mesh to the other by a map that has passed [`crate::surface_map::correspondence::check`] with them.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn new(
        meshes: [&'a SurfaceMesh; 2],
        map: &Correspondence,
        direction: Direction,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let giver = direction.side();
        let (giving, receiving) = (meshes[giver], meshes[giver.other()]);
        let Shares { begins, shares } = shares(meshes, map, giver, monitor)?;
        Ok(Self { giving, receiving, begins, shares, poisson: Poisson::new(receiving) })
    }

    /// The receiving mesh moved as the giving one is from its own shape to a frame.
    ///
    /// # Errors
    /// [`DeformationError`].
    pub fn moved(
        &mut self,
        frame: &TiSlice<VertexId, DVec3>,
        monitor: &mut dyn Monitor,
    ) -> Result<Shape, DeformationError> {
        let mut gradients = self.carried(&gradients(self.giving, frame));
        let mean = self.mean(&gradients);
        gradients.iter_mut().for_each(|gradient| *gradient -= mean);
        let displacements = self.poisson.displacements(&gradients, mean, monitor)?;
        let areas = self.receiving.vertex_areas();
        let giving_areas = self.giving.vertex_areas();
        let middle = centre(&areas, self.receiving.positions());
        let [from, to] = [self.giving.positions(), frame].map(|points| centre(&giving_areas, points));
        let to = to + mean * (middle - from) - centre(&areas, &displacements);
        let position = |(p, u): (&DVec3, &DVec3)| mean * (*p - middle) + *u + to;
        Ok(self.receiving.positions().iter().zip(&displacements).map(position).collect())
    }

    /// Gradients of the giving mesh's faces as those of the receiving one's: means by area.
    fn carried(&self, gradients: &TiSlice<FaceId, DMat3>) -> TiVec<FaceId, DMat3> {
        let mean = |f: FaceId| {
            let within = self.begins[f.index()] as usize..self.begins[f.index() + 1] as usize;
            self.shares[within].iter().fold(DMat3::ZERO, |sum, (g, share)| sum + gradients[*g] * *share)
        };
        self.receiving.faces().map(mean).collect()
    }

    fn mean(&self, gradients: &TiSlice<FaceId, DMat3>) -> DMat3 {
        let sum = |sum: DMat3, f: FaceId| sum + gradients[f] * self.receiving.face_area(f);
        self.receiving.faces().fold(DMat3::ZERO, sum) * (1.0 / self.receiving.area())
    }
}

/// Faces of the giving mesh by face of the receiving one.
struct Shares {
    /// The place at which the shares of each face begin, and one past the last.
    begins: Vec<u32>,
    shares: Vec<(FaceId, f64)>,
}

/// For each face of the receiving mesh the giving mesh's faces and their shares of it, which sum to 1.
fn shares(
    meshes: [&SurfaceMesh; 2],
    map: &Correspondence,
    giver: MeshSide,
    monitor: &mut dyn Monitor,
) -> Result<Shares, Cancelled> {
    let receiver = giver.other();
    let mut by_face: TiVec<FaceId, Vec<(FaceId, f64)>> = ti_vec![Vec::new(); meshes[receiver].face_count()];
    let mut cells = Cells::new(meshes, map);
    for (number, piece) in map.pieces.iter().enumerate() {
        if number % PIECES_A_STEP == 0 {
            monitor.step(Step { fraction: number as f64 / map.pieces.len() as f64, residual: None })?;
        }
        let area: f64 = cells.of(piece).iter().map(|cell| cell.areas[receiver]).sum();
        by_face[piece.faces[receiver]].push((piece.faces[giver], area));
    }
    let (mut begins, mut shares) = (vec![0], Vec::with_capacity(map.pieces.len()));
    for found in &by_face {
        let whole: f64 = found.iter().map(|(_, area)| area).sum();
        // A face so thin that it has no area takes its pieces alike.
        let share = |area: f64| if whole > 0.0 { area / whole } else { 1.0 / found.len() as f64 };
        shares.extend(found.iter().map(|(g, area)| (*g, share(*area))));
        begins.push(shares.len() as u32);
    }
    Ok(Shares { begins, shares })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::vertex_image::Direction::{SourceToTarget, TargetToSource};
    use crate::math::scalar::{cos, sin};
    use crate::monitor::Silent;
    use crate::transfer::poisson::weighted_hats;
    use crate::transfer::tests::ball_on_egg;

    /// The receiving mesh moved as `motion` moves the giving one.
    fn moved(direction: Direction, motion: impl Fn(DVec3) -> DVec3) -> (Shape, &'static SurfaceMesh) {
        let mapped = ball_on_egg();
        let mut transfer =
            DeformationTransfer::new(mapped.meshes(), &mapped.map, direction, &mut Silent).unwrap();
        let frame: Shape = mapped.meshes()[direction.side()].positions().iter().map(|p| motion(*p)).collect();
        (transfer.moved(&frame, &mut Silent).unwrap(), mapped.meshes()[direction.side().other()])
    }

    fn farthest(shape: &Shape, mesh: &SurfaceMesh, motion: impl Fn(DVec3) -> DVec3) -> f64 {
        shape.iter().zip(mesh.positions()).map(|(q, p)| q.distance(motion(*p))).fold(0.0, f64::max)
    }

    #[test]
    fn affine_motions_are_the_same_on_both() {
        let turn = DMat3::from_cols(
            DVec3::new(cos(0.7), sin(0.7), 0.0),
            DVec3::new(-sin(0.7), cos(0.7), 0.0),
            DVec3::Z,
        );
        let shear = DMat3::from_cols(DVec3::X, DVec3::new(0.4, 1.2, 0.0), DVec3::new(0.0, -0.3, 0.8));
        let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
        let matrices = [DMat3::IDENTITY, turn, DMat3::IDENTITY * 2.5, shear, turn * shear, mirror];
        for matrix in matrices {
            let motion = |p: DVec3| matrix * p + DVec3::new(3.0, -1.0, 0.5);
            for direction in [TargetToSource, SourceToTarget] {
                let (shape, mesh) = moved(direction, motion);
                let off = farthest(&shape, mesh, motion);
                assert!(off < 1e-9, "{direction:?}, {matrix}: {off:e}");
            }
        }
    }

    /// Each height is turned by its own angle around the axis.
    fn twist(p: DVec3) -> DVec3 {
        let angle = 0.8 * p.z;
        DVec3::new(cos(angle) * p.x - sin(angle) * p.y, sin(angle) * p.x + cos(angle) * p.y, p.z)
    }

    #[test]
    fn a_twist_is_a_twist() {
        let (shape, mesh) = moved(TargetToSource, twist);
        // The map takes heights nearly to heights; a wrong transpose or sign would be off by the size of the body.
        let off = farthest(&shape, mesh, twist);
        let way = farthest(&shape, mesh, |p| p);
        assert!(off < 0.12 && way > 0.3, "{off} off after {way}");
    }

    #[test]
    fn the_displacements_are_those_of_least_squares() {
        // Moving any vertex of the result makes the gradients fit worse.
        let mapped = ball_on_egg();
        let mut transfer =
            DeformationTransfer::new(mapped.meshes(), &mapped.map, TargetToSource, &mut Silent).unwrap();
        let frame: Shape = mapped.target.positions().iter().map(|p| twist(*p)).collect();
        let wanted = transfer.carried(&gradients(&mapped.target, &frame));
        let shape = transfer.moved(&frame, &mut Silent).unwrap();
        let misfit = |shape: &Shape| -> f64 {
            let off = |f: FaceId| {
                let hats = weighted_hats(&mapped.source, f);
                let area = mapped.source.face_area(f);
                let corners = mapped.source.triangles()[f];
                // The gradient found minus the wanted one, both on the face's plane.
                let [p, q, r] = mapped.source.corners(f);
                let normal = (q - p).cross(r - p).normalize();
                let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
                    let found: DVec3 = (0..3).map(|k| shape[corners[k]] * hats[k].dot(axis) / area).sum();
                    found - wanted[f] * (axis - normal * normal.dot(axis))
                });
                area * columns.iter().map(|c| c.length_squared()).sum::<f64>()
            };
            mapped.source.faces().map(off).sum()
        };
        let least = misfit(&shape);
        for v in [0, 100, 500, 1000] {
            for push in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X] {
                let mut other = shape.clone();
                other[VertexId(v)] += push * 1e-3;
                assert!(misfit(&other) > least, "vertex {v}");
            }
        }
    }
}
