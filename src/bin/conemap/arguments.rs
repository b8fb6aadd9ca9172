//! What the user types.

use clap::{Args, Parser, Subcommand};
use conemap::cone_metric::Scheme;
use conemap::export::MeshFormat;
use conemap::io::Format;
use conemap::io::landmark_formats::LandmarkFormat;
use conemap::job::{LEAST_MEMORY, MEMORY_PER_FACE, MeshFaults};
use conemap::landmark_suggestion::USUAL_COUNT;
use conemap::landmarks::MeshSide;
use conemap::mesh::repair::{Handles, Parts, RepairOptions};
use conemap::pipeline::Choices;
use conemap::remesh::USUAL_CREASE_ANGLE;
use conemap::transfer::{Carrying, Raster, USUAL_GIVER};
use std::path::PathBuf;
use std::time::Duration;

/// Bijective, low-distortion maps between closed triangle meshes of genus 0.
#[derive(Debug, Parser)]
#[command(name = "conemap", version, about)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Say whether a mesh can be mapped, what is wrong with it, and what a repair does about it.
    Check(CheckArguments),
    /// Map a source mesh onto a target mesh from corresponding landmarks.
    Map(MapArguments),
    /// Find landmark pairs of two meshes, with their alternatives and how sure they are.
    Match(MatchArguments),
    /// Lay a base mesh onto a scan: its own vertices, polygons and texture coordinates in the scan's shape.
    Wrap(WrapArguments),
    /// Answer images of points from a map file, without computing.
    Query(QueryArguments),
    /// Measure the map of a map file anew, from its pieces alone.
    Report(ReportArguments),
    /// Prove anew, in exact arithmetic and by other code, that the map of a map file is one-to-one.
    Verify(VerifyArguments),
    /// Write all files of the map of a map file, without computing.
    Export(ExportArguments),
    /// Bring attributes, motions, curves or the shape of one mesh onto the other by the map of a map file.
    Transfer(TransferArguments),
    /// Print vertices of a mesh that are worth a landmark: ends of limbs, then points far from all others.
    Suggest(SuggestArguments),
    /// Deform one mesh conformally to a flat metric with prescribed cones.
    Flow(FlowArguments),
    /// Convert landmark files, or tell how far their points lie off the meshes.
    Landmarks(LandmarksArguments),
    /// Give a mesh even triangles, as many as wanted, with vertices on its surface.
    Remesh(RemeshArguments),
    /// Write two meshes with landmarks to try things on, or list them.
    Demo(DemoArguments),
}

/// `conemap check`.
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// Mesh.
    #[arg(help = format!("Mesh: {}", Format::NAMES))]
    pub mesh: PathBuf,
    /// Repair the mesh; without this it is only told what a repair would do.
    #[arg(long)]
    pub repair: bool,
    /// File for the repaired mesh.
    #[arg(long, requires = "repair", help = written_help("File for the repaired mesh"))]
    pub out: Option<PathBuf>,
    /// File for the report (JSON); - for standard output, in place of the sentences.
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// What a repair may do.
    #[command(flatten)]
    pub repairs: RepairArguments,
}

/// What a repair may do beyond what does not change the shape.
#[derive(Clone, Copy, Debug, Args)]
pub struct RepairArguments {
    /// Keep the largest part of a mesh alone, also where the others have 1 % of the area or more.
    #[arg(long)]
    pub largest_component: bool,
    /// Cut handles along their shortest loops, and close them.
    #[arg(long)]
    pub cut_handles: bool,
    /// Join vertices on open edges that are within this distance, in the file's units; otherwise only those at the same place.
    #[arg(long, value_name = "DISTANCE", default_value_t = RepairOptions::default().join_within, value_parser = distance, allow_negative_numbers = true)]
    pub join_within: f64,
}

