//! Networks: what those of Algorithm 2, of the joint search and of the bundled designs reach, and whether a hand can sew them.
//!
//! Every error is that of the worst pose, wound from rest as a check winds it, as a part of the error at rest.

mod rigged;
pub mod toys;

use super::report::Cell;
use super::shapes;
use super::statistics::quantile;
use super::{BenchError, Report, Session, Table};
use crate::defaults;
use crate::design::Design;
use crate::random::Random;
use crate::rigging::{Method, RigOptions, TendonChoice};
use rigged::Rigged;

/// Friction that rigs are compared under.
const FRICTIONS: [f64; 5] = [0.0, 0.05, 0.1, 0.2, 0.4];
/// Targets are moved by this part of the body length, and once by one that nobody could see.
const MOVED: f64 = 0.005;
const UNSEEN: f64 = 1e-9;
/// An error after a move that is no more than so many times the one before, or no more than so much larger, is as good.
const AS_GOOD: [f64; 2] = [1.5, 0.03];
/// Plushies sewn of each rig.
const SEWN_PLUSHIES: usize = 10;

/// A design that needs winches, and how many it may have.
struct Case {
    name: String,
    design: Design,
    winches: usize,
    tendons: TendonChoice,
    /// Whether its own networks are compared.
    shipped: bool,
}

/// What is known of a design: rigs, and rows of the other tables.
struct Studied {
    rigs: Vec<(&'static str, Rigged)>,
    rubbed: Option<Vec<Cell>>,
    by_hand: Option<Vec<Cell>>,
    moved: Option<Vec<Cell>>,
    curve: Option<Vec<Cell>>,
}

/// The study.
pub struct Networks {
    /// Names of bundled designs and toys.
    pub shapes: Vec<String>,
    pub rounds: usize,
    /// Fibres of toys, or the fewest that an outline allows where that is more.
    pub fibers: usize,
    /// Winches and tendons of toys.
    pub winches: usize,
    pub tendons: usize,
    /// Moved targets for each design; 0 for none.
    pub moves: usize,
    /// Most winches of the curve; 0 for none.
    pub curve: usize,
}

/// All that can be asked for by name.
pub fn names() -> Vec<String> {
    shapes::names().into_iter().chain(toys::ALL.iter().map(|toy| toy.name.to_owned())).collect()
}

impl Networks {
    /// Told to stop, it ends with the designs that were finished.
    ///
    /// # Errors
    /// A name that is none, or cancelled before a design was finished.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let cases = self.shapes.iter().map(|name| self.case(name)).collect::<Result<Vec<_>, _>>()?;
        let mut report =
            Report { title: format!("networks, {} rounds, seed {}", self.rounds, session.seed), ..Report::default() };
        let (mut compared, mut rubbed) = (compared_table(), rubbed_table());
        let (mut by_hand, mut moved, mut curve) = (by_hand_table(), moved_table(), curve_table(self.curve));
        let mut errors: Vec<(&str, Vec<f64>)> = Vec::new();
        for (done, case) in cases.iter().enumerate() {
            let studied = match self.studied(case, session) {
                Ok(studied) => studied,
                Err(BenchError::Cancelled) if done > 0 => {
                    report.remarks.push(format!("stopped at {}, after {done} of {} designs", case.name, cases.len()));
                    break;
                }
                Err(error) => return Err(error),
            };
            for (what, rigged) in &studied.rigs {
                compared.rows.push(rigged.row(&case.name, what));
                if let Some(error) = rigged.error() {
                    match errors.iter_mut().find(|(name, _)| name == what) {
                        Some((_, errors)) => errors.push(error),
                        None => errors.push((what, vec![error])),
                    }
                }
            }
            rubbed.rows.extend(studied.rubbed);
            by_hand.rows.extend(studied.by_hand);
            moved.rows.extend(studied.moved);
            curve.rows.extend(studied.curve);
        }
        for (what, mut errors) in errors {
            errors.sort_by(f64::total_cmp);
            let worst = errors.last().copied().unwrap_or(f64::NAN);
            report.remarks.push(format!("{what}: median {:.3}, worst {worst:.3}", quantile(&errors, 0.5)));
        }
        report.tables = vec![compared, rubbed, by_hand];
        report.tables.extend([moved, curve].into_iter().filter(|table| !table.rows.is_empty()));
        Ok(report)
    }

