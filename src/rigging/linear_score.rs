//! How well cables would serve the poses, by the body linearised around a state.
//!
//! Around positions `x` with the body's Hessian `H`, cables with gradients of length `G`, gaps `b` (rest length less present length)
//! and windings `alpha` of their winches carry the tensions `tau` of
//!
//! ```text
//! (G H^-1 G^T + 1/k) tau = G u0 - b + B alpha,     u = u0 - H^-1 G^T tau,     u0 = H^-1 p
//! ```
//!
//! where `p` is what the cables that are there in this state pull, and `u0` the way back without them. What the best windings of each
//! pose, none below zero, leave of the way to the targets ranks layouts before any of them is simulated. Cables that would have to push
//! are slack. Around rest the model is far from large motions, but says which way a cable pulls at all; around what a layout reaches
//! already, it says which change of that layout is worth a simulation.

use super::layout::{Cable, Layout, Placed};
use super::refine::{Fit, Task};
use crate::engine::compile::{compile_with, objective};
use crate::mesh::Mesh;
use crate::outline::Point;
use crate::outline::polygon::length;
use nalgebra::{DMatrix, DVector};

/// Rounds of the best windings, one winch after the other.
const ROUNDS: usize = 12;
/// Times that cables which would push are taken out.
const SLACKENED: usize = 3;
/// A cable yields at least as much as the body does, by this part: two cables on one way share what one would carry.
const YIELDING: f64 = 1e-3;

/// The poses of a task, linearised around a state of each.
pub struct Linear<'a> {
    mesh: &'a Mesh,
    /// Winches that stay, and their cables.
    fixed: Layout,
    states: Vec<State>,
    /// Which state is a pose's: around rest all have the same.
    poses: Vec<Pose>,
}

/// A state of the body.
struct State {
    x: Vec<f64>,
    /// `H^-1`, column after column.
    compliance: Vec<f64>,
}

struct Pose {
    state: usize,
    /// `u0`.
    back: Vec<f64>,
    /// Rows of `S H^-1` by the root of the targets' weights.
    rows: Vec<Vec<f64>>,
    /// What is left of the way after `u0`, likewise.
    way: Vec<f64>,
    /// The squared way at rest.
    whole: f64,
}

/// A cable in a state: the gradient of its length, entry by entry, and its gap, mm.
struct Taut {
    gradient: Vec<(usize, f64)>,
    gap: f64,
    winch: usize,
    ratio: f64,
}

impl<'a> Linear<'a> {
    /// Around rest; `None` where the design has no model, or the body is not held.
    pub fn at_rest(task: &'a Task<'a>) -> Option<Self> {
        Self::around(task, None)
    }

    /// Around what a layout reaches.
    pub fn at(task: &'a Task<'a>, fit: &Fit) -> Option<Self> {
        Self::around(task, Some(fit))
    }

    fn around(task: &'a Task<'a>, fit: Option<&Fit>) -> Option<Self> {
        let mesh = &task.design.mesh;
        let mut plushie = compile_with(task.design, &[]).ok()?;
        let rest = plushie.model.rest.clone();
        let (mut states, mut poses) = (Vec::new(), Vec::new());
        for (k, (targets, whole)) in task.poses.iter().enumerate() {
            if fit.is_some() || k == 0 {
                let x = fit.map_or_else(|| rest.clone(), |fit| fit.poses[k].x.clone());
                plushie.model.factorize_for_descent(&x).ok()?;
                let mut compliance = vec![0.0; x.len() * x.len()];
                (0..x.len()).for_each(|i| compliance[i * x.len() + i] = 1.0);
                plushie.model.solve_many(&mut compliance, x.len());
                states.push(State { x, compliance });
            }
            let state = states.len() - 1;
            let State { x, compliance } = &states[state];
            // Without cables the body pulls back with what they carried.
            let mut back = vec![0.0; x.len()];
            if fit.is_some() {
                plushie.model.gradient(x, &mut back);
                back.iter_mut().for_each(|g| *g = -*g);
                plushie.model.solve(&mut back);
            }
            let objective = objective(task.design, &plushie, targets);
            let (mut rows, mut way) = (Vec::new(), Vec::new());
            for target in &objective.targets {
                let root = target.weight.sqrt();
                for (axis, offset) in target.offset(x).into_iter().enumerate() {
                    let mut row = vec![0.0; x.len()];
                    let mut gone = 0.0;
                    for (&n, w) in target.nodes.iter().zip(&target.weights) {
                        let column = &compliance[(2 * n + axis) * x.len()..][..x.len()];
                        row.iter_mut().zip(column).for_each(|(r, c)| *r += root * w * c);
                        gone += w * back[2 * n + axis];
                    }
                    rows.push(row);
                    way.push(-root * (offset + gone));
                }
            }
            poses.push(Pose { state, back, rows, way, whole: *whole });
        }
        Some(Self { mesh, fixed: Layout::of(task.fixed, mesh), states, poses })
    }

