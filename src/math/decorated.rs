//! Diamonds of decorated triangles: inversive distances, flips, tilts (Bobenko & Lutz 2023; Zhang et al. 2014).
//!
//! ```text
//!            k
//!          /   \          one radius per vertex, one inversive distance eta per edge,
//!        /       \        l_ij^2 = eps (gamma_i^2 + gamma_j^2) + 2 eta_ij gamma_i gamma_j
//!      i --------- j      eps = 1: inversive distance circle packing
//!        \       /        eps = 0: vertex scaling
//!          \   /
//!            l
//! ```
//!
//! The circles are vectors of R^{2,1} with Gram matrix eps on the diagonal and -eta off it. Eta does not depend on the
//! radii, so flips happen in a fixed hyperbolic structure, also where Euclidean triangle inequalities fail.

/// Squared length of an edge from its radii and inversive distance.
#[inline]
pub fn squared_length(eps: f64, [gamma_i, gamma_j]: [f64; 2], eta: f64) -> f64 {
    eps * (gamma_i * gamma_i + gamma_j * gamma_j) + 2.0 * eta * gamma_i * gamma_j
}

/// Inversive distance of an edge from its length and radii.
#[inline]
pub fn inversive_distance(eps: f64, [gamma_i, gamma_j]: [f64; 2], length: f64) -> f64 {
    (length * length - eps * (gamma_i * gamma_i + gamma_j * gamma_j)) / (2.0 * gamma_i * gamma_j)
}

/// Height s_k of the apex vector above the span of i and j; `e` is eta_ij, `sides` are eta_ik, eta_jk.
#[inline]
pub fn apex_height(eps: f64, e: f64, [ik, jk]: [f64; 2]) -> f64 {
    (eps + (eps * (ik * ik + jk * jk) + 2.0 * e * ik * jk) / ((e - eps) * (e + eps))).sqrt()
}

/// Eta of the other diagonal kl of a diamond; `k` are eta_ik, eta_jk and `l` are eta_il, eta_jl.
pub fn flipped_inversive_distance(eps: f64, e: f64, k: [f64; 2], l: [f64; 2]) -> f64 {
    let heights = apex_height(eps, e, k) * apex_height(eps, e, l);
    heights + (eps * (k[0] * l[0] + k[1] * l[1]) + e * (k[0] * l[1] + k[1] * l[0])) / ((e - eps) * (e + eps))
}

/// Tilt of the triangle ijk at its edge ij; `inverse` are 1/gamma of i, j and k.
///
/// Edge ij is weighted Delaunay where the tilts of its two triangles sum to at least 0.
#[inline]
pub fn tilt(eps: f64, e: f64, [ik, jk]: [f64; 2], inverse: [f64; 3]) -> f64 {
    let [i, j, k] = inverse;
    let w = (eps * (ik * i + jk * j) + e * (jk * i + ik * j)) / ((e - eps) * (e + eps));
    (w - k) / apex_height(eps, e, [ik, jk])
}

/// Signed distance from the power centre of a triangle to its edge ij, divided by the edge's length: d theta_i / d u_j.
///
/// `lengths` are l_ij, l_jk, l_ki; `gammas` are those of i, j, k; `angle_i` is (cos, sin) of the angle at i.
#[inline]
pub fn half_edge_weight(eps: f64, lengths: [f64; 3], gammas: [f64; 3], (cos_i, sin_i): (f64, f64)) -> f64 {
    let [ij, _, ki] = lengths;
    let [i, j, k] = gammas.map(|g| g * g);
    let foot = (ij * ij + eps * (i - j)) / (2.0 * ij);
    let other_foot = (ki * ki + eps * (i - k)) / (2.0 * ki);
    (other_foot - foot * cos_i) / (sin_i * ij)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn flipping_twice_restores_the_diamond(
            e in 1.05_f64..20.0, ik in 1.05_f64..20.0, jk in 1.05_f64..20.0, il in 1.05_f64..20.0, jl in 1.05_f64..20.0,
            euclidean in proptest::bool::ANY,
        ) {
            let eps = if euclidean { 1.0 } else { 0.0 };
            let kl = flipped_inversive_distance(eps, e, [ik, jk], [il, jl]);
            let back = flipped_inversive_distance(eps, kl, [ik, il], [jk, jl]);
            prop_assert!((back - e).abs() < 1e-8 * e, "{e} -> {kl} -> {back}");
        }

        #[test]
        fn without_circles_a_flip_is_ptolemys_relation(
            e in 0.1_f64..20.0, ik in 0.1_f64..20.0, jk in 0.1_f64..20.0, il in 0.1_f64..20.0, jl in 0.1_f64..20.0,
        ) {
            // eta = l^2 / 2 for unit radii: l_ij l_kl = l_ik l_jl + l_jk l_il.
            let l = |eta: f64| (2.0 * eta).sqrt();
            let kl = flipped_inversive_distance(0.0, e, [ik, jk], [il, jl]);
            prop_assert!((l(e) * l(kl) - (l(ik) * l(jl) + l(jk) * l(il))).abs() < 1e-9 * l(e) * l(kl));
        }

        #[test]
        fn length_and_inversive_distance_are_inverse(gi in 0.1_f64..2.0, gj in 0.1_f64..2.0, eta in 1.0_f64..50.0) {
            let length = squared_length(1.0, [gi, gj], eta).sqrt();
            prop_assert!((inversive_distance(1.0, [gi, gj], length) - eta).abs() < 1e-9 * eta);
        }
    }
}
