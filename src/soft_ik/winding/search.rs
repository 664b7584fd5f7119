//! The search over wound states, unit by unit.

use super::care::{Care, LATTICE};
use super::proof::{Proof, SAME_POSE, Verdict};
use super::rays::{Ray, ranges, rays, spread};
use super::walk::{Walk, distance, size};
use crate::soft_ik::contraction::{FIRST_DAMPING, GaussNewton};
use crate::soft_ik::{Answer, Budget, Posture, Question};
use std::collections::VecDeque;

/// Gauss-Newton from a valley: relative decrease of `O` below which it ends, and iterations at most. Enough to tell values apart.
const EXPLORING_DECREASE: f64 = 1e-5;
const EXPLORING_ITERATIONS: usize = 40;
/// Iterations of one unit of work.
const UNIT: usize = 4;
/// The best is followed to this relative decrease, for at most so many iterations.
const LAST_DECREASE: f64 = 1e-9;
const LAST_ITERATIONS: usize = 200;
/// A valley within so many lattice spacings of a lower one, or so many strides of where Gauss-Newton has ended lower, is the slope
/// of that one.
const NEXT_TO: f64 = 1.5;
/// Polishing ends after so many valleys that end where others have.
const REPEATS: usize = 2;
/// Halvings between a wound state and one that winding does not reach: a part of 1/64 of the way is left.
const HALVINGS: usize = 6;

/// Ends of which no proof holds, at most: each costs a few hundred states, and a body of which so many are not reached snaps wherever it is wound.
const MOST_UNPROVED: usize = 6;

/// Factorisations of walks that may lead to no state of theirs: a snap costs up to three hundred, a body that crumples ten thousand, each as much as
/// several others since its forces hardly ever balance.
const MOST_WASTED: usize = 500;

/// The bottom of a valley on a line.
struct Valley {
    posture: Posture,
    /// Its activations as parts of the ranges, from -1 to 1.
    parts: Vec<f64>,
}

/// Where Gauss-Newton has ended, and the wound state from which it came.
#[derive(Clone)]
struct End {
    posture: Posture,
    from: Option<Posture>,
    /// Whether Gauss-Newton has come to its end there.
    finished: bool,
    done: bool,
}

enum Stage {
    Walking,
    /// Gauss-Newton from a valley, the iterations taken, and the damping it has come to.
    Polishing {
        from: Option<Posture>,
        now: Posture,
        iterations: usize,
        damping: f64,
    },
    /// Gauss-Newton to the end, from the best end that is not done.
    Finishing {
        end: usize,
        iterations: usize,
        damping: f64,
    },
    Proving {
        end: usize,
        proof: Box<Proof>,
        what: Attempt,
    },
    Done,
}

/// What is being proved.
enum Attempt {
    End,
    /// The wound state from which an end came that winding does not reach.
    Valley,
    /// A state between the two.
    Between {
        low: Posture,
        high: Vec<f64>,
        left: usize,
    },
}

/// Finds the best wound state for the present targets.
pub struct Search {
    care: Care,
    size: f64,
    origin: Posture,
    ranges: Vec<[f64; 2]>,
    rays: VecDeque<Ray>,
    walk: Option<Walk>,
    valleys: VecDeque<Valley>,
    ends: Vec<End>,
    polished: usize,
    repeats: usize,
    unproved: usize,
    wasted: usize,
    stage: Stage,
    best: Posture,
    converged: bool,
    iterations: usize,
    factorizations: usize,
    walked: usize,
}

impl Search {
    /// `origin`: the equilibrium from which winding begins.
    pub fn new(question: &Question, origin: &Posture, care: Care) -> Self {
        let count = origin.beta.len();
        let ranges = ranges(question, &origin.beta);
        let rays = match count {
            0 => Vec::new(),
            1..=LATTICE => rays(&origin.beta, &ranges, care.levels[count - 1]),
            _ => spread(&origin.beta, &ranges, care.spread),
        };
        Self {
            care,
            size: size(&question.model.rest),
            origin: origin.clone(),
            ranges,
            rays: rays.into(),
            walk: None,
            valleys: VecDeque::from([Valley { posture: origin.clone(), parts: vec![0.0; count] }]),
            ends: Vec::new(),
            polished: 0,
            repeats: 0,
            unproved: 0,
            wasted: 0,
            stage: if count == 0 { Stage::Done } else { Stage::Walking },
            best: origin.clone(),
            converged: count == 0,
            iterations: 0,
            factorizations: 0,
            walked: 0,
        }
    }

