//! What makes a document sound: every index in range, every figure in its range ([`ranges`]), names unambiguous and fit to be
//! shown, no more of anything than can be worked on.
//!
//! The rest of the program relies on it and does not check again. An error names the place as a path into the file
//! (`pins[1].at.triangle`), 0-based, and what is wrong there.

use super::fault::{Check, DesignError, Fault, at_least, fail, finite, require, same_length};
use super::ranges::{self, Range, at_most};
use super::{
    Design, DriveSettings, FORMAT_VERSION, FiberSet, Keyframe, MaterialPoint, Network, Pin, Pose, Target, Tendon, Term,
};
use super::{Easing, Hold};
use crate::files::is_hidden;
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::{Point, polygon::signed_area};
use crate::sewing::Rules;
use std::collections::HashSet;

/// Longest name of a design, pose or network, characters: what a file name has room for.
pub const MAX_NAME_CHARS: usize = 255;
/// Longest path of a texture, characters: that of the systems.
const MAX_PATH_CHARS: usize = 4096;
/// What activations are measured by on bodies larger than it, mm.
const METRE_MM: f64 = 1000.0;
/// How far the weights of a body point may sum from 1, dimensionless: a file written by hand with six decimals passes.
pub const WEIGHT_SUM_TOLERANCE: f64 = 1e-6;
/// How far below zero a weight of a body point may be, dimensionless: room for rounding where a point lies on an edge.
pub const WEIGHT_TOLERANCE: f64 = 1e-9;

impl Design {
    /// Checks the whole document; the first fault found, the body first. The cost is that of [`Mesh::validate`].
    ///
    /// # Errors
    /// [`DesignError`]: the place of the first fault, and what is wrong there.
    pub fn validate(&self) -> Result<(), DesignError> {
        if self.version == 0 || self.version > FORMAT_VERSION {
            return fail("version", Fault::Version { found: self.version });
        }
        outline(self)?;
        mesh(&self.mesh)?;
        self.validate_beside_body()
    }

    /// Everything but outline and mesh, which hardly any edit touches. Linear in the document's size.
    pub(super) fn validate_beside_body(&self) -> Result<(), DesignError> {
        settings(self)?;
        shown_name("name", &self.name, false)?;
        at_most("pins", self.pins.len(), ranges::MAX_PINS, "pins")?;
        for (i, p) in self.pins.iter().enumerate() {
            pin(&format!("pins[{i}]"), &self.mesh, p)?;
        }
        poses(&self.mesh, &self.poses)?;
        at_most("networks", self.networks.len(), ranges::MAX_NETWORKS, "networks")?;
        for (i, n) in self.networks.iter().enumerate() {
            network(&format!("networks[{i}]"), &self.mesh, n)?;
        }
        keyframes(self)
    }
}

fn outline(design: &Design) -> Check {
    let points = design.outline.polygons().map(<[Point]>::len).sum();
    at_most("outline", points, ranges::MAX_OUTLINE_POINTS, "points")?;
    let area = polygon("outline.outer", &design.outline.outer)?;
    require(area > 0.0, "outline.outer", || Fault::OuterPolygon(area))?;
    for (i, hole) in design.outline.holes.iter().enumerate() {
        let at = format!("outline.holes[{i}]");
        let area = polygon(&at, hole)?;
        require(area < 0.0, &at, || Fault::HolePolygon(area))?;
    }
    Ok(())
}

/// Signed area of a polygon, mm^2, after checking that it has one.
fn polygon(at: &str, points: &[Point]) -> Result<f64, DesignError> {
    at_least(at, points.len(), 3, "points")?;
    for (i, p) in points.iter().enumerate() {
        coordinates(&format!("{at}[{i}]"), p, &ranges::COORDINATE)?;
    }
    Ok(signed_area(points))
}

