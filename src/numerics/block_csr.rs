//! Symmetric sparse matrices of 2 x 2 blocks, and symmetric block Gauss-Seidel sweeps as their preconditioner.

use super::conjugate_gradients::{LinearOperator, Preconditioner};
use glam::{DMat2, DVec2};

/// A symmetric matrix of 2 x 2 blocks with a fixed pattern; both triangles are stored.
#[derive(Clone, Debug)]
pub struct BlockCsr {
    /// Start of each row in `columns`, and one past the end.
    starts: Vec<u32>,
    /// Block columns, ascending in each row; the diagonal is always there.
    columns: Vec<u32>,
    /// Place of the diagonal block of each row.
    diagonal: Vec<u32>,
    blocks: Vec<DMat2>,
}

impl BlockCsr {
    /// The pattern of all pairs `(row, column)`; the diagonal is added, duplicates are merged, all blocks zero.
    pub fn with_pattern(rows: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut counts = vec![1_u32; rows + 1];
        counts[rows] = 0;
        pairs.clone().filter(|(i, j)| i != j).for_each(|(i, _)| counts[i as usize] += 1);
        let mut starts = vec![0_u32; rows + 1];
        for i in 0..rows {
            starts[i + 1] = starts[i] + counts[i];
        }
        let mut fill = starts.clone();
        let mut columns = vec![0_u32; starts[rows] as usize];
        let mut put = |i: u32, j: u32| {
            columns[fill[i as usize] as usize] = j;
            fill[i as usize] += 1;
        };
        (0..rows as u32).for_each(|i| put(i, i));
        pairs.filter(|(i, j)| i != j).for_each(|(i, j)| put(i, j));
        Self::merge_duplicates(rows, &starts, columns)
    }

    fn merge_duplicates(rows: usize, loose: &[u32], mut columns: Vec<u32>) -> Self {
        let mut starts = Vec::with_capacity(rows + 1);
        let mut diagonal = Vec::with_capacity(rows);
        let mut end = 0;
        starts.push(0);
        for i in 0..rows {
            let (from, to) = (loose[i] as usize, loose[i + 1] as usize);
            columns[from..to].sort_unstable();
            let row_start = end;
            for k in from..to {
                let column = columns[k];
                if end == row_start || columns[end - 1] != column {
                    if column == i as u32 {
                        diagonal.push(end as u32);
                    }
                    columns[end] = column;
                    end += 1;
                }
            }
            starts.push(end as u32);
        }
        columns.truncate(end);
        let blocks = vec![DMat2::ZERO; end];
        Self { starts, columns, diagonal, blocks }
    }

    /// Number of block rows.
    pub fn rows(&self) -> usize {
        self.diagonal.len()
    }

    /// The place of a block of the pattern, for [`BlockCsr::add_at`].
    ///
    /// # Panics
    /// When the pattern has no such block.
    pub fn place(&self, row: u32, column: u32) -> u32 {
        let start = self.starts[row as usize];
        let columns = &self.columns[start as usize..self.starts[row as usize + 1] as usize];
        start + columns.binary_search(&column).expect("a block of the pattern") as u32
    }

    /// Sets all blocks to zero.
    pub fn clear(&mut self) {
        self.blocks.fill(DMat2::ZERO);
    }

    /// Adds to the block at a place.
    #[inline]
    pub fn add_at(&mut self, place: u32, block: DMat2) {
        self.blocks[place as usize] += block;
    }

    /// Adds to both diagonal entries of each diagonal block `shift` times their mean.
    pub fn regularise(&mut self, shift: f64) {
        for &d in &self.diagonal {
            let block = &mut self.blocks[d as usize];
            let mean = 0.5 * (block.x_axis.x + block.y_axis.y);
            *block += DMat2::from_diagonal(DVec2::splat(shift * mean.max(f64::MIN_POSITIVE)));
        }
    }

    /// The product of a range of a row's blocks and x.
    #[inline]
    fn row_times(&self, [from, to]: [u32; 2], x: &[DVec2]) -> DVec2 {
        let (from, to) = (from as usize, to as usize);
        let row = self.blocks[from..to].iter().zip(&self.columns[from..to]);
        let mut sum = DVec2::ZERO;
        for (block, &column) in row {
            sum += *block * x[column as usize];
        }
        sum
    }

