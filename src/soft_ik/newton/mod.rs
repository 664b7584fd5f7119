//! Newton's method in the contractions: the question's own `O`, with true bounds, for any number of fibres.
//!
//! Each iteration linearises the equilibrium at `(x, beta)` (`saddle`), minimises the quadratic model of `O` within the bounds
//! (`quadratic`), and settles the body at the activations that it names; `O` never rises. Where the exact reduced Hessian is not
//! positive definite, Gauss-Newton takes its place. Damping (Levenberg, Marquardt) follows the gain ratio.
//!
//! It is a local method: what it finds depends on where it starts (`super::fibers`). An element that is slack feels
//! nothing but the regulariser.

mod active;
mod border;
mod damped;
mod form;
mod interior;
mod quadratic;
mod rows;
mod saddle;
mod structure;

use super::{Answer, Budget, Method, Posture, Question};
use crate::physics::HessianForm;
use form::{Form, NotConvex};
use saddle::{Local, Saddle, Step};

/// Descends to a point where the projected gradient of `O` vanishes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newton {
    /// Ends where iterations gain less than this part of `O`, each, `PATIENCE` times in a row; 0: only where converged.
    pub relative_decrease: f64,
    /// A value of `O` that others have: ends where it is out of reach at the pace of the last iterations.
    pub rival: f64,
}

impl Default for Newton {
    fn default() -> Self {
        Self { relative_decrease: 0.0, rival: f64::INFINITY }
    }
}

/// Iterations of little gain after which a search is given up.
const PATIENCE: usize = 3;
/// A search is given up as well after so many iterations in a row in which it gains less than this part of what it is behind its rival.
/// Of 23 seeded problems of fibres none lost more than 3e-5 of its value by that.
const LEFT_BEHIND: usize = 2;
const CATCHING_UP: f64 = 0.15;
/// Converged where the [`projected_gradient`] is at most this part of `O`: no winch, moved by its whole length, would change `O` by
/// more to first order. A tenth of it is more than statics can resolve where targets are all but reached.
pub const TOLERANCE: f64 = 1e-4;
/// `O` below this part of that of the rest shape counts as zero: targets are reached to six digits.
const NOTHING: f64 = 1e-12;
/// Damping in units of a winch's own curvature: the first one, the least (below it counts as none), the largest.
const FIRST_DAMPING: f64 = 1.0;
const LEAST_DAMPING: f64 = 1e-6;
const LARGEST_DAMPING: f64 = 1e16;
/// A winch's own curvature counts as at least this part of all targets' weights: without a regulariser it has none.
const LEAST_CURVATURE: f64 = 1e-7;
/// Longest step of a node, as a part of the body, and of a winch, as a part of its length: beyond it the linearised lengths mean
/// nothing. Farther moves can take statics 30 to 45 factorisations to settle, many for steps that are then refused.
const LONGEST_MOVE: f64 = 0.1;
const LONGEST_PULL: f64 = 0.5;
/// Gain ratios: a step is taken above the first; damping falls above the second, and grows below the third.
const TAKEN: f64 = 1e-4;
const GOOD: f64 = 0.75;
const POOR: f64 = 0.25;
/// By what damping falls, and by what it grows where a step is not taken and where it is poor.
const RELAXED: f64 = 0.1;
const REJECTED: f64 = 8.0;
const DOUBTED: f64 = 2.0;
/// By what the damping of a step that was not taken counts less from one good step to the next: else every other step would be one as bold.
const FORGOTTEN: f64 = 0.5;
/// Parts to which a step is shortened at least and at most that is not taken, since damping may leave it as long as it was; and by what later
/// ones may be longer than a good one.
const SHORTENED: [f64; 2] = [0.25, 0.5];
const LENGTHENED: f64 = 4.0;
/// Iterations for which a form of the Hessian is used that is convex, before the exact one is tried again.
const CONVEX_AFTER: usize = 2;
/// Forms and dampings that are tried in an iteration before Gauss-Newton takes the place of the convexified Hessian.
const MOST_RAISED: usize = 4;
/// Where the Hessian had to be damped to be convex, `O` may fall far along the step: it is gone on with by this factor.
const EXTENSION: f64 = 3.0;
/// A winch this near to a bound, in its lengths, is on it.
const ON_BOUND: f64 = 1e-12;
/// A promise below this part of `O` is rounding.
const NO_PROMISE: f64 = 1e-15;
/// Statics resolves `O` no better than to this part where targets are all but reached: there a promise is believed, and the projected
/// gradient says whether it was kept.
const RESOLVED: f64 = 1e-7;
/// Believed steps that do not leave a smaller projected gradient, before a search is given up.
const MOST_BELIEVED: usize = 4;
/// Step of the difference quotient of `H` along `p`, as a part of the body: error 1e-8, rounding 1e-12.
const DIFFERENCE: f64 = 1e-5;

