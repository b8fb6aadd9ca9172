//! Pictures: files that browsers show are checked before they are decoded; PNG files are read as pixels.

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
    #[error("this is no {wanted} file: save the picture as PNG")]
    UnknownFormat {
        /// The formats that are read.
        wanted: &'static str,
    },
    /// The picture is too large.
    #[error("the picture has {width} x {height} pixels; the limit is {MAX_PIXELS}: make it smaller")]
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

/// Checks a picture that a browser is to decode, by its head alone.
///
/// # Errors
/// [`PictureError`]: it is no PNG, JPEG or WebP file, its head is damaged, or it has more than [`MAX_PIXELS`] pixels.
pub fn check(bytes: &[u8]) -> Result<(), PictureError> {
    if media_type(bytes).is_none() {
        return Err(PictureError::UnknownFormat { wanted: "PNG, JPEG or WebP" });
    }
    let size = imagesize::blob_size(bytes).map_err(|e| PictureError::Malformed(e.to_string()))?;
    check_size([size.width, size.height])
}

fn check_size([width, height]: [usize; 2]) -> Result<(), PictureError> {
    match width.checked_mul(height) {
        Some(1..=MAX_PIXELS) => Ok(()),
        Some(0) => Err(PictureError::Malformed("it has no pixels".to_owned())),
        _ => Err(PictureError::TooLarge { width, height }),
    }
}

/// Reads a PNG file.
///
/// # Errors
/// [`PictureError`].
pub fn read(bytes: &[u8]) -> Result<Picture, PictureError> {
    if !bytes.starts_with(b"\x89PNG") {
        return Err(PictureError::UnknownFormat { wanted: "PNG" });
    }
    let malformed = |e: png::DecodingError| PictureError::Malformed(e.to_string());
    let limits = png::Limits { bytes: MAX_BYTES };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(malformed)?;
    let [width, height] = [reader.info().width as usize, reader.info().height as usize];
    check_size([width, height])?;
    let size = reader.output_buffer_size().ok_or(PictureError::TooLarge { width, height })?;
    let mut samples = vec![0; size];
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
pub(super) mod tests {
    use super::*;
    use crate::export::picture::png;

    #[test]
    fn what_was_written_is_read() {
        let pixels = (0..6_u8).map(|k| [k, 255 - k, 7 * k, 200 + k]).collect();
        let picture = Picture { width: 3, height: 2, pixels };
        let bytes = png(&picture).unwrap();
        assert_eq!(read(&bytes).unwrap(), picture);
        assert!(matches!(read(&bytes[..40]), Err(PictureError::Malformed(_))));
        assert_eq!(read(b"\xff\xd8\xff\xe0 JFIF"), Err(PictureError::UnknownFormat { wanted: "PNG" }));
    }

    /// The head of a JPEG file: a segment that says nothing, then the frame of so many pixels.
    fn jpeg([width, height]: [u16; 2]) -> Vec<u8> {
        let [[w, x], [h, i]] = [width, height].map(u16::to_be_bytes);
        let frame = [0xff, 0xc0, 0, 17, 8, h, i, w, x, 3, 1, 0x22, 0, 2, 0x11, 1, 3, 0x11, 1];
        [&[0xff, 0xd8, 0xff, 0xe0, 0, 16], &b"JFIF\0\x01\x01\0\0\x01\0\x01\0\0"[..], &frame].concat()
    }

    /// The head of a WebP file of so many pixels: with an alpha channel, lossless, lossy.
    fn webps([width, height]: [u32; 2]) -> [Vec<u8>; 3] {
        let of = |kind: &[u8; 4], data: &[u8]| {
            let size = (data.len() as u32).to_le_bytes();
            let chunk = [&kind[..], &size, data].concat();
            [&b"RIFF"[..], &(chunk.len() as u32 + 4).to_le_bytes(), b"WEBP", &chunk].concat()
        };
        let [less_w, less_h] = [width - 1, height - 1].map(u32::to_le_bytes);
        let extended = [&[0x10, 0, 0, 0], &less_w[..3], &less_h[..3]].concat();
        let packed = (width - 1) & 0x3fff | ((height - 1) & 0x3fff) << 14;
        let lossless = [&[0x2f][..], &packed.to_le_bytes(), &[0; 8]].concat();
        let [w, h] = [width, height].map(|n| ((n & 0x3fff) as u16).to_le_bytes());
        let lossy = [&[0, 0, 0, 0x9d, 0x01, 0x2a][..], &w, &h, &[0; 8]].concat();
        [of(b"VP8X", &extended), of(b"VP8L", &lossless), of(b"VP8 ", &lossy)]
    }

    #[test]
    fn what_a_browser_would_decode_is_checked_by_its_head() {
        for size in [[7, 5], [4096, 4096], [16_383, 8_192]] {
            assert_eq!(check(&jpeg(size.map(|n| n as u16))), Ok(()));
            webps(size).iter().for_each(|webp| assert_eq!(check(webp), Ok(()), "{size:?}"));
        }
        let [width, height] = [60_000_u32, 50_000];
        let refused = Err(PictureError::TooLarge { width: 60_000, height: 50_000 });
        assert_eq!(check(&jpeg([width as u16, height as u16])), refused);
        assert_eq!(check(&webps([width, height])[0]), refused);
        assert_eq!(check(&png_that_announces([60_000, 50_000])), refused);
        assert!(matches!(check(&png_that_announces([0, 3])), Err(PictureError::Malformed(_))));
        for cut in 0..24 {
            for file in [jpeg([7, 5]), webps([7, 5])[1].clone(), png_that_announces([7, 5])] {
                assert!(check(&file[..cut]).is_err(), "{cut} bytes");
            }
        }
        assert_eq!(check(b"GIF89a"), Err(PictureError::UnknownFormat { wanted: "PNG, JPEG or WebP" }));
    }

    #[test]
    fn a_picture_that_announces_much_is_refused_at_once() {
        let bytes = png_that_announces([65_536, 65_536]);
        assert_eq!(read(&bytes), Err(PictureError::TooLarge { width: 65536, height: 65536 }));
    }

    /// A PNG file of one pixel whose head tells another size.
    pub(in crate::io) fn png_that_announces(size: [u32; 2]) -> Vec<u8> {
        let picture = Picture { width: 1, height: 1, pixels: vec![[0; 4]] };
        let mut bytes = png(&picture).unwrap();
        bytes[16..24].copy_from_slice(&size.map(u32::to_be_bytes).concat());
        // The head's checksum made to fit.
        let sum = checksum(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&sum.to_be_bytes());
        bytes
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