    /// All that is asked of a design.
    fn studied(&self, case: &Case, session: &Session) -> Result<Studied, BenchError> {
        let rigs = self.rigs(case, session)?;
        let (mut rubbed, mut by_hand, mut moved) = (None, None, None);
        if let Some((_, rigged)) = rigs.iter().find(|(what, _)| *what == SEWN) {
            let errors = FRICTIONS.iter().map(|&mu| rigged.under(mu, session).into());
            rubbed = Some(std::iter::once(case.name.clone().into()).chain(errors).collect());
            // What is cut short has no figures.
            session.check()?;
            let sewn = rigged.sewn(SEWN_PLUSHIES, session)?;
            let error = rigged.error();
            by_hand = Some([vec![case.name.clone().into(), error.into()], again(error, &sewn).to_vec()].concat());
            moved = (self.moves > 0).then(|| self.moved(case, rigged, &sewn, session)).transpose()?;
        }
        let curve = (self.curve > 0).then(|| self.curve(case, session)).transpose()?;
        Ok(Studied { rigs, rubbed, by_hand, moved, curve })
    }

    fn case(&self, name: &str) -> Result<Case, BenchError> {
        if let Some(toy) = toys::ALL.iter().find(|toy| toy.name == name.to_lowercase()) {
            let mut design = toy.design(self.fibers)?;
            design.tendons.friction = 0.0;
            let tendons = TendonChoice::PerWinch(vec![self.tendons]);
            return Ok(Case { name: name.into(), design, winches: self.winches, tendons, shipped: false });
        }
        let mut design = shapes::original(name).map_err(|error| match error {
            BenchError::NoSuchShape { name, made, .. } => BenchError::NoSuchShape { name, known: names(), made },
            other => other,
        })?;
        design.tendons.friction = 0.0;
        let tendons = design.networks.iter().map(|network| network.tendons.len()).collect();
        let winches = design.networks.len();
        Ok(Case { name: name.into(), design, winches, tendons: TendonChoice::PerWinch(tendons), shipped: true })
    }

    /// All rigs that are compared.
    fn rigs(&self, case: &Case, session: &Session) -> Result<Vec<(&'static str, Rigged)>, BenchError> {
        let mut out = Vec::new();
        let told = |what: &'static str, rigged: Rigged| {
            let error = rigged.error().map_or("no figure".into(), |error| format!("{error:.3} of rest"));
            let took = if rigged.seconds() > 0.0 { format!(", {:.0} s", rigged.seconds()) } else { String::new() };
            (session.found)(&format!("{}, {what}: {error}{took}", case.name));
            (what, rigged)
        };
        if case.shipped {
            session.next(&format!("{}: {SHIPPED}", case.name))?;
            out.push(told(SHIPPED, Rigged::of(case.design.clone(), 0.0, session)?));
        }
        let joint = self.sewn(case, session, case.winches);
        let swept = RigOptions { method: Method::Algorithm2, ..joint.clone() };
        let paper = RigOptions {
            seed_num: Some(defaults::SEED_NUM),
            join_depth: Some(defaults::JOIN_DEPTH),
            join_len: Some(defaults::JOIN_LEN),
            phi: Some(defaults::PHI),
            ..swept.clone()
        };
        let free = RigOptions { rules: false, ..joint.clone() };
        for (what, options) in [(AS_PUBLISHED, paper), (SWEPT, swept), (FREE, free), (SEWN, joint)] {
            session.next(&format!("{}: {what}", case.name))?;
            out.push(told(what, Rigged::found(&case.design, &options, session)?));
        }
        Ok(out)
    }

    /// The joint search again for targets that moved a little. `sewn`: the errors of plushies of the one before.
    fn moved(&self, case: &Case, base: &Rigged, sewn: &[f64], session: &Session) -> Result<Vec<Cell>, BenchError> {
        let options = self.sewn(case, session, case.winches);
        let (mut errors, mut as_sewn) = (Vec::new(), Vec::new());
        for number in 0..self.moves {
            session.next(&format!("{}: moved targets {} of {}", case.name, number + 1, self.moves))?;
            let random = &mut Random::of(session.seed, "moved", number as u64);
            let other = Rigged::found(&with_moved(&case.design, MOVED, random), &options, session)?;
            errors.push(other.error().unwrap_or(f64::INFINITY));
            as_sewn.push(quantile(&other.sewn(SEWN_PLUSHIES, session)?, 0.5));
        }
        [&mut errors, &mut as_sewn].into_iter().for_each(|errors| errors.sort_by(f64::total_cmp));
        let unseen = with_moved(&case.design, UNSEEN, &mut Random::of(session.seed, "unseen", 0));
        let same = Rigged::found(&unseen, &options, session)?.design.networks == base.design.networks;
        let before = [base.error(), Some(quantile(sewn, 0.5))];
        let mut row = vec![case.name.clone().into()];
        for (before, errors) in before.into_iter().zip([errors, as_sewn]) {
            row.push(before.into());
            row.extend(again(before, &errors));
        }
        row.push(if same { "yes" } else { "no" }.into());
        Ok(row)
    }

    fn curve(&self, case: &Case, session: &Session) -> Result<Vec<Cell>, BenchError> {
        let mut row = vec![case.name.clone().into()];
        for winches in 1..=self.curve {
            session.next(&format!("{}: {winches} winches", case.name))?;
            let found = Rigged::found(&case.design, &self.sewn(case, session, winches), session)?;
            row.push(found.error().into());
        }
        Ok(row)
    }

    fn sewn(&self, case: &Case, session: &Session, winches: usize) -> RigOptions {
        RigOptions {
            rounds: self.rounds,
            seed: session.seed,
            max_winches: winches,
            tendons: case.tendons.clone(),
            ..RigOptions::default()
        }
    }
}

