//! Measures of a closed polygon. The first point is not repeated at the end.

use super::Point;

/// The sides of a polygon, each as its two ends, the closing side last.
pub fn sides(polygon: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    let closing = polygon.last().copied().zip(polygon.first().copied());
    polygon.windows(2).map(|ends| (ends[0], ends[1])).chain(closing)
}

/// Area by the shoelace formula, positive for a counter-clockwise polygon.
///
/// The first point serves as origin, so a small polygon far from the origin keeps its digits.
pub fn signed_area(polygon: &[Point]) -> f64 {
    let Some(&o) = polygon.first() else { return 0.0 };
    0.5 * sides(polygon).map(|(a, b)| (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1])).sum::<f64>()
}

/// Length of the closed polygon.
pub fn perimeter(polygon: &[Point]) -> f64 {
    sides(polygon).map(|(a, b)| length(a, b)).sum()
}

/// Lower left and upper right corner of the box around the points; inverted infinities for none.
pub fn bounding_box(points: &[Point]) -> (Point, Point) {
    points.iter().fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(low, high), p| {
        ([low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])])
    })
}

/// Whether `p` is inside, by the parity of crossings of a ray to the right.
pub fn contains(polygon: &[Point], p: Point) -> bool {
    let mut inside = false;
    for (a, b) in sides(polygon) {
        // Half-open in y, so that a ray through a vertex counts once.
        if (a[1] > p[1]) != (b[1] > p[1]) {
            let x = a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            inside ^= p[0] < x;
        }
    }
    inside
}

/// Distance from `p` to the boundary of the polygon; infinite for no points.
pub fn distance(polygon: &[Point], p: Point) -> f64 {
    nearest(sides(polygon), p)
}

/// Distance from `p` to the nearest of some segments; infinite for none. Squares are compared: they take a fraction of the time of distances that cannot
/// overflow.
pub fn nearest(segments: impl Iterator<Item = (Point, Point)>, p: Point) -> f64 {
    let squared = |(a, b): (Point, Point)| {
        let q = lerp(a, b, nearest_parameter(a, b, p));
        let [dx, dy] = [q[0] - p[0], q[1] - p[1]];
        (dx * dx + dy * dy, (a, b))
    };
    let nearest = segments.map(squared).reduce(|best, next| if next.0 < best.0 { next } else { best });
    nearest.map_or(f64::INFINITY, |(_, (a, b))| distance_to_segment(a, b, p))
}

/// Distance from `p` to the segment from `a` to `b`.
pub fn distance_to_segment(a: Point, b: Point, p: Point) -> f64 {
    let t = nearest_parameter(a, b, p);
    length(p, lerp(a, b, t))
}

/// The parameter in 0..=1 of the point of segment `ab` nearest to `p`.
pub fn nearest_parameter(a: Point, b: Point, p: Point) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let length2 = d[0] * d[0] + d[1] * d[1];
    if length2 > 0.0 { (((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / length2).clamp(0.0, 1.0) } else { 0.0 }
}

/// Distance between two points.
pub fn length(a: Point, b: Point) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// The point at `t` between `a` (0) and `b` (1).
pub fn lerp(a: Point, b: Point, t: f64) -> Point {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    const L: [Point; 6] = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];

    #[test]
    fn an_l_has_its_closed_form_measures() {
        assert_eq!(signed_area(&L), 6.0);
        let reversed: Vec<Point> = L.iter().rev().copied().collect();
        assert_eq!(signed_area(&reversed), -6.0);
        assert_eq!(perimeter(&L), 14.0);
        assert_eq!(bounding_box(&L), ([0.0, 0.0], [4.0, 3.0]));
        assert!(contains(&L, [0.5, 2.5]) && contains(&L, [3.5, 0.5]) && !contains(&L, [2.0, 2.0]));
        assert_eq!(distance(&L, [2.0, 2.0]), 1.0);
        assert_eq!(distance(&L, [7.0, -4.0]), 5.0);
    }

    #[test]
    fn a_regular_polygon_tends_to_its_circle() {
        for n in [3_usize, 8, 100, 1000] {
            let step = std::f64::consts::TAU / n as f64;
            let ring: Vec<Point> = (0..n).map(|i| [(i as f64 * step).cos(), (i as f64 * step).sin()]).collect();
            assert!((signed_area(&ring) - 0.5 * n as f64 * step.sin()).abs() < 1e-12);
            assert!((perimeter(&ring) - 2.0 * n as f64 * (0.5 * step).sin()).abs() < 1e-12);
        }
    }

    #[test]
    fn area_keeps_its_digits_far_from_the_origin() {
        let far: Vec<Point> = L.iter().map(|p| [p[0] + 1e9, p[1] - 1e9]).collect();
        assert_eq!(signed_area(&far), 6.0);
    }

    #[test]
    fn no_points_are_no_trouble() {
        assert_eq!(signed_area(&[]), 0.0);
        assert_eq!(perimeter(&[]), 0.0);
        assert!(!contains(&[], [0.0, 0.0]));
        assert_eq!(distance(&[], [0.0, 0.0]), f64::INFINITY);
    }
}
