//! Landmarks as pins: a head of constant size on the screen over a thin stem that ends at the place, so that it stays to be seen.

use super::buffers::PinInstance;
use glam::{Vec2, Vec3};
use serde::Deserialize;

/// Radius of a head in pixels of the page.
pub const HEAD: f32 = 5.0;

/// Radius of the head of a pin that is selected or under the pointer.
pub const RAISED_HEAD: f32 = 7.0;

/// From the place to the middle of the head, in pixels of the page.
pub const STEM: f32 = 17.0;

/// The distance beside a stem at which a pointer still takes the pin, in pixels of the page.
const BESIDE_STEM: f32 = 4.0;

/// The emphasis of a pin.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "lowercase")]
pub enum Stand {
    /// A pin as all others.
    #[default]
    Plain,
    /// A pin that is selected, or under the pointer here or in a list.
    Raised,
    /// A pin that is proposed, and is no landmark yet.
    Ghost,
}

/// A landmark of one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// The place, in scene coordinates.
    pub base: Vec3,
    /// Linear red, green, blue.
    pub colour: [f32; 3],
    /// The emphasis of the pin.
    pub stand: Stand,
}

impl Pin {
    /// The pin as it is drawn behind the surface, at this number of physical pixels per pixel of the page.
    pub fn outline(&self, pixel_ratio: f32) -> PinInstance {
        PinInstance { kind: 1.0, ..self.instance(pixel_ratio) }
    }

    /// The pin as it is drawn in front of the surface, at the same scale.
    pub fn instance(&self, pixel_ratio: f32) -> PinInstance {
        let radius = match self.stand {
            Stand::Plain => HEAD,
            Stand::Raised | Stand::Ghost => RAISED_HEAD,
        };
        let kind = match self.stand {
            Stand::Ghost => 3.0,
            Stand::Plain | Stand::Raised => 0.0,
        };
        PinInstance {
            base: self.base.to_array(),
            colour: self.colour,
            radius: radius * pixel_ratio,
            stem: STEM * pixel_ratio,
            kind,
        }
    }
}

/// The distance of a pointer from a pin that stands at `base`, both in pixels of the page with y up; `None` beyond `slack` pixels from its
/// head and beside its stem.
pub fn distance_to_pin(base: Vec2, pointer: Vec2, slack: f32) -> Option<f32> {
    let from_head = (pointer - base - Vec2::new(0.0, STEM)).length() - HEAD;
    let from_stem = (pointer - base - Vec2::new(0.0, (pointer.y - base.y).clamp(0.0, STEM))).length();
    let distance = from_head.max(0.0).min(from_stem);
    (from_head <= slack || from_stem <= BESIDE_STEM).then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pin_is_taken_at_its_head_and_stem_and_nowhere_else() {
        let base = Vec2::new(100.0, 50.0);
        let at = |x: f32, y: f32| distance_to_pin(base, base + Vec2::new(x, y), 3.0);
        assert_eq!(at(0.0, STEM), Some(0.0));
        assert!(at(7.0, STEM).is_some() && at(9.0, STEM).is_none());
        assert!(at(3.0, 6.0).is_some() && at(6.0, 6.0).is_none());
        assert!(at(0.0, 0.0).is_some() && at(0.0, -6.0).is_none());
    }

    #[test]
    fn a_raised_pin_is_larger_and_stands_on_the_same_place() {
        let pin = Pin { base: Vec3::X, colour: [0.1, 0.2, 0.3], stand: Stand::Plain };
        let plain = pin.instance(2.0);
        let raised = Pin { stand: Stand::Raised, ..pin }.outline(2.0);
        assert!(raised.radius > plain.radius && raised.base == plain.base && raised.stem == plain.stem);
        assert_eq!((plain.kind, raised.kind, plain.stem), (0.0, 1.0, 2.0 * STEM));
    }

    #[test]
    fn a_ghost_is_told_from_a_pin_until_the_body_hides_it() {
        let ghost = Pin { base: Vec3::Y, colour: [0.3, 0.2, 0.1], stand: Stand::Ghost };
        let pin = Pin { stand: Stand::Raised, ..ghost };
        assert_ne!(ghost.instance(1.0).kind, pin.instance(1.0).kind);
        assert_eq!(ghost.outline(1.0), pin.outline(1.0));
    }
}
