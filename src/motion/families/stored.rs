//! Programs stored in Faulhaber controllers of the classic ASCII family: each drive plays its own winch, without a computer.
//!
//! Sent once over the network, `PROGSEQ` to `END` go into the flash of a node, every line with its number; so it says at the end of the motion's part that
//! it is started by `ENPROG`. Motors know no common clock: they are started within the time of a few commands of each other.
//!
//! Moves last as long as `DELAY` says, whose unit is a setting (`controller.drives.delay_unit_s`). Times are rounded to it from the beginning, not from
//! the step before, so that nothing adds up.

use super::classic::{self, END};
use super::family::{Family, Sketch};
use super::shortened::{Steps, shortened};
use crate::motion::error::MotionError;
use crate::motion::machine::Machine;
use crate::motion::trajectory::Trajectory;

pub(super) static FAMILY: Family = Family {
    name: "ascii-stored",
    title: "Faulhaber controllers of the classic ASCII family (MCDC, MCBL 300x RS), stored in them",
    extension: "txt",
    stream: None,
    sketches: Some(sketches),
    unconfirmed: &[
        "the unit of DELAY, believed to be 1/100 s (controller.drives.delay_unit_s)",
        "the room for programs: ask MEM; a lower track rate makes shorter ones",
        "how often flash may be written, believed to be 10 000 times",
    ],
};

/// The longest `DELAY`, in its unit (unconfirmed: two bytes).
const LONGEST_DELAY: u64 = 65_535;
/// A stored program takes no more steps: the flash is small (unconfirmed).
const MOST_STEPS: usize = 200;

fn sketches(machine: &Machine, trajectory: &Trajectory) -> Result<Vec<Sketch>, MotionError> {
    classic::checked(machine)?;
    let mut parts = [("setup", String::new()), ("motion", String::new()), ("stop", String::new())];
    for winch in 0..machine.winches.len() {
        let own = [setup(machine, winch), stored(&motion(machine, trajectory, winch)?), stop(machine)];
        for ((_, text), commands) in parts.iter_mut().zip(own) {
            *text += &commands.iter().map(|command| format!("{}{command}{END}", winch + 1)).collect::<String>();
        }
    }
    let sketch = |(part, text): (&str, String)| Sketch { part: part.into(), extension: FAMILY.extension, text };
    Ok(parts.into_iter().map(sketch).collect())
}

/// A stored program that still runs is stopped first.
fn setup(machine: &Machine, winch: usize) -> Vec<String> {
    std::iter::once("DIPROG".to_owned()).chain(classic::own_setup(machine, winch)).collect()
}

/// As a program in flash, and started.
fn stored(commands: &[String]) -> Vec<String> {
    let first = ["DIPROG".to_owned(), "PROGSEQ".into()];
    let last = ["END".to_owned(), "ENPROG".into()];
    first.into_iter().chain(commands.iter().cloned()).chain(last).collect()
}

fn motion(machine: &Machine, trajectory: &Trajectory, winch: usize) -> Result<Vec<String>, MotionError> {
    let following = machine.controller.drives.following_acceleration;
    let mut commands = vec![format!("AC{following}"), format!("DEC{following}"), "EN".into()];
    let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
    let steps = steps(machine, trajectory, winch, "a stored program")?;
    let units = |k: usize| ((times[k] - times[0]) / machine.controller.drives.delay_unit_s).round() as u64;
    for pair in steps.windows(2) {
        let (from, to) = (machine.counts(lengths[pair[0]][winch]), machine.counts(lengths[pair[1]][winch]));
        let speed = machine.rpm(to - from, times[pair[1]] - times[pair[0]]);
        commands.extend([format!("SP{speed}"), format!("LA{to}"), "M".into()]);
        let mut rest = units(pair[1]) - units(pair[0]);
        while rest > 0 {
            commands.push(format!("DELAY{}", rest.min(LONGEST_DELAY)));
            rest -= rest.min(LONGEST_DELAY);
        }
    }
    Ok(commands)
}

/// The steps of a winch that are kept, at most [`MOST_STEPS`].
pub(super) fn steps(
    machine: &Machine,
    trajectory: &Trajectory,
    winch: usize,
    what: &'static str,
) -> Result<Vec<usize>, MotionError> {
    let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
    // Speeds are whole revolutions a minute, rounded up: a drive comes too early, and waits.
    let uneven_mm = |from: usize, to: usize| {
        let (by, lasts_s) = (lengths[to][winch] - lengths[from][winch], times[to] - times[from]);
        let counts = machine.counts(lengths[to][winch]) - machine.counts(lengths[from][winch]);
        let there_s =
            60.0 * counts.abs() as f64 / (f64::from(machine.rpm(counts, lasts_s)) * f64::from(machine.resolution()));
        by.abs() * (1.0 - there_s / lasts_s).max(0.0)
    };
    let own = Steps { times_s: times, lengths_mm: lengths, winches: winch..winch + 1, uneven_mm: &uneven_mm };
    shortened(&own, |kept| kept.len() <= MOST_STEPS + 1, what)
}

fn stop(machine: &Machine) -> Vec<String> {
    let (speed, acceleration) = (machine.gentle_rpm(), machine.controller.acceleration);
    let delay = (machine.stopping_s() / machine.controller.drives.delay_unit_s).ceil() as u64;
    let mut commands = vec![format!("SP{speed}"), format!("AC{acceleration}"), format!("DEC{acceleration}")];
    commands.extend(["LA0".to_owned(), "M".into(), format!("DELAY{}", delay.min(LONGEST_DELAY)), "DI".into()]);
    stored(&commands)
}
