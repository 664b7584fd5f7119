//! How a position drive moves: a trapezoid of speed, planned anew whenever it is told something else.
//!
//! It speeds up towards its target with one rate to its speed limit, and slows down with another so that it stands still there. Nothing pulls at it.

/// A drive. Positions in whatever units, rates in those units and s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    pub position: f64,
    pub velocity: f64,
    pub target: f64,
    pub speed: f64,
    pub acceleration: f64,
    pub deceleration: f64,
}

/// Step of the simulation, s: a drive is where it would be to within its way in one step.
pub const TICK_S: f64 = 5e-4;
/// A drive this near to its target, and slow, is there, units.
const THERE: f64 = 0.5;

impl Drive {
    /// At rest at zero, with these limits.
    pub fn new(speed: f64, acceleration: f64) -> Self {
        Self { position: 0.0, velocity: 0.0, target: 0.0, speed, acceleration, deceleration: acceleration }
    }

    /// Whether it stands at its target.
    pub fn is_there(&self) -> bool {
        self.position == self.target && self.velocity == 0.0
    }

    /// Stays where it is.
    pub fn halt(&mut self) {
        (self.velocity, self.target) = (0.0, self.position);
    }

    /// Moves for `duration_s`.
    pub fn pass(&mut self, duration_s: f64) {
        let ticks = (duration_s / TICK_S).ceil().max(1.0);
        for _ in 0..ticks as u64 {
            if self.is_there() {
                return;
            }
            self.tick(duration_s / ticks);
        }
    }

    fn tick(&mut self, dt: f64) {
        let distance = self.target - self.position;
        let (rise, fall) = (self.acceleration, self.deceleration);
        if distance.abs() < THERE && self.velocity.abs() <= 2.0 * fall * dt {
            (self.position, self.velocity) = (self.target, 0.0);
            return;
        }
        // The speed from which the way that is left after this tick is just enough to stop: v dt + v^2 / (2 fall) = distance.
        let stopping = (fall * dt).hypot((2.0 * fall * distance.abs()).sqrt()) - fall * dt;
        let wanted = distance.signum() * stopping.min(self.speed);
        let speeding_up = wanted.abs() > self.velocity.abs() && wanted * self.velocity >= 0.0;
        let most = dt * if speeding_up { rise } else { fall };
        self.velocity += (wanted - self.velocity).clamp(-most, most);
        self.position += self.velocity * dt;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drive_runs_a_trapezoid() {
        let mut drive = Drive { deceleration: 40_000.0, target: 10_000.0, ..Drive::new(10_000.0, 20_000.0) };
        // 10 000 units/s after 0.5 s (2500 units), 0.25 s to stop (1250), the rest at full speed: 1.375 s in all.
        drive.pass(0.5);
        assert!((drive.position - 2500.0).abs() < 20.0, "{}", drive.position);
        drive.pass(0.85);
        assert!(!drive.is_there());
        drive.pass(0.035);
        assert!(drive.is_there() && drive.position == 10_000.0, "{}", drive.position);
        drive.target = -5.0;
        drive.pass(0.2);
        drive.halt();
        assert!(drive.is_there() && drive.position < 10_000.0);
    }
}
