//! Which cables of a linear body pull, and the windings that bring it closest to its targets.

use nalgebra::{DMatrix, DVector};

/// Rounds of the best windings, one winch after the other.
const ROUNDS: usize = 12;
/// Times that the best windings are worked out for the cables that pull at the last ones.
const SLACKENED: usize = 3;
/// Cables are called for where they lack more than this part of what the most called one does.
const LACKING: f64 = 1e-9;

/// Cables on a linear body: `C tau >= q + R alpha`, `tau >= 0`, one of both exact, and what `tau` leaves of the way, `w + E tau`.
pub(super) struct Pulls {
    /// `C`, compliances of the body and the cables.
    pub compliance: DMatrix<f64>,
    /// `q`: how much longer the cables would be than at rest, if none pulled.
    pub called: DVector<f64>,
    /// Columns of `E`.
    pub effects: Vec<DVector<f64>>,
    /// `w`.
    pub way: DVector<f64>,
    /// The rows of `R`: the winch of each cable, and what it winds of it in a turn as a part of what the others do.
    pub winches: Vec<(usize, f64)>,
    /// Most that every winch winds.
    pub most: Vec<f64>,
}

/// What windings leave.
pub(super) struct Left {
    /// Of the way, squared.
    pub square: f64,
    pub windings: Vec<f64>,
}

impl Pulls {
    /// The best windings that were found; `None` where `C` is not positive definite.
    ///
    /// Windings that are best for the cables that pull decide which do, and so on: the best of these is kept.
    pub fn best(&self) -> Option<Left> {
        let mut taut: Vec<usize> = (0..self.effects.len()).collect();
        let (mut best, _) = self.at(vec![0.0; self.most.len()], &taut)?;
        for _ in 0..SLACKENED {
            let (left, pulling) = self.at(self.windings(&taut)?, &taut)?;
            if left.square < best.square {
                best = left;
            }
            if pulling == taut {
                break;
            }
            taut = pulling;
        }
        Some(best)
    }

    /// What these windings leave, and the cables that pull then, `first` being the guess.
    fn at(&self, windings: Vec<f64>, first: &[usize]) -> Option<(Left, Vec<usize>)> {
        let called = self.called.iter().zip(&self.winches).map(|(own, &(winch, ratio))| own + ratio * windings[winch]);
        let called = DVector::from_iterator(self.called.len(), called);
        let (pulling, tensions) = pulling(&self.compliance, &called, first)?;
        let square = self.carried(&pulling, &tensions, self.way.clone()).norm_squared();
        Some((Left { square, windings }, pulling))
    }

    /// The best windings if just these cables pulled, or pushed.
    fn windings(&self, taut: &[usize]) -> Option<Vec<f64>> {
        let mut windings = vec![0.0; self.most.len()];
        if taut.is_empty() {
            return Some(windings);
        }
        let factor = within(&self.compliance, taut).cholesky()?;
        let tensions = |called: &dyn Fn(usize) -> f64| {
            factor.solve(&DVector::from_iterator(taut.len(), taut.iter().map(|&c| called(c))))
        };
        let mut rest = self.carried(taut, &tensions(&|c| self.called[c]), self.way.clone());
        let by_winch =
            (0..windings.len()).map(|w| tensions(&|c| if self.winches[c].0 == w { self.winches[c].1 } else { 0.0 }));
        let moves: Vec<DVector<f64>> =
            by_winch.map(|tensions| self.carried(taut, &tensions, DVector::zeros(self.way.len()))).collect();
        for _ in 0..ROUNDS {
            for ((by, winding), most) in moves.iter().zip(&mut windings).zip(&self.most) {
                let square = by.norm_squared();
                if square > 0.0 {
                    let next = (*winding - by.dot(&rest) / square).clamp(0.0, *most);
                    rest.axpy(next - *winding, by, 1.0);
                    *winding = next;
                }
            }
        }
        Some(windings)
    }

    fn carried(&self, taut: &[usize], tensions: &DVector<f64>, from: DVector<f64>) -> DVector<f64> {
        let mut out = from;
        taut.iter().zip(tensions.iter()).for_each(|(&c, t)| out.axpy(*t, &self.effects[c], 1.0));
        out
    }
}

