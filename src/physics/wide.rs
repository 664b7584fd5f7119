//! Plain loops, compiled for the vector instructions of the machine that they run on.
//!
//! A [`Work`] is written as ordinary code on arrays, all of it `#[inline(always)]`, and compiled twice: for any processor, and for
//! one with 256-bit vectors and fused multiply-adds, which is asked for at run time. A machine always takes the same of the two,
//! so that the same input gives the same bits there.

use pulp::{Arch, Simd, WithSimd};

/// A loop that is worth vectors.
pub trait Work {
    type Output;

    /// Does the work; `FUSED` says that [`multiply_add`] is one instruction.
    fn run<const FUSED: bool>(self) -> Self::Output;
}

/// Runs the work with the best instructions there are.
#[inline]
pub fn run<W: Work>(work: W) -> W::Output {
    Arch::new().dispatch(Dispatched(work))
}

struct Dispatched<W>(W);

impl<W: Work> WithSimd for Dispatched<W> {
    type Output = W::Output;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> W::Output {
        if S::IS_SCALAR { self.0.run::<false>() } else { self.0.run::<true>() }
    }
}

/// `a b + c`, rounded once where that is quick.
#[inline(always)]
pub fn multiply_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Entries that are taken through a loop together: their intermediate results stay in the nearest cache, and the compiler makes
/// vectors of the loop.
pub const CHUNK: usize = 64;

/// One number for each entry of a chunk.
pub type Lanes = [f64; CHUNK];

/// Whether [`ln`] is good for `x`: positive, finite, and not so small that its digits run out.
#[inline(always)]
pub fn has_ln(x: f64) -> bool {
    (f64::MIN_POSITIVE..=f64::MAX).contains(&x)
}

/// `ln x` where [`has_ln`], to less than one unit in the last place; else some number.
///
/// `x = 2^k m`, `sqrt(1/2) <= m < sqrt(2)`, `s = (m - 1)/(m + 1)` and `ln m = 2 s + s R(s^2)`: the reduction and the polynomial `R`
/// of fdlibm's `e_log.c` (Sun Microsystems, 1993).
#[inline(always)]
pub fn ln<const FUSED: bool>(x: f64) -> f64 {
    const R: [f64; 7] = [
        6.666_666_666_666_735e-1,
        3.999_999_999_940_942e-1,
        2.857_142_874_366_239e-1,
        2.222_219_843_214_978_4e-1,
        1.818_357_216_161_805e-1,
        1.531_383_769_920_937_3e-1,
        1.479_819_860_511_658_6e-1,
    ];
    const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const ROOT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
    // `2^52`, whose last bits are an integer.
    const INTEGER: u64 = 0x4330_0000_0000_0000;
    let fma = multiply_add::<FUSED>;
    let bits = x.to_bits();
    let exponent = bits.wrapping_add(ONE - ROOT_HALF) >> 52;
    let k = f64::from_bits(INTEGER | exponent) - (4_503_599_627_370_496.0 + 1023.0);
    let m = f64::from_bits(bits.wrapping_sub(exponent << 52).wrapping_add(ONE));
    let f = m - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even = w * fma(w, fma(w, R[5], R[3]), R[1]);
    let odd = z * fma(w, fma(w, fma(w, R[6], R[4]), R[2]), R[0]);
    let half = 0.5 * f * f;
    let tail = fma(s, half + (even + odd), k * LN_2[1]);
    fma(k, LN_2[0], f - (half - tail))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Logarithms<'a>(&'a [f64], &'a mut [f64]);

    impl Work for Logarithms<'_> {
        type Output = ();

        #[inline(always)]
        fn run<const FUSED: bool>(self) {
            for (x, y) in self.0.iter().zip(self.1) {
                *y = ln::<FUSED>(*x);
            }
        }
    }

    #[test]
    fn logarithms_are_good_to_the_last_place() {
        let mut x: Vec<f64> = (-60..=60).map(|k| 1.0 + f64::from(k) * 1e-3).collect();
        x.extend((1..4000).map(|k| 0.37 * f64::from(k).powf(3.1) * 1e-5));
        x.extend((0..600).map(|k| 10.0_f64.powi(k - 300)));
        x.extend([1.0, f64::MIN_POSITIVE, f64::MAX, 1.0 - f64::EPSILON, 1.0 + f64::EPSILON, 0.5_f64.sqrt()]);
        let check = |y: &[f64]| {
            for (x, y) in x.iter().zip(y) {
                let right = x.ln();
                assert!((y - right).abs() <= 2.0 * f64::EPSILON * right.abs(), "ln {x:e} = {right:e}, not {y:e}");
            }
        };
        let mut y = vec![0.0; x.len()];
        run(Logarithms(&x, &mut y));
        check(&y);
        Logarithms(&x, &mut y).run::<false>();
        check(&y);
        assert!(x.iter().all(|x| has_ln(*x)));
        assert!(![0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310].into_iter().any(has_ln));
    }
}
