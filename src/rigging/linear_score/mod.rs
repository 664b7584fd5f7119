//! How well cables would serve the poses, by the body linearised around a state.
//!
//! Around positions `x` with the body's Hessian `H`, cables with gradients of length `G`, gaps `b` (rest length less present length),
//! compliances `D` and windings `alpha` of their winches carry the tensions `tau` of
//!
//! ```text
//! (G H^-1 G^T + D) tau = G u0 - b + R alpha,     u = u0 - H^-1 G^T tau,     u0 = H^-1 p
//! ```
//!
//! where `p` is what the cables that are there in this state pull, and `u0` the way back without them. Cables that would have to push are
//! slack. What the best windings of each pose, none below zero or above what its winch can wind, leave of the way to the targets ranks
//! layouts before any of them is simulated ([`pulls`]).
//!
//! Around rest the model is far from large motions, but says which way a cable pulls at all. Around what a layout reaches already, it says
//! which change of that layout is worth a simulation. Around what a fibre on every edge reaches, it is exact where it counts: a layout that
//! holds the body in that shape leaves nothing there, however far from rest it is.

mod pulls;

use super::layout::{Cable, Layout, Placed};
use super::refine::{Fit, Start, Task};
use super::sewable::posed_violation;
use crate::design::TendonSettings;
use crate::engine::compile::{compile_with, limit_of, objective};
use crate::engine::{Setpoint, solve_once};
use crate::mesh::Mesh;
use crate::outline::Point;
use crate::outline::polygon::length;
use crate::threads::in_order;
use nalgebra::{DMatrix, DVector};
use pulls::{Left, Pulls};
use std::sync::atomic::AtomicBool;

/// A cable yields at least as much as the body does, by this part: two cables on one way share what one would carry.
const YIELDING: f64 = 1e-3;
/// Around goals, which no cables have reached yet, the way of the whole body counts as well, at so many of its nodes: what a linear model says of
/// far ways is not true. All together they weigh this part of the targets.
const NODES: usize = 30;
const STAYING: f64 = 0.1;

/// The poses of a task, linearised around a state of each.
pub struct Linear<'a> {
    mesh: &'a Mesh,
    /// Winches that stay, and their cables.
    fixed: Layout,
    tendons: &'a TendonSettings,
    /// The rim of the mesh, ring by ring.
    rings: Vec<Vec<usize>>,
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
    way: DVector<f64>,
    /// The squared way at rest.
    whole: f64,
}

/// A cable in a state: the gradient of its length, entry by entry, and its gap, mm.
struct Taut {
    gradient: Vec<(usize, f64)>,
    gap: f64,
    winch: usize,
    ratio: f64,
    /// Farthest that its winch can wind it.
    most: f64,
    /// Where it passes in this state.
    places: Vec<Point>,
}

/// The cables in all states.
struct Everywhere {
    winches: usize,
    /// State by state.
    cables: Vec<Vec<Taut>>,
}

impl<'a> Linear<'a> {
    /// Around rest; `None` where the design has no model, or the body is not held.
    pub fn at_rest(task: &'a Task<'a>) -> Option<Self> {
        Self::around(task, None, 0.0)
    }

    /// Around what a layout reaches.
    pub fn at(task: &'a Task<'a>, fit: &Fit) -> Option<Self> {
        Self::around(task, Some(fit.poses.iter().map(|posture| posture.x.clone()).collect()), 0.0)
    }

    /// Around what a fibre on every edge reaches; `None` as [`Self::at_rest`], or where there is no such shape of every pose.
    pub fn at_goals(task: &'a Task<'a>, cancel: &AtomicBool) -> Option<Self> {
        let goals = in_order(&task.poses, |(targets, _)| {
            let setpoint = Setpoint::Targets(targets.clone());
            let shape = solve_once(task.design, setpoint, [true, false], cancel).idealized?;
            Some(shape.nodes.into_iter().flatten().collect())
        });
        Self::around(task, Some(goals.into_iter().collect::<Option<_>>()?), STAYING)
    }

