//! Meshes and landmarks from files, with errors that name the file.

use crate::arguments::FaultArguments;
use crate::told::say;
use conemap::export::MeshFormat;
use conemap::io::{self, Format, gltf_parts, material_set};
use conemap::job::{LookFiles, MapLook, ReadMesh, read_mesh};
use conemap::landmark_exchange::{GivenFile, PairLandmarks, Surface, compare_names, read_pairs};
use conemap::mesh::check::CheckedMesh;
use conemap::mesh::soup::PolygonSoup;
use conemap::monitor::Silent;
use std::collections::BTreeMap;
use std::error::Error;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// The error with which the command line fails: a sentence.
pub type Failure = Box<dyn Error>;

/// Reads a file, no more of it than a mesh may have: a device never ends.
pub fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    limited(path).map_err(|e| format!("{}: {e}", path.display()).into())
}

fn limited(path: &Path) -> std::io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let most = io::MAX_BYTES as u64;
    let length = file.metadata()?.len();
    let mut bytes = Vec::new();
    if length <= most {
        bytes.reserve_exact(length as usize);
        file.take(most + 1).read_to_end(&mut bytes)?;
    }
    if length > most || bytes.len() as u64 > most {
        let sentence = format!("it has more than {most} bytes, the most that a file may have");
        return Err(std::io::Error::new(std::io::ErrorKind::FileTooLarge, sentence));
    }
    Ok(bytes)
}

/// Reads a mesh, with what it keeps in files beside it, unchecked.
pub fn soup(path: &Path) -> Result<PolygonSoup, Failure> {
    io::read_mesh(&mesh_bytes(path)?).map_err(|e| format!("{}: {e}", path.display()).into())
}

/// The format of a mesh to be written, by its name.
pub fn format(out: &Path) -> Result<MeshFormat, Failure> {
    MeshFormat::of(out).ok_or_else(|| {
        let known = MeshFormat::ALL.map(|format| format!(".{}", format.ending())).join(", ");
        format!("{}: the name must end in one of {known}", out.display()).into()
    })
}

/// Reads the file of a mesh, with what it keeps in files beside it.
pub fn mesh_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let own = bytes(path)?;
    let parts = gltf_parts::parts_of(&own);
    if parts.buffers.is_empty() {
        return Ok(own);
    }
    // What a file names is read from its own folder and those below, and from nowhere else.
    let folder = path.parent().unwrap_or(Path::new(""));
    let is_below = |name: &str| Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
    let names = parts.buffers.into_iter().chain(parts.images).filter(|name| is_below(name));
    let contents: BTreeMap<String, Vec<u8>> =
        names.filter_map(|name| limited(&folder.join(&name)).ok().map(|content| (name, content))).collect();
    let find = |name: &str| contents.get(name).map(Vec::as_slice);
    let packed = gltf_parts::packed(&own, find).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(packed.bytes)
}

/// The companion of a mesh file for its look: the materials that an OBJ file names, with their pictures, from its own folder and those
/// below; or else a picture beside it with its name.
pub fn companion(path: &Path, mesh: &[u8]) -> Option<Vec<u8>> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let is_below = |name: &str| Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
    let find = |name: &str| limited(&folder.join(name)).ok().filter(|_| is_below(name));
    let set = material_set::packed(mesh, find);
    if set.as_ref().is_some_and(|set| set.found > 0) {
        return set.map(|set| set.bytes);
    }
    let is_pictured = matches!(io::detect(mesh), Some(Format::Obj | Format::Ply));
    let beside = |ending: &&str| limited(&path.with_extension(ending)).ok().filter(|_| is_pictured);
    PICTURE_ENDINGS.iter().find_map(beside).or_else(|| set.map(|set| set.bytes))
}

/// The endings of pictures that can be laid on a mesh.
const PICTURE_ENDINGS: [&str; 4] = ["png", "jpg", "jpeg", "webp"];

