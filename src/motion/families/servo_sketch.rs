//! Sketches for hobby servos on a PCA9685: an Arduino or MicroPython plays the table that stands in it, and obeys a computer ([`super::servo`]).
//!
//! All three parts are words that the sketch obeys over its serial port: `setup`, `motion`, `stop`.

use super::family::{Family, Sketch};
use super::servo::{Servos, UNCONFIRMED};
use super::shortened::{Steps, shortened};
use crate::motion::error::MotionError;
use crate::motion::machine::Machine;
use crate::motion::trajectory::Trajectory;
use std::fmt::Write;

pub(super) static ARDUINO: Family = Family {
    name: "servo-arduino",
    title: "hobby servos on a PCA9685, an Arduino that plays by itself",
    extension: "ino",
    stream: None,
    sketches: Some(arduino),
    unconfirmed: UNCONFIRMED,
};

pub(super) static MICROPYTHON: Family = Family {
    name: "servo-micropython",
    title: "hobby servos on a PCA9685, MicroPython that plays by itself",
    extension: "py",
    stream: None,
    sketches: Some(micropython),
    unconfirmed: UNCONFIRMED,
};

/// The sketches with their places for figures.
const INO: &str = include_str!("sketches/servos.ino");
const PY: &str = include_str!("sketches/servos.py");
/// Room for the table, bytes: an Arduino Uno has 32 kB for the table and its sketch, and what is beyond the first 32 kB needs another way to read it.
const TABLE_BYTES: usize = 20_000;
/// A figure of the table, bytes.
const FIGURE_BYTES: usize = 2;
/// Longest row, ms: what two bytes hold.
const LONGEST_MS: u64 = 65_535;

fn arduino(machine: &Machine, trajectory: &Trajectory) -> Result<Vec<Sketch>, MotionError> {
    sketch(machine, trajectory, INO, ["// ", "{", "}"], "ino")
}

fn micropython(machine: &Machine, trajectory: &Trajectory) -> Result<Vec<Sketch>, MotionError> {
    sketch(machine, trajectory, PY, ["# ", "(", ")"], "py")
}

/// Fills a sketch with figures; `marks`: how a comment begins, and what stands around a row.
fn sketch(
    machine: &Machine,
    trajectory: &Trajectory,
    text: &str,
    [comment, open, close]: [&str; 3],
    extension: &'static str,
) -> Result<Vec<Sketch>, MotionError> {
    let servos = Servos::new(machine)?;
    let rows = table(&servos, machine, trajectory)?;
    let list = |values: &mut dyn Iterator<Item = i64>| values.map(|v| v.to_string()).collect::<Vec<_>>().join(", ");
    let mut lines = String::new();
    for (ms, pulses) in &rows {
        let figures = list(&mut std::iter::once(*ms as i64).chain(pulses.iter().copied()));
        // Writing to a string cannot fail.
        let _ = writeln!(lines, "  {open}{figures}{close},");
    }
    let fill = [
        ("@NAME@", "Winches".to_owned()),
        ("@HEAD@", head(machine, trajectory, comment)),
        ("@SERVOS@", machine.winches.len().to_string()),
        ("@REST@", list(&mut machine.winches.iter().map(|_| servos.pulse(0.0)))),
        ("@FARTHEST@", list(&mut machine.travel_mm.iter().map(|&travel| servos.pulse(travel)))),
        ("@HOME_MS@", servos.home_ms().to_string()),
        ("@ROWS@", rows.len().to_string()),
        ("@TABLE@", lines),
    ];
    let text = fill.iter().fold(text.to_owned(), |text, (place, figures)| text.replace(place, figures));
    Ok(vec![Sketch { part: String::new(), extension, text }])
}

/// Comments: which channel is which winch, what it asks of its servo, and what is not known.
fn head(machine: &Machine, trajectory: &Trajectory, comment: &str) -> String {
    let drives = &machine.controller.drives;
    let mut lines: Vec<String> = Vec::new();
    for (channel, (winch, &travel)) in machine.winches.iter().zip(&machine.travel_mm).enumerate() {
        lines.push(format!("Channel {channel}: {winch}, {travel:.1} mm, {:.0} degrees.", machine.degrees(travel)));
    }
    lines.push(format!(
        "Servos of {} degrees from {} to {} us; the fastest turn here is {:.0} degrees/s.",
        drives.servo_degrees,
        drives.servo_low_us,
        drives.servo_high_us,
        fastest(machine, trajectory)
    ));
    lines.extend(UNCONFIRMED.iter().map(|line| format!("Unconfirmed: {line}.")));
    lines.iter().map(|line| format!("{comment}{line}")).collect::<Vec<_>>().join("\n")
}

/// The fastest turn of any spool, degrees/s.
fn fastest(machine: &Machine, trajectory: &Trajectory) -> f64 {
    let steps = trajectory.times_s.windows(2).zip(trajectory.lengths_mm.windows(2));
    let speeds = steps.flat_map(|(times, rows)| {
        let lasts_s = times[1] - times[0];
        rows[0].iter().zip(&rows[1]).map(move |(from, to)| (to - from).abs() / lasts_s)
    });
    machine.degrees(speeds.fold(0.0, f64::max))
}

/// Rows of the motion: milliseconds since the one before, and pulses. As few as the motion needs, and as many as the table has room for; times are rounded
/// from the beginning, so that nothing adds up. The first row is the rest.
fn table(servos: &Servos, machine: &Machine, trajectory: &Trajectory) -> Result<Vec<(u64, Vec<i64>)>, MotionError> {
    let room = TABLE_BYTES / (FIGURE_BYTES * (machine.winches.len() + 1));
    let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
    let ms = |k: usize| (1e3 * (times[k] - times[0])).round() as u64;
    // What lasts longer than a row can is several.
    let parts = |pair: &[usize]| (ms(pair[1]) - ms(pair[0])).div_ceil(LONGEST_MS).max(1);
    let even = |_: usize, _: usize| 0.0;
    let all = Steps { times_s: times, lengths_mm: lengths, winches: 0..machine.winches.len(), uneven_mm: &even };
    let fits = |kept: &[usize]| kept.windows(2).map(parts).sum::<u64>() < room as u64;
    let kept = shortened(&all, fits, "the table of a sketch")?;
    let pulses = |row: &[f64]| row.iter().map(|&length| servos.pulse(length)).collect();
    let mut rows = vec![(0, pulses(&lengths[0]))];
    for pair in kept.windows(2) {
        let (begin, end, parts) = (ms(pair[0]), ms(pair[1]), parts(pair));
        let at = |part: u64| begin + (end - begin) * part / parts;
        for part in 1..=parts {
            let done = part as f64 / parts as f64;
            let between = |(from, to): (&f64, &f64)| from + done * (to - from);
            let row: Vec<f64> = lengths[pair[0]].iter().zip(&lengths[pair[1]]).map(between).collect();
            rows.push((at(part) - at(part - 1), pulses(&row)));
        }
    }
    Ok(rows)
}
