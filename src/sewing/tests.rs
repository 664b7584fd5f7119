use super::*;
use crate::outline::{Outline, Point, polygon};
use std::f64::consts::PI;

fn square(side: f64) -> Outline {
    Outline { outer: vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]], holes: vec![] }
}

/// Rules that nothing breaks.
fn lifted() -> Rules {
    Rules {
        hole_to_seam_mm: f64::NEG_INFINITY,
        hole_to_hole_mm: 0.0,
        most_holes: usize::MAX,
        turn_degrees: 180.0,
        turning_degrees: f64::INFINITY,
        beside_mm: 0.0,
        along_mm: f64::INFINITY,
        lead_mm: 0.0,
        housing_mm: 0.0,
        between_housings_mm: 0.0,
    }
}

fn rig(cables: &[&[Point]]) -> Rig {
    Rig { winch: cables[0][0], cables: cables.iter().map(|c| c.to_vec()).collect() }
}

fn breaches(rules: Rules, rigs: &[Rig]) -> Vec<Breach> {
    judge(&rules, &Body::new(&square(200.0)), rigs, 60.0)
}

/// Numbers between 0 and 1 from a seed.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[test]
fn a_plain_rig_keeps_every_rule() {
    let rigs = [rig(&[&[[60.0, 60.0], [100.0, 60.0], [150.0, 80.0]], &[[60.0, 60.0], [60.0, 150.0]]])];
    assert_eq!(breaches(Rules::default(), &rigs), []);
}

#[test]
fn each_rule_is_kept_at_its_figure_and_broken_beyond() {
    let d = Rules::default();
    // The rule alone, a rig as a function of its figure, the figure, and a little beyond it.
    type Case = (Rules, Box<dyn Fn(f64) -> Vec<Rig>>, f64, f64);
    let turned = |degrees: f64| {
        let a = degrees.to_radians();
        vec![rig(&[&[[50.0, 50.0], [90.0, 50.0], [90.0 + 40.0 * a.cos(), 50.0 + 40.0 * a.sin()]]])]
    };
    let curled = |degrees: f64| {
        let (mut p, mut points) = ([100.0, 60.0], vec![[60.0, 60.0], [100.0, 60.0]]);
        for k in 1..=8 {
            let a = (degrees * f64::from(k) / 8.0).to_radians();
            p = [p[0] + 20.0 * a.cos(), p[1] + 20.0 * a.sin()];
            points.push(p);
        }
        vec![Rig { winch: points[0], cables: vec![points] }]
    };
    let two =
        |gap: f64| vec![rig(&[&[[50.0, 100.0], [50.0, 150.0]]]), rig(&[&[[50.0 + gap, 100.0], [50.0 + gap, 50.0]]])];
    let beside = |length: f64| {
        vec![rig(&[&[[20.0, 20.0], [40.0, 20.0], [40.0 + length, 20.0]]]), rig(&[&[[40.0, 22.0], [180.0, 22.0]]])]
    };
    let cases: Vec<Case> = vec![
        (
            Rules { hole_to_seam_mm: 5.0, ..lifted() },
            Box::new(|d| vec![rig(&[&[[100.0, 100.0], [200.0 - d, 100.0]]])]),
            5.0,
            4.99,
        ),
        (
            Rules { hole_to_hole_mm: 8.0, ..lifted() },
            Box::new(|d| vec![rig(&[&[[100.0, 100.0], [100.0 + d, 100.0]]])]),
            8.0,
            7.99,
        ),
        (Rules { turn_degrees: d.turn_degrees, ..lifted() }, Box::new(turned), 75.0, 75.1),
        (Rules { turning_degrees: d.turning_degrees, ..lifted() }, Box::new(curled), 360.0, 361.0),
        (Rules { housing_mm: 24.0, ..lifted() }, Box::new(|d| vec![rig(&[&[[d, 100.0], [d, 150.0]]])]), 12.0, 11.9),
        (Rules { housing_mm: 24.0, between_housings_mm: 5.0, ..lifted() }, Box::new(two), 29.0, 28.9),
        // Beside another one from 20 mm on; where it ends, the last of it is still near.
        (Rules { beside_mm: 3.0, along_mm: 10.0, lead_mm: 20.0, ..lifted() }, Box::new(beside), 10.0, 10.1),
    ];
    for (k, (rules, make, kept, broken)) in cases.into_iter().enumerate() {
        assert_eq!(breaches(rules, &make(kept)), [], "case {k} at its figure");
        let found = breaches(rules, &make(broken));
        assert!(!found.is_empty(), "case {k} beyond its figure");
        assert!(found.iter().all(|b| b.severity() >= 1.0 && b.severity() < 1.2), "case {k}: {found:?}");
    }
}

