//! Properties that hold for every problem and every design, tried out on random ones.
//!
//! Problems go through the text of a file. No panic; nothing that is not finite in any output or document; no inverted element
//! shown; every failure of a type, with its text; statics never end above the energy of a valid start; broken files are refused.
//! Designs are edited at random: every document comes back from undo and redo, and from its file, bit for bit.

mod check;
mod designs;
mod draw;

pub use check::End;

use super::{BenchError, Report, Session, Table};

/// So many problems to one sequence of edits: a sequence does the work of many problems.
const PROBLEMS_PER_SEQUENCE: usize = 100;
/// Violations that are listed.
const LISTED: usize = 50;

pub struct Properties {
    /// Random problems; one sequence of edits for every hundred.
    pub problems: usize,
    /// Number of the first one, to look at a violation again.
    pub first: usize,
}

/// The result of a run.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// How many problems ended in each way of [`End::ALL`].
    pub ends: [usize; End::ALL.len()],
    pub sequences: usize,
    /// Edits that took effect and were undone and redone.
    pub edits: usize,
    /// Each property that does not hold: the kind (`problem`, `design`), its number, and what is wrong.
    pub violations: Vec<(&'static str, usize, String)>,
}

impl Properties {
    /// The counts, and whether anything was violated.
    ///
    /// # Errors
    /// The study was cancelled.
    pub fn run(&self, session: &Session) -> Result<(Report, Option<String>), BenchError> {
        let found = self.try_out(session)?;
        let count = found.violations.len();
        Ok((self.report(&found, session.seed), (count > 0).then(|| format!("{count} violations"))))
    }

    /// Runs all problems and sequences of edits.
    ///
    /// # Errors
    /// The study was cancelled.
    pub fn try_out(&self, session: &Session) -> Result<Found, BenchError> {
        let mut found = Found::default();
        for number in self.first..self.first + self.problems {
            if number % 100 == 0 {
                session.next(&format!("problem {number}, {} violations", found.violations.len()))?;
            }
            let drawn = draw::problem(session.seed, number as u64);
            match check::problem(&drawn) {
                Ok(end) => {
                    let place = End::ALL.iter().position(|e| *e == end).unwrap_or(0);
                    found.ends[place] += 1;
                }
                Err(what) => found.violations.push(("problem", number, what)),
            }
            if number % PROBLEMS_PER_SEQUENCE == 0 {
                found.sequences += 1;
                match designs::sequence(session.seed, number as u64) {
                    Ok(edits) => found.edits += edits,
                    Err(what) => found.violations.push(("design", number, what)),
                }
            }
        }
        Ok(found)
    }

    fn report(&self, found: &Found, seed: u64) -> Report {
        let mut ends = Table::new("properties", "How the problems ended", &["end", "problems"]);
        for (end, count) in End::ALL.iter().zip(found.ends) {
            ends.push(vec![end.name().into(), count.into()]);
        }
        let mut violations = Table::new("violations", "What does not hold", &["kind", "number", "what"]);
        for (kind, number, what) in found.violations.iter().take(LISTED) {
            violations.push(vec![(*kind).into(), (*number).into(), what.clone().into()]);
        }
        let remarks = vec![format!(
            "{} problems and {} sequences of edits ({} edits undone and redone): {} violations.",
            self.problems,
            found.sequences,
            found.edits,
            found.violations.len()
        )];
        let last = (self.first + self.problems).saturating_sub(1);
        Report {
            title: format!("Properties: random problems {} to {last}, seed {seed}", self.first),
            tables: vec![ends, violations],
            remarks,
            plots: Vec::new(),
        }
    }
}

/// The text of the problem with this number, to be looked at on its own.
pub fn problem_text(seed: u64, number: usize) -> Option<String> {
    draw::problem(seed, number as u64).problem.to_text().ok()
}
