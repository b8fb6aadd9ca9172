//! Weighted graphs and their Laplacians.

/// A weighted graph; parallel edges add up.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// Number of vertices.
    pub vertices: usize,
    /// Ends and weight (not negative) of each edge; the ends differ.
    pub edges: Vec<(u32, u32, f64)>,
}

impl Graph {
    /// y = L x with (L x)_i = sum over edges ij of w_ij (x_i - x_j).
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for &(i, j, w) in &self.edges {
            let flow = w * (x[i as usize] - x[j as usize]);
            y[i as usize] += flow;
            y[j as usize] -= flow;
        }
    }
}
