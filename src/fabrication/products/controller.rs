//! The programs for motor controllers, family by family.

use crate::engine::winch_reach_mm;
use crate::fabrication::demand::strong_enough;
use crate::fabrication::error::ExportError;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::remark::Remark;
use crate::motion::families::{self, classic};
use crate::motion::{
    Family, Following, Forecast, Machine, MotionError, Note, Plan, Sketch, Stream, Trajectory, commands_a_step, line,
    programs,
};
use std::collections::HashSet;

/// Programs of every family that was asked for, or of all that can play this motion: `controller-<family>-setup`, `-motion`, `-stop`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let machine = Machine::new(source.design, source.trajectory);
    let (mut products, mut guide, mut remarks) = (Vec::new(), how(), remarks(source));
    let weak = strong_enough(source.design, source.trajectory, source.demands())?;
    remarks.extend(weak.map(|error| Remark::from(format!("Assumed of the motors: {error}.")).grave()));
    guide += &followed(source, &machine)?;
    let mut left_out: Vec<(String, Vec<&str>)> = Vec::new();
    for family in chosen(source)? {
        match written(family, &machine, source.trajectory) {
            Ok(own) => {
                guide += &family_guide(family, &machine, &own);
                products.extend(own);
            }
            // What was asked for is refused by name, and so is what the tracks themselves are counted for.
            Err(error) if !source.options.controllers.is_empty() || std::ptr::eq(family, families::ALL[0]) => {
                return Err(error.into());
            }
            Err(error) => match left_out.iter_mut().find(|(why, _)| *why == error.to_string()) {
                Some((_, names)) => names.push(family.name),
                None => left_out.push((error.to_string(), vec![family.name])),
            },
        }
    }
    let left_out = left_out.iter().map(|(why, names)| format!("No files for controllers {}: {why}.", names.join(", ")));
    remarks.extend(left_out.map(Remark::from));
    Ok(Part { products, guide, remarks })
}

