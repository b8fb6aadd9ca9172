//! Tests of the user's own colours and pictures in the GLB of a map: every place in the target's pictures is that of the image point, and
//! pictures stay the same byte for byte.

use conemap::export::vertex_image::Direction;
use conemap::export::{obj, ply};
use conemap::io::appearance;
use conemap::io::landmark_file::{LandmarkFile, LandmarkPoint, write};
use conemap::io::{LookRemark, material_set, read_mesh};
use conemap::job::{Job, JobFiles, LookFiles, MapLook, OutputKind, ReadOptions, TakenMap, TargetImage};
use conemap::landmark_exchange::GivenFile;
use conemap::map_file::MapFile;
use conemap::mesh::generators::{icosphere, midpoint_subdivision, octahedron};
use conemap::mesh::surface_index::SurfaceIndex;
use conemap::mesh::{SurfaceMesh, VertexId};
use conemap::monitor::Silent;
use conemap::pipeline::{Choices, PipelineOptions};
use glam::{DVec2, DVec3};
use serde_json::Value;

/// Bytes that begin like files of pictures; the tests never decode them.
pub const COAT: &[u8] = b"\x89PNG coat";
pub const EYE: &[u8] = b"\xff\xd8\xff\xe0 eye";
const WEBP: &[u8] = b"RIFF....WEBP skin";

pub fn ball() -> SurfaceMesh {
    let fine = (0..2).fold(octahedron(), |mesh, _| midpoint_subdivision(&mesh));
    fine.with_positions(fine.positions().iter().map(|p| p.normalize()).collect())
}

pub fn egg() -> SurfaceMesh {
    let sphere = icosphere(1);
    sphere.with_positions(sphere.positions().iter().map(|p| *p * DVec3::new(1.0, 1.3, 0.9)).collect())
}

/// The place of a face's corner in its picture, which may lie beyond the picture. It is shifted on the half with negative z, so that there
/// is a seam at the equator.
fn place(mesh: &SurfaceMesh, face: usize, corner: usize) -> DVec2 {
    let points = mesh.corners(face.into());
    let shift = if points.iter().map(|p| p.z).sum::<f64>() < 0.0 { 3.5 } else { 0.0 };
    let p = points[corner];
    DVec2::new(0.7 * p.x + 0.2 * p.z + shift, 0.5 * p.y - 0.3)
}

/// The picture of a face; faces with large x have another one.
fn picture(mesh: &SurfaceMesh, face: usize) -> &'static [u8] {
    let is_eye = mesh.corners(face.into()).iter().map(|p| p.x).sum::<f64>() > 1.5;
    if is_eye { EYE } else { COAT }
}

/// An OBJ file of the mesh with places in two pictures.
pub fn pictured(mesh: &SurfaceMesh) -> Vec<u8> {
    let mut text = String::from("mtllib egg.mtl\n") + &String::from_utf8(obj::mesh(mesh)).unwrap();
    text.truncate(text.find("f ").unwrap());
    for (face, corners) in mesh.triangles().iter().enumerate() {
        let material = if picture(mesh, face) == EYE { "eye" } else { "coat" };
        let places = [0, 1, 2].map(|k| place(mesh, face, k));
        places.iter().for_each(|p| text += &format!("vt {} {}\n", p.x, p.y));
        let [a, b, c] = corners.map(|v| v.0 + 1);
        text += &format!("usemtl {material}\nf {a}/-3 {b}/-2 {c}/-1\n");
    }
    text.into_bytes()
}

fn companion(mesh: &[u8]) -> Option<Vec<u8>> {
    let file = |name: &str| match name {
        "egg.mtl" => Some(b"newmtl coat\nmap_Kd coat.png\nnewmtl eye\nmap_Kd eye.jpg\n".to_vec()),
        "coat.png" => Some(COAT.to_vec()),
        "eye.jpg" => Some(EYE.to_vec()),
        _ => None,
    };
    material_set::packed(mesh, file).map(|set| set.bytes)
}

struct Mapped {
    job: Job,
    map: MapFile,
}

/// Landmarks of the ball and the egg, or of its mirror image.
pub fn landmarks(target_image: TargetImage) -> Vec<u8> {
    let (ball, egg) = (ball(), egg());
    let end = |mesh: &SurfaceMesh, axis: DVec3| {
        let along = |v: &VertexId| mesh.positions()[*v].dot(axis);
        LandmarkPoint::Vertex(mesh.vertices().max_by(|v, w| along(v).total_cmp(&along(w))).unwrap().0)
    };
    let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let mirror = DVec3::new(if target_image == TargetImage::Mirrored { -1.0 } else { 1.0 }, 1.0, 1.0);
    let pairs = axes.map(|axis| [end(&ball, axis), end(&egg, axis * mirror)]).to_vec();
    write(&LandmarkFile { pairs, ..LandmarkFile::default() })
}

