//! Pins of a design, and targets of one of its poses.
//!
//! What a hand gives in a view is kept to a micrometre ([`at_hand`], [`rounded`]), far below what a hand or a needle can do, so that it
//! is the same as what is read off and typed.

use super::{Cancelled, Context};
use crate::defaults;
use crate::design::edit::{self, EditError};
use crate::design::{Design, Hold, Pin, Pose, Target};
use crate::mesh::{BodyPoint, Mesh, limbs};
use crate::outline::Point;
use serde::{Deserialize, Serialize};

/// How far beside the body a place may lie and still mean the nearest point of the body, in body lengths: what a reading off a
/// picture misses by.
const REACH: f64 = 0.02;
/// Places at hand are whole multiples of this part of a mm.
const STEPS_PER_MM: f64 = 1e3;
/// Places of the body at rest that are nearer than this count as one: far below what anybody types, far above rounding.
const SAME_MM: f64 = 1e-3;

/// Places that are pinned and pulled. They are in mm and mean points of the body at rest.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Name of the pose, which is made where it is missing. Empty: the one that `begin` gives.
    pub name: String,
    /// Places that are held where they are at rest.
    pub pins: Vec<Point>,
    /// Places that are held otherwise than as points.
    pub held: Vec<Held>,
    pub targets: Vec<Move>,
    /// Holds the middle of the body so that it can neither move nor turn.
    pub middle: bool,
    /// Holds the middle where nothing is pinned, and adds a first pose.
    pub begin: bool,
}

/// A point of the body at rest, mm, and how it is held.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Held {
    pub at: Point,
    pub hold: Hold,
}

/// A point of the body at rest and where it should go, mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Move {
    pub from: Point,
    pub to: Point,
}

/// Why a place or a pose was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Adds pins to `design` and targets to one of its poses, whose number it returns. One on a point that has one already replaces it.
///
/// # Errors
/// A place is not on the body, or a name is none; the design is as it was then.
pub fn run(design: &mut Design, options: &Options, context: &Context) -> Result<usize, Error> {
    context.check()?;
    let mut changed = design.clone();
    for &place in &options.pins {
        let at = body_point(&changed.mesh, place)?;
        put_pin(&mut changed, at, Hold::Point)?;
    }
    for held in &options.held {
        let at = body_point(&changed.mesh, held.at)?;
        put_pin(&mut changed, at, held.hold)?;
    }
    if options.middle {
        pin_middle(&mut changed)?;
    }
    let name = options.name.trim();
    let begun = if options.begin { Some(begin(&mut changed)?) } else { None };
    if let Some(pose) = begun.filter(|_| !name.is_empty()) {
        edit::rename_pose(&mut changed, pose, name)?;
    }
    let pose = match begun.or_else(|| changed.poses.iter().position(|p| p.name == name)) {
        Some(pose) => pose,
        None => edit::add_pose(&mut changed, Pose { name: name.to_owned(), targets: Vec::new() })?,
    };
    for &Move { from, to } in &options.targets {
        let at = body_point(&changed.mesh, from)?;
        put_target(&mut changed, pose, Target { at, to, weight: 1.0 })?;
    }
    *design = changed;
    Ok(pose)
}

/// Holds a point of the body where it is at rest, and returns the number of the pin.
///
/// # Errors
/// As [`edit::add_pin`].
pub fn put_pin(design: &mut Design, at: BodyPoint, hold: Hold) -> Result<usize, EditError> {
    place_pin(design, Pin { hold, ..Pin::at_rest(at, defaults::PIN_STIFFNESS) })
}

/// Holds the place of the body that is farthest from its seam, within half that distance, so that it can neither move nor turn. The number of
/// the pin.
///
/// # Errors
/// A design without a mesh.
pub fn pin_middle(design: &mut Design) -> Result<usize, EditError> {
    let mesh = &design.mesh;
    let rim: Vec<usize> = mesh.boundary().into_iter().flatten().collect();
    let from_seam = |n: usize| {
        let [x, y] = mesh.nodes[n];
        rim.iter().map(|&r| (mesh.nodes[r][0] - x).hypot(mesh.nodes[r][1] - y)).fold(f64::INFINITY, f64::min)
    };
    let inner = (0..mesh.nodes.len()).map(|n| (n, from_seam(n)));
    let Some((node, far)) = inner.max_by(|a, b| a.1.total_cmp(&b.1)) else {
        return Err(EditError::NoBody { place: [0.0; 2] });
    };
    let at = mesh.node_point(node).ok_or(EditError::NoBody { place: mesh.nodes[node] })?;
    let radius_mm = (0.5 * far * STEPS_PER_MM).round() / STEPS_PER_MM;
    put_pin(design, at, Hold::Region { radius_mm, degrees: 0.0 })
}

/// Begins with a body that nobody has posed yet: holds its middle where nothing is pinned, and adds a pose in which the slenderest limb
/// waves. The number of the pose.
///
/// # Errors
/// A design without a mesh.
pub fn begin(design: &mut Design) -> Result<usize, EditError> {
    if design.pins.is_empty() {
        pin_middle(design)?;
    }
    let mesh = &design.mesh;
    let held = design.pins[0].anchor(mesh);
    let tip = limbs::tip(mesh, held).ok_or(EditError::NoBody { place: held })?;
    let place = mesh.nodes[tip];
    let at = mesh.node_point(tip).ok_or(EditError::NoBody { place })?;
    let [dx, dy] = [place[0] - held[0], place[1] - held[1]];
    // Upwards, as one waves.
    let (sin, cos) = WAVE_DEGREES.copysign(dx).to_radians().sin_cos();
    let to = rounded([held[0] + cos * dx - sin * dy, held[1] + sin * dx + cos * dy]);
    let name = edit::unused_pose_name(design, "Wave");
    edit::add_pose(design, Pose { name, targets: vec![Target { at, to, weight: 1.0 }] })
}

