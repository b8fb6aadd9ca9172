//! Whether a landmark file was made for the meshes that are given.

use super::remark::Remark;
use crate::io::landmark_file::LandmarkFile;
use crate::landmarks::MeshSide;

/// Remarks on the meshes that a landmark file names, `given` being the names of the source's and the target's file. Folders and endings do
/// not count: `shapes/Cat.off` and `cat.ply` are one name.
pub fn compare_names(file: &LandmarkFile, given: [&str; 2]) -> Vec<Remark> {
    let named =
        [&file.source, &file.target].map(|name| name.as_deref().filter(|name| !stem(name).is_empty()));
    let is_other =
        |side: MeshSide, than: MeshSide| named[side].is_some_and(|name| stem(name) != stem(given[than]));
    let is_exchanged =
        |side: &MeshSide| named[*side].is_some() && is_other(*side, *side) && !is_other(*side, side.other());
    if MeshSide::BOTH.iter().all(is_exchanged) {
        return vec![Remark::ExchangedMeshes];
    }
    let remark = |side: MeshSide| {
        let named = named[side].filter(|_| is_other(side, side))?.to_owned();
        Some(Remark::OtherMesh { side, named, given: given[side].to_owned() })
    };
    MeshSide::BOTH.into_iter().filter_map(remark).collect()
}

/// The name of a file without folders and ending, in small letters.
fn stem(path: &str) -> String {
    let name = path.rsplit(['/', '\\']).next().unwrap_or_default();
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    (if stem.is_empty() { name } else { stem }).to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kinds(named: [Option<&str>; 2], given: [&str; 2]) -> Vec<&'static str> {
        let [source, target] = named.map(|name| name.map(str::to_owned));
        let file = LandmarkFile { source, target, ..LandmarkFile::default() };
        compare_names(&file, given).iter().map(Remark::kind).collect()
    }

    #[test]
    fn names_are_compared_without_folders_and_endings() {
        let given = ["meshes/cat.ply", "lion.off"];
        assert!(kinds([Some("shapes\\Cat.off"), Some("a/lion.off")], given).is_empty());
        assert!(kinds([None, None], given).is_empty());
        assert!(kinds([Some(""), Some("lion")], given).is_empty());
        assert_eq!(kinds([Some("horse.off"), Some("lion.off")], given), ["other_mesh"]);
        assert_eq!(kinds([Some("horse.off"), Some("cat.off")], given), ["other_mesh"; 2]);
        assert_eq!(kinds([Some("lion.off"), Some("cat.off")], given), ["exchanged_meshes"]);
        assert!(kinds([Some("cat.off"), Some("cat.off")], ["cat.off", "cat.obj"]).is_empty());
    }
}
