//! Where entities and blocks lie in space.

/// A place in space.
pub(super) type Point3 = [f64; 3];

/// An affine map of space, row by row: `x' = row . (x, y, z, 1)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place(pub [[f64; 4]; 3]);

/// A normal with both x and y below this is taken for upright by the arbitrary axis algorithm.
const UPRIGHT: f64 = 1.0 / 64.0;

impl Place {
    pub const IDENTITY: Self = Self([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);

    pub fn at(&self, [x, y, z]: Point3) -> Point3 {
        self.0.map(|[a, b, c, d]| a * x + b * y + c * z + d)
    }

    /// First `inner`, then this.
    pub fn after(&self, inner: &Self) -> Self {
        let column = |row: &[f64; 4], k: usize| (0..3).map(|i| row[i] * inner.0[i][k]).sum::<f64>();
        Self(self.0.map(|row| std::array::from_fn(|k| column(&row, k) + if k == 3 { row[3] } else { 0.0 })))
    }

    pub fn moved([x, y, z]: Point3) -> Self {
        let mut place = Self::IDENTITY;
        (place.0[0][3], place.0[1][3], place.0[2][3]) = (x, y, z);
        place
    }

    pub fn scaled([x, y, z]: Point3) -> Self {
        Self([[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]])
    }

    /// Turned about z by an angle.
    pub fn turned(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self([[cos, -sin, 0.0, 0.0], [sin, cos, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]])
    }

    /// From the coordinates of an object with an extrusion direction to the world's (the "arbitrary axis algorithm" of the reference).
    pub fn extruded(normal: Point3) -> Self {
        let Some(n) = unit(normal) else { return Self::IDENTITY };
        let axis = if n[0].abs() < UPRIGHT && n[1].abs() < UPRIGHT { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        let Some(x) = unit(cross(axis, n)) else { return Self::IDENTITY };
        let y = cross(n, x);
        Self(std::array::from_fn(|i| [x[i], y[i], n[i], 0.0]))
    }

    /// The most that a length grows.
    pub fn scale(&self) -> f64 {
        let column = |k: usize| (0..3).map(|i| self.0[i][k].powi(2)).sum::<f64>().sqrt();
        (0..3).map(column).fold(0.0, f64::max)
    }
}

pub(super) fn cross(a: Point3, b: Point3) -> Point3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The direction of a vector; `None` of nothing.
pub(super) fn unit(v: Point3) -> Option<Point3> {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    (length.is_finite() && length > 0.0).then(|| v.map(|c| c / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arbitrary_axes_are_those_of_the_reference() {
        let near = |a: Point3, b: Point3| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-12);
        assert!(near(Place::extruded([0.0, 0.0, 2.0]).at([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]));
        // Seen from below, x points the other way.
        assert!(near(Place::extruded([0.0, 0.0, -1.0]).at([1.0, 2.0, 3.0]), [-1.0, 2.0, -3.0]));
        // The front view: x to the right, y up.
        assert!(near(Place::extruded([0.0, -1.0, 0.0]).at([1.0, 2.0, 3.0]), [1.0, -3.0, 2.0]));
        let there = Place::moved([5.0, 0.0, 0.0]).after(&Place::turned(std::f64::consts::FRAC_PI_2));
        assert!(near(there.after(&Place::scaled([2.0; 3])).at([1.0, 0.0, 0.0]), [5.0, 2.0, 0.0]));
    }
}
