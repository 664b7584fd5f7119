//! DoubleDouble-double arithmetic: an unevaluated sum of two `f64`, some 31 decimal digits.
//!
//! For what one `f64` cannot hold: the stretch of a spring a billion times stiffer than the body, and the reference answers
//! against which accuracy is measured. Error-free transformations after Dekker (1971) and Knuth; products use the fused
//! multiply-add. Relative error of an operation: a few times `2^-104`. Overflow and NaN behave as in `f64`.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// `high + low` with `|low| <= ulp(high)/2`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DoubleDouble {
    pub high: f64,
    pub low: f64,
}

/// `ln 2` to 32 digits.
const LN_2: DoubleDouble = DoubleDouble { high: std::f64::consts::LN_2, low: 2.319_046_813_846_299_6e-17 };

/// `a + b` and its rounding error, whatever their sizes.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let from_b = sum - a;
    (sum, (a - (sum - from_b)) + (b - from_b))
}

/// `a + b` and its rounding error where `|a| >= |b|`.
fn quick_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: if high.is_finite() { b - (high - a) } else { 0.0 } }
}

impl DoubleDouble {
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// The exact difference of two `f64`.
    pub fn difference(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, -b);
        Self { high, low }
    }

    /// The nearest `f64`.
    pub fn value(self) -> f64 {
        self.high + self.low
    }

    pub fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    pub fn square(self) -> Self {
        self * self
    }

    /// Zero for zero, NaN below it.
    pub fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return Self::ZERO;
        }
        let root = self.high.sqrt();
        // One Newton step from the root of the leading part doubles its digits.
        let rest = self - Self::from(root).square();
        quick_sum(root, rest.high / (2.0 * root))
    }

    /// `e^self`; by the Taylor series of a 512th part of what is left of it without multiples of `ln 2`.
    pub fn exp(self) -> Self {
        const HALVINGS: u32 = 9;
        const TERMS: u32 = 14;
        let power = (self.high / LN_2.high).round();
        let small = (self - LN_2 * Self::from(power)).scaled(0.5_f64.powi(HALVINGS as i32));
        let (mut term, mut sum) = (small, small);
        for k in 2..=TERMS {
            term = term * small / Self::from(f64::from(k));
            sum = sum + term;
        }
        // (1 + s)^2 = 1 + (2 s + s^2): the one is added last, so that no digit is lost.
        for _ in 0..HALVINGS {
            sum = sum.scaled(2.0) + sum.square();
        }
        (sum + Self::ONE).scaled(2.0_f64.powi(power as i32))
    }

    /// The natural logarithm; NaN below zero. A Newton step on `e^y = self` from the leading part's logarithm.
    pub fn ln(self) -> Self {
        let guess = Self::from(self.high.ln());
        guess + (self * (-guess).exp() - Self::ONE)
    }

    /// Times a power of two, without error.
    fn scaled(self, power_of_two: f64) -> Self {
        Self { high: self.high * power_of_two, low: self.low * power_of_two }
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = two_sum(self.high, other.high);
        let (next, last) = two_sum(self.low, other.low);
        let sum = quick_sum(high, low + next);
        quick_sum(sum.high, sum.low + last)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        let low = self.high.mul_add(other.high, -high);
        quick_sum(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        quick_sum(first, second) + Self::from(rest.high / other.high)
    }
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            order => order,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative difference, in units of the last of 31 digits.
    fn off(a: DoubleDouble, b: DoubleDouble) -> f64 {
        ((a - b).value() / b.value()).abs() / 1e-31
    }

    #[test]
    fn known_constants_have_thirty_digits() {
        // e and sqrt 2 as sums of two f64 (from their decimal expansions).
        let e = DoubleDouble { high: std::f64::consts::E, low: 1.445_646_891_729_250_2e-16 };
        let root = DoubleDouble { high: std::f64::consts::SQRT_2, low: -9.667_293_313_452_913e-17 };
        assert!(off(DoubleDouble::ONE.exp(), e) < 20.0);
        assert!(off(DoubleDouble::from(2.0).sqrt(), root) < 5.0);
        assert!(off(DoubleDouble::from(2.0).ln(), LN_2) < 20.0);
    }

    #[test]
    fn operations_undo_each_other() {
        for x in [1e-9, 0.3, 1.0 + 1e-12, 7.0, 123.456, 1e9] {
            let x = DoubleDouble::from(x) / DoubleDouble::from(3.0);
            assert!(off(x * (DoubleDouble::ONE / x), DoubleDouble::ONE) < 10.0);
            assert!(off(x.sqrt().square(), x) < 10.0);
            assert!(off(x.ln().exp(), x) < 1e3, "{x:?}: {}", off(x.ln().exp(), x));
            assert!((x + DoubleDouble::ONE - x - DoubleDouble::ONE).value().abs() < 1e-31 * (1.0 + x.value()));
        }
    }

    #[test]
    fn a_difference_is_exact() {
        let d = DoubleDouble::difference(1.0, 1e-30);
        assert_eq!((d.high, d.low), (1.0, -1e-30));
        assert!(DoubleDouble { high: 1.0, low: 1e-20 } > DoubleDouble::ONE);
    }
}
