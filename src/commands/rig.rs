//! `rig`: the design loop over all poses, without a window.

use super::error::CommandError;
use super::output::say;
use super::{document, words};
use crate::files::shown;
use crate::operations::rig::{self, Error, Options, TendonChoice};
use crate::operations::{Context, Progress};
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Find winches and tendons for all poses: solve, discover, try out, accept
///
/// Where the design has no keyframes, its poses are laid on the timeline one second apart, with rest at both ends.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright rig pig.plush -o pig.plush --max-winches 1 --tendons 2")]
pub struct Rig {
    /// Design file to read
    pub design: PathBuf,
    #[command(flatten)]
    pub target: document::Target,
    /// Most winches the design may have in the end
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=64))]
    pub max_winches: u16,
    /// Tendons of each winch: one number for all, a list winch by winch, or a range to choose from
    #[arg(long, value_name = "N[,N...]|A..B", default_value = "1..4")]
    pub tendons: TendonChoice,
    /// Fibers that seed a network (SEED_NUM of Algorithm 2) [default: several are tried]
    #[arg(long, value_name = "N")]
    pub seed_num: Option<usize>,
    /// Rounds of joining (JOIN_DEPTH) [default: several are tried]
    #[arg(long, value_name = "N")]
    pub join_depth: Option<usize>,
    /// Largest number of edges of a joining path (JOIN_LEN) [default: several are tried]
    #[arg(long, value_name = "N")]
    pub join_len: Option<usize>,
    /// 0 (equal tendons) to 1 (long tendons) [default: several are tried]
    #[arg(long, value_name = "PHI", value_parser = parse_phi, allow_hyphen_values = true)]
    pub phi: Option<f64>,
}

impl Rig {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let options = Options {
            max_winches: usize::from(self.max_winches),
            tendons: self.tendons.clone(),
            seed_num: self.seed_num,
            join_depth: self.join_depth,
            join_len: self.join_len,
            phi: self.phi,
        };
        let mut printed = Ok(());
        let mut progress = |step: &Progress| {
            if printed.is_ok() {
                printed = say(out, &words::progress(step));
            }
        };
        let mut context = Context::telling(cancel, &mut progress);
        rig::run(&mut design, &options, &mut context).map_err(|error| failed(&self.design, error))?;
        printed?;
        edit.save(&design, cancel)?;
        let tendons: usize = design.networks.iter().map(|n| n.tendons.len()).sum();
        say(out, &format!("{}: {} winches, {tendons} tendons", shown(&self.target.output), design.networks.len()))
    }
}

/// Why there is no rig for a design that was read from `path`.
pub fn failed(path: &Path, error: Error) -> CommandError {
    match error {
        Error::NoTargets => CommandError::input(path, error),
        Error::NothingFound => CommandError::NotConverged(error.to_string()),
        Error::Key(_) | Error::Edit(_) => CommandError::Failed(error.to_string()),
        Error::Cancelled(_) => CommandError::Cancelled,
    }
}

fn parse_phi(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(phi) if (0.0..=1.0).contains(&phi) => Ok(phi),
        _ => Err(format!("expected a number from 0 to 1, found `{text}`")),
    }
}
