//! OFF with its variants (normals, colours and texture coordinates are passed over), text or binary, also without its
//! keyword; the vertex order of the file is kept.

use super::problem::{Place, Problem, Unread};
use super::reading::{content_lines, number, text, unmarked};
use crate::mesh::soup::PolygonSoup;
use crate::monitor::{Pulse, Silent};
use glam::DVec3;

/// The numbers of a vertex as the keyword says: `[ST][C][N][4][n]OFF`, the letters in any order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Kind {
    /// A fourth coordinate, by which the others are divided.
    is_homogeneous: bool,
    /// The number of coordinates stands after the keyword.
    has_dimension: bool,
    /// A normal is among the numbers that are passed over.
    has_normals: bool,
    /// A colour is among them too, after the normal.
    has_colours: bool,
    /// Numbers of a vertex that are passed over.
    others: usize,
}

impl Kind {
    /// The kind that the first word of a file tells, with what stands in the word behind the keyword; `None` for other words.
    fn of(word: &str) -> Option<(Self, &str)> {
        let end = word.find("OFF").or_else(|| word.find("off"))?;
        let (mut letters, rest) = (&word[..end], &word[end + 3..]);
        // Some files lack the space after the keyword.
        if !rest.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let mut kind = Self::default();
        while !letters.is_empty() {
            let (length, others) = match letters.as_bytes() {
                [b'S', b'T', ..] => (2, 2),
                [b'C', ..] => (1, 4),
                [b'N', ..] => (1, 3),
                [b'4', ..] if !kind.is_homogeneous => (1, 0),
                [b'n', ..] if !kind.has_dimension => (1, 0),
                _ => return None,
            };
            kind.is_homogeneous |= letters.starts_with('4');
            kind.has_dimension |= letters.starts_with('n');
            kind.has_normals |= letters.starts_with('N');
            kind.has_colours |= letters.starts_with('C');
            kind.others += others;
            letters = &letters[length..];
        }
        Some((kind, rest))
    }

    fn coordinates(self) -> usize {
        if self.is_homogeneous { 4 } else { 3 }
    }

    /// The position that the coordinates give.
    fn position(self, p: [f64; 4], place: Place) -> Result<DVec3, Problem> {
        let [x, y, z, w] = p;
        match self.is_homogeneous {
            false => Ok(DVec3::new(x, y, z)),
            true if w != 0.0 => Ok(DVec3::new(x, y, z) / w),
            true => Err((place, "its fourth coordinate is 0: it lies at infinity".into())),
        }
    }
}

/// Whether a file begins with these two lines: the keyword, or else two or three whole numbers and the coordinates of a vertex.
pub(super) fn is_header(first: &[u8], second: Option<&[u8]>) -> bool {
    let words = |line: &[u8]| -> Vec<String> {
        String::from_utf8_lossy(line).split_whitespace().map(str::to_owned).collect()
    };
    let words_of_first = words(&first[..first.len().min(256)]);
    if words_of_first.first().is_some_and(|word| Kind::of(word).is_some()) {
        return true;
    }
    let is_counts = |words: &[String]| {
        (2..=3).contains(&words.len()) && words.iter().all(|word| word.parse::<u32>().is_ok())
    };
    let is_vertex = |line: &[u8]| {
        let words = words(&line[..line.len().min(1024)]);
        words.len() >= 3 && words.iter().take(3).all(|word| word.parse::<f64>().is_ok())
    };
    is_counts(&words_of_first) && second.is_some_and(is_vertex)
}

pub(super) fn read(bytes: &[u8], pulse: &mut Pulse<'_>) -> Result<PolygonSoup, Unread> {
    let unmarked = unmarked(bytes);
    match binary_part(&unmarked) {
        Some((kind, part)) => binary(kind, part, pulse),
        None => read_text(&text(bytes)?, bytes.len(), &mut |_| {}, pulse),
    }
}

/// Whether a file is binary.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    binary_part(&unmarked(bytes)).is_some()
}

/// Whether the vertices of a text file have normals.
pub(super) fn has_normals(text: &str) -> bool {
    let first = content_lines(text).next().and_then(|(_, line)| line.split_whitespace().next());
    first.and_then(Kind::of).is_some_and(|(kind, _)| kind.has_normals)
}

