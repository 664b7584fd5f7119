//! Numerical extremes: every row a scene, swept over a range until something would have to break.
//!
//! | file | holds |
//! | --- | --- |
//! | [`row`] | what a row is, its thresholds, and how it is judged |
//! | [`measure`] | runs a case through the door of a problem file |
//! | [`mod@reference`] | answers of twice the digits, by formulas of their own |
//! | [`closed`] | closed forms |
//! | [`scenes`] | the bodies |
//! | [`materials`], [`elements`], [`meshes`], [`pins`], [`targets`] | the rows |

pub mod closed;
pub mod elements;
pub mod materials;
pub mod measure;
pub mod meshes;
pub mod pins;
pub mod reference;
pub mod row;
pub mod scenes;
pub mod targets;

use super::{BenchError, Cell, Report, Session, Table};
use row::{Bar, Outcome, Row};

pub struct Extremes {
    /// The ends and the middle of every sweep, and no large body.
    pub short: bool,
    /// Only rows whose name or group holds this text.
    pub only: Option<String>,
}

/// A row and what happened to its cases.
pub struct Judged {
    pub row: Row,
    pub outcomes: Vec<(Outcome, Vec<String>)>,
}

/// All rows of the table.
pub fn rows(short: bool) -> Vec<Row> {
    [materials::rows, elements::rows, meshes::rows, pins::rows, targets::rows]
        .into_iter()
        .flat_map(|rows| rows(short))
        .collect()
}

impl Extremes {
    /// The table, and the rows that do not pass.
    ///
    /// # Errors
    /// The study was cancelled, or the table's plot cannot be drawn.
    pub fn run(&self, session: &Session) -> Result<(Report, Option<String>), BenchError> {
        let judged = self.judge(session)?;
        let failing: Vec<&str> = judged.iter().filter(|j| !j.passes()).map(|j| j.row.name).collect();
        let failed = (!failing.is_empty()).then(|| format!("rows that do not pass: {}", failing.join("; ")));
        Ok((report(&judged, self.short), failed))
    }

    /// The rows asked for.
    fn wanted(&self) -> Vec<Row> {
        let holds = |row: &Row, text: &str| row.name.contains(text) || row.group.contains(text);
        rows(self.short).into_iter().filter(|row| self.only.as_ref().is_none_or(|text| holds(row, text))).collect()
    }

    /// Name and text of the problem file of every case that can be written.
    pub fn files(&self) -> Vec<(String, String)> {
        let plain = |text: &str| {
            let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|w| !w.is_empty());
            words.collect::<Vec<_>>().join("-").to_lowercase()
        };
        let file = |(number, row): (usize, Row)| {
            let name = plain(row.name);
            let cases = row.cases.into_iter().enumerate();
            let named = cases.filter_map(move |(k, case)| {
                let at = plain(&case.at);
                Some((format!("{number:02}-{name}-{k:02}-{at}.json"), case.problem.to_text().ok()?))
            });
            named.collect::<Vec<_>>()
        };
        self.wanted().into_iter().enumerate().flat_map(file).collect()
    }

    /// Runs every case of the rows asked for.
    ///
    /// # Errors
    /// The study was cancelled.
    pub fn judge(&self, session: &Session) -> Result<Vec<Judged>, BenchError> {
        let mut judged = Vec::new();
        for row in self.wanted() {
            let mut outcomes = Vec::new();
            for case in &row.cases {
                session.next(&format!("{}: {}", row.name, case.at))?;
                let outcome = measure::run(case, session.stop);
                session.check()?;
                let short = case.bar.judge(&outcome);
                outcomes.push((outcome, short));
            }
            judged.push(Judged { row, outcomes });
        }
        if judged.is_empty() {
            return Err(BenchError::Nothing(format!("no row is called `{}`", self.only.as_deref().unwrap_or(""))));
        }
        Ok(judged)
    }
}

impl Judged {
    pub fn passes(&self) -> bool {
        self.outcomes.iter().all(|(_, short)| short.is_empty())
    }
}