fn mesh(mesh: &Mesh) -> Check {
    at_least("mesh.nodes", mesh.nodes.len(), 3, "nodes")?;
    at_least("mesh.triangles", mesh.triangles.len(), 1, "triangles")?;
    for (i, p) in mesh.nodes.iter().enumerate() {
        coordinates(&format!("mesh.nodes[{i}]"), p, &ranges::COORDINATE)?;
    }
    ranges::BODY.check("mesh.nodes", mesh.body_length())?;
    at_most("mesh.triangles", mesh.triangles.len(), ranges::MAX_TRIANGLES, "triangles")?;
    for (i, corners) in mesh.triangles.iter().enumerate() {
        let at = format!("mesh.triangles[{i}]");
        for &n in corners {
            node(&at, mesh, n)?;
        }
        let [a, b, c] = corners.map(|n| mesh.nodes[n]);
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        require(area > 0.0 && area.is_finite(), &at, || Fault::Triangle(area))?;
    }
    // What the mesh as a whole must be: one piece, no overlaps, every node used.
    mesh.validate().or_else(|error| fail("mesh", Fault::Mesh(error)))
}

/// Everything about a design's settings; used by the edits as well.
pub(super) fn settings(design: &Design) -> Check {
    ranges::parameters("material", &design.material)?;
    let fibers = &design.fibers;
    if let FiberSet::Routings(routings) = &fibers.set {
        for (i, r) in routings.iter().enumerate() {
            routing(&format!("fibers.set[{i}]"), &design.mesh, r)?;
        }
    }
    ranges::FIBER_STIFFNESS.check("fibers.stiffness", fibers.stiffness)?;
    ranges::FIBER_EPSILON.check("fibers.epsilon_fraction", fibers.epsilon_fraction)?;
    ranges::FIBER_CONTRACTION.check("fibers.max_contraction", fibers.max_contraction)?;
    ranges::TENDON_STIFFNESS.check("tendons.stiffness", design.tendons.stiffness)?;
    ranges::TENDON_EPSILON.check("tendons.epsilon_mm", design.tendons.epsilon_mm)?;
    ranges::TENDON_CONTRACTION.check("tendons.max_contraction", design.tendons.max_contraction)?;
    ranges::FRICTION.check("tendons.friction", design.tendons.friction)?;
    made(design)?;
    if let Some(gravity) = &design.gravity {
        ranges::parameters("gravity", &Term::from(*gravity))?;
    }
    for (i, term) in design.terms.iter().enumerate() {
        let at = format!("terms[{i}]");
        ranges::parameters(&at, term)?;
        let before = design.all_terms().iter().filter(|other| other.kind().name == term.kind().name).count();
        require(before == 1, &at, || Fault::Duplicate { what: "term", name: term.kind().name.into() })?;
    }
    if let Some(map) = &design.stiffness_map {
        same_length("stiffness_map", map.len(), design.mesh.triangles.len(), "triangles")?;
        for (i, &factor) in map.iter().enumerate() {
            ranges::STIFFNESS_FACTOR.check(&format!("stiffness_map[{i}]"), factor)?;
        }
    }
    if let Some(drawing) = &design.drawing {
        drawing.check().or_else(|(at, why)| fail(format!("drawing.{at}"), Fault::Drawing(why)))?;
    }
    if let Some([low, high]) = &design.texture_box {
        coordinates("texture_box[0]", low, &ranges::POSITION)?;
        coordinates("texture_box[1]", high, &ranges::POSITION)?;
        (0..2).try_for_each(|axis| ranges::TEXTURE_SIZE.check("texture_box", high[axis] - low[axis]))?;
    }
    match &design.texture {
        Some(path) => shown_text("texture", path, MAX_PATH_CHARS, true),
        None => Ok(()),
    }
}

