//! The defects of a mesh as they are drawn: each kind has its own colour and its own line, filling or sign, so that nobody needs colours to
//! distinguish them.

use super::buffers::{Frame, LineVertex, PinInstance, SurfaceVertex, Triangles};
use super::colours::linear;
use crate::mesh::repair::{DefectKind, Defects};
use glam::{DVec3, Vec3};
use serde::Serialize;

/// The style of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Stroke {
    /// A line in one piece.
    Solid,
    /// Dashes.
    Dashed,
    /// Points.
    Dotted,
    /// Dashes with points between.
    DashDot,
    /// Two lines beside each other.
    Double,
}

impl Stroke {
    /// The number of the stroke in the shader.
    fn code(self) -> f32 {
        match self {
            Self::Solid => 0.0,
            Self::Dashed => 1.0,
            Self::Dotted => 2.0,
            Self::DashDot => 3.0,
            Self::Double => 4.0,
        }
    }
}

/// The filling of faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Fill {
    /// Stripes that fall to the right.
    Stripes,
    /// Lines that cross.
    Grid,
    /// Points.
    Dots,
    /// Level stripes.
    Bars,
}

impl Fill {
    /// The number of the filling in the shader.
    fn code(self) -> f32 {
        match self {
            Self::Stripes => 0.0,
            Self::Grid => 1.0,
            Self::Dots => 2.0,
            Self::Bars => 3.0,
        }
    }
}

/// The sign at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Sign {
    /// A square on its corner.
    Diamond,
    /// Two crossed bars.
    Cross,
}

impl Sign {
    /// The number of the sign in the shader, among the kinds of pins.
    fn code(self) -> f32 {
        match self {
            Self::Diamond => 4.0,
            Self::Cross => 5.0,
        }
    }
}

/// How a kind of defect is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Look {
    /// Red, green and blue, eight bits each.
    pub colour: u32,
    /// The style of its lines; `None` where it has none.
    pub stroke: Option<Stroke>,
    /// The filling of its faces; `None` where they are not painted.
    pub fill: Option<Fill>,
    /// The sign at its places; `None` where it has none.
    pub sign: Option<Sign>,
}

impl Look {
    /// How a kind is drawn. The colours are those of Okabe and Ito, which the colour-blind tell apart, and two darker ones.
    pub fn of(kind: DefectKind) -> Self {
        let line = |colour, stroke| Self { colour, stroke: Some(stroke), fill: None, sign: None };
        let faces = |colour, fill| Self { colour, stroke: None, fill: Some(fill), sign: None };
        let places = |colour, sign| Self { colour, stroke: None, fill: None, sign: Some(sign) };
        match kind {
            DefectKind::OpenRim => line(0xd5_5e00, Stroke::Solid),
            DefectKind::CrowdedEdges => line(0xa6_3f8b, Stroke::Double),
            DefectKind::OneSidedSeam => line(0x10_1010, Stroke::Dotted),
            DefectKind::TurnedPatch => {
                Self { stroke: Some(Stroke::Dashed), ..faces(0x00_72b2, Fill::Stripes) }
            }
            DefectKind::LoosePart => faces(0xe3_c800, Fill::Grid),
            DefectKind::HandleLoop => line(0x00_9e73, Stroke::DashDot),
            DefectKind::PinchedVertex => places(0xe6_9f00, Sign::Diamond),
            DefectKind::FaceWithoutArea => places(0x2b_8fc9, Sign::Cross),
            DefectKind::DoubleFace => faces(0x6b_3b12, Fill::Dots),
            DefectKind::StopsFlow => Self { sign: Some(Sign::Diamond), ..faces(0xd0_1c8b, Fill::Bars) },
            DefectKind::Cap => Self { stroke: Some(Stroke::Solid), ..faces(0x7a_7f86, Fill::Bars) },
        }
    }

    /// The colour as linear red, green and blue.
    pub fn linear(&self) -> [f32; 3] {
        linear(self.colour)
    }
}

/// A corner of the ribbon that draws a segment of a marked line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct MarkedLineVertex {
    /// The vertex as that of every line.
    pub line: LineVertex,
    /// Linear red, green, blue.
    pub colour: [f32; 3],
    /// The number of its stroke.
    pub stroke: f32,
    /// Length of the line up to here, in scene units.
    pub along: f32,
}

/// Lines of one colour and stroke.
pub(super) fn marked(
    Triangles { vertices, indices }: Triangles<LineVertex>,
    colour: [f32; 3],
    stroke: f32,
) -> Triangles<MarkedLineVertex> {
    let marked = |line| MarkedLineVertex { line, colour, stroke, along: 0.0 };
    Triangles { vertices: vertices.into_iter().map(marked).collect(), indices }
}

/// Radius of a sign, in pixels of the page.
const SIGN: f32 = 6.0;

/// Defects as buffers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DefectBuffers {
    /// Painted faces; the colour is the image's place, and the number of the filling the first texture coordinate.
    pub faces: Triangles<SurfaceVertex>,
    /// Lines.
    pub lines: Triangles<MarkedLineVertex>,
    /// Signs, at one physical pixel per pixel of the page.
    pub signs: Vec<PinInstance>,
}

/// A frame around all faces of a file.
pub fn frame_of(defects: &Defects) -> Frame {
    Frame::around(defects.triangles.iter().flatten().map(|&v| defects.positions[v as usize]))
}