/// The families that were asked for, or all.
fn chosen(source: &Source<'_>) -> Result<Vec<&'static Family>, MotionError> {
    let names = &source.options.controllers;
    let named = |name: &String| {
        families::by_name(name)
            .ok_or_else(|| MotionError::NoSuchFamily { name: name.clone(), known: families::names() })
    };
    if names.is_empty() {
        return Ok(families::ALL.to_vec());
    }
    let mut chosen: Vec<&'static Family> = names.iter().map(named).collect::<Result<_, _>>()?;
    // Named twice, it is written once.
    let mut seen = HashSet::new();
    chosen.retain(|family| seen.insert(family.name));
    Ok(chosen)
}

/// The files of a family.
fn written(family: &Family, machine: &Machine, trajectory: &Trajectory) -> Result<Vec<Product>, MotionError> {
    let name = |part: &str| {
        let parts = ["controller", family.name, part];
        parts.iter().filter(|part| !part.is_empty()).copied().collect::<Vec<_>>().join("-")
    };
    let mut products = Vec::new();
    if let Some(stream) = family.stream {
        let made = programs(&*stream(machine)?, trajectory, &unconfirmed(family));
        for (part, program) in [("setup", made.setup), ("motion", made.motion), ("stop", made.stop)] {
            let content = Content::Program { program, extension: family.extension };
            products.push(Product::new(name(part), content));
        }
    }
    if let Some(sketches) = family.sketches {
        for Sketch { part, extension, text } in sketches(machine, trajectory)? {
            products.push(Product::new(name(&part), Content::Text { text, extension }));
        }
    }
    Ok(products)
}

fn unconfirmed(family: &Family) -> Vec<String> {
    family.unconfirmed.iter().map(|what| format!("Unconfirmed: {what}.")).collect()
}

/// What holds for all families.
fn how() -> String {
    "  One set of files a family of controllers; take the one for yours. Each has three parts. setup: once, with the plushie at rest and its cables
  just slack; it makes this the zero position and sets the limits of travel; never send it while cable is wound. motion: as often as you
  like, from the rest position; it never sets zero. stop: slowly back to zero, then motors off; send it after the last motion, and after
  one that was broken off.
  Played live by plushwright, replies are read, the time is kept, the winches go back to zero first, and all motors are switched off on any
  fault.
"
    .into()
}

/// The simulated drives, told from the file and live.
fn followed(source: &Source<'_>, machine: &Machine) -> Result<String, MotionError> {
    let words = |[lag_mm, ripple]: [f64; 2]| {
        format!("at most {lag_mm:.2} mm behind or ahead, speed uneven by {:.1} % (rms)", 100.0 * ripple)
    };
    let classic = classic::Classic::new(machine)?;
    let plan = Plan::of(source.design, source.options.too_fast)?;
    let forecast = Forecast::of(&classic, &plan, source.trajectory);
    Ok(format!(
        "  Simulated drives (trapezoids of speed, up to {:.0} s of the motion) that get each step of the file at its time: {}.
  Played live at {} baud with replies after {:.0} ms, a winch every {:.3} s: {}.
",
        Following::most_s(machine),
        words(forecast.file),
        machine.controller.drives.baud,
        1e3 * line::LATENCY_S,
        forecast.slot_s,
        words(forecast.live),
    ))
}

/// Addresses, sending, and what is not known, for one family.
fn family_guide(family: &Family, machine: &Machine, products: &[Product]) -> String {
    let names: Vec<String> = products.iter().map(|p| p.name.clone()).collect();
    let stream = family.stream.and_then(|stream| stream(machine).ok());
    let winches: Vec<String> = machine
        .winches
        .iter()
        .enumerate()
        .map(|(winch, name)| {
            let address =
                stream.as_ref().map_or_else(|| format!("winch {}", winch + 1), |stream| stream.address(winch));
            format!("    {address}: {name}, up to {:.1} mm\n", machine.travel_mm[winch])
        })
        .collect();
    let sending = stream.as_ref().map_or(String::new(), |stream| sending(&**stream, machine));
    let unconfirmed: Vec<String> = unconfirmed(family).iter().map(|line| format!("    {line}\n")).collect();
    let own = match family.name {
        "ascii" => ascii(machine),
        "servo-arduino" => "    Put the file into a folder of its own name, as the Arduino IDE wants it.\n".into(),
        _ => String::new(),
    };
    format!(
        "\n  {}: {}\n    {}\n{}{sending}{own}{}",
        family.name,
        family.title,
        names.join(", "),
        winches.concat(),
        unconfirmed.concat()
    )
}

/// How a host sends the commands of a family.
fn sending(stream: &dyn Stream, machine: &Machine) -> String {
    let order = if stream.moves_together() {
        "one line for all winches".to_owned()
    } else {
        format!(
            "{} commands: what loads the position of the next row for every winch, then what starts each",
            commands_a_step(stream)
        )
    };
    let bytes = if stream.framing().is_binary() { " Frames follow each other without gaps." } else { "" };
    format!(
        "    Send one command at a time and await its reply. Step k begins at time_s of row k of tracks.csv: {order}, so that the drives
    follow without trailing. stop: wait {} s before what switches the motors off.{bytes}
",
        machine.stopping_s()
    )
}

/// What is particular to the classic family: its line, and the limits that its files set.
fn ascii(machine: &Machine) -> String {
    let motor = &machine.controller;
    let current = match motor.drives.current_ma {
        0 => "Set current limits (LPC, LCC) for your motor and gear before you let it pull: the files set none."
            .to_owned(),
        current => format!(
            "setup limits the current to {current} mA (LPC, LCC; controller.drives.current_ma): set it to yours."
        ),
    };
    format!(
        "    8N1, 9600 baud from the factory, Xon/Xoff, node numbers set beforehand; each command ends with a carriage return.
    At most {} rpm and {} rev/s^2 are asked of the motors; AC and DEC are set to their largest value, so that the drives do not trail.
    {current}
",
        motor.speed_rpm, motor.acceleration
    )
}

/// What became of the animation, and where the line is too slow for it.
fn remarks(source: &Source<'_>) -> Vec<Remark> {
    let (design, trajectory) = (source.design, source.trajectory);
    let mut remarks: Vec<Remark> = trajectory.notes.iter().map(|note| worded(note).into()).collect();
    let machine = Machine::new(design, trajectory);
    for (network, travel_mm) in design.networks.iter().zip(&machine.travel_mm) {
        let (name, reach_mm) = (&network.name, winch_reach_mm(design, network));
        if *travel_mm > reach_mm {
            let words = format!(
                "Winch {name:?} winds up to {travel_mm:.1} mm, and its cables are as short as they may be at {reach_mm:.1} mm: work the keyframes out \
                 again, or the motor pulls against itself."
            );
            remarks.push(Remark::from(words).grave());
        } else if *travel_mm == 0.0 && !design.keyframes.is_empty() {
            remarks.push(
                format!(
                    "Winch {name:?} never winds in this animation: switch it off, or work the keyframes out again."
                )
                .into(),
            );
        }
    }
    if let Ok(classic) = classic::Classic::new(&machine) {
        let on_line = commands_a_step(&classic) as f64 * line::carried_s(&machine, line::COMMAND_BYTES);
        let steps = trajectory.times_s.windows(2).map(|times| times[1] - times[0]);
        let shortest = steps.fold(f64::INFINITY, f64::min);
        if on_line > shortest {
            let words = format!(
                "At {} baud a step takes about {:.0} ms on the line with its replies, longer than the {:.0} ms of the shortest step: set a higher \
                 baud rate, or a lower track rate; or play it live, where slow lines get fewer steps.",
                machine.controller.drives.baud,
                1e3 * on_line,
                1e3 * shortest
            );
            remarks.push(words.into());
        }
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
        Note::Jump { winch, from_s, to_s } => format!(
            "From {from_s:.2} s to {to_s:.2} s winch {winch:?} is on its way to the next keyframe, although the one before is held: no motor jumps."
        ),
    }
}
