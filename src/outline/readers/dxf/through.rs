//! The curve through points: a cubic spline, as CAD programs draw a spline that is given by the points it passes alone.
//!
//! Parameters are chord lengths. With slopes `m` at the points and `h_i = t_(i+1) - t_i`, the curvature is continuous where
//! `m_(i-1) / h_(i-1) + 2 (1 / h_(i-1) + 1 / h_i) m_i + m_(i+1) / h_i = 3 ((p_i - p_(i-1)) / h_(i-1)^2 + (p_(i+1) - p_i) / h_i^2)`.
//! At the ends the slope is the stated tangent, or the curvature zero.

use super::place::{Point3, unit};

/// Points of a closed curve that are repeated at either side: the influence of an end falls by 0.27 from point to point.
const REPEATED: usize = 24;

/// Points with the slopes of the curve there, over its chord lengths.
pub(super) struct Through {
    pub points: Vec<Point3>,
    pub slopes: Vec<Point3>,
    pub parameters: Vec<f64>,
}

impl Through {
    /// The curve through points, with stated directions at its ends where there are any.
    pub fn new(mut points: Vec<Point3>, closed: bool, ends: [Option<Point3>; 2]) -> Option<Self> {
        points.dedup();
        if closed && points.len() > 2 && points.first() == points.last() {
            points.pop();
        }
        if points.len() < 2 {
            return None;
        }
        if !closed || points.len() < 3 {
            let parameters = chords(&points);
            let slopes = slopes(&points, &parameters, ends.map(|end| end.and_then(unit)));
            return Some(Self { points, slopes, parameters });
        }
        let n = points.len();
        let around: Vec<Point3> =
            (0..n + 2 * REPEATED + 1).map(|k| points[(k + n * REPEATED - REPEATED) % n]).collect();
        let parameters = chords(&around);
        let slopes = slopes(&around, &parameters, [None; 2]);
        let own = REPEATED..REPEATED + n + 1;
        Some(Self {
            points: around[own.clone()].to_vec(),
            slopes: slopes[own.clone()].to_vec(),
            parameters: parameters[own].to_vec(),
        })
    }

    /// The point of piece `k` at `s` between 0 and 1 (Hermite).
    pub fn at(&self, k: usize, s: f64) -> Point3 {
        let h = self.parameters[k + 1] - self.parameters[k];
        let (s2, s3) = (s * s, s * s * s);
        let weights = [2.0 * s3 - 3.0 * s2 + 1.0, h * (s3 - 2.0 * s2 + s), 3.0 * s2 - 2.0 * s3, h * (s3 - s2)];
        std::array::from_fn(|i| {
            weights[0] * self.points[k][i]
                + weights[1] * self.slopes[k][i]
                + weights[2] * self.points[k + 1][i]
                + weights[3] * self.slopes[k + 1][i]
        })
    }
}

fn chords(points: &[Point3]) -> Vec<f64> {
    let mut t = 0.0;
    let mut all = vec![0.0];
    for pair in points.windows(2) {
        t += (0..3).map(|i| (pair[1][i] - pair[0][i]).powi(2)).sum::<f64>().sqrt();
        all.push(t);
    }
    all
}

/// Solves for the slopes (Thomas's algorithm).
fn slopes(points: &[Point3], t: &[f64], ends: [Option<Point3>; 2]) -> Vec<Point3> {
    let n = points.len();
    let h = |i: usize| t[i + 1] - t[i];
    let rise = |i: usize| -> Point3 { std::array::from_fn(|k| (points[i + 1][k] - points[i][k]) / h(i)) };
    let row = |i: usize| -> ([f64; 3], Point3) {
        let end = if i == 0 {
            ends[0]
        } else if i == n - 1 {
            ends[1]
        } else {
            None
        };
        match (i, end) {
            (_, Some(slope)) => ([0.0, 1.0, 0.0], slope),
            (0, None) => ([0.0, 2.0, 1.0], rise(0).map(|v| 3.0 * v)),
            (i, None) if i == n - 1 => ([1.0, 2.0, 0.0], rise(n - 2).map(|v| 3.0 * v)),
            (i, None) => {
                let (before, after) = (h(i - 1).recip(), h(i).recip());
                let (a, b) = (rise(i - 1), rise(i));
                let right = std::array::from_fn(|k| 3.0 * (before * a[k] + after * b[k]));
                ([before, 2.0 * (before + after), after], right)
            }
        }
    };
    let mut upper = vec![0.0; n];
    let mut slopes = vec![[0.0; 3]; n];
    for i in 0..n {
        let ([a, b, c], right) = row(i);
        let (over, last) = if i > 0 { (upper[i - 1], slopes[i - 1]) } else { (0.0, [0.0; 3]) };
        let pivot = b - a * over;
        upper[i] = c / pivot;
        slopes[i] = std::array::from_fn(|k| (right[k] - a * last[k]) / pivot);
    }
    for i in (0..n - 1).rev() {
        let next = slopes[i + 1];
        (0..3).for_each(|k| slopes[i][k] -= upper[i] * next[k]);
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_closed_curve_through_points_of_a_circle_is_nearly_that() {
        let mut last = f64::INFINITY;
        for n in [6, 12, 24] {
            let points = (0..n).map(|i| TAU * f64::from(i) / f64::from(n)).map(|a| [a.cos(), a.sin(), 0.0]).collect();
            let curve = Through::new(points, true, [None; 2]).unwrap();
            let off = (0..n as usize).map(|k| curve.at(k, 0.5)).map(|p| (p[0].hypot(p[1]) - 1.0).abs());
            let off = off.fold(0.0, f64::max);
            // Fourth order.
            assert!(off < 0.1 * last && off < 2e-2, "{n}: {off}");
            last = off;
            assert_eq!(curve.at(0, 0.0), curve.at(n as usize - 1, 1.0));
        }
    }

    #[test]
    fn a_cubic_with_its_own_ends_is_met() {
        let points = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
        let straight = Through::new(points, false, [Some([2.0, 0.0, 0.0]), None]).unwrap();
        assert!((straight.at(1, 0.25)[0] - 1.5).abs() < 1e-12 && straight.slopes.iter().all(|m| m[1] == 0.0));
        assert!(Through::new(vec![[1.0; 3]; 3], false, [None; 2]).is_none());
    }
}