    /// Takes note of a posture found otherwise (`finished`: Gauss-Newton has nothing to add to it). Where proof is asked for, it
    /// counts once that is given.
    pub fn offer(&mut self, posture: &Posture, finished: bool) {
        if posture.in_equilibrium() {
            self.note(End { posture: posture.clone(), from: None, finished, done: false });
        }
    }

    /// Looks no further: what is known by now is followed to its end.
    pub fn hurry(&mut self) {
        if let Stage::Polishing { from, now, .. } = std::mem::replace(&mut self.stage, Stage::Done) {
            self.note(End { posture: now, from, finished: false, done: false });
        }
        self.stage = self.next_end();
    }

    pub fn is_done(&self) -> bool {
        matches!(self.stage, Stage::Done)
    }

    /// The best state so far: proved, where that is asked for.
    pub fn best(&self) -> &Posture {
        &self.best
    }

    /// Works until it is done, or about `most` factorisations are spent, or `stop` ends it. Returns those spent.
    pub fn advance(&mut self, question: &mut Question, most: usize, stop: &dyn Fn() -> bool) -> usize {
        let before = self.factorizations;
        while !self.is_done() && self.factorizations - before < most && !stop() {
            let stage = std::mem::replace(&mut self.stage, Stage::Done);
            self.stage = match stage {
                Stage::Walking => self.walk_on(question, stop),
                Stage::Polishing { from, now, iterations, damping } => {
                    self.polish(question, from, now, (iterations, damping), stop)
                }
                Stage::Finishing { end, iterations, damping } => {
                    self.finish(question, end, (iterations, damping), stop)
                }
                Stage::Proving { end, proof, what } => self.prove(question, end, proof, what, stop),
                Stage::Done => Stage::Done,
            };
        }
        self.factorizations - before
    }

    /// All at once. Leaves the contractions of the answer in the model.
    pub fn run(mut self, question: &mut Question, stop: &dyn Fn() -> bool) -> Answer {
        self.advance(question, usize::MAX, stop);
        if !self.care.proved {
            // Stopped early, what is found counts as it is.
            let ends = std::mem::take(&mut self.ends);
            ends.iter().for_each(|end| self.take(&end.posture));
        }
        let contractions = question.actuation.contractions(&self.best.beta);
        question.model.contractile.set_contractions(&contractions);
        let converged = self.is_done() && self.converged;
        Answer {
            posture: self.best,
            iterations: self.iterations,
            factorizations: self.factorizations,
            converged,
            starts: 1,
        }
    }

    fn walk_on(&mut self, question: &mut Question, stop: &dyn Fn() -> bool) -> Stage {
        if self.walk.is_none() && self.walked < self.care.walking && self.wasted < MOST_WASTED {
            let next = self.rays.pop_front();
            self.walk = next.map(|ray| Walk::new(&self.origin, ray.end, self.size, self.care.pace));
        }
        let Some(walk) = &mut self.walk else {
            self.choose_valleys();
            return self.next_valley(question, stop);
        };
        let (valley, spent) = walk.step(question, stop);
        let wasted = self.wasted + walk.wasted;
        let over = walk.is_over() || self.walked + spent >= self.care.walking || wasted >= MOST_WASTED;
        self.walked += spent;
        self.factorizations += spent;
        if let Some(posture) = valley {
            let parts = self.parts(&posture.beta);
            self.valleys.push_back(Valley { posture, parts });
        }
        if over {
            self.wasted = wasted;
            self.walk = None;
        }
        Stage::Walking
    }

