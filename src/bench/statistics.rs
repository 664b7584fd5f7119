//! Order statistics, and the exponent of a growth law.

/// The smallest, middle, 95th percentile and largest of some values; all NaN without values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    pub least: f64,
    pub median: f64,
    pub p95: f64,
    pub worst: f64,
}

impl Summary {
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = values.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        Self {
            least: quantile(&sorted, 0.0),
            median: quantile(&sorted, 0.5),
            p95: quantile(&sorted, 0.95),
            worst: quantile(&sorted, 1.0),
        }
    }
}

/// The `q`-quantile of ascending values, linear between neighbours; NaN without values.
pub fn quantile(sorted: &[f64], q: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let place = q.clamp(0.0, 1.0) * last as f64;
    let (below, part) = (place.floor() as usize, place.fract());
    let above = (below + 1).min(last);
    if part == 0.0 { sorted[below] } else { sorted[below] + part * (sorted[above] - sorted[below]) }
}

/// Quantile of the normal distribution for 95 % confidence, two-sided.
const CONFIDENCE: f64 = 1.959_964;

/// The share of which `hits` out of `count` draws are a sample, with 95 % confidence: Wilson's score interval, which holds for shares near
/// 0 and 1 too. All shares without draws.
pub fn wilson(hits: usize, count: usize) -> (f64, f64) {
    if count == 0 {
        return (0.0, 1.0);
    }
    let (n, z2) = (count as f64, CONFIDENCE * CONFIDENCE);
    let p = hits as f64 / n;
    let middle = (p + 0.5 * z2 / n) / (1.0 + z2 / n);
    let half = CONFIDENCE / (1.0 + z2 / n) * (p * (1.0 - p) / n + 0.25 * z2 / (n * n)).sqrt();
    ((middle - half).max(0.0), (middle + half).min(1.0))
}

/// The exponent `p` of `y = c x^p`, by least squares of `ln y` over `ln x`. `None` with fewer than two different positive `x`.
pub fn growth_exponent(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> =
        points.iter().filter(|(x, y)| *x > 0.0 && *y > 0.0).map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let mean_x = logs.iter().map(|p| p.0).sum::<f64>() / count;
    let mean_y = logs.iter().map(|p| p.1).sum::<f64>() / count;
    let spread: f64 = logs.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    let slope = logs.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum::<f64>() / spread;
    slope.is_finite().then_some(slope)
}

/// Which of some `(time, error)` pairs are on the Pareto front: no other is at least as good in both and better in one.
pub fn pareto_front(points: &[(f64, f64)]) -> Vec<bool> {
    let beats = |a: &(f64, f64), b: &(f64, f64)| a.0 <= b.0 && a.1 <= b.1 && (a.0 < b.0 || a.1 < b.1);
    points.iter().map(|p| !points.iter().any(|other| beats(other, p))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn summaries_of_known_values() {
        let summary = Summary::of((0..=100).rev().map(f64::from));
        assert_eq!(summary, Summary { least: 0.0, median: 50.0, p95: 95.0, worst: 100.0 });
        assert_eq!(Summary::of([3.0, 1.0]).median, 2.0);
        assert!(Summary::of([]).median.is_nan());
    }

    #[test]
    fn wilsons_interval_of_known_shares() {
        // Wilson 1927 in the table of Newcombe 1998: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
        for (hits, count, low, high) in
            [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)]
        {
            let (l, h) = wilson(hits, count);
            assert!((l - low).abs() < 1e-4 && (h - high).abs() < 1e-4, "{hits} of {count}: {l} to {h}");
        }
        assert_eq!(wilson(0, 0), (0.0, 1.0));
    }

    #[test]
    fn a_power_law_is_found_and_a_point_is_not_enough() {
        let points: Vec<(f64, f64)> = [100.0, 414.0, 9000.0].iter().map(|x: &f64| (*x, 3.0 * x.powf(1.2))).collect();
        assert!((growth_exponent(&points).unwrap() - 1.2).abs() < 1e-12);
        assert_eq!(growth_exponent(&points[..1]), None);
        assert_eq!(growth_exponent(&[(2.0, 1.0), (2.0, 5.0)]), None);
    }

    #[test]
    fn the_front_keeps_what_nothing_beats() {
        let points = [(1.0, 5.0), (2.0, 2.0), (3.0, 2.0), (4.0, 1.0), (1.0, 5.0)];
        assert_eq!(pareto_front(&points), [true, true, false, true, true]);
    }
}
