//! Paints triangles with a texture: affine in each, every pixel once.
//!
//! A pixel belongs to the triangle that its middle lies in; on a shared edge, to the one below it or to the right. The rim is as
//! rough as that, and lies under the seam.

use super::texture::Texture;
use crate::outline::Point;
use tiny_skia::PixmapMut;

/// A corner: where it is in the picture (pixels, y down), and in the texture (0 to 1 from the upper left corner).
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub at: Point,
    pub place: Point,
}

pub(super) fn triangle(pixmap: &mut PixmapMut, corners: [Corner; 3], texture: &Texture) {
    let [a, b, c] = turned(corners);
    let area = cross(a.at, b.at, c.at);
    if !(area > 0.0 && area.is_finite()) {
        return;
    }
    // Pixels of the texture on a pixel of the picture, along each axis.
    let (width, height) = (f64::from(texture.levels()[0].width), f64::from(texture.levels()[0].height));
    let texels = (cross(a.place, b.place, c.place).abs() * width * height / area).sqrt();
    let (columns, rows) = (pixmap.width(), pixmap.height());
    let range = |axis: usize, size: u32| {
        let values = [a.at[axis], b.at[axis], c.at[axis]];
        let low = values.into_iter().fold(f64::INFINITY, f64::min);
        let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let bound = |v: f64| v.clamp(0.0, f64::from(size)) as u32;
        bound(low.floor())..bound(high.ceil())
    };
    let data = pixmap.data_mut();
    for y in range(1, rows) {
        for x in range(0, columns) {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let sides = [side(b.at, c.at, p), side(c.at, a.at, p), side(a.at, b.at, p)];
            if sides.iter().any(|s| s.is_none()) {
                continue;
            }
            let [u, v, w] = sides.map(|s| s.unwrap_or(0.0) / area);
            let place = [0, 1].map(|k| u * a.place[k] + v * b.place[k] + w * c.place[k]);
            let over = texture.color(place, texels);
            let pixel = &mut data[4 * (y as usize * columns as usize + x as usize)..][..4];
            let rest = 1.0 - over[3] / 255.0;
            for (below, over) in pixel.iter_mut().zip(over) {
                *below = (over + rest * f64::from(*below)).round().clamp(0.0, 255.0) as u8;
            }
        }
    }
}

/// All turning the same way.
fn turned([a, b, c]: [Corner; 3]) -> [Corner; 3] {
    if cross(a.at, b.at, c.at) < 0.0 { [a, c, b] } else { [a, b, c] }
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