#[test]
fn counts_and_passages_are_seen() {
    let many: Vec<Point> = (0..11).map(|k| [20.0 + 15.0 * f64::from(k), 50.0]).collect();
    let rigs = [Rig { winch: many[0], cables: vec![many.clone()] }];
    let found = breaches(Rules { most_holes: 8, ..lifted() }, &rigs);
    assert_eq!(found, [Breach::ManyHoles { at: Place { winch: 0, cable: 0 }, holes: 9, most: 8 }]);
    let through = [rig(&[&[[30.0, 100.0], [170.0, 100.0]]]), rig(&[&[[100.0, 105.0], [100.0, 160.0]]])];
    let found = breaches(Rules { housing_mm: 24.0, ..lifted() }, &through);
    let at = Place { winch: 0, cable: 0 };
    assert_eq!(found, [Breach::ThroughWinch { at, piece: 0, winch: 1, distance_mm: 5.0, least_mm: 12.0 }]);
    let gap = judge(&Rules { housing_mm: 24.0, ..lifted() }, &Body::new(&square(200.0)), &through[..1], 20.0);
    assert_eq!(gap, [Breach::HousingAtGap { winch: 0, gap_mm: 20.0, housing_mm: 24.0 }]);
    // A hole that two cables share is one; two holes at a hair's distance are not.
    let shared: [&[Point]; 2] = [&[[50.0, 50.0], [90.0, 50.0]], &[[50.0, 50.0], [90.0, 50.0]]];
    assert_eq!(breaches(Rules { hole_to_hole_mm: 8.0, ..lifted() }, &[rig(&shared)]), []);
}

#[test]
fn what_is_along_another_cable_agrees_with_sampling() {
    let mut next = random(7);
    for _ in 0..200 {
        let mut line = |points: usize| (0..points).map(|_| [40.0 * next(), 40.0 * next()]).collect::<Vec<Point>>();
        let (p, q) = (line(4), line(5));
        let exact = shared_mm(&p, &q, 3.0, 20.0);
        let (mut sampled, mut s) = (0.0, 0.0);
        for piece in p.windows(2) {
            let whole = polygon::length(piece[0], piece[1]);
            let count = 20_000;
            for i in 0..count {
                let t = (f64::from(i) + 0.5) / f64::from(count);
                let m = polygon::lerp(piece[0], piece[1], t);
                let near = q.windows(2).any(|s| polygon::distance_to_segment(s[0], s[1], m) < 3.0);
                if near && s + t * whole > 20.0 {
                    sampled += whole / f64::from(count);
                }
            }
            s += whole;
        }
        assert!((exact - sampled).abs() < 0.02, "{exact} and {sampled}");
    }
}

#[test]
fn what_is_outside_of_a_body_has_its_closed_form() {
    let body = Outline { holes: vec![vec![[40.0, 40.0], [40.0, 60.0], [60.0, 60.0], [60.0, 40.0]]], ..square(100.0) };
    let out = |a, b| outside(body.polygons(), a, b);
    assert!((out([-10.0, 50.0], [110.0, 50.0]) - 40.0).abs() < 1e-12);
    assert_eq!(out([10.0, 10.0], [90.0, 10.0]), 0.0);
    assert_eq!(out([10.0, 50.0], [10.0, 50.0]), 0.0);
    assert!((out([45.0, 50.0], [55.0, 50.0]) - 10.0).abs() < 1e-12);
}