    /// Around these positions of every pose, or rest; `staying` is the weight of the whole body's way.
    fn around(task: &'a Task<'a>, shapes: Option<Vec<Vec<f64>>>, staying: f64) -> Option<Self> {
        let mesh = &task.design.mesh;
        let mut plushie = compile_with(task.design, &[]).ok()?;
        let rest = plushie.model.rest.clone();
        let (mut states, mut poses) = (Vec::new(), Vec::new());
        for (k, (targets, whole)) in task.poses.iter().enumerate() {
            if shapes.is_some() || k == 0 {
                let x = shapes.as_ref().map_or_else(|| rest.clone(), |shapes| shapes[k].clone());
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
            if shapes.is_some() {
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
            if staying > 0.0 {
                let some: Vec<usize> = (0..x.len() / 2).step_by((x.len() / 2 / NODES).max(1)).collect();
                let weight: f64 = objective.targets.iter().map(|target| target.weight).sum();
                let root = (staying * weight / some.len() as f64).sqrt();
                for entry in some.into_iter().flat_map(|n| [2 * n, 2 * n + 1]) {
                    rows.push(compliance[entry * x.len()..][..x.len()].iter().map(|c| root * c).collect());
                    way.push(-root * back[entry]);
                }
            }
            poses.push(Pose { state, back, rows, way: DVector::from_vec(way), whole: *whole });
        }
        let (fixed, tendons, rings) = (Layout::of(task.fixed, mesh), &task.design.tendons, mesh.boundary());
        Some(Self { mesh, fixed, tendons, rings, states, poses })
    }

    /// The squared way that is left of every pose, as a part of the whole, squared again and summed, and cables that leave the body in its states:
    /// as `C` counts, or a part of that which is more than the limit. Infinite for a layout outside of the body at rest.
    pub fn cost(&self, layout: &Layout, limit: f64) -> f64 {
        let Some(everywhere) = self.everywhere(layout) else { return f64::INFINITY };
        let outside = self.outside(&everywhere);
        if outside > limit { outside } else { outside + self.left(&everywhere) }
    }

    /// [`Self::cost`] without what cables outside of the body add.
    #[cfg(test)]
    pub fn missed(&self, layout: &Layout) -> f64 {
        self.everywhere(layout).map_or(f64::INFINITY, |everywhere| self.left(&everywhere))
    }

    /// Windings and positions of every pose from which a layout is to be tried.
    pub fn starts(&self, layout: &Layout) -> Option<Vec<Start>> {
        let everywhere = self.everywhere(layout)?;
        let start = |pose: &Pose| Some((self.pulled(pose, &everywhere)?.windings, self.states[pose.state].x.clone()));
        self.poses.iter().map(start).collect()
    }

    fn left(&self, everywhere: &Everywhere) -> f64 {
        let left = |pose: &Pose| {
            self.pulled(pose, everywhere).map_or(f64::INFINITY, |left| (left.square / pose.whole).powi(2))
        };
        self.poses.iter().map(left).sum()
    }

    /// By how much cables leave the body.
    fn outside(&self, everywhere: &Everywhere) -> f64 {
        let of = |(state, cables): (&State, &Vec<Taut>)| {
            let ring = |nodes: &Vec<usize>| nodes.iter().map(|&n| [state.x[2 * n], state.x[2 * n + 1]]).collect();
            let rings: Vec<Vec<Point>> = self.rings.iter().map(ring).collect();
            posed_violation(&rings, cables.iter().map(|cable| cable.places.as_slice()))
        };
        self.states.iter().zip(&everywhere.cables).map(of).sum()
    }

    /// `None` where a cable leaves the body at rest.
    fn everywhere(&self, layout: &Layout) -> Option<Everywhere> {
        let winches: Vec<&Placed> = self.fixed.winches.iter().chain(&layout.winches).collect();
        let taut = |state: &State| -> Option<Vec<Taut>> {
            let cables = winches
                .iter()
                .enumerate()
                .flat_map(|(winch, placed)| placed.cables.iter().map(move |c| self.taut(state, winch, placed.at, c)));
            cables.collect()
        };
        Some(Everywhere { winches: winches.len(), cables: self.states.iter().map(taut).collect::<Option<_>>()? })
    }

    fn taut(&self, state: &State, winch: usize, at: Point, cable: &Cable) -> Option<Taut> {
        let mut out = Taut {
            gradient: Vec::new(),
            gap: cable.slack_mm,
            winch,
            ratio: cable.ratio,
            most: 0.0,
            places: Vec::new(),
        };
        let mut whole = 0.0;
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
                whole += length(rest, p);
                let u = [(here[0] - there[0]) / now, (here[1] - there[1]) / now];
                for (point, sign) in [(&other, -1.0), (&body, 1.0)] {
                    for (n, w) in self.mesh.triangles[point.triangle].into_iter().zip(point.weights) {
                        out.gradient.extend([(2 * n, sign * w * u[0]), (2 * n + 1, sign * w * u[1])]);
                    }
                }
            }
            out.places.push(here);
            before = Some((p, here, body));
        }
        out.most = limit_of(self.tendons, whole, cable.slack_mm, cable.ratio);
        Some(out)
    }

    /// What the best windings leave of a pose; `None` where they have none.
    fn pulled(&self, pose: &Pose, everywhere: &Everywhere) -> Option<Left> {
        let (cables, compliance) = (&everywhere.cables[pose.state], &self.states[pose.state].compliance);
        let (n, count) = (pose.back.len(), cables.len());
        let dot = |row: &[f64], cable: &Taut| cable.gradient.iter().map(|&(i, g)| g * row[i]).sum::<f64>();
        let mut coupling = DMatrix::from_fn(count, count, |a, b| {
            if b > a {
                return 0.0;
            }
            cables[a].gradient.iter().map(|&(i, g)| g * dot(&compliance[i * n..][..n], &cables[b])).sum()
        });
        coupling.fill_upper_triangle_with_lower_triangle();
        // Taut, a cable is a spring of twice the stiffness (eq. 8).
        let own = 0.5 / self.tendons.stiffness;
        (0..count).for_each(|k| coupling[(k, k)] = coupling[(k, k)] * (1.0 + YIELDING) + own);
        let effect =
            |cable: &Taut| DVector::from_iterator(pose.rows.len(), pose.rows.iter().map(|row| dot(row, cable)));
        let most = |w: usize| cables.iter().filter(|c| c.winch == w).map(|c| c.most).fold(f64::INFINITY, f64::min);
        let pulls = Pulls {
            compliance: coupling,
            called: DVector::from_iterator(count, cables.iter().map(|cable| dot(&pose.back, cable) - cable.gap)),
            effects: cables.iter().map(effect).collect(),
            way: pose.way.clone(),
            winches: cables.iter().map(|cable| (cable.winch, cable.ratio)).collect(),
            most: (0..everywhere.winches).map(most).collect(),
        };
        pulls.best()
    }
}