impl From<RepairArguments> for RepairOptions {
    fn from(arguments: RepairArguments) -> Self {
        let parts = if arguments.largest_component { Parts::LargestAlone } else { Parts::LargestAndSpecks };
        let handles = if arguments.cut_handles { Handles::Cut } else { Handles::Refused };
        Self { join_within: arguments.join_within, parts, handles }
    }
}

/// What becomes of a mesh that is not one closed surface of genus 0.
#[derive(Clone, Copy, Debug, Args)]
pub struct FaultArguments {
    /// Refuse meshes that would have to be repaired.
    #[arg(long, conflicts_with_all = ["largest_component", "cut_handles", "join_within"])]
    pub strict: bool,
    /// What the repair of the meshes may do.
    #[command(flatten)]
    pub repairs: RepairArguments,
}

impl From<FaultArguments> for MeshFaults {
    fn from(arguments: FaultArguments) -> Self {
        if arguments.strict { Self::Refused } else { Self::Repaired(arguments.repairs.into()) }
    }
}

/// A distance of zero or more.
fn distance(text: &str) -> Result<f64, String> {
    let distance: f64 = text.parse().map_err(|_| format!("`{text}` is no distance"))?;
    if distance.is_finite() && distance >= 0.0 {
        Ok(distance)
    } else {
        Err("it must be 0 or more".to_owned())
    }
}

/// `conemap map`.
#[derive(Debug, Args)]
pub struct MapArguments {
    /// Source mesh.
    #[arg(help = mesh_help("Source mesh"))]
    pub source: PathBuf,
    /// Target mesh, likewise.
    pub target: PathBuf,
    /// The target's landmark file, where --landmarks names that of the source.
    #[arg(requires = "landmarks")]
    pub target_landmarks: Option<PathBuf>,
    /// Landmark file.
    #[arg(long, value_name = "FILE", help = landmarks_help("Landmark file; with fewer than four pairs, or without it, landmarks are looked for"))]
    pub landmarks: Option<PathBuf>,
    /// What is chosen of the run.
    #[command(flatten)]
    pub choices: Choices,
    /// Finish from then on with the best map so far: less relaxed, but whole and certified. Ctrl-C does the same; pressed
    /// twice it ends without a map.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    pub time_limit: Option<Duration>,
    /// End within this time, with a map or with a sentence that says how far it came: from half of it on finish as with
    /// --time-limit.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    pub deadline: Option<Duration>,
    /// Refuse meshes whose map may take more memory than that.
    #[arg(long, value_name = "MIB", help = memory_help())]
    pub memory_limit: Option<u32>,
    /// Use the mirror image of the target: for landmarks whose left and right are exchanged.
    #[arg(long)]
    pub mirror_target: bool,
    /// True images of the source's vertices, in columns x, y and z as vertex-images.csv has them: the report tells how far the map is
    /// from them.
    #[arg(long, value_name = "FILE")]
    pub truth: Option<PathBuf>,
    /// What becomes of meshes with faults.
    #[command(flatten)]
    pub faults: FaultArguments,
    /// File for the map itself, from which `query`, `report` and `export` work without computing.
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// Folder for all files of the map: textured source, images of vertices, shapes, flat layout, distortions, base domain.
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// File for the report (JSON).
    #[arg(long)]
    pub report: Option<PathBuf>,
}

/// `conemap match`.
#[derive(Debug, Args)]
pub struct MatchArguments {
    /// Source mesh.
    #[arg(help = mesh_help("Source mesh"))]
    pub source: PathBuf,
    /// Target mesh, likewise.
    pub target: PathBuf,
    /// The target's landmark file, where --landmarks names that of the source.
    #[arg(requires = "landmarks")]
    pub target_landmarks: Option<PathBuf>,
    /// Landmarks that are held.
    #[arg(long, value_name = "FILE", help = landmarks_help("Landmarks that are held"))]
    pub landmarks: Option<PathBuf>,
    /// File for the best pairs (JSON).
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// File for all candidates with their scores, and the verdict (JSON).
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// What becomes of meshes with faults.
    #[command(flatten)]
    pub faults: FaultArguments,
}