#[test]
fn pieces_outside_are_judged_in_the_pose_they_are_asked_for() {
    // An L; the cable from one arm to the other leaves it over the inner corner. The arm bent down by 90 degrees takes its end along.
    let straight: Vec<Point> = vec![[0.0, 0.0], [100.0, 0.0], [100.0, 20.0], [20.0, 20.0], [20.0, 100.0], [0.0, 100.0]];
    let piece = |a, b| [Rig { winch: a, cables: vec![vec![a, b]] }];
    let judged = |ring: &[Point], rigs: &[Rig]| judge_pieces(std::iter::once(ring), rigs);
    let [breach] = judged(&straight, &piece([10.0, 90.0], [90.0, 10.0]))[..] else { panic!("one piece") };
    // It enters and leaves where x or y is 20.
    let Breach::Outside { at: Place { winch: 0, cable: 0 }, piece: 0, length_mm, most_mm: OUTSIDE_MM } = breach else {
        panic!("{breach}")
    };
    assert!((length_mm - 60.0 * 2f64.sqrt()).abs() < 1e-12, "{length_mm}");
    let down: Vec<Point> = vec![[0.0, 0.0], [0.0, -100.0], [20.0, -100.0], [20.0, 100.0], [0.0, 100.0]];
    assert_eq!(judged(&down, &piece([10.0, 90.0], [10.0, -90.0])), []);
    // Below the tolerance nothing is told; along the rim a cable is inside, to whichever side it rounds.
    let ends = |beyond: f64| piece([50.0, 10.0], [50.0, 20.0 + beyond]);
    assert_eq!(judged(&straight, &ends(0.9 * OUTSIDE_MM)), []);
    assert_eq!(judged(&straight, &ends(10.0)).len(), 1);
    for off in [-1e-12, 0.0, 1e-12] {
        assert_eq!(judged(&straight, &piece([100.0, 20.0 + off], [20.0, 20.0 + off])), []);
    }
}

#[test]
fn a_body_that_lies_over_itself_is_inside_there() {
    // A strip bent into a U whose arms lie over each other from x = 40 to x = 60.
    let bent: Vec<Point> = vec![
        [0.0, 0.0],
        [100.0, 0.0],
        [100.0, 100.0],
        [40.0, 100.0],
        [40.0, 20.0],
        [60.0, 20.0],
        [60.0, 100.0],
        [0.0, 100.0],
    ];
    let out = |a, b| outside(std::iter::once(bent.as_slice()), a, b);
    assert_eq!(out([10.0, 60.0], [90.0, 60.0]), 0.0);
    assert!((out([-10.0, 60.0], [110.0, 60.0]) - 20.0).abs() < 1e-12);
}

#[test]
fn judgements_do_not_depend_on_where_the_body_lies() {
    let mut next = random(11);
    for _ in 0..30 {
        let mut cable = || (0..5).map(|_| [20.0 + 160.0 * next(), 20.0 + 160.0 * next()]).collect::<Vec<Point>>();
        let rigs: Vec<Rig> = (0..2)
            .map(|_| {
                let c = cable();
                Rig { winch: c[0], cables: vec![c] }
            })
            .collect();
        let (sine, cosine) = (0.3 * PI).sin_cos();
        // Turned, mirrored and moved away.
        let there = |p: Point| [500.0 - (cosine * p[0] - sine * p[1]), sine * p[0] + cosine * p[1] - 70.0];
        let map = |c: &Vec<Point>| c.iter().map(|&p| there(p)).collect::<Vec<Point>>();
        let moved: Vec<Rig> =
            rigs.iter().map(|r| Rig { winch: there(r.winch), cables: r.cables.iter().map(map).collect() }).collect();
        let mut outline = square(200.0);
        outline.outer = outline.outer.iter().rev().map(|&p| there(p)).collect();
        let here = judge(&Rules::default(), &Body::new(&square(200.0)), &rigs, 60.0);
        let away = judge(&Rules::default(), &Body::new(&outline), &moved, 60.0);
        assert_eq!(here.len(), away.len());
        for (a, b) in here.iter().zip(&away) {
            assert_eq!(std::mem::discriminant(a), std::mem::discriminant(b));
            assert!((a.severity() - b.severity()).abs() < 1e-9, "{a} and {b}");
        }
    }
}

#[test]
fn a_thin_body_has_room_for_a_small_housing() {
    let thin = Outline { outer: vec![[0.0, 0.0], [200.0, 0.0], [200.0, 20.0], [0.0, 20.0]], holes: vec![] };
    let room = largest_housing(&Body::new(&thin), 24.0);
    assert!((14.0..=16.0).contains(&room), "{room}");
    assert_eq!(largest_housing(&Body::new(&square(200.0)), 24.0), 24.0);
}

