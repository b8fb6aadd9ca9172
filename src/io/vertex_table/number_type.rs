//! Types of numbers, by the names that PLY files give them.

/// The type of a number in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
    /// One byte, signed.
    Char,
    /// One byte.
    UChar,
    /// Two bytes, signed.
    Short,
    /// Two bytes.
    UShort,
    /// Four bytes, signed.
    Int,
    /// Four bytes.
    UInt,
    /// Single precision.
    Float,
    /// Double precision.
    Double,
}

impl NumberType {
    /// Its name in the head of a PLY file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Char => "char",
            Self::UChar => "uchar",
            Self::Short => "short",
            Self::UShort => "ushort",
            Self::Int => "int",
            Self::UInt => "uint",
            Self::Float => "float",
            Self::Double => "double",
        }
    }

    /// The least and the largest whole number of the type; `None` where it has fractions.
    fn limits(self) -> Option<[f64; 2]> {
        Some(match self {
            Self::Char => [i8::MIN.into(), i8::MAX.into()],
            Self::UChar => [0.0, u8::MAX.into()],
            Self::Short => [i16::MIN.into(), i16::MAX.into()],
            Self::UShort => [0.0, u16::MAX.into()],
            Self::Int => [i32::MIN.into(), i32::MAX.into()],
            Self::UInt => [0.0, u32::MAX.into()],
            Self::Float | Self::Double => return None,
        })
    }

    /// Whether its numbers are whole.
    pub fn is_whole(self) -> bool {
        self.limits().is_some()
    }

    /// The nearest number of the type.
    pub fn nearest(self, value: f64) -> f64 {
        match self.limits() {
            Some([least, most]) => value.round().clamp(least, most),
            None => value,
        }
    }

    /// Adds a number to a binary file, little-endian.
    pub fn push(self, value: f64, bytes: &mut Vec<u8>) {
        let value = self.nearest(value);
        match self {
            Self::Char => bytes.extend((value as i8).to_le_bytes()),
            Self::UChar => bytes.push(value as u8),
            Self::Short => bytes.extend((value as i16).to_le_bytes()),
            Self::UShort => bytes.extend((value as u16).to_le_bytes()),
            Self::Int => bytes.extend((value as i32).to_le_bytes()),
            Self::UInt => bytes.extend((value as u32).to_le_bytes()),
            Self::Float => bytes.extend((value as f32).to_le_bytes()),
            Self::Double => bytes.extend(value.to_le_bytes()),
        }
    }
}