fn report(judged: &[Judged], short: bool) -> Report {
    let failing = judged.iter().filter(|j| !j.passes()).count();
    let cases: usize = judged.iter().map(|j| j.outcomes.len()).sum();
    let bar = row::BAR;
    let remarks = vec![
        format!("{} of {} rows pass, {cases} cases in all.", judged.len() - failing, judged.len()),
        format!(
            "A case passes with a residual of at most {:e} of the forces at work, det F > {}, at most {} iterations, and at least \
             16 - log10(condition) - {} digits; an expected refusal only with its cause. Digits lost are those of 16, of \
             positions, against closed forms and references of twice the digits; the condition is that of the Hessian.",
            bar.residual, bar.determinant, bar.iterations, bar.spare_digits
        ),
    ];
    let form = if short { "shortened" } else { "whole" };
    Report {
        title: format!("Extremes ({form}): what the solvers survive, and with how many digits"),
        tables: vec![summary(judged), details(judged)],
        remarks,
        plots: Vec::new(),
    }
}

/// Columns of both tables: what was done, and the state it led to.
const WORK: [&str; 5] = ["iterations", "factors", "projections", "det F", "residual"];

/// The worst of every row.
fn summary(judged: &[Judged]) -> Table {
    let mut table = Table::new(
        "extremes",
        "Rows, the worst of their cases",
        &[&["group", "row", "swept", "cases"][..], &WORK, &["lost digits", "condition", "pass"]].concat(),
    );
    for j in judged {
        let most = |of: fn(&Outcome) -> usize| j.outcomes.iter().map(|(o, _)| of(o)).max().unwrap_or(0);
        let solved = || j.outcomes.iter().map(|(o, _)| o).filter(|o| o.failure.is_none());
        let largest = |of: fn(&Outcome) -> Option<f64>| solved().filter_map(of).reduce(f64::max);
        table.push(vec![
            j.row.group.into(),
            j.row.name.into(),
            format!("{}: {}", j.row.swept, range(j)).into(),
            j.outcomes.len().into(),
            most(|o| o.iterations).into(),
            most(|o| o.factorizations).into(),
            most(|o| o.projections).into(),
            solved().map(|o| o.determinant).reduce(f64::min).into(),
            largest(|o| Some(o.residual)).into(),
            largest(Outcome::lost).into(),
            largest(|o| o.condition).into(),
            if j.passes() { "yes" } else { "NO" }.into(),
        ]);
    }
    table
}

/// The first and the last of what is swept.
fn range(judged: &Judged) -> String {
    let word = |text: &str| text.split(',').next().unwrap_or_default().to_owned();
    let ends = [judged.row.cases.first(), judged.row.cases.last()].map(|c| c.map_or(String::new(), |c| word(&c.at)));
    if ends[0].starts_with(|c: char| c.is_ascii_digit() || c == '-') && ends[1] != ends[0] {
        format!("{} to {}", ends[0], ends[1])
    } else {
        format!("{} cases", judged.outcomes.len())
    }
}

fn details(judged: &[Judged]) -> Table {
    let mut table = Table::new(
        "cases",
        "Cases",
        &[&["row", "at"][..], &WORK, &["error", "lost digits", "condition", "target error", "ms", "outcome"]].concat(),
    );
    for j in judged {
        for (case, (o, short)) in j.row.cases.iter().zip(&j.outcomes) {
            let verdict = match (short.is_empty(), &case.bar, &o.failure) {
                (true, Bar::Refused(_), Some(cause)) => format!("refused: {cause}"),
                (true, ..) => "ok".into(),
                (false, ..) => format!("FAILS: {}", short.join("; ")),
            };
            let known = o.failure.is_none();
            let figure = |v: f64| if known { Cell::Number(v) } else { Cell::Missing };
            table.push(vec![
                j.row.name.into(),
                case.at.clone().into(),
                o.iterations.into(),
                o.factorizations.into(),
                o.projections.into(),
                figure(o.determinant),
                figure(o.residual),
                o.error.into(),
                o.lost().into(),
                o.condition.into(),
                o.target_error.into(),
                o.milliseconds.into(),
                verdict.into(),
            ]);
        }
    }
    table
}
