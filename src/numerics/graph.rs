//! Weighted graphs and their Laplacians.

use super::conjugate_gradients::LinearOperator;

/// A weighted graph; parallel edges add up.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// Number of vertices.
    pub vertices: usize,
    /// Ends and weight (not negative) of each edge; the ends differ.
    pub edges: Vec<(u32, u32, f64)>,
}

/// The Laplacian L: (L x)_i is the sum over edges ij of w_ij (x_i - x_j). The graph should be connected: then only constants
/// are in the kernel.
impl LinearOperator<f64> for Graph {
    fn apply(&self, x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for &(i, j, w) in &self.edges {
            let flow = w * (x[i as usize] - x[j as usize]);
            y[i as usize] += flow;
            y[j as usize] -= flow;
        }
    }

    /// Subtracts the mean.
    fn leave_kernel(&self, x: &mut [f64]) {
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        x.iter_mut().for_each(|v| *v -= mean);
    }
}
