//! Numbers one after the other as little-endian bytes: how one instance of the program hands its data to another one of the same
//! build. There is no version in it, and nothing of it is kept.

use glam::DVec3;

/// Why packed bytes do not make what they should.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("packed data: {problem}")]
pub struct PackedError {
    problem: &'static str,
}

impl PackedError {
    /// An error with its sentence, without a full stop.
    pub fn new(problem: &'static str) -> Self {
        Self { problem }
    }
}

/// Takes numbers.
#[derive(Default)]
pub struct Packer {
    bytes: Vec<u8>,
}

impl Packer {
    /// The bytes of all that was added.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Adds a number of things, or a small number.
    pub fn count(&mut self, count: usize) {
        self.bytes.extend((count as u64).to_le_bytes());
    }

    /// Adds one real number.
    pub fn real(&mut self, x: f64) {
        self.reals(std::iter::once(x));
    }

    /// Adds real numbers, with their count before them.
    pub fn reals(&mut self, values: impl ExactSizeIterator<Item = f64>) {
        self.numbers(values, f64::to_le_bytes);
    }

    /// Adds real numbers in single precision, with their count before them.
    pub fn singles(&mut self, values: impl ExactSizeIterator<Item = f32>) {
        self.numbers(values, f32::to_le_bytes);
    }

    /// Adds whole numbers, with their count before them.
    pub fn wholes(&mut self, values: impl ExactSizeIterator<Item = u32>) {
        self.numbers(values, u32::to_le_bytes);
    }

    /// Adds whole numbers in threes, with their count before them.
    pub fn triples(&mut self, triples: impl ExactSizeIterator<Item = [u32; 3]>) {
        let bytes = |[a, b, c]: [u32; 3]| {
            let [[a, b, c, d], [e, f, g, h], [i, j, k, l]] = [a, b, c].map(u32::to_le_bytes);
            [a, b, c, d, e, f, g, h, i, j, k, l]
        };
        self.numbers(triples, bytes);
    }

    /// Adds places, with their count before them.
    pub fn places(&mut self, places: impl ExactSizeIterator<Item = DVec3>) {
        self.count(places.len());
        let first = self.bytes.len();
        self.bytes.resize(first + 24 * places.len(), 0);
        for (room, place) in self.bytes[first..].chunks_exact_mut(24).zip(places) {
            for (room, x) in room.chunks_exact_mut(8).zip(place.to_array()) {
                room.copy_from_slice(&x.to_le_bytes());
            }
        }
    }

    /// Adds truth values, with their count before them.
    pub fn flags(&mut self, values: impl ExactSizeIterator<Item = bool>) {
        self.numbers(values, |flag| [u8::from(flag)]);
    }

    /// Adds bytes, with their count before them.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.count(bytes.len());
        self.bytes.extend_from_slice(bytes);
    }

    fn numbers<T, const N: usize>(
        &mut self,
        values: impl ExactSizeIterator<Item = T>,
        bytes: impl Fn(T) -> [u8; N],
    ) {
        self.count(values.len());
        let first = self.bytes.len();
        self.bytes.resize(first + N * values.len(), 0);
        for (room, value) in self.bytes[first..].chunks_exact_mut(N).zip(values) {
            room.copy_from_slice(&bytes(value));
        }
    }
}

/// Gives numbers back in the order in which they were taken. Every size is compared with what is left before anything is made.
pub struct Unpacker<'a> {
    rest: &'a [u8],
}

impl<'a> Unpacker<'a> {
    /// An unpacker that begins with these bytes.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    /// Makes sure that nothing is left.
    ///
    /// # Errors
    /// [`PackedError`] where something is left.
    pub fn end(&self) -> Result<(), PackedError> {
        if self.rest.is_empty() { Ok(()) } else { Err(PackedError::new("bytes are left over")) }
    }

    /// Takes a number of things, or a small number.
    ///
    /// # Errors
    /// [`PackedError`] where the bytes end before it.
    pub fn count(&mut self) -> Result<usize, PackedError> {
        let (bytes, rest) = self.rest.split_first_chunk().ok_or(ENDS_EARLY)?;
        self.rest = rest;
        usize::try_from(u64::from_le_bytes(*bytes)).map_err(|_| ENDS_EARLY)
    }

    /// Takes one real number.
    ///
    /// # Errors
    /// [`PackedError`] where there is none, or more than one.
    pub fn real(&mut self) -> Result<f64, PackedError> {
        match self.reals()?[..] {
            [x] => Ok(x),
            _ => Err(PackedError::new("one number is many")),
        }
    }

    /// Takes real numbers.
    ///
    /// # Errors
    /// [`PackedError`] where the bytes end before them.
    pub fn reals(&mut self) -> Result<Vec<f64>, PackedError> {
        self.numbers(f64::from_le_bytes)
    }

    /// Takes real numbers in single precision.
    ///
    /// # Errors
    /// As [`Self::reals`].
    pub fn singles(&mut self) -> Result<Vec<f32>, PackedError> {
        self.numbers(f32::from_le_bytes)
    }

