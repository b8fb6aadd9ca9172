//! Numbers of screens and the light that they stand for (sRGB, IEC 61966-2-1).

use super::scalar::pow;

/// Light from 0 to 1 as a screen's number.
pub fn screen_byte(light: f64) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let screen = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * pow(light, 1.0 / 2.4) - 0.055 };
    (255.0 * screen).round() as u8
}

/// The light of a screen's number, from 0 to 1.
pub fn light_of(byte: u8) -> f64 {
    let screen = f64::from(byte) / 255.0;
    if screen <= 0.040_45 { screen / 12.92 } else { pow((screen + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_is_that_of_its_light() {
        assert!((0..=u8::MAX).all(|byte| screen_byte(light_of(byte)) == byte));
        assert_eq!([light_of(0), light_of(u8::MAX)], [0.0, 1.0]);
    }
}