/// `conemap wrap`.
#[derive(Debug, Args)]
pub struct WrapArguments {
    /// Base mesh: OBJ or OFF, whose lines are kept but for the places of its vertices; repaired for the map where it is not closed.
    #[arg(id = "base_mesh", value_name = "BASE")]
    pub base: PathBuf,
    /// Scan that it is laid onto.
    #[arg(help = mesh_help("Scan that it is laid onto"))]
    pub scan: PathBuf,
    /// The scan's landmark file, where --landmarks names that of the base.
    pub scan_landmarks: Option<PathBuf>,
    /// Landmark file of base and scan.
    #[arg(long, value_name = "FILE", help = landmarks_help("Landmark file of base and scan"))]
    pub landmarks: PathBuf,
    /// File for the wrapped base, in the format of the base's file.
    #[arg(long)]
    pub out: PathBuf,
    /// Leave out the base's normals, which are those of its own shape, so that programs make new ones.
    #[arg(long)]
    pub drop_normals: bool,
    /// What is chosen of the run.
    #[command(flatten)]
    pub choices: Choices,
    /// Finish from then on with the best map so far: less relaxed, but whole and certified. Ctrl-C does the same; pressed
    /// twice it ends without a map.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    pub time_limit: Option<Duration>,
    /// What becomes of meshes with faults.
    #[command(flatten)]
    pub faults: FaultArguments,
    /// File for the report (JSON): that of the map, and that of the wrapped base.
    #[arg(long)]
    pub report: Option<PathBuf>,
}

/// A map file with the meshes that it was made with.
#[derive(Debug, Args)]
pub struct SavedMapArguments {
    /// Map file, as `conemap map --map` writes it.
    pub map: PathBuf,
    /// The source that it was made with.
    pub source: PathBuf,
    /// The target that it was made with.
    pub target: PathBuf,
}

impl SavedMapArguments {
    /// The files that are read.
    pub fn files(&self) -> [&PathBuf; 3] {
        [&self.map, &self.source, &self.target]
    }
}

/// `conemap query`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("asked").required(true))]
pub struct QueryArguments {
    /// The map.
    #[command(flatten)]
    pub saved: SavedMapArguments,
    /// Text file of points, one a line: `face,b0,b1,b2` or `vertex` (0-based, as the mesh's file numbers them).
    #[arg(long, value_name = "FILE", group = "asked")]
    pub points: Option<PathBuf>,
    /// All vertices of the mesh.
    #[arg(long, group = "asked")]
    pub vertices: bool,
    /// From the target to the source.
    #[arg(long)]
    pub inverse: bool,
    /// File for the images (CSV); standard output where there is none.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// `conemap report`.
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// The map.
    #[command(flatten)]
    pub saved: SavedMapArguments,
    /// File for the measures (JSON); standard output where there is none.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// `conemap verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// The map.
    #[command(flatten)]
    pub saved: SavedMapArguments,
    /// File for the report (JSON), written for a refused map as well; - for standard output, in place of the sentences.
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
}

