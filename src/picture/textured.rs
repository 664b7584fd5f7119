//! Paints triangles whose colour changes within: affine in each, every pixel once.
//!
//! A pixel belongs to the triangle that its middle lies in; on a shared edge, to the one below it or to the right. The rim is as
//! rough as that, and lies under the seam.

use super::texture::Texture;
use crate::outline::Point;
use tiny_skia::PixmapMut;

/// Paints a triangle whose corners are at places of the picture, pixels (y down). `color` of the weights of its corners is RGBA,
/// 0 to 255, multiplied by the opacity.
pub(super) fn triangle(pixmap: &mut PixmapMut, corners: [Point; 3], color: impl Fn([f64; 3]) -> [f64; 4]) {
    let flipped = cross(corners[0], corners[1], corners[2]) < 0.0;
    let [a, b, c] = if flipped { [corners[0], corners[2], corners[1]] } else { corners };
    let area = cross(a, b, c);
    if !(area > 0.0 && area.is_finite()) {
        return;
    }
    let (columns, rows) = (pixmap.width(), pixmap.height());
    let range = |axis: usize, size: u32| {
        let values = [a[axis], b[axis], c[axis]];
        let low = values.into_iter().fold(f64::INFINITY, f64::min);
        let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let bound = |v: f64| v.clamp(0.0, f64::from(size)) as u32;
        bound(low.floor())..bound(high.ceil())
    };
    let data = pixmap.data_mut();
    for y in range(1, rows) {
        for x in range(0, columns) {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let sides = [side(b, c, p), side(c, a, p), side(a, b, p)];
            if sides.iter().any(|s| s.is_none()) {
                continue;
            }
            let [u, v, w] = sides.map(|s| s.unwrap_or(0.0) / area);
            let over = color(if flipped { [u, w, v] } else { [u, v, w] });
            let pixel = &mut data[4 * (y as usize * columns as usize + x as usize)..][..4];
            let rest = 1.0 - over[3] / 255.0;
            for (below, over) in pixel.iter_mut().zip(over) {
                *below = (over + rest * f64::from(*below)).round().clamp(0.0, 255.0) as u8;
            }
        }
    }
}

/// Pixels of a texture on a pixel of the picture, along each axis, where a triangle of it is drawn at places.
pub(super) fn texels(corners: [Point; 3], places: [Point; 3], texture: &Texture) -> f64 {
    let (width, height) = (f64::from(texture.levels()[0].width), f64::from(texture.levels()[0].height));
    let area = cross(corners[0], corners[1], corners[2]).abs().max(f64::MIN_POSITIVE);
    (cross(places[0], places[1], places[2]).abs() * width * height / area).sqrt()
}

/// The mean of three places or figures by weights.
pub(super) fn mean<const N: usize>(weights: [f64; 3], of: [[f64; N]; 3]) -> [f64; N] {
    std::array::from_fn(|k| weights.iter().zip(&of).map(|(w, v)| w * v[k]).sum())
}

/// Twice the area of a triangle.
fn cross(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Twice the area between an edge and a place on its inner side, none on the outer. The figure is the same for both triangles at
/// the edge, but for its sign, so that each place is on the inner side of one of them exactly.
fn side(a: Point, b: Point, p: Point) -> Option<f64> {
    let forward = a < b;
    let area = if forward { cross(a, b, p) } else { -cross(b, a, p) };
    (area > 0.0 || area == 0.0 && forward).then_some(area)
}
