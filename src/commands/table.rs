//! Figures of a design: sizes, and how close each pose comes to its targets.

use super::error::CommandError;
use super::output::say;
use super::words;
use crate::defaults;
use crate::design::Design;
use crate::operations::check::{self, Error, Figures, Note};
use crate::operations::{Context, Unbalanced};
use std::io::Write;
use std::sync::atomic::AtomicBool;

/// The figures of all poses, with this coefficient of friction or the design's own; where that is asked for, as a hand sews them too.
///
/// # Errors
/// The coefficient is none; it was cancelled.
pub fn figures(
    design: &Design,
    friction: Option<f64>,
    sewn: bool,
    cancel: &AtomicBool,
) -> Result<Figures, CommandError> {
    let options = check::Options { friction, sewn, ..check::Options::default() };
    check::run(design, &options, &Context::new(cancel)).map_err(|error| match error {
        Error::Cancelled(_) => CommandError::Cancelled,
        error @ (Error::NoSuchPose(_) | Error::Friction(_)) => CommandError::Usage(error.to_string()),
    })
}

/// The poses that did not come to equilibrium.
pub fn unbalanced(figures: &Figures) -> impl Iterator<Item = &Unbalanced> {
    figures.notes.iter().filter_map(|note| match note {
        Note::Unbalanced(unbalanced) => Some(unbalanced),
        Note::Warning { .. } | Note::Friction { .. } => None,
    })
}

/// Prints the figures as a table.
pub fn print(figures: &Figures, out: &mut dyn Write) -> Result<(), CommandError> {
    say(
        out,
        &format!(
            "{}: {} fibers, {} nodes, {} triangles, {}, {:.1} mm long",
            figures.name,
            figures.fibers,
            figures.nodes,
            figures.triangles,
            words::built(figures.winches, figures.tendons),
            figures.body_length_mm
        ),
    )?;
    if !figures.switched_off.is_empty() {
        say(out, &format!("switched off: {}", figures.switched_off.join(", ")))?;
    }
    if !figures.poses.is_empty() {
        poses(figures, out)?;
    }
    sewing(figures, out)
}

fn poses(figures: &Figures, out: &mut dyn Write) -> Result<(), CommandError> {
    let width = figures.poses.iter().map(|p| p.name.chars().count()).max().unwrap_or(0).max(4);
    say(out, "")?;
    let above = "         rms target error (% of body length)         solved in (ms)  unbalanced forces (part)";
    say(out, &format!("{:width$}  {above}", ""))?;
    let columns = "targets     rest  idealized  realizable  idealized  realizable  idealized  realizable";
    say(out, &format!("{:width$}  {columns}", "pose"))?;
    for p in &figures.poses {
        say(
            out,
            &format!(
                "{:width$}  {:7}  {:7.2}  {:9.2}  {:10.2}  {:9.1}  {:10.1}  {:9.0e}  {:10.0e}",
                p.name,
                p.targets,
                100.0 * p.error_rest,
                100.0 * p.error_idealized,
                100.0 * p.error_realizable,
                p.milliseconds_idealized,
                p.milliseconds_realizable,
                p.imbalance_idealized,
                p.imbalance_realizable
            ),
        )?;
    }
    friction(figures, width, out)?;
    by_hand(figures, width, out)?;
    // What is off equilibrium is told at the end, as the error that it is.
    for warning in figures.notes.iter().filter(|note| !matches!(note, Note::Unbalanced(_))) {
        say(out, &format!("note: {warning}"))?;
    }
    Ok(())
}

/// How close the realizable plushie comes when its cables rub, where that was asked for.
fn friction(figures: &Figures, width: usize, out: &mut dyn Write) -> Result<(), CommandError> {
    if figures.poses.iter().all(|p| p.error_realizable_friction.is_none()) {
        return Ok(());
    }
    say(out, "")?;
    say(out, &format!("{:width$}  realizable with friction at the holes (% of body length)", ""))?;
    say(out, &format!("{:width$}  pulled  the same let out", "pose"))?;
    let percent = |error: Option<f64>| error.map_or("-".into(), |error| format!("{:.2}", 100.0 * error));
    for p in &figures.poses {
        let [pulled, let_out] = [p.error_realizable_friction, p.error_realizable_letting_out].map(percent);
        say(out, &format!("{:width$}  {pulled:>6}  {let_out:>16}", p.name))?;
    }
    Ok(())
}

/// What a hand's inaccuracy leaves of it, where that was asked for.
fn by_hand(figures: &Figures, width: usize, out: &mut dyn Write) -> Result<(), CommandError> {
    if figures.poses.iter().all(|p| p.error_realizable_sewn.is_none()) {
        return Ok(());
    }
    let (draws, hole_mm) = (defaults::SEWN_DRAWS, defaults::SEWN_HOLE_MM);
    say(out, "")?;
    say(
        out,
        &format!("{:width$}  realizable sewn by hand, {draws} times, holes {hole_mm} mm off (% of body length)", ""),
    )?;
    say(out, &format!("{:width$}  as a rule  at worst", "pose"))?;
    let percent = |error: f64| if error.is_finite() { format!("{:.2}", 100.0 * error) } else { "-".into() };
    for p in &figures.poses {
        if let Some(sewn) = p.error_realizable_sewn {
            say(out, &format!("{:width$}  {:>9}  {:>8}", p.name, percent(sewn.median), percent(sewn.worst)))?;
        }
    }
    Ok(())
}

/// The rules of sewing that are broken, a line each.
fn sewing(figures: &Figures, out: &mut dyn Write) -> Result<(), CommandError> {
    if figures.sewing.is_empty() {
        return Ok(());
    }
    say(out, "")?;
    say(out, &format!("hard to sew ({}):", figures.sewing.len()))?;
    figures.sewing.iter().try_for_each(|broken| say(out, &format!("  {broken}")))
}