/// The words of the coordinates of a vertex, as they stand in a text.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CoordinateWords<'a> {
    /// The words of x, y and z, or of what becomes x, y and z.
    pub axes: [&'a str; 3],
    /// The word of the number by which the others are divided, where there is one.
    pub divisor: Option<&'a str>,
}

impl<'a> CoordinateWords<'a> {
    fn set(&mut self, k: usize, word: &'a str) {
        match self.axes.get_mut(k) {
            Some(axis) => *axis = word,
            None => self.divisor = Some(word),
        }
    }
}

/// Tells the words of each vertex's coordinates in a text, in the order of the vertices.
pub(super) fn each_vertex<'a>(
    text: &'a str,
    mut told: impl FnMut(CoordinateWords<'a>),
) -> Result<(), Unread> {
    read_text(text, text.len(), &mut told, &mut Pulse::new(&mut Silent, usize::MAX)).map(drop)
}

/// The numbers of elements that the header announces.
#[derive(Clone, Copy)]
struct Counts {
    vertices: usize,
    faces: usize,
}

impl Counts {
    /// Refuses more than a file can hold, so that a small one cannot ask for much memory.
    fn checked(self, bytes: usize, least: [usize; 2], place: Place) -> Result<Self, Problem> {
        let Self { vertices, faces } = self;
        if vertices > bytes / least[0] + 1 || faces > bytes / least[1] + 1 {
            let problem =
                format!("it announces {vertices} vertices and {faces} faces, more than the file can hold");
            return Err((place, problem));
        }
        Ok(self)
    }

    fn soup(self) -> PolygonSoup {
        PolygonSoup {
            positions: Vec::with_capacity(self.vertices),
            polygons: Vec::with_capacity(self.faces),
            ..PolygonSoup::default()
        }
    }
}

/// Reads a text from a file of that many bytes, and tells the words of each vertex's coordinates.
fn read_text<'a>(
    text: &'a str,
    bytes: usize,
    told: &mut dyn FnMut(CoordinateWords<'a>),
    pulse: &mut Pulse<'_>,
) -> Result<PolygonSoup, Unread> {
    let mut lines = content_lines(text);
    let Opening { kind, counts, words } = Opening::read(&mut lines, bytes)?;
    let last_line = text.lines().count().max(1);
    let rest = lines.map(|line| pulse.beat().map(|()| line)).collect::<Result<Vec<(usize, &str)>, _>>()?;
    let announced = Announced { kind, counts, last_line };
    // The number of edges is given and not needed.
    let all = || {
        let later =
            rest.iter().flat_map(|&(line, content)| content.split_whitespace().map(move |w| (line, w)));
        words.clone().skip(1).chain(later)
    };
    let has_lines = rest.len() >= counts.vertices + counts.faces;
    let is_short = || {
        let first = rest.first().map_or(0, |(_, content)| content.split_whitespace().count());
        !has_lines || first < kind.coordinates()
    };
    // A file with a line for each element that was cut off is not taken for one long line.
    let is_by_words = if words.len() > 1 {
        !has_lines
    } else {
        is_short() && by_words(announced, all(), &mut |_| {}, pulse).is_ok_and(|(_, left)| left == 0)
    };
    if is_by_words {
        by_words(announced, all(), told, pulse).map(|(soup, _)| soup)
    } else {
        by_lines(announced, rest.iter().copied(), told, pulse)
    }
}

/// The part of a text before the vertices.
struct Opening<'a> {
    kind: Kind,
    counts: Counts,
    /// The words that follow the numbers of vertices and faces on their line, the number of edges first; each word with its line.
    words: std::vec::IntoIter<(usize, &'a str)>,
}

