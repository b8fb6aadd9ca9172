//! The container: a JSON header and named arrays, some of them packed.

use super::error::{MapFileError, SectionProblem};
use super::header::{Header, Packing, SectionEntry, SectionType};
use super::version::{MAGIC, MAJOR, MINOR, is_one};
use crate::io::MAX_BYTES;
use std::collections::BTreeMap;

/// The number of bytes before the header.
const PREAMBLE: usize = 16;
/// Sections and the header begin at multiples of this.
const ALIGNMENT: usize = 8;
/// The largest size of a header in bytes: 10 000 landmarks with names take 2 MB.
const MAX_HEADER: usize = 1 << 26;
/// The effort of packing, 0 to 10: more takes three times as long for a file that is 3 % smaller.
const LEVEL: u8 = 1;
/// The largest number of bytes that one deflated byte can become.
const MOST_UNPACKED: u64 = 1032;

/// Sections being written.
#[derive(Default)]
pub(super) struct Sections {
    entries: Vec<SectionEntry>,
    data: Vec<u8>,
}

impl Sections {
    /// Adds a section of small integers, packed.
    pub fn bytes(&mut self, name: &str, values: &[u8]) {
        self.push(name, SectionType::U8, values.len(), values, Packing::Deflate);
    }

    /// Adds a section of integers, packed.
    pub fn integers(&mut self, name: &str, values: &[u32]) {
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.push(name, SectionType::U32, values.len(), &bytes, Packing::Deflate);
    }

    /// Adds a section of numbers as they are: their digits do not pack.
    pub fn numbers(&mut self, name: &str, values: &[f64]) {
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.push(name, SectionType::F64, values.len(), &bytes, Packing::None);
    }

    fn push(&mut self, name: &str, kind: SectionType, count: usize, bytes: &[u8], packing: Packing) {
        let packed =
            (packing == Packing::Deflate).then(|| miniz_oxide::deflate::compress_to_vec_zlib(bytes, LEVEL));
        let stored = packed.as_deref().unwrap_or(bytes);
        let entry = SectionEntry {
            name: name.to_owned(),
            kind,
            count: count as u64,
            packing,
            offset: self.data.len() as u64,
            bytes: stored.len() as u64,
        };
        self.entries.push(entry);
        self.data.extend_from_slice(stored);
        self.data.resize(self.data.len().next_multiple_of(ALIGNMENT), 0);
    }

    /// The whole file.
    pub fn into_file(self, header: Header) -> Vec<u8> {
        let header = Header { sections: self.entries, ..header };
        // Strings, numbers and lists always have JSON.
        let mut text = serde_json::to_vec(&header).unwrap_or_default();
        text.resize(text.len().next_multiple_of(ALIGNMENT), b' ');
        let mut file = Vec::with_capacity(PREAMBLE + text.len() + self.data.len());
        file.extend(MAGIC);
        file.extend(MAJOR.to_le_bytes());
        file.extend(MINOR.to_le_bytes());
        file.extend((text.len() as u32).to_le_bytes());
        file.extend(text);
        file.extend(self.data);
        file
    }
}

/// A file's header and where its sections lie.
pub(super) struct Container<'a> {
    pub header: Header,
    data: &'a [u8],
    by_name: BTreeMap<String, SectionEntry>,
}

impl<'a> Container<'a> {
    /// Reads the header and compares all sizes with the file's before anything is unpacked.
    pub fn open(bytes: &'a [u8]) -> Result<Self, MapFileError> {
        if bytes.len() > MAX_BYTES {
            return Err(MapFileError::TooLarge { bytes: bytes.len() as u64 });
        }
        if !is_one(bytes) {
            return Err(MapFileError::NotAMapFile);
        }
        let cut_off = |needed: u64| MapFileError::CutOff { bytes: bytes.len(), needed };
        let preamble = bytes.get(MAGIC.len()..PREAMBLE).ok_or(cut_off(PREAMBLE as u64))?;
        let major = u16::from_le_bytes([preamble[0], preamble[1]]);
        if major != MAJOR {
            return Err(MapFileError::Version { major });
        }
        let length = u32::from_le_bytes([preamble[4], preamble[5], preamble[6], preamble[7]]) as usize;
        if length > MAX_HEADER {
            return Err(MapFileError::Header {
                problem: format!("it has {length} bytes; the limit is {MAX_HEADER}"),
            });
        }
        let text = bytes.get(PREAMBLE..PREAMBLE + length).ok_or(cut_off((PREAMBLE + length) as u64))?;
        let data = &bytes[PREAMBLE + length..];
        let header: Header =
            serde_json::from_slice(text).map_err(|e| MapFileError::Header { problem: e.to_string() })?;
        if let Some(what) = header.requires.first() {
            return Err(MapFileError::Needs { what: what.clone() });
        }
        let by_name = sizes_checked(&header.sections, data.len())?;
        Ok(Self { header, data, by_name })
    }

