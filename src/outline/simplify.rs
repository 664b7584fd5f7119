//! Fewer points within a tolerance (Douglas and Peucker 1973).

use super::{Point, polygon};

/// Douglas-Peucker on a closed polygon: no dropped point lies farther than `tolerance` from what is left.
///
/// The ring is cut at its lowest leftmost point, which is a corner of the hull, and at the point farthest from it.
pub(super) fn simplify(ring: &[Point], tolerance: f64) -> Vec<Point> {
    let order = |a: &Point, b: &Point| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
    let Some(first) = (0..ring.len()).min_by(|&a, &b| order(&ring[a], &ring[b])) else { return Vec::new() };
    let mut points: Vec<Point> = ring[first..].iter().chain(&ring[..=first]).copied().collect();
    let far = (0..points.len())
        .max_by(|&a, &b| polygon::length(points[0], points[a]).total_cmp(&polygon::length(points[0], points[b])))
        .unwrap_or(0);
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[far] = true;
    let mut open = vec![(0, far), (far, points.len() - 1)];
    while let Some((from, to)) = open.pop() {
        let away = |i: usize| polygon::distance_to_segment(points[from], points[to], points[i]);
        let Some(worst) = (from + 1..to).max_by(|&a, &b| away(a).total_cmp(&away(b))) else { continue };
        if away(worst) > tolerance {
            keep[worst] = true;
            open.extend([(from, worst), (worst, to)]);
        }
    }
    let mut kept = keep.iter();
    points.retain(|_| kept.next() == Some(&true));
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simplification_stays_within_its_tolerance() {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / 5000.0;
        let ring: Vec<Point> = (0..5000).map(|i| [100.0 * angle(i).cos(), 100.0 * angle(i).sin()]).collect();
        let mut last = usize::MAX;
        for tolerance in [1e-3, 1e-2, 1e-1, 1.0] {
            let thin = simplify(&ring, tolerance);
            assert!(thin.len() < last);
            last = thin.len();
            for &p in &ring {
                assert!(polygon::distance(&thin, p) <= tolerance * (1.0 + 1e-9));
            }
        }
    }
}