const SHIPPED: &str = "as shipped";
const AS_PUBLISHED: &str = "Algorithm 2";
const SWEPT: &str = "Algorithm 2, swept";
const FREE: &str = "joint, no rules";
const SEWN: &str = "joint, sewable";

fn compared_table() -> Table {
    let headings =
        ["design", "poses", "networks", "winches", "tendons", "error", "holes", "thread mm", "rules broken", "s"];
    Table {
        name: "networks".into(),
        caption: "The worst pose's error as a part of that at rest, without friction".into(),
        headings: headings.map(str::to_owned).to_vec(),
        rows: Vec::new(),
    }
}

fn rubbed_table() -> Table {
    Table {
        name: "friction".into(),
        caption: "The same under friction at the holes, all cables pulled".into(),
        headings: std::iter::once("design".to_owned()).chain(FRICTIONS.map(|mu| format!("mu {mu}"))).collect(),
        rows: Vec::new(),
    }
}

/// How errors compare with the one before, ascending: median, worst, and how many are as good.
fn again(before: Option<f64>, errors: &[f64]) -> [Cell; 3] {
    let before = before.unwrap_or(f64::INFINITY);
    let as_good = errors.iter().filter(|e| **e <= f64::max(AS_GOOD[0] * before, before + AS_GOOD[1])).count();
    let worst = errors.last().copied();
    [quantile(errors, 0.5).into(), worst.into(), format!("{as_good} of {}", errors.len()).into()]
}

fn by_hand_table() -> Table {
    let (hole, winch) = (defaults::SEWN_HOLE_MM, defaults::SEWN_WINCH_MM);
    Table {
        name: "sewn".into(),
        caption: format!(
            "The same sewn {SEWN_PLUSHIES} times, holes {hole} mm and winches {winch} mm off, each wound as serves it best"
        ),
        headings: ["design", "as drawn", "median sewn", "worst sewn", "as good"].map(str::to_owned).to_vec(),
        rows: Vec::new(),
    }
}

fn moved_table() -> Table {
    let drawn = ["as drawn", "median moved", "worst moved", "as good"];
    let sewn = ["as sewn", "sewn: median moved", "sewn: worst moved", "sewn: as good"];
    let headings = [&["design"][..], &drawn, &sewn, &["same after 1e-9"]].concat();
    Table {
        name: "stability".into(),
        caption: format!(
            "Targets moved by {} % of the body, and networks sought again: as drawn, and the median plushie as sewn",
            100.0 * MOVED
        ),
        headings: headings.into_iter().map(str::to_owned).collect(),
        rows: Vec::new(),
    }
}

fn curve_table(most: usize) -> Table {
    Table {
        name: "winches".into(),
        caption: "Error against the number of winches".into(),
        headings: std::iter::once("design".to_owned()).chain((1..=most).map(|n| n.to_string())).collect(),
        rows: Vec::new(),
    }
}

/// The design with every target moved by a part of the body length, any way.
fn with_moved(design: &Design, part: f64, random: &mut Random) -> Design {
    let (mut out, by) = (design.clone(), part * design.body_length_mm());
    for target in out.poses.iter_mut().flat_map(|pose| &mut pose.targets) {
        let way = random.direction();
        target.to = [target.to[0] + by * way[0], target.to[1] + by * way[1]];
    }
    out
}