#[test]
fn the_largest_housing_has_its_closed_form() {
    let room = |outer: &[Point]| {
        let outline = Outline { outer: outer.to_vec(), holes: vec![] };
        largest_housing(&Body::new(&outline), 100.0) / 0.8
    };
    // The inscribed circle of a right triangle of 30, 40 and 50 mm has a radius of 10 mm.
    assert!((room(&[[0.0, 0.0], [40.0, 0.0], [0.0, 30.0]]) - 20.0).abs() <= 0.2);
    // A square of 60 mm, turned: twice its depth.
    let a = 60.0 / 2f64.sqrt();
    assert!((room(&[[a, 0.0], [2.0 * a, a], [a, 2.0 * a], [0.0, a]]) - 60.0).abs() <= 0.2);
    // In the corner of an L of two bars of 40 mm a circle touches both outer sides and the inner corner: r = (40 - r) sqrt 2.
    let l = [[0.0, 0.0], [200.0, 0.0], [200.0, 40.0], [40.0, 40.0], [40.0, 200.0], [0.0, 200.0]];
    let r = 40.0 * 2f64.sqrt() / (1.0 + 2f64.sqrt());
    assert!((room(&l) - 2.0 * r).abs() <= 0.2);
    // A needle across its box.
    let slant = [[0.0, 0.0], [1.0, 0.0], [301.0, 300.0], [300.0, 300.0]];
    assert!((room(&slant) - 0.5 * 2f64.sqrt()).abs() <= 0.31);
}

#[test]
fn a_thin_body_is_told_once_and_judged_by_what_fits() {
    let thin = Outline { outer: vec![[0.0, 0.0], [200.0, 0.0], [200.0, 20.0], [0.0, 20.0]], holes: vec![] };
    let winch = |x: f64, y: f64| rig(&[&[[x, y], [x + 20.0, y]]]);
    let judged = |rigs: &[Rig]| judge(&Rules { housing_mm: 24.0, ..lifted() }, &Body::new(&thin), rigs, 60.0);
    let found = judged(&[winch(30.0, 10.0), winch(90.0, 10.0), winch(150.0, 10.0)]);
    let [Breach::ThinBody { room_mm, housing_mm: 24.0 }] = found[..] else { panic!("{found:?}") };
    assert!((room_mm - 16.0).abs() <= 0.16, "{room_mm}");
    // What fits is still to be inside the seam.
    let found = judged(&[winch(30.0, 5.0)]);
    assert!(matches!(found[..], [Breach::ThinBody { .. }, Breach::HousingOutside { winch: 0, room_mm: 10.0, .. }]));
}

#[test]
fn every_breach_has_words_facts_and_a_finite_severity() {
    let rules =
        Rules { hole_to_seam_mm: 5.0, turning_degrees: 0.0, turn_degrees: 0.0, most_holes: 0, ..Rules::default() };
    let rigs = [
        rig(&[&[[5.0, 5.0], [60.0, 5.0], [60.0, 30.0], [260.0, 30.0]], &[[5.0, 5.0], [62.0, 5.0], [62.0, 30.0]]]),
        rig(&[&[[20.0, 6.0], [20.0, 3.0]]]),
    ];
    let found = judge(&rules, &Body::new(&square(200.0)), &rigs, 20.0);
    let json = serde_json::to_value(&found).unwrap();
    let mut rules: Vec<&str> = json.as_array().unwrap().iter().map(|f| f["rule"].as_str().unwrap()).collect();
    for facts in json.as_array().unwrap() {
        assert!(facts["severity"].as_f64().unwrap() >= 1.0 && facts["value"].is_number() && facts["limit"].is_number());
        assert!(facts["winch"].as_u64() >= Some(1) && facts["tendon"].as_u64().is_none_or(|t| t >= 1), "{facts}");
    }
    rules.sort_unstable();
    rules.dedup();
    let all = [
        "along",
        "hole_to_hole",
        "hole_to_seam",
        "holes",
        "housing_to_gap",
        "housing_to_housing",
        "housing_to_seam",
        "outside",
        "through_winch",
        "turn",
        "turning",
    ];
    assert_eq!(rules, all);
    let first = most_severe(&found, 3);
    assert!(first.len() == 3 && first.windows(2).all(|b| b[0].severity() >= b[1].severity()));
    assert!(found.iter().all(|b| b.severity() <= first[0].severity() && b.to_string().contains("winch")));
    // A pair of cables along each other is told once.
    assert_eq!(rules.len(), all.len());
    let pairs = found.iter().filter(|b| matches!(b, Breach::Along { .. })).count();
    assert_eq!(pairs, 1, "{found:?}");
}

#[test]
fn turns_have_their_angles() {
    for degrees in [0.0, 30.0, 75.0, 90.0, 179.0] {
        let a = f64::to_radians(degrees);
        for sign in [1.0, -1.0] {
            let c = [10.0 + 3.0 * a.cos(), sign * 3.0 * a.sin()];
            assert!((turn([0.0, 0.0], [10.0, 0.0], c) - degrees).abs() < 1e-9);
        }
    }
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
    assert!((turning(&square) - 270.0).abs() < 1e-9);
}
