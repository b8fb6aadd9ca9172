//! Smooth tubes with elliptic sections through given nodes.

use super::body::{Section, Solid};
use crate::math::scalar::max;
use glam::{DVec2, DVec3};

/// The approximate length of the straight pieces from node to node, in units of the tube's radius there.
const PIECE: f64 = 0.10;
/// The length of a direction, in units of that it was made of, below which it is rounding.
const ROUNDING: f64 = 1e-6;

/// A section of a tube.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub centre: DVec3,
    /// Half the height perpendicular to `across` and the tube.
    pub height: f64,
    /// Half the width along `across`.
    pub width: f64,
    /// The direction of the width; its component along the tube is ignored.
    pub across: DVec3,
}

impl Node {
    /// A round section.
    pub fn round(centre: DVec3, radius: f64) -> Self {
        Self { centre, height: radius, width: radius, across: DVec3::Z }
    }
}

/// The tube through nodes (a Catmull-Rom spline), cut into straight pieces.
pub(super) fn tube(nodes: &[Node]) -> Vec<Solid> {
    let mut sampled = Vec::new();
    for k in 0..nodes.len() - 1 {
        let around = [k.saturating_sub(1), k, k + 1, (k + 2).min(nodes.len() - 1)].map(|i| nodes[i]);
        let [_, a, b, _] = around;
        let pieces = a.centre.distance(b.centre) / (PIECE * (a.height + b.height));
        let pieces = pieces.ceil().clamp(2.0, 10.0) as usize;
        sampled.extend((0..pieces).map(|i| between(around, i as f64 / pieces as f64)));
    }
    sampled.extend(nodes.last().copied());
    sampled.windows(2).map(|ends| piece(ends[0], ends[1])).collect()
}

fn piece(a: Node, b: Node) -> Solid {
    let axis = (b.centre - a.centre).normalize();
    let across = a.across + b.across;
    let perpendicular = across - axis * across.dot(axis);
    // Of a width along the tube nothing is left but rounding.
    let across = if perpendicular.length() > ROUNDING {
        perpendicular.normalize()
    } else {
        axis.any_orthonormal_vector()
    };
    let sizes = [a, b].map(|node| DVec2::new(node.width, node.height));
    Solid::Section(Section::new([a.centre, b.centre], sizes, across))
}

/// The section between the middle two of four nodes.
fn between(nodes: [Node; 4], t: f64) -> Node {
    let weights = [
        0.5 * t * (-1.0 + t * (2.0 - t)),
        0.5 * (2.0 + t * t * (-5.0 + 3.0 * t)),
        0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
        0.5 * t * t * (t - 1.0),
    ];
    let mean = |of: fn(&Node) -> DVec3| nodes.iter().zip(weights).map(|(n, w)| of(n) * w).sum::<DVec3>();
    let number = |of: fn(&Node) -> f64| {
        let least = 0.5 * nodes[1..3].iter().map(of).fold(f64::INFINITY, f64::min);
        max(nodes.iter().zip(weights).map(|(n, w)| of(n) * w).sum(), least)
    };
    Node {
        centre: mean(|n| n.centre),
        height: number(|n| n.height),
        width: number(|n| n.width),
        across: nodes[1].across.lerp(nodes[2].across, t),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demo::body::{Body, Part};

    #[test]
    fn a_tube_has_its_nodes_sections() {
        let node = |x: f64, y: f64, height: f64, width: f64| Node {
            centre: DVec3::new(x, y, 0.0),
            height,
            width,
            across: DVec3::Z,
        };
        let nodes = [node(0.0, 0.0, 0.2, 0.1), node(0.5, 0.2, 0.15, 0.2), node(1.0, 0.0, 0.1, 0.1)];
        let body = Body::new(vec![Part::join(tube(&nodes), 0.05, 0.03)]);
        // The tube is level at its middle node.
        for (direction, reach) in [(DVec3::Y, 0.15), (-DVec3::Y, 0.15), (DVec3::Z, 0.2), (-DVec3::Z, 0.2)] {
            let value = body.value(nodes[1].centre + direction * reach);
            assert!(value.abs() < 0.004, "{direction}: {value}");
        }
    }

    #[test]
    fn a_tube_along_the_direction_of_its_width_is_round() {
        // Along the width to the last bit, and but for rounding.
        for along in [DVec3::Z, DVec3::new(1e-17, -3e-17, 1.0).normalize()] {
            let nodes = [0.0, 0.3, 1.0].map(|t| Node::round(t * along, 0.1));
            let body = Body::new(vec![Part::join(tube(&nodes), 0.05, 0.03)]);
            for (at, value) in [([0.15, 0.0, 0.5], 0.05), ([0.0, -0.14, 0.4], 0.04), ([0.0, 0.0, 1.15], 0.05)]
            {
                assert!((body.value(at.into()) - value).abs() < 0.004, "{at:?}");
            }
        }
    }
}