/// What is made: felt, spools, motors.
fn made(design: &Design) -> Check {
    let made = &design.fabrication;
    ranges::SEAM_ALLOWANCE.check("fabrication.seam_allowance_mm", made.seam_allowance_mm)?;
    ranges::TENDON_HOLE.check("fabrication.tendon_hole_mm", made.tendon_hole_mm)?;
    ranges::TURNING_GAP.check("fabrication.turning_gap_mm", made.turning_gap_mm)?;
    ranges::SPOOL_RADIUS.check("fabrication.spool_radius_mm", made.spool_radius_mm)?;
    let motor = &design.controller;
    ranges::ENCODER_LINES.check("controller.encoder_lines", f64::from(motor.encoder_lines))?;
    ranges::GEAR_RATIO.check("controller.gear_ratio", motor.gear_ratio)?;
    ranges::TRACK_RATE.check("controller.track_rate_hz", motor.track_rate_hz)?;
    ranges::SPEED.check("controller.speed_rpm", f64::from(motor.speed_rpm))?;
    ranges::MOTOR_ACCELERATION.check("controller.acceleration", f64::from(motor.acceleration))?;
    ranges::MOTOR_TORQUE.check("controller.torque_nmm", motor.torque_nmm)?;
    drives(&motor.drives)?;
    sewing(&design.sewing)
}

/// What single families of controllers are told.
fn drives(drives: &DriveSettings) -> Check {
    ranges::BAUD.check("controller.drives.baud", f64::from(drives.baud))?;
    ranges::CURRENT.check("controller.drives.current_ma", f64::from(drives.current_ma))?;
    ranges::DELAY_UNIT.check("controller.drives.delay_unit_s", drives.delay_unit_s)?;
    ranges::SCRIPT_DELAY_UNIT.check("controller.drives.script_delay_unit_s", drives.script_delay_unit_s)?;
    let following = f64::from(drives.following_acceleration);
    ranges::FOLLOWING.check("controller.drives.following_acceleration", following)?;
    ranges::SERVO_DEGREES.check("controller.drives.servo_degrees", drives.servo_degrees)?;
    ranges::SERVO_LOW.check("controller.drives.servo_low_us", f64::from(drives.servo_low_us))?;
    ranges::SERVO_HIGH.check("controller.drives.servo_high_us", f64::from(drives.servo_high_us))?;
    ranges::STEPS_PER_TURN.check("controller.drives.steps_per_turn", drives.steps_per_turn)
}

/// What a hand is to sew.
fn sewing(rules: &Rules) -> Check {
    ranges::HOLE_TO_SEAM.check("sewing.hole_to_seam_mm", rules.hole_to_seam_mm)?;
    ranges::HOLE_TO_HOLE.check("sewing.hole_to_hole_mm", rules.hole_to_hole_mm)?;
    ranges::MOST_HOLES.check("sewing.most_holes", rules.most_holes as f64)?;
    ranges::TURN.check("sewing.turn_degrees", rules.turn_degrees)?;
    ranges::TURNING.check("sewing.turning_degrees", rules.turning_degrees)?;
    ranges::BESIDE.check("sewing.beside_mm", rules.beside_mm)?;
    ranges::ALONG.check("sewing.along_mm", rules.along_mm)?;
    ranges::LEAD.check("sewing.lead_mm", rules.lead_mm)?;
    ranges::HOUSING.check("sewing.housing_mm", rules.housing_mm)?;
    ranges::BETWEEN_HOUSINGS.check("sewing.between_housings_mm", rules.between_housings_mm)
}

fn poses(mesh: &Mesh, poses: &[Pose]) -> Check {
    let mut names = HashSet::new();
    at_most("poses", poses.len(), ranges::MAX_POSES, "poses")?;
    for (i, p) in poses.iter().enumerate() {
        let at = format!("poses[{i}]");
        pose(&at, mesh, p)?;
        require(names.insert(p.name.as_str()), &format!("{at}.name"), || Fault::Duplicate {
            what: "pose",
            name: p.name.clone(),
        })?;
    }
    Ok(())
}

fn keyframes(design: &Design) -> Check {
    let mut before: Option<f64> = None;
    at_most("keyframes", design.keyframes.len(), ranges::MAX_KEYFRAMES, "keyframes")?;
    for (i, k) in design.keyframes.iter().enumerate() {
        let at = format!("keyframes[{i}]");
        keyframe(&at, design, k)?;
        if let Some(before) = before.filter(|&before| k.time_s <= before) {
            return fail(format!("{at}.time_s"), Fault::NotAscending { time: k.time_s, before });
        }
        before = Some(k.time_s);
    }
    Ok(())
}

