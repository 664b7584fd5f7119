//! The tracker on bundled designs: what it shows can always be shown, far-away targets leave no trace, and the same drag gives
//! the same bits.

use crate::support::scenes::{Parts, Scene, steady_e};
use plushwright::bench::{Session, wander};
use plushwright::soft_ik::{Frame, Quality, Tracker};

/// Largest residual, as a part of the forces at work, with which a pose may be shown.
const SHOWN: f64 = 1e-3;

/// What every frame must be, whatever was asked of it.
fn check(scene: &Scene, tracker: &Tracker, frame: &Frame, at: &str) {
    let posture = tracker.posture();
    assert!(posture.x.iter().all(|v| v.is_finite()), "{at}: not finite");
    let smallest = scene.plushie.model.body.smallest_determinant(&posture.x);
    assert!(smallest > 0.0, "{at}: inverted, {smallest}");
    for (k, (winch, beta)) in scene.actuation.winches.iter().zip(&posture.beta).enumerate() {
        let contraction = winch.members[0].1 * beta;
        let inside = contraction >= winch.lower - 1e-12 && contraction <= winch.upper + 1e-12;
        assert!(inside, "{at}: fibre {k} at {contraction} of [{}, {}]", winch.lower, winch.upper);
    }
    assert!(frame.residual <= SHOWN * frame.force_scale, "{at}: residual {:e}", frame.residual / frame.force_scale);
    // The figures belong to the shape, with its contractions in the model.
    let model = &scene.plushie.model;
    let mut forces = vec![0.0; posture.x.len()];
    model.gradient(&posture.x, &mut forces);
    let residual = forces.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    let scale = model.force_scale(&posture.x);
    assert!(residual <= SHOWN * scale, "{at}: residual {:e} in truth", residual / scale);
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let nodes = a.chunks_exact(2).zip(b.chunks_exact(2));
    nodes.map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1])).fold(0.0, f64::max)
}

/// Targets leave by three body lengths for 20 frames and come back to where they are at rest.
fn leave_and_return(name: &str, parts: Parts, way: [f64; 2]) {
    let mut scene = Scene::new(name, parts);
    let mut tracker = scene.tracker();
    let rest = tracker.posture().x.clone();
    let (mut nearest, mut frames) = (f64::INFINITY, 0);
    for k in 0..80 {
        let away = k < 20;
        scene.aim(if away { way } else { [0.0; 2] });
        let frame = scene.frame(&mut tracker, Quality::Balanced);
        check(&scene, &tracker, &frame, &format!("{name}, {parts:?}, {way:?}, frame {k}"));
        if !away {
            frames = k - 19;
            nearest = distance(&tracker.posture().x, &rest) / scene.body_length;
            if frame.converged {
                break;
            }
        }
    }
    println!("{name}, {parts:?}, {way:?}: {nearest:.1e} body lengths from rest after {frames} frames");
    assert!(nearest < 1e-3, "{name}, {parts:?}, {way:?}: {nearest} body lengths from rest");
}

#[test]
fn targets_that_were_far_away_leave_no_trace() {
    leave_and_return("E", Parts::default(), [-2.1, 2.1]);
}

#[test]
fn nor_do_they_beside_winches() {
    leave_and_return("E", Parts { tendons: true, ..Parts::default() }, [0.0, -3.0]);
}

/// Winches turn while targets are out of reach and back: every frame can be shown, and at rest the pose is the one that a
/// tracker finds which saw nothing of it.
#[test]
fn a_mixed_scene_settles_where_a_fresh_one_does() {
    let parts = Parts { tendons: true, ..Parts::default() };
    let mut scene = Scene::of(steady_e(), parts);
    let mut tracker = scene.tracker();
    for k in 0..8 {
        let t = k as f64;
        scene.aim([0.4 * (0.9 * t).sin(), 3.0 * (0.5 * t).sin()]);
        scene.turn(0.5 - 0.5 * (0.7 * t).cos());
        let frame = scene.frame(&mut tracker, Quality::Balanced);
        check(&scene, &tracker, &frame, &format!("frame {k}"));
    }
    let settled = |scene: &mut Scene, tracker: &mut Tracker| {
        scene.aim([0.1, 0.05]);
        scene.turn(0.3);
        for k in 0..60 {
            let frame = scene.frame(tracker, Quality::Balanced);
            check(scene, tracker, &frame, &format!("at rest, frame {k}"));
            if frame.converged {
                return tracker.posture().clone();
            }
        }
        panic!("not converged after a second at rest");
    };
    let posture = settled(&mut scene, &mut tracker);
    let mut fresh = scene.tracker();
    let expected = settled(&mut scene, &mut fresh);
    let difference = distance(&posture.x, &expected.x) / scene.body_length;
    println!("{difference:.1e} body lengths apart, O {} and {}", posture.objective, expected.objective);
    assert!(difference < 1e-3, "{difference} body lengths from the fresh pose");
}

/// Every coordinate, activation and count of a drag, as bits.
fn drag(parts: Parts, quality: Quality) -> Vec<u64> {
    let mut scene = Scene::new("E", parts);
    let mut tracker = scene.tracker();
    let mut bits = Vec::new();
    for k in 0..4 {
        scene.drag(6 * k, 16);
        let frame = scene.frame(&mut tracker, quality);
        let posture = tracker.posture();
        let figures = [posture.objective, posture.residual, frame.force_scale, frame.iterations as f64];
        bits.extend(posture.x.iter().chain(&posture.beta).chain(&figures).map(|v| v.to_bits()));
    }
    bits
}

#[test]
fn the_same_drag_gives_the_same_bits_on_any_thread() {
    for parts in [Parts::default(), Parts { tendons: true, gravity: true, stiff: false }] {
        let alone = drag(parts, Quality::Draft);
        assert!(alone == drag(parts, Quality::Draft), "{parts:?}: twice in a row");
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..2).map(|_| scope.spawn(|| drag(parts, Quality::Draft))).collect();
            for thread in threads {
                assert!(alone == thread.join().unwrap(), "{parts:?}: beside other threads");
            }
        });
    }
}

/// A wild drag of three shapes: jumps of up to hundreds of body lengths in scenes of every stiffness.
#[test]
fn wild_drags_end_where_a_search_from_rest_does() {
    static CANCEL: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);
    let session = Session { seed: 1, stop: &|| false, cancel: &CANCEL, progress: &|_| {}, found: &|_| {} };
    let shapes = ["pig", "puppy", "e"].map(String::from).to_vec();
    let report = wander::Wander { shapes, fibers: 177, drags: 1 }.run(&session).unwrap().json();
    let rows = report["tables"]["wander"]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 3);
    for row in rows {
        assert_eq!(row["not showable"], 0, "{row}");
        assert!(row["unbalanced, worst"].as_f64().unwrap() <= SHOWN, "{row}");
        assert!(row["apart"].as_f64().unwrap() <= 1e-3, "{row}");
    }
}
