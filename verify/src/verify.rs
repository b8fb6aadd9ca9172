//! The proof, step by step.

use crate::complex::{Pieces, check_sphere};
use crate::container::{Container, expect_count};
use crate::exact::Tally;
use crate::header::TargetImage;
use crate::landmarks::{self, Landmarks};
use crate::matrices::{self, Matrices};
use crate::mesh::{GivenMesh, Mesh};
use crate::places;
use crate::refusal::{Refusal, Side};
use crate::tiling::{Doubtful, Map, check_cover, cut};
use std::ops::ControlFlow;

/// The findings about a map that is not refused.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// The numbers of faces of the source and of the target.
    pub faces: [usize; 2],
    /// The number of overlay vertices.
    pub vertices: usize,
    /// The number of pieces.
    pub pieces: usize,
    /// The number of pieces without inside, which two edges make that coincide.
    pub segments: usize,
    /// The number of triangles into which the pieces were cut.
    pub triangles: usize,
    /// Triangles that are not proved to be positive; the map is proved where there are none.
    pub doubtful: Doubtful,
    /// The signs of determinants that were found, and those of them that took integers.
    pub signs: Tally,
    /// The landmark pairs.
    pub landmarks: Landmarks,
    /// The matrices of the pieces.
    pub matrices: Matrices,
    /// Whether the map goes to the mirror image of the target.
    pub is_mirrored: bool,
}

impl Proof {
    /// Whether the map is proved to be one-to-one everywhere. Otherwise it is so outside of the [`Doubtful`] triangles' images.
    pub fn is_exact(&self) -> bool {
        self.doubtful.triangles == 0
    }

    /// The verdict in a sentence.
    pub fn sentence(&self) -> String {
        let image = if self.is_mirrored { "the mirror image of the target" } else { "the target" };
        if self.is_exact() {
            return format!(
                "Proved: the map is one-to-one from the source onto {image}. All {} triangles of its {} pieces are positive on both \
                 meshes in exact arithmetic, and they cover every face once.",
                self.triangles, self.pieces
            );
        }
        let Doubtful { triangles, first_piece, source_share, target_share, .. } = self.doubtful;
        format!(
            "Not proved everywhere: {triangles} of {} triangles have no positive area, within rounding (the first one in piece {}). \
             Outside of them, {:.1e} of the source's area and {:.1e} of the target's, the map is proved to be one-to-one onto {image}.",
            self.triangles,
            first_piece.unwrap_or_default(),
            source_share,
            target_share
        )
    }
}

/// Proves that a map file holds a one-to-one map between two meshes; what that means is said in the crate's documentation.
///
/// `ask` is called some hundred times with the share that is done, and stops the check by returning `Break`.
///
/// # Errors
/// The first [`Refusal`].
pub fn verify(
    map_file: &[u8],
    meshes: [GivenMesh<'_>; 2],
    ask: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Proof, Refusal> {
    let container = Container::open(map_file)?;
    let header = &container.header;
    let [source, target] = meshes;
    let source = checked(source, Side::Source, &header.source.checked_sha256)?;
    let target = checked(target, Side::Target, &header.target.checked_sha256)?;
    let mut go_on = |share: f64| if ask(share).is_break() { Err(Refusal::Stopped) } else { Ok(()) };
    go_on(0.1)?;
    let places =
        [places::read(&container, &source, Side::Source)?, places::read(&container, &target, Side::Target)?];
    expect_count("vertices.target.kinds", places[1].len(), places[0].len())?;
    let pieces = Pieces::read(&container)?;
    go_on(0.2)?;
    check_sphere(&pieces, places[0].len())?;
    go_on(0.3)?;
    let is_mirrored = header.target_image == TargetImage::Mirrored;
    let map = Map { meshes: [&source, &target], places, pieces, is_mirrored };
    let mut tally = Tally::default();
    let cut = cut(&map, &mut tally, &mut |share| ask(0.3 + 0.2 * share))?;
    for side in [0, 1] {
        let done = 0.5 + 0.2 * side as f64;
        check_cover(&map, &cut, side, &mut tally, &mut |share| ask(done + 0.2 * share))?;
    }
    let matrices = matrices::check(&container, &map)?;
    let landmarks = landmarks::check(&header.landmarks.pairs, &map, &mut |share| ask(0.95 + 0.05 * share))?;
    Ok(Proof {
        faces: [source.face_count(), target.face_count()],
        vertices: map.places[0].len(),
        pieces: map.pieces.len(),
        segments: (0..map.pieces.len()).filter(|&p| map.pieces.is_segment(p)).count(),
        triangles: cut.triangles,
        doubtful: cut.doubtful,
        signs: tally,
        landmarks,
        matrices,
        is_mirrored,
    })
}

/// A mesh that is a sphere and that the map file knows.
fn checked<'a>(given: GivenMesh<'a>, side: Side, wanted: &str) -> Result<Mesh<'a>, Refusal> {
    let mesh = Mesh::new(given).map_err(|problem| Refusal::Mesh { side, problem })?;
    let found = mesh.hash();
    if found == wanted {
        return Ok(mesh);
    }
    // What the file says may be anything.
    let wanted = wanted.chars().filter(char::is_ascii_alphanumeric).take(64).collect();
    Err(Refusal::OtherMesh { side, found, wanted })
}
