//! The pieces of a map between two meshes.

use crate::landmarks::MeshSide;
use crate::math::matrix2::invertible;
use crate::math::triangle::signed_double_area;
use crate::mesh::{Carrier, FaceId, Place, SurfaceMesh, SurfacePoint, VertexId};
use crate::monitor::{Cancelled, Monitor, Pulse};
use crate::surface_map::measures::distortion::is_certain;
use crate::surface_map::overlay::{Overlay, OverlayPoint, Piece};
use crate::surface_map::parametrisation::embedding::Parametrised;
use glam::{DMat2, DVec2};
use std::ops::Range;
use typed_index_collections::TiVec;

/// A map between two meshes, given on pieces that cover each mesh once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Correspondence {
    /// Every corner of a piece: its place on the source and on the target.
    pub vertices: Vec<[Place; 2]>,
    /// Convex polygons on which the map is affine.
    pub pieces: Vec<MappedPiece>,
    /// Corners of all pieces: numbers in `vertices`, counter-clockwise on both meshes.
    pub corners: Vec<u32>,
}

/// A convex polygon inside one source face and one target face.
#[derive(Clone, Debug, PartialEq)]
pub struct MappedPiece {
    /// Face of the source, face of the target.
    pub faces: [FaceId; 2],
    /// Its corners in [`Correspondence::corners`]; two only where two edges coincide.
    pub corners: Range<usize>,
    /// The linear part of the affine map on the piece, from barycentric coordinates 1 and 2 in the source face to those in the target
    /// face. Its determinant is positive.
    pub map: DMat2,
    /// Whether the piece is larger than rounding; one that is not may be an artefact of rounding, and maxima leave it out.
    pub is_certain: bool,
}

impl MappedPiece {
    /// The linear part of the map from one mesh to the other: `map`, or its inverse.
    pub fn map_from(&self, side: MeshSide) -> DMat2 {
        match side {
            MeshSide::Source => self.map,
            MeshSide::Target => self.map.inverse(),
        }
    }
}

/// The matrix of a piece that is thinner than this, in barycentric coordinates of its faces, is not taken from its corners: rounding of
/// these by 1e-16 changes it by more than 1e-12.
const THIN: f64 = 1e-4;

/// Pieces between two questions to the monitor: some milliseconds.
const ASKED_EVERY: usize = 16_384;

impl Correspondence {
    /// The pieces of an overlay, with places on the meshes that were overlaid.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn of_overlay(
        [source, target]: [Parametrised<'_>; 2],
        overlay: &Overlay,
        monitor: &mut dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let mut places: Vec<Option<[Place; 2]>> = vec![None; overlay.vertex_count];
        let [from, onto] = [source, target].map(|side| {
            side.mesh
                .faces()
                .map(|f| edge_vectors(side.embedding.triangle(f)))
                .collect::<TiVec<FaceId, DMat2>>()
        });
        let mut corners = Vec::with_capacity(overlay.points.len());
        let mut pieces = Vec::with_capacity(overlay.pieces.len());
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        for piece in &overlay.pieces {
            pulse.beat()?;
            let Piece { source_face, target_face, motion, .. } = piece;
            let begin = corners.len();
            for point in &overlay.points[piece.points.clone()] {
                let OverlayPoint { source: at_source, target: at_target, vertex, .. } = *point;
                places[vertex as usize].get_or_insert_with(|| {
                    let on = |mesh: &SurfaceMesh, face: FaceId, barycentric| {
                        Place::of(mesh, SurfacePoint { face, barycentric })
                    };
                    [on(source.mesh, *source_face, at_source), on(target.mesh, *target_face, at_target)]
                });
                corners.push(vertex);
            }
            let triangles =
                [source.embedding.triangle(*source_face), target.embedding.triangle(*target_face)];
            pieces.push(MappedPiece {
                faces: [*source_face, *target_face],
                corners: begin..corners.len(),
                map: invertible(onto[*target_face].inverse() * motion.turn() * from[*source_face]),
                is_certain: is_certain(piece.area, [&triangles[0], &triangles[1]]),
            });
        }
        // Every vertex of an overlay is a corner of its pieces.
        let vertices = places.into_iter().map(|p| p.unwrap_or([Place::Vertex(VertexId(0)); 2])).collect();
        Ok(Self { vertices, pieces, corners })
    }

