//! The height of the felt over the plane: the membrane over the silhouette that a load bends, rounded.
//!
//! `-laplace(phi) = 2` within, `phi = 0` on the rim, in linear elements on the cells at rest, by conjugate gradients. The height is
//! `sqrt(2 phi)` times a factor: over a disc of radius R, phi = (R^2 - r^2) / 2 makes a ball of radius R, over a long strip an ellipse. It is
//! smooth, rises upright from the rim as stuffed felt does, and is low in thin limbs. The normal `(-grad phi, sqrt(2 phi))` is
//! bounded up to the rim.

use super::tie::doubled_area;
use crate::outline::Point;

/// Residual, as a part of that of a flat sheet, at which the height is right to a thousandth: less is not seen.
const TOLERANCE: f64 = 1e-4;
/// Steps that no body needs.
const MOST_STEPS: usize = 2000;

/// `phi` at each point, mm^2.
pub fn heights(rest: &[Point], triangles: &[[usize; 3]], rings: &[Vec<usize>]) -> Vec<f64> {
    let mut held = vec![false; rest.len()];
    rings.iter().flatten().for_each(|&p| held[p] = true);
    let mut load = vec![0.0; rest.len()];
    let mut diagonal = vec![0.0; rest.len()];
    // Pairs of points with the cotangents of the angles that face them. One below zero belongs to a sliver; without it no height is
    // below zero.
    let mut pairs: Vec<([usize; 2], f64)> = Vec::with_capacity(3 * triangles.len());
    for triangle in triangles {
        let [a, b, c] = triangle.map(|p| rest[p]);
        let area = doubled_area(a, b, c);
        if area <= 0.0 {
            continue;
        }
        for k in 0..3 {
            let [i, j, apex] = [triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]];
            load[i] += area / 3.0;
            let (p, q) = ([0, 1].map(|k| rest[i][k] - rest[apex][k]), [0, 1].map(|k| rest[j][k] - rest[apex][k]));
            let cotangent = (0.5 * (p[0] * q[0] + p[1] * q[1]) / area).max(0.0);
            diagonal[i] += cotangent;
            diagonal[j] += cotangent;
            pairs.push(([i, j], cotangent));
        }
    }
    // A point that nothing ties, of a flat triangle, stays where it is.
    let free = |p: usize| !held[p] && diagonal[p] > 0.0;
    let residual: Vec<f64> = (0..rest.len()).map(|p| if free(p) { load[p] } else { 0.0 }).collect();
    let multiply = |x: &[f64]| {
        let mut out: Vec<f64> = x.iter().zip(&diagonal).map(|(x, d)| x * d).collect();
        for &([i, j], weight) in &pairs {
            out[i] -= weight * x[j];
            out[j] -= weight * x[i];
        }
        (0..out.len()).filter(|&p| !free(p)).for_each(|p| out[p] = 0.0);
        out
    };
    let mut heights = conjugate_gradients(multiply, &diagonal, residual);
    heights.iter_mut().for_each(|h| *h = h.max(0.0));
    heights
}

/// Solves `A x = b` from zero, scaled by the diagonal of `A`.
fn conjugate_gradients(multiply: impl Fn(&[f64]) -> Vec<f64>, diagonal: &[f64], b: Vec<f64>) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let scaled =
        |r: &[f64]| r.iter().zip(diagonal).map(|(r, d)| if *d > 0.0 { r / d } else { 0.0 }).collect::<Vec<f64>>();
    let mut x = vec![0.0; b.len()];
    let mut residual = b;
    let mut z = scaled(&residual);
    let mut way = z.clone();
    let mut worth = dot(&residual, &z);
    let enough = TOLERANCE * TOLERANCE * worth;
    for _ in 0..MOST_STEPS {
        if worth <= enough {
            break;
        }
        let image = multiply(&way);
        let step = worth / dot(&way, &image);
        x.iter_mut().zip(&way).for_each(|(x, w)| *x += step * w);
        residual.iter_mut().zip(&image).for_each(|(r, i)| *r -= step * i);
        z = scaled(&residual);
        let now = dot(&residual, &z);
        let ratio = now / worth;
        way.iter_mut().zip(&z).for_each(|(w, z)| *w = z + ratio * *w);
        worth = now;
    }
    x
}
