//! `key`: a pose on the timeline, as the winch activations that reach it.

use super::document;
use super::error::{CommandError, check_cancel};
use super::output::say;
use crate::design::{Design, Easing, Keyframe, Target, edit};
use crate::engine::{Effort, Quality, Question, Request, Shape, Solver};
use crate::files::shown;
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Put a pose on the timeline (as winch activations; a keyframe at the same time is replaced)
///
/// Where the plushie does not come to equilibrium in that pose, the best activations found are written all the same, and
/// the exit code is 3.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright key pig.plush --pose wave --time 1.5 --ease smooth -o pig.plush")]
pub struct Key {
    /// Design file to read; it needs winches (see `plushwright rig`)
    pub design: PathBuf,
    /// Name of the pose; `rest` means no activation unless the design has a pose of that name
    #[arg(long, value_name = "P")]
    pub pose: String,
    /// Time of the keyframe in s
    #[arg(long, value_name = "S", value_parser = parse_time, allow_hyphen_values = true)]
    pub time: f64,
    /// How the animation moves on to the next keyframe
    #[arg(long, value_enum, default_value_t = Ease::Smooth)]
    pub ease: Ease,
    #[command(flatten)]
    pub target: document::Target,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Ease {
    /// At constant speed
    Linear,
    /// Starting and ending at rest
    Smooth,
    /// Stay until the next keyframe
    Hold,
}

impl Key {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        if design.networks.is_empty() {
            return Err(CommandError::input(
                &self.design,
                "the design has no winches to key; run `plushwright rig` first",
            ));
        }
        let known = design.poses.iter().any(|p| p.name == self.pose);
        let (activations, pose, unbalanced) = if !known && self.pose == "rest" {
            (vec![0.0; design.networks.len()], None, Vec::new())
        } else {
            let shape = realizable(&design, &self.pose, cancel)?;
            let activations = shape.activations_mm.clone();
            (activations, Some(self.pose.clone()), unbalanced(&self.pose, &[at_rest(&design), shape]))
        };
        let text = activations.iter().map(|a| format!("{a:.2}")).collect::<Vec<_>>().join(" ");
        let easing = match self.ease {
            Ease::Linear => Easing::Linear,
            Ease::Smooth => Easing::Smooth,
            Ease::Hold => Easing::Hold,
        };
        put(&mut design, self.time, activations, pose, easing)?;
        edit.save(&design, cancel)?;
        say(out, &format!("{}: {} at {} s, winches at {text} mm", shown(&self.target.output), self.pose, self.time))?;
        balanced(unbalanced)
    }
}

/// Winch activations, mm, with which the realizable plushie comes closest to a pose.
pub fn activations(design: &Design, pose: &str, cancel: &AtomicBool) -> Result<Vec<f64>, CommandError> {
    Ok(realizable(design, pose, cancel)?.activations_mm)
}

/// The realizable plushie, as close to a pose as it comes.
fn realizable(design: &Design, pose: &str, cancel: &AtomicBool) -> Result<Shape, CommandError> {
    let [_, shape] = solve(design, Question::Targets(targets(design, pose)?), [false, true], cancel)?;
    if shape.activations_mm.len() != design.networks.len() {
        return Err(CommandError::Failed("the solver returned no activation for some winches".into()));
    }
    Ok(shape)
}

/// What is to be said of shapes that did not come to equilibrium: where (a pose, say), which plushie, how far from it.
pub fn unbalanced(place: &str, [idealized, realizable]: &[Shape; 2]) -> Vec<String> {
    let views = [("idealized", idealized), ("realizable", realizable)];
    let off = views.into_iter().filter(|(_, shape)| !shape.converged);
    off.map(|(view, shape)| {
        let distance = shape.distance_from_equilibrium();
        let why = shape.warning.as_ref().map_or("not in equilibrium".into(), |warning| warning.to_string());
        let why = why.trim_end_matches('.');
        format!("{place}, {view}: {why} (unbalanced forces are {distance:.1e} of those at work)")
    })
    .collect()
}

/// Fails where anything is [`unbalanced`]; for the end of a command, when what was found is written.
pub fn balanced(unbalanced: Vec<String>) -> Result<(), CommandError> {
    if unbalanced.is_empty() { Ok(()) } else { Err(CommandError::NotConverged(unbalanced.join("; "))) }
}

/// The targets of a pose.
pub fn targets(design: &Design, pose: &str) -> Result<Vec<Target>, CommandError> {
    design.poses.iter().find(|p| p.name == pose).map(|p| p.targets.clone()).ok_or_else(|| {
        let names: Vec<&str> = design.poses.iter().map(|p| p.name.as_str()).collect();
        CommandError::Usage(format!("no pose `{pose}`; the design has: {}", names.join(", ")))
    })
}

/// Both plushies, idealized first, solved from rest; one that is not `wanted` stays at rest.
pub fn solve(
    design: &Design,
    question: Question,
    wanted: [bool; 2],
    cancel: &AtomicBool,
) -> Result<[Shape; 2], CommandError> {
    let request = Request {
        id: 0,
        design: Arc::new(design.clone()),
        question,
        quality: Quality::Accurate,
        show_idealized: wanted[0],
        show_realizable: wanted[1],
    };
    let outcome = Solver::default().solve_with(&request, Effort::Thorough, cancel);
    check_cancel(cancel)?;
    let rest = || at_rest(design);
    Ok([outcome.idealized.unwrap_or_else(rest), outcome.realizable.unwrap_or_else(rest)])
}

fn at_rest(design: &Design) -> Shape {
    Shape { nodes: design.mesh.nodes.clone(), converged: true, ..Shape::default() }
}

/// Puts a keyframe on the timeline; one at the same time is replaced.
pub fn put(
    design: &mut Design,
    time_s: f64,
    activations_mm: Vec<f64>,
    pose: Option<String>,
    easing: Easing,
) -> Result<(), CommandError> {
    edit::set_keyframe(design, Keyframe { time_s, activations_mm, pose, easing })
        .map(|_| ())
        .map_err(|e| CommandError::Failed(e.to_string()))
}

fn parse_time(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() && time >= 0.0 => Ok(time),
        _ => Err(format!("expected a time in s, 0 or later, found `{text}`")),
    }
}
