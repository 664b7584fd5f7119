//! `key`: a pose on the timeline, as the winch activations that reach it.

use super::document;
use super::error::{CommandError, check_cancel};
use super::output::say;
use crate::design::{Design, Easing, Keyframe, Target, edit};
use crate::engine::{Effort, Question, Request, Shape, Solver};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Put a pose on the timeline (as winch activations; a keyframe at the same time is replaced)
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
    /// Design file to write; may be the one read
    #[arg(short, long, value_name = "DESIGN")]
    pub output: PathBuf,
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
        let mut design = document::load(&self.design)?;
        if design.networks.is_empty() {
            return Err(CommandError::input(
                &self.design,
                "the design has no winches to key; run `plushwright rig` first",
            ));
        }
        let known = design.poses.iter().any(|p| p.name == self.pose);
        let (activations, pose) = if !known && self.pose == "rest" {
            (vec![0.0; design.networks.len()], None)
        } else {
            (activations(&design, &self.pose, cancel)?, Some(self.pose.clone()))
        };
        let text = activations.iter().map(|a| format!("{a:.2}")).collect::<Vec<_>>().join(" ");
        let easing = match self.ease {
            Ease::Linear => Easing::Linear,
            Ease::Smooth => Easing::Smooth,
            Ease::Hold => Easing::Hold,
        };
        put(&mut design, self.time, activations, pose, easing)?;
        document::save(&self.output, &design, cancel)?;
        say(out, &format!("{}: {} at {} s, winches at {text} mm", self.output.display(), self.pose, self.time))
    }
}

/// Winch activations, mm, with which the realizable plushie comes closest to a pose.
pub fn activations(design: &Design, pose: &str, cancel: &AtomicBool) -> Result<Vec<f64>, CommandError> {
    let [_, realizable] = solve(design, Question::Targets(targets(design, pose)?), [false, true], cancel)?;
    let activations = realizable.activations_mm;
    if activations.len() != design.networks.len() {
        return Err(CommandError::Failed("the solver returned no activation for some winches".into()));
    }
    Ok(activations)
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
        show_idealized: wanted[0],
        show_realizable: wanted[1],
    };
    let outcome = Solver::default().solve_with(&request, Effort::Thorough, cancel);
    check_cancel(cancel)?;
    let rest = || Shape { nodes: design.mesh.nodes.clone(), ..Shape::default() };
    Ok([outcome.idealized.unwrap_or_else(rest), outcome.realizable.unwrap_or_else(rest)])
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
