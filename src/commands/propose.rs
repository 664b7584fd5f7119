//! `propose`: networks for one pose to choose from, and the choice.

use super::document::Target;
use super::error::CommandError;
use super::output::{say, say_json, say_lines};
use super::search::{Algorithm2, Rules};
use super::{document, progress, words};
use crate::bench::{Cell, Table};
use crate::defaults;
use crate::design::Design;
use crate::discovery::Parameters;
use crate::files::shown;
use crate::operations::propose::{self, Error, Options};
use crate::operations::{Context, Progress};
use crate::rigging::{PoseServed, Proposal, ProposeOptions, Sewn};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Find networks for one pose to choose from, and accept one
///
/// Each is a winch with its tendons that brings the realizable plushie closer to the pose, with what `check` would say of the design
/// that has it, and what a hand would need to sew it. They differ in kind, the best first. Nothing is written unless `--accept` is given.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright propose pig.plush --pose ear-and-leg --tendons 2 --accept 1")]
pub struct Propose {
    /// Design file to read
    pub design: PathBuf,
    /// Name of the pose
    #[arg(long, value_name = "P")]
    pub pose: String,
    /// Most tendons of a network
    #[arg(long, value_name = "N", default_value_t = defaults::TENDON_NUM as u16, value_parser = clap::value_parser!(u16).range(1..=16))]
    pub tendons: u16,
    /// Leave out networks of fewer tendons
    #[arg(long)]
    pub no_fewer: bool,
    /// Whether networks keep the design's rules of sewing, or none (for studies)
    #[arg(long, value_enum, default_value_t)]
    pub rules: Rules,
    /// Seed of the search: another one may find other networks
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    #[command(flatten)]
    pub parameters: Algorithm2,
    /// Build the network of this number into the design
    #[arg(long, value_name = "NUMBER")]
    pub accept: Option<usize>,
    #[command(flatten)]
    pub target: Target,
    /// Print JSON; errors as fractions of the body length
    #[arg(long)]
    pub json: bool,
}

/// Format of what `propose --json` prints.
const FORMAT: &str = "plushwright-propose/1";

/// What `propose --json` prints.
#[derive(Serialize)]
struct Summary<'a> {
    design: String,
    pose: &'a str,
    proposals: Vec<Told>,
    /// The number of the one that was built in.
    accepted: Option<usize>,
}

/// A proposal as it is told.
#[derive(Serialize)]
struct Told {
    number: usize,
    tendons: usize,
    holes: usize,
    thread_mm: f64,
    force_n: f64,
    turn_degrees: f64,
    turning_degrees: f64,
    /// Places in which a rule of sewing is broken.
    hard_to_sew: usize,
    /// Error of the pose as a rule and at worst, when it is sewn by hand; null where that was not worked out.
    error_sewn: Option<Sewn>,
    poses: Vec<Served>,
}

/// A pose without and with a network.
#[derive(Serialize)]
struct Served {
    name: String,
    error_before: f64,
    error_realizable: f64,
    /// With friction, where the design has it and the figure is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_realizable_friction: Option<f64>,
    served: bool,
}

