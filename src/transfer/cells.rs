//! The overlay as triangles, each inside one face of both meshes, with exact integrals of linear functions on them.

use crate::landmarks::MeshSide;
use crate::math::triangle::signed_double_area;
use crate::mesh::SurfaceMesh;
use crate::surface_map::correspondence::{Correspondence, MappedPiece};
use glam::DVec2;

/// A triangle of the overlay.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// The weights of its three corners in the source's face and in the target's.
    pub weights: [[[f64; 3]; 3]; 2],
    /// Its area on the source and on the target; not negative.
    pub areas: [f64; 2],
}

/// The integral of the product of two functions that are linear on a triangle, by their values at its corners.
pub fn integral_of_product(area: f64, u: [f64; 3], v: [f64; 3]) -> f64 {
    let dot = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    area / 12.0 * (u.iter().sum::<f64>() * v.iter().sum::<f64>() + dot)
}

/// Cuts a map's pieces into triangles, piece by piece.
pub struct Cells<'a> {
    meshes: [&'a SurfaceMesh; 2],
    map: &'a Correspondence,
    areas: [Vec<f64>; 2],
    rings: [Vec<DVec2>; 2],
    cells: Vec<Cell>,
}

impl<'a> Cells<'a> {
    /// The cells of a map that has passed [`crate::surface_map::correspondence::check`] with the meshes.
    pub fn new(meshes: [&'a SurfaceMesh; 2], map: &'a Correspondence) -> Self {
        let areas = meshes.map(|mesh| mesh.faces().map(|f| mesh.face_area(f)).collect());
        Self { meshes, map, areas, rings: [Vec::new(), Vec::new()], cells: Vec::new() }
    }

    /// The triangles of a piece, a fan around its first corner; none where two edges coincide.
    pub fn of(&mut self, piece: &MappedPiece) -> &[Cell] {
        let Self { meshes, map, areas, rings, cells } = self;
        for side in MeshSide::BOTH {
            map.ring(meshes[side], side, piece, &mut rings[side]);
        }
        cells.clear();
        for k in 2..rings[0].len().min(rings[1].len()) {
            let corners = MeshSide::BOTH.map(|side| [0, k - 1, k].map(|c| rings[side][c]));
            let area = |side: MeshSide| {
                let [p, q, r] = corners[side];
                let share = signed_double_area(p, q, r);
                // Rounding may turn the thinnest triangles over.
                if share > 0.0 { share * areas[side][piece.faces[side].index()] } else { 0.0 }
            };
            cells.push(Cell {
                weights: corners.map(|triangle| triangle.map(|p| [1.0 - p.x - p.y, p.x, p.y])),
                areas: MeshSide::BOTH.map(area),
            });
        }
        cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::tests::ball_on_egg;

    #[test]
    fn the_cells_cover_both_meshes() {
        let mapped = ball_on_egg();
        let mut cells = Cells::new(mapped.meshes(), &mapped.map);
        let mut sums = [0.0; 2];
        for piece in &mapped.map.pieces {
            for cell in cells.of(piece) {
                sums.iter_mut().zip(cell.areas).for_each(|(sum, area)| *sum += area);
            }
        }
        for (sum, mesh) in sums.into_iter().zip(mapped.meshes()) {
            assert!((sum / mesh.area() - 1.0).abs() < 1e-9, "{sum}");
        }
    }

    #[test]
    fn products_are_integrated_exactly() {
        // Over the triangle (0, 0), (1, 0), (0, 1): x y has the integral 1/24, x x has 1/12.
        let [x, y] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!((integral_of_product(0.5, x, y) - 1.0 / 24.0).abs() < 1e-16);
        assert!((integral_of_product(0.5, x, x) - 1.0 / 12.0).abs() < 1e-16);
    }
}