    /// The preconditioner of the present blocks; `memory` takes the inverse diagonal blocks.
    pub fn gauss_seidel<'a>(&'a self, memory: &'a mut Vec<DMat2>) -> GaussSeidel<'a> {
        memory.clear();
        memory.extend(self.diagonal.iter().map(|&d| {
            let block = self.blocks[d as usize];
            if block.determinant() > 0.0 { block.inverse() } else { DMat2::IDENTITY }
        }));
        GaussSeidel { matrix: self, inverse_diagonal: memory }
    }
}

impl LinearOperator<DVec2> for BlockCsr {
    fn apply(&self, x: &[DVec2], y: &mut [DVec2]) {
        for (i, out) in y.iter_mut().enumerate() {
            *out = self.row_times([self.starts[i], self.starts[i + 1]], x);
        }
    }
}

/// Symmetric block Gauss-Seidel: one forward and one backward sweep from zero, exact on the diagonal blocks.
#[derive(Clone, Copy, Debug)]
pub struct GaussSeidel<'a> {
    matrix: &'a BlockCsr,
    inverse_diagonal: &'a [DMat2],
}

impl Preconditioner<DVec2> for GaussSeidel<'_> {
    /// y = (L + D)^-T D (L + D)^-1 x.
    fn precondition(&self, x: &[DVec2], y: &mut [DVec2]) {
        let BlockCsr { starts, diagonal, .. } = self.matrix;
        for i in 0..x.len() {
            let before = self.matrix.row_times([starts[i], diagonal[i]], y);
            y[i] = self.inverse_diagonal[i] * (x[i] - before);
        }
        for i in (0..x.len()).rev() {
            let after = self.matrix.row_times([diagonal[i] + 1, starts[i + 1]], y);
            y[i] -= self.inverse_diagonal[i] * after;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::conjugate_gradients::{CgOptions, CgWorkspace, dot};

    /// The Laplacian of a path with unit springs to the ground at both ends, coupled between the coordinates.
    fn chain(n: u32) -> BlockCsr {
        let pairs: Vec<_> = (1..n).flat_map(|i| [(i, i - 1), (i - 1, i)]).collect();
        let mut matrix = BlockCsr::with_pattern(n as usize, pairs.iter().copied());
        let spring = DMat2::from_cols_array(&[2.0, 0.5, 0.5, 1.0]);
        for i in 0..n {
            matrix.add_at(matrix.place(i, i), spring * 2.0);
        }
        for &(i, j) in &pairs {
            matrix.add_at(matrix.place(i, j), -spring);
        }
        matrix
    }

    #[test]
    fn the_solution_satisfies_the_system() {
        let (matrix, mut memory) = (chain(100), Vec::new());
        let b: Vec<_> = (0..100).map(|i| DVec2::new(f64::from(i % 7) - 3.0, f64::from(i % 5))).collect();
        let (mut x, mut ax) = (vec![DVec2::ZERO; 100], vec![DVec2::ZERO; 100]);
        let options = CgOptions { tolerance: 1e-12, max_iterations: 300 };
        let sweeps = matrix.gauss_seidel(&mut memory);
        let report = CgWorkspace::default().solve(&matrix, &sweeps, &b, &mut x, &options).unwrap();
        assert!(report.iterations < 120, "{report:?}");
        matrix.apply(&x, &mut ax);
        let error = ax.iter().zip(&b).map(|(p, q)| (*p - *q).length()).fold(0.0, f64::max);
        assert!(error < 1e-9, "{error}");
    }

    #[test]
    fn the_preconditioner_is_symmetric() {
        let (matrix, mut memory) = (chain(10), Vec::new());
        let sweeps = matrix.gauss_seidel(&mut memory);
        let unit = |k: usize| {
            let mut e = vec![DVec2::ZERO; 10];
            e[k] = DVec2::new(0.3, 1.0);
            e
        };
        let mut image = vec![DVec2::ZERO; 10];
        for (i, j) in [(0, 9), (3, 4), (2, 7)] {
            sweeps.precondition(&unit(j), &mut image);
            let forth = dot(&unit(i), &image);
            sweeps.precondition(&unit(i), &mut image);
            let back = dot(&unit(j), &image);
            assert!((forth - back).abs() < 1e-14);
        }
    }
}
