//! The possible contents of a file that is to be brought over, recognised by its content alone, whatever mesh it belongs to.

use crate::io::vertex_table::{self, AnnouncedColumn, TableError};
use crate::io::{Format, OtherFile, curve_file, detect};
use serde::Serialize;

/// A kind of content that a file may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(all(feature = "web", target_arch = "wasm32"), derive(tsify::Tsify))]
#[serde(rename_all = "snake_case")]
pub enum GivenKind {
    /// Values of vertices.
    Values,
    /// Curves on a mesh.
    Curves,
    /// A picture.
    Texture,
    /// A mesh in another pose.
    Frames,
}

/// The possible contents of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GivenFile {
    /// The kinds of content that the file may have, the likeliest first; at least one.
    pub kinds: Vec<GivenKind>,
    /// The columns of values that it has.
    pub columns: Vec<AnnouncedColumn>,
}

/// Why a file holds nothing that can be brought over.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GivenKindError {
    /// The file is empty.
    #[error("the file is empty")]
    Empty,
    /// The file is a picture in another format.
    #[error("only pictures in PNG are read: save the picture as PNG")]
    Picture,
    /// The file is of a kind that is known, and of no use here.
    #[error("{0}")]
    Other(OtherFile),
    /// The file is a table that begins with a fault.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The file holds nothing that is known.
    #[error(
        "nothing in it can be brought across: give values as a table (CSV) or PLY, curves as OBJ lines, CSV or JSON, a texture as \
         PNG, or the mesh in other poses"
    )]
    Unknown,
}

/// Vertex properties that follow from the places, and are no reason to take a mesh for values.
const NORMALS: [&str; 3] = ["nx", "ny", "nz"];

/// Tells what a file may hold. A PLY file with vertex properties beside places and normals is likelier one of values than a frame; an
/// OBJ file with lines `l`, and a table whose rows begin with a name, are curves.
///
/// # Errors
/// [`GivenKindError`] where nothing of it can be brought over.
pub fn given_file(bytes: &[u8]) -> Result<GivenFile, GivenKindError> {
    use GivenKind::{Curves, Frames, Texture, Values};
    let only = |kinds: &[GivenKind]| Ok(GivenFile { kinds: kinds.to_vec(), columns: Vec::new() });
    if bytes.starts_with(b"\x89PNG") {
        return only(&[Texture]);
    }
    let other = OtherFile::of(bytes);
    if other == Some(OtherFile::Empty) {
        return Err(GivenKindError::Empty);
    }
    let has_curves = curve_file::is_one(bytes);
    match (detect(bytes), other) {
        (Some(Format::Ply), _) => {
            let columns = vertex_table::announced(bytes)?.unwrap_or_default();
            let is_bare = columns.iter().all(|column| NORMALS.contains(&column.name.as_str()));
            Ok(GivenFile { kinds: if is_bare { vec![Frames] } else { vec![Values, Frames] }, columns })
        }
        (Some(_), _) if has_curves => only(&[Curves, Frames]),
        (Some(_), _) => only(&[Frames]),
        // JSON.
        (None, Some(_)) if has_curves => only(&[Curves]),
        (None, Some(OtherFile::Document("JPEG picture" | "GIF picture" | "TIFF picture"))) => {
            Err(GivenKindError::Picture)
        }
        (None, Some(other)) => Err(GivenKindError::Other(other)),
        (None, None) => {
            let columns = vertex_table::announced(bytes)?.ok_or(GivenKindError::Unknown)?;
            let kinds = if has_curves { [Curves, Values] } else { [Values, Curves] };
            Ok(GivenFile { kinds: kinds.to_vec(), columns })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::ply;
    use crate::io::vertex_table::{Column, NumberType};
    use glam::DVec3;

    fn ply_with(names: &[&str]) -> Vec<u8> {
        let column = |name: &&str| Column {
            name: (*name).to_owned(),
            number_type: NumberType::Int,
            values: vec![Some(1.0); 3],
        };
        let columns: Vec<Column> = names.iter().map(column).collect();
        ply::polygons_with(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[vec![0, 1, 2]], &columns)
    }

    #[test]
    fn files_are_told_by_their_content() {
        use GivenKind::{Curves, Frames, Texture, Values};
        let told = |bytes: &[u8]| {
            let GivenFile { kinds, columns } = given_file(bytes).unwrap();
            (kinds, columns.into_iter().map(|column| column.name).collect::<Vec<_>>().join(" "))
        };
        let values = |names: &str| (vec![Values, Curves], names.to_owned());
        assert_eq!(told(b"vertex,heat,part\n0,1,2\n"), values("heat part"));
        assert_eq!(told(b"heat,part\n1,2\n"), values("heat part"));
        assert_eq!(told(b"0.5,2\n1,2\n"), values("1 2"));
        assert_eq!(told(b"heat\n1\n"), values("heat"));
        assert_eq!(told(b"curve,vertex\na,0\n"), (vec![Curves, Values], "curve vertex".to_owned()));
        assert_eq!(told(b"a,0\n").0, [Curves, Values]);
        assert_eq!(told(&ply_with(&["bone", "nx"])), (vec![Values, Frames], "bone nx".to_owned()));
        assert_eq!(told(&ply_with(&["nx", "ny", "nz"])), (vec![Frames], "nx ny nz".to_owned()));
        let bare = |bytes: &[u8]| {
            let (kinds, columns) = told(bytes);
            assert_eq!(columns, "");
            kinds
        };
        assert_eq!(bare(&ply_with(&[])), [Frames]);
        assert_eq!(bare(b"v 0 0 0\nf 1 1 1\n"), [Frames]);
        assert_eq!(bare(b"v 0 0 0\nf 1 1 1\nl 1 1\n"), [Curves, Frames]);
        assert_eq!(bare(b"{\"curves\": []}"), [Curves]);
        assert_eq!(bare(b"\x89PNG\r\n"), [Texture]);
    }

    #[test]
    fn what_is_of_no_use_is_told() {
        let told = |bytes: &[u8]| given_file(bytes).unwrap_err().to_string();
        assert_eq!(told(b" \n"), "the file is empty");
        assert_eq!(told(b"PK\x03\x04"), "it is a packed file (zip): unpack it first");
        assert_eq!(told(b"\xff\xd8\xff"), "only pictures in PNG are read: save the picture as PNG");
        assert!(told(b"Dear reader\nsome words\n").starts_with("nothing in it can be brought across"));
        assert_eq!(told(b"a,a\n1,2\n"), "line 1: two columns are called \"a\"");
    }
}
