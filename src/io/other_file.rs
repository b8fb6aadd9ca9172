//! Files that hold no mesh of a known format, recognised by their first bytes, so that the error can say what was given.

use super::reading::unmarked;
use std::fmt;

/// A file of another kind than those that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OtherFile {
    /// The file holds nothing, or spaces alone.
    Empty,
    /// The file is packed, by the way of this name.
    Packed(&'static str),
    /// A web page.
    WebPage,
    /// A pointer that Git LFS leaves in place of a large file.
    LfsPointer,
    /// A picture or a document, with the name of its kind.
    Document(&'static str),
    /// A shape of a format that is not read, with the format's name.
    OtherShape(&'static str),
    /// A landmark file of this program.
    Landmarks,
    /// A map file of this program.
    Map,
    /// A project file of this program.
    Project,
}

/// First bytes, and what they say.
const STARTS: [(&[u8], OtherFile); 31] = [
    (b"\x1f\x8b", OtherFile::Packed("gzip")),
    (b"BZh", OtherFile::Packed("bzip2")),
    (b"\xfd7zXZ\0", OtherFile::Packed("xz")),
    (b"\x28\xb5\x2f\xfd", OtherFile::Packed("Zstandard")),
    (b"7z\xbc\xaf\x27\x1c", OtherFile::Packed("7-Zip")),
    (b"Rar!", OtherFile::Packed("RAR")),
    (b"PK\x03\x04", OtherFile::Packed("zip")),
    (b"PK\x05\x06", OtherFile::Packed("zip")),
    (b"version https://git-lfs", OtherFile::LfsPointer),
    (b"\x89PNG", OtherFile::Document("PNG picture")),
    (b"\xff\xd8\xff", OtherFile::Document("JPEG picture")),
    (b"GIF8", OtherFile::Document("GIF picture")),
    (b"RIFF", OtherFile::Document("RIFF file (a picture, sound or film)")),
    (b"%PDF", OtherFile::Document("PDF document")),
    (b"{\\rtf", OtherFile::Document("RTF document")),
    (b"Kaydara FBX", OtherFile::OtherShape("FBX")),
    (b"; FBX", OtherFile::OtherShape("FBX")),
    (b"BLENDER", OtherFile::OtherShape("Blender")),
    (b"ISO-10303", OtherFile::OtherShape("STEP")),
    (b"#VRML", OtherFile::OtherShape("VRML")),
    (b"# vtk DataFile", OtherFile::OtherShape("VTK")),
    (b"MeshVersionFormatted", OtherFile::OtherShape("Medit")),
    (b"$MeshFormat", OtherFile::OtherShape("Gmsh")),
    (b"#usda", OtherFile::OtherShape("USD")),
    (b"PXR-USDC", OtherFile::OtherShape("USD")),
    (b"Ogawa", OtherFile::OtherShape("Alembic")),
    (b"xof ", OtherFile::OtherShape("DirectX")),
    (b"MM\x00\x2a", OtherFile::Document("TIFF picture")),
    (b"II\x2a\x00", OtherFile::Document("TIFF picture")),
    (b"MM", OtherFile::OtherShape("3DS")),
    (b"CONEMAP\0", OtherFile::Map),
];

/// The number of bytes that are looked at.
const HEAD: usize = 4096;

impl OtherFile {
    /// The kind of a file that holds no mesh; `None` where it is not known.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let head = &bytes[..bytes.len().min(HEAD)];
        let head = unmarked(head);
        let start = head.trim_ascii_start();
        let known = STARTS.iter().find(|(word, _)| start.starts_with(word)).map(|(_, file)| *file);
        // A project names its content in the first entry.
        let is_project = || head.windows(12).any(|word| word == b"conemap.json");
        match known {
            Some(Self::Packed("zip")) if is_project() => Some(Self::Project),
            Some(file) => Some(file),
            None if start.is_empty() && bytes.iter().all(u8::is_ascii_whitespace) => Some(Self::Empty),
            None => Self::of_text(start),
        }
    }

    fn of_text(start: &[u8]) -> Option<Self> {
        let has = |word: &[u8]| start.windows(word.len()).any(|part| part.eq_ignore_ascii_case(word));
        match start.first()? {
            b'<' if has(b"<html") || has(b"<!doctype html") || has(b"<body") => Some(Self::WebPage),
            b'<' if has(b"<COLLADA") => Some(Self::OtherShape("Collada")),
            b'<' if has(b"<X3D") => Some(Self::OtherShape("X3D")),
            b'<' if has(b"<VTKFile") => Some(Self::OtherShape("VTK")),
            b'<' if has(b"<svg") => Some(Self::Document("SVG picture")),
            b'<' => Some(Self::Document("XML file")),
            b'{' if has(b"\"pairs\"") => Some(Self::Landmarks),
            b'{' | b'[' => Some(Self::Document("JSON file")),
            _ => None,
        }
    }
}

impl fmt::Display for OtherFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("the file is empty"),
            Self::Packed(name) => write!(f, "it is a packed file ({name}): unpack it first"),
            Self::WebPage => f.write_str(
                "it is a web page: the address may lead to a page about the file, not to the file",
            ),
            Self::LfsPointer => {
                f.write_str("it is a pointer of Git LFS in place of the file: get the file by `git lfs pull`")
            }
            Self::Document(name) => write!(f, "it is no mesh but a {name}"),
            Self::OtherShape(name) => {
                write!(f, "files of the format {name} are not read: export it in another")
            }
            Self::Landmarks => f.write_str("it is a landmark file, not a mesh"),
            Self::Map => f.write_str("it is a map file, not a mesh"),
            Self::Project => f.write_str("it is a project file of the page, not a mesh"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_told_by_their_first_bytes() {
        let cases: [(&[u8], Option<OtherFile>); 12] = [
            (b"", Some(OtherFile::Empty)),
            (b" \n\r\n", Some(OtherFile::Empty)),
            (b"\x1f\x8b\x08", Some(OtherFile::Packed("gzip"))),
            (b"\n<!DOCTYPE html>", Some(OtherFile::WebPage)),
            (b"<?xml version=\"1.0\"?><COLLADA>", Some(OtherFile::OtherShape("Collada"))),
            (b"<?xml?><a/>", Some(OtherFile::Document("XML file"))),
            (b"\xef\xbb\xbf{\"pairs\": []}", Some(OtherFile::Landmarks)),
            (b"[1]", Some(OtherFile::Document("JSON file"))),
            (b"PK\x03\x04....conemap.json", Some(OtherFile::Project)),
            (b"PK\x03\x04....a.obj", Some(OtherFile::Packed("zip"))),
            (b"CONEMAP\0", Some(OtherFile::Map)),
            (b"hello", None),
        ];
        for (bytes, file) in cases {
            assert_eq!(OtherFile::of(bytes), file, "{}", String::from_utf8_lossy(bytes));
        }
    }
}
