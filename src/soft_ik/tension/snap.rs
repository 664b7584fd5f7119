//! When a state has snapped into another equilibrium.

/// Growth of `O`, as a factor and in squared body lengths, when a state is settled, from which on it counts as snapped.
const SNAPPED: f64 = 1.01;
const SNAPPED_BY: f64 = 1e-6;
/// How often a run goes on from a pose that a converged state snapped into.
pub(in crate::soft_ik) const RETURNS: usize = 4;

/// Whether a state has snapped into another equilibrium when it was settled: `O` there, what it was taken for before, and the
/// size of the body.
pub(in crate::soft_ik) fn snapped(settled: f64, expected: f64, size: f64) -> bool {
    settled > SNAPPED * expected && settled > expected + SNAPPED_BY * size * size
}
