//! Motors that makers own: a small table that can be edited, and which of them a winch can have.

use super::demand::Demand;

/// The table that is used where no other is given.
pub const BUNDLED: &str = include_str!("../../assets/motors.csv");
const HEADER: &str = "name,kind,torque_nmm,speed_rpm,turn_degrees,shaft_mm,boss_mm,screw_circle_mm,screws,screw_mm";
/// Most motors of a table, and most bytes of its file: what bounds the work of an export.
const MOST_MOTORS: usize = 500;
pub const MOST_BYTES: u64 = 1 << 20;

/// A motor with its gear, as a winch meets it: at its output shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    pub name: String,
    pub kind: Kind,
    /// Torque that it can keep up, N mm.
    pub torque_nmm: f64,
    /// Speed under that torque, rpm.
    pub speed_rpm: f64,
    /// Largest turn, degrees; none for one that turns on.
    pub turn_degrees: Option<f64>,
    pub shaft_mm: f64,
    /// The round part around the shaft that the housing's floor leaves free.
    pub boss_mm: f64,
    /// Circle of the screws in its face, their number and thread; none for a motor that is held by its body.
    pub screw_circle_mm: f64,
    pub screws: usize,
    pub screw_mm: f64,
}

/// How a motor is told where to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// With an encoder and a controller.
    Gearmotor,
    Servo,
    Stepper,
}

/// A table of motors; never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Catalogue(Vec<Motor>);

/// A line of a table that cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {why}")]
pub struct CatalogueError {
    pub line: usize,
    pub why: String,
}

/// Whether a motor suits a winch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fit {
    /// By how many times the motor is stronger, and faster, than it has to be; the lesser of both.
    Fits(f64),
    /// The torque that is missing, N mm.
    TooWeak(f64),
    /// The speed that is missing, rpm.
    TooSlow(f64),
    /// A servo that cannot turn as far. The spool's radius that would do, mm.
    TurnsTooLittle(f64),
}

impl Catalogue {
    /// Reads a table: lines of ten figures after a header, `#` before remarks.
    ///
    /// # Errors
    /// The first line that is not a motor, and why.
    pub fn read(text: &str) -> Result<Self, CatalogueError> {
        let lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
        let mut lines = lines.peekable();
        let fault = |line: usize, why: &str| CatalogueError { line, why: why.into() };
        match lines.next() {
            Some((_, line)) if line.trim() == HEADER => {}
            Some((line, _)) => return Err(fault(line, &format!("the first line must be {HEADER}"))),
            None => return Err(fault(1, "the file has no motors")),
        }
        let motors = lines.map(|(line, text)| motor(text).map_err(|why| CatalogueError { line, why }));
        let motors: Vec<Motor> = motors.take(MOST_MOTORS + 1).collect::<Result<_, _>>()?;
        match motors.len() {
            0 => Err(fault(1, "the file has no motors")),
            1..=MOST_MOTORS => Ok(Self(motors)),
            _ => Err(fault(1, &format!("the file has more than {MOST_MOTORS} motors"))),
        }
    }

    pub fn motors(&self) -> &[Motor] {
        &self.0
    }

    /// The weakest motor that fits all winches; where none does, the one that misses the least torque.
    pub fn choice(&self, demands: &[Demand], radius_mm: f64) -> &Motor {
        let fits = |m: &&Motor| demands.iter().all(|d| matches!(m.fit(d, radius_mm), Fit::Fits(_)));
        let weakest = self.0.iter().filter(fits).min_by(|a, b| a.torque_nmm.total_cmp(&b.torque_nmm));
        // A catalogue has at least one motor.
        weakest.or_else(|| self.0.iter().max_by(|a, b| a.torque_nmm.total_cmp(&b.torque_nmm))).unwrap_or(&self.0[0])
    }
}

impl Default for Catalogue {
    fn default() -> Self {
        Self::read(BUNDLED).unwrap_or_else(|error| unreachable!("the bundled table: {error}"))
    }
}

impl Motor {
    /// Whether it can do what a winch asks for, with a spool of a radius.
    pub fn fit(&self, demand: &Demand, radius_mm: f64) -> Fit {
        if self.torque_nmm < demand.torque_nmm {
            return Fit::TooWeak(demand.torque_nmm - self.torque_nmm);
        }
        if let Some(most) = self.turn_degrees.filter(|&most| most < demand.turn_degrees) {
            return Fit::TurnsTooLittle(radius_mm * demand.turn_degrees / most);
        }
        if self.speed_rpm < demand.speed_rpm {
            return Fit::TooSlow(demand.speed_rpm - self.speed_rpm);
        }
        let times = |is: f64, asked: f64| if asked > 0.0 { is / asked } else { f64::INFINITY };
        Fit::Fits(times(self.torque_nmm, demand.torque_nmm).min(times(self.speed_rpm, demand.speed_rpm)))
    }
}

