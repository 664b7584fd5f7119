use super::*;
use crate::design::{Keyframe, bundled};

/// A design of one winch with these keyframes: time, length, easing.
fn design(keys: &[(f64, f64, Easing)]) -> Design {
    let mut design = bundled::ALL[1].design().expect("a sound design");
    design.networks.truncate(1);
    design.keyframes = keys
        .iter()
        .map(|&(time_s, mm, easing)| Keyframe {
            time_s,
            activations_mm: vec![mm; design.networks.len()],
            pose: None,
            easing,
        })
        .collect();
    design
}

/// Samples of the first winch, and the largest speed and acceleration in them.
fn sampled(plan: &Plan, from: f64, to: f64) -> (Vec<f64>, f64, f64) {
    let steps = 20_000;
    let dt = (to - from) / f64::from(steps);
    let way: Vec<f64> = (0..=steps).map(|k| plan.at(from + f64::from(k) * dt)[0]).collect();
    let speeds: Vec<f64> = way.windows(2).map(|w| (w[1] - w[0]) / dt).collect();
    let speed = speeds.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let acceleration = speeds.windows(2).fold(0.0, |m: f64, v| m.max(((v[1] - v[0]) / dt).abs()));
    (way, speed, acceleration)
}

const EASINGS: [Easing; 3] = [Easing::Linear, Easing::Smooth, Easing::Hold];

#[test]
fn keyframes_are_hit_within_limits_whatever_the_easing() {
    for easing in EASINGS {
        let keys =
            [(0.0, 0.0, easing), (1.03, 20.0, easing), (2.0, 35.0, easing), (3.5, 5.0, easing), (4.4, 5.0, easing)];
        let design = design(&keys);
        let plan = Plan::of(&design, TooFast::Refuse).expect("slow enough");
        for (time, mm, _) in keys {
            assert!((plan.at(time)[0] - mm).abs() < 1e-6, "{easing:?} at {time} s");
        }
        let limits = limits(&design);
        let (_, speed, acceleration) = sampled(&plan, -0.1, 4.5);
        assert!(speed <= limits.speed * (1.0 + 1e-6), "{easing:?}: {speed} mm/s of {}", limits.speed);
        assert!(acceleration <= limits.acceleration * 1.01, "{easing:?}: {acceleration} of {}", limits.acceleration);
        for rate in [0.1, 7.0, 50.0] {
            let steps = plan.steps(rate);
            assert!(keys.iter().all(|(time, ..)| steps.contains(time)), "every keyframe is a step at {rate} Hz");
            assert!(steps.windows(2).all(|t| t[1] > t[0] && t[1] - t[0] < 1.0 / rate + 1e-5));
            assert_eq!(steps.len() as f64, plan.count(rate));
        }
    }
}

#[test]
fn a_smooth_section_that_fits_stays_as_it_is() {
    let keys = [(0.0, 0.0, Easing::Smooth), (1.5, 20.0, Easing::Smooth), (3.0, 0.0, Easing::Smooth)];
    let design = design(&keys);
    let plan = Plan::of(&design, TooFast::Refuse).expect("slow enough");
    assert_eq!(plan.notes, []);
    for k in 0..=300 {
        let time = 0.01 * f64::from(k);
        let there = crate::design::animation::activations_at(&design, time)[0];
        assert!((plan.at(time)[0] - there).abs() < 1e-12);
    }
}

#[test]
fn a_straight_line_is_followed_but_for_its_corners() {
    let keys = [(0.0, 0.0, Easing::Linear), (2.0, 40.0, Easing::Linear), (4.0, 80.0, Easing::Linear)];
    let design = design(&keys);
    let plan = Plan::of(&design, TooFast::Refuse).expect("slow enough");
    // At 20 mm/s and 292 mm/s^2 a corner takes 0.07 s: it is cut by less than 2 mm.
    let off = |time: f64| (plan.at(time)[0] - 20.0 * time).abs();
    assert!((0..=400).all(|k| off(0.01 * f64::from(k)) < 1.0));
    assert!(plan.at(2.05)[0] > 40.9, "it does not stop on the way");
}

#[test]
fn a_held_value_jumps_as_late_and_as_quickly_as_the_motor_can() {
    let keys = [(0.0, 0.0, Easing::Hold), (2.0, 30.0, Easing::Hold), (3.0, 30.0, Easing::Hold)];
    let design = design(&keys);
    let plan = Plan::of(&design, TooFast::Refuse).expect("slow enough");
    let takes = Trapezoid::shortest(30.0, limits(&design));
    assert_eq!(plan.at(2.0 - takes - 1e-6), [0.0]);
    assert!((plan.at(2.0 - 0.5 * takes)[0] - 15.0).abs() < 1e-6);
    assert!((plan.at(2.0)[0] - 30.0).abs() < 1e-6);
    let [Note::Jump { from_s, to_s: 2.0, .. }] = plan.notes[..] else { panic!("{:?}", plan.notes) };
    assert!((from_s - (2.0 - takes)).abs() < 1e-12, "{from_s}");
}

