//! What counts of the errors of several poses: the worst first.

use std::cmp::Ordering;

/// A pose that keeps this part of its error at rest, or more, counts as one that keeps all of it: a tenth less is what a body's drift gives away, and no
/// maker would call that served. Less: poses that are hard to serve would count for nothing.
const HELPED: f64 = 0.9;

/// Parts of their errors at rest that poses keep, in the order in which rigs [compare](compare): the largest first.
///
/// What no winch brings nearer ([`HELPED`]) must not decide by a thousandth over what they do for the others, so all such poses count alike. The
/// largest as it is comes last, for rigs that help none.
pub fn worst_first(parts: impl Iterator<Item = f64>) -> Vec<f64> {
    let parts: Vec<f64> = parts.collect();
    let mut sorted: Vec<f64> = parts.iter().map(|part| if *part >= HELPED { 1.0 } else { *part }).collect();
    sorted.sort_by(|a, b| b.total_cmp(a));
    sorted.push(parts.into_iter().fold(0.0, f64::max));
    sorted
}

/// Compares rigs by what [`worst_first`] makes of them: the better one is less.
pub fn compare(a: &[f64], b: &[f64]) -> Ordering {
    a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
}

/// The largest part of a pose that is helped; of all where none is.
pub fn worst_helped(parts: impl Iterator<Item = f64>) -> f64 {
    let sorted = worst_first(parts);
    sorted.iter().copied().find(|part| *part < HELPED).or(sorted.last().copied()).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_that_nothing_helps_does_not_decide_over_the_others() {
        let better = |a: &[f64], b: &[f64]| {
            let [a, b] = [a, b].map(|parts| worst_first(parts.iter().copied()));
            compare(&a, &b) == Ordering::Less && compare(&b, &a) == Ordering::Greater
        };
        assert!(better(&[0.08, 0.07], &[0.09, 0.01]));
        assert!(better(&[0.08, 0.01], &[0.08, 0.02]));
        assert!(better(&[0.9991, 0.05, 0.1], &[0.9, 0.999, 0.7]));
        assert!(better(&[0.05, 1.0], &[0.999, 0.06]));
        // Where none is helped, less is less.
        assert!(better(&[0.93], &[0.95]) && better(&[1.0], &[f64::INFINITY]));
        assert_eq!(worst_helped([0.99, 0.1, 0.2].into_iter()), 0.2);
        assert_eq!(worst_helped([0.99, 0.95].into_iter()), 0.99);
        assert_eq!(worst_helped(std::iter::empty()), 0.0);
    }
}
