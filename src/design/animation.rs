//! Winch activations over time, read off the keyframes.
//!
//! Between two keyframes each activation moves along the straight line of its two values, at the pace of the earlier
//! keyframe's [`Easing`]; before the first and after the last keyframe it stays where that keyframe put it.

use super::{Design, Easing};

/// Two moments closer than this are the same moment, s. Well below a track step and any hand on a timeline.
pub const SAME_TIME_S: f64 = 1e-6;

/// Cable wound by each winch at `time_s`, mm, in the order of the networks; zeros if there are no keyframes.
pub fn activations_at(design: &Design, time_s: f64) -> Vec<f64> {
    let frames = &design.keyframes;
    let next = frames.partition_point(|k| k.time_s <= time_s);
    match (next.checked_sub(1).map(|i| &frames[i]), frames.get(next)) {
        (None, None) => vec![0.0; design.networks.len()],
        (None, Some(only)) | (Some(only), None) => only.activations_mm.clone(),
        (Some(a), Some(b)) => {
            let s = eased(a.easing, (time_s - a.time_s) / (b.time_s - a.time_s));
            a.activations_mm.iter().zip(&b.activations_mm).map(|(a, b)| a + (b - a) * s).collect()
        }
    }
}

/// Progress of the motion after the fraction `s` of the time between two keyframes, both from 0 to 1.
pub fn eased(easing: Easing, s: f64) -> f64 {
    match easing {
        Easing::Linear => s,
        Easing::Smooth => s * s * (3.0 - 2.0 * s),
        Easing::Slow { out, into } => {
            let u = handle_parameter(out, into, s);
            u * u * (3.0 - 2.0 * u)
        }
        Easing::Hold => {
            if s < 1.0 {
                0.0
            } else {
                1.0
            }
        }
    }
}

/// Halvings of an interval: enough to reach the last bit of its ends.
const HALVINGS: usize = 60;

/// The parameter `u` at which the curve of `Easing::Slow` has come to the part `s` of its time:
/// `3 (1-u)^2 u out + 3 (1-u) u^2 (1-into) + u^3 = s`, which ascends.
fn handle_parameter(out: f64, into: f64, s: f64) -> f64 {
    let time = |u: f64| u * (3.0 * (1.0 - u) * ((1.0 - u) * out + u * (1.0 - into)) + u * u);
    let (mut low, mut high) = (0.0, 1.0);
    if s <= low || s >= high {
        return s.clamp(low, high);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if time(middle) < s { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Time of the last keyframe, s: the length of the timeline, which starts at 0.
pub fn duration_s(design: &Design) -> f64 {
    design.keyframes.last().map_or(0.0, |k| k.time_s)
}

/// About how many steps a winch track has from the first to the last keyframe at the track rate: a check before a long export.
pub fn track_steps(design: &Design) -> f64 {
    let first = design.keyframes.first().map_or(0.0, |k| k.time_s);
    (duration_s(design) - first) * design.controller.track_rate_hz + 1.0
}

#[cfg(test)]
mod tests {
    use super::super::testing::sample;
    use super::*;
    use crate::design::Keyframe;

    fn with_keyframes(frames: &[(f64, f64, Easing)]) -> Design {
        let mut design = sample();
        design.networks.truncate(1);
        design.keyframes = frames
            .iter()
            .map(|&(time_s, a, easing)| Keyframe { time_s, activations_mm: vec![a], pose: None, easing })
            .collect();
        design.validate().expect("sound");
        design
    }

    #[test]
    fn clamps_outside_and_is_exact_on_keyframes() {
        let design =
            with_keyframes(&[(0.5, 3.0, Easing::Smooth), (2.5, 7.0, Easing::Linear), (3.5, 1.0, Easing::Hold)]);
        for (time, value) in [(-1.0, 3.0), (0.0, 3.0), (0.5, 3.0), (2.5, 7.0), (3.5, 1.0), (9.0, 1.0)] {
            assert_eq!(activations_at(&design, time), [value], "at {time} s");
        }
        // 3 s^2 - 2 s^3 at a quarter is 5/32.
        assert!((activations_at(&design, 1.0)[0] - (3.0 + 4.0 * 5.0 / 32.0)).abs() < 1e-12);
        assert!((activations_at(&design, 2.75)[0] - 5.5).abs() < 1e-12);
        assert_eq!(duration_s(&design), 3.5);
    }

    #[test]
    fn handles_of_a_third_are_smooth_and_longer_ones_slower() {
        let slow = |out: f64, into: f64| Easing::Slow { out, into };
        for k in 0..=20 {
            let s = f64::from(k) / 20.0;
            let thirds = eased(slow(1.0 / 3.0, 1.0 / 3.0), s);
            assert!((thirds - eased(Easing::Smooth, s)).abs() < 1e-12, "{s}");
            // Turned about the middle, the handles change places.
            assert!((eased(slow(0.7, 0.2), s) - (1.0 - eased(slow(0.2, 0.7), 1.0 - s))).abs() < 1e-12);
        }
        assert!(eased(slow(0.8, 0.2), 0.3) < 0.5 * eased(Easing::Smooth, 0.3));
        assert_eq!((eased(slow(0.8, 0.2), 0.0), eased(slow(0.8, 0.2), 1.0)), (0.0, 1.0));
    }

    #[test]
    fn hold_stays_until_the_next_keyframe() {
        let design = with_keyframes(&[(0.0, 1.0, Easing::Hold), (1.0, 2.0, Easing::Smooth)]);
        assert_eq!(activations_at(&design, 0.999), [1.0]);
        assert_eq!(activations_at(&design, 1.0), [2.0]);
    }

    #[test]
    fn without_keyframes_everything_is_slack() {
        let design = with_keyframes(&[]);
        assert_eq!(activations_at(&design, 1.0), [0.0]);
        assert_eq!(track_steps(&design), 1.0);
    }

    #[test]
    fn a_track_has_a_step_at_each_end_and_those_of_its_rate_between() {
        let design = with_keyframes(&[(0.1, 0.0, Easing::Linear), (1.1, 1.0, Easing::Linear)]);
        assert!((track_steps(&design) - 51.0).abs() < 1e-9);
        assert_eq!(track_steps(&with_keyframes(&[(2.0, 1.0, Easing::Linear)])), 1.0);
    }
}
