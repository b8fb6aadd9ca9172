//! Warnings about a result, with sentences for the user.

use super::{BorderCase, Borders, BordersReport};
use crate::landmarks::MeshSide;
use serde::Serialize;
use std::fmt;

/// A warning about a result; in reports a [`WarningReport`].
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(into = "WarningReport")]
#[non_exhaustive]
pub enum Warning {
    /// A mesh was repaired before it was mapped.
    Repaired {
        /// The mesh.
        side: MeshSide,
        /// The changes, in words.
        changes: String,
    },
    /// Holes of a mesh were closed by caps, which take part in the map.
    Capped {
        /// The mesh.
        side: MeshSide,
        /// Share of the mapped surface's area that is caps.
        share: f64,
    },
    /// Rims of both meshes were guessed to correspond.
    GuessedBorders {
        /// Number of rims of each mesh.
        rims: usize,
    },
    /// No rims of both meshes correspond, though the user said that they do.
    NoCorrespondingBorders,
    /// The landmark file may not belong to the meshes.
    LandmarkFile {
        /// The reason for the doubt.
        remark: String,
    },
    /// The result was asked for before the map was relaxed as far as usual.
    FinishedEarly {
        /// Its energy; 4 for an isometry.
        energy: f64,
    },
    /// Another class of maps is nearly as good.
    RivalClass {
        /// Its mean log density relative to that of the class chosen.
        ratio: f64,
    },
    /// A path of the layout is much longer than the shortest one.
    LongPath {
        /// The ratio of both lengths.
        stretch: f64,
    },
    /// 5 % of the surface is strongly distorted.
    Distorted {
        /// The 95 % quantile of the density; 1 for an isometry.
        p95: f64,
    },
    /// A flow failed: the map is not affected, but the cone metric of the mesh, and for the target the texture, is missing.
    NoConeMetric {
        /// The mesh.
        side: MeshSide,
        /// The error of the flow.
        reason: String,
    },
    /// There was no time for a flow: the cone metric of the mesh, and for the target the texture, is missing.
    NoTimeForConeMetric {
        /// The mesh.
        side: MeshSide,
    },
    /// The map has no overlay: it is shown and measured at the source's vertices only.
    NoOverlay {
        /// The error of the overlay.
        reason: String,
    },
    /// There was no time for the overlay: the map is shown and measured at the source's vertices only.
    NoTimeForOverlay,
    /// The method guarantees no bijection.
    NoBijection,
    /// Rounding kept the map from being one-to-one everywhere (the method of Tutte).
    NotCertified {
        /// The faults that the certificate found.
        reason: String,
    },
    /// Triangles of the base domain are inverted in the flat metrics (the thesis' method).
    InvertedPatches {
        /// Their number on the source.
        source: usize,
        /// Their number on the target.
        target: usize,
    },
    /// Vertices of the source have no image (the methods that map patch by patch).
    Unmapped {
        /// Their share of the source's vertices, 0 to 1.
        share: f64,
    },
}

impl Warning {
    /// The warning about the borders of both meshes; `None` where they are as the user said.
    pub(super) fn of_borders(report: &BordersReport) -> Option<Self> {
        match (report.asked, report.case) {
            (Borders::Guess, BorderCase::Corresponding) => {
                Some(Self::GuessedBorders { rims: report.rims.len() })
            }
            (Borders::Corresponding, BorderCase::Missing) => Some(Self::NoCorrespondingBorders),
            _ => None,
        }
    }

    /// A stable name for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Repaired { .. } => "repaired",
            Self::Capped { .. } => "capped",
            Self::GuessedBorders { .. } => "guessed_borders",
            Self::NoCorrespondingBorders => "no_corresponding_borders",
            Self::LandmarkFile { .. } => "landmark_file",
            Self::FinishedEarly { .. } => "finished_early",
            Self::RivalClass { .. } => "rival_class",
            Self::LongPath { .. } => "long_path",
            Self::Distorted { .. } => "distorted",
            Self::NoConeMetric { .. } | Self::NoTimeForConeMetric { .. } => "no_cone_metric",
            Self::NoOverlay { .. } | Self::NoTimeForOverlay => "no_overlay",
            Self::NoBijection => "no_bijection",
            Self::NotCertified { .. } => "not_certified",
            Self::InvertedPatches { .. } => "inverted_patches",
            Self::Unmapped { .. } => "unmapped",
        }
    }
}