impl Method for Newton {
    fn name(&self) -> &'static str {
        "newton"
    }

    /// Panics where the question has a weight on tensions (a caller's mistake: its derivatives are not here).
    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
        assert!(question.objective.tension_weight == 0.0, "Newton's method knows no weight on tensions");
        let mut answer = Answer::at(start);
        if question.actuation.winches.is_empty() {
            answer.converged = true;
            return answer;
        }
        if let Some(mut search) = Search::new(question) {
            search.run(question, self, budget, &mut answer);
        }
        let contractions = question.actuation.contractions(&answer.posture.beta);
        question.model.contractile.set_contractions(&contractions);
        answer
    }
}

/// The largest `|P_j| a_j` at activations `beta` with `gradient = dO/dbeta`, in units of `O`: `P_j` is the gradient, or zero where
/// winch `j` is at a bound that the descent pushes against; `a_j` is the longest initial rest length of its elements, over
/// its ratio.
pub fn projected_gradient(question: &Question, beta: &[f64], gradient: &[f64]) -> f64 {
    let lengths = rows::lengths(question.actuation, &question.model.contractile.elements);
    let inward = |j: usize| {
        let (winch, g) = (&question.actuation.winches[j], gradient[j]);
        !(beta[j] <= winch.lower && g > 0.0 || beta[j] >= winch.upper && g < 0.0)
    };
    (0..beta.len()).filter(|j| inward(*j)).map(|j| gradient[j].abs() * lengths[j]).fold(0.0, f64::max)
}

/// Whether a [`projected_gradient`] is small enough at an objective.
pub fn is_small(question: &Question, projected: f64, objective: f64) -> bool {
    projected <= TOLERANCE * objective || objective <= NOTHING * question.objective.position_value(&question.model.rest)
}

/// Structure and buffers of a search, and what it has learnt.
struct Search {
    saddle: Saddle,
    local: Local,
    size: f64,
    lengths: Vec<f64>,
    damping: f64,
    /// The damping that it does not fall below at once: of the last step that was not taken, a little raised.
    refused: f64,
    /// Trust radius, as a part of the longest steps.
    radius: f64,
    /// Iterations for which Gauss-Newton is used without a try of the exact Hessian.
    convex: usize,
    /// Iterations for which the convexified form is used without a try of the exact one.
    convexified: usize,
    /// Whether the last step promised too little for `O` to tell.
    believed: bool,
}

impl Search {
    fn new(question: &Question) -> Option<Self> {
        Some(Self {
            saddle: Saddle::new(question)?,
            local: Local::default(),
            size: question.body_size(),
            lengths: rows::lengths(question.actuation, &question.model.contractile.elements),
            damping: FIRST_DAMPING,
            refused: 0.0,
            radius: 1.0,
            convex: 0,
            convexified: 0,
            believed: false,
        })
    }

