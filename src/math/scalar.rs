//! Elementary functions with the same result on every platform.
//!
//! The standard library calls the platform's mathematics library, whose last bit differs between machines and
//! between native and wasm. These call one software implementation everywhere, so that results agree bit for bit.

pub use libm::{acos, atan2, cos, exp, hypot, log as ln, pow, sin};