    /// The squared way that is left of every pose, as a part of the whole, squared again and summed: as `C` counts. Infinite for a
    /// layout outside of the body.
    pub fn left(&self, layout: &Layout) -> f64 {
        let winches: Vec<&Placed> = self.fixed.winches.iter().chain(&layout.winches).collect();
        let taut = |state: &State| -> Option<Vec<Taut>> {
            let cables = winches
                .iter()
                .enumerate()
                .flat_map(|(winch, placed)| placed.cables.iter().map(move |c| self.taut(state, winch, placed.at, c)));
            cables.collect()
        };
        let Some(taut) = self.states.iter().map(taut).collect::<Option<Vec<_>>>() else { return f64::INFINITY };
        let left = |pose: &Pose| {
            let compliance = &self.states[pose.state].compliance;
            pose.left(compliance, &taut[pose.state], winches.len()).map_or(f64::INFINITY, |left| left.powi(2))
        };
        self.poses.iter().map(left).sum()
    }

    fn taut(&self, state: &State, winch: usize, at: Point, cable: &Cable) -> Option<Taut> {
        let mut out = Taut { gradient: Vec::new(), gap: cable.slack_mm, winch, ratio: cable.ratio };
        let mut before: Option<(Point, Point, crate::mesh::BodyPoint)> = None;
        for &p in std::iter::once(&at).chain(cable.iter()) {
            let body = self.mesh.locate(p, &self.mesh.nodes)?;
            let corners = self.mesh.triangles[body.triangle];
            let mut here = [0.0; 2];
            for (n, w) in corners.into_iter().zip(body.weights) {
                here[0] += w * state.x[2 * n];
                here[1] += w * state.x[2 * n + 1];
            }
            if let Some((rest, there, other)) = before {
                let now = length(there, here).max(f64::MIN_POSITIVE);
                out.gap += length(rest, p) - now;
                let u = [(here[0] - there[0]) / now, (here[1] - there[1]) / now];
                for (point, sign) in [(&other, -1.0), (&body, 1.0)] {
                    for (n, w) in self.mesh.triangles[point.triangle].into_iter().zip(point.weights) {
                        out.gradient.extend([(2 * n, sign * w * u[0]), (2 * n + 1, sign * w * u[1])]);
                    }
                }
            }
            before = Some((p, here, body));
        }
        Some(out)
    }
}

impl Pose {
    /// The part of the squared way at rest that cables leave at the best windings of their winches; `None` where they have none.
    fn left(&self, compliance: &[f64], cables: &[Taut], winches: usize) -> Option<f64> {
        let n = self.back.len();
        let dot = |row: &[f64], cable: &Taut| cable.gradient.iter().map(|&(i, g)| g * row[i]).sum::<f64>();
        let effects: Vec<DVector<f64>> = cables
            .iter()
            .map(|cable| DVector::from_iterator(self.rows.len(), self.rows.iter().map(|row| dot(row, cable))))
            .collect();
        let coupling = DMatrix::from_fn(cables.len(), cables.len(), |a, b| {
            if b > a {
                return 0.0;
            }
            cables[a].gradient.iter().map(|&(i, g)| g * dot(&compliance[i * n..][..n], &cables[b])).sum()
        });
        let mut taut: Vec<usize> = (0..cables.len()).collect();
        let mut left = self.way.iter().map(|w| w * w).sum::<f64>();
        for _ in 0..SLACKENED {
            if taut.is_empty() {
                break;
            }
            let m = taut.len();
            let mut matrix = DMatrix::from_fn(m, m, |a, b| coupling[(taut[a].max(taut[b]), taut[a].min(taut[b]))]);
            (0..m).for_each(|k| matrix[(k, k)] *= 1.0 + YIELDING);
            let factor = matrix.cholesky()?;
            let own = factor
                .solve(&DVector::from_iterator(m, taut.iter().map(|&c| dot(&self.back, &cables[c]) - cables[c].gap)));
            // Tensions by the winding of each winch.
            let by_winch: Vec<DVector<f64>> = (0..winches)
                .map(|w| {
                    let pulled = taut.iter().map(|&c| if cables[c].winch == w { cables[c].ratio } else { 0.0 });
                    factor.solve(&DVector::from_iterator(m, pulled))
                })
                .collect();
            let moved = |tensions: &DVector<f64>| {
                let mut out = DVector::zeros(self.rows.len());
                taut.iter().zip(tensions.iter()).for_each(|(&c, t)| out.axpy(*t, &effects[c], 1.0));
                out
            };
            let mut rest = DVector::from_column_slice(&self.way) + moved(&own);
            let moves: Vec<DVector<f64>> = by_winch.iter().map(moved).collect();
            let mut windings = vec![0.0; winches];
            for _ in 0..ROUNDS {
                for (by, winding) in moves.iter().zip(&mut windings) {
                    let square = by.dot(by);
                    if square > 0.0 {
                        let next = f64::max(*winding - by.dot(&rest) / square, 0.0);
                        rest.axpy(next - *winding, by, 1.0);
                        *winding = next;
                    }
                }
            }
            left = rest.dot(&rest);
            let tension = |k: usize| own[k] + by_winch.iter().zip(&windings).map(|(by, w)| by[k] * w).sum::<f64>();
            let pulling: Vec<usize> = (0..m).filter(|&k| tension(k) > 0.0).map(|k| taut[k]).collect();
            if pulling.len() == m {
                break;
            }
            taut = pulling;
        }
        if taut.is_empty() {
            left = self.way.iter().map(|w| w * w).sum::<f64>();
        }
        Some(left / self.whole)
    }
}