    fn run(&mut self, question: &mut Question, ends: &Newton, budget: &Budget, answer: &mut Answer) {
        let (mut idle, mut behind) = (0, 0);
        // The smallest projected gradient where `O` is no longer resolved, and the believed steps since.
        let mut kept: Option<(f64, Posture)> = None;
        let mut believed = 0;
        while answer.iterations < budget.iterations && !(budget.stop)() {
            answer.iterations += 1;
            if !self.linearise(question, &answer.posture, &mut answer.factorizations) {
                return;
            }
            let posture = &answer.posture;
            let projected = projected_gradient(question, &posture.beta, &self.local.gradient);
            if is_small(question, projected, posture.objective) {
                answer.converged = true;
                return;
            }
            if !self.believed {
                (kept, believed) = (None, 0);
            } else {
                believed += 1;
                if kept.as_ref().is_none_or(|(least, _)| projected < *least) {
                    (kept, believed) = (Some((projected, posture.clone())), 0);
                }
            }
            let before = posture.objective;
            if believed >= MOST_BELIEVED || !self.improve(question, budget, answer) {
                break;
            }
            let gain = before - answer.posture.objective;
            idle = if gain < ends.relative_decrease * before { idle + 1 } else { 0 };
            behind = if gain < CATCHING_UP * (answer.posture.objective - ends.rival) { behind + 1 } else { 0 };
            if idle >= PATIENCE || behind >= LEFT_BEHIND {
                break;
            }
        }
        if let Some((_, posture)) = kept.filter(|_| self.believed) {
            answer.posture = posture;
        }
    }

    /// Takes one step that lowers `O`; whether there was one.
    fn improve(&mut self, question: &mut Question, budget: &Budget, answer: &mut Answer) -> bool {
        let mut form = self.first_form();
        self.saddle.assemble(question, &self.local, form);
        let (first, mut raised, mut refused) = (self.damping, 0, false);
        while self.damping <= LARGEST_DAMPING && !(budget.stop)() {
            let Ok(step) = self.minimise(question, form, answer) else {
                raised += 1;
                match form {
                    Form::Exact => {
                        form = Form::Convexified;
                        self.convexified = CONVEX_AFTER;
                        self.saddle.assemble(question, &self.local, form);
                    }
                    Form::Convexified if raised >= MOST_RAISED => {
                        form = Form::GaussNewton;
                        self.convex = CONVEX_AFTER;
                        self.damping = first;
                        self.saddle.assemble(question, &self.local, form);
                    }
                    _ => self.raise(),
                }
                continue;
            };
            let longest = self.longest(&step);
            let t = (self.radius.min(1.0) * longest).min(1.0);
            let promised = -(t * step.slope + t * t * step.curvature);
            if promised <= NO_PROMISE * answer.posture.objective {
                // The bounds leave nothing of a step this long.
                self.raise();
                continue;
            }
            let trial = self.settle_at(question, &answer.posture, &step, t, budget, &mut answer.factorizations);
            let gain = answer.posture.objective - trial.objective;
            let ratio = gain / promised;
            let told = (0.5..2.0).contains(&ratio);
            self.believed = promised <= RESOLVED * answer.posture.objective && !told;
            let kept = self.believed && -gain <= RESOLVED * answer.posture.objective;
            let taken = trial.in_equilibrium() && (ratio > TAKEN || kept);
            if taken {
                self.trust(t / longest, ratio, t == 1.0 && !refused);
                let from = std::mem::replace(&mut answer.posture, trial);
                if raised > 0 && ratio > GOOD && t == 1.0 {
                    self.extend(question, budget, &from, &step, answer);
                }
                return true;
            }
            refused = true;
            self.distrust(t / longest, if trial.in_equilibrium() { ratio } else { f64::NEG_INFINITY });
            // Statics has left its own factor behind.
            let contractions = question.actuation.contractions(&answer.posture.beta);
            question.model.contractile.set_contractions(&contractions);
            answer.factorizations += 1;
            if question.model.factorize(&answer.posture.x, HessianForm::Exact).is_err() {
                return false;
            }
        }
        false
    }

    /// The form of the Hessian that an iteration begins with.
    fn first_form(&mut self) -> Form {
        let form = match (self.convex, self.convexified) {
            (1.., _) => Form::GaussNewton,
            (0, 1..) => Form::Convexified,
            (0, 0) => Form::Exact,
        };
        self.convex = self.convex.saturating_sub(1);
        self.convexified = self.convexified.saturating_sub(1);
        form
    }

