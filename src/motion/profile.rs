//! The motion of one winch between two keyframes, and what it asks of the motor.

use super::limits::Limits;
use crate::design::{Easing, animation::eased};

/// How a winch gets from one keyframe's length to the next one's, mm and s from the section's beginning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Profile {
    /// The easing that the keyframe names, as it is.
    Eased { from: f64, by: f64, duration: f64, easing: Easing },
    /// Waits, then `trapezoid` to the end.
    Trapezoid { from: f64, wait: f64, trapezoid: Trapezoid },
}

/// Speed changes evenly from `start` to `cruise`, stays, and changes evenly to `end`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Trapezoid {
    pub start: f64,
    pub cruise: f64,
    pub end: f64,
    pub acceleration: f64,
    pub duration: f64,
}

/// Halvings of an interval: enough to reach the last bit of its ends.
const HALVINGS: usize = 100;
/// A limit may be exceeded by this part: what rounding makes of a profile that meets it exactly.
pub(super) const ROUNDING: f64 = 1e-9;

impl Trapezoid {
    /// The trapezoid that covers `by` in `duration` with these speeds at its ends, if the limits allow one.
    pub fn find(by: f64, duration: f64, [start, end]: [f64; 2], limits: Limits) -> Option<Self> {
        let Limits { speed, acceleration } = limits;
        let with = |cruise: f64| Self { start, cruise, end, acceleration, duration };
        // The distance grows with the cruising speed as long as both ramps fit into the time.
        let room = acceleration * duration;
        let fits = |cruise: f64| (cruise - start).abs() + (cruise - end).abs() <= room * (1.0 + ROUNDING);
        if !fits(0.5 * (start + end)) {
            return None;
        }
        let middle = 0.5 * (start + end);
        // Where the ramps fill the time, above and below.
        let (mut low, mut high) = (middle.min(0.5 * (start + end - room)), middle.max(0.5 * (start + end + room)));
        (low, high) = (low.max(-speed), high.min(speed));
        if low > high
            || with(low).distance() > by + ROUNDING * by.abs()
            || with(high).distance() < by - ROUNDING * by.abs()
        {
            return None;
        }
        for _ in 0..HALVINGS {
            let cruise = 0.5 * (low + high);
            if with(cruise).distance() < by { low = cruise } else { high = cruise }
        }
        Some(with(0.5 * (low + high)))
    }

    /// Shortest time in which a winch gets `by` from rest to rest, s.
    pub fn shortest(by: f64, Limits { speed, acceleration }: Limits) -> f64 {
        let by = by.abs();
        if by * acceleration <= speed * speed {
            2.0 * (by / acceleration).sqrt()
        } else {
            by / speed + speed / acceleration
        }
    }

    /// Durations of the two ramps, s.
    fn ramps(&self) -> [f64; 2] {
        [self.start, self.end].map(|speed| (self.cruise - speed).abs() / self.acceleration)
    }

    /// Way covered, mm.
    fn distance(&self) -> f64 {
        self.at(self.duration)
    }

    /// Way covered after `t`, mm.
    fn at(&self, t: f64) -> f64 {
        let [up, down] = self.ramps();
        let level = self.duration - up - down;
        let (a, b, c) = (t.min(up), (t - up).clamp(0.0, level.max(0.0)), (t - up - level).max(0.0));
        let ramp = |from: f64, to: f64, whole: f64, t: f64| {
            if whole > 0.0 { from * t + 0.5 * (to - from) * t * t / whole } else { 0.0 }
        };
        ramp(self.start, self.cruise, up, a) + self.cruise * b + ramp(self.cruise, self.end, down, c)
    }
}

impl Profile {
    /// Length after `t` of the section, mm.
    pub fn at(&self, t: f64) -> f64 {
        match self {
            Self::Eased { from, by, duration, easing } => from + by * eased(*easing, (t / duration).clamp(0.0, 1.0)),
            Self::Trapezoid { from, wait, trapezoid } => from + trapezoid.at((t - wait).max(0.0)),
        }
    }

    /// Largest speed of an easing that covers `by` in `duration`, mm/s, and acceleration, mm/s^2; neither is bounded where it jumps.
    pub fn peaks(easing: Easing, by: f64, duration: f64) -> [f64; 2] {
        let (speed, acceleration) = (by.abs() / duration, by.abs() / (duration * duration));
        match easing {
            _ if by == 0.0 => [0.0; 2],
            // s = 3 u^2 - 2 u^3: s' is at most 3/2, s'' 6.
            Easing::Smooth => [1.5 * speed, 6.0 * acceleration],
            Easing::Slow { out, into } => {
                let [most_speed, most_acceleration] = handle_peaks(out, into);
                [most_speed * speed, most_acceleration * acceleration]
            }
            Easing::Linear | Easing::Hold => [f64::INFINITY; 2],
        }
    }
}

