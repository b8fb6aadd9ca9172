//! Defects as bytes, from the instance of the program that has looked for them to the one that shows them.

use super::defect::{Defect, DefectGroup, DefectKind, Defects};
use crate::mesh::FileFrame;
use crate::mesh::packing::{PackedError, Packer, Unpacker};

impl Defects {
    /// Adds all defects to a packer, with what is needed to show them.
    pub fn pack(&self, packer: &mut Packer) {
        let Self { frame, positions, triangles, file_vertices, groups } = self;
        frame.pack(packer);
        packer.places(positions.iter().copied());
        packer.triples(triangles.iter().copied());
        packer.count(*file_vertices);
        packer.count(groups.len());
        for DefectGroup { kind, count, defects } in groups {
            packer.count(DefectKind::ALL.iter().position(|one| one == kind).unwrap_or_default());
            packer.count(*count);
            packer.count(defects.len());
            for Defect { lines, faces } in defects {
                packer.count(lines.len());
                lines.iter().for_each(|line| packer.wholes(line.iter().copied()));
                packer.wholes(faces.iter().copied());
            }
        }
    }

    /// Takes back from an unpacker the defects that [`Self::pack`] has added.
    ///
    /// # Errors
    /// [`PackedError`] where a number names nothing.
    pub fn unpack(unpacker: &mut Unpacker<'_>) -> Result<Self, PackedError> {
        let frame = FileFrame::unpack(unpacker)?;
        let (positions, triangles) = (unpacker.places()?, unpacker.triples()?);
        let file_vertices = unpacker.count()?;
        if triangles.iter().flatten().any(|v| *v as usize >= positions.len()) {
            return Err(PackedError::new("a triangle names a vertex that there is not"));
        }
        let mut found = Self { frame, positions, triangles, file_vertices, groups: Vec::new() };
        for _ in 0..unpacker.count()? {
            let group = found.group(unpacker)?;
            found.groups.push(group);
        }
        Ok(found)
    }

    fn group(&self, unpacker: &mut Unpacker<'_>) -> Result<DefectGroup, PackedError> {
        let kind = DefectKind::ALL.get(unpacker.count()?);
        let kind = *kind.ok_or(PackedError::new("a kind of defects is none"))?;
        let count = unpacker.count()?;
        let mut defects = Vec::new();
        for _ in 0..unpacker.count()? {
            let mut defect = Defect::default();
            for _ in 0..unpacker.count()? {
                defect.lines.push(unpacker.wholes()?);
            }
            defect.faces = unpacker.wholes()?;
            let is_known = defect.lines.iter().flatten().all(|v| (*v as usize) < self.positions.len())
                && defect.faces.iter().all(|f| (*f as usize) < self.triangles.len());
            if !is_known {
                return Err(PackedError::new("a defect names what there is not"));
            }
            defects.push(defect);
        }
        Ok(DefectGroup { kind, count, defects })
    }
}

#[cfg(test)]
mod tests {
    use super::super::defects;
    use super::*;
    use crate::mesh::generators::icosphere;
    use crate::mesh::repair::RepairOptions;
    use crate::mesh::soup::PolygonSoup;
    use crate::monitor::Silent;

    fn unpacked(bytes: &[u8]) -> Result<Defects, PackedError> {
        let mut unpacker = Unpacker::new(bytes);
        let found = Defects::unpack(&mut unpacker)?;
        unpacker.end()?;
        Ok(found)
    }

    #[test]
    fn defects_come_back_as_they_were_and_changed_ones_name_nothing_that_is_not_there() {
        let sphere = icosphere(1);
        let mut polygons: Vec<Vec<u32>> =
            sphere.triangles().iter().map(|t| t.iter().map(|v| v.0).collect()).collect();
        polygons.drain(10..12);
        polygons[30].reverse();
        polygons.push(vec![7, 7, 8]);
        let positions = sphere.positions().iter().copied().collect();
        let soup = PolygonSoup { positions, polygons, ..PolygonSoup::default() };
        let found = defects(&soup, &RepairOptions::default(), &mut Silent).unwrap();
        assert!(found.groups.len() >= 3);
        let mut packer = Packer::default();
        found.pack(&mut packer);
        let bytes = packer.into_bytes();
        assert_eq!(unpacked(&bytes), Ok(found));
        for at in 0..bytes.len() {
            assert!(unpacked(&bytes[..at]).is_err());
            let mut changed = bytes.clone();
            changed[at] ^= 0x81;
            if let Ok(Defects { positions, triangles, groups, .. }) = unpacked(&changed) {
                let defects = || groups.iter().flat_map(|group| &group.defects);
                assert!(triangles.iter().flatten().all(|v| (*v as usize) < positions.len()));
                assert!(defects().flat_map(|d| &d.faces).all(|f| (*f as usize) < triangles.len()));
                assert!(defects().flat_map(|d| &d.lines).flatten().all(|v| (*v as usize) < positions.len()));
            }
        }
    }
}
