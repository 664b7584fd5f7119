//! The look of stuffed felt: light on a puffed surface, and its grain. `shaders/plushie.wgsl` says the same, with [`constants`] from here.

use super::color::Color;
use super::silhouette::Silhouette;
use super::texture::{Texture, places};
use crate::outline::Point;
use std::sync::Arc;

/// Height of the felt over the plane, in that of a ball on a disc: a little more than that of two discs of felt that are stuffed firmly
/// (0.914 thick at a radius of 0.763, a flat radius of 1), so that light finds the form.
const PUFF: f32 = 0.62;
/// Where light comes from: upper left, before the picture.
const LIGHT: [f32; 3] = [-0.42, 0.56, 0.714];
/// Felt scatters light into the shadow: by so much it reaches around.
const WRAP: f32 = 0.35;
/// Strength in the shadow, and what full light adds.
const AMBIENT: f32 = 0.60;
const DIRECT: f32 = 0.47;
/// Light that loose fibres catch at the rim.
const SHEEN: f32 = 0.10;
/// How much the grain of the felt varies its tone.
const GRAIN: f32 = 0.15;
/// Width of a bundle of fibres of the felt, mm.
const BUNDLE_MM: f32 = 0.9;

/// Stuffed felt as it is to be painted.
#[derive(Clone, Debug, PartialEq)]
pub struct Felt {
    pub silhouette: Arc<Silhouette>,
    /// Places of its points, mm.
    pub points: Vec<Point>,
    /// Slope of its [heights](Silhouette::heights) at the points, mm.
    pub slopes: Vec<[f32; 2]>,
    pub color: Color,
    /// A picture on it, and the corners of that on the body at rest: lower left and upper right, mm.
    pub texture: Option<(Arc<Texture>, [Point; 2])>,
}

impl Felt {
    /// Felt whose points are at places.
    pub fn of(
        silhouette: Arc<Silhouette>,
        points: Vec<Point>,
        color: Color,
        texture: Option<(Arc<Texture>, [Point; 2])>,
    ) -> Self {
        let slopes = slopes(&silhouette, &points);
        Self { silhouette, points, slopes, color, texture }
    }

    /// Where its points lie in the picture on it: 0 to 1 from the upper left corner.
    pub fn places(&self) -> Option<Vec<Point>> {
        self.texture.as_ref().map(|(_, frame)| places(*frame, &self.silhouette.rest))
    }
}

/// Slope of the heights at the points: the mean of their triangles by their area.
fn slopes(silhouette: &Silhouette, points: &[Point]) -> Vec<[f32; 2]> {
    let mut sums = vec![[0.0; 3]; points.len()];
    for triangle in &silhouette.triangles {
        let [a, b, c] = triangle.map(|p| points[p]);
        let [p, q] = [[b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]];
        let area = p[0] * q[1] - p[1] * q[0];
        // Where the body is folded over a triangle lies upside down: its slope is as real, and counts by its size.
        let side = area.signum();
        let [h, i, j] = triangle.map(|p| silhouette.heights[p]);
        let (u, v) = (i - h, j - h);
        // The gradient times the doubled area.
        let weighted = [side * (u * q[1] - v * p[1]), side * (v * p[0] - u * q[0])];
        for &corner in triangle {
            let sum: &mut [f64; 3] = &mut sums[corner];
            (sum[0], sum[1], sum[2]) = (sum[0] + weighted[0], sum[1] + weighted[1], sum[2] + area.abs());
        }
    }
    sums.iter().map(|s| if s[2] > 0.0 { [(s[0] / s[2]) as f32, (s[1] / s[2]) as f32] } else { [0.0; 2] }).collect()
}

/// The constants of the look, as WGSL.
pub fn constants() -> String {
    let one = |name: &str, value: f32| format!("const {name}: f32 = {value:?};\n");
    let named = [
        ("PUFF", PUFF),
        ("WRAP", WRAP),
        ("AMBIENT", AMBIENT),
        ("DIRECT", DIRECT),
        ("SHEEN", SHEEN),
        ("GRAIN", GRAIN),
        ("BUNDLE_MM", BUNDLE_MM),
    ];
    let [x, y, z] = LIGHT;
    named.map(|(name, value)| one(name, value)).concat() + &format!("const LIGHT = vec3f({x:?}, {y:?}, {z:?});\n")
}

