//! Random designs under random edits: what is undone comes back bit for bit, what is shown is a body.

use crate::design::{
    Design, Easing, EditError, Gravity, History, Keyframe, Material, MaterialPoint, Network, Pin, Pose, Target, Tendon,
    edit, file,
};
use crate::engine::{Request, Setpoint, Shape, Solver};
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::Outline;
use crate::physics::terms::GRAVITY;
use crate::physics::{NeoHookean, StVenantKirchhoff};
use crate::random::Random;
use crate::soft_ik::Quality;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Edits of a sequence.
const EDITS: usize = 40;
/// After so many edits the worker is asked for a picture.
const SHOWN_EVERY: usize = 10;

/// A sequence of edits; what is wrong with what came of it is the error. Returns how many edits took effect.
///
/// # Errors
/// What was violated, in words.
pub fn sequence(seed: u64, number: u64) -> Result<usize, String> {
    let run = catch_unwind(AssertUnwindSafe(|| run(Random::of(seed, "design", number))));
    run.map_err(|_| "panic".to_owned())?
}

fn run(mut random: Random) -> Result<usize, String> {
    let mut history = History::new(plain(1 + random.index(4), 1 + random.index(3)));
    let mut states = vec![text(history.current())?];
    let mut solver = Solver::default();
    for step in 0..EDITS {
        if random.index(4) == 0 {
            history.begin("gesture");
            for _ in 0..random.index(4) {
                let _ = history.preview(|design| change(&mut random, design));
            }
            if random.index(4) == 0 {
                history.cancel();
            } else {
                history.commit();
            }
        } else {
            let _ = history.edit("edit", |design| change(&mut random, design));
        }
        history.current().validate().map_err(|e| format!("edit {step} left an unsound design: {e}"))?;
        let now = text(history.current())?;
        if states.last() != Some(&now) {
            states.push(now);
        }
        if step % SHOWN_EVERY == SHOWN_EVERY - 1 {
            show(&mut solver, history.current(), &mut random)?;
        }
    }
    let end = text(history.current())?;
    let read = file::parse(&end).map_err(|e| format!("the design cannot be read back: {e}"))?;
    if read != **history.current() || text(&read)? != end {
        return Err("reading the design back changed it".into());
    }
    for expected in states.iter().rev().skip(1) {
        if history.undo().is_none() || text(history.current())? != *expected {
            return Err("undo did not give the document back".into());
        }
    }
    for expected in states.iter().skip(1) {
        if history.redo().is_none() || text(history.current())? != *expected {
            return Err("redo did not give the document back".into());
        }
    }
    Ok(states.len() - 1)
}

fn text(design: &Design) -> Result<String, String> {
    file::to_text(design).map_err(|e| format!("the design cannot be written: {e}"))
}

/// Asks for both plushies and looks at what would be shown.
fn show(solver: &mut Solver, design: &Arc<Design>, random: &mut Random) -> Result<(), String> {
    let setpoint = match random.index(3) {
        0 => Setpoint::Activations(design.networks.iter().map(|_| random.between(-20.0, 60.0)).collect()),
        _ => Setpoint::Targets(design.poses.first().map(|p| p.targets.clone()).unwrap_or_default()),
    };
    let request = Request {
        id: 0,
        design: design.clone(),
        setpoint,
        quality: Quality::Draft,
        show_idealized: random.index(4) > 0,
        show_realizable: random.index(4) > 0,
    };
    let outcome = solver.solve(&request, &AtomicBool::new(false));
    let shapes = [("idealized", outcome.idealized), ("realizable", outcome.realizable)];
    shapes
        .iter()
        .filter_map(|(name, shape)| Some((name, shape.as_ref()?)))
        .try_for_each(|(name, shape)| sound(design, shape).map_err(|what| format!("{name}: {what}")))
}