pub(super) fn pin(at: &str, mesh: &Mesh, pin: &Pin) -> Check {
    body_point(&format!("{at}.at"), mesh, &pin.at)?;
    if let Some(position) = &pin.position {
        coordinates(&format!("{at}.position"), position, &ranges::POSITION)?;
    }
    match pin.hold {
        Hold::Point => {}
        Hold::Line { degrees } => ranges::PIN_ANGLE.check(&format!("{at}.hold.degrees"), degrees)?,
        Hold::Region { radius_mm, degrees } => {
            ranges::PIN_RADIUS.check(&format!("{at}.hold.radius_mm"), radius_mm)?;
            ranges::PIN_ANGLE.check(&format!("{at}.hold.degrees"), degrees)?;
        }
    }
    ranges::PIN_STIFFNESS.check(&format!("{at}.stiffness"), pin.stiffness)
}

pub(super) fn pose(at: &str, mesh: &Mesh, pose: &Pose) -> Check {
    shown_name(&format!("{at}.name"), &pose.name, true)?;
    at_most(&format!("{at}.targets"), pose.targets.len(), ranges::MAX_TARGETS, "targets")?;
    for (i, t) in pose.targets.iter().enumerate() {
        target(&format!("{at}.targets[{i}]"), mesh, t)?;
    }
    Ok(())
}

pub(super) fn target(at: &str, mesh: &Mesh, target: &Target) -> Check {
    body_point(&format!("{at}.at"), mesh, &target.at)?;
    coordinates(&format!("{at}.to"), &target.to, &ranges::POSITION)?;
    ranges::WEIGHT.check(&format!("{at}.weight"), target.weight)
}

/// Network names may repeat or be empty: nothing refers to them, and exports make their own labels.
pub(super) fn network(at: &str, mesh: &Mesh, network: &Network) -> Check {
    shown_name(&format!("{at}.name"), &network.name, false)?;
    at_least(&format!("{at}.tendons"), network.tendons.len(), 1, "tendons")?;
    at_most(&format!("{at}.tendons"), network.tendons.len(), ranges::MAX_TENDONS, "tendons")?;
    let mut winch = None;
    for (i, Tendon { routing: points, ratio, slack_mm }) in network.tendons.iter().enumerate() {
        let at = format!("{at}.tendons[{i}]");
        cable(&format!("{at}.routing"), mesh, points)?;
        let (found, winch) = (&points[0], *winch.get_or_insert(&points[0]));
        require(found == winch, &format!("{at}.routing"), || Fault::OtherWinch {
            found: found.clone(),
            winch: winch.clone(),
        })?;
        ranges::RATIO.check(&format!("{at}.ratio"), *ratio)?;
        ranges::SLACK.check(&format!("{at}.slack_mm"), *slack_mm)?;
    }
    Ok(())
}

pub(super) fn keyframe(at: &str, design: &Design, keyframe: &Keyframe) -> Check {
    ranges::TIME.check(&format!("{at}.time_s"), keyframe.time_s)?;
    let activations = &keyframe.activations_mm;
    same_length(&format!("{at}.activations_mm"), activations.len(), design.networks.len(), "networks")?;
    // A body of many metres has cables of many metres.
    let size = (design.body_length_mm() / METRE_MM).max(1.0);
    for (i, &a) in activations.iter().enumerate() {
        ranges::ACTIVATION.check_scaled(&format!("{at}.activations_mm[{i}]"), a, size)?;
    }
    if let Easing::Slow { out, into } = keyframe.easing {
        ranges::EASE.check(&format!("{at}.easing.out"), out)?;
        ranges::EASE.check(&format!("{at}.easing.into"), into)?;
    }
    if let Some(name) = &keyframe.pose {
        shown_name(&format!("{at}.pose"), name, true)?;
    }
    match &keyframe.pose {
        Some(name) if !design.poses.iter().any(|p| p.name == *name) => {
            fail(format!("{at}.pose"), Fault::UnknownPose(name.clone()))
        }
        _ => Ok(()),
    }
}