    /// Takes whole numbers.
    ///
    /// # Errors
    /// As [`Self::reals`].
    pub fn wholes(&mut self) -> Result<Vec<u32>, PackedError> {
        self.numbers(u32::from_le_bytes)
    }

    /// Takes whole numbers in threes.
    ///
    /// # Errors
    /// As [`Self::reals`].
    pub fn triples(&mut self) -> Result<Vec<[u32; 3]>, PackedError> {
        self.numbers(|[a, b, c, d, e, f, g, h, i, j, k, l]| {
            [[a, b, c, d], [e, f, g, h], [i, j, k, l]].map(u32::from_le_bytes)
        })
    }

    /// Takes places.
    ///
    /// # Errors
    /// As [`Self::reals`].
    pub fn places(&mut self) -> Result<Vec<DVec3>, PackedError> {
        let bytes: Vec<[u8; 24]> = self.numbers(|bytes| bytes)?;
        let place = |bytes: &[u8; 24]| {
            let mut place = [0.0; 3];
            for (x, bytes) in place.iter_mut().zip(bytes.chunks_exact(8)) {
                let mut eight = [0; 8];
                eight.copy_from_slice(bytes);
                *x = f64::from_le_bytes(eight);
            }
            DVec3::from_array(place)
        };
        Ok(bytes.iter().map(place).collect())
    }

    /// Takes truth values.
    ///
    /// # Errors
    /// As [`Self::reals`].
    pub fn flags(&mut self) -> Result<Vec<bool>, PackedError> {
        self.numbers(|[byte]| byte != 0)
    }

    /// Takes bytes.
    ///
    /// # Errors
    /// As [`Self::reals`].
    pub fn bytes(&mut self) -> Result<&'a [u8], PackedError> {
        let count = self.count()?;
        let (bytes, rest) = self.rest.split_at_checked(count).ok_or(ENDS_EARLY)?;
        self.rest = rest;
        Ok(bytes)
    }

    fn numbers<T, const N: usize>(&mut self, value: impl Fn([u8; N]) -> T) -> Result<Vec<T>, PackedError> {
        let count = self.count()?;
        let size = count.checked_mul(N).filter(|size| *size <= self.rest.len()).ok_or(ENDS_EARLY)?;
        let (bytes, rest) = self.rest.split_at(size);
        self.rest = rest;
        let (all, _) = bytes.as_chunks::<N>();
        Ok(all.iter().map(|bytes| value(*bytes)).collect())
    }
}

const ENDS_EARLY: PackedError = PackedError { problem: "it ends early" };

#[cfg(test)]
mod tests {
    use super::*;

    fn packed() -> Vec<u8> {
        let mut packer = Packer::default();
        packer.count(7);
        packer.real(-0.0);
        packer.reals([1e-300, f64::MAX].into_iter());
        packer.singles([0.1_f32].into_iter());
        packer.wholes([0, u32::MAX].into_iter());
        packer.triples([[1, 2, 3], [4, 5, 0x0102_0304]].into_iter());
        packer.places([DVec3::new(0.1, -2.0, 1e9)].into_iter());
        packer.flags([true, false].into_iter());
        packer.bytes(b"abc");
        packer.into_bytes()
    }

    fn unpack(bytes: &[u8]) -> Result<(), PackedError> {
        let mut unpacker = Unpacker::new(bytes);
        assert_eq!(unpacker.count()?, 7);
        assert_eq!(unpacker.real()?.to_bits(), (-0.0_f64).to_bits());
        assert_eq!(unpacker.reals()?, [1e-300, f64::MAX]);
        assert_eq!(unpacker.singles()?, [0.1]);
        assert_eq!(unpacker.wholes()?, [0, u32::MAX]);
        assert_eq!(unpacker.triples()?, [[1, 2, 3], [4, 5, 0x0102_0304]]);
        assert_eq!(unpacker.places()?, [DVec3::new(0.1, -2.0, 1e9)]);
        assert_eq!(unpacker.flags()?, [true, false]);
        assert_eq!(unpacker.bytes()?, b"abc");
        unpacker.end()
    }

    #[test]
    fn what_is_packed_comes_back_and_what_is_cut_off_does_not() {
        let bytes = packed();
        assert_eq!(unpack(&bytes), Ok(()));
        for length in 0..bytes.len() {
            assert!(unpack(&bytes[..length]).is_err(), "{length}");
        }
        assert!(unpack(&[&bytes[..], &[0]].concat()).is_err());
    }

    #[test]
    fn a_count_that_nothing_could_hold_is_refused_before_room_is_made() {
        for count in [u64::MAX, u64::MAX / 8, 1 << 40] {
            let bytes = count.to_le_bytes();
            assert!(Unpacker::new(&bytes).reals().is_err());
            assert!(Unpacker::new(&bytes).places().is_err());
        }
    }
}
