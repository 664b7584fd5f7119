//! `rig`: the design loop over all poses, without a window.

use super::error::CommandError;
use super::output::say;
use super::{document, key};
use crate::defaults;
use crate::design::{Design, Easing};
use crate::files::shown;
use crate::rigging::{Progress, RigError, RigOptions, TendonChoice, rig};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
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
    #[arg(long, value_name = "N[,N...]|A..B", default_value = "1..4", value_parser = parse_tendons)]
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
        let (design, edit) = self.target.open(&self.design, cancel)?;
        let options = RigOptions {
            max_winches: usize::from(self.max_winches),
            tendons: self.tendons.clone(),
            seed_num: self.seed_num,
            join_depth: self.join_depth,
            join_len: self.join_len,
            phi: self.phi,
        };
        let mut printed = Ok(());
        let rigged = rigged(
            &design,
            &options,
            &mut |step| {
                if printed.is_ok() {
                    printed = say(out, &worded(&step));
                }
            },
            cancel,
        )
        .map_err(|e| match e {
            CommandError::Usage(reason) => CommandError::input(&self.design, reason),
            other => other,
        })?;
        printed?;
        edit.save(&rigged, cancel)?;
        let tendons: usize = rigged.networks.iter().map(|n| n.tendons.len()).sum();
        say(out, &format!("{}: {} winches, {tendons} tendons", shown(&self.target.output), rigged.networks.len()))
    }
}

/// The design with networks for its poses, and its poses on the timeline if nothing is there yet.
pub fn rigged(
    design: &Design,
    options: &RigOptions,
    progress: &mut dyn FnMut(Progress),
    cancel: &AtomicBool,
) -> Result<Design, CommandError> {
    let mut rigged = rig(design, options, progress, cancel).map_err(|e| match e {
        RigError::NoTargets => CommandError::Usage(e.to_string()),
        RigError::NothingFound => CommandError::NotConverged(e.to_string()),
        RigError::Cancelled => CommandError::Cancelled,
    })?;
    if rigged.keyframes.is_empty() {
        lay_out(&mut rigged, cancel)?;
    }
    Ok(rigged)
}

/// One line about a step of the search.
pub fn worded(step: &Progress) -> String {
    match step {
        Progress::Candidates { winch, count } => format!("winch {}: {count} candidate networks", winch + 1),
        Progress::Accepted { winch, tendons, errors } => {
            let errors: Vec<String> =
                errors.iter().map(|(name, error)| format!("{name} {:.1} %", 100.0 * error)).collect();
            format!("winch {}: {tendons} tendons; {}", winch + 1, errors.join(", "))
        }
    }
}

/// Lays the poses on the timeline, evenly spaced, with rest at both ends.
fn lay_out(design: &mut Design, cancel: &AtomicBool) -> Result<(), CommandError> {
    let names: Vec<String> = design.poses.iter().filter(|p| !p.targets.is_empty()).map(|p| p.name.clone()).collect();
    let rest = vec![0.0; design.networks.len()];
    let time = |index: usize| index as f64 * defaults::KEYFRAME_SPACING_S;
    key::put(design, time(0), rest.clone(), None, Easing::default())?;
    for (index, name) in names.iter().enumerate() {
        let activations = key::activations(design, name, cancel)?;
        key::put(design, time(index + 1), activations, Some(name.clone()), Easing::default())?;
    }
    key::put(design, time(names.len() + 1), rest, None, Easing::default())
}

/// Most tendons of one winch: a spool does not hold more.
const MAX_TENDONS: usize = 16;

/// Reads `N`, `N,N,...` or `A..B` (both ends included).
fn parse_tendons(text: &str) -> Result<TendonChoice, String> {
    let explain = || format!("expected N, N,N,... or A..B with numbers from 1 to {MAX_TENDONS}, found `{text}`");
    let number =
        |part: &str| part.trim().parse::<usize>().ok().filter(|n| (1..=MAX_TENDONS).contains(n)).ok_or_else(explain);
    if let Some((low, high)) = text.split_once("..") {
        let (low, high) = (number(low)?, number(high)?);
        return if low <= high { Ok(TendonChoice::Between(low, high)) } else { Err(explain()) };
    }
    Ok(TendonChoice::PerWinch(text.split(',').map(number).collect::<Result<_, _>>()?))
}

fn parse_phi(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(phi) if (0.0..=1.0).contains(&phi) => Ok(phi),
        _ => Err(format!("expected a number from 0 to 1, found `{text}`")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tendon_choices_read_back() {
        assert_eq!(parse_tendons("2"), Ok(TendonChoice::PerWinch(vec![2])));
        assert_eq!(parse_tendons("1,2,3"), Ok(TendonChoice::PerWinch(vec![1, 2, 3])));
        assert_eq!(parse_tendons("1..3"), Ok(TendonChoice::Between(1, 3)));
        for bad in ["", "0", "3..1", "1,,2", "a", "1..", "99"] {
            assert!(parse_tendons(bad).unwrap_err().contains(&format!("`{bad}`")), "{bad}");
        }
    }
}