    /// After a step that was taken, of this length in the longest ones, with this gain ratio: longer ones later, and less damping after a
    /// `whole` one, of the model's own length and before which none was refused.
    fn trust(&mut self, length: f64, ratio: f64, whole: bool) {
        self.radius = self.radius.max(if ratio > POOR { LENGTHENED * length } else { length });
        if whole && (ratio > GOOD || self.believed) {
            self.damping = (RELAXED * self.damping).max(self.refused).max(LEAST_DAMPING);
            self.refused *= FORGOTTEN;
        } else if ratio < POOR {
            self.damping *= DOUBTED;
        }
    }

    /// After a step that was not taken: the next is shorter, to where the parabola through both values has its least, and damped more.
    fn distrust(&mut self, length: f64, ratio: f64) {
        self.radius = length * (1.0 / (2.0 - ratio)).clamp(SHORTENED[0], SHORTENED[1]);
        self.refused = REJECTED.sqrt() * self.damping;
        self.raise();
    }

    fn raise(&mut self) {
        self.damping = (REJECTED * self.damping).max(REJECTED * LEAST_DAMPING);
    }

    /// The minimiser of the model at the answer's posture with the present damping.
    fn minimise(&mut self, question: &mut Question, form: Form, answer: &mut Answer) -> Result<Step, NotConvex> {
        let damping = if self.damping <= LEAST_DAMPING { 0.0 } else { self.damping };
        let damping: Vec<f64> = self.units(question).iter().map(|unit| damping * unit).collect();
        let beta = &answer.posture.beta;
        let room = question.actuation.winches.iter().zip(beta).map(|(w, b)| [w.lower - b, w.upper - b]).collect();
        let mut model = damped::Model {
            saddle: &mut self.saddle,
            question,
            local: &self.local,
            form,
            damping: &damping,
            room,
            lengths: &self.lengths,
            objective: answer.posture.objective,
        };
        quadratic::minimise(&mut model, &mut answer.factorizations)
    }

    /// The equilibrium after `t` times a step.
    fn settle_at(
        &self,
        question: &mut Question,
        from: &Posture,
        step: &Step,
        t: f64,
        budget: &Budget,
        factorizations: &mut usize,
    ) -> Posture {
        let beta = self.stepped(question, &from.beta, &step.beta, t);
        let guess = predicted(question, &from.x, &step.x, t);
        let (posture, count) = question.settle(&beta, &guess, budget.stop);
        *factorizations += count;
        posture
    }

    /// Activations after a part of a step, within their bounds, and on them where rounding alone keeps them off.
    fn stepped(&self, question: &Question, beta: &[f64], step: &[f64], t: f64) -> Vec<f64> {
        let on = |(j, w): (usize, &super::Winch)| {
            let (b, near) = (beta[j] + t * step[j], ON_BOUND * self.lengths[j]);
            if b <= w.lower + near {
                w.lower
            } else if b >= w.upper - near {
                w.upper
            } else {
                b
            }
        };
        question.actuation.winches.iter().enumerate().map(on).collect()
    }

    /// Goes on along a step that the damping alone has kept short, while that lowers `O`.
    fn extend(&self, question: &mut Question, budget: &Budget, from: &Posture, step: &Step, answer: &mut Answer) {
        let most = self.longest(step);
        let mut t = 1.0;
        while t < most && !(budget.stop)() {
            t = (EXTENSION * t).min(most);
            let trial = self.settle_at(question, from, step, t, budget, &mut answer.factorizations);
            if !trial.in_equilibrium() || trial.objective >= answer.posture.objective {
                break;
            }
            answer.posture = trial;
        }
    }

    /// The curvature that each winch has of its own, by which it is damped.
    fn units(&self, question: &Question) -> Vec<f64> {
        let weights: f64 = question.objective.targets.iter().map(|t| t.weight).sum();
        let least = LEAST_CURVATURE * weights.max(f64::MIN_POSITIVE);
        self.local.rows.explicit.iter().map(|own| own.max(least)).collect()
    }

