//! A drag frame by frame: `cargo run --release --example drag`.
//!
//! The muscle fibres of the pig follow a hand that moves one of its points on a circle. Every frame has a bounded cost; what it shows is a
//! state in which forces balance.

use plushwright::design::{Target, bundled};
use plushwright::engine::compile::{View, compile, objective};
use plushwright::soft_ik::{Actuation, Quality, Question, Tracker};
use std::error::Error;
use std::f64::consts::TAU;

fn main() -> Result<(), Box<dyn Error>> {
    run()
}

/// Drags, and prints every tenth frame.
///
/// # Errors
/// A design that is not there or does not compile.
pub fn run() -> Result<(), Box<dyn Error>> {
    let design =
        bundled::ALL.iter().find(|bundled| bundled.name.eq_ignore_ascii_case("pig")).ok_or("no pig")?.design()?;
    let mut plushie = compile(&design, View::Idealized)?;
    let hand: Vec<Target> = design.poses[0].targets.iter().take(1).copied().collect();
    let mut objective = objective(&design, &plushie, &hand);
    let home = design.mesh.position(&hand[0].at, &design.mesh.nodes);
    // Every fibre by itself; nothing else is wound.
    let actuation = Actuation { winches: plushie.fibers.clone(), fixed: vec![0.0; plushie.fiber_elements.end] };

    let rest = plushie.model.rest.clone();
    let mut question = Question { model: &mut plushie.model, actuation: &actuation, objective: &objective };
    let (start, _) = question.settle(&vec![0.0; actuation.winches.len()], &rest, &|| false);
    let mut tracker = Tracker::new(&mut question, &start);

    let radius = 0.1 * design.body_length_mm();
    for frame in 0..60 {
        let angle = TAU * f64::from(frame) / 60.0;
        objective.targets[0].goal = [home[0] + radius * (angle.cos() - 1.0), home[1] + radius * angle.sin()];
        let mut question = Question { model: &mut plushie.model, actuation: &actuation, objective: &objective };
        tracker.frame(&mut question, Quality::Balanced, &|| false);
        let posture = tracker.posture();
        let [x, y] = objective.targets[0].offset(&posture.x);
        let off = x.hypot(y);
        if frame % 10 == 0 {
            println!("frame {frame}: the point is {off:.2} mm from the hand");
        }
    }
    Ok(())
}
