//! Values at the vertices of one mesh brought to the vertices of the other.
//!
//! A value at the vertices is a function that is linear on every face. Seen through the map it is linear on every triangle of the
//! overlay, so that its integrals against the receiving mesh's hat functions phi_i are exact: b_i. The mean b_i / (integral of
//! phi_i) blurs by about one ring, and stays between the values that it is made of. The L2 projection solves M x = b with
//! M_ij the integral of phi_i phi_j: no function of the receiving mesh is nearer. Both keep constants, so that what sums to 1
//! still does.

use super::cells::{Cells, integral_of_product};
use super::mass::Mass;
use crate::export::vertex_image::Direction;
use crate::landmarks::MeshSide;
use crate::mesh::{FaceId, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Step};
use crate::numerics::conjugate_gradients::{CgError, CgOptions, CgWorkspace};
use crate::surface_map::correspondence::Correspondence;
use serde::{Deserialize, Serialize};
use typed_index_collections::{TiVec, ti_vec};

/// How a value at a vertex is made of those of the other mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum Carrying {
    /// The nearest piecewise linear function, in the sense of least squares over the area.
    #[default]
    Projection,
    /// The mean over the vertex's share of the surface: blurred, but never beyond the values that it is made of.
    Mean,
    /// The value at the vertex's image.
    Sample,
}

/// Why values could not be brought over.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ValueError {
    /// The user asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The projection could not be solved.
    #[error("the projection of the values: {0}")]
    Solve(#[from] CgError),
}

/// Values by vertex of a mesh.
pub type Values = TiVec<VertexId, f64>;

/// The number of pieces after which progress is reported.
const PIECES_A_STEP: usize = 1 << 14;

/// The accuracy of the projection, in units of its right-hand side.
const PROJECTION: CgOptions = CgOptions { tolerance: 1e-13, max_iterations: 400 };

/// A map seen from the mesh that gives values to the one that receives them.
#[derive(Clone, Copy)]
pub struct ValueCarrier<'a> {
    meshes: [&'a SurfaceMesh; 2],
    map: &'a Correspondence,
    giver: MeshSide,
}

impl<'a> ValueCarrier<'a> {
    /// The carrier from one mesh to the other by a map that has passed [`crate::surface_map::correspondence::check`] with them.
    pub fn new(meshes: [&'a SurfaceMesh; 2], map: &'a Correspondence, direction: Direction) -> Self {
        Self { meshes, map, giver: direction.side() }
    }

    fn giving(&self) -> &'a SurfaceMesh {
        self.meshes[self.giver]
    }

