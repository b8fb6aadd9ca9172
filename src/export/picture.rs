//! Pictures as PNG.

use crate::io::picture::Picture;

/// A PNG file of 8-bit red, green, blue and opacity.
///
/// # Errors
/// Where the picture has no pixels.
pub fn png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    // Pictures are bounded far below 2^32 pixels in a row.
    let mut encoder = png::Encoder::new(&mut bytes, picture.width as u32, picture.height as u32);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.pixels.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}