#[test]
fn what_no_motor_can_follow_is_refused_by_name_or_stretched() {
    for easing in EASINGS {
        let keys = [(0.0, 0.0, easing), (0.2, 90.0, easing), (1.0, 0.0, easing)];
        let design = design(&keys);
        let MotionError::TooFast { winch, from_s, to_s, by_mm, needs_s } =
            Plan::of(&design, TooFast::Refuse).expect_err("too fast")
        else {
            panic!("another error");
        };
        assert_eq!((winch.as_str(), from_s, to_s, by_mm), (design.networks[0].name.as_str(), 0.0, 0.2, 90.0));
        let limits = limits(&design);
        assert!((needs_s - Trapezoid::shortest(90.0, limits)).abs() < 1e-12);
        let plan = Plan::of(&design, TooFast::Stretch).expect("stretched");
        let stretched: Vec<f64> = plan
            .notes
            .iter()
            .filter_map(|note| match note {
                Note::Stretched { now_s, .. } => Some(*now_s),
                _ => None,
            })
            .collect();
        assert_eq!(stretched.len(), 2, "{:?}", plan.notes);
        assert!(stretched.iter().all(|now| (needs_s..1.000_001 * needs_s).contains(now)), "{stretched:?}, {needs_s}");
        let end = plan.times_s[2];
        assert!((plan.at(plan.times_s[1])[0] - 90.0).abs() < 1e-6 && plan.at(end)[0].abs() < 1e-6);
        let (_, speed, acceleration) = sampled(&plan, 0.0, end);
        assert!(speed <= limits.speed * (1.0 + 1e-6) && acceleration <= limits.acceleration * 1.01);
    }
}

#[test]
fn slack_is_not_commanded_and_a_pose_at_the_beginning_is_wound_first() {
    let keys = [(0.0, 25.0, Easing::Smooth), (2.0, -15.0, Easing::Smooth)];
    let design = design(&keys);
    let plan = Plan::of(&design, TooFast::Refuse).expect("slow enough");
    let [Note::Slack { length_mm, .. }, Note::Lead { lead_s, later_s }] = &plan.notes[..] else {
        panic!("{:?}", plan.notes)
    };
    assert_eq!((*length_mm, later_s), (-15.0, lead_s));
    assert_eq!(plan.at(0.0), [0.0], "it begins at rest");
    assert!((plan.at(*lead_s)[0] - 25.0).abs() < 1e-9);
    assert!((plan.at(lead_s + 2.0)[0]).abs() < 1e-9);
    let (way, speed, acceleration) = sampled(&plan, 0.0, lead_s + 2.0);
    assert!(way.iter().all(|mm| *mm >= -1e-12));
    let limits = limits(&design);
    assert!(speed <= limits.speed && acceleration <= limits.acceleration * 1.01);
}

#[test]
fn a_winch_without_keyframes_stands_still() {
    let plan = Plan::of(&design(&[]), TooFast::Refuse).expect("nothing to do");
    assert_eq!((plan.at(3.0), plan.steps(50.0)), (vec![0.0], vec![0.0]));
    let plan = Plan::of(&design(&[(2.0, 0.0, Easing::Linear)]), TooFast::Refuse).expect("nothing to do");
    assert_eq!((plan.at(3.0), plan.steps(50.0)), (vec![0.0], vec![2.0]));
}

#[test]
fn times_that_are_told_are_those_of_the_design() {
    let keys = [(0.1, 60.0, Easing::Smooth), (0.4, 0.0, Easing::Smooth), (0.8, 60.0, Easing::Smooth)];
    let design = design(&keys);
    let refused = Plan::of(&design, TooFast::Refuse).expect_err("too fast");
    assert!(matches!(refused, MotionError::TooFast { from_s: 0.1, to_s: 0.4, .. }), "{refused}");
    let plan = Plan::of(&design, TooFast::Stretch).expect("stretched");
    let told: Vec<(f64, f64)> = plan
        .notes
        .iter()
        .filter_map(|note| match *note {
            Note::Stretched { from_s, to_s, .. } => Some((from_s, to_s)),
            _ => None,
        })
        .collect();
    assert_eq!(told, [(0.1, 0.4), (0.4, 0.8)]);
    assert!((plan.at(*plan.times_s.last().expect("keyframes"))[0] - 60.0).abs() < 1e-6);
}

#[test]
fn ten_thousand_keyframes_that_are_too_fast_are_stretched_at_once() {
    let keys: Vec<(f64, f64, Easing)> =
        (0..10_000).map(|k| (0.1 * f64::from(k), if k % 2 == 0 { 0.0 } else { 40.0 }, Easing::Linear)).collect();
    let plan = Plan::of(&design(&keys), TooFast::Stretch).expect("stretched");
    assert_eq!(plan.notes.len(), 9_999);
}