    /// The same map with places on the meshes that its meshes refine.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn carried(&self, carriers: [Carrier<'_>; 2], monitor: &mut dyn Monitor) -> Result<Self, Cancelled> {
        let carry = |places: &[Place; 2]| [carriers[0].place(places[0]), carriers[1].place(places[1])];
        let piece = |piece: &MappedPiece| {
            let [from, onto] = MeshSide::BOTH.map(|side| (carriers[side].frame)(piece.faces[side]));
            MappedPiece {
                faces: [from.face, onto.face],
                map: invertible(onto.matrix() * piece.map * from.matrix().inverse()),
                ..piece.clone()
            }
        };
        let mut pulse = Pulse::new(monitor, ASKED_EVERY);
        let mut vertices = Vec::with_capacity(self.vertices.len());
        for places in &self.vertices {
            pulse.beat()?;
            vertices.push(carry(places));
        }
        let mut pieces = Vec::with_capacity(self.pieces.len());
        for given in &self.pieces {
            pulse.beat()?;
            pieces.push(piece(given));
        }
        Ok(Self { vertices, pieces, corners: self.corners.clone() })
    }

    /// Fills `ring` with barycentric coordinates 1 and 2 of the corners of a piece, in its face of one mesh.
    ///
    /// Corners that do not lie in the face, which [`super::check`] refuses, are left out.
    pub fn ring(&self, mesh: &SurfaceMesh, side: MeshSide, piece: &MappedPiece, ring: &mut Vec<DVec2>) {
        ring.clear();
        let weights = |&v: &u32| self.vertices[v as usize][side].weights_in(mesh, piece.faces[side]);
        let places = self.corners[piece.corners.clone()].iter().filter_map(weights);
        ring.extend(places.map(|[_, x, y]| DVec2::new(x, y)));
    }

    /// The image of each source vertex, or the preimage of each target vertex: of the vertices of the mesh `from`.
    pub fn vertex_images(
        &self,
        meshes: [&SurfaceMesh; 2],
        from: MeshSide,
    ) -> TiVec<VertexId, Option<SurfacePoint>> {
        let onto = from.other();
        let mut images: TiVec<VertexId, _> = meshes[from].vertices().map(|_| None).collect();
        for places in &self.vertices {
            if let Place::Vertex(v) = places[from] {
                images[v] = Some(places[onto].surface_point(meshes[onto]));
            }
        }
        images
    }
}

/// The vectors from the first corner of a triangle to the others.
fn edge_vectors([p, q, r]: [DVec2; 3]) -> DMat2 {
    DMat2::from_cols(q - p, r - p)
}

/// The matrix of a piece from the barycentric coordinates of its corners in both faces; `None` where the piece is too thin for that.
///
/// It is that of the triangle of corners with the largest area on the source, the first one where several are as large.
pub fn matrix_of_corners(source: &[DVec2], target: &[DVec2]) -> Option<DMat2> {
    let n = source.len();
    let double_area = |ring: &[DVec2], [i, j, k]: [usize; 3]| signed_double_area(ring[i], ring[j], ring[k]);
    let mut best = (0.0, [0; 3]);
    for i in 0..n {
        for j in i + 1..n {
            for k in j + 1..n {
                let area = double_area(source, [i, j, k]);
                if area > best.0 {
                    best = (area, [i, j, k]);
                }
            }
        }
    }
    let (area, corners) = best;
    let height = |area: f64, ring: &[DVec2]| {
        let [p, q, r] = corners.map(|k| ring[k]);
        area / p.distance(q).max(q.distance(r)).max(r.distance(p))
    };
    // A piece without area has no height: 0 / 0 counts as thin.
    let is_thick = |area: f64, ring: &[DVec2]| area > 0.0 && height(area, ring) >= THIN;
    if n < 3 || !is_thick(area, source) || !is_thick(double_area(target, corners), target) {
        return None;
    }
    let [from, onto] = [source, target].map(|ring| edge_vectors(corners.map(|k| ring[k])));
    Some(onto * from.inverse())
}

/// Twice the signed area of a polygon; in barycentric coordinates 1 and 2 of a face, the share of the face that it covers.
pub(crate) fn share(ring: &[DVec2]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    ring.windows(2).map(|w| signed_double_area(origin, w[0], w[1])).sum()
}
