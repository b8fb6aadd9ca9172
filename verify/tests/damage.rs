//! Damaged files: whatever happens to the bytes, the answer is a refusal with a sentence, or a proof; never a panic.
#![allow(clippy::expect_used, clippy::unwrap_used, clippy::panic, reason = "a test fails by a panic")]

mod support;

use conemap_verify::{Proof, Refusal};
use support::{BEAN_BALL, BEAN_BALL_MIRRORED, Example, judged, meshes};

/// Random numbers with a seed (SplitMix64).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) % limit as u64) as usize
    }
}

fn tell(outcome: &Result<Proof, Refusal>) -> String {
    match outcome {
        Ok(proof) => proof.sentence(),
        Err(refusal) => refusal.to_string(),
    }
}

#[test]
fn files_that_are_cut_off_are_refused() {
    let meshes = meshes();
    let whole = Example::new(BEAN_BALL_MIRRORED).bytes();
    for length in (0..whole.len() - 8).step_by(61).chain(0..32) {
        assert!(judged(&whole[..length], &meshes).is_err(), "{length}");
    }
}

/// Bits, bytes and words are changed in files as they are written, and in files without packed sections, where more changes get past the
/// reader.
#[test]
fn damage_never_panics() {
    let meshes = meshes();
    let files = [
        BEAN_BALL_MIRRORED.to_vec(),
        Example::new(BEAN_BALL_MIRRORED).bytes(),
        Example::new(BEAN_BALL).bytes(),
    ];
    let mut random = Random(14);
    let (mut proved, mut kinds) = (0, std::collections::BTreeSet::new());
    for round in 0..3000 {
        let mut bytes = files[round % files.len()].clone();
        for _ in 0..1 + random.below(3) {
            let at = random.below(bytes.len());
            match random.below(4) {
                0 => bytes[at] ^= 1 << random.below(8),
                1 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][random.below(5)],
                2 => bytes[at..].iter_mut().take(8).for_each(|b| *b = random.below(256) as u8),
                _ => {
                    let from = random.below(bytes.len());
                    let copied: Vec<u8> = bytes[from..].iter().take(8).copied().collect();
                    bytes[at..].iter_mut().zip(copied).for_each(|(b, c)| *b = c);
                }
            }
        }
        let outcome = judged(&bytes, &meshes);
        assert!(!tell(&outcome).is_empty());
        match outcome {
            Ok(proof) => proved += usize::from(proof.is_exact()),
            Err(refusal) => {
                kinds.insert(refusal.kind());
            }
        }
    }
    // The last bits of weights, the program's name and what is not read may change without harm.
    assert!(proved > 50 && proved < 2500, "{proved}");
    assert!(kinds.len() >= 9, "{kinds:?}");
}

/// Numbers in the arrays are changed, so that every file gets to the geometry.
#[test]
fn wrong_numbers_never_panic() {
    let e = Example::new(BEAN_BALL_MIRRORED);
    let mut random = Random(41);
    let mut kinds = std::collections::BTreeSet::new();
    for _ in 0..2000 {
        let mut changed = e.clone();
        let section = random.below(changed.sections.len());
        match &mut changed.sections[section].1 {
            support::Elements::U8(x) if !x.is_empty() => {
                let at = random.below(x.len());
                x[at] = random.below(4) as u8;
            }
            support::Elements::U32(x) if !x.is_empty() => {
                let at = random.below(x.len());
                x[at] = [random.below(x.len() + 1) as u32, 0, 1, 2, 17, u32::MAX, x[at] ^ 1][random.below(7)];
            }
            support::Elements::F64(x) if !x.is_empty() => {
                let at = random.below(x.len());
                let values = [
                    0.0,
                    -0.0,
                    1.0,
                    0.5,
                    f64::NAN,
                    f64::INFINITY,
                    5e-324,
                    1e308,
                    -x[at],
                    x[at].next_up(),
                    1.0 - x[at],
                ];
                x[at] = values[random.below(values.len())];
            }
            _ => {}
        }
        let outcome = changed.judged();
        assert!(!tell(&outcome).is_empty());
        if let Err(refusal) = outcome {
            kinds.insert(refusal.kind());
        }
    }
    assert!(kinds.len() >= 8, "{kinds:?}");
}