/// The colour of a piece of felt (red, green, blue, 0 to 1): `base` where it lies flat, its `slope` and `height`, its place at rest in mm
/// and the size of a pixel there, in which fine grain is not seen.
pub fn shade(base: [f32; 3], slope: [f32; 2], height: f32, place_mm: [f32; 2], pixel_mm: f32) -> [f32; 3] {
    let n = [-PUFF * slope[0], -PUFF * slope[1], (2.0 * height.max(0.0)).sqrt() + 1e-3];
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    let n = n.map(|v| v / length);
    let lit = (n[0] * LIGHT[0] + n[1] * LIGHT[1] + n[2] * LIGHT[2] + WRAP) / (1.0 + WRAP);
    let seen = (1.15 - pixel_mm / BUNDLE_MM).clamp(0.0, 1.0);
    let tone = (AMBIENT + DIRECT * lit.max(0.0)) * (1.0 + GRAIN * seen * grain(place_mm));
    let flat = 1.0 - n[2];
    let sheen = SHEEN * flat * flat * flat;
    base.map(|c| (c * tone + sheen).clamp(0.0, 1.0))
}

/// Bundles of fibres across each other, -1 to 1.
fn grain(place_mm: [f32; 2]) -> f32 {
    let [x, y] = place_mm.map(|v| v / BUNDLE_MM);
    let along = noise(0.42 * (0.8 * x + 0.6 * y), 1.3 * (0.8 * y - 0.6 * x));
    let across = noise(1.3 * (0.9 * x - 0.44 * y) + 57.0, 0.42 * (0.9 * y + 0.44 * x) + 31.0);
    along + across - 1.0
}

/// Values at whole places, 0 to 1, and smoothly between them.
fn noise(x: f32, y: f32) -> f32 {
    let (left, low) = (x.floor(), y.floor());
    let (u, v) = (x - left, y - low);
    let (s, t) = (u * u * (3.0 - 2.0 * u), v * v * (3.0 - 2.0 * v));
    let (i, j) = (left as i32, low as i32);
    let value = |i: i32, j: i32| {
        let mut h = (i as u32).wrapping_mul(0x9E37_79B1) ^ (j as u32).wrapping_mul(0x85EB_CA77);
        h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
        ((h ^ (h >> 13)) & 0xFFFF) as f32 / 65535.0
    };
    let near = value(i, j) + s * (value(i + 1, j) - value(i, j));
    let far = value(i, j + 1) + s * (value(i + 1, j + 1) - value(i, j + 1));
    near + t * (far - near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_comes_from_the_upper_left_and_flat_felt_keeps_its_colour() {
        let base = [0.8, 0.7, 0.5];
        let at = |slope: [f32; 2], height: f32| shade(base, slope, height, [3.0, 4.0], 9.0);
        let flat = at([0.0, 0.0], 200.0);
        assert!(flat.iter().zip(base).all(|(f, b)| (f / b - 1.0).abs() < 0.06), "{flat:?}");
        let (lit, shadow) = (at([20.0, -20.0], 200.0), at([-20.0, 20.0], 200.0));
        assert!(lit[1] > flat[1] && flat[1] > shadow[1], "{lit:?} {flat:?} {shadow:?}");
        assert!(at([30.0, 0.0], 0.0).iter().all(|c| (0.0..=1.0).contains(c)));
    }

    #[test]
    fn grain_is_there_only_where_pixels_are_finer() {
        let tones = |pixel: f32| {
            let all = (0..200).map(|k| shade([0.5; 3], [0.0; 2], 50.0, [0.37 * k as f32, 0.11 * k as f32], pixel)[0]);
            let (low, high) = all.fold((1.0_f32, 0.0_f32), |(l, h), v| (l.min(v), h.max(v)));
            high - low
        };
        assert!(tones(0.2) > 0.03 && tones(2.0) < 1e-6, "{} {}", tones(0.2), tones(2.0));
    }
}
