//! Where a block is inserted.

use crate::outline::Point;

/// An affine map, `[a, b, c, d, x, y]`: `(a p + c q + x, b p + d q + y)`.
#[derive(Clone, Copy)]
pub(super) struct Place(pub [f64; 6]);

impl Place {
    pub const IDENTITY: Self = Self([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

    pub fn at(&self, [p, q]: Point) -> Point {
        let Self([a, b, c, d, x, y]) = self;
        [a * p + c * q + x, b * p + d * q + y]
    }

    /// First `inner`, then this.
    pub fn after(&self, inner: &Self) -> Self {
        let [x, y] = self.at([inner.0[4], inner.0[5]]);
        let Self([a, b, c, d, ..]) = self;
        let Self([e, f, g, h, ..]) = inner;
        Self([a * e + c * f, b * e + d * f, a * g + c * h, b * g + d * h, x, y])
    }
}
