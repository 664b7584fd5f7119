//! Nested dissection by coordinates: an order of elimination for the Hessian of a mesh (George 1973).
//!
//! The nodes are halved by a line across the longer side of their box; the nodes of one half that touch the other are the
//! separator and are eliminated last. For planar meshes the factor has `O(n log n)` values and costs `O(n^1.5)`.

use crate::mesh::Mesh;

/// Parts up to this many nodes are not divided further.
const LEAF: usize = 12;

/// The order in which the nodes are eliminated.
pub fn nested_dissection(mesh: &Mesh) -> Vec<usize> {
    let neighbours = mesh.neighbours();
    let mut side = vec![0; mesh.nodes.len()];
    let mut order = Vec::with_capacity(mesh.nodes.len());
    let mut fresh = 0;
    dissect(mesh, &neighbours, (0..mesh.nodes.len()).collect(), &mut side, &mut fresh, &mut order);
    order
}

/// Appends the order of `part`. `side[n]` marks the half that node `n` was last put in; marks are never used twice.
fn dissect(
    mesh: &Mesh,
    neighbours: &[Vec<usize>],
    mut part: Vec<usize>,
    side: &mut [usize],
    fresh: &mut usize,
    order: &mut Vec<usize>,
) {
    if part.len() <= LEAF {
        order.extend(part);
        return;
    }
    let axis = longer_axis(mesh, &part);
    part.sort_unstable_by(|&a, &b| mesh.nodes[a][axis].total_cmp(&mesh.nodes[b][axis]).then(a.cmp(&b)));
    let high = part.split_off(part.len() / 2);
    let (low_mark, high_mark) = (*fresh + 1, *fresh + 2);
    *fresh += 2;
    for &n in &part {
        side[n] = low_mark;
    }
    for &n in &high {
        side[n] = high_mark;
    }
    let touches = |nodes: &[usize], mark: usize| -> Vec<bool> {
        nodes.iter().map(|&n| neighbours[n].iter().any(|&m| side[m] == mark)).collect()
    };
    let (low_touches, high_touches) = (touches(&part, high_mark), touches(&high, low_mark));
    let count = |flags: &[bool]| flags.iter().filter(|f| **f).count();
    let keep = |nodes: &[usize], flags: &[bool], wanted: bool| -> Vec<usize> {
        nodes.iter().zip(flags).filter(|(_, f)| **f == wanted).map(|(n, _)| *n).collect()
    };
    let (low, high, separator) = if count(&low_touches) <= count(&high_touches) {
        (keep(&part, &low_touches, false), high, keep(&part, &low_touches, true))
    } else {
        let separator = keep(&high, &high_touches, true);
        (part, keep(&high, &high_touches, false), separator)
    };
    dissect(mesh, neighbours, low, side, fresh, order);
    dissect(mesh, neighbours, high, side, fresh, order);
    order.extend(separator);
}

fn longer_axis(mesh: &Mesh, part: &[usize]) -> usize {
    let extent = |axis: usize| {
        let values = part.iter().map(|&n| mesh.nodes[n][axis]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        high - low
    };
    usize::from(extent(1) > extent(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::shapes;

    #[test]
    fn it_is_a_permutation() {
        let mesh = shapes::design("robot", 1055).unwrap().mesh;
        let mut order = nested_dissection(&mesh);
        order.sort_unstable();
        assert!(order.into_iter().eq(0..mesh.nodes.len()));
        assert!(nested_dissection(&Mesh::default()).is_empty());
    }
}
