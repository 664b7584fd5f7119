//! The program for motor controllers of the classic ASCII family.

use crate::design::Design;
use crate::fabrication::error::ExportError;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::motion::{Trajectory, classic};

/// Time on the line for one winch's step (target, start and their replies) at the factory's 9600 baud, s.
const STEP_ON_LINE_S: f64 = 0.015;

/// The program `controller-ascii`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let program = classic::program(source.design, source.trajectory)?;
    let products = vec![Product::new("controller-ascii", Content::Program(program))];
    let remarks = remarks(source.design, source.trajectory);
    Ok(Part { products, guide: guide(source.design, source.trajectory), remarks })
}

fn guide(design: &Design, trajectory: &Trajectory) -> String {
    let motor = &design.controller;
    let nodes: Vec<String> =
        trajectory.winches.iter().enumerate().map(|(i, w)| format!("  node {}: {w}\n", i + 1)).collect();
    format!(
        "  For Faulhaber controllers of the classic ASCII family (MCDC, MCBL 300x RS), 8N1, 9600 baud from the factory,
  Xon/Xoff, with node numbers set beforehand:
{nodes}  Put the plushie at rest, cables just slack: HO0 makes this the zero position. Send one command at a time (each ends
  with a carriage return) and await its reply. Every step is one LA and one M for each node; begin a step every
  {interval} s. Limits of travel, {speed} rpm and {acceleration} rev/s^2 are set at the start; check them against your
  motor and gear before you let it pull.
",
        nodes = nodes.concat(),
        interval = 1.0 / motor.track_rate_hz,
        speed = motor.speed_rpm,
        acceleration = motor.acceleration,
    )
}

/// Remarks where the motor settings cannot follow the trajectory.
fn remarks(design: &Design, trajectory: &Trajectory) -> Vec<String> {
    let motor = &design.controller;
    let mut remarks = Vec::new();
    for (i, winch) in trajectory.winches.iter().enumerate() {
        let peak = trajectory.peak_rpm(i, motor.encoder_lines);
        if peak > f64::from(motor.speed_rpm) {
            remarks.push(format!(
                "Winch {winch:?} needs {peak:.0} rpm at its fastest, more than the {} rpm set: it will lag behind.",
                motor.speed_rpm
            ));
        }
    }
    let on_line = STEP_ON_LINE_S * trajectory.winches.len() as f64;
    if trajectory.times_s.len() > 1 && on_line * motor.track_rate_hz > 1.0 {
        remarks.push(format!(
            "At 9600 baud a step takes about {:.0} ms on the line, longer than the {:.0} ms between steps: set a higher baud \
             rate, or a lower track rate.",
            1e3 * on_line,
            1e3 / motor.track_rate_hz
        ));
    }
    if design.keyframes.is_empty() {
        remarks.push("The design has no keyframes: its tracks hold the rest state alone.".into());
    }
    remarks
}
