//! OFF meshes.

use crate::mesh::soup::PolygonSoup;

/// Reads an OFF file (placeholder reader for well-formed files).
pub fn read(bytes: &[u8]) -> Option<PolygonSoup> {
    let text = std::str::from_utf8(bytes).ok()?;
    let mut tokens =
        text.lines().filter(|l| !l.trim_start().starts_with('#')).flat_map(str::split_whitespace);
    (tokens.next()? == "OFF").then_some(())?;
    let vertices: usize = tokens.next()?.parse().ok()?;
    let faces: usize = tokens.next()?.parse().ok()?;
    tokens.next()?;
    let mut soup = PolygonSoup::default();
    for _ in 0..vertices {
        let mut number = || tokens.next()?.parse::<f64>().ok();
        soup.positions.push(glam::DVec3::new(number()?, number()?, number()?));
    }
    for _ in 0..faces {
        let n: usize = tokens.next()?.parse().ok()?;
        soup.polygons.push((0..n).map(|_| tokens.next()?.parse().ok()).collect::<Option<_>>()?);
    }
    Some(soup)
}
