//! `solve`: one numerical question, as JSON.

use super::error::{CommandError, check_cancel};
use super::meant;
use super::output::{Kind, Output, Replace, json, read_text, say_lines};
use crate::files::shown;
use crate::problem::{self, Document, Options, Problem, ProblemError, Quality};
use crate::soft_ik;
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// Longest time that can be asked for: a day, ms.
const LONGEST_MS: u64 = 86_400_000;
/// How often a running answer looks for an interrupt.
const CANCEL_INTERVAL: Duration = Duration::from_millis(20);

/// Answer a problem file (JSON, SI units: m, N, J)
///
/// The format is described in examples/problem-format.md. An answer that did not converge is written all the same, with
/// the reason in it, and the exit code is 3.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright solve problem.json -o answer.json --quality accurate")]
pub struct Solve {
    /// Problem file (`plushwright-problem/1`)
    pub problem: PathBuf,
    /// Answer file to write [default: standard output]
    #[arg(short, long, value_name = "OUT.json")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub replace: Replace,
    /// How contractions are found; `gradient` is Algorithm 1 of the paper
    #[arg(long, default_value = "default", value_parser = PossibleValuesParser::new(soft_ik::METHODS))]
    pub method: String,
    /// How much work each frame of a drag may take; no effect on other questions
    #[arg(long, value_enum, default_value_t = QualityChoice::Balanced)]
    pub quality: QualityChoice,
    /// Time for the whole answer in ms; the factorisation under way is finished, then the best state so far is written
    ///
    /// An answer that the budget cut short has `"converged": false` and the exit code 3. How far it came depends on the
    /// machine; without reaching the budget the same file gives the same answer.
    #[arg(long, value_name = "MS", default_value_t = 10_000, value_parser = clap::value_parser!(u64).range(1..=LONGEST_MS))]
    pub budget_ms: u64,
    /// Answer statics and Soft IK too where the file has a drag
    #[arg(long)]
    pub all: bool,
    /// Say on standard error how long reading, solving and writing took
    #[arg(long)]
    pub times: bool,
}

/// A quality by its name on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum QualityChoice {
    /// A part of the work of `balanced`: least delay, trails fast moves
    Draft,
    /// A bounded amount of work: follows the hand
    Balanced,
    /// Until nothing moves any more: for figures that are compared
    Accurate,
}

impl From<QualityChoice> for Quality {
    fn from(choice: QualityChoice) -> Self {
        match choice {
            QualityChoice::Draft => Self::Draft,
            QualityChoice::Balanced => Self::Balanced,
            QualityChoice::Accurate => Self::Accurate,
        }
    }
}

/// Times one thing after another, ms.
struct Stopwatch {
    last: Instant,
}

impl Stopwatch {
    fn start() -> Self {
        Self { last: Instant::now() }
    }

    fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let taken = now.duration_since(self.last);
        self.last = now;
        1e3 * taken.as_secs_f64()
    }
}

impl Solve {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let inputs = || [self.problem.clone()];
        let output =
            self.output.as_deref().map(|path| Output::new(path, Kind::Answer, self.replace, inputs())).transpose()?;
        let mut clock = Stopwatch::start();
        let text = read_text(&self.problem)?;
        let (problem, unknown) = problem::read(&text).map_err(|error| unanswered(&self.problem, error))?;
        if !unknown.is_empty() {
            log::info!("{}: ignored: {}", shown(&self.problem), unknown.join(", "));
        }
        let reading = clock.lap();
        let answered = self.answer(problem, cancel)?;
        let solving = clock.lap();
        let mut text = json(&answered)?;
        match output {
            Some(output) => {
                text.push('\n');
                output.write(text.as_bytes(), cancel)?;
            }
            None => say_lines(out, &text)?,
        }
        if self.times {
            let writing = clock.lap();
            eprintln!("plushwright: reading {reading:.2} ms, solving {solving:.2} ms, writing {writing:.2} ms");
        }
        if answered.converged {
            return Ok(());
        }
        Err(CommandError::NotConverged(answered.error.unwrap_or_else(|| "no reason given".into())))
    }

    /// The answer, computed on a thread of its own that an interrupt leaves behind.
    fn answer(&self, problem: Problem, cancel: &AtomicBool) -> Result<Document, CommandError> {
        let options = Options {
            method: self.method.clone(),
            quality: self.quality.into(),
            all: self.all,
            budget: Duration::from_millis(self.budget_ms),
        };
        let (send, receive) = channel();
        let worker = move || {
            // Nobody is listening any more after an interrupt.
            let _ = send.send(problem::answer(&problem, &options));
        };
        std::thread::Builder::new()
            .spawn(worker)
            .map_err(|e| CommandError::Failed(format!("cannot start a thread: {e}")))?;
        loop {
            match receive.recv_timeout(CANCEL_INTERVAL) {
                Ok(answered) => return answered.map_err(|error| self.refused(&error)),
                Err(RecvTimeoutError::Timeout) => check_cancel(cancel)?,
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(CommandError::Failed("the solver broke down; please report this problem file".into()));
                }
            }
        }
    }

    /// Why the problem has no answer, with the option that may be at fault.
    fn refused(&self, error: &ProblemError) -> CommandError {
        match error {
            ProblemError::Method(what) => CommandError::input(&self.problem, format!("--method: {what}")),
            ProblemError::Json(_) | ProblemError::Content { .. } => CommandError::input(&self.problem, error),
        }
    }
}

/// Why a file asks nothing, or the command that is meant where it is a design.
pub fn unanswered(path: &Path, error: impl ToString) -> CommandError {
    CommandError::input(path, meant::instead_of_question(path).unwrap_or_else(|| error.to_string()))
}