impl fmt::Display for Warning {
    /// A sentence for the user, with what to do.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Repaired { side, changes } => write!(
                f,
                "The {side} could not be mapped as it is and was repaired: {changes}. `conemap check` tells more and writes the \
                 repaired mesh."
            ),
            Self::Capped { side, share } => write!(
                f,
                "{:.2} % of the {side} are caps over its holes: made-up surface. The certificate holds for the surface with its \
                 caps; they count little in the map, and measures are those of skin onto skin.",
                100.0 * share
            ),
            Self::GuessedBorders { rims } => {
                let holes = if *rims == 1 { "One large hole".to_owned() } else { format!("{rims} large holes") };
                write!(
                    f,
                    "{holes} of each mesh have landmarks around them that agree, so both surfaces were taken to end there: rim \
                     goes to rim, and skin under a cap costs. If one of them lacks data there, the option --borders missing \
                     lets its skin go under the cap."
                )
            }
            Self::NoCorrespondingBorders => f.write_str(
                "Borders were said to correspond, but there are no holes on both meshes that could belong to each other; what \
                 lies under caps was taken for unknown.",
            ),
            Self::LandmarkFile { remark } => {
                write!(f, "The landmark file may not fit these meshes: {remark}.")
            }
            Self::FinishedEarly { energy } => write!(
                f,
                "Finished early on request, at energy {energy:.3} (4 is the least): the map is whole and certified, but a \
                 full run would lower its distortion."
            ),
            Self::RivalClass { ratio } => write!(
                f,
                "Another class of maps, which goes another way round some limb, is nearly as good: its mean log distortion is \
                 {ratio:.3} times that of this one. The option for the runner-up (--class runner-up) makes it; one more pair \
                 of landmarks beside the limb decides."
            ),
            Self::LongPath { stretch } => write!(
                f,
                "A path between two landmarks is {stretch:.1} times its shortest length: the map may wind around a limb. \
                 Landmarks nearby, or a look at pairs that could be swapped, may help."
            ),
            Self::Distorted { p95 } => write!(
                f,
                "5 % of the surface is distorted by more than {p95:.1} (1 is none): landmarks on unmarked limbs may help."
            ),
            Self::NoConeMetric { side, reason } => {
                let missing = match side {
                    MeshSide::Source => "its numbers are",
                    MeshSide::Target => "the texture of the target is",
                };
                write!(
                    f,
                    "The map is whole and certified, but the {side} has no cone metric, so {missing} missing: {reason}. Very \
                     thin triangles are a common cause; remeshing the {side} helps."
                )
            }
            Self::NoTimeForConeMetric { side } => {
                let missing = match side {
                    MeshSide::Source => "the cone metric of the source, so its numbers are",
                    MeshSide::Target => "the cone metric of the target and its texture, so the texture is",
                };
                write!(f, "The map is whole and certified, but there was no time for {missing} missing: give more time.")
            }
            Self::NoOverlay { reason } => write!(
                f,
                "The map is whole and certified, but both meshes could not be laid over each other, so it is shown and measured \
                 at the vertices of the source only: {reason}."
            ),
            Self::NoTimeForOverlay => f.write_str(
                "The map is whole and certified, but there was no time to lay both meshes over each other, so it is shown and \
                 measured at the vertices of the source only: give more time.",
            ),
            Self::NoBijection => {
                f.write_str("This method does not guarantee a bijection; the relaxed map does.")
            }
            Self::NotCertified { reason } => write!(
                f,
                "The map is not certified: {reason}. A limb without a landmark shrinks to a point in its patch, where rounding \
                 cannot tell its triangles apart. The relaxed map is certified."
            ),
            Self::InvertedPatches { source, target } => write!(
                f,
                "Triangles of the base domain that come out inverted in the flat metrics: {source} on the source, {target} on \
                 the target."
            ),
            Self::Unmapped { share } => write!(
                f,
                "{:.2} % of the source's vertices have no image: no straight triangle with a counterpart lies over them.",
                100.0 * share
            ),
        }
    }
}