    /// Whether there is such a section.
    pub fn has(&self, name: &str) -> bool {
        self.by_name.contains_key(name)
    }

    /// A section of small integers.
    pub fn bytes(&self, name: &str) -> Result<Vec<u8>, MapFileError> {
        self.unpacked(name, SectionType::U8)
    }

    /// A section of integers.
    pub fn integers(&self, name: &str) -> Result<Vec<u32>, MapFileError> {
        let bytes = self.unpacked(name, SectionType::U32)?;
        Ok(bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect())
    }

    /// A section of numbers, all finite.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, MapFileError> {
        let bytes = self.unpacked(name, SectionType::F64)?;
        let number = |b: &[u8]| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]);
        let values: Vec<f64> = bytes.chunks_exact(8).map(number).collect();
        match values.iter().position(|x| !x.is_finite()) {
            Some(index) => Err(fault(name, Some(index), SectionProblem::Number { value: values[index] })),
            None => Ok(values),
        }
    }

    fn unpacked(&self, name: &str, kind: SectionType) -> Result<Vec<u8>, MapFileError> {
        let entry = self.by_name.get(name).ok_or_else(|| fault(name, None, SectionProblem::Missing))?;
        if entry.kind != kind {
            return Err(fault(name, None, SectionProblem::Type));
        }
        // Checked when the file was opened.
        let stored = &self.data[entry.offset as usize..(entry.offset + entry.bytes) as usize];
        let size = entry.unpacked_size().unwrap_or_default() as usize;
        let bytes = match entry.packing {
            Packing::Other => return Err(fault(name, None, SectionProblem::Packed)),
            Packing::None => stored.to_vec(),
            Packing::Deflate => miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(stored, size)
                .map_err(|_| fault(name, None, SectionProblem::Packed))?,
        };
        if bytes.len() == size { Ok(bytes) } else { Err(fault(name, None, SectionProblem::Packed)) }
    }
}

/// The sections by name, each within the data and none larger unpacked than its bytes can hold.
fn sizes_checked(
    sections: &[SectionEntry],
    length: usize,
) -> Result<BTreeMap<String, SectionEntry>, MapFileError> {
    let mut by_name = BTreeMap::new();
    let mut total = 0_u64;
    for entry in sections {
        let wrong = |problem| fault(&entry.name, None, problem);
        let end = entry.offset.checked_add(entry.bytes);
        if end.is_none_or(|end| end > length as u64) {
            return Err(wrong(SectionProblem::Outside));
        }
        // A section that this version does not know is never unpacked.
        let size = entry.unpacked_size().unwrap_or_default();
        total = total.saturating_add(size);
        if total > MAX_BYTES as u64 {
            return Err(MapFileError::TooLarge { bytes: total });
        }
        let fits = match entry.packing {
            _ if entry.kind == SectionType::Other => true,
            Packing::None => size == entry.bytes,
            Packing::Deflate => size <= entry.bytes.saturating_mul(MOST_UNPACKED),
            Packing::Other => true,
        };
        if !fits {
            return Err(wrong(SectionProblem::Packed));
        }
        if by_name.insert(entry.name.clone(), entry.clone()).is_some() {
            return Err(wrong(SectionProblem::Twice));
        }
    }
    Ok(by_name)
}

/// The error of a section.
pub(super) fn fault(section: &str, index: Option<usize>, problem: SectionProblem) -> MapFileError {
    MapFileError::Section { section: section.to_owned(), index, problem }
}