fn cable(at: &str, mesh: &Mesh, points: &[MaterialPoint]) -> Check {
    at_least(at, points.len(), 2, "points")?;
    at_most(at, points.len(), ranges::MAX_ROUTING, "points")?;
    for (i, point) in points.iter().enumerate() {
        material_point(&format!("{at}[{i}]"), mesh, point)?;
    }
    let repeated = |i: &usize| points[*i].place(&mesh.nodes) == points[i - 1].place(&mesh.nodes);
    match (1..points.len()).find(repeated) {
        Some(i) => fail(format!("{at}[{i}]"), Fault::RepeatedPoint(points[i].clone())),
        None => Ok(()),
    }
}

fn material_point(at: &str, mesh: &Mesh, point: &MaterialPoint) -> Check {
    match point {
        MaterialPoint::Node(n) => node(at, mesh, *n),
        MaterialPoint::Inside(carriers) => {
            for (i, &n) in carriers.nodes.iter().enumerate() {
                node(&format!("{at}.nodes[{i}]"), mesh, n)?;
            }
            // From any corner, in the order of the mesh.
            let turns = |t: &[usize; 3]| (0..3).any(|k| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]] == carriers.nodes);
            let known = mesh.triangles.iter().any(turns);
            require(known, &format!("{at}.nodes"), || Fault::NoTriangle(carriers.nodes))?;
            weights(at, &carriers.weights)
        }
    }
}

fn routing(at: &str, mesh: &Mesh, nodes: &[usize]) -> Check {
    at_least(at, nodes.len(), 2, "nodes")?;
    at_most(at, nodes.len(), ranges::MAX_ROUTING, "nodes")?;
    for (i, &n) in nodes.iter().enumerate() {
        node(&format!("{at}[{i}]"), mesh, n)?;
    }
    match (1..nodes.len()).find(|&i| nodes[i] == nodes[i - 1]) {
        Some(i) => fail(format!("{at}[{i}]"), Fault::RepeatedNode(nodes[i])),
        None => Ok(()),
    }
}

fn body_point(at: &str, mesh: &Mesh, p: &BodyPoint) -> Check {
    let len = mesh.triangles.len();
    require(p.triangle < len, &format!("{at}.triangle"), || Fault::OutOfRange {
        index: p.triangle,
        len,
        what: "triangles",
    })?;
    weights(at, &p.weights)
}

fn weights(at: &str, weights: &[f64; 3]) -> Check {
    for (i, &w) in weights.iter().enumerate() {
        let at = format!("{at}.weights[{i}]");
        finite(&at, w)?;
        require(w >= -WEIGHT_TOLERANCE, &at, || Fault::Negative(w))?;
    }
    let sum: f64 = weights.iter().sum();
    require((sum - 1.0).abs() <= WEIGHT_SUM_TOLERANCE, &format!("{at}.weights"), || Fault::WeightSum(sum))
}

fn node(at: &str, mesh: &Mesh, index: usize) -> Check {
    let len = mesh.nodes.len();
    require(index < len, at, || Fault::OutOfRange { index, len, what: "nodes" })
}

fn coordinates(at: &str, p: &Point, range: &Range) -> Check {
    p.iter().try_for_each(|&v| range.check(at, v))
}

/// A name that people see: of a bounded length, and without characters that a terminal or a table obeys instead of showing them.
fn shown_name(at: &str, name: &str, needed: bool) -> Check {
    shown_text(at, name, MAX_NAME_CHARS, needed)
}

fn shown_text(at: &str, text: &str, most: usize, needed: bool) -> Check {
    require(!needed || !text.trim().is_empty(), at, || Fault::Empty)?;
    // Bytes first: they are counted already.
    let found = if text.len() <= most { 0 } else { text.chars().count() };
    at_most(at, found, most, "characters")?;
    match text.chars().find(|&c| is_hidden(c)) {
        Some(c) => fail(at, Fault::Hidden(u32::from(c))),
        None => Ok(()),
    }
}
