//! Smoothing within a tolerance: wobble goes, corners stay.
//!
//! Each stretch between two corners is sampled evenly, its points are averaged with their neighbours (a Gaussian window
//! along the arc), and no point is let farther from its place than the tolerance.

use super::regions::{self, Shapes};
use super::simplify::simplify;
use super::{OutlineError, Point, polygon};

/// A vertex that turns the boundary by more than this, measured over two standard deviations of the window to either side, is a corner and stays.
const CORNER_RAD: f64 = 0.9;
/// Standard deviation of the window over the tolerance: wobble of that amplitude and a few times its length goes.
const WINDOW: f64 = 3.0;
/// Samples in a standard deviation.
const SAMPLES: f64 = 3.0;
/// Most samples of a polygon: time stays bounded where the tolerance is tiny.
const MAX_SAMPLES: f64 = 60_000.0;

/// The regions with smooth boundaries, none of whose points moved farther than `tolerance`.
pub(super) fn smooth(shapes: Shapes, tolerance: f64) -> Result<Shapes, OutlineError> {
    let ring = |ring: &Vec<Point>| simplify(&smooth_ring(ring, tolerance), 0.05 * tolerance);
    let smoothed: Shapes = shapes.iter().map(|rings| rings.iter().map(ring).collect()).collect();
    let clean = regions::union(smoothed)?;
    // Where neighbours now touch or a hole has closed, the boundary is better left as it was.
    let holes = |shapes: &Shapes| shapes.iter().map(Vec::len).sum::<usize>();
    Ok(if clean.len() == shapes.len() && holes(&clean) == holes(&shapes) { clean } else { shapes })
}

fn smooth_ring(ring: &[Point], tolerance: f64) -> Vec<Point> {
    let length = polygon::perimeter(ring);
    let sigma = WINDOW * tolerance;
    let count = (length / sigma * SAMPLES).ceil().min(MAX_SAMPLES);
    if count.is_nan() || count < 8.0 {
        return ring.to_vec();
    }
    let n = count as usize;
    let points = resample(ring, n);
    let n = points.len();
    if n < 16 {
        return ring.to_vec();
    }
    let reach = SAMPLES as usize;
    let corner: Vec<bool> = (0..n).map(|i| is_corner(&points, i, 2 * reach)).collect();
    let kernel: Vec<f64> = (0..=3 * reach).map(|k| (-0.5 * (k as f64 / SAMPLES).powi(2)).exp()).collect();
    (0..n).map(|i| if corner[i] { points[i] } else { averaged(&points, &corner, i, &kernel, tolerance) }).collect()
}

/// The weighted mean about sample `i`, over as many neighbours to either side as there are up to the nearest corner.
fn averaged(points: &[Point], corner: &[bool], i: usize, kernel: &[f64], tolerance: f64) -> Point {
    let n = points.len();
    let (mut sum, mut weight) = (points[i], 1.0);
    for (k, w) in kernel.iter().enumerate().skip(1) {
        let (a, b) = ((i + n - k % n) % n, (i + k) % n);
        for axis in 0..2 {
            sum[axis] += w * (points[a][axis] + points[b][axis]);
        }
        weight += 2.0 * w;
        if corner[a] || corner[b] {
            break;
        }
    }
    let mean = [sum[0] / weight, sum[1] / weight];
    let moved = polygon::length(points[i], mean);
    if moved > tolerance { polygon::lerp(points[i], mean, tolerance / moved) } else { mean }
}

/// Whether the boundary turns at sample `i`, and more so than at its neighbours.
fn is_corner(points: &[Point], i: usize, half: usize) -> bool {
    let n = points.len();
    let turn = |i: usize| {
        let (a, p, b) = (points[(i + n - half) % n], points[i % n], points[(i + half) % n]);
        let (u, v) = ([p[0] - a[0], p[1] - a[1]], [b[0] - p[0], b[1] - p[1]]);
        (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]).abs()
    };
    let here = turn(i);
    here > CORNER_RAD && here >= turn(i + 1) && here >= turn(i + n - 1)
}

/// `n` points along the ring, evenly spaced but for its vertices: a sample nearest to a vertex moves onto it, so that
/// corners are hit.
fn resample(ring: &[Point], n: usize) -> Vec<Point> {
    let step = polygon::perimeter(ring) / n as f64;
    let mut points = Vec::with_capacity(n);
    let (mut s, mut next) = (0.0, 0.0);
    for (a, b) in polygon::sides(ring) {
        let side = polygon::length(a, b);
        while next < s + side - 0.5 * step {
            let t = if next < s + 0.5 * step { 0.0 } else { (next - s) / side };
            points.push(polygon::lerp(a, b, t));
            next += step;
        }
        s += side;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wobble_goes_corners_stay_and_nothing_moves_too_far() {
        // A square of 100 with a wobble of 0.4 on its sides.
        let mut ring: Vec<Point> = Vec::new();
        for side in 0..4 {
            for i in 0..200 {
                let (t, w) = (0.5 * f64::from(i), if i == 0 { 0.0 } else { 0.4 * (f64::from(i) * 1.9).sin() });
                ring.push(match side {
                    0 => [t, w],
                    1 => [100.0 + w, t],
                    2 => [100.0 - t, 100.0 + w],
                    _ => [w, 100.0 - t],
                });
            }
        }
        let smooth = smooth(vec![vec![ring.clone()]], 0.5).unwrap();
        let out = &smooth[0][0];
        assert!(polygon::perimeter(out) < 404.0 && polygon::perimeter(&ring) > 430.0, "{}", polygon::perimeter(out));
        for p in out {
            assert!(polygon::distance(&ring, *p) < 0.55);
        }
        for corner in [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]] {
            assert!(polygon::distance(out, corner) < 0.5, "{corner:?} {}", polygon::distance(out, corner));
        }
    }
}
