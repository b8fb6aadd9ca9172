//! Colours of landmarks and of scales, linear red, green and blue from 0 to 1.

/// A colour as style sheets write it: eight bits of red, green and blue.
type Hex = u32;

/// Colours that can be told apart, also by the colour-blind: each is the farthest from all before it (and from the grounds and
/// the surface), by the least of the distances in OKLab as people with full colour vision and without one kind of cones see
/// them (Machado, Oliveira and Fernandes 2009). The first are the clearest.
const LANDMARKS: [Hex; 40] = [
    0xd7263d, 0x2f7fe0, 0xf5c400, 0x1c9a56, 0x5e0086, 0x0d00e4, 0x791b00, 0x6bbcff, 0x944386, 0xd786ae,
    0x5effa1, 0x433651, 0x94ae00, 0xe41bbc, 0x007900, 0x1b51ff, 0xf2c9f2, 0xffa186, 0xf2f200, 0x860dae,
    0x8694ff, 0x51795e, 0x6b4351, 0xd75194, 0xf26b79, 0x28aed7, 0xbc791b, 0x5e3679, 0x284328, 0x866bbc,
    0xa1bcd7, 0xa1e46b, 0x79430d, 0x5ec95e, 0x1bd7a1, 0x1b8694, 0xbce4c9, 0x6b43d7, 0xae5eff, 0xff0079,
];

/// The map cividis at ten even places, the lightest first (Nuñez, Anderton and Renslow, "Optimizing colormaps with consideration
/// for color vision deficiency", 2018): equal steps look equal, also to the colour-blind and in grey.
const CIVIDIS: [Hex; 10] =
    [0xffea46, 0xe4cf5b, 0xc4b56c, 0xa69d75, 0x8a8779, 0x707173, 0x575c6d, 0x39486b, 0x00336f, 0x00204d];

/// The map `PuOr` at ten even places, reversed: from what shrinks to what grows (ColorBrewer), told apart also by the colour-blind.
const SHRINKING_TO_GROWING: [Hex; SCALE_COLOURS] =
    [0x2d004b, 0x542788, 0x8073ac, 0xb2abd2, 0xd8daeb, 0xfee0b6, 0xfdb863, 0xe08214, 0xb35806, 0x7f3b08];

/// Number of colours on a scale.
pub const SCALE_COLOURS: usize = CIVIDIS.len();

/// The colour of a landmark by its number, from 0; after 40 they begin again.
pub fn landmark_colour(k: usize) -> [f32; 3] {
    linear(LANDMARKS[k % LANDMARKS.len()])
}

/// Colours from little to much, at even steps.
pub fn rising_scale() -> [[f32; 3]; SCALE_COLOURS] {
    CIVIDIS.map(linear)
}

/// Colours of factors of length, at even steps of the logarithm: from those that shrink to those that grow.
pub fn factor_scale() -> [[f32; 3]; SCALE_COLOURS] {
    SHRINKING_TO_GROWING.map(linear)
}

/// The standard's transfer function (IEC 61966-2-1) undone.
pub(super) fn linear(hex: Hex) -> [f32; 3] {
    [16, 8, 0].map(|shift| {
        let c = (hex >> shift & 0xff) as f32 / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_landmarks_have_colours_that_are_alike() {
        for k in 0..LANDMARKS.len() {
            for l in 0..k {
                let [a, b] = [k, l].map(|m| LANDMARKS[m].to_be_bytes().map(f32::from));
                let distance: f32 = (1..4).map(|c| (a[c] - b[c]).abs()).sum();
                assert!(distance > 30.0, "{k} {l}");
            }
        }
        assert_eq!(landmark_colour(3), landmark_colour(43));
    }

    #[test]
    fn the_scale_darkens_evenly() {
        let light = rising_scale().map(|[r, g, b]| (0.2126 * r + 0.7152 * g + 0.0722 * b).cbrt());
        let steps: Vec<f32> = light.windows(2).map(|w| w[0] - w[1]).collect();
        assert!(steps.iter().all(|step| (0.02..0.12).contains(step)), "{steps:?}");
    }

    #[test]
    fn factors_are_lightest_in_the_middle_and_warm_where_they_grow() {
        let light = factor_scale().map(|[r, g, b]| 0.2126 * r + 0.7152 * g + 0.0722 * b);
        assert!(light[..5].is_sorted() && light[5..].iter().rev().is_sorted(), "{light:?}");
        assert!(factor_scale()[..5].iter().all(|[r, _, b]| b > r));
        assert!(factor_scale()[5..].iter().all(|[r, _, b]| r > b));
    }

    #[test]
    fn grey_and_white_are_linear() {
        assert_eq!(linear(0xffffff), [1.0; 3]);
        assert!((linear(0x808080)[0] - 0.2159).abs() < 1e-3);
    }
}