/// The mesh files of a map with what comes with them.
pub struct MeshSets<'a> {
    paths: [&'a Path; 2],
    meshes: [&'a [u8]; 2],
    companions: [Option<Vec<u8>>; 2],
}

impl<'a> MeshSets<'a> {
    /// Reads what comes with mesh files that were read.
    pub fn of(paths: [&'a Path; 2], meshes: [&'a [u8]; 2]) -> Self {
        Self { paths, meshes, companions: [0, 1].map(|k| companion(paths[k], meshes[k])) }
    }

    /// The look that a map of these files carries; prints remarks on the parts that cannot be used.
    pub fn look(&self, read: impl FnOnce([LookFiles<'_>; 2]) -> MapLook) -> MapLook {
        let files = |k: usize| LookFiles { mesh: self.meshes[k], companion: self.companions[k].as_deref() };
        let look = read([files(0), files(1)]);
        for (path, remarks) in self.paths.iter().zip(&look.remarks) {
            remarks.iter().for_each(|remark| say(format_args!("warning: {}: {remark}", path.display())));
        }
        look
    }
}

/// A file with those beside it in which it keeps its data.
pub fn files_of(path: &Path) -> Vec<PathBuf> {
    let is_gltf = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gltf"));
    let parts = is_gltf.then(|| limited(path).map(|own| gltf_parts::parts_of(&own)).unwrap_or_default());
    let names = parts.into_iter().flat_map(|parts| parts.buffers.into_iter().chain(parts.images));
    let folder = path.parent().unwrap_or(Path::new(""));
    std::iter::once(path.to_owned()).chain(names.map(|name| folder.join(name))).collect()
}

/// Reads a mesh, and checks or repairs it.
pub fn mesh(path: &Path, faults: FaultArguments) -> Result<CheckedMesh, Failure> {
    checked(path, &mesh_bytes(path)?, faults)
}

/// Checks or repairs a mesh that was read from a file, and prints the repairs.
pub fn checked(path: &Path, bytes: &[u8], faults: FaultArguments) -> Result<CheckedMesh, Failure> {
    let name = path.display();
    let ReadMesh { mesh, report } =
        read_mesh(bytes, faults.into(), &mut Silent).map_err(|e| format!("{name}: {e}"))?;
    if report.fault.is_some() {
        say(format_args!(
            "warning: {name} could not be used as it is and was repaired: {}. `conemap check` tells more and writes the repaired \
             mesh.",
            report.sentence()
        ));
    }
    Ok(mesh.into_checked())
}

/// Files with their names.
pub struct NamedFiles(Vec<(String, Vec<u8>)>);

impl NamedFiles {
    /// Reads files.
    pub fn read<P: AsRef<Path>>(paths: &[P]) -> Result<Self, Failure> {
        let file = |path: &P| Ok((path.as_ref().display().to_string(), bytes(path.as_ref())?));
        Ok(Self(paths.iter().map(file).collect::<Result<_, Failure>>()?))
    }

    /// As landmark files.
    pub fn given(&self) -> Vec<GivenFile<'_>> {
        self.0.iter().map(|(name, bytes)| GivenFile { name, bytes }).collect()
    }
}

/// Reads landmark files of two meshes onto them; an error names the file. Remarks also say where files name other meshes than `meshes`.
pub fn landmarks<P: AsRef<Path>>(
    paths: &[P],
    meshes: [&Path; 2],
    surfaces: [Surface<'_>; 2],
) -> Result<PairLandmarks, Failure> {
    let mut landmarks = read_pairs(&NamedFiles::read(paths)?.given(), surfaces).map_err(|error| {
        let file = error.file().and_then(|number| paths.get(number));
        file.map_or_else(|| error.to_string(), |path| format!("{}: {error}", path.as_ref().display()))
    })?;
    let names = meshes.map(|path| path.to_string_lossy());
    landmarks.remarks.extend(compare_names(&landmarks.file, names.each_ref().map(|name| &**name)));
    Ok(landmarks)
}