    /// Activations as parts of the ranges.
    fn parts(&self, beta: &[f64]) -> Vec<f64> {
        let part = |j: usize| {
            let (away, [lower, upper]) = (beta[j] - self.origin.beta[j], self.ranges[j]);
            let range = if away < 0.0 { self.origin.beta[j] - lower } else { upper - self.origin.beta[j] };
            if range > 0.0 { away / range } else { 0.0 }
        };
        (0..beta.len()).map(part).collect()
    }

    /// The lowest valleys, without those that lie on the slope of a lower one.
    fn choose_valleys(&mut self) {
        let mut all: Vec<Valley> = std::mem::take(&mut self.valleys).into();
        all.sort_by(|a, b| a.posture.objective.total_cmp(&b.posture.objective));
        let count = self.origin.beta.len();
        let near = match count {
            1 => 0.0,
            2..=LATTICE => NEXT_TO / self.care.levels[count - 1] as f64,
            _ => 0.5,
        };
        let apart =
            |a: &Valley, b: &Valley| a.parts.iter().zip(&b.parts).map(|(p, q)| (p - q).abs()).fold(0.0, f64::max);
        let stride = NEXT_TO * self.care.pace.stride * self.size;
        let known = |valley: &Valley| {
            self.ends.iter().any(|end| {
                let near = distance(&end.posture.x, &valley.posture.x) <= stride;
                near && end.posture.objective <= valley.posture.objective
            })
        };
        let mut chosen: Vec<bool> = Vec::new();
        for (k, valley) in all.iter().enumerate() {
            chosen.push(all[..k].iter().all(|lower| apart(valley, lower) > near) && !known(valley));
        }
        let kept = all.into_iter().zip(chosen).filter(|(_, chosen)| *chosen).map(|(valley, _)| valley);
        self.valleys = kept.take(self.care.polished).collect();
    }

    fn next_valley(&mut self, question: &mut Question, stop: &dyn Fn() -> bool) -> Stage {
        if self.repeats < REPEATS
            && let Some(valley) = self.valleys.pop_front()
        {
            let loose = valley.posture;
            let (posture, spent) = question.settle(&loose.beta, &loose.x, stop);
            self.factorizations += spent;
            let from = Some(posture.clone());
            return Stage::Polishing { from, now: posture, iterations: 0, damping: FIRST_DAMPING };
        }
        self.next_end()
    }

    fn polish(
        &mut self,
        question: &mut Question,
        from: Option<Posture>,
        now: Posture,
        (iterations, mut damping): (usize, f64),
        stop: &dyn Fn() -> bool,
    ) -> Stage {
        let answer = self.descend(question, &now, EXPLORING_DECREASE, &mut damping, stop);
        let iterations = iterations + answer.iterations;
        if answer.iterations == UNIT && !answer.converged && iterations < EXPLORING_ITERATIONS {
            return Stage::Polishing { from, now: answer.posture, iterations, damping };
        }
        self.polished += 1;
        if answer.posture.in_equilibrium() {
            let known = !self.note(End { posture: answer.posture, from, finished: false, done: false });
            self.repeats += known as usize;
        }
        self.next_valley(question, stop)
    }

    fn descend(
        &mut self,
        question: &mut Question,
        from: &Posture,
        relative_decrease: f64,
        damping: &mut f64,
        stop: &dyn Fn() -> bool,
    ) -> Answer {
        let budget = Budget { iterations: UNIT, stop };
        let answer = GaussNewton { relative_decrease }.resume(question, from, &budget, damping);
        self.iterations += answer.iterations;
        self.factorizations += answer.factorizations;
        answer
    }

    /// Keeps an end that is not known yet; whether it was new.
    fn note(&mut self, end: End) -> bool {
        let same = |known: &End| distance(&known.posture.x, &end.posture.x) <= 2.0 * SAME_POSE * self.size;
        match self.ends.iter().position(same) {
            None => {
                self.ends.push(end);
                true
            }
            Some(k) => {
                let known = &mut self.ends[k];
                if !known.done && !known.finished && end.posture.objective < known.posture.objective {
                    (known.posture, known.finished) = (end.posture, end.finished);
                }
                known.from = known.from.take().or(end.from);
                false
            }
        }
    }