fn motor(line: &str) -> Result<Motor, String> {
    let fields: Vec<&str> = line.split(',').map(str::trim).collect();
    let columns: Vec<&str> = HEADER.split(',').collect();
    if fields.len() != columns.len() {
        return Err(format!("{} fields instead of {}", fields.len(), columns.len()));
    }
    let figure = |k: usize| -> Result<f64, String> {
        let value: f64 = fields[k].parse().map_err(|_| format!("{} is no number: {:?}", columns[k], fields[k]))?;
        if (0.0..=1e6).contains(&value) { Ok(value) } else { Err(format!("{} is not between 0 and 1e6", columns[k])) }
    };
    let positive = |k: usize| match figure(k)? {
        value if value > 0.0 => Ok(value),
        _ => Err(format!("{} must be more than 0", columns[k])),
    };
    let kind = match fields[1] {
        "gearmotor" => Kind::Gearmotor,
        "servo" => Kind::Servo,
        "stepper" => Kind::Stepper,
        other => return Err(format!("kind is gearmotor, servo or stepper, not {other:?}")),
    };
    if fields[0].is_empty() || fields[0].chars().any(char::is_control) {
        return Err("the motor has no name".into());
    }
    Ok(Motor {
        name: fields[0].into(),
        kind,
        torque_nmm: positive(2)?,
        speed_rpm: positive(3)?,
        turn_degrees: if fields[4].is_empty() { None } else { Some(positive(4)?) },
        shaft_mm: positive(5)?,
        boss_mm: figure(6)?,
        screw_circle_mm: figure(7)?,
        screws: figure(8)? as usize,
        screw_mm: figure(9)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bundled_table_is_read_and_faults_are_named_with_their_line() {
        assert!(Catalogue::default().motors().len() >= 8);
        let fault = |text: &str| Catalogue::read(text).unwrap_err().to_string();
        assert!(fault("").contains("no motors"));
        assert!(fault("name,kind\n").starts_with("line 1: the first line must be"));
        let with = |line: &str| format!("# mine\n{HEADER}\n{line}\n");
        assert_eq!(fault(&with("a,servo,1,2,180,4")), "line 3: 6 fields instead of 10");
        assert_eq!(fault(&with("a,servo,x,2,180,4,0,0,0,0")), "line 3: torque_nmm is no number: \"x\"");
        assert_eq!(fault(&with("a,dog,1,2,180,4,0,0,0,0")), "line 3: kind is gearmotor, servo or stepper, not \"dog\"");
        assert_eq!(fault(&with("a,servo,1,0,180,4,0,0,0,0")), "line 3: speed_rpm must be more than 0");
    }

    #[test]
    fn a_servo_that_turns_too_little_is_told_the_spool_that_would_do() {
        let text = format!("{HEADER}\nsmall,servo,50,80,180,4,12,0,0,0\nstrong,gearmotor,500,10,,6,12,0,0,0\n");
        let catalogue = Catalogue::read(&text).unwrap();
        let demand =
            |torque_nmm, speed_rpm, turn_degrees| Demand { torque_nmm, speed_rpm, turn_degrees, ..Demand::default() };
        let [small, strong] = catalogue.motors() else { panic!("two") };
        assert_eq!(small.fit(&demand(40.0, 20.0, 210.0), 10.0), Fit::TurnsTooLittle(10.0 * 210.0 / 180.0));
        assert_eq!(small.fit(&demand(60.0, 20.0, 90.0), 10.0), Fit::TooWeak(10.0));
        assert_eq!(strong.fit(&demand(60.0, 20.0, 900.0), 10.0), Fit::TooSlow(10.0));
        assert_eq!(small.fit(&demand(25.0, 20.0, 90.0), 10.0), Fit::Fits(2.0));
        assert_eq!(catalogue.choice(&[demand(25.0, 20.0, 90.0)], 10.0).name, "small");
        assert_eq!(catalogue.choice(&[demand(60.0, 20.0, 90.0)], 10.0).name, "strong");
    }
}