/// `conemap export`.
#[derive(Debug, Args)]
pub struct ExportArguments {
    /// The map.
    #[command(flatten)]
    pub saved: SavedMapArguments,
    /// Folder for the files.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// `conemap transfer`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("what").required(true))]
pub struct TransferArguments {
    /// The map.
    #[command(flatten)]
    pub saved: SavedMapArguments,
    /// Values of the vertices: a table (`vertex,value,...`, or a row for each vertex) or a PLY file with vertex properties.
    #[arg(long, value_name = "FILE", group = "what")]
    pub attributes: Option<PathBuf>,
    /// Mesh files with the same vertices and faces, moved: the other mesh moves likewise.
    #[arg(long, value_name = "FILE", num_args = 1.., group = "what")]
    pub frames: Vec<PathBuf>,
    /// Curves over vertices (OBJ with `l` lines, or CSV) or over points of faces (CSV or JSON).
    #[arg(long, value_name = "FILE", group = "what")]
    pub curves: Option<PathBuf>,
    /// Texture of the giving mesh (PNG), baked into a picture over the receiving mesh's own texture coordinates. Both mesh files
    /// must have theirs: OBJ, or PLY with the vertex properties u and v.
    #[arg(long, value_name = "FILE", group = "what")]
    pub texture: Option<PathBuf>,
    /// Each mesh's triangles in the shape of the other, with distances and how well the normals agree.
    #[arg(long, group = "what", conflicts_with = "from")]
    pub shape: bool,
    /// The source on its way to the target's shape, as an animated GLB: limbs turn instead of shrinking.
    #[arg(long, group = "what", conflicts_with = "from")]
    pub morph: bool,
    /// The mesh that gives.
    #[arg(long, value_enum, default_value_t = USUAL_GIVER)]
    pub from: MeshSide,
    /// How values are made.
    #[arg(long, value_enum, default_value_t, requires = "attributes")]
    pub method: Carrying,
    /// Columns that are labels: whole numbers that are not to be mixed.
    #[arg(long, value_name = "NAME", value_delimiter = ',', requires = "attributes")]
    pub labels: Vec<String>,
    /// Columns that are weights: none below 0, and the sum of a row is kept.
    #[arg(long, value_name = "NAME", value_delimiter = ',', requires = "attributes")]
    pub weights: Vec<String>,
    /// Texels in a row and in a column of the picture.
    #[arg(long, value_name = "TEXELS", default_value_t = Raster::USUAL_SIZE, requires = "texture", value_parser = clap::value_parser!(u16).range(1..=i64::from(Raster::LARGEST_SIZE)))]
    pub size: u16,
    /// Texels by which colours are carried on beyond the charts.
    #[arg(long, value_name = "TEXELS", default_value_t = Raster::USUAL_BORDER, requires = "texture", value_parser = clap::value_parser!(u8).range(..=64))]
    pub border: u8,
    /// File for values (csv or ply by its ending), curves (json, csv or obj), a texture (png) or a morph (glb); folder for frames and shapes.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
}

/// `conemap suggest`.
#[derive(Debug, Args)]
pub struct SuggestArguments {
    /// Mesh.
    #[arg(help = mesh_help("Mesh"))]
    pub mesh: PathBuf,
    /// How many at most.
    #[arg(long, default_value_t = USUAL_COUNT, allow_negative_numbers = true)]
    pub count: usize,
    /// Vertices (0-based) that are landmarks already: the suggestions keep away from them.
    #[arg(long, value_name = "VERTEX", value_delimiter = ',')]
    pub beside: Vec<usize>,
    /// What becomes of a mesh with faults.
    #[command(flatten)]
    pub faults: FaultArguments,
}

/// `conemap demo`.
#[derive(Debug, Args)]
pub struct DemoArguments {
    /// Name of the demo; without one all are listed.
    pub id: Option<String>,
    /// Folder for the meshes (OBJ) and the landmarks (JSON).
    #[arg(long, value_name = "FOLDER", default_value = ".")]
    pub out: PathBuf,
}

/// `conemap landmarks`.
#[derive(Debug, Args)]
pub struct LandmarksArguments {
    /// Source mesh.
    #[arg(help = mesh_help("Source mesh"))]
    pub source: PathBuf,
    /// Target mesh, likewise.
    pub target: PathBuf,
    /// Landmark files to read.
    #[arg(long = "in", value_name = "FILE", num_args = 1..=2, required = true, help = landmarks_help("Landmark file of both meshes, or that of the source and that of the target"))]
    pub inputs: Vec<PathBuf>,
    /// Landmark file of both meshes to write, or that of the source and that of the target.
    #[arg(long = "out", value_name = "FILE", num_args = 1..=2)]
    pub outputs: Vec<PathBuf>,
    /// The format to write, if not the one that the ending of the name says.
    #[arg(long, value_parser = landmark_format, value_name = "FORMAT", help = format_help())]
    pub format: Option<LandmarkFormat>,
    /// Print the points' distances and what there is to know about them as JSON instead of text.
    #[arg(long)]
    pub json: bool,
    /// What becomes of meshes with faults.
    #[command(flatten)]
    pub faults: FaultArguments,
}

/// The memory that a map may take.
fn memory_help() -> String {
    let [least, per_face] = [LEAST_MEMORY >> 20, MEMORY_PER_FACE >> 10];
    format!(
        "Refuse meshes whose map may take more memory than that: {least} MiB and {per_face} KiB for each triangle of both meshes"
    )
}

/// The formats of landmark files.
fn landmarks_help(name: &str) -> String {
    format!("{name}: {}", LandmarkFormat::NAMES)
}

/// The words of the formats.
fn format_words() -> String {
    LandmarkFormat::ALL.map(LandmarkFormat::id).join(", ")
}

fn format_help() -> String {
    format!("Format to write, if not the one that the ending of the name says: {}", format_words())
}

fn landmark_format(text: &str) -> Result<LandmarkFormat, String> {
    LandmarkFormat::of_id(text).ok_or_else(|| format!("`{text}` is none of {}", format_words()))
}

/// What a mesh must be.
fn mesh_help(name: &str) -> String {
    format!("{name}: {}; of genus 0, repaired where it is not closed", Format::NAMES)
}

/// The formats in which meshes are written.
fn written_help(name: &str) -> String {
    format!("{name}: its ending says the format: {}", MeshFormat::ALL.map(MeshFormat::ending).join(", "))
}

/// A time of zero or more seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("`{text}` is no number of seconds"))?;
    Duration::try_from_secs_f64(seconds).map_err(|_| format!("`{text}` is no time to wait"))
}

