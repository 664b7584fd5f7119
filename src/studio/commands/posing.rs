//! Commands of posing: symmetry, snapping, kinds of pins, starch.

use super::command::{Command, Keys, Place, Scope};
use crate::design::{Hold, Pin};
use crate::mesh::Axis;
use crate::operations::arrange::Handle;
use crate::outline::polygon;
use crate::studio::acts;
use crate::studio::canvas::Hit;
use crate::studio::change::Change;
use crate::studio::language::{mark, t};
use crate::studio::session::{Selection, Session};
use eframe::egui::Key;

pub static ALL: [&Command; 12] = [
    &BEGIN,
    &SYMMETRIC,
    &SNAP,
    &MIRROR,
    &MIRROR_POSE,
    &SELECT_ALL,
    &PIN_MIDDLE,
    &HOLD_POINT,
    &HOLD_LINE,
    &HOLD_REGION,
    &PIN_HOME,
    &CLEAR_STARCH,
];

pub static BEGIN: Command = Command {
    scope: Scope::Views,
    run: &|session, _| acts::edit::change(session, Change::Begin),
    ..Command::new("pose.begin", "Pins and a first pose", "Hold the middle of the body, and let a limb wave")
};

const NO_AXIS: &str = mark("The outline of this plushie is not its own mirror image");
const NO_PIN: &str = mark("Select a pin first, or point at one");

pub static SYMMETRIC: Command = Command {
    keys: &[Keys::shift(Key::M)],
    scope: Scope::Views,
    on: Some(&|session| session.posing.symmetric),
    why_not: &|session, _| session.posing.axis().is_none().then_some(t(NO_AXIS)),
    run: &|session, _| session.posing.symmetric = !session.posing.symmetric,
    ..Command::new("pose.symmetric", "Symmetric", "What is dragged is dragged on the other side of the body's axis too")
};

pub static SNAP: Command = Command {
    keys: &[Keys::shift(Key::N)],
    scope: Scope::Views,
    on: Some(&|session| session.posing.snaps),
    run: &|session, _| session.posing.snaps = !session.posing.snaps,
    ..Command::new(
        "pose.snap",
        "Snap",
        "Goals fall into line with others, with pins, with their rest and with the axis",
    )
};

pub static MIRROR: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, at| match (session.posing.axis(), chosen(session, at).is_empty()) {
        (None, _) => Some(t(NO_AXIS)),
        (_, true) => Some(t("Select targets or pins first")),
        _ => None,
    },
    run: &|session, at| {
        with_axis(session, |session, axis| {
            let (pose, handles) = (session.pose(), chosen(session, at));
            acts::edit::change(session, Change::Mirror { pose, handles, axis });
        });
    },
    ..Command::new(
        "pose.mirror",
        "Mirror",
        "Add the mirror images of the targets and pins that are selected or pointed at",
    )
};

pub static MIRROR_POSE: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| match (session.posing.axis(), session.pose()) {
        (None, _) => Some(t(NO_AXIS)),
        (_, None) => Some(t("Choose a pose first")),
        _ => None,
    },
    run: &|session, _| {
        with_axis(session, |session, axis| {
            if let Some(pose) = session.pose() {
                acts::edit::change(session, Change::MirrorPose { pose, axis });
            }
        })
    },
    ..Command::new("pose.mirrored", "Mirrored pose", "Add a pose that is the mirror image of this one")
};

pub static SELECT_ALL: Command = Command {
    keys: &[Keys::ctrl(Key::A)],
    scope: Scope::Views,
    why_not: &|session, _| all(session).is_empty().then_some(t("There are no targets and pins")),
    run: &|session, _| {
        let handles = all(session);
        acts::edit::gather(session, handles);
    },
    ..Command::new("pose.all", "Select all", "Pick out all targets of the pose and all pins")
};

