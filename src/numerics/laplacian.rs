//! Systems of a graph's Laplacian solved by preconditioned conjugate gradients.

use super::approximate_cholesky::ApproximateCholesky;
use super::graph::Graph;

/// Reusable memory of [`LaplacianCg::solve`].
#[derive(Clone, Debug, Default)]
pub struct LaplacianCg {
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    preconditioned: Vec<f64>,
}

impl LaplacianCg {
    /// Solves L x = b for the x of mean 0, to |b - L x| <= `tolerance` |b| or `limit` iterations; returns the iterations.
    ///
    /// The mean of b is taken out first. The graph should be connected.
    pub fn solve(
        &mut self,
        graph: &Graph,
        preconditioner: &ApproximateCholesky,
        (b, x): (&[f64], &mut [f64]),
        (tolerance, limit): (f64, usize),
    ) -> usize {
        let n = b.len();
        for memory in [&mut self.residual, &mut self.direction, &mut self.image, &mut self.preconditioned] {
            memory.resize(n, 0.0);
        }
        x.fill(0.0);
        self.residual.copy_from_slice(b);
        remove_mean(&mut self.residual);
        let goal = tolerance * tolerance * dot(&self.residual, &self.residual);
        if goal == 0.0 {
            return 0;
        }
        preconditioner.apply(&self.residual, &mut self.preconditioned);
        remove_mean(&mut self.preconditioned);
        self.direction.copy_from_slice(&self.preconditioned);
        let mut rho = dot(&self.residual, &self.preconditioned);
        for iteration in 0..limit {
            graph.multiply(&self.direction, &mut self.image);
            let curvature = dot(&self.direction, &self.image);
            if curvature.is_nan() || curvature <= 0.0 {
                return iteration;
            }
            let step = rho / curvature;
            for i in 0..n {
                x[i] += step * self.direction[i];
                self.residual[i] -= step * self.image[i];
            }
            if dot(&self.residual, &self.residual) <= goal {
                remove_mean(x);
                return iteration + 1;
            }
            remove_mean(&mut self.residual);
            preconditioner.apply(&self.residual, &mut self.preconditioned);
            remove_mean(&mut self.preconditioned);
            let next = dot(&self.residual, &self.preconditioned);
            let ratio = next / rho;
            rho = next;
            for i in 0..n {
                self.direction[i] = self.preconditioned[i] + ratio * self.direction[i];
            }
        }
        remove_mean(x);
        limit
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn remove_mean(x: &mut [f64]) {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    x.iter_mut().for_each(|v| *v -= mean);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid with weights over six orders of magnitude.
    fn grid(n: u32) -> Graph {
        let weight = |k: u32| 10_f64.powi((k * 7919 % 7) as i32 - 3);
        let mut edges = Vec::new();
        for i in 0..n {
            for j in 0..n {
                let at = i * n + j;
                if j + 1 < n {
                    edges.push((at, at + 1, weight(at)));
                }
                if i + 1 < n {
                    edges.push((at, at + n, weight(at + 3)));
                }
            }
        }
        Graph { vertices: (n * n) as usize, edges }
    }

    #[test]
    fn the_solution_satisfies_the_system() {
        let graph = grid(60);
        let preconditioner = ApproximateCholesky::new(&graph);
        let n = graph.vertices;
        let mut b: Vec<f64> = (0..n).map(|i| (i % 17) as f64 - 8.0).collect();
        remove_mean(&mut b);
        let (mut x, mut lx) = (vec![0.0; n], vec![0.0; n]);
        let iterations = LaplacianCg::default().solve(&graph, &preconditioner, (&b, &mut x), (1e-10, 200));
        graph.multiply(&x, &mut lx);
        let error: f64 = lx.iter().zip(&b).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt();
        assert!(error < 1e-8 * dot(&b, &b).sqrt(), "{error}");
        assert!(iterations < 60, "{iterations}");
        assert!(x.iter().sum::<f64>().abs() < 1e-6);
    }

    #[test]
    fn on_a_tree_the_factorisation_is_exact() {
        let edges = (1..500_u32).map(|i| ((i - 1) / 3, i, 1.0 + f64::from(i % 5))).collect();
        let graph = Graph { vertices: 500, edges };
        let preconditioner = ApproximateCholesky::new(&graph);
        let b: Vec<f64> = (0..500).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let mut x = vec![0.0; 500];
        let iterations = LaplacianCg::default().solve(&graph, &preconditioner, (&b, &mut x), (1e-10, 50));
        assert!(iterations <= 2, "{iterations}");
    }

    #[test]
    fn two_factorisations_agree_bit_for_bit() {
        let graph = grid(20);
        let b: Vec<f64> = (0..400).map(f64::from).collect();
        let image = || {
            let mut y = vec![0.0; 400];
            ApproximateCholesky::new(&graph).apply(&b, &mut y);
            y
        };
        assert_eq!(image(), image());
    }
}
