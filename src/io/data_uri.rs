//! Data in an address: `data:TYPE;base64,CODE`.

use base64::alphabet::{STANDARD, URL_SAFE};
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use base64::{DecodeError, Engine};

/// Either alphabet, with or without padding at the end: files have all of them.
const LENIENT: GeneralPurposeConfig =
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent);
/// The usual alphabet of base64.
const USUAL: GeneralPurpose = GeneralPurpose::new(&STANDARD, LENIENT);
/// The alphabet of base64 for addresses.
const OF_ADDRESSES: GeneralPurpose = GeneralPurpose::new(&URL_SAFE, LENIENT);

/// The data of an address that holds them; `None` for other addresses.
pub(super) fn data(uri: &str) -> Option<Result<Vec<u8>, DecodeError>> {
    let (_, code) = uri.strip_prefix("data:")?.split_once(";base64,")?;
    Some(USUAL.decode(code).or_else(|e| OF_ADDRESSES.decode(code).map_err(|_| e)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_alphabets_are_read_with_and_without_an_end() {
        let bytes = vec![0xfb, 0xff, 0xfe, 0x01];
        for code in ["+//+AQ==", "+//+AQ", "-__-AQ==", "-__-AQ"] {
            assert_eq!(data(&format!("data:a/b;c=d;base64,{code}")), Some(Ok(bytes.clone())), "{code}");
        }
        assert!(data("data:;base64,=A").unwrap().is_err());
        assert_eq!(["a.bin", "data:,AA", "a;base64,AA"].map(data), [None, None, None]);
    }
}