impl<'a> Opening<'a> {
    /// Takes the opening from the lines of a text with their numbers; the text's file has that many bytes.
    fn read(lines: &mut impl Iterator<Item = (usize, &'a str)>, bytes: usize) -> Result<Self, Problem> {
        let (mut line, first) = lines.next().unwrap_or((1, ""));
        let mut words: Vec<(usize, &str)> = first.split_whitespace().map(|word| (line, word)).collect();
        let mut kind = Kind::default();
        if let Some((of_word, rest)) = words.first().and_then(|(_, word)| Kind::of(word)) {
            kind = of_word;
            words[0].1 = rest;
            words.retain(|(_, word)| !word.is_empty());
        }
        // The counts may stand on the first line, after the keyword, and so may all the rest.
        while words.len() < 2 + usize::from(kind.has_dimension) {
            let missing = || (Place::Line(line), "the numbers of vertices and faces are missing".to_owned());
            let (number, content) = lines.next().ok_or_else(missing)?;
            line = number;
            words.extend(content.split_whitespace().map(|word| (line, word)));
        }
        let mut words = words.into_iter();
        let mut next = |what| {
            let (line, word) = words.next().unzip();
            number::<usize>(word, line.unwrap_or(1), what)
        };
        if kind.has_dimension {
            let dimension = next("the number of coordinates")?;
            if dimension != 3 {
                let problem = format!("its vertices have {dimension} coordinates; only 3 can be read");
                return Err((Place::Line(line), problem));
            }
        }
        let counts =
            Counts { vertices: next("the number of vertices")?, faces: next("the number of faces")? };
        Ok(Self { kind, counts: counts.checked(bytes, [6, 8], Place::Line(line))?, words })
    }
}

/// The lines of a text that has one for each vertex and each face.
pub(super) struct ElementLines<'a> {
    /// The number of numbers before a vertex's colour; `None` where vertices have no colours.
    pub before_colour: Option<usize>,
    /// The lines of the vertices.
    pub vertices: Vec<&'a str>,
    /// The lines of the faces.
    pub faces: Vec<&'a str>,
}

/// The lines of the vertices and faces; `None` where they do not have one each.
pub(super) fn element_lines(text: &str) -> Option<ElementLines<'_>> {
    let mut lines = content_lines(text);
    let Opening { kind, counts, words } = Opening::read(&mut lines, text.len()).ok()?;
    let mut lines = lines.map(|(_, line)| line);
    let vertices: Vec<&str> = lines.by_ref().take(counts.vertices).collect();
    let faces: Vec<&str> = lines.take(counts.faces).collect();
    let is_whole = words.len() <= 1 && faces.len() == counts.faces;
    let before = kind.coordinates() + if kind.has_normals { 3 } else { 0 };
    let before_colour = kind.has_colours.then_some(before);
    is_whole.then_some(ElementLines { before_colour, vertices, faces })
}

/// The header of a text.
#[derive(Clone, Copy)]
struct Announced {
    kind: Kind,
    counts: Counts,
    /// The number of the last line of the text.
    last_line: usize,
}