/// How far the tip of a limb turns about what holds it in its first pose: enough to be seen, little enough to be reached.
const WAVE_DEGREES: f64 = 12.0;

/// Puts a pin in, in the place of one on the same point of the body, and returns its number.
pub(super) fn place_pin(design: &mut Design, pin: Pin) -> Result<usize, EditError> {
    match design.pins.iter().position(|old| is_same(&design.mesh, &old.at, &pin.at)) {
        Some(index) => edit::set_pin(design, index, pin).map(|()| index),
        None => edit::add_pin(design, pin),
    }
}

/// Pulls a point of the body in a pose, and returns the number of the target.
///
/// # Errors
/// As [`edit::add_target`].
pub fn put_target(design: &mut Design, pose: usize, target: Target) -> Result<usize, EditError> {
    let targets = design.poses.get(pose).map_or(&[][..], |pose| &pose.targets);
    match targets.iter().position(|old| is_same(&design.mesh, &old.at, &target.at)) {
        Some(index) => edit::set_target(design, pose, index, target).map(|()| index),
        None => edit::add_target(design, pose, target),
    }
}

/// A place to the micrometre, mm. A number with up to three decimals stays itself, bit for bit.
pub fn rounded(place: Point) -> Point {
    place.map(|v| (v * STEPS_PER_MM).round() / STEPS_PER_MM)
}

/// The point of the body whose place at rest is that of `at` to the micrometre.
pub fn at_hand(mesh: &Mesh, at: &BodyPoint) -> BodyPoint {
    let place = rounded(mesh.position(at, &mesh.nodes));
    mesh.locate_nearest(place, &mesh.nodes).map_or(*at, |(at, _)| at)
}

/// The point of the body at rest that a place means.
///
/// # Errors
/// [`EditError::OffBody`], [`EditError::NoBody`].
pub(super) fn body_point(mesh: &Mesh, place: Point) -> Result<BodyPoint, EditError> {
    match mesh.locate_nearest(place, &mesh.nodes) {
        Some((at, distance)) if distance <= REACH * mesh.body_length() => Ok(at),
        Some((at, _)) => Err(EditError::OffBody { place, nearest: mesh.position(&at, &mesh.nodes) }),
        None => Err(EditError::NoBody { place }),
    }
}

/// Whether two points of the body are one place at rest.
pub(super) fn is_same(mesh: &Mesh, a: &BodyPoint, b: &BodyPoint) -> bool {
    let (p, q) = (mesh.position(a, &mesh.nodes), mesh.position(b, &mesh.nodes));
    (p[0] - q[0]).hypot(p[1] - q[1]) < SAME_MM
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    fn options(pins: &[Point], targets: &[Move]) -> Options {
        Options { name: " wave ".into(), pins: pins.to_vec(), targets: targets.to_vec(), ..Options::default() }
    }

    #[test]
    fn a_pose_is_made_and_what_is_on_a_point_replaced() {
        let mut design = testing::sample();
        let go = AtomicBool::new(false);
        let up = |to: Point| options(&[[0.0, 0.0], [-0.5, 60.0]], &[Move { from: [50.0, 60.0], to }]);
        run(&mut design, &up([50.0, 70.0]), &Context::new(&go)).unwrap();
        let once = design.clone();
        // One of the pins was there.
        assert_eq!((design.pins.len(), design.poses.len(), design.poses[2].name.as_str()), (2, 3, "wave"));
        run(&mut design, &up([50.0, 80.0]), &Context::new(&go)).unwrap();
        assert_eq!(design.poses[2].targets[0].to, [50.0, 80.0]);
        run(&mut design, &up([50.0, 70.0]), &Context::new(&go)).unwrap();
        assert_eq!(design, once);
    }

    #[test]
    fn what_is_refused_changes_nothing() {
        let mut design = testing::sample();
        let before = design.clone();
        let go = AtomicBool::new(false);
        let beside = options(&[[0.0, 0.0], [70.0, 10.0]], &[]);
        let refused = run(&mut design, &beside, &Context::new(&go));
        assert_eq!(refused, Err(EditError::OffBody { place: [70.0, 10.0], nearest: [60.0, 10.0] }.into()));
        let nameless = run(&mut design, &Options::default(), &Context::new(&go));
        assert!(matches!(nameless, Err(Error::Edit(EditError::NoName(_)))));
        let stopped = run(&mut design, &options(&[[0.0, 0.0]], &[]), &Context::new(&AtomicBool::new(true)));
        assert_eq!(stopped, Err(Error::Cancelled(Cancelled)));
        assert_eq!(design, before);
    }

    #[test]
    fn what_a_hand_gives_can_be_read_off_and_typed() {
        let mesh = testing::sample().mesh;
        for k in 1..40 {
            let t = f64::from(k) / 40.3;
            // Inside, and on the rim of the body.
            for weights in [[t, 0.3 * (1.0 - t), 0.7 * (1.0 - t)], [t, 1.0 - t, 0.0]] {
                let at = at_hand(&mesh, &BodyPoint { triangle: k as usize % 4, weights });
                let typed = mesh.position(&at, &mesh.nodes).map(|v| format!("{v:.3}").parse::<f64>().unwrap());
                assert_eq!(body_point(&mesh, typed), Ok(at));
                assert_eq!(at_hand(&mesh, &at), at);
            }
        }
        assert_eq!(rounded([67.0, 214.345]), [67.0, 214.345]);
        assert_eq!(rounded([0.1, -36.0004999]), [0.1, -36.0]);
    }
}