/// A warning in a report.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
pub struct WarningReport {
    /// Its stable name.
    pub kind: &'static str,
    /// A sentence for the user, with what to do.
    pub sentence: String,
    /// The number of its kind, in the unit that the sentence names; `null` where it has none.
    pub value: Option<f64>,
    /// The mesh that it is about; `null` where it is about no single mesh.
    pub side: Option<MeshSide>,
}

impl From<Warning> for WarningReport {
    fn from(warning: Warning) -> Self {
        let (kind, sentence) = (warning.kind(), warning.to_string());
        let (mut value, mut side) = (None, None);
        match warning {
            Warning::FinishedEarly { energy: x }
            | Warning::RivalClass { ratio: x }
            | Warning::LongPath { stretch: x }
            | Warning::Distorted { p95: x }
            | Warning::Unmapped { share: x } => value = Some(x),
            Warning::GuessedBorders { rims } => value = Some(rims as f64),
            Warning::NoConeMetric { side: of, .. }
            | Warning::NoTimeForConeMetric { side: of }
            | Warning::Repaired { side: of, .. } => side = Some(of),
            Warning::Capped { side: of, share } => (value, side) = (Some(share), Some(of)),
            Warning::NoCorrespondingBorders
            | Warning::LandmarkFile { .. }
            | Warning::NoOverlay { .. }
            | Warning::NoTimeForOverlay
            | Warning::NoBijection
            | Warning::NotCertified { .. }
            | Warning::InvertedPatches { .. } => {}
        }
        Self { kind, sentence, value, side }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_are_told_where_they_are_not_what_the_user_said() {
        let of = |case, asked| Warning::of_borders(&BordersReport { case, asked, rims: Vec::new() });
        let (missing, corresponding) = (BorderCase::Missing, BorderCase::Corresponding);
        assert_eq!(of(corresponding, Borders::Guess), Some(Warning::GuessedBorders { rims: 0 }));
        assert_eq!(of(missing, Borders::Corresponding), Some(Warning::NoCorrespondingBorders));
        assert_eq!(of(missing, Borders::Guess), None);
        assert_eq!(of(missing, Borders::Missing), None);
        assert_eq!(of(corresponding, Borders::Corresponding), None);
        let value = serde_json::to_value(Warning::GuessedBorders { rims: 2 }).unwrap();
        assert_eq!((&value["kind"], &value["value"]), (&"guessed_borders".into(), &2.0.into()));
        assert!(
            value["sentence"].as_str().unwrap().starts_with("2 large holes of each mesh have"),
            "{value}"
        );
    }

    #[test]
    fn reports_tell_kind_sentence_and_numbers() {
        let value = serde_json::to_value(Warning::RivalClass { ratio: 1.02 }).unwrap();
        assert_eq!((&value["kind"], &value["value"]), (&"rival_class".into(), &1.02.into()));
        assert!(value["sentence"].as_str().unwrap().contains("1.020 times"), "{value}");
        let reason = "the flow did not converge".to_owned();
        let value = serde_json::to_value(Warning::NoConeMetric { side: MeshSide::Target, reason }).unwrap();
        assert_eq!((&value["side"], &value["value"]), (&"target".into(), &serde_json::Value::Null));
        let sentence = value["sentence"].as_str().unwrap();
        assert!(
            sentence.contains("the texture of the target is missing: the flow did not converge."),
            "{sentence}"
        );
    }
}
