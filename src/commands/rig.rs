//! `rig`: the design loop over all poses, without a window.

use super::error::CommandError;
use super::explore::Explore;
use super::interrupt::Keeping;
use super::output::{say, say_json, say_lines};
use super::search::{Algorithm2, Rules};
use super::{document, progress, words};
use crate::defaults;
use crate::design::Design;
use crate::files::shown;
use crate::operations::explore;
use crate::operations::rig::{self, Error, Note, Options, TendonChoice, Trims};
use crate::operations::{Context, Progress};
use crate::rigging;
use crate::rigging::RigError;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Find winches and tendons for all poses
///
/// All winches are looked for together, within the rules of sewing, and what is told is what `check` says of the design. Where
/// the design has no keyframes, its poses are laid on the timeline one second apart, with rest at both ends.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright rig pig.plush --max-winches 1 --tendons 2")]
pub struct Rig {
    /// Design file to read
    pub design: PathBuf,
    #[command(flatten)]
    pub target: document::Target,
    /// Most winches that are added
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=64))]
    pub max_winches: u16,
    /// Tendons of each winch: one number for all, a list winch by winch, or a range to choose from
    #[arg(long, value_name = "N[,N...]|A..B", default_value = "1..4")]
    pub tendons: TendonChoice,
    /// How networks are looked for: all together, or winch by winch those of Algorithm 2 as they are
    #[arg(long, value_enum, default_value_t)]
    pub method: Method,
    /// Whether networks keep the design's rules of sewing, or none (for studies)
    #[arg(long, value_enum, default_value_t)]
    pub rules: Rules,
    /// Let each cable have a spool radius of its own, as a part of its winch's
    #[arg(long)]
    pub ratios: bool,
    /// Let cables be slack at assembly, so that they pull later than others of their winch
    #[arg(long)]
    pub slack: bool,
    /// Forget the networks that are there, and solve keyframes of poses anew
    #[arg(long)]
    pub fresh: bool,
    /// Rounds of the search; it ends sooner where nothing is gained
    #[arg(long, value_name = "N", default_value_t = defaults::RIG_ROUNDS as u16, value_parser = clap::value_parser!(u16).range(0..=10_000))]
    pub rounds: u16,
    /// Seed of the search: another one may find other networks
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Starts that are raced in the first half of the rounds, before the best go on together: one for every five rounds of it, or at most so many
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=2_000))]
    pub starts: Option<u16>,
    #[command(flatten)]
    pub explore: Explore,
    #[command(flatten)]
    pub parameters: Algorithm2,
    /// Print JSON when the search is over
    #[arg(long)]
    pub json: bool,
}

/// How networks are looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Method {
    #[default]
    Joint,
    Algorithm2,
}

impl From<Method> for rig::Method {
    fn from(method: Method) -> Self {
        match method {
            Method::Joint => Self::Joint,
            Method::Algorithm2 => Self::Algorithm2,
        }
    }
}

/// Format of what `rig --json` prints.
const FORMAT: &str = "plushwright-rig/1";

/// What `rig --json` prints.
#[derive(Serialize)]
struct Summary {
    design: String,
    winches: usize,
    tendons: usize,
    /// Whether the search was interrupted, and this is the best that it had.
    interrupted: bool,
    /// What `check` says of every pose: rms distance of the targets in body lengths. None where it was interrupted before that.
    poses: Vec<PoseError>,
    /// About keyframes.
    notes: Vec<String>,
    /// With `--explore`: the best rig with every number of winches and tendons.
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<Vec<explore::Point>>,
}

#[derive(Serialize)]
struct PoseError {
    name: String,
    error_realizable: f64,
}

/// What was told on the way.
#[derive(Default)]
struct Told {
    /// Rounds that were begun, of how many.
    rounds: Option<[usize; 2]>,
    /// What a check says of the poses.
    errors: Vec<(String, f64)>,
    /// The gain that was printed last.
    gain: Option<(String, usize)>,
}

impl Told {
    /// Takes a step; says whether it is news. A round without a gain is none.
    fn hear(&mut self, step: &Progress) -> bool {
        let gain = match step {
            Progress::Rig(rigging::Progress::Round { round, rounds, worst, holes }) => {
                self.rounds = Some([round + 1, *rounds]);
                let worst = format!("{:.1}", 100.0 * worst);
                progress::at(
                    *round,
                    *rounds,
                    &format!("worst pose {worst} % of its error at rest, {}", words::count(*holes, "hole", "holes")),
                );
                Some((worst, *holes))
            }
            Progress::Rig(rigging::Progress::Found { errors, .. }) => {
                self.errors.clone_from(errors);
                None
            }
            Progress::Rig(rigging::Progress::Candidates { .. } | rigging::Progress::Accepted { .. })
            | Progress::Proposals(_)
            | Progress::Picture { .. }
            | Progress::Keyed { .. }
            | Progress::Part { .. } => None,
        };
        let news = gain.is_none() || gain != self.gain;
        self.gain = gain;
        news
    }
}