    /// The multiple of a step beyond which it is too long.
    fn longest(&self, step: &Step) -> f64 {
        let moved = step.x.iter().fold(0.0_f64, |m, d| m.max(d.abs())) / (LONGEST_MOVE * self.size);
        let pulled = step.beta.iter().zip(&self.lengths).map(|(d, l)| d.abs() / (LONGEST_PULL * l)).fold(0.0, f64::max);
        1.0 / moved.max(pulled).max(f64::MIN_POSITIVE)
    }

    /// Everything at the posture that a step needs; `false` where its equilibrium is not stable.
    fn linearise(&mut self, question: &mut Question, at: &Posture, factorizations: &mut usize) -> bool {
        let contractions = question.actuation.contractions(&at.beta);
        question.model.contractile.set_contractions(&contractions);
        *factorizations += 1;
        if question.model.factorize(&at.x, HessianForm::Exact).is_err() {
            return false;
        }
        self.local.hessian.clear();
        self.local.hessian.extend_from_slice(question.model.hessian_values());
        let mut p = vec![0.0; at.x.len()];
        question.objective.position_gradient(&at.x, &mut p);
        question.model.solve(&mut p);
        self.local.rows.update(&self.saddle.stencils, question, &at.x, &contractions, &p);
        self.gradient(question, &contractions, &p);
        self.bend(question, &at.x, &p);
        true
    }

    /// `dO/dbeta_j = lambda sum r alpha_c/alpha_0^2 - force_j . p`, from the rows at hand: what [`super::sensitivity::gradient`] finds
    /// element by element, but for the order of the sums.
    fn gradient(&mut self, question: &Question, contractions: &[f64], p: &[f64]) {
        let elements = &question.model.contractile.elements;
        let lambda = question.objective.contraction_weight;
        let Local { rows, gradient, .. } = &mut self.local;
        gradient.clear();
        for (j, winch) in question.actuation.winches.iter().enumerate() {
            let explicit = |&(e, r): &(usize, f64)| lambda * r * contractions[e] / elements[e].alpha0.powi(2);
            let pulled =
                self.saddle.stencils.nodes(j).iter().zip(rows.force[self.saddle.stencils.entries(j)].chunks_exact(2));
            let pulled: f64 = pulled.map(|(&n, f)| f[0] * p[2 * n] + f[1] * p[2 * n + 1]).sum();
            gradient.push(winch.members.iter().map(explicit).sum::<f64>() - pulled);
        }
    }

    /// `d(H p)/dx` by a central difference of `H` along `p`.
    fn bend(&mut self, question: &mut Question, x: &[f64], p: &[f64]) {
        let longest = p.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let [bend, convex] = &mut self.local.bend;
        for list in [&mut *bend, &mut *convex] {
            list.clear();
            list.resize(self.local.hessian.len(), 0.0);
        }
        if longest == 0.0 {
            return;
        }
        let h = DIFFERENCE * self.size / longest;
        for sign in [1.0, -1.0] {
            let moved: Vec<f64> = x.iter().zip(p).map(|(x, p)| x + sign * h * p).collect();
            question.model.assemble(&moved, HessianForm::Exact);
            for (b, v) in bend.iter_mut().zip(question.model.hessian_values()) {
                *b += sign * v / (2.0 * h);
            }
        }
        convex.clone_from(bend);
        self.saddle.remove_concave(question, x, &self.local.rows.concave, convex);
    }
}

/// First-order prediction of the positions, as far as no triangle comes near inversion.
fn predicted(question: &Question, x: &[f64], dx: &[f64], t: f64) -> Vec<f64> {
    let scaled: Vec<f64> = dx.iter().map(|d| t * d).collect();
    let limit = question.model.step_limit(x, &scaled);
    x.iter().zip(&scaled).map(|(x, d)| x + limit * d).collect()
}

#[cfg(test)]
mod tests;