/// The triangles of the file, none of a cap, as read.
pub fn surface_as_read(defects: &Defects, normals: &[DVec3], frame: &Frame) -> Triangles<SurfaceVertex> {
    let vertex = |(p, n): (&DVec3, &DVec3)| SurfaceVertex {
        position: frame.place(*p).to_array(),
        normal: n.normalize_or(DVec3::Z).as_vec3().to_array(),
        ..SurfaceVertex::default()
    };
    Triangles {
        vertices: defects.positions.iter().zip(normals).map(vertex).collect(),
        indices: defects.triangles.iter().flatten().copied().collect(),
    }
}

/// The buffers in which all defects are drawn.
pub fn painted(defects: &Defects, normals: &[DVec3], frame: &Frame) -> DefectBuffers {
    let mut buffers = DefectBuffers::default();
    let place = |v: u32| frame.place(defects.positions[v as usize]);
    for group in &defects.groups {
        let look = Look::of(group.kind);
        let colour = look.linear();
        for defect in &group.defects {
            if let Some(fill) = look.fill {
                for &face in &defect.faces {
                    for v in defects.triangles[face as usize] {
                        buffers.faces.indices.push(buffers.faces.vertices.len() as u32);
                        buffers.faces.vertices.push(SurfaceVertex {
                            position: place(v).to_array(),
                            normal: normals[v as usize].normalize_or(DVec3::Z).as_vec3().to_array(),
                            uv: [fill.code(), 0.0],
                            image: colour,
                            ..SurfaceVertex::default()
                        });
                    }
                }
            }
            for line in &defect.lines {
                if let Some(stroke) = look.stroke {
                    let line: Vec<Vec3> = line.iter().map(|&v| place(v)).collect();
                    ribbon(&line, colour, stroke, &mut buffers.lines);
                }
                if let (Some(sign), [v]) = (look.sign, &line[..]) {
                    let base = place(*v).to_array();
                    buffers.signs.push(PinInstance {
                        base,
                        colour,
                        radius: SIGN,
                        stem: 0.0,
                        kind: sign.code(),
                    });
                }
            }
        }
    }
    buffers
}

/// A ribbon along a line: four vertices and six indices a segment.
fn ribbon(line: &[Vec3], colour: [f32; 3], stroke: Stroke, to: &mut Triangles<MarkedLineVertex>) {
    let mut length = 0.0;
    for segment in line.windows(2) {
        let ([a, b], begin) = ([segment[0].to_array(), segment[1].to_array()], length);
        length += segment[0].distance(segment[1]);
        let first = to.vertices.len() as u32;
        for (position, other, side, along) in
            [(a, b, 1.0, begin), (a, b, -1.0, begin), (b, a, -2.0, length), (b, a, 2.0, length)]
        {
            let line = LineVertex { position, other, side };
            to.vertices.push(MarkedLineVertex { line, colour, stroke: stroke.code(), along });
        }
        to.indices.extend([0, 1, 2, 2, 1, 3].map(|k| first + k));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::mesh::repair::{RepairOptions, defects};
    use crate::mesh::soup::PolygonSoup;
    use crate::monitor::Silent;

    #[test]
    fn no_two_kinds_look_alike_even_without_colours() {
        let looks = DefectKind::ALL.map(Look::of);
        for (k, a) in looks.iter().enumerate() {
            for b in &looks[k + 1..] {
                assert_ne!((a.stroke, a.fill, a.sign), (b.stroke, b.fill, b.sign));
                assert_ne!(a.colour, b.colour);
            }
        }
    }

    #[test]
    fn rims_become_ribbons_patches_faces_and_vertices_signs() {
        let sphere = icosphere(2);
        let mut polygons: Vec<Vec<u32>> =
            sphere.triangles().iter().map(|t| t.iter().map(|v| v.0).collect()).collect();
        polygons.retain(|polygon| !polygon.contains(&40));
        polygons.iter_mut().filter(|polygon| polygon.contains(&50)).for_each(|polygon| polygon.reverse());
        polygons.push(vec![7, 7, 8]);
        let positions = sphere.positions().iter().copied().collect();
        let soup = PolygonSoup { positions, polygons, ..PolygonSoup::default() };
        let found = defects(&soup, &RepairOptions::default(), &mut Silent).unwrap();
        let (frame, normals) = (frame_of(&found), found.normals());
        let DefectBuffers { faces, lines, signs } = painted(&found, &normals, &frame);
        assert_eq!((faces.vertices.len(), faces.indices.len()), (18, 18));
        assert!(faces.vertices.iter().all(|v| v.image == Look::of(DefectKind::TurnedPatch).linear()));
        // Six edges around the hole and six around the patch.
        assert_eq!((lines.vertices.len(), lines.indices.len()), (48, 72));
        let ends = |k: usize| (lines.vertices[4 * k].along, lines.vertices[4 * k + 2].along);
        assert!((0..5).all(|k| ends(k).1 == ends(k + 1).0) && ends(6).0 == 0.0);
        assert_eq!(signs.len(), 1);
        let Triangles { vertices, indices } = surface_as_read(&found, &normals, &frame);
        assert_eq!((vertices.len(), indices.len()), (162, 3 * soup.polygons.len()));
        assert!(vertices.iter().all(|v| Vec3::from_array(v.position).length() <= 1.0 + 1e-5));
    }
}
