//! Pictures as pixels; PNG files are read.

use super::MAX_BYTES;
use std::io::Cursor;

/// A picture of 8-bit colours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Red, green, blue and opacity, row by row from the top.
    pub pixels: Vec<[u8; 4]>,
}

/// The largest number of pixels: a small file can hold a picture of any size.
pub const MAX_PIXELS: usize = 1 << 27;

/// Why a picture cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The picture has another format.
    #[error("this is no PNG file: save the picture as PNG")]
    UnknownFormat,
    /// The picture is too large.
    #[error("the picture has {width} x {height} pixels; the limit is {MAX_PIXELS}")]
    TooLarge {
        /// Pixels in a row.
        width: usize,
        /// Number of rows.
        height: usize,
    },
    /// Something in the file is wrong.
    #[error("the picture cannot be read: {0}: the file may be damaged")]
    Malformed(String),
}

/// The media type of a file that begins as a picture which browsers show; `None` for any other.
pub fn media_type(bytes: &[u8]) -> Option<&'static str> {
    let is_webp = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP");
    let kinds = [
        (bytes.starts_with(b"\x89PNG"), "image/png"),
        (bytes.starts_with(b"\xff\xd8\xff"), "image/jpeg"),
        (is_webp, WEBP),
    ];
    kinds.into_iter().find(|(is_so, _)| *is_so).map(|(_, name)| name)
}

/// The media type of WebP pictures.
pub const WEBP: &str = "image/webp";

/// Reads a PNG file.
///
/// # Errors
/// [`PictureError`].
pub fn read(bytes: &[u8]) -> Result<Picture, PictureError> {
    if !bytes.starts_with(b"\x89PNG") {
        return Err(PictureError::UnknownFormat);
    }
    let malformed = |e: png::DecodingError| PictureError::Malformed(e.to_string());
    let limits = png::Limits { bytes: MAX_BYTES };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(malformed)?;
    let [width, height] = [reader.info().width as usize, reader.info().height as usize];
    let too_large = || PictureError::TooLarge { width, height };
    if width.checked_mul(height).is_none_or(|pixels| pixels > MAX_PIXELS) {
        return Err(too_large());
    }
    let mut samples = vec![0; reader.output_buffer_size().ok_or_else(too_large)?];
    let frame = reader.next_frame(&mut samples).map_err(malformed)?;
    let pixel = |s: &[u8]| match *s {
        [grey] => [grey, grey, grey, 255],
        [grey, opacity] => [grey, grey, grey, opacity],
        [red, green, blue] => [red, green, blue, 255],
        [red, green, blue, opacity] => [red, green, blue, opacity],
        _ => [0; 4],
    };
    let pixels: Vec<_> =
        samples.chunks_exact(frame.color_type.samples()).take(width * height).map(pixel).collect();
    if pixels.len() != width * height {
        return Err(PictureError::Malformed("it has too few pixels".to_owned()));
    }
    Ok(Picture { width, height, pixels })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::picture::png;

    #[test]
    fn what_was_written_is_read() {
        let pixels = (0..6_u8).map(|k| [k, 255 - k, 7 * k, 200 + k]).collect();
        let picture = Picture { width: 3, height: 2, pixels };
        let bytes = png(&picture).unwrap();
        assert_eq!(read(&bytes).unwrap(), picture);
        assert!(matches!(read(&bytes[..40]), Err(PictureError::Malformed(_))));
        assert_eq!(read(b"\xff\xd8\xff\xe0 JFIF"), Err(PictureError::UnknownFormat));
    }

    #[test]
    fn a_picture_that_announces_much_is_refused_at_once() {
        let picture = Picture { width: 1, height: 1, pixels: vec![[0; 4]] };
        let mut bytes = png(&picture).unwrap();
        // Width and height in the head, and the head's checksum made to fit.
        bytes[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
        let sum = checksum(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&sum.to_be_bytes());
        assert_eq!(read(&bytes), Err(PictureError::TooLarge { width: 65536, height: 65536 }));
    }

    /// CRC-32, as PNG has it.
    fn checksum(bytes: &[u8]) -> u32 {
        let step = |sum: u32, byte: &u8| {
            (0..8)
                .fold(sum ^ u32::from(*byte), |s, _| if s & 1 == 1 { 0xedb8_8320 ^ (s >> 1) } else { s >> 1 })
        };
        !bytes.iter().fold(u32::MAX, step)
    }
}
