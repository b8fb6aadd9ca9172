//! Elementary functions with the same result on every platform.
//!
//! The standard library calls the platform's mathematics library, whose last bit differs between machines and
//! between native and wasm. These call one software implementation everywhere, so that results agree bit for bit.

pub use libm::{acos, atan2, cos, exp, hypot, log as ln, pow, sin};

/// The larger of two numbers; `b` where one is not a number.
///
/// One instruction everywhere, where `f64::max` is a function call on wasm, and the same for zeros of either sign.
#[inline]
pub fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers; `b` where one is not a number.
#[inline]
pub fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