/// `conemap flow`.
#[derive(Debug, Args)]
pub struct FlowArguments {
    /// Mesh.
    #[arg(help = mesh_help("Mesh"))]
    pub mesh: PathBuf,
    /// Text file of lines `vertex angle_defect` (0-based, radians); all other vertices become flat. The sum must be 4 pi.
    #[arg(long)]
    pub cones: PathBuf,
    /// The discrete conformal structure.
    #[arg(long, value_enum, default_value_t)]
    pub scheme: Scheme,
    /// File for the report (JSON).
    #[arg(long)]
    pub report: Option<PathBuf>,
    /// What becomes of a mesh with faults.
    #[command(flatten)]
    pub faults: FaultArguments,
}

/// `conemap remesh`.
#[derive(Debug, Args)]
pub struct RemeshArguments {
    /// Mesh.
    #[arg(help = mesh_help("Mesh"))]
    pub mesh: PathBuf,
    /// The wanted number of triangles; the result is within 5 % of it.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub faces: usize,
    /// Edges whose faces' normals differ by more than this stay sharp; 180 for none.
    #[arg(long, value_name = "DEGREES", default_value_t = USUAL_CREASE_ANGLE.to_degrees(), value_parser = degrees, allow_negative_numbers = true)]
    pub crease_angle: f64,
    /// File for the new mesh.
    #[arg(long, help = written_help("File for the new mesh"))]
    pub out: PathBuf,
    /// File for the report (JSON).
    #[arg(long)]
    pub report: Option<PathBuf>,
    /// What becomes of a mesh with faults.
    #[command(flatten)]
    pub faults: FaultArguments,
}

/// An angle from 0 to 180 degrees.
fn degrees(text: &str) -> Result<f64, String> {
    let degrees = text.parse().map_err(|_| format!("`{text}` is no number of degrees"))?;
    if (0.0..=180.0).contains(&degrees) { Ok(degrees) } else { Err("it must be from 0 to 180".to_owned()) }
}