/// Maps the ball onto the egg, or onto its mirror image.
fn mapped(source: &[u8], target: &[u8], target_image: TargetImage) -> Mapped {
    let landmarks = landmarks(target_image);
    let landmarks = [GivenFile { name: "pairs.json", bytes: &landmarks }];
    let files = JobFiles { source, target, landmarks: &landmarks };
    let job = Job::read(files, ReadOptions::from(target_image), &mut Silent).unwrap();
    let result = job.run(&PipelineOptions::default(), &mut Silent).unwrap();
    let map = job.map_file(&result, &Choices::default()).unwrap();
    Mapped { job, map }
}

/// A GLB that was written.
pub struct Glb {
    document: Value,
    binary: Vec<u8>,
}

impl Glb {
    pub fn new(bytes: &[u8]) -> Self {
        let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
        let document = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        Self { document, binary: bytes[28 + length..].to_vec() }
    }

    fn view(&self, number: &Value) -> &[u8] {
        let view = &self.document["bufferViews"][number.as_u64().unwrap() as usize];
        let [begin, length] = ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
        &self.binary[begin..begin + length]
    }

    fn words(&self, accessor: &Value) -> Vec<[u8; 4]> {
        let accessor = &self.document["accessors"][accessor.as_u64().unwrap() as usize];
        self.view(&accessor["bufferView"]).as_chunks().0.to_vec()
    }

    fn numbers(&self, accessor: &Value) -> Vec<f64> {
        self.words(accessor).into_iter().map(|word| f64::from(f32::from_le_bytes(word))).collect()
    }

    fn indices(&self, accessor: &Value) -> Vec<usize> {
        self.words(accessor).into_iter().map(|word| u32::from_le_bytes(word) as usize).collect()
    }

    pub fn primitives(&self) -> &[Value] {
        self.document["meshes"][0]["primitives"].as_array().unwrap()
    }

    /// The texture of a primitive's material.
    pub fn texture(&self, primitive: &Value) -> &Value {
        let material = &self.document["materials"][primitive["material"].as_u64().unwrap() as usize];
        let number = &material["pbrMetallicRoughness"]["baseColorTexture"]["index"];
        number.as_u64().map_or(&Value::Null, |number| &self.document["textures"][number as usize])
    }

    pub fn image(&self, number: &Value) -> &[u8] {
        self.view(&self.document["images"][number.as_u64().unwrap() as usize]["bufferView"])
    }
}

/// Checks at points inside the triangles of a file that the places in the pictures are those of the images under the map.
fn expect_places_of_images(bytes: &[u8], taken: &TakenMap<'_>) {
    let (glb, source, target) = (Glb::new(bytes), ball(), egg());
    let surface = SurfaceIndex::new(&source);
    let mut seen = 0.0;
    for primitive in glb.primitives() {
        let attributes = &primitive["attributes"];
        let [positions, uvs] = ["POSITION", "TEXCOORD_0"].map(|name| glb.numbers(&attributes[name]));
        let file = glb.image(&glb.texture(primitive)["source"]);
        for corners in glb.indices(&primitive["indices"]).as_chunks::<3>().0 {
            let points = corners.map(|v| DVec3::from_slice(&positions[3 * v..3 * v + 3]));
            let places = corners.map(|v| DVec2::from_slice(&uvs[2 * v..2 * v + 2]));
            let area = 0.5 * (points[1] - points[0]).cross(points[2] - points[0]).length();
            // In f32 it is not certain on which side of a seam a thinner triangle lies.
            if area < 1e-4 {
                continue;
            }
            seen += area;
            for weights in [[0.2, 0.3, 0.5], [0.4, 0.35, 0.25]] {
                let blend3 = |values: [DVec3; 3]| (0..3).map(|k| values[k] * weights[k]).sum::<DVec3>();
                let point = surface.nearest(blend3(points)).point;
                let image = taken.images(Direction::SourceToTarget, &[point])[0].point;
                let face = image.face.index();
                let expected: DVec2 = (0..3).map(|k| place(&target, face, k) * image.barycentric[k]).sum();
                let written: DVec2 = (0..3).map(|k| places[k] * weights[k]).sum();
                // In glTF the rows of a picture go down.
                let written = DVec2::new(written.x, 1.0 - written.y);
                assert!(written.distance(expected) < 2e-5, "{written} {expected}");
                assert_eq!(file, picture(&target, face));
            }
        }
    }
    assert!(seen > 0.98 * source.area(), "{seen}");
}

#[test]
fn the_places_in_the_targets_pictures_are_those_of_the_images() {
    let (source, target) = (obj::mesh(&ball()), pictured(&egg()));
    let set = companion(&target);
    let files = [
        LookFiles { mesh: &source, companion: None },
        LookFiles { mesh: &target, companion: set.as_deref() },
    ];
    for image in [TargetImage::AsGiven, TargetImage::Mirrored] {
        let Mapped { job, map } = mapped(&source, &target, image);
        let look = job.look(files);
        assert_eq!(look.remarks, [vec![], vec![]]);
        let taken = job.taken(&map).wearing(&look);
        let bytes = taken.output(OutputKind::Glb).unwrap();
        assert_eq!(Glb::new(&bytes).primitives().len(), 2);
        expect_places_of_images(&bytes, &taken);
        // A body cannot be morphed into a mirror image.
        if image == TargetImage::AsGiven {
            expect_places_of_images(&taken.morph_glb(&mut Silent).unwrap(), &taken);
        }
    }
}