fn within(compliance: &DMatrix<f64>, some: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(some.len(), some.len(), |a, b| compliance[(some[a], some[b])])
}

/// The cables that pull and their tensions: the one that pushes most is taken out, or else the one that lacks most taken in, until there
/// is none of either; `None` where rounding makes that a cycle.
fn pulling(compliance: &DMatrix<f64>, called: &DVector<f64>, first: &[usize]) -> Option<(Vec<usize>, DVector<f64>)> {
    let mut taut = first.to_vec();
    let enough = LACKING * called.amax();
    for _ in 0..=3 * called.len() {
        let right = DVector::from_iterator(taut.len(), taut.iter().map(|&c| called[c]));
        let tensions = within(compliance, &taut).cholesky()?.solve(&right);
        let least = (0..taut.len()).min_by(|&a, &b| tensions[a].total_cmp(&tensions[b]));
        if let Some(k) = least.filter(|&k| tensions[k] < 0.0) {
            taut.remove(k);
            continue;
        }
        let lacks = |c: usize| {
            called[c] - taut.iter().zip(tensions.iter()).map(|(&t, tension)| compliance[(c, t)] * tension).sum::<f64>()
        };
        let slack = (0..called.len()).filter(|c| !taut.contains(c)).map(|c| (lacks(c), c));
        match slack.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(lacking, _)| *lacking > enough) {
            Some((_, c)) => taut.insert(taut.partition_point(|&t| t < c), c),
            None => return Some((taut, tensions)),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Cables of two winches on a random body.
    fn random_pulls(random: &mut Random, cables: usize) -> Pulls {
        let mut unit = || random.between(-1.0, 1.0);
        let root = DMatrix::from_fn(cables, cables + 2, |_, _| unit());
        Pulls {
            compliance: &root * root.transpose() + 0.05 * DMatrix::identity(cables, cables),
            called: DVector::from_fn(cables, |_, _| unit()),
            effects: (0..cables).map(|_| DVector::from_fn(6, |_, _| unit())).collect(),
            way: DVector::from_fn(6, |_, _| unit()),
            winches: (0..cables).map(|c| (c % 2, 1.0)).collect(),
            most: vec![2.0; 2],
        }
    }

    #[test]
    fn cables_pull_or_are_slack_and_none_pushes() {
        let random = &mut Random::new(11);
        for _ in 0..500 {
            let cables = 1 + random.index(7);
            let pulls = random_pulls(random, cables);
            let first: Vec<usize> = (0..cables).filter(|_| random.index(2) == 0).collect();
            let (taut, tensions) = pulling(&pulls.compliance, &pulls.called, &first).unwrap();
            let mut tau = DVector::zeros(cables);
            taut.iter().zip(tensions.iter()).for_each(|(&c, t)| tau[c] = *t);
            let over = &pulls.compliance * &tau - &pulls.called;
            for c in 0..cables {
                assert!(tau[c] >= 0.0 && over[c] > -1e-8, "{tau} {over}");
                assert!(tau[c].min(over[c]) < 1e-8, "{tau} {over}");
            }
        }
    }

    #[test]
    fn the_best_windings_are_seldom_beaten_by_a_scan() {
        let random = &mut Random::new(12);
        let mut beaten = 0;
        for _ in 0..200 {
            let pulls = random_pulls(random, 4);
            let best = pulls.best().unwrap();
            assert!(best.windings.iter().all(|w| (0.0..=2.0).contains(w)));
            let known = pulls.at(best.windings.clone(), &[]).unwrap().0.square;
            assert!((known - best.square).abs() < 1e-9 * (1.0 + known), "{known} {}", best.square);
            let at = |i: i32| 0.1 * f64::from(i);
            let scanned = (0..=20).flat_map(|i| (0..=20).map(move |j| vec![at(i), at(j)]));
            let least = scanned.map(|w| pulls.at(w, &[]).unwrap().0.square).fold(f64::INFINITY, f64::min);
            beaten += usize::from(least < 0.95 * best.square);
        }
        assert!(beaten < 40, "{beaten} of 200");
    }
}
