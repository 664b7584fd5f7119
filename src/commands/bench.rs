//! `bench`: whole studies of the solvers, as tables, CSV and plots.

use super::error::CommandError;
use super::interrupt::Keeping;
use super::output::{check_folder, say_json, say_lines, write_folder};
use super::progress;
use super::reading::Reading;
use super::render::look_names;
use super::solve::QualityChoice;
use crate::bench::drags::{Path as DragPath, SWEEP_FRAMES};
use crate::bench::{
    BenchError, Report, Session, cold, drag, extremes, import, linear, misses, networks, properties, resolution, scene,
    shapes, trade, wander, winding,
};
use crate::defaults;
use clap::{Args, Subcommand, ValueEnum};
use std::io::Write;
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

/// Format of the manifest in a folder of results, and of what is printed for other programs.
const FORMAT: &str = "plushwright-bench/1";

/// Options of every study.
#[derive(Debug, Args)]
struct Common {
    /// Bundled shapes: pig, robot, puppy, squid, e, s, or `all`; also limb, spiral, hand or star with a number, such as hand-1
    #[arg(long, value_delimiter = ',')]
    shapes: Vec<String>,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Folder for CSV tables and SVG plots; an earlier result there is replaced, any other folder refused
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Study {
    /// Warm drags: time of a frame by phase, target error, distance from equilibrium and from the optimum, Algorithm 1
    Drag {
        /// Numbers of muscle fibres
        #[arg(long, value_delimiter = ',', default_values_t = [414, 1055, 5000], alias = "fibres")]
        fibers: Vec<usize>,
        /// Numbers of targets
        #[arg(long, value_delimiter = ',', default_values_t = [4])]
        targets: Vec<usize>,
        /// Frames of each drag; 120 are a whole sweep
        #[arg(long, default_value_t = SWEEP_FRAMES / 2)]
        frames: usize,
        /// Work a frame may take
        #[arg(long, value_enum, default_value_t = QualityChoice::Balanced)]
        quality: QualityChoice,
        /// Only targets that can be reached, or only such that cannot
        #[arg(long, value_enum)]
        path: Option<Reach>,
        /// Compare with Algorithm 1 up to this many fibres
        #[arg(long, default_value_t = 500, value_name = "FIBERS")]
        baseline: usize,
        #[command(flatten)]
        common: Common,
    },
    /// Cold drags of 40 % of the body length: what is missing after so many factorisations
    Cold {
        /// Number of muscle fibres
        #[arg(long, default_value_t = 414, alias = "fibres")]
        fibers: usize,
        /// Numbers of targets
        #[arg(long, value_delimiter = ',', default_values_t = [1, 2, 3, 4])]
        targets: Vec<usize>,
        /// Drags of each shape and number of targets
        #[arg(long, default_value_t = 1)]
        draws: usize,
        /// Seeded scenes instead, 1 to 6 targets on bundled shapes and on such that are made from the seed: how often the best
        /// pose is missed
        #[arg(long, value_name = "N", conflicts_with_all = ["targets", "draws", "shapes"])]
        scenes: Option<usize>,
        /// Number of the first of these scenes
        #[arg(long, default_value_t = 0, value_name = "N")]
        first: usize,
        #[command(flatten)]
        common: Common,
    },
    /// Wild drags that come back: may every frame be shown, and does the pose not depend on the way there
    Wander {
        /// Number of muscle fibres
        #[arg(long, default_value_t = 414, alias = "fibres")]
        fibers: usize,
        /// Drags of each shape
        #[arg(long, default_value_t = 10)]
        drags: usize,
        #[command(flatten)]
        common: Common,
    },
    /// Rigs of one to three winches: is the pose shown the best that winding from rest reaches, and at what cost
    Winding {
        /// Rigs of each number of winches
        #[arg(long, default_value_t = 25)]
        rigs: usize,
        #[command(flatten)]
        common: Common,
    },
    /// Error against time over mesh resolution, Newton tolerance and quality; locking of the triangles
    Trade {
        /// Numbers of muscle fibres
        #[arg(long, value_delimiter = ',', default_values_t = [177, 414, 1055, 5000], alias = "fibres")]
        fibers: Vec<usize>,
        /// Fibres of the reference mesh
        #[arg(long, default_value_t = 10_000)]
        reference: usize,
        #[command(flatten)]
        common: Common,
    },
    /// The same pose at several resolutions: how far poses, activations and networks agree
    Resolution {
        /// Numbers of muscle fibres, ascending; the last is the reference
        #[arg(long, value_delimiter = ',', default_values_t = [177, 414, 1055, 5000], alias = "fibres")]
        fibers: Vec<usize>,
        /// Fibres of the coarse set on the finest mesh
        #[arg(long, default_value_t = 414)]
        coarse: usize,
        /// Discover networks up to this many fibres
        #[arg(long, default_value_t = 1100, value_name = "FIBERS")]
        networks: usize,
        #[command(flatten)]
        common: Common,
    },
    /// The window off screen, on any graphics adapter, while a hand drags: the interface thread's own work, the adapter's, frames a second
    Window {
        /// Numbers of muscle fibres
        #[arg(long, value_delimiter = ',', default_values_t = [414, 10_000], alias = "fibres")]
        fibers: Vec<usize>,
        /// Frames of each drag
        #[arg(long, default_value_t = 180)]
        frames: usize,
        /// Time that a slow solver takes, ms
        #[arg(long, default_value_t = 200, value_name = "MS")]
        late: u64,
        /// How the body is shown: a look of `render`
        #[arg(long, default_value = "plush", value_parser = look_names())]
        look: String,
        #[command(flatten)]
        common: Common,
    },
    /// What each optional part of a scene costs per frame
    Scene {
        /// Frames of the drag
        #[arg(long, default_value_t = 60)]
        frames: usize,
        #[command(flatten)]
        common: Common,
    },
    /// Networks of the joint search, of Algorithm 2 and of the bundled designs: errors wound from rest, and whether they can be sewn
    Networks {
        /// Rounds of the joint search
        #[arg(long, default_value_t = defaults::RIG_ROUNDS)]
        rounds: usize,
        /// Muscle fibres of the toys
        #[arg(long, default_value_t = defaults::FIBERS, alias = "fibres")]
        fibers: usize,
        /// Winches of the toys
        #[arg(long, default_value_t = 3)]
        winches: usize,
        /// Tendons of each of their winches
        #[arg(long, default_value_t = 2)]
        tendons: usize,
        /// Seek networks again so many times for targets that moved a little
        #[arg(long, default_value_t = 0, value_name = "TIMES")]
        moves: usize,
        /// The error against the number of winches, up to so many
        #[arg(long, default_value_t = 0, value_name = "WINCHES")]
        curve: usize,
        #[command(flatten)]
        common: Common,
    },
    /// Outlines that nobody here drew: what becomes of every file of a folder, mesh quality, times
    Import {
        /// Folder of SVG, PNG, JPEG, DXF, OBJ and drawing files, searched with all its folders
        dir: PathBuf,
        /// Numbers of muscle fibres; 0 for import alone
        #[arg(long, value_delimiter = ',', default_values_t = [414, 2000, 10_000], alias = "fibres")]
        fibers: Vec<usize>,
        /// Try so many files, evenly spread [default: all]
        #[arg(long, value_name = "FILES")]
        limit: Option<usize>,
        #[command(flatten)]
        reading: Reading,
        #[command(flatten)]
        common: Common,
    },
    /// Extreme scenes, every one swept over its range: what happened, digits lost, and whether it passes
    Extremes {
        /// Only the ends and the middle of every sweep, and no large body
        #[arg(long)]
        short: bool,
        /// Only rows whose name or group holds this text
        #[arg(long, value_name = "TEXT")]
        only: Option<String>,
        /// Write the problem file of every case into this folder, and solve nothing
        #[arg(long, value_name = "DIR")]
        scenes: Option<PathBuf>,
        #[command(flatten)]
        common: Common,
    },
    /// Random problems and random edits: what must hold for all of them
    Properties {
        /// Number of problems; there is one sequence of edits for every hundred
        #[arg(long, default_value_t = 10_000)]
        problems: usize,
        /// Number of the first problem, to look at one again
        #[arg(long, default_value_t = 0, value_name = "NUMBER")]
        first: usize,
        /// Print the problem file of the first one, and do nothing else
        #[arg(long)]
        show: bool,
        #[command(flatten)]
        common: Common,
    },
    /// The same Hessians through every variant of the sparse factorisation
    Linear {
        /// Numbers of muscle fibres
        #[arg(long, value_delimiter = ',', default_values_t = [414, 1055, 5000, 10_000], alias = "fibres")]
        fibers: Vec<usize>,
        #[command(flatten)]
        common: Common,
    },
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Reach {
    Reachable,
    Unreachable,
}

impl Study {
    fn common(&self) -> &Common {
        match self {
            Self::Drag { common, .. }
            | Self::Cold { common, .. }
            | Self::Wander { common, .. }
            | Self::Winding { common, .. }
            | Self::Trade { common, .. }
            | Self::Resolution { common, .. }
            | Self::Scene { common, .. }
            | Self::Window { common, .. }
            | Self::Networks { common, .. }
            | Self::Import { common, .. }
            | Self::Extremes { common, .. }
            | Self::Properties { common, .. }
            | Self::Linear { common, .. } => common,
        }
    }

    /// The report, and what in it fails a bar that was set before.
    fn run(&self, session: &Session) -> Result<(Report, Option<String>), BenchError> {
        match self {
            Self::Extremes { short, only, .. } => extremes::Extremes { short: *short, only: only.clone() }.run(session),
            Self::Properties { problems, first, .. } => {
                properties::Properties { problems: *problems, first: *first }.run(session)
            }
            _ => self.measure(session).map(|report| (report, None)),
        }
    }

    fn measure(&self, session: &Session) -> Result<Report, BenchError> {
        match self {
            Self::Extremes { .. } | Self::Properties { .. } => self.run(session).map(|(report, _)| report),
            Self::Drag { fibers, targets, frames, quality, path, baseline, common } => drag::Drag {
                shapes: common.shapes(&["pig"]),
                fibers: fibers.clone(),
                targets: targets.clone(),
                paths: match path {
                    None => vec![DragPath::Reachable, DragPath::Unreachable],
                    Some(Reach::Reachable) => vec![DragPath::Reachable],
                    Some(Reach::Unreachable) => vec![DragPath::Unreachable],
                },
                frames: *frames,
                quality: (*quality).into(),
                baseline_up_to: *baseline,
            }
            .run(session),
            Self::Cold { fibers, scenes: Some(scenes), first, .. } => {
                misses::Misses { fibers: *fibers, first: *first, scenes: *scenes }.run(session)
            }
            Self::Cold { fibers, targets, draws, common, .. } => {
                cold::Cold { shapes: common.shapes(&["all"]), fibers: *fibers, targets: targets.clone(), draws: *draws }
                    .run(session)
            }
            Self::Wander { fibers, drags, common } => {
                wander::Wander { shapes: common.shapes(&["all"]), fibers: *fibers, drags: *drags }.run(session)
            }
            Self::Winding { rigs, common } => winding::Winding {
                shapes: common.shapes(&["all"]),
                rigs: *rigs,
                scanned: winding::SCANNED,
                runs: winding::RUNS,
            }
            .run(session),
            Self::Trade { fibers, reference, common } => {
                let shapes = common.shapes(&["pig"]);
                trade::Trade { shapes, fibers: fibers.clone(), reference: *reference }.run(session)
            }
            Self::Resolution { fibers, coarse, networks, common } => resolution::Resolution {
                shapes: common.shapes(&["pig"]),
                fibers: fibers.clone(),
                coarse: *coarse,
                networks_up_to: *networks,
            }
            .run(session),
            Self::Scene { frames, common } => {
                scene::Scene { shapes: common.shapes(&["pig"]), frames: *frames }.run(session)
            }
            Self::Window { .. } => Err(BenchError::Nothing("this build has no window (feature `studio`)".into())),
            Self::Networks { rounds, fibers, winches, tendons, moves, curve, common } => {
                let shapes = match common.shapes.as_slice() {
                    [] => networks::names(),
                    [all] if all == "all" => networks::names(),
                    named => named.to_vec(),
                };
                let (rounds, fibers, winches, tendons) = (*rounds, *fibers, *winches, *tendons);
                networks::Networks { shapes, rounds, fibers, winches, tendons, moves: *moves, curve: *curve }
                    .run(session)
            }
            Self::Import { dir, fibers, limit, reading, .. } => {
                let import = reading.import();
                let fibers = fibers.iter().copied().filter(|count| *count > 0).collect();
                import::Imports { folder: dir.clone(), import, fibers, limit: limit.unwrap_or(0) }.run(session)
            }
            Self::Linear { fibers, common } => {
                linear::Linear { shapes: common.shapes(&["pig"]), fibers: fibers.clone() }.run(session)
            }
        }
    }
}

impl Common {
    /// The shapes asked for, or these.
    fn shapes(&self, default: &[&str]) -> Vec<String> {
        let named = match self.shapes.as_slice() {
            [] => default.iter().map(|&name| name.to_owned()).collect(),
            names => names.to_vec(),
        };
        if named == ["all"] { shapes::names() } else { named }
    }
}

/// A study that the window makes of itself, where the program has one.
pub type WindowStudy<'a> = &'a dyn Fn(&WindowOptions, &Session) -> Result<Report, BenchError>;

/// What is to be measured of the window.
#[derive(Clone, Debug)]
pub struct WindowOptions {
    pub fibers: Vec<usize>,
    pub frames: usize,
    pub late_ms: u64,
    pub look: String,
}

impl Bench {
    pub fn run(
        &self,
        out: &mut dyn Write,
        cancel: &AtomicBool,
        window: Option<WindowStudy<'_>>,
    ) -> Result<(), CommandError> {
        let common = self.study.common();
        if let Study::Properties { first, show: true, .. } = &self.study {
            let text = properties::problem_text(common.seed, *first);
            return say_lines(out, &text.ok_or_else(|| CommandError::Failed("the problem cannot be written".into()))?);
        }
        if let Study::Extremes { short, only, scenes: Some(folder), .. } = &self.study {
            let files = extremes::Extremes { short: *short, only: only.clone() }.files();
            let files: Vec<_> = files.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
            return write_folder(folder, FORMAT, &files, cancel);
        }
        if let Some(folder) = &common.out {
            check_folder(folder, FORMAT)?;
        }
        let stop = || cancel.load(Ordering::SeqCst);
        let (now, found) = (|what: &str| progress::now(what), |what: &str| log::info!("{what}"));
        let session = Session { seed: common.seed, stop: &stop, cancel, progress: &now, found: &found };
        // It ends with what it has by then.
        let keeping = matches!(self.study, Study::Networks { .. }).then(Keeping::begin);
        let report = match (&self.study, window) {
            (Study::Window { fibers, frames, late, look, .. }, Some(window)) => {
                let (fibers, look) = (fibers.clone(), look.clone());
                window(&WindowOptions { fibers, frames: *frames, late_ms: *late, look }, &session)
                    .map(|report| (report, None))
            }
            (study, _) => study.run(&session),
        };
        let (report, failed) = report.map_err(|error| failure(error, cancel))?;
        let interrupted = stop();
        if let Some(folder) = &common.out {
            let go = AtomicBool::new(false);
            write(&report, folder, if keeping.is_some() { &go } else { cancel })?;
        }
        if common.json {
            say_json(out, FORMAT, &report.json())?
        } else {
            say_lines(out, &report.text())?
        }
        if interrupted && keeping.is_some() {
            return Err(CommandError::Interrupted("the report has the designs that were finished".into()));
        }
        failed.map_or(Ok(()), |what| Err(CommandError::Failed(what)))
    }
}

/// Tables and plots in a folder that appears whole or not at all.
fn write(report: &Report, path: &Path, cancel: &AtomicBool) -> Result<(), CommandError> {
    let mut files = Vec::new();
    for table in &report.tables {
        files.push((format!("{}.csv", table.name), table.csv().into_bytes()));
    }
    for plot in &report.plots {
        files.push((format!("{}.svg", plot.name), plot.svg().map_err(|e| failure(e, cancel))?.into_bytes()));
    }
    files.push(("report.txt".into(), (report.text() + "\n").into_bytes()));
    write_folder(path, FORMAT, &files, cancel)
}

fn failure(error: BenchError, cancel: &AtomicBool) -> CommandError {
    match error {
        BenchError::Cancelled => CommandError::Cancelled,
        _ if cancel.load(Ordering::SeqCst) => CommandError::Cancelled,
        BenchError::NoSuchShape { .. } | BenchError::Mesh { .. } => CommandError::Usage(error.to_string()),
        other => CommandError::Failed(other.to_string()),
    }
}
