//! The zero set of a function that is known at the corners of a grid of cubes.
//!
//! Marching tetrahedra, six to a cube, always give a closed manifold.

use glam::DVec3;
use rustc_hash::FxHashMap;

/// The six tetrahedra of a cube around its diagonal 0-7; corner k is at (k & 1, k >> 1 & 1, k >> 2).
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];
/// A grid over a box, with the triangles that were found in it.
pub(super) struct Grid {
    /// The value at each corner, x running fastest: negative inside, and nowhere so near to 0 that vertices would coincide.
    pub values: Vec<f64>,
    /// The number of corners along each axis.
    pub size: [usize; 3],
    low: DVec3,
    cell: f64,
    /// The vertex of the surface on each edge of the grid that the surface crosses.
    crossings: FxHashMap<[u32; 2], u32>,
    pub positions: Vec<DVec3>,
    pub faces: Vec<[u32; 3]>,
}

impl Grid {
    /// A grid that covers a box; all its corners are outside of the surface at first.
    pub fn new([low, high]: [DVec3; 2], cell: f64) -> Self {
        let size = ((high - low) / cell).ceil().to_array().map(|n| n as usize + 2);
        Self {
            values: vec![1.0; size[0] * size[1] * size[2]],
            size,
            low,
            cell,
            crossings: FxHashMap::default(),
            positions: Vec::new(),
            faces: Vec::new(),
        }
    }

    /// The place of a corner.
    pub fn at(&self, [x, y, z]: [usize; 3]) -> DVec3 {
        self.low + DVec3::new(x as f64, y as f64, z as f64) * self.cell
    }

    /// The number of a corner.
    pub fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }

    /// Adds the triangles of all cells: a closed manifold where the values at the box's border are positive.
    pub fn march(&mut self) {
        let [nx, ny, nz] = self.size;
        let steps = [0, 1, nx, nx + 1, nx * ny, nx * ny + 1, nx * ny + nx, nx * ny + nx + 1];
        for z in 0..nz - 1 {
            for y in 0..ny - 1 {
                for x in 0..nx - 1 {
                    let corners = steps.map(|step| (z * ny + y) * nx + x + step);
                    let inside = corners.iter().filter(|&&c| self.values[c] < 0.0).count();
                    if inside != 0 && inside != 8 {
                        for tetrahedron in TETRAHEDRA {
                            self.cut(tetrahedron.map(|k| corners[k]));
                        }
                    }
                }
            }
        }
    }

    /// Adds the triangles of one positively oriented tetrahedron, facing away from the inside.
    fn cut(&mut self, corners: [usize; 4]) {
        let is_inside = corners.map(|c| self.values[c] < 0.0);
        let (mut order, mut inside) = ([0; 4], 0);
        for k in (0..4).filter(|&k| is_inside[k]).chain((0..4).filter(|&k| !is_inside[k])) {
            order[inside] = corners[k];
            inside += 1;
        }
        let inside = is_inside.iter().filter(|b| **b).count();
        let [a, b, c, d] = order;
        let mut at = |a: usize, b: usize| self.crossing(a, b);
        let (first, second) = match inside {
            1 => ([at(a, b), at(a, c), at(a, d)], None),
            2 => {
                let [ac, ad, bc, bd] = [at(a, c), at(a, d), at(b, c), at(b, d)];
                ([ac, ad, bd], Some([ac, bd, bc]))
            }
            3 => ([at(d, a), at(d, b), at(d, c)], None),
            _ => return,
        };
        let outwards = self.place(order[inside]) - self.place(a);
        for mut t in std::iter::once(first).chain(second) {
            let [p, q, r] = t.map(|v| self.positions[v as usize]);
            if (q - p).cross(r - p).dot(outwards) < 0.0 {
                t.swap(1, 2);
            }
            self.faces.push(t);
        }
    }

    /// The place of a corner by its number.
    fn place(&self, corner: usize) -> DVec3 {
        let [nx, ny, _] = self.size;
        self.at([corner % nx, corner / nx % ny, corner / (nx * ny)])
    }

    fn crossing(&mut self, a: usize, b: usize) -> u32 {
        let (a, b) = (a.min(b), a.max(b));
        let next = self.positions.len() as u32;
        let index = *self.crossings.entry([a as u32, b as u32]).or_insert(next);
        if index == next {
            let (va, vb) = (self.values[a], self.values[b]);
            self.positions.push(self.place(a).lerp(self.place(b), va / (va - vb)));
        }
        index
    }
}