impl Propose {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        match self.accept {
            None => {
                let design = document::load(&self.design)?;
                let list = self.find(&design, cancel)?;
                self.tell(&list, None, out)
            }
            Some(number) => {
                let (mut design, edit) = self.target.open(&self.design, cancel)?;
                let list = self.find(&design, cancel)?;
                let chosen = number.checked_sub(1).and_then(|index| list.get(index)).ok_or_else(|| {
                    CommandError::Usage(format!("there is no network {number}; there are 1 to {}", list.len()))
                })?;
                propose::accept(&mut design, chosen.network.clone())
                    .map_err(|error| CommandError::Failed(error.to_string()))?;
                edit.save(&design, cancel)?;
                self.tell(&list, Some((number, &design)), out)
            }
        }
    }

    fn find(&self, design: &Design, cancel: &AtomicBool) -> Result<Vec<Arc<Proposal>>, CommandError> {
        let mut hear = |step: &Progress| progress::now(&words::progress(step));
        let mut context = Context::telling(cancel, &mut hear);
        propose::run(design, &self.options(), &mut context).map_err(|error| self.failed(error))
    }

    fn options(&self) -> Options {
        let (given, usual) = (self.parameters, Parameters::default());
        let parameters = Parameters {
            seed_num: given.seed_num.unwrap_or(usual.seed_num),
            join_depth: given.join_depth.unwrap_or(usual.join_depth),
            join_len: given.join_len.unwrap_or(usual.join_len),
            phi: given.phi.unwrap_or(usual.phi),
            tendon_num: usize::from(self.tendons),
            ..usual
        };
        let rules = self.rules == Rules::Sewing;
        let search = ProposeOptions { parameters, fewer: !self.no_fewer, rules, seed: self.seed };
        Options { pose: self.pose.clone(), search }
    }

    fn failed(&self, error: Error) -> CommandError {
        match error {
            Error::NoSuchPose(error) => words::no_such_pose(&error),
            Error::NoTargets => {
                let (design, pose) = (shown(&self.design), &self.pose);
                let advice = format!("`plushwright pose {design} --name {pose} --target X,Y=X2,Y2` gives it one");
                CommandError::input(&self.design, format!("{error}; {advice}"))
            }
            Error::NothingFound => {
                CommandError::NotConverged(format!("{error}; try more --tendons, another --seed, or --rules none"))
            }
            Error::Cancelled(_) => CommandError::Cancelled,
        }
    }

    fn tell(
        &self,
        list: &[Arc<Proposal>],
        accepted: Option<(usize, &Design)>,
        out: &mut dyn Write,
    ) -> Result<(), CommandError> {
        if self.json {
            let path = if accepted.is_some() { self.target.path(&self.design) } else { &self.design };
            let proposals = list.iter().enumerate().map(|(index, proposal)| told(index, proposal)).collect();
            let accepted = accepted.map(|(number, _)| number);
            return say_json(out, FORMAT, &Summary { design: shown(path), pose: &self.pose, proposals, accepted });
        }
        say_lines(out, table(&self.pose, list).text().trim_end())?;
        let Some((number, design)) = accepted else {
            return Ok(());
        };
        let name = design.networks.last().map_or("", |network| network.name.as_str());
        say(out, &format!("{}: network {number} is {name}", shown(self.target.path(&self.design))))?;
        if design.keyframes.is_empty() {
            return Ok(());
        }
        let again = format!("`plushwright key {} --again`", shown(self.target.path(&self.design)));
        say(out, &format!("note: it is slack in the keyframes that are there; {again} works them out with it"))
    }
}

fn told(index: usize, proposal: &Proposal) -> Told {
    Told {
        number: index + 1,
        tendons: proposal.network.tendons.len(),
        holes: proposal.holes,
        thread_mm: proposal.thread_mm,
        force_n: proposal.force_n,
        turn_degrees: proposal.turn_degrees,
        turning_degrees: proposal.turning_degrees,
        hard_to_sew: proposal.breaches.len(),
        error_sewn: proposal.sewn,
        poses: proposal.poses.iter().map(served).collect(),
    }
}

fn served(pose: &PoseServed) -> Served {
    Served {
        name: pose.name.clone().unwrap_or_default(),
        error_before: pose.before,
        error_realizable: pose.after,
        error_realizable_friction: pose.with_friction.map(|[_, after]| after).filter(|after| after.is_finite()),
        served: pose.is_served(),
    }
}

/// A row for each proposal; for other poses only the names of those that it serves.
fn table(pose: &str, list: &[Arc<Proposal>]) -> Table {
    let caption = format!(
        "Networks for {pose}. Errors in % of the body length, wound from rest without friction; sewn: holes {} mm off",
        defaults::SEWN_HOLE_MM
    );
    let headings = [
        "network",
        "tendons",
        "error before",
        "after",
        "sewn",
        "holes",
        "cable (mm)",
        "force (N)",
        "hard to sew",
        "serves",
    ];
    let mut table = Table::new("proposals", &caption, &headings);
    for (index, proposal) in list.iter().enumerate() {
        let serves: Vec<&str> = proposal.serves().collect();
        table.push(vec![
            (index + 1).into(),
            proposal.network.tendons.len().into(),
            (100.0 * proposal.error_before()).into(),
            (100.0 * proposal.error_after()).into(),
            Cell::from(proposal.sewn.map(|sewn| 100.0 * sewn.median)),
            proposal.holes.into(),
            proposal.thread_mm.round().into(),
            proposal.force_n.into(),
            proposal.breaches.len().into(),
            serves.join(", ").into(),
        ]);
    }
    table
}