/// Places of a curve with handles that are looked at for its peaks, and what they may miss by between two of them, as a part.
const PLACES: usize = 400;
const BETWEEN: f64 = 1e-3;

/// Largest first and second derivative of progress over time, of `Easing::Slow`: `y'/x'` and `(y'' x' - y' x'') / x'^3` by the curve's parameter.
fn handle_peaks(out: f64, into: f64) -> [f64; 2] {
    let (a, b) = (out, 1.0 - into);
    let mut peaks = [0.0_f64; 2];
    for k in 0..=PLACES {
        let u = k as f64 / PLACES as f64;
        let v = 1.0 - u;
        let x1 = 3.0 * (v * v * a + 2.0 * v * u * (b - a) + u * u * (1.0 - b));
        let x2 = 6.0 * (v * (b - 2.0 * a) + u * (1.0 - 2.0 * b + a));
        let (y1, y2) = (6.0 * u * v, 6.0 - 12.0 * u);
        peaks[0] = peaks[0].max(y1 / x1);
        peaks[1] = peaks[1].max(((y2 * x1 - y1 * x2) / (x1 * x1 * x1)).abs());
    }
    peaks.map(|peak| peak * (1.0 + BETWEEN))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits { speed: 100.0, acceleration: 200.0 };

    #[test]
    fn the_shortest_time_is_a_trapezoid_at_its_limits() {
        // 100 mm/s after 0.5 s and 25 mm.
        assert!((Trapezoid::shortest(50.0, LIMITS) - 1.0).abs() < 1e-12);
        assert!((Trapezoid::shortest(-150.0, LIMITS) - 2.0).abs() < 1e-12);
        assert!((Trapezoid::shortest(12.5, LIMITS) - 0.5).abs() < 1e-12);
        for by in [1e-6, 12.5, 50.0, 150.0, -1e4] {
            let shortest = Trapezoid::shortest(by, LIMITS);
            assert!(Trapezoid::find(by, 0.999 * shortest, [0.0; 2], LIMITS).is_none());
            let found = Trapezoid::find(by, shortest, [0.0; 2], LIMITS).expect("it fits exactly");
            assert!((found.distance() - by).abs() < 1e-8 * by.abs());
        }
    }

    #[test]
    fn peaks_of_handles_are_those_of_differences() {
        for (out, into) in [(1.0 / 3.0, 1.0 / 3.0), (0.7, 0.2), (0.1, 0.9), (0.9, 0.9), (0.05, 0.05)] {
            let easing = Easing::Slow { out, into };
            let [speed, acceleration] = Profile::peaks(easing, 1.0, 1.0);
            let (steps, mut most) = (20_000, [0.0_f64; 2]);
            let dt = 1.0 / f64::from(steps);
            let at = |k: i32| eased(easing, f64::from(k) * dt);
            for k in 1..steps {
                most[0] = most[0].max((at(k + 1) - at(k - 1)) / (2.0 * dt));
                most[1] = most[1].max((at(k + 1) - 2.0 * at(k) + at(k - 1)).abs() / (dt * dt));
            }
            assert!((speed / most[0] - 1.0).abs() < 0.01, "{out} {into}: {speed} {most:?}");
            // At the ends of short handles it falls within one difference.
            assert!((0.999..1.05).contains(&(acceleration / most[1])), "{out} {into}: {acceleration} {most:?}");
        }
    }

    #[test]
    fn trapezoids_cover_the_way_within_limits() {
        let mut seed = 3u64;
        let mut random = |low: f64, high: f64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * (seed >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut found = 0;
        for _ in 0..2000 {
            let (by, duration) = (random(-100.0, 100.0), random(0.05, 3.0));
            let ends = [random(-100.0, 100.0), random(-100.0, 100.0)];
            let Some(trapezoid) = Trapezoid::find(by, duration, ends, LIMITS) else { continue };
            found += 1;
            assert!((trapezoid.at(duration) - by).abs() < 1e-6, "{trapezoid:?}");
            let steps = 4000;
            let dt = duration / f64::from(steps);
            let way: Vec<f64> = (0..=steps).map(|k| trapezoid.at(f64::from(k) * dt)).collect();
            let speeds: Vec<f64> = way.windows(2).map(|w| (w[1] - w[0]) / dt).collect();
            assert!(speeds.iter().all(|v| v.abs() <= 100.0 + 1e-6));
            assert!(
                speeds.windows(2).all(|v| ((v[1] - v[0]) / dt).abs() <= 200.0 * (1.0 + 1e-3) + 1e-3),
                "{trapezoid:?}"
            );
            assert!(
                (speeds[0] - ends[0]).abs() <= 200.0 * dt && (speeds[speeds.len() - 1] - ends[1]).abs() <= 200.0 * dt
            );
        }
        assert!(found > 300, "{found}");
    }
}
