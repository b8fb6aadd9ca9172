//! Colours of vertices and faces in OFF files of text that have a line for each.

use super::off::{ElementLines, element_lines};

/// The colours of a file, red, green and blue as a screen shows them (sRGB).
#[derive(Debug, PartialEq)]
pub(super) enum OffColours {
    /// The colours of the vertices.
    OfVertices(Vec<[u8; 3]>),
    /// The colours of the faces; white where a face has none.
    OfFaces(Vec<[u8; 3]>),
}

/// The colours of the vertices, where the keyword announces them, else those of the faces; `None` where there are none.
pub(super) fn read(text: &str) -> Option<OffColours> {
    let ElementLines { before_colour, vertices, faces } = element_lines(text)?;
    if let Some(before) = before_colour {
        let colours: Vec<_> =
            vertices.iter().map(|line| channels(line.split_whitespace().skip(before))).collect();
        if colours.iter().all(Option::is_some) {
            return Some(OffColours::OfVertices(bytes(&colours)));
        }
    }
    let colours: Vec<_> = faces.iter().map(|line| of_face(line)).collect();
    colours.iter().any(Option::is_some).then(|| OffColours::OfFaces(bytes(&colours)))
}

/// The colour that follows the vertices of a face; a single number there is one of a table of colours, which the file does not
/// have.
fn of_face(line: &str) -> Option<[f64; 3]> {
    let mut words = line.split_whitespace();
    let corners: usize = words.next()?.parse().ok()?;
    channels(words.skip(corners))
}

/// Red, green and blue; how solid the colour is may follow.
fn channels<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<[f64; 3]> {
    let mut next = || words.next()?.parse::<f64>().ok().filter(|x| (0.0..=255.0).contains(x));
    Some([next()?, next()?, next()?])
}

/// The colours in bytes: where no number of the file is beyond 1 the numbers are shares, else they go up to 255.
fn bytes(colours: &[Option<[f64; 3]>]) -> Vec<[u8; 3]> {
    let is_share = colours.iter().flatten().flatten().all(|x| *x <= 1.0);
    let unit = if is_share { 255.0 } else { 1.0 };
    let colour =
        |channels: &Option<[f64; 3]>| channels.map_or([u8::MAX; 3], |c| c.map(|x| (unit * x).round() as u8));
    colours.iter().map(colour).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_stand_behind_coordinates_and_normals() {
        let expected = Some(OffColours::OfVertices(vec![[255, 0, 51], [0, 255, 0], [0, 0, 255]]));
        for text in [
            "COFF\n3 1 0\n0 0 0 255 0 51 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2\n",
            "COFF 3 1 0\n0 0 0 1 0 0.2 1\n1 0 0 0 1 0 1\n0 1 0 0 0 1 1\n3 0 1 2 255 255 255\n",
            "NC4OFF\n3 1 0\n0 0 0 1 0 0 1 1 0 0.2\n1 0 0 1 0 0 1 0 1 0\n0 1 0 1 0 0 1 0 0 1\n3 0 1 2\n",
        ] {
            assert_eq!(read(text), expected, "{text:?}");
        }
    }

    #[test]
    fn colours_of_faces_stand_behind_their_vertices() {
        let text = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2 200 0 51\n3 0 2 3\n3 0 3 1 0 255 0 128\n";
        let expected = vec![[200, 0, 51], [255; 3], [0, 255, 0]];
        assert_eq!(read(text), Some(OffColours::OfFaces(expected)));
    }

    #[test]
    fn other_numbers_are_no_colours() {
        let vertices = "0 0 0\n1 0 0\n0 1 0\n";
        for text in [
            format!("OFF\n3 1 0\n{vertices}3 0 1 2\n"),
            // The number of a colour in a table.
            format!("OFF\n3 1 0\n{vertices}3 0 1 2 7\n"),
            format!("OFF\n3 1 0\n{vertices}3 0 1 2 -1 0 0\n"),
            format!("COFF\n3 1 0\n{vertices}3 0 1 2\n"),
            format!("OFF 3 1 0 {} 3 0 1 2 1 0 0", vertices.replace('\n', " ")),
            "OFF\n3 2 0\n0 0 0\n".to_owned(),
        ] {
            assert_eq!(read(&text), None, "{text:?}");
        }
    }
}