pub static PIN_MIDDLE: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    run: &|session, _| acts::edit::change(session, Change::PinMiddle),
    ..Command::new("pin.middle", "Pin the middle", "Hold the middle of the body, so that it can neither move nor turn")
};

pub static HOLD_POINT: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, at| kind_refused(session, at, |hold| matches!(hold, Hold::Point)),
    run: &|session, at| hold(session, at, |_| Hold::Point),
    ..Command::new("pin.point", "Hold the point", "The body may turn about this pin")
};

pub static HOLD_LINE: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, at| kind_refused(session, at, |hold| matches!(hold, Hold::Line { .. })),
    run: &|session, at| hold(session, at, |_| Hold::Line { degrees: 0.0 }),
    ..Command::new("pin.line", "Let it slide", "The body slides along a line through this pin")
};

pub static HOLD_REGION: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, at| kind_refused(session, at, |hold| matches!(hold, Hold::Region { .. })),
    run: &|session, at| hold(session, at, region),
    ..Command::new("pin.region", "Hold its angle", "All around this pin is held, so that the body cannot turn there")
};

pub static PIN_HOME: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, at| match pin(session, at) {
        None => Some(t(NO_PIN)),
        Some((_, pin)) => pin.position.is_none().then_some(t("The pin is where the body is at rest")),
    },
    run: &|session, at| {
        if let Some((index, _)) = pin(session, at) {
            acts::edit::change(session, Change::MovePin { index, to: None });
        }
    },
    ..Command::new("pin.home", "Put pin back", "Hold the body where it is at rest again")
};

pub static CLEAR_STARCH: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| session.design().stiffness_map.is_none().then_some(t("Nothing is starched")),
    run: &|session, _| acts::edit::change(session, Change::ClearStarch),
    ..Command::new("starch.clear", "Clear starch", "Make all of the body as stiff as its material again")
};

/// Radius of a region at first, as a part of the body length.
const REGION: f64 = 0.08;

/// A region of a radius that is easy to read, for the body as it is.
pub fn region(session: &Session) -> Hold {
    let mesh = &session.design().mesh;
    let (low, high) = polygon::bounding_box(&mesh.nodes);
    let length = (high[0] - low[0]).max(high[1] - low[1]);
    Hold::Region { radius_mm: (REGION * length).round().max(1.0), degrees: 0.0 }
}

/// What is picked out together, or else pointed at or selected.
fn chosen(session: &Session, at: Hit) -> Vec<Handle> {
    let group = session.group().handles();
    match at {
        _ if group.len() > 1 => group.to_vec(),
        Hit::Target(index) => vec![Handle::Target(index)],
        Hit::Pin(index) => vec![Handle::Pin(index)],
        _ => Vec::new(),
    }
}

fn all(session: &Session) -> Vec<Handle> {
    let targets = (0..session.targets().len()).map(Handle::Target);
    targets.chain((0..session.design().pins.len()).map(Handle::Pin)).collect()
}

fn with_axis(session: &mut Session, act: impl FnOnce(&mut Session, Axis)) {
    if let Some(axis) = session.posing.axis() {
        act(session, axis);
    }
}

/// The pin that is pointed at or selected.
fn pin(session: &Session, at: Hit) -> Option<(usize, Pin)> {
    let index = match (at, session.selection()) {
        (Hit::Pin(index), _) | (Hit::Nothing, Selection::Pin(index)) => index,
        _ => return None,
    };
    Some((index, *session.design().pins.get(index)?))
}

fn kind_refused(session: &Session, at: Hit, is: fn(&Hold) -> bool) -> Option<&'static str> {
    match pin(session, at) {
        None => Some(t(NO_PIN)),
        Some((_, pin)) => is(&pin.hold).then_some(t("The pin is of that kind")),
    }
}

fn hold(session: &mut Session, at: Hit, of: fn(&Session) -> Hold) {
    if let Some((index, _)) = pin(session, at) {
        let hold = of(session);
        acts::edit::change(session, Change::HoldPin { index, hold });
    }
}
