//! Commands of motors that are driven live.

use super::command::{Command, Scope};
use crate::live::Order;
use crate::studio::acts;
use crate::studio::language::t;
use crate::studio::session::Session;

pub static ALL: [&Command; 5] = [&CONNECT, &SET_ZERO, &PLAY, &HOME, &STOP];

pub static CONNECT: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| match session.motors().remote.is_some() {
        true => Some(t("The line is open; stop first")),
        false => session.design().networks.is_empty().then_some(t("The design has no winches yet")),
    },
    run: &|session, _| acts::motors::connect(session),
    ..Command::new("motors.connect", "Connect", "Open the line to the motor controllers; no motor moves")
};

pub static SET_ZERO: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| not_ready(session),
    run: &|session, _| acts::motors::order(session, Order::SetZero),
    ..Command::new(
        "motors.zero",
        "Set zero",
        "Tell the controllers that here is zero, and their limits: only at rest, with all cables just slack",
    )
};

pub static PLAY: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| not_ready(session),
    run: &|session, _| acts::motors::order(session, Order::Play),
    ..Command::new(
        "motors.play",
        "Play on motors",
        "Wind back to zero, play the animation on the motors, and back again",
    )
};

pub static HOME: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| not_ready(session),
    run: &|session, _| acts::motors::order(session, Order::Home),
    ..Command::new(
        "motors.home",
        "Back to zero",
        "Wind all cables back to just slack, slowly, then switch the motors off",
    )
};

pub static STOP: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| session.motors().remote.is_none().then_some(t("No line to motors is open")),
    run: &|session, _| acts::motors::stop(session),
    ..Command::new("motors.stop", "Stop motors", "Switch all motors off at once and close the line; Escape does it too")
};

fn not_ready(session: &Session) -> Option<&'static str> {
    let motors = session.motors();
    if motors.remote.is_none() {
        Some(t("Connect first"))
    } else if motors.is_stale(session.design()) {
        Some(t("The motion has changed since the line was opened: stop, and connect again"))
    } else {
        (!motors.is_ready()).then_some(t("The motors are busy"))
    }
}
