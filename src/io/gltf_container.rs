//! The two parts of a glTF file: its JSON, and the binary part of a GLB.

/// Parts of a file, borrowed from its bytes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Container<'a> {
    /// The JSON.
    pub(super) json: &'a [u8],
    /// The binary part, where there is one.
    pub(super) binary: Option<&'a [u8]>,
}

/// The bytes of a GLB's header.
const HEADER: usize = 12;
/// The bytes of the header of each part of a GLB.
const PART_HEADER: usize = 8;

/// Splits a GLB; a text file is JSON alone.
pub(super) fn split(bytes: &[u8]) -> Result<Container<'_>, String> {
    if !bytes.starts_with(b"glTF") {
        return Ok(Container { json: bytes, binary: None });
    }
    let word = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
        word.map(u32::from_le_bytes).ok_or("the file ends in a header: it is cut off")
    };
    let (version, length) = (word(4)?, word(8)? as usize);
    if version != 2 {
        return Err(format!("it is of glTF version {version}; only version 2 is read: export it anew"));
    }
    if length > bytes.len() {
        return Err(format!("it should have {length} bytes and has {}: the file is cut off", bytes.len()));
    }
    let mut parts: [Option<&[u8]>; 2] = [None; 2];
    let mut at = HEADER;
    // What follows the parts is passed over, as parts of other kinds are.
    while at + PART_HEADER <= length {
        let (size, kind) = (word(at)? as usize, word(at + 4)?);
        let begin = at + PART_HEADER;
        let content = bytes[..length].get(begin..begin.saturating_add(size));
        let content = content.ok_or_else(|| {
            let there = length - begin;
            format!("a part should have {size} bytes and has {there}: the file is cut off or damaged")
        })?;
        let known = [*b"JSON", *b"BIN\0"].map(u32::from_le_bytes).iter().position(|known| *known == kind);
        if let Some(number) = known {
            parts[number] = parts[number].or(Some(content));
        }
        at = begin + size.next_multiple_of(4);
    }
    let [json, binary] = parts;
    Ok(Container { json: json.ok_or("its part JSON is missing")?, binary })
}
