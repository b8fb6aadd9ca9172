//! A text file that is written again as it was written: its mark, its encoding and its words stay.

use super::reading::{text, unmarked};
use std::fmt::{Display, Write};

/// How the characters of a text are written as bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Utf8,
    Utf16Little,
    Utf16Big,
    Latin1,
}

/// A text with the way in which its file is written.
#[derive(Debug)]
pub(super) struct WrittenText {
    /// The characters, without the mark.
    pub text: String,
    mark: Vec<u8>,
    encoding: Encoding,
}

impl WrittenText {
    /// The text of a file; `None` where it is none, or would not become the same bytes again.
    pub(super) fn of(bytes: &[u8]) -> Option<Self> {
        // The same steps as those of `read_mesh` and its readers.
        let unmarked = unmarked(bytes);
        let decoded = text(&unmarked).ok()?;
        let encoding = match bytes {
            [0xff, 0xfe, ..] => Encoding::Utf16Little,
            [0xfe, 0xff, ..] => Encoding::Utf16Big,
            _ if std::str::from_utf8(bytes).is_ok() => Encoding::Utf8,
            _ => Encoding::Latin1,
        };
        let mark = match encoding {
            Encoding::Utf16Little | Encoding::Utf16Big => 2,
            Encoding::Utf8 | Encoding::Latin1 => bytes.len() - unmarked.len(),
        };
        let written = Self { text: decoded.into_owned(), mark: bytes[..mark].to_vec(), encoding };
        (written.encoded(&written.text) == bytes).then_some(written)
    }

    /// The bytes of another text, with this one's mark and encoding.
    pub(super) fn encoded(&self, text: &str) -> Vec<u8> {
        let mut bytes = self.mark.clone();
        match self.encoding {
            Encoding::Utf8 => bytes.extend(text.bytes()),
            Encoding::Utf16Little => bytes.extend(text.encode_utf16().flat_map(u16::to_le_bytes)),
            Encoding::Utf16Big => bytes.extend(text.encode_utf16().flat_map(u16::to_be_bytes)),
            // All of them are one byte: they were read from one, or stand in for numbers.
            Encoding::Latin1 => bytes.extend(text.chars().map(|c| u8::try_from(c).unwrap_or(b'?'))),
        }
        bytes
    }
}

/// A text in which some words are replaced; all else stays.
pub(super) struct Replacing<'a> {
    text: &'a str,
    /// Number of bytes of the text that are dealt with.
    done: usize,
    result: String,
}

impl<'a> Replacing<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, done: 0, result: String::with_capacity(text.len() + text.len() / 2) }
    }

    /// Puts something in the place of a part of the text, which must lie behind all that were replaced before.
    pub(super) fn replace(&mut self, part: &'a str, new: impl Display) {
        let begin = part.as_ptr() as usize - self.text.as_ptr() as usize;
        self.result.push_str(&self.text[self.done..begin]);
        // Writing to a string does not fail.
        let _ = write!(self.result, "{new}");
        self.done = begin + part.len();
    }

    /// Leaves out a part and the end of its line.
    pub(super) fn leave_out_line(&mut self, line: &'a str) {
        self.replace(line, "");
        let rest = &self.text[self.done..];
        let end = ["\r\n", "\n", "\r"].into_iter().find(|end| rest.starts_with(end));
        self.done += end.map_or(0, str::len);
    }

    pub(super) fn finish(mut self) -> String {
        self.result.push_str(&self.text[self.done..]);
        self.result
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_become_the_same_bytes_again() {
        let utf16 =
            |order: fn(u16) -> [u8; 2]| "\u{feff}v é".encode_utf16().flat_map(order).collect::<Vec<u8>>();
        let files = [
            b"v \xe9".to_vec(),
            "v é".as_bytes().to_vec(),
            "\u{feff}v é".as_bytes().to_vec(),
            b"\xef\xbb\xbfv \xe9".to_vec(),
            utf16(u16::to_le_bytes),
            utf16(u16::to_be_bytes),
        ];
        for bytes in files {
            let written = WrittenText::of(&bytes).unwrap();
            assert_eq!(written.text, "v é", "{bytes:?}");
            assert_eq!(written.encoded("v é"), bytes);
        }
        // Half a character at the end, and half of a pair.
        for bytes in [&b"\xff\xfev\0\0"[..], b"\xff\xfe\0\xd8v\0", b"v\0"] {
            assert!(WrittenText::of(bytes).is_none(), "{bytes:?}");
        }
    }

    #[test]
    fn parts_are_replaced_and_lines_left_out() {
        let text = "a b\r\nc\rd\ne";
        let mut replacing = Replacing::new(text);
        replacing.replace(&text[2..3], 7);
        replacing.leave_out_line(&text[5..6]);
        replacing.leave_out_line(&text[7..8]);
        replacing.leave_out_line(&text[9..10]);
        assert_eq!(replacing.finish(), "a 7\r\n");
    }
}