fn sound(design: &Design, shape: &Shape) -> Result<(), String> {
    if shape.nodes.len() != design.mesh.nodes.len() {
        return Err("the shape has another number of nodes".into());
    }
    let lists = [&shape.activations_mm, &shape.fiber_contractions_mm, &shape.fiber_tensions, &shape.tendon_tensions];
    let figures = [shape.target_error, shape.residual, shape.force_scale];
    let all = shape.nodes.iter().flatten().chain(lists.into_iter().flatten()).chain(&figures);
    if !all.clone().all(|v| v.is_finite()) {
        return Err("a figure is not finite".into());
    }
    for (k, t) in design.mesh.triangles.iter().enumerate() {
        let [p, q, r] = t.map(|n| shape.nodes[n]);
        let area = (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
        if area.is_nan() || area <= 0.0 {
            return Err(format!("triangle {k} is inverted"));
        }
    }
    if !shape.converged && shape.warning.is_none() {
        return Err("not in equilibrium, and nothing says so".into());
    }
    Ok(())
}

/// A rectangle of 20 mm cells.
fn plain(columns: usize, rows: usize) -> Design {
    let at = |i: usize, j: usize| j * (columns + 1) + i;
    let mut mesh = Mesh::default();
    let [width, height] = [columns, rows].map(|n| 20.0 * n as f64);
    for j in 0..=rows {
        for i in 0..=columns {
            mesh.nodes.push([20.0 * i as f64, 20.0 * j as f64]);
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    let outer = vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    Design::new("rectangle", Outline { outer, holes: Vec::new() }, mesh)
}

/// One change; most are allowed, some are refused.
fn change(random: &mut Random, design: &mut Design) -> Result<(), EditError> {
    let index = random.index(3);
    let name = format!("name {}", random.index(5));
    match random.index(20) {
        0 | 1 => {
            let position = (random.index(3) == 0).then(|| [random.between(-50.0, 150.0), random.between(-50.0, 150.0)]);
            let stiffness =
                if random.index(4) == 0 { 10f64.powf(random.between(-6.0, 12.0)) } else { random.between(-1.0, 30.0) };
            edit::add_pin(design, Pin { position, ..Pin::at_rest(point(random, &design.mesh), stiffness) }).map(drop)
        }
        2 => edit::remove_pin(design, index).map(drop),
        3 | 4 => {
            let targets = (0..1 + random.index(3)).map(|_| target(random, &design.mesh)).collect();
            edit::add_pose(design, Pose { name, targets }).map(drop)
        }
        5 => edit::rename_pose(design, index, &name),
        6 => edit::duplicate_pose(design, index).map(drop),
        7 => edit::remove_pose(design, index).map(drop),
        8 => edit::add_target(design, index, target(random, &design.mesh)).map(drop),
        9 => edit::move_target(design, index, random.index(3), target(random, &design.mesh).to),
        10 => edit::remove_target(design, index, random.index(3)).map(drop),
        11 | 12 => {
            let network = network(random, &design.mesh);
            edit::accept_network(design, network).map(drop)
        }
        13 => edit::remove_network(design, index).map(drop),
        14 => {
            let activations_mm = design.networks.iter().map(|_| random.between(0.0, 20.0)).collect();
            let pose = design.poses.get(index).map(|p| p.name.clone());
            let (time_s, easing) =
                (0.25 * random.index(20) as f64, [Easing::Linear, Easing::Smooth, Easing::Hold][index]);
            edit::set_keyframe(design, Keyframe { time_s, activations_mm, pose, easing }).map(drop)
        }
        15 => edit::move_keyframe(design, index, 0.25 * random.index(20) as f64).map(drop),
        16 => edit::set_material(design, material(random)),
        17 => {
            let fibers = crate::design::FiberSettings {
                stiffness: 10f64.powf(random.between(-4.0, 6.0)),
                epsilon_fraction: 10f64.powf(random.between(-8.0, -1.0)),
                max_contraction: random.between(0.0, 1.1),
                ..design.fibers.clone()
            };
            edit::set_fibers(design, fibers)
        }
        18 => {
            let tendons = crate::design::TendonSettings {
                stiffness: 10f64.powf(random.between(-3.0, 7.0)),
                epsilon_mm: 10f64.powf(random.between(-6.0, 0.5)),
                max_contraction: random.between(0.0, 1.0),
                friction: random.between(0.0, 1.0),
            };
            edit::set_tendons(design, tendons)
        }
        _ => {
            let surface_density = if random.index(2) == 0 { 0.0 } else { 10f64.powf(random.between(-9.0, -4.0)) };
            let gravity = Gravity { acceleration: [0.0, -9.81], surface_density };
            edit::set_term(design, GRAVITY, Some(gravity.into()))
        }
    }
}

fn material(random: &mut Random) -> Material {
    let mu = 10f64.powf(random.between(-4.0, 3.0));
    let ratio = if random.index(3) == 0 { 10f64.powf(random.between(0.0, 5.0)) } else { random.between(-0.1, 3.0) };
    if random.index(3) == 0 {
        StVenantKirchhoff { mu, lambda: ratio * mu }.into()
    } else {
        NeoHookean { mu, kappa: ratio * mu }.into()
    }
}

fn point(random: &mut Random, mesh: &Mesh) -> BodyPoint {
    let (a, b) = (random.unit(), random.unit());
    let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
    BodyPoint { triangle: random.index(mesh.triangles.len()), weights: [a, b, 1.0 - a - b] }
}

fn target(random: &mut Random, mesh: &Mesh) -> Target {
    let far = if random.index(5) == 0 { 10f64.powf(random.between(2.0, 8.0)) } else { 100.0 };
    let to = [random.between(-far, far), random.between(-far, far)];
    Target { at: point(random, mesh), to, weight: random.between(0.0, 3.0) }
}

fn network(random: &mut Random, mesh: &Mesh) -> Network {
    let nodes = mesh.nodes.len();
    let winch = random.index(nodes);
    let tendons = (0..1 + random.index(3)).map(|_| {
        let mut last = winch;
        let mut routing = vec![MaterialPoint::Node(winch)];
        for _ in 0..1 + random.index(4) {
            last = (last + 1 + random.index(nodes - 1)) % nodes;
            routing.push(if random.index(3) == 0 {
                let at = point(random, mesh);
                MaterialPoint::of_triangle(mesh.triangles[at.triangle], at.weights)
            } else {
                MaterialPoint::Node(last)
            });
        }
        Tendon { routing, ratio: random.between(0.5, 2.0), slack_mm: random.between(0.0, 5.0) }
    });
    Network::new("winch 1", tendons.collect())
}
