//! Least energy by a quasi-Newton method of limited memory (L-BFGS; Nocedal and Wright, *Numerical Optimization*, 7.2).

use super::membrane::Membrane;

/// Steps remembered.
const MEMORY: usize = 12;
/// Most iterations: a body of 1500 triangles takes a few hundred.
const MOST_ITERATIONS: usize = 700;
/// Most work, in energies of a triangle: what bounds the time where there is no coarser mesh.
const MOST_WORK: usize = 6_000_000;
/// Largest force that is left, over the pressure on the area around a node, dimensionless: sizes are right to a hundredth well before.
const FORCE: f64 = 2e-3;
/// Sufficient decrease, and the most halvings of a step (Armijo).
const DECREASE: f64 = 1e-4;
const MOST_HALVINGS: usize = 30;
/// Length of the first step, over the largest coordinate of its direction, mm.
const FIRST_STEP_MM: f64 = 0.1;

type Nodes = Vec<[f64; 3]>;

/// Where the sheet rests, from `start`.
pub fn relaxed(membrane: &Membrane, start: Nodes) -> Nodes {
    let mut x = start;
    let mut gradient = vec![[0.0; 3]; x.len()];
    let mut energy = membrane.energy(&x, &mut gradient);
    let enough = FORCE * membrane.force_scale();
    let mut memory: Vec<Pair> = Vec::new();
    for _ in 0..MOST_ITERATIONS.min(MOST_WORK / membrane.size().max(1)) {
        let largest = gradient.as_flattened().iter().map(|g| g.abs()).fold(0.0, f64::max);
        if largest <= enough {
            break;
        }
        let mut direction = descent(&memory, &gradient);
        let mut slope = product(&direction, &gradient);
        if slope >= 0.0 {
            memory.clear();
            direction = gradient.iter().map(|g| g.map(|v| -v)).collect();
            slope = -product(&gradient, &gradient);
        }
        let mut step = if memory.is_empty() { FIRST_STEP_MM / largest } else { 1.0 };
        let mut next = gradient.clone();
        let mut found = None;
        for _ in 0..MOST_HALVINGS {
            let there: Nodes = x.iter().zip(&direction).map(|(p, d)| [0, 1, 2].map(|k| p[k] + step * d[k])).collect();
            let value = membrane.energy(&there, &mut next);
            if value <= energy + DECREASE * step * slope {
                found = Some((there, value));
                break;
            }
            step *= 0.5;
        }
        // Rounding allows no more.
        let Some((there, value)) = found else { break };
        let pair = Pair::new(&x, &there, &gradient, &next);
        if pair.curvature > 0.0 {
            if memory.len() == MEMORY {
                memory.remove(0);
            }
            memory.push(pair);
        }
        (x, gradient, energy) = (there, next, value);
    }
    x
}

/// A step and how the gradient changed along it.
struct Pair {
    step: Nodes,
    change: Nodes,
    /// Their product.
    curvature: f64,
}

impl Pair {
    fn new(x: &Nodes, there: &Nodes, gradient: &Nodes, next: &Nodes) -> Self {
        let minus = |a: &Nodes, b: &Nodes| a.iter().zip(b).map(|(p, q)| [0, 1, 2].map(|k| p[k] - q[k])).collect();
        let (step, change) = (minus(there, x), minus(next, gradient));
        let curvature = product(&step, &change);
        Self { step, change, curvature }
    }
}

/// The direction that the remembered curvature suggests.
fn descent(memory: &[Pair], gradient: &Nodes) -> Nodes {
    let mut q: Nodes = gradient.iter().map(|g| g.map(|v| -v)).collect();
    let mut parts = Vec::new();
    for pair in memory.iter().rev() {
        let part = product(&pair.step, &q) / pair.curvature;
        add(&mut q, -part, &pair.change);
        parts.push(part);
    }
    if let Some(last) = memory.last() {
        let scale = last.curvature / product(&last.change, &last.change).max(f64::MIN_POSITIVE);
        q.as_flattened_mut().iter_mut().for_each(|v| *v *= scale);
    }
    for (pair, part) in memory.iter().zip(parts.into_iter().rev()) {
        let back = product(&pair.change, &q) / pair.curvature;
        add(&mut q, part - back, &pair.step);
    }
    q
}

fn product(a: &Nodes, b: &Nodes) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(p, q)| p * q).sum()
}

fn add(q: &mut Nodes, factor: f64, other: &Nodes) {
    for (v, o) in q.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
        *v += factor * o;
    }
}
