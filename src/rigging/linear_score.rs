//! How well cables would serve the poses, by the body linearised at rest.
//!
//! With `A = S H^-1` at rest a cable under the tension `tau` moves the targets by `-A grad l tau`, and the cables of one winch pull
//! alike. What the winches of a layout leave of the way to the targets, at their best tensions of each pose, ranks layouts before any of
//! them is simulated: the model is far from large motions, but says which way a cable pulls at all.

use super::layout::Layout;
use super::refine::Task;
use crate::engine::compile::{compile_with, objective};
use crate::mesh::Mesh;
use crate::outline::Point;
use crate::outline::polygon::length;

/// Rounds of the best tensions, one winch after the other.
const ROUNDS: usize = 12;

/// The poses of a task, linearised at rest.
pub struct Linear<'a> {
    mesh: &'a Mesh,
    /// Of every pose: rows of `S H^-1`, and the way that is left, both by the root of the targets' weights.
    poses: Vec<(Vec<Vec<f64>>, Vec<f64>)>,
}

impl<'a> Linear<'a> {
    /// `None` where the design has no model, or the body is not held.
    pub fn new(task: &'a Task<'a>) -> Option<Self> {
        let mesh = &task.design.mesh;
        let mut plushie = compile_with(task.design, task.fixed).ok()?;
        let rest = plushie.model.rest.clone();
        plushie.model.contractile.set_contractions(&vec![0.0; plushie.tendons.len()]);
        plushie.model.factorize_for_descent(&rest).ok()?;
        let mut poses = Vec::new();
        for (targets, _) in &task.poses {
            let objective = objective(task.design, &plushie, targets);
            let (mut rows, mut way) = (Vec::new(), Vec::new());
            for target in &objective.targets {
                let root = target.weight.sqrt();
                for (axis, offset) in target.offset(&rest).into_iter().enumerate() {
                    let mut row = vec![0.0; rest.len()];
                    for (&n, w) in target.nodes.iter().zip(&target.weights) {
                        row[2 * n + axis] += root * w;
                    }
                    plushie.model.solve(&mut row);
                    rows.push(row);
                    way.push(-root * offset);
                }
            }
            poses.push((rows, way));
        }
        Some(Self { mesh, poses })
    }

    /// The squared way that is left of every pose, as a part of the whole, squared again and summed: as `C` counts. Infinite for a
    /// layout outside of the body.
    pub fn left(&self, layout: &Layout) -> f64 {
        let Some(effects) = layout.winches.iter().map(|w| self.effects(w.at, &w.cables)).collect::<Option<Vec<_>>>()
        else {
            return f64::INFINITY;
        };
        let left = |k: usize| {
            let mine: Vec<&Vec<f64>> = effects.iter().map(|of_winch| &of_winch[k]).collect();
            left(&self.poses[k].1, &mine)
        };
        (0..self.poses.len()).map(|k| left(k).powi(2)).sum()
    }

    /// How a winch moves the targets of every pose, all its cables pulled alike.
    fn effects(&self, winch: Point, cables: &[Vec<Point>]) -> Option<Vec<Vec<f64>>> {
        let mut out: Vec<Vec<f64>> = self.poses.iter().map(|(_, way)| vec![0.0; way.len()]).collect();
        for cable in cables {
            let points = [&[winch], &cable[..]].concat();
            for s in points.windows(2) {
                let whole = length(s[0], s[1]).max(f64::MIN_POSITIVE);
                let u = [(s[1][0] - s[0][0]) / whole, (s[1][1] - s[0][1]) / whole];
                for (p, sign) in [(s[0], 1.0), (s[1], -1.0)] {
                    let at = self.mesh.locate(p, &self.mesh.nodes)?;
                    for (n, w) in self.mesh.triangles[at.triangle].into_iter().zip(at.weights) {
                        for ((rows, _), out) in self.poses.iter().zip(&mut out) {
                            for (row, out) in rows.iter().zip(out) {
                                *out += sign * w * (u[0] * row[2 * n] + u[1] * row[2 * n + 1]);
                            }
                        }
                    }
                }
            }
        }
        Some(out)
    }
}

/// The part of a squared way that winches of these effects leave at the best tensions, none below zero.
fn left(way: &[f64], effects: &[&Vec<f64>]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let whole = dot(way, way).max(f64::MIN_POSITIVE);
    let (mut rest, mut tensions) = (way.to_vec(), vec![0.0; effects.len()]);
    for _ in 0..ROUNDS {
        for (effect, tension) in effects.iter().zip(&mut tensions) {
            let by = dot(effect, &rest) / dot(effect, effect).max(f64::MIN_POSITIVE);
            let next = f64::max(*tension + by, 0.0);
            rest.iter_mut().zip(effect.iter()).for_each(|(r, e)| *r -= (next - *tension) * e);
            *tension = next;
        }
    }
    dot(&rest, &rest) / whole
}