#[test]
fn colours_of_the_source_are_written_where_the_target_has_none() {
    let plain = String::from_utf8(obj::mesh(&ball())).unwrap();
    let line = |line: &str| match line.strip_prefix("v ").map(|rest| rest.starts_with('-')) {
        Some(true) => format!("{line} 1 0.2 0\n"),
        Some(false) => format!("{line} 0 0.4 1\n"),
        None => format!("{line}\n"),
    };
    let source: String = plain.lines().map(line).collect();
    let target = obj::mesh(&egg());
    let Mapped { job, map } = mapped(source.as_bytes(), &target, TargetImage::AsGiven);
    let files = [source.as_bytes(), &target].map(|mesh| LookFiles { mesh, companion: None });
    let look = job.look(files);
    let bytes = job.taken(&map).wearing(&look).output(OutputKind::Glb).unwrap();
    let glb = Glb::new(&bytes);
    assert_eq!((glb.primitives().len(), glb.document.get("images")), (1, None));
    // The colours read from the file again are those of the source's vertices, and mixtures of these between them.
    let read = appearance::read(&bytes, &read_mesh(&bytes).unwrap(), None).look.unwrap();
    let mut colours: Vec<[u8; 3]> = read.corners.iter().flatten().map(|corner| corner.colour).collect();
    colours.sort_unstable();
    colours.dedup();
    assert!(colours.contains(&[255, 51, 0]) && colours.contains(&[0, 102, 255]));
    // In the mixtures the shares of red and blue sum to 1.
    assert!(
        colours.iter().all(|[r, _, b]| (u16::from(*r) + u16::from(*b)).abs_diff(255) <= 1),
        "{colours:?}"
    );
}

#[test]
fn one_picture_stays_byte_for_byte_and_webp_has_another_one_beside_it() {
    let target = ply_with_places(&egg());
    let source = obj::mesh(&ball());
    let Mapped { job, map } = mapped(&source, &target, TargetImage::AsGiven);
    for file in [COAT, EYE, WEBP] {
        let files = [
            LookFiles { mesh: &source, companion: None },
            LookFiles { mesh: &target, companion: Some(file) },
        ];
        let look = job.look(files);
        let glb = Glb::new(&job.taken(&map).wearing(&look).output(OutputKind::Glb).unwrap());
        let texture = glb.texture(&glb.primitives()[0]);
        let webp = &texture["extensions"]["EXT_texture_webp"]["source"];
        assert_eq!(glb.image(if webp.is_null() { &texture["source"] } else { webp }), file);
        assert_eq!(webp.is_null(), file != WEBP);
        assert_eq!(glb.document["extensionsUsed"].is_null(), file != WEBP);
        let fallback = glb.image(&texture["source"]);
        assert!(file != WEBP || fallback.starts_with(b"\x89PNG"));
    }
}

#[test]
fn without_colours_or_with_other_files_the_checkerboard_stays() {
    let (source, target) = (obj::mesh(&ball()), pictured(&egg()));
    let Mapped { job, map } = mapped(&source, &target, TargetImage::AsGiven);
    let bare = job.taken(&map).output(OutputKind::Glb).unwrap();
    let file = |mesh, companion| LookFiles { mesh, companion };
    let set = companion(&target);
    let cases: [[LookFiles<'_>; 2]; 3] = [
        [file(&source, None), file(&target, None)],
        // These are not the files of the meshes.
        [file(&target, set.as_deref()), file(&source, None)],
        [file(&source, None), file(&target, Some(b"<script>"))],
    ];
    for files in cases {
        let look = job.look(files);
        assert_eq!(job.taken(&map).wearing(&look).output(OutputKind::Glb).unwrap(), bare);
    }
    let none = LookRemark::NoPicture { name: "that came with it".into() };
    assert_eq!(job.look(cases[2]).remarks, [vec![], vec![none]]);
    let look = MapLook::default();
    assert_eq!(job.taken(&map).wearing(&look).output(OutputKind::Glb).unwrap(), bare);
}

/// A PLY file of the mesh with places in a picture by vertex.
fn ply_with_places(mesh: &SurfaceMesh) -> Vec<u8> {
    let column = |name: &str, value: fn(DVec3) -> f64| conemap::io::vertex_table::Column {
        name: name.into(),
        number_type: conemap::io::vertex_table::NumberType::Double,
        values: mesh.positions().iter().map(|p| Some(value(*p))).collect(),
    };
    let polygons: Vec<Vec<u32>> = mesh.triangles().iter().map(|t| t.iter().map(|v| v.0).collect()).collect();
    let columns = [column("u", |p| 0.5 + 0.3 * p.x), column("v", |p| 0.5 + 0.3 * p.y)];
    ply::polygons_with(&mesh.positions().raw, &polygons, &columns)
}