impl Rig {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        self.check_parameters()?;
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        // From here on an interrupt finds something to keep.
        let _keeping = Keeping::begin();
        let options = self.options();
        if self.explore.explore {
            return self.explore(design, edit, &Options { keep: false, ..options }, out, cancel);
        }
        let before = design.clone();
        let (mut printed, mut told) = (Ok(()), Told::default());
        let mut progress = |step: &Progress| {
            if told.hear(step) && printed.is_ok() && !self.json {
                printed = say_lines(out, &words::progress(step));
            }
        };
        let mut context = Context::telling(cancel, &mut progress);
        let rigged = rig::run(&mut design, &options, &mut context).map_err(|error| self.failed(error, cancel))?;
        let path = if rigged.interrupted {
            edit.save_interrupted(&design, self.fresh)?
        } else {
            edit.save_found(&design)?;
            self.target.path(&self.design).to_owned()
        };
        // What cannot be told is found all the same.
        printed?;
        self.tell(out, &design, &path, &told.errors, &rigged, None)?;
        // With `fresh` they were worked out on the way.
        if let Some(note) = words::outdated(&before, &design, &path).filter(|_| !self.fresh && !self.json) {
            say(out, &format!("note: {note}"))?;
        }
        balanced(&rigged.notes)?;
        if rigged.interrupted { Err(interrupted(&path, &told, false)) } else { Ok(()) }
    }

    /// Refuses what belongs to another method, and numbers that no winch gets.
    fn check_parameters(&self) -> Result<(), CommandError> {
        if let Some(name) = self.parameters.given().filter(|_| self.method == Method::Joint) {
            return Err(CommandError::Usage(format!("--{name} is a parameter of --method algorithm2")));
        }
        if (self.ratios || self.slack) && self.method == Method::Algorithm2 {
            let name = if self.ratios { "ratios" } else { "slack" };
            return Err(CommandError::Usage(format!(
                "--{name} is for --method joint: Algorithm 2 knows no such thing"
            )));
        }
        let most = usize::from(self.max_winches);
        match &self.tendons {
            TendonChoice::PerWinch(list) if list.len() > most => Err(CommandError::Usage(format!(
                "--tendons {} is for {} winches, and there are at most {most}; give 1 to {most} numbers, or another --max-winches",
                self.tendons,
                list.len()
            ))),
            _ => Ok(()),
        }
    }

    fn options(&self) -> Options {
        Options {
            method: self.method.into(),
            rules: self.rules == Rules::Sewing,
            trims: Trims { ratios: self.ratios, slack: self.slack },
            fresh: self.fresh,
            rounds: usize::from(self.rounds),
            seed: self.seed,
            starts: self.starts.map(usize::from),
            keep: true,
            max_winches: usize::from(self.max_winches),
            tendons: self.tendons.clone(),
            seed_num: self.parameters.seed_num,
            join_depth: self.parameters.join_depth,
            join_len: self.parameters.join_len,
            phi: self.parameters.phi,
        }
    }

    fn tell(
        &self,
        out: &mut dyn Write,
        design: &Design,
        path: &Path,
        errors: &[(String, f64)],
        &rig::Rigged { interrupted, ref notes, .. }: &rig::Rigged,
        points: Option<Vec<explore::Point>>,
    ) -> Result<(), CommandError> {
        let notes: Vec<String> = notes.iter().filter_map(|note| in_words(note, path)).collect();
        let tendons: usize = design.networks.iter().map(|n| n.tendons.len()).sum();
        let (winches, path) = (design.networks.len(), shown(path));
        if self.json {
            let pose = |(name, error): &(String, f64)| PoseError { name: name.clone(), error_realizable: *error };
            let poses = errors.iter().map(pose).collect();
            let summary = Summary { design: path, winches, tendons, interrupted, poses, notes, points };
            return say_json(out, FORMAT, &summary);
        }
        let ended = if interrupted { ", the best so far" } else { "" };
        say(out, &format!("{path}: {}{ended}", words::built(winches, tendons)))?;
        notes.iter().try_for_each(|note| say(out, &format!("note: {note}")))
    }
}

