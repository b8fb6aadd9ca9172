//! The bytes of a map file: a header and named arrays. Sizes are compared with the file's before memory is taken.

use crate::header::{Header, SectionEntry};
use crate::refusal::Refusal;

const MAGIC: &[u8; 8] = b"CONEMAP\0";
/// The version of the format that this crate reads.
const MAJOR: u16 = 1;
const PREAMBLE: usize = 16;
/// The largest size of a file, and of what its sections unpack to, in bytes.
const MOST_BYTES: u64 = 1 << 30;
const MOST_HEADER_BYTES: usize = 1 << 26;
/// The largest number of bytes that one deflated byte can become.
const MOST_UNPACKED: u64 = 1032;
/// The largest ratio of what is unpacked to the file's length, beside one MiB: real maps unpack to two or three times, as their
/// weights do not pack at all. So a small file takes little memory, whatever it says.
const MOST_GROWTH: u64 = 16;
const FREE_BYTES: u64 = 1 << 20;

/// A map file, its sections still packed.
pub struct Container<'a> {
    pub header: Header,
    data: &'a [u8],
}

/// Element types of the sections that are read.
#[derive(Clone, Copy)]
enum Kind {
    U8,
    U32,
    F64,
}

impl Kind {
    const fn word(self) -> &'static str {
        match self {
            Self::U8 => "u8",
            Self::U32 => "u32",
            Self::F64 => "f64",
        }
    }
}

/// Whether a section is read at all.
fn is_read(name: &str) -> bool {
    name.starts_with("vertices.") || name.starts_with("pieces.")
}

impl<'a> Container<'a> {
    pub fn open(bytes: &'a [u8]) -> Result<Self, Refusal> {
        let problem = |problem: String| Refusal::File { problem };
        if bytes.len() as u64 > MOST_BYTES {
            return Err(problem(format!("it has {} bytes; the limit is {MOST_BYTES}", bytes.len())));
        }
        let Some((preamble, rest)) = bytes.split_first_chunk::<PREAMBLE>() else {
            return Err(problem(format!("it has {} bytes and is cut off", bytes.len())));
        };
        if !preamble.starts_with(MAGIC) {
            return Err(problem("it does not begin with \"CONEMAP\"".to_owned()));
        }
        let major = u16::from_le_bytes([preamble[8], preamble[9]]);
        if major != MAJOR {
            return Err(problem(format!("it has version {major}; this program knows version {MAJOR}")));
        }
        let length = u32::from_le_bytes([preamble[12], preamble[13], preamble[14], preamble[15]]) as usize;
        if length > MOST_HEADER_BYTES || length > rest.len() {
            return Err(problem(format!("its header of {length} bytes is cut off or too long")));
        }
        let (text, data) = rest.split_at(length);
        let header: Header = serde_json::from_slice(text).map_err(|e| problem(format!("its header: {e}")))?;
        if let Some(word) = header.requires.first() {
            return Err(problem(format!("it needs \"{word}\", which this program does not know")));
        }
        let size = header.sections.iter().filter(|e| is_read(&e.name)).map(SectionEntry::unpacked_bytes);
        let size = size.fold(0, u64::saturating_add);
        if size > MOST_BYTES.min(MOST_GROWTH * bytes.len() as u64 + FREE_BYTES) {
            return Err(problem(format!("its {} bytes unpack to {size}: no map does so", bytes.len())));
        }
        Ok(Self { header, data })
    }

    pub fn bytes(&self, name: &str) -> Result<Vec<u8>, Refusal> {
        self.unpacked(name, Kind::U8)
    }

    pub fn integers(&self, name: &str) -> Result<Vec<u32>, Refusal> {
        let bytes = self.unpacked(name, Kind::U32)?;
        Ok(bytes.as_chunks().0.iter().map(|b| u32::from_le_bytes(*b)).collect())
    }

    /// A section of finite numbers.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, Refusal> {
        let bytes = self.unpacked(name, Kind::F64)?;
        let values: Vec<f64> = bytes.as_chunks().0.iter().map(|b| f64::from_le_bytes(*b)).collect();
        match values.iter().position(|x| !x.is_finite()) {
            Some(k) => Err(of_section(name, format!("element {k} is {}", values[k]))),
            None => Ok(values),
        }
    }

    fn entry(&self, name: &str) -> Result<&SectionEntry, Refusal> {
        let mut entries = self.header.sections.iter().filter(|entry| entry.name == name);
        match (entries.next(), entries.next()) {
            (Some(entry), None) => Ok(entry),
            (None, _) => Err(of_section(name, "it is missing".to_owned())),
            _ => Err(of_section(name, "it is there twice".to_owned())),
        }
    }

    fn unpacked(&self, name: &str, kind: Kind) -> Result<Vec<u8>, Refusal> {
        let entry = self.entry(name)?;
        let wrong = |problem: String| of_section(name, problem);
        if entry.kind != kind.word() {
            return Err(wrong("its elements have the wrong type".to_owned()));
        }
        let end = entry.offset.checked_add(entry.bytes).filter(|end| *end <= self.data.len() as u64);
        let Some(end) = end else { return Err(wrong("it does not lie within the file".to_owned())) };
        let stored = &self.data[entry.offset as usize..end as usize];
        // The size was bounded when the file was opened.
        let size = entry.unpacked_bytes();
        let bytes = match entry.packing.as_deref() {
            None | Some("none") => stored.to_vec(),
            Some("deflate") if size <= entry.bytes.saturating_mul(MOST_UNPACKED) => {
                miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(stored, size as usize)
                    .map_err(|_| wrong("it cannot be unpacked".to_owned()))?
            }
            Some(_) => return Err(wrong("it cannot be unpacked".to_owned())),
        };
        if bytes.len() as u64 == size {
            Ok(bytes)
        } else {
            Err(wrong(format!("it has {} bytes instead of {size}", bytes.len())))
        }
    }
}

/// A refusal that names a section.
pub fn of_section(section: &str, problem: String) -> Refusal {
    Refusal::Section { section: section.to_owned(), problem }
}

/// Whether a section has as many elements as another one demands.
pub fn expect_count(section: &str, found: usize, expected: usize) -> Result<(), Refusal> {
    if found == expected {
        return Ok(());
    }
    Err(of_section(section, format!("it has {found} elements instead of {expected}")))
}
