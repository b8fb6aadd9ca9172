//! The files that a command writes; `-` is standard output. They are looked at before the work begins, so that a name that cannot be written costs
//! nothing, and each is written beside its place and then moved there, so that none is left half written.

use crate::input::{self, Failure};
use crate::told;
use conemap::job::OutputKind;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Refuses outputs that cannot be written, that are inputs, and those that two results would share.
pub fn check<'a>(
    inputs: impl IntoIterator<Item = &'a PathBuf>,
    outputs: impl IntoIterator<Item = PathBuf>,
) -> Result<(), Failure> {
    let read: Vec<PathBuf> = inputs.into_iter().flat_map(|path| input::files_of(path)).collect();
    let mut places: Vec<(PathBuf, PathBuf)> = Vec::new();
    for path in outputs {
        if is_special(&path) {
            continue;
        }
        let place = if is_standard(&path) { path.clone() } else { place(&path) };
        let refused = |problem: &str| Err(format!("{}: {problem}", path.display()).into());
        if !is_standard(&path) && read.iter().any(|input| is_same(input, &path)) {
            return refused("this file is read; choose another name for what is to be written");
        }
        if places.iter().any(|(other, _)| *other == place) {
            return refused("two results would be written to this file; give each its own name");
        }
        if is_standard(&path) {
            places.push((place, path));
            continue;
        }
        let holds = |a: &Path, b: &Path| a.starts_with(b) || b.starts_with(a);
        if let Some((_, other)) = places.iter().find(|(other, _)| holds(other, &place)) {
            return refused(&format!(
                "{} is in the way: one would be the folder of the other",
                other.display()
            ));
        }
        try_out(&path).map_err(|e| format!("{}: it cannot be written: {e}", path.display()))?;
        places.push((place, path));
    }
    Ok(())
}

/// The files of a map in a folder.
pub fn of_folder(folder: &Path) -> impl Iterator<Item = PathBuf> {
    OutputKind::ALL.into_iter().map(move |kind| folder.join(kind.file_name()))
}

/// Writes files into a folder. All are tried, so that one that fails costs only itself; the first error is given back.
pub fn write_all<'a>(
    folder: &Path,
    files: impl IntoIterator<Item = Result<(&'a str, Vec<u8>), Failure>>,
) -> Result<(), Failure> {
    let mut first = Ok(());
    for file in files {
        let written = file.and_then(|(name, bytes)| write(&folder.join(name), &bytes));
        first = first.and(written);
    }
    first
}

/// Whether a name stands for standard output.
pub fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Writes a file, with the folder above it; or to standard output, where that is meant.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_standard(path) {
        return match std::str::from_utf8(bytes) {
            Ok(text) => told::print(text.trim_end()),
            Err(_) => std::io::stdout().write_all(bytes).map_err(|e| format!("standard output: {e}").into()),
        };
    }
    written(path, bytes).map_err(|e| format!("{}: it cannot be written: {e}", path.display()).into())
}

fn written(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    if let Some(folder) = folder(path) {
        fs::create_dir_all(folder)?;
    }
    // The file to which a link leads is replaced, and the link stays.
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let is_link = fs::symlink_metadata(&place).is_ok_and(|data| data.is_symlink());
    if is_special(path) || is_link {
        return fs::write(path, bytes);
    }
    let (beside, mut file) = match new_beside(&place) {
        Ok(new) => new,
        // A file may be written in a folder in which none can be made.
        Err(_) if place.is_file() => return fs::write(path, bytes),
        Err(error) => return Err(error),
    };
    let moved = file.write_all(bytes).and_then(|()| file.sync_all()).and_then(|()| {
        drop(file);
        if let Ok(old) = fs::metadata(&place) {
            // The permissions of the old file stay; where that cannot be, the file counts more.
            drop(fs::set_permissions(&beside, old.permissions()));
        }
        fs::rename(&beside, &place)
    });
    if moved.is_err() {
        drop(fs::remove_file(&beside));
    }
    moved
}

/// Whether a file can be written; what was there stays.
fn try_out(path: &Path) -> std::io::Result<()> {
    if path.exists() {
        return OpenOptions::new().append(true).open(path).map(drop);
    }
    let mut ancestors = path.ancestors().skip(1).map(|folder| match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    });
    let folder = ancestors.find(|folder| folder.exists()).unwrap_or(Path::new("."));
    let (probe, _) = new_beside(&folder.join("any"))?;
    fs::remove_file(probe)
}

/// A new file in the folder of another.
fn new_beside(path: &Path) -> std::io::Result<(PathBuf, File)> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let name = format!(".conemap-{}-{number}.part", std::process::id());
    let beside = folder(path).unwrap_or(Path::new(".")).join(name);
    let file = OpenOptions::new().write(true).create_new(true).open(&beside)?;
    Ok((beside, file))
}

fn folder(path: &Path) -> Option<&Path> {
    path.parent().filter(|folder| !folder.as_os_str().is_empty())
}

/// Whether a path leads to something that is neither file nor folder, such as a terminal or a pipe.
fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|data| !data.is_file() && !data.is_dir())
}

/// The place of a file without links, also of one that is not there yet.
fn place(path: &Path) -> PathBuf {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let known = path.ancestors().find_map(|start| Some((start, fs::canonicalize(start).ok()?)));
    let Some((start, mut place)) = known else { return path };
    for part in path.strip_prefix(start).into_iter().flat_map(Path::components) {
        match part {
            Component::ParentDir => drop(place.pop()),
            part => place.push(part),
        }
    }
    place
}

/// Whether two paths lead to one file, by any links.
fn is_same(a: &Path, b: &Path) -> bool {
    #[cfg(unix)]
    if let (Ok(a), Ok(b)) = (fs::metadata(a), fs::metadata(b)) {
        use std::os::unix::fs::MetadataExt;
        return (a.dev(), a.ino()) == (b.dev(), b.ino());
    }
    place(a) == place(b)
}