impl Announced {
    /// The position that the next words give, each with its line; `told` gets the words.
    fn position<'a>(
        self,
        mut next: impl FnMut() -> (usize, Option<&'a str>),
        told: &mut dyn FnMut(CoordinateWords<'a>),
    ) -> Result<DVec3, Problem> {
        let (mut p, mut at, mut words) = ([0.0; 4], self.last_line, CoordinateWords::default());
        for k in 0..self.kind.coordinates() {
            let (line, word) = next();
            p[k] = number(word, line, "a coordinate")?;
            words.set(k, word.unwrap_or_default());
            at = line;
        }
        told(words);
        self.kind.position(p, Place::Line(at))
    }
}

/// One line for each element: what follows its own numbers is passed over.
fn by_lines<'a>(
    announced: Announced,
    mut lines: impl Iterator<Item = (usize, &'a str)>,
    told: &mut dyn FnMut(CoordinateWords<'a>),
    pulse: &mut Pulse<'_>,
) -> Result<PolygonSoup, Unread> {
    let mut soup = announced.counts.soup();
    let Counts { vertices, faces } = announced.counts;
    let mut next_line = |what: &str, number: usize, of: usize| {
        let problem =
            || (Place::Line(announced.last_line), format!("the file ends before {what} {number} of {of}"));
        lines.next().ok_or_else(problem)
    };
    for v in 0..vertices {
        pulse.beat()?;
        let (line, content) = next_line("vertex", v, vertices)?;
        let mut words = content.split_whitespace();
        soup.positions.push(announced.position(|| (line, words.next()), told)?);
    }
    for f in 0..faces {
        pulse.beat()?;
        let (line, content) = next_line("face", f, faces)?;
        let mut words = content.split_whitespace();
        let corners: usize = number(words.next(), line, "a number of corners")?;
        let corner = |_| number::<u32>(words.next(), line, "a vertex number");
        soup.polygons.push((0..corners).map(corner).collect::<Result<_, _>>()?);
    }
    Ok(soup)
}

/// Numbers one after another, wherever lines end: then a vertex has all the numbers that the keyword says, and faces no colours. With the
/// number of words that are left.
fn by_words<'a>(
    announced: Announced,
    mut words: impl Iterator<Item = (usize, &'a str)>,
    told: &mut dyn FnMut(CoordinateWords<'a>),
    pulse: &mut Pulse<'_>,
) -> Result<(PolygonSoup, usize), Unread> {
    let mut soup = announced.counts.soup();
    let mut next = || {
        let (line, word) = words.next().unzip();
        (line.unwrap_or(announced.last_line), word)
    };
    for _ in 0..announced.counts.vertices {
        pulse.beat()?;
        soup.positions.push(announced.position(&mut next, told)?);
        (0..announced.kind.others).for_each(|_| _ = next());
    }
    for _ in 0..announced.counts.faces {
        pulse.beat()?;
        let (line, word) = next();
        let corners: usize = number(word, line, "a number of corners")?;
        let corner = |_| {
            let (line, word) = next();
            number::<u32>(word, line, "a vertex number")
        };
        soup.polygons.push((0..corners).map(corner).collect::<Result<_, _>>()?);
    }
    Ok((soup, words.count()))
}

/// The bytes after the first line of a binary file; `None` for text.
fn binary_part(bytes: &[u8]) -> Option<(Kind, &[u8])> {
    let mut end = 0;
    for line in bytes.split_inclusive(|b| *b == b'\n') {
        end += line.len();
        let content = line.trim_ascii();
        if content.is_empty() || content.starts_with(b"#") {
            continue;
        }
        let mut words = content.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let (kind, rest) = Kind::of(std::str::from_utf8(words.next()?).ok()?)?;
        let is_binary = rest.is_empty() && words.next() == Some(b"BINARY");
        return is_binary.then_some((kind, &bytes[end..]));
    }
    None
}

/// Whole numbers and floats of 4 bytes each, the high one first.
struct Words<'a>(std::slice::Iter<'a, [u8; 4]>);

impl Words<'_> {
    fn next(&mut self, place: Place) -> Result<[u8; 4], Problem> {
        let word = self.0.next().copied();
        word.ok_or_else(|| (place, "the file ends here: it is cut off".to_owned()))
    }

    fn whole(&mut self, place: Place, what: &str) -> Result<u32, Problem> {
        let number = i32::from_be_bytes(self.next(place)?);
        u32::try_from(number).map_err(|_| (place, format!("{number} should be {what}")))
    }

    fn float(&mut self, place: Place) -> Result<f64, Problem> {
        Ok(f64::from(f32::from_be_bytes(self.next(place)?)))
    }
}

fn binary(kind: Kind, part: &[u8], pulse: &mut Pulse<'_>) -> Result<PolygonSoup, Unread> {
    let mut words = Words(part.as_chunks::<4>().0.iter());
    if kind.has_dimension && words.whole(Place::Header, "the number of coordinates")? != 3 {
        return Err((Place::Header, "its vertices do not have 3 coordinates".to_owned()).into());
    }
    let vertices = words.whole(Place::Header, "the number of vertices")? as usize;
    let faces = words.whole(Place::Header, "the number of faces")? as usize;
    words.whole(Place::Header, "the number of edges")?;
    let counts = Counts { vertices, faces }.checked(part.len(), [12, 8], Place::Header)?;
    let mut soup = counts.soup();
    for v in 0..vertices {
        pulse.beat()?;
        let place = Place::Vertex(v);
        let mut p = [0.0; 4];
        for x in &mut p[..kind.coordinates()] {
            *x = words.float(place)?;
        }
        (0..kind.others).try_for_each(|_| words.next(place).map(drop))?;
        soup.positions.push(kind.position(p, place)?);
    }
    for f in 0..faces {
        pulse.beat()?;
        let place = Place::Face(f);
        let corners = words.whole(place, "a number of corners")?;
        let polygon = (0..corners).map(|_| words.whole(place, "a vertex number"));
        soup.polygons.push(polygon.collect::<Result<_, _>>()?);
        let colours = words.whole(place, "a number of colours")?;
        (0..colours).try_for_each(|_| words.next(place).map(drop))?;
    }
    Ok(soup)
}
