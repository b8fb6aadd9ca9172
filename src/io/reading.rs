//! What several readers need: text, numbers, and vertices joined by their coordinates.

use super::problem::{Place, Problem};
use crate::mesh::soup::PolygonSoup;

/// The text of a file.
pub fn text(bytes: &[u8]) -> Result<&str, Problem> {
    let text = std::str::from_utf8(bytes).map_err(|e| {
        let line = 1 + bytes[..e.valid_up_to()].iter().filter(|b| **b == b'\n').count();
        (Place::Line(line), "it holds bytes that are not text: the file may be damaged".to_owned())
    })?;
    Ok(text.trim_start_matches('\u{feff}'))
}

/// A number of a text file.
pub fn number<T: std::str::FromStr>(token: Option<&str>, line: usize, what: &str) -> Result<T, Problem> {
    let token =
        token.ok_or_else(|| (Place::Line(line), format!("{what} is missing: the file may be cut off")))?;
    let short: String = token.chars().take(20).collect();
    token.parse().map_err(|_| (Place::Line(line), format!("\"{short}\" should be {what}")))
}

/// Polygons name the first of the vertices with exactly equal coordinates; formats without shared vertices need it.
pub fn weld(mut soup: PolygonSoup) -> PolygonSoup {
    let mut first_at = rustc_hash::FxHashMap::default();
    let joined = |(number, p): (u32, &glam::DVec3)| {
        // Adding 0 makes -0 and 0 the same bits.
        let key = (*p + glam::DVec3::ZERO).to_array().map(f64::to_bits);
        *first_at.entry(key).or_insert(number)
    };
    soup.joined_with = (0..).zip(&soup.positions).map(joined).collect();
    for v in soup.polygons.iter_mut().flatten() {
        *v = soup.joined_with.get(*v as usize).copied().unwrap_or(u32::MAX);
    }
    soup
}
