//! Motors that are driven live.

use crate::live::{Order, Status};
use crate::motion::{Machine, Trajectory};
use crate::operations::play;
use crate::studio::language::tf;
use crate::studio::session::{Mode, Session};
use crate::studio::words;

/// Opens the line that was chosen; the motors stay off.
pub fn connect(session: &mut Session) {
    session.motors.remote = None;
    let (design, wake) = (session.design().clone(), session.jobs.wake());
    let choice = session.motors.choice.clone();
    let acting = design.acting();
    let travel = Trajectory::of(&acting, choice.too_fast).map(|t| Machine::new(&acting, &t).travel_mm);
    match (play::remote(&design, &choice, move || wake()), travel) {
        (Ok(remote), Ok(travel_mm)) => session.motors.begin(design.clone(), travel_mm, remote),
        (Err(error), _) => session.messages.error(words::unplayed(&error)),
        (_, Err(error)) => session.messages.error(words::unplayed(&error.into())),
    }
}

/// Switches all motors off and closes the line.
pub fn stop(session: &mut Session) {
    if let Some(remote) = &session.motors.remote {
        remote.stop();
    }
}

/// Gives the motors an order.
pub fn order(session: &mut Session, order: Order) {
    if let Some(remote) = &session.motors.remote {
        // What is asked for from now on counts from the new zero, though it be not set yet.
        let zeros = if order == Order::SetZero { session.motors.travel_mm().len() } else { 0 };
        session.motors.asked_mm = vec![0.0; zeros];
        remote.order(order);
    }
}

/// Winds one winch by hand, within its travel.
pub fn wind(session: &mut Session, winch: usize, length_mm: f64) {
    let motors = &mut session.motors;
    let mut asked_mm = motors.asked_mm();
    let (Some(remote), Some(&travel), Some(asked)) =
        (&motors.remote, motors.travel_mm().get(winch), asked_mm.get_mut(winch))
    else {
        return;
    };
    *asked = length_mm.clamp(0.0, travel);
    // One that stands beyond its travel goes back to it.
    asked_mm.iter_mut().zip(motors.travel_mm()).for_each(|(asked, travel)| *asked = asked.clamp(0.0, *travel));
    remote.order(Order::Wind(asked_mm.clone()));
    motors.asked_mm = asked_mm;
}

/// Once a frame: the window is there; the views show what is played; what ended is told.
pub fn follow(session: &mut Session) {
    let Some(remote) = &session.motors.remote else { return };
    remote.seen();
    match remote.status() {
        Status::Playing { lengths_mm, .. } => show(session, &lengths_mm),
        Status::Ended { why, wanted } => {
            session.motors.remote = None;
            if wanted {
                session.messages.info(tf!("Motors: {why}.", why));
            } else {
                session.messages.error(tf!("Motors: {why}.", why));
            }
        }
        Status::Connecting | Status::Ready(_) | Status::Zeroing | Status::Checking | Status::Homing => {}
    }
}

/// The plushies as the motors are told to have them, while the networks are those of the motors. Networks that are switched off are not among them.
fn show(session: &mut Session, lengths_mm: &[f64]) {
    let design = session.design().clone();
    if !session.motors.winds(&design) {
        return;
    }
    let mut lengths = lengths_mm.iter();
    let wound: Vec<f64> =
        design.networks.iter().map(|n| if n.muted { 0.0 } else { lengths.next().copied().unwrap_or(0.0) }).collect();
    session.winding.begin(&design, &wound);
    session.playback.playing = false;
    session.discovery.shown = None;
    session.picked.mode = Mode::Winding;
}
