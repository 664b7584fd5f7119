//! One order for equal meshes.

/// Puts triangles in the order of their nodes, each with its smallest first.
pub(super) fn order(triangles: &mut [[usize; 3]]) {
    for t in triangles.iter_mut() {
        let smallest = (0..3).min_by_key(|&k| t[k]).unwrap_or(0);
        t.rotate_left(smallest);
    }
    triangles.sort_unstable();
}