    fn receiving(&self) -> &'a SurfaceMesh {
        self.meshes[self.giver.other()]
    }

    /// Functions of the giving mesh as functions of the receiving one.
    ///
    /// # Errors
    /// [`ValueError`].
    pub fn numbers(
        &self,
        columns: &[Values],
        carrying: Carrying,
        monitor: &mut dyn Monitor,
    ) -> Result<Vec<Values>, ValueError> {
        if carrying == Carrying::Sample {
            let images = self.images();
            return Ok(columns.iter().map(|values| self.sampled(values, &images)).collect());
        }
        let (mass, loads) = self.integrals(columns, monitor)?;
        let lumped = mass.lumped();
        let means = |load: &Values| load.iter().zip(&lumped).map(|(b, m)| b / m).collect::<Values>();
        if carrying == Carrying::Mean {
            return Ok(loads.iter().map(means).collect());
        }
        let diagonal = mass.diagonal();
        let mut workspace = CgWorkspace::default();
        let mut projected = Vec::with_capacity(loads.len());
        for (k, load) in loads.iter().enumerate() {
            monitor.step(Step { fraction: 0.5 + 0.5 * k as f64 / loads.len() as f64, residual: None })?;
            let mut x = vec![0.0; load.len()];
            workspace.solve(&mass, &diagonal, &load.raw, &mut x, &PROJECTION)?;
            projected.push(x.into());
        }
        Ok(projected)
    }

    /// The receiving mesh's mass matrix, and the integrals of each column against its hat functions. Both are summed over the
    /// same triangles, so that constants are kept whatever rounding did to these.
    fn integrals(
        &self,
        columns: &[Values],
        monitor: &mut dyn Monitor,
    ) -> Result<(Mass<'a>, Vec<Values>), Cancelled> {
        let (giver, receiver) = (self.giver, self.giver.other());
        let mut mass = Mass::zero(self.receiving());
        let mut loads: Vec<Values> = vec![ti_vec![0.0; self.receiving().vertex_count()]; columns.len()];
        let mut cells = Cells::new(self.meshes, self.map);
        for (number, piece) in self.map.pieces.iter().enumerate() {
            if number % PIECES_A_STEP == 0 {
                let fraction = 0.5 * number as f64 / self.map.pieces.len() as f64;
                monitor.step(Step { fraction, residual: None })?;
            }
            let onto = self.receiving().triangles()[piece.faces[receiver]];
            let from = self.giving().triangles()[piece.faces[giver]];
            for cell in cells.of(piece) {
                let area = cell.areas[receiver];
                let hats = [0, 1, 2].map(|k| cell.weights[receiver].map(|w| w[k]));
                let pairs = [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2], [2, 0]];
                mass.add(
                    piece.faces[receiver],
                    pairs.map(|[i, j]| integral_of_product(area, hats[i], hats[j])),
                );
                for (values, load) in columns.iter().zip(&mut loads) {
                    let given = from.map(|v| values[v]);
                    let here =
                        cell.weights[giver].map(|w| w[0] * given[0] + w[1] * given[1] + w[2] * given[2]);
                    (0..3).for_each(|k| load[onto[k]] += integral_of_product(area, hats[k], here));
                }
            }
        }
        Ok((mass, loads))
    }

    /// Labels of the giving mesh's vertices brought to the receiving one: that which has most of a vertex's share of the surface,
    /// where a point of a face counts for its corners' labels by its weights; of equal ones the smallest. With
    /// [`Carrying::Sample`] that of the corner of largest weight at the vertex's image.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn labels(
        &self,
        labels: &TiVec<VertexId, i64>,
        carrying: Carrying,
        monitor: &mut dyn Monitor,
    ) -> Result<TiVec<VertexId, i64>, Cancelled> {
        if carrying == Carrying::Sample {
            return Ok(self.images().into_iter().map(|image| self.nearest_label(labels, image)).collect());
        }
        let (giver, receiver) = (self.giver, self.giver.other());
        let mut shares: TiVec<VertexId, Vec<(i64, f64)>> =
            ti_vec![Vec::new(); self.receiving().vertex_count()];
        let mut cells = Cells::new(self.meshes, self.map);
        for (number, piece) in self.map.pieces.iter().enumerate() {
            if number % PIECES_A_STEP == 0 {
                let fraction = number as f64 / self.map.pieces.len() as f64;
                monitor.step(Step { fraction, residual: None })?;
            }
            let onto = self.receiving().triangles()[piece.faces[receiver]];
            let from = self.giving().triangles()[piece.faces[giver]].map(|v| labels[v]);
            for cell in cells.of(piece) {
                let corner_weights = |side: MeshSide, k: usize| cell.weights[side].map(|w| w[k]);
                for (vertex, hat) in onto.into_iter().zip([0, 1, 2].map(|k| corner_weights(receiver, k))) {
                    for (j, label) in from.into_iter().enumerate() {
                        let share = integral_of_product(cell.areas[receiver], hat, corner_weights(giver, j));
                        add_share(&mut shares[vertex], label, share);
                    }
                }
            }
        }
        Ok(shares.iter().map(|found| most(found)).collect())
    }

    /// The image of each vertex of the receiving mesh.
    fn images(&self) -> TiVec<VertexId, SurfacePoint> {
        let images = self.map.vertex_images(self.meshes, self.giver.other());
        // Every vertex is a corner of pieces, as the check of a map makes sure.
        let first = SurfacePoint { face: FaceId(0), barycentric: [1.0, 0.0, 0.0] };
        images.into_iter().map(|image| image.unwrap_or(first)).collect()
    }

    fn sampled(&self, values: &Values, images: &TiVec<VertexId, SurfacePoint>) -> Values {
        let value = |image: &SurfacePoint| {
            let corners = self.giving().triangles()[image.face];
            (0..3).map(|k| image.barycentric[k] * values[corners[k]]).sum::<f64>()
        };
        images.iter().map(value).collect()
    }

    fn nearest_label(&self, labels: &TiVec<VertexId, i64>, image: SurfacePoint) -> i64 {
        let corners = self.giving().triangles()[image.face];
        let mut shares = Vec::new();
        (0..3).for_each(|k| add_share(&mut shares, labels[corners[k]], image.barycentric[k]));
        most(&shares)
    }
}

fn add_share(shares: &mut Vec<(i64, f64)>, label: i64, share: f64) {
    match shares.iter_mut().find(|(known, _)| *known == label) {
        Some((_, sum)) => *sum += share,
        None => shares.push((label, share)),
    }
}

/// The label of the largest share, the smallest where shares are equal.
fn most(shares: &[(i64, f64)]) -> i64 {
    let best = shares.iter().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
    best.map_or(0, |(label, _)| *label)
}
