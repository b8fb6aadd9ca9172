//! Signs of determinants, exactly.
//!
//! The sign is that of f64 where the value is beyond a bound of all rounding, and else that of integers: every f64 is an
//! integer times a power of two.

use num_bigint::{BigInt, Sign};

/// A number in [0, 1] that is known exactly: the sum of two f64, the second one below the rounding of the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weight {
    high: f64,
    low: f64,
}

/// Three weights: a point of a triangle, up to the division by their sum.
pub type Weights = [Weight; 3];

impl Weight {
    /// A number as it is.
    pub const fn new(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// 1 - t, exactly, for t in [0, 1].
    pub fn rest(t: f64) -> Self {
        let high = 1.0 - t;
        // Knuth's two-sum: the part that the rounding of the difference lost.
        let of_t = 1.0 - high;
        let of_one = high + of_t;
        Self { high, low: (1.0 - of_one) + (of_t - t) }
    }

    /// The nearest f64.
    pub fn value(self) -> f64 {
        self.high
    }
}

/// The largest weight, so that six products of three weights, with all their rounding, are off by less than `CERTAIN`.
pub const LARGEST: f64 = 1.0 + 1e-9;

/// The size of a determinant in f64 beyond which it has the sign of the exact one. Entries are off by 2^-53 of themselves and at
/// most [`LARGEST`]; each of six products takes two roundings, their sums five: below 64 x 2^-53 = 7.2e-15 in all.
const CERTAIN: f64 = 2e-14;

/// Counts the signs that were found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// The number of signs that were asked for.
    pub signs: u64,
    /// The number of signs that f64 could not tell.
    pub by_integers: u64,
}

impl Tally {
    /// The sign (-1, 0 or 1) of the determinant with these rows: whether three points of a triangle are counter-clockwise.
    pub fn orientation(&mut self, rows: [&Weights; 3]) -> i8 {
        self.signs += 1;
        let value = determinant(rows);
        if value.abs() > CERTAIN {
            return if value > 0.0 { 1 } else { -1 };
        }
        self.by_integers += 1;
        exact_sign(rows)
    }
}

/// The determinant in f64: of points with weights that sum to 1, the share of the triangle that theirs covers.
pub fn determinant(rows: [&Weights; 3]) -> f64 {
    let [a, b, c] = rows.map(|row| row.map(Weight::value));
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

fn exact_sign(rows: [&Weights; 3]) -> i8 {
    let parts = rows.iter().flat_map(|row| row.iter()).flat_map(|w| [w.high, w.low]);
    let unit = parts.filter(|x| *x != 0.0).map(|x| parts_of(x).1).min().unwrap_or(0);
    let integer = |w: &Weight| scaled(w.high, unit) + scaled(w.low, unit);
    let [a, b, c] = rows.map(|row| [integer(&row[0]), integer(&row[1]), integer(&row[2])]);
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    let sum: BigInt = &a[0] * minor(1, 2) + &a[1] * minor(2, 0) + &a[2] * minor(0, 1);
    match sum.sign() {
        Sign::Minus => -1,
        Sign::NoSign => 0,
        Sign::Plus => 1,
    }
}

/// A finite number as integer m and exponent e: m 2^e.
fn parts_of(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let size = if exponent == 0 { fraction } else { fraction | 1 << 52 };
    (if x < 0.0 { -size } else { size }, exponent.max(1) - 1075)
}

/// A number in units of 2^unit, which must not exceed its own exponent.
fn scaled(x: f64, unit: i32) -> BigInt {
    let (size, exponent) = parts_of(x);
    // Zero has an exponent, too, but nothing to shift.
    if size == 0 { BigInt::ZERO } else { BigInt::from(size) << (exponent - unit).unsigned_abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(a: f64, b: f64, c: f64) -> Weights {
        [a, b, c].map(Weight::new)
    }

    #[test]
    fn numbers_are_taken_apart() {
        for x in [1.0, 0.1, -0.3, f64::MIN_POSITIVE, 5e-324, 1.0 - f64::EPSILON / 2.0] {
            let (size, exponent) = parts_of(x);
            let back = if exponent < -1022 {
                size as f64 * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
            } else {
                size as f64 * 2f64.powi(exponent)
            };
            assert_eq!(back, x);
        }
    }

    #[test]
    fn the_rest_of_a_weight_is_exact() {
        for t in [0.0, 1.0, 0.1, 1e-17, 0.3, 1.0 - f64::EPSILON / 2.0, 5e-324, 0.7] {
            let w = Weight::rest(t);
            // high + low + t = 1 in integers.
            let unit = -1074;
            let sum = scaled(w.high, unit) + scaled(w.low, unit) + scaled(t, unit);
            assert_eq!(sum, scaled(1.0, unit), "{t}");
        }
    }

    #[test]
    fn signs_are_exact_where_f64_fails() {
        let mut tally = Tally::default();
        let (e0, e1) = (row(1.0, 0.0, 0.0), row(0.0, 1.0, 0.0));
        assert_eq!(tally.orientation([&e0, &e1, &row(0.0, 0.0, 1.0)]), 1);
        assert_eq!(tally.by_integers, 0);
        // Nearly on the line between two points, by as little as a number can be.
        for (third, sign) in [(5e-324, 1), (0.0, 0), (-5e-324, -1)] {
            assert_eq!(tally.orientation([&e0, &e1, &row(0.3, 0.7, third)]), sign);
            assert_eq!(tally.orientation([&e1, &e0, &row(0.3, 0.7, third)]), -sign);
        }
        // Rows that depend on each other only without rounding.
        let (p, q) = (row(0.1, 0.2, 0.7), row(0.3, 0.3, 0.4));
        let half = |a: f64, b: f64| (a + b) / 2.0;
        let between = row(half(0.1, 0.3), half(0.2, 0.3), half(0.7, 0.4));
        let sign = tally.orientation([&p, &q, &between]);
        assert_eq!(tally.orientation([&q, &between, &p]), sign);
        assert_eq!(tally.orientation([&q, &p, &between]), -sign);
        let on_edge = [Weight::rest(0.1), Weight::new(0.1), Weight::new(0.0)];
        assert_eq!(tally.orientation([&e0, &on_edge, &e1]), 0);
        assert_eq!(tally.signs - tally.by_integers, 1);
    }
}