impl Rig {
    /// All numbers of winches and tendons; what was found is told though it be interrupted.
    fn explore(
        &self,
        mut design: Design,
        edit: document::Edit,
        options: &Options,
        out: &mut dyn Write,
        cancel: &AtomicBool,
    ) -> Result<(), CommandError> {
        let files = self.explore.files(&self.design, self.target.force)?;
        let (mut points, mut printed) = (Vec::new(), Ok(()));
        let mut hear = |list: &[Arc<explore::Point>]| {
            points = list.to_vec();
            let all = options.max_winches * most_tendons(&options.tendons);
            progress::at(points.len(), all.max(points.len()), "rigs compared");
            if let (Some(last), Ok(()), false) = (list.last(), &printed, self.json) {
                printed = say(out, &words::explored(last));
            }
        };
        let found = explore::run(&design, options, &mut hear, &mut Context::new(cancel));
        let is_interrupted = matches!(found, Err(Error::Cancelled(_))) && !points.is_empty();
        let points = if is_interrupted { points } else { found.map_err(|error| self.failed(error, cancel))? };
        let best = best(&points).ok_or_else(|| self.failed(RigError::NothingFound.into(), cancel))?;
        put(best, &mut design)?;
        let path = match is_interrupted {
            true => edit.save_interrupted(&design, self.fresh)?,
            false => {
                edit.save_found(&design)?;
                self.target.path(&self.design).to_owned()
            }
        };
        // What cannot be told or drawn is found all the same.
        printed?;
        if !self.json {
            say_lines(out, &super::explore::table(&points).text())?;
        }
        // By a run that ends by itself.
        if !is_interrupted {
            files.write(&points, cancel)?;
        }
        let errors: Vec<(String, f64)> = best.poses.iter().map(|pose| (pose.name.clone(), pose.exact)).collect();
        let mut rigged = best.rigged.clone();
        rigged.interrupted = is_interrupted;
        let points = points.iter().map(|point| explore::Point::clone(point)).collect();
        self.tell(out, &design, &path, &errors, &rigged, Some(points))?;
        balanced(&rigged.notes)?;
        if is_interrupted { Err(interrupted(&path, &Told::default(), true)) } else { Ok(()) }
    }
}

/// Of equal ones the first: fewer winches and tendons.
fn best(points: &[Arc<explore::Point>]) -> Option<&Arc<explore::Point>> {
    points.iter().min_by(|a, b| a.worst.total_cmp(&b.worst))
}

fn put(point: &explore::Point, design: &mut Design) -> Result<(), CommandError> {
    point.rigged.clone().apply(design).map(drop).map_err(|error| CommandError::Failed(error.to_string()))
}

impl Rig {
    /// Why there is no rig; what was interrupted before it found one leaves all as it was.
    fn failed(&self, error: Error, cancel: &AtomicBool) -> CommandError {
        let is_interrupted = cancel.load(Ordering::SeqCst);
        match error {
            Error::Cancelled(_) | Error::Rig(RigError::NothingFound) if is_interrupted => {
                CommandError::Interrupted(format!(
                    "nothing was found yet, {} is as it was; the same command begins anew",
                    shown(self.target.path(&self.design))
                ))
            }
            error => failed(&self.design, error),
        }
    }
}

/// A note as it is told with the rig, and what to do; a pose that does not balance is told by itself.
fn in_words(note: &Note, path: &Path) -> Option<String> {
    match note {
        Note::AtRest { .. } => Some(note.to_string()),
        Note::Coarse => Some(format!("{note}; `plushwright key {} --again` does", shown(path))),
        Note::Unbalanced(_) => None,
    }
}

/// Tells keyframes whose poses do not balance.
fn balanced(notes: &[Note]) -> Result<(), CommandError> {
    words::balanced(notes.iter().filter_map(|note| match note {
        Note::Unbalanced(unbalanced) => Some(unbalanced),
        Note::AtRest { .. } | Note::Coarse => None,
    }))
}

/// What an interrupted search leaves, and how to go on.
fn interrupted(path: &Path, told: &Told, checked: bool) -> CommandError {
    let path = shown(path);
    let by = told.rounds.map_or(String::new(), |[round, rounds]| format!(" by round {round} of {rounds}"));
    let but = if checked { ";" } else { ", not checked yet:" };
    CommandError::Interrupted(format!(
        "{path} has the best networks{by}{but} `plushwright check {path}` says how good they are, the same command with --fresh searches to the end"
    ))
}

/// Why there is no rig for a design that was read from `path`.
pub fn failed(path: &Path, error: Error) -> CommandError {
    match error {
        Error::Rig(RigError::NothingFound | RigError::NothingToAdd) => CommandError::NotConverged(error.to_string()),
        Error::Rig(RigError::NoTargets) => {
            let design = shown(path);
            let advice = format!("`plushwright pose {design} --name P --target X,Y=X2,Y2` makes one");
            CommandError::input(path, format!("{error}; {advice}"))
        }
        Error::Rig(_) => CommandError::input(path, error),
        Error::Edit(_) => CommandError::Failed(error.to_string()),
        Error::Cancelled(_) => CommandError::Cancelled,
    }
}

/// Most tendons of a winch that may come of a choice.
fn most_tendons(choice: &TendonChoice) -> usize {
    match choice {
        TendonChoice::Between(low, high) => high - low + 1,
        TendonChoice::PerWinch(_) => 1,
    }
}
