//! The share of each mesh's skin that is mapped onto skin, where holes were closed by caps.

/// Areas of skin under a map between two meshes with caps, summed over its pieces.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::surface_map) struct SkinAreas {
    /// The area of each mesh's skin, source first.
    skin: [f64; 2],
    /// The area of each mesh's skin that is mapped onto skin, source first.
    shared: [f64; 2],
}

/// Shares of the skin, 0 to 1, that are mapped onto skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// The share of the source's skin whose image is skin.
    pub source: f64,
    /// The share of the target's skin whose preimage is skin.
    pub target: f64,
}

impl Coverage {
    /// The share of skin that is mapped onto a cap, 0 to 1: the mean of both meshes.
    pub fn hidden(&self) -> f64 {
        1.0 - 0.5 * (self.source + self.target)
    }
}

impl SkinAreas {
    /// Sums up pieces, each given by whether its faces are skin and by its areas, source first.
    pub(in crate::surface_map) fn of(pieces: impl Iterator<Item = ([bool; 2], [f64; 2])>) -> Self {
        let mut sums = Self::default();
        for (is_skin, areas) in pieces {
            for k in (0..2).filter(|&k| is_skin[k]) {
                sums.skin[k] += areas[k];
                if is_skin[1 - k] {
                    sums.shared[k] += areas[k];
                }
            }
        }
        sums
    }

    /// The area of each mesh's skin that is mapped onto skin, source first.
    pub(in crate::surface_map) fn shared(&self) -> [f64; 2] {
        self.shared
    }

    pub(in crate::surface_map) fn coverage(&self) -> Coverage {
        let [source, target] = [0, 1].map(|k| self.shared[k] / self.skin[k]);
        Coverage { source, target }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn skin_over_a_cap_has_no_partner() {
        let pieces = [
            ([true, true], [0.5, 0.6]),
            ([true, false], [0.3, 0.1]),
            ([false, true], [0.1, 0.2]),
            ([false, false], [0.1, 0.1]),
        ];
        let areas = SkinAreas::of(pieces.into_iter());
        assert_eq!(areas.shared(), [0.5, 0.6]);
        let coverage = areas.coverage();
        assert!((coverage.source - 0.5 / 0.8).abs() < 1e-15 && (coverage.target - 0.6 / 0.8).abs() < 1e-15);
        assert!((coverage.hidden() - (0.375 + 0.25) / 2.0).abs() < 1e-15);
    }
}
