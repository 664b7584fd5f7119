//! `bench`: whole studies of the solvers, as tables, CSV and plots.

use super::error::{CommandError, check_cancel};
use super::output::{Staged, say, say_json};
use crate::bench::{BenchError, Report, Session, linear, shapes};
use clap::{Args, Subcommand};
use std::cell::Cell;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Measure the solvers: whole studies that anybody can repeat
///
/// Random numbers follow from the printed seed. Every study compares within one run, on one thread; times depend on the
/// machine and on what else it does.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright bench linear --fibers 414,10000 --shapes pig --out linear")]
pub struct Bench {
    #[command(subcommand)]
    study: Study,
}

/// Options of every study.
#[derive(Debug, Args)]
struct Common {
    /// Bundled shapes: pig, robot, puppy, squid, e, s, or `all`
    #[arg(long, value_delimiter = ',')]
    shapes: Vec<String>,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Folder for CSV tables and SVG plots; replaced where it exists
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Study {
    /// The same Hessians through every variant of the sparse factorisation
    Linear {
        /// Numbers of muscle fibres
        #[arg(long, value_delimiter = ',', default_values_t = [414, 1055, 5000, 10_000])]
        fibers: Vec<usize>,
        #[command(flatten)]
        common: Common,
    },
}

impl Study {
    fn common(&self) -> &Common {
        match self {
            Self::Linear { common, .. } => common,
        }
    }

    fn run(&self, session: &Session) -> Result<Report, BenchError> {
        match self {
            Self::Linear { fibers, common } => {
                linear::Linear { shapes: common.shapes(&["pig"]), fibers: fibers.clone() }.run(session)
            }
        }
    }
}

impl Common {
    /// The shapes asked for, or these.
    fn shapes(&self, default: &[&str]) -> Vec<String> {
        match self.shapes.as_slice() {
            [] => default.iter().map(|&name| name.to_owned()).collect(),
            [all] if all == "all" => shapes::names(),
            names => names.to_vec(),
        }
    }
}

impl Bench {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let common = self.study.common();
        let progress = Progress::default();
        let stop = || cancel.load(Ordering::SeqCst);
        let session = Session { seed: common.seed, stop: &stop, progress: &|what| progress.show(what) };
        let report = self.study.run(&session);
        progress.clear();
        let report = report.map_err(|error| failure(error, cancel))?;
        if let Some(folder) = &common.out {
            write(&report, folder, cancel)?;
        }
        if common.json { say_json(out, &report.json()) } else { say(out, &report.text()) }
    }
}

/// Tables and plots in a folder that appears whole or not at all.
fn write(report: &Report, path: &Path, cancel: &AtomicBool) -> Result<(), CommandError> {
    check_cancel(cancel)?;
    let staged = Staged::beside(path)?;
    let put = |name: String, text: String| {
        std::fs::write(staged.folder().join(name), text).map_err(|e| CommandError::write(path, e))
    };
    for table in &report.tables {
        put(format!("{}.csv", table.name), table.csv())?;
    }
    for plot in &report.plots {
        put(format!("{}.svg", plot.name), plot.svg().map_err(|e| failure(e, cancel))?)?;
    }
    put("report.txt".into(), report.text() + "\n")?;
    staged.commit(cancel)
}

fn failure(error: BenchError, cancel: &AtomicBool) -> CommandError {
    match error {
        BenchError::Cancelled => CommandError::Cancelled,
        _ if cancel.load(Ordering::SeqCst) => CommandError::Cancelled,
        BenchError::NoSuchShape(_) | BenchError::Mesh { .. } => CommandError::Usage(error.to_string()),
        other => CommandError::Failed(other.to_string()),
    }
}

/// One line on a terminal's standard error that says what is being worked on.
#[derive(Default)]
struct Progress {
    shown: Cell<usize>,
}

impl Progress {
    fn show(&self, what: &str) {
        if std::io::stderr().is_terminal() {
            eprint!("\r{what:width$}", width = self.shown.get());
            self.shown.set(what.chars().count());
        }
    }

    fn clear(&self) {
        let shown = self.shown.take();
        if shown > 0 {
            eprint!("\r{:shown$}\r", "");
        }
    }
}