    /// The best end that is left, where it can better what is proved.
    fn next_end(&mut self) -> Stage {
        let left = self.ends.iter().enumerate().filter(|(_, end)| !end.done);
        let best = left.min_by(|a, b| a.1.posture.objective.total_cmp(&b.1.posture.objective)).map(|(k, _)| k);
        let Some(end) = best else { return Stage::Done };
        if self.unproved >= MOST_UNPROVED && self.best.in_equilibrium() {
            self.converged = false;
            return Stage::Done;
        }
        let promising = self.ends[end].posture.objective < self.best.objective || !self.best.in_equilibrium();
        if !promising {
            return Stage::Done;
        }
        self.ends[end].done = true;
        Stage::Finishing { end, iterations: 0, damping: FIRST_DAMPING }
    }

    fn finish(
        &mut self,
        question: &mut Question,
        end: usize,
        (iterations, mut damping): (usize, f64),
        stop: &dyn Fn() -> bool,
    ) -> Stage {
        if !self.ends[end].finished {
            let from = self.ends[end].posture.clone();
            let answer = self.descend(question, &from, LAST_DECREASE, &mut damping, stop);
            self.ends[end].posture = answer.posture;
            let iterations = iterations + answer.iterations;
            if answer.iterations == UNIT && !answer.converged && iterations < LAST_ITERATIONS {
                return Stage::Finishing { end, iterations, damping };
            }
            self.ends[end].finished = answer.converged;
        }
        self.converged = self.ends[end].finished;
        if !self.care.proved {
            let posture = self.ends[end].posture.clone();
            self.take(&posture);
            return Stage::Done;
        }
        let proof = Proof::new(&self.origin, &self.ends[end].posture.beta, self.size);
        Stage::Proving { end, proof: Box::new(proof), what: Attempt::End }
    }

    fn take(&mut self, posture: &Posture) {
        if posture.objective < self.best.objective || !self.best.in_equilibrium() {
            self.best = posture.clone();
        }
    }

    fn prove(
        &mut self,
        question: &mut Question,
        end: usize,
        mut proof: Box<Proof>,
        what: Attempt,
        stop: &dyn Fn() -> bool,
    ) -> Stage {
        let (verdict, spent) = proof.step(question, stop);
        self.factorizations += spent;
        let reached = match verdict {
            Verdict::Open => return Stage::Proving { end, proof, what },
            Verdict::Wound(posture) => Some(posture),
            Verdict::Undecided => None,
        };
        if let Some(posture) = &reached {
            self.take(posture);
        }
        let (low, high, left) = match (what, reached) {
            (Attempt::End, Some(posture))
                if distance(&posture.x, &self.ends[end].posture.x) <= SAME_POSE * self.size =>
            {
                return self.next_end();
            }
            (Attempt::End, reached) => {
                self.unproved += 1;
                if let Some(posture) = reached {
                    // Another branch: what Gauss-Newton makes of it is another end.
                    let mut damping = FIRST_DAMPING;
                    let answer = self.descend(question, &posture, EXPLORING_DECREASE, &mut damping, stop);
                    self.note(End { posture: answer.posture, from: Some(posture), finished: false, done: false });
                }
                let Some(from) = self.ends[end].from.clone() else { return self.next_end() };
                let proof = Box::new(Proof::new(&self.origin, &from.beta, self.size));
                return Stage::Proving { end, proof, what: Attempt::Valley };
            }
            (Attempt::Valley, None) => return self.next_end(),
            (Attempt::Valley, Some(posture)) => (posture, self.ends[end].posture.beta.clone(), HALVINGS),
            (Attempt::Between { low, left, .. }, None) => (low, proof.beta().to_vec(), left - 1),
            (Attempt::Between { low, high, left }, Some(posture)) => {
                let better = posture.objective < low.objective;
                if better { (posture, high, left - 1) } else { (low, proof.beta().to_vec(), left - 1) }
            }
        };
        if left == 0 {
            return self.next_end();
        }
        let middle: Vec<f64> = low.beta.iter().zip(&high).map(|(a, b)| 0.5 * (a + b)).collect();
        let proof = Box::new(Proof::new(&self.origin, &middle, self.size));
        Stage::Proving { end, proof, what: Attempt::Between { low, high, left } }
    }
}
