//! The page that goes with a blueprint: how to use its files, and what to mind with this design.

use super::tracks::Track;
use crate::design::Design;

/// Time on the line for one winch's step (target, start and their replies) at the factory's 9600 baud, s.
const STEP_ON_LINE_S: f64 = 0.015;

/// Where the motor settings cannot follow the track.
pub(super) fn motor_remarks(design: &Design, track: &Track) -> Vec<String> {
    let motor = &design.controller;
    let mut remarks = Vec::new();
    for (i, winch) in track.winches.iter().enumerate() {
        let peak = track.peak_rpm(i, motor.encoder_lines);
        if peak > f64::from(motor.speed_rpm) {
            remarks.push(format!(
                "Winch {winch:?} needs {peak:.0} rpm at its fastest, more than the {} rpm set: it will lag behind.",
                motor.speed_rpm
            ));
        }
    }
    let on_line = STEP_ON_LINE_S * track.winches.len() as f64;
    if track.times_s.len() > 1 && on_line * motor.track_rate_hz > 1.0 {
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

pub(super) fn text(design: &Design, track: &Track, remarks: &[String]) -> String {
    let motor = &design.controller;
    let made = &design.fabrication;
    let nodes: Vec<String> =
        track.winches.iter().enumerate().map(|(i, w)| format!("  node {}: {w}\n", i + 1)).collect();
    let remarks: Vec<String> = remarks.iter().map(|r| format!("  - {r}\n")).collect();
    let remarks = if remarks.is_empty() { String::new() } else { format!("Mind\n{}\n", remarks.concat()) };
    format!(
        "Blueprint of {name:?}, made by plushwright {version}

{remarks}pattern.svg
  One unit is one millimetre. Measure the 100 mm line before you cut. Red hairlines are cut (holes first), blue lines
  are sewn, green marks are for you. The seam allowance is {allowance} mm. Put front and back together with their outer
  sides facing, sew along the blue line, leave the marked gap open, turn, stuff, close the gap by hand.

routing.svg, routing.csv
  Lead each cable from its winch through the numbered holes, without tension and without slack (unless a slack is
  noted), and tie it at the last hole. Rig front and back alike: two cables a tendon, both on the winch's spool. Leave
  extra cable on the spool. Lengths are those at rest; pulling the ends by hand works as well.

tracks.csv
  Cable wound by each winch in mm (0: at rest, just slack) and as encoder counts,
  4 * encoder_lines * gear_ratio * length / (2 pi * spool_radius_mm), with {lines} lines, gear {gear}, radius {radius} mm.
  The motor must pull when counts grow.

controller-ascii.txt
  For Faulhaber controllers of the classic ASCII family (MCDC, MCBL 300x RS), 8N1, 9600 baud from the factory,
  Xon/Xoff, with node numbers set beforehand:
{nodes}  Put the plushie at rest, cables just slack: HO0 makes this the zero position. Send one command at a time (each ends
  with a carriage return) and await its reply. Every step is one LA and one M for each node; begin a step every
  {interval} s. Limits of travel, {speed} rpm and {acceleration} rev/s^2 are set at the start; check them against your
  motor and gear before you let it pull.
",
        name = design.name,
        version = env!("CARGO_PKG_VERSION"),
        remarks = remarks,
        allowance = made.seam_allowance_mm,
        lines = motor.encoder_lines,
        gear = motor.gear_ratio,
        radius = made.spool_radius_mm,
        nodes = nodes.concat(),
        interval = 1.0 / motor.track_rate_hz,
        speed = motor.speed_rpm,
        acceleration = motor.acceleration,
    )
}
