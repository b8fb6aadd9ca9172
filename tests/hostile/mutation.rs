//! Changes of files that may break readers: of bytes, of numbers in text, of whole numbers in binary files, of the order of parts.

use conemap::math::random::SplitMix;

/// Unusual numbers, as text.
const NUMBERS: [&str; 20] = [
    "0",
    "-1",
    "1",
    "2",
    "3",
    "255",
    "65536",
    "2147483647",
    "4294967295",
    "-2147483648",
    "9223372036854775807",
    "18446744073709551615",
    "1e308",
    "-1e-308",
    "1e999",
    "nan",
    "inf",
    "0.5",
    "",
    "1000000000",
];

/// Words and signs of the file formats.
const WORDS: [&str; 24] = [
    "\n",
    "\r",
    "\r\n",
    " ",
    "\\\n",
    "#",
    ",",
    ";",
    "\"",
    "[",
    "]",
    "{",
    "}",
    "\u{feff}",
    "v ",
    "f ",
    "OFF",
    "4OFF",
    "element vertex 9",
    "property list uchar int ",
    "end_header\n",
    "endsolid",
    "null",
    "\0",
];

/// A source of random changes; the same seed gives the same changes.
pub struct Mutator {
    random: SplitMix,
}

impl Mutator {
    pub fn new(seed: u64) -> Self {
        Self { random: SplitMix::new(seed) }
    }

    /// A random number below `most`.
    pub fn below(&mut self, most: usize) -> usize {
        ((self.random.unit() * most as f64) as usize).min(most.saturating_sub(1))
    }

    /// One of the files, chosen at random, with some changes.
    pub fn changed(&mut self, files: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = files[self.below(files.len())].clone();
        let binary_part = json_end(&bytes);
        for _ in 0..=self.below(6) {
            self.change(&mut bytes, files);
        }
        // Seven times of eight the container is repaired, so that its content is read.
        if let Some(end) = binary_part.filter(|_| self.below(8) > 0) {
            restore_container(&mut bytes, end);
        }
        bytes
    }

    fn change(&mut self, bytes: &mut Vec<u8>, files: &[Vec<u8>]) {
        let at = self.below(bytes.len() + 1);
        let longest = 1 + self.below(64);
        let length = self.below(longest).min(bytes.len() - at);
        match self.below(10) {
            0 => self.overwrite(bytes, at, 1),
            1 => self.overwrite(bytes, at, 4),
            2 => self.overwrite(bytes, at, 8),
            3 => drop(bytes.drain(at..at + length)),
            4 => {
                let part = bytes[at..at + length].to_vec();
                bytes.splice(at..at, part);
            }
            5 => {
                let other = &files[self.below(files.len())];
                let from = self.below(other.len() + 1);
                let part = other[from..(from + length).min(other.len())].to_vec();
                bytes.splice(at..at, part);
            }
            6 => bytes.truncate(at),
            7 => {
                let word = WORDS[self.below(WORDS.len())];
                bytes.splice(at..at, word.bytes());
            }
            _ => self.replace_number(bytes, at),
        }
    }

    /// Overwrites bytes with an unusual whole number.
    fn overwrite(&mut self, bytes: &mut [u8], at: usize, size: usize) {
        let any = (self.random.unit() * 1.8e19) as u64;
        let number =
            [0, 1, 0x7f, 0x80, 0xff, 0xffff, 0x7fff_ffff, 0xffff_ffff, u64::MAX, any][self.below(10)];
        let little = number.to_le_bytes();
        let big = (number << (8 * (8 - size))).to_be_bytes();
        let new = if self.below(4) == 0 { &big[..size] } else { &little[..size] };
        for (byte, new) in bytes.iter_mut().skip(at).zip(new) {
            *byte = *new;
        }
    }

    /// Replaces the next number of a text by another one.
    fn replace_number(&mut self, bytes: &mut Vec<u8>, at: usize) {
        let Some(begin) = bytes[at..].iter().position(u8::is_ascii_digit).map(|k| at + k) else { return };
        let is_of_number = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'e' | b'-' | b'+');
        let end = bytes[begin..].iter().position(|b| !is_of_number(b)).map_or(bytes.len(), |k| begin + k);
        let number = NUMBERS[self.below(NUMBERS.len())];
        bytes.splice(begin..end, number.bytes());
    }
}

/// The end of the JSON of a GLB, counted in bytes from the end of the file.
fn json_end(bytes: &[u8]) -> Option<usize> {
    let length = u32::from_le_bytes(bytes.get(12..16)?.try_into().ok()?) as usize;
    bytes.starts_with(b"glTF").then(|| bytes.len().saturating_sub(20 + length))
}

/// Corrects the lengths in the header of a changed GLB; the part after its JSON kept its length.
fn restore_container(bytes: &mut [u8], after_json: usize) {
    let total = bytes.len();
    let Some(json) = total.checked_sub(20 + after_json) else { return };
    bytes[..4].copy_from_slice(b"glTF");
    bytes[4..8].copy_from_slice(&2_u32.to_le_bytes());
    bytes[8..12].copy_from_slice(&(total as u32).to_le_bytes());
    bytes[12..16].copy_from_slice(&(json as u32).to_le_bytes());
    bytes[16..20].copy_from_slice(b"JSON");
}

/// A copy of a map file with none of its sections compressed, so that changes reach their content.
pub fn unpacked(map: &[u8]) -> Vec<u8> {
    let length = u32::from_le_bytes(map[12..16].try_into().unwrap()) as usize;
    let (text, sections) = map[16..].split_at(length);
    let mut header: serde_json::Value = serde_json::from_slice(text).unwrap();
    let mut data = Vec::new();
    for entry in header["sections"].as_array_mut().unwrap() {
        let [offset, bytes] = ["offset", "bytes"].map(|key| entry[key].as_u64().unwrap() as usize);
        let mut content = sections[offset..offset + bytes].to_vec();
        if entry["packing"] == "deflate" {
            content = miniz_oxide::inflate::decompress_to_vec_zlib(&content).unwrap();
        }
        entry["packing"] = "none".into();
        (entry["offset"], entry["bytes"]) = (data.len().into(), content.len().into());
        data.extend(content);
        data.resize(data.len().next_multiple_of(8), 0);
    }
    let mut text = serde_json::to_vec(&header).unwrap();
    text.resize(text.len().next_multiple_of(8), b' ');
    [&map[..12], &(text.len() as u32).to_le_bytes(), &text, &data].concat()
}
