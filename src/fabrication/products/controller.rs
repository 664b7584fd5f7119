//! The programs for motor controllers of the classic ASCII family.

use crate::design::Design;
use crate::fabrication::error::ExportError;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::motion::{Note, Program, Trajectory, classic};

/// The programs `controller-ascii-setup`, `-motion` and `-stop`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let programs = classic::programs(source.design, source.trajectory)?;
    let remarks = remarks(source.design, source.trajectory, &programs.motion);
    let guide = guide(source.design, source.trajectory);
    let classic::Programs { setup, motion, stop } = programs;
    let parts = [("setup", setup), ("motion", motion), ("stop", stop)];
    let products =
        parts.map(|(part, program)| Product::new(format!("controller-ascii-{part}"), Content::Program(program)));
    Ok(Part { products: products.into(), guide, remarks })
}

fn guide(design: &Design, trajectory: &Trajectory) -> String {
    let motor = &design.controller;
    let nodes: Vec<String> =
        trajectory.winches.iter().enumerate().map(|(i, w)| format!("  node {}: {w}\n", i + 1)).collect();
    format!(
        "  For Faulhaber controllers of the classic ASCII family (MCDC, MCBL 300x RS), 8N1, 9600 baud from the factory,
  Xon/Xoff, with node numbers set beforehand:
{nodes}  Send one command at a time (each ends with a carriage return) and await its reply.
  setup: once, with the plushie at rest and its cables just slack. It makes this the zero position and sets the limits of travel;
  never send it while cable is wound. motion: as often as you like, from the rest position. Step k begins at time_s of row k of
  tracks.csv with SP and LA for every node, then M for every node: each is the position of the next row, so that the drives follow
  without trailing. stop: back to zero; wait {wait} s before its last commands (DI), which switch the motors off. Send it after the
  last motion, and after one that was broken off.
  At most {speed} rpm and {acceleration} rev/s^2 are asked of the motors; AC and DEC are set to their largest value, believed to be 30000, so that
  the drives do not trail. Set current limits (LPC, LCC) for your motor and gear before you let it pull: this file knows neither.
",
        nodes = nodes.concat(),
        wait = classic::stopping_s(design, trajectory),
        speed = motor.speed_rpm,
        acceleration = motor.acceleration,
    )
}

/// What became of the animation, and where the line is too slow for it.
fn remarks(design: &Design, trajectory: &Trajectory, motion: &Program) -> Vec<String> {
    let mut remarks: Vec<String> = trajectory.notes.iter().map(worded).collect();
    let slow = motion.steps().zip(trajectory.times_s.windows(2)).filter_map(|((_, commands), times)| {
        let on_line: f64 = commands.map(classic::line_s).sum();
        (on_line > times[1] - times[0]).then_some((on_line, times[1] - times[0]))
    });
    if let Some((on_line, step)) = slow.max_by(|a, b| a.0.total_cmp(&b.0)) {
        remarks.push(format!(
            "At 9600 baud a step takes up to {:.0} ms on the line with its replies, longer than the {:.0} ms of the step: set a higher \
             baud rate, or a lower track rate.",
            1e3 * on_line,
            1e3 * step
        ));
    }
    if design.keyframes.is_empty() {
        remarks.push("The design has no keyframes: its tracks hold the rest state alone.".into());
    }
    remarks
}

/// A sentence of what happened to the animation on its way to the motors.
fn worded(note: &Note) -> String {
    match note {
        Note::Slack { winch, time_s, length_mm } => format!(
            "The keyframe at {time_s:.2} s lets winch {winch:?} out by {:.1} mm beyond its rest length, where line may leave the spool: it stops \
             at 0, and that pose may be missed.",
            -length_mm
        ),
        Note::Lead { lead_s, later_s } => {
            let later = if *later_s > 0.0 { format!("; all of it is {later_s:.2} s later") } else { String::new() };
            format!(
                "The animation does not begin at rest: its winches take {lead_s:.2} s to wind up to the first keyframe{later}."
            )
        }
        Note::Stretched { from_s, to_s, now_s } => format!(
            "From {from_s:.2} s to {to_s:.2} s the motors would have been too slow: that section takes {now_s:.2} s now, and what follows is later."
        ),
        Note::Rounded { winch, from_s, to_s } => format!(
            "From {from_s:.2} s to {to_s:.2} s winch {winch:?} moves as evenly as its motor can, not as the keyframe's easing would have it."
        ),
    }
}
