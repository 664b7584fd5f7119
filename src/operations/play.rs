//! The animation of a design on motors, live: a serial port, or simulated controllers in virtual time.

use super::{Cancelled, Context};
use crate::design::Design;
use crate::fabrication::{demands, strong_enough};
use crate::live::{
    Cause, End, Fault, Link, LiveError, Motion, Open, Played, Player, Remote, SerialLink, SimulatedLink, Simulation,
    Stage,
};
use crate::motion::{Family, Forecast, Machine, MotionError, Plan, Stream, TooFast, Trajectory, families};
use serde::{Deserialize, Serialize};
use std::sync::atomic::AtomicBool;

/// The name that stands for simulated controllers in the place of a port.
pub const SIMULATED: &str = "simulated";

/// How motors are driven.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Path of a serial port, or [`SIMULATED`].
    pub port: String,
    /// Family of the controllers by name.
    pub family: String,
    /// Speed of the line, baud; none for the design's with the classic family, 115 200 with others.
    pub baud: Option<u32>,
    pub too_fast: TooFast,
    /// Tell the controllers first that here is zero, and their limits: only at rest, with cables just slack.
    pub set_zero: bool,
    pub action: Action,
    /// Faults of simulated controllers, as [`Fault`] reads them.
    pub faults: Vec<String>,
}

/// What the motors are to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Action {
    /// The motion, so many times.
    Play(u32),
    /// Back to zero, motors off.
    Home,
    /// These lengths by hand, mm, held for so long, s; then back to zero.
    Wind { lengths_mm: Vec<f64>, hold_s: f64 },
}

/// Why nothing was driven, or not to its end.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("the design has no winch-tendon networks yet")]
    NoNetworks,
    #[error("all winches of the design are switched off")]
    AllOff,
    #[error("there are no controllers {name:?} that a computer can tell live; there are {}", known())]
    NoSuchFamily { name: String },
    #[error("{given} lengths for {winches} winches")]
    WrongCount { given: usize, winches: usize },
    #[error("{0}")]
    NoSuchFault(String),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Live(LiveError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// What simulated drives make of the motion.
///
/// # Errors
/// As [`prepare`].
pub fn forecast(design: &Design, options: &Options) -> Result<Forecast, Error> {
    let prepared = prepare(design, options)?;
    let trajectory = Trajectory::of(&design.acting(), options.too_fast)?;
    Ok(Forecast::of(&*prepared.stream, &prepared.plan, &trajectory))
}

/// Everything that a live drive of a design needs besides its port.
pub struct Prepared {
    pub family: &'static Family,
    pub stream: Box<dyn Stream>,
    pub plan: Plan,
    /// No slot is shorter, s.
    pub least_slot_s: f64,
    /// Speed of the line, baud.
    pub baud: u32,
}

/// Speed of the line to families that are not the classic one, baud.
const BAUD: u32 = 115_200;
/// Speed of that to serial bus servos from the factory, baud.
const BUS_BAUD: u32 = 1_000_000;

impl Default for Options {
    fn default() -> Self {
        Self {
            port: SIMULATED.into(),
            family: families::ALL[0].name.into(),
            baud: None,
            too_fast: TooFast::default(),
            set_zero: false,
            action: Action::Play(1),
            faults: Vec::new(),
        }
    }
}

/// Families that can be driven live, for people.
fn known() -> String {
    families::streams().map(|family| family.name).collect::<Vec<_>>().join(", ")
}

/// Works out what the motors are told. Networks that are switched off have none.
///
/// # Errors
/// No networks or no such family, and an animation that its motors cannot play.
pub fn prepare(design: &Design, options: &Options) -> Result<Prepared, Error> {
    let (acting, all) = (design.acting(), design);
    let design = &*acting;
    if design.networks.is_empty() {
        return Err(if all.networks.is_empty() { Error::NoNetworks } else { Error::AllOff });
    }
    let no_such = || Error::NoSuchFamily { name: options.family.clone() };
    let family = families::by_name(&options.family).ok_or_else(no_such)?;
    let make = family.stream.ok_or_else(no_such)?;
    let trajectory = Trajectory::of(design, options.too_fast)?;
    let stream = make(&Machine::new(design, &trajectory))?;
    let baud = options.baud.unwrap_or(match family.name {
        "ascii" => design.controller.drives.baud,
        "bus-servo" => BUS_BAUD,
        _ => BAUD,
    });
    let plan = Plan::of(design, options.too_fast)?;
    Ok(Prepared { family, stream, plan, least_slot_s: 1.0 / design.controller.track_rate_hz, baud })
}

/// Drives motors; how they kept the time, for each time that the motion was played. `tell` is given what they do.
///
/// # Errors
/// [`Error`]; whatever it is, the motors are off, or the error says which could not be told.
pub fn run(
    design: &Design,
    options: &Options,
    context: &Context,
    tell: &mut dyn FnMut(Stage),
) -> Result<Vec<Played>, Error> {
    context.check()?;
    let prepared = prepare(design, options)?;
    if let Action::Wind { lengths_mm, .. } = &options.action {
        let winches = prepared.stream.machine().winches.len();
        if lengths_mm.len() != winches {
            return Err(Error::WrongCount { given: lengths_mm.len(), winches });
        }
    }
    if matches!(options.action, Action::Play(_)) {
        allowed(design, options.too_fast, context.cancel())?;
        context.check()?;
    }
    let mut link = open(&prepared, options)?;
    act(&prepared, options, &mut *link, context, tell).map_err(|error| match error {
        LiveError { cause: Cause::Cancelled, end: End::Off | End::SwitchedOff } => Error::Cancelled(Cancelled),
        error => Error::Live(error),
    })
}

/// Finds the controllers and does what was asked for.
fn act(
    prepared: &Prepared,
    options: &Options,
    link: &mut dyn Link,
    context: &Context,
    tell: &mut dyn FnMut(Stage),
) -> Result<Vec<Played>, LiveError> {
    let (stream, cancel) = (&*prepared.stream, context.cancel());
    // Simulated controllers are as from the factory, with cables just slack.
    let mut player = if options.set_zero || options.port == SIMULATED {
        let mut player = Player::found(stream, link, cancel)?;
        player.set_zero()?;
        player
    } else {
        Player::connect(stream, link, cancel)?
    };
    match &options.action {
        Action::Play(times) => (0..*times).map(|_| player.play(&prepared.plan, prepared.least_slot_s, tell)).collect(),
        Action::Home => player.finish().map(|()| Vec::new()),
        Action::Wind { lengths_mm, hold_s } => {
            player.home()?;
            player.wind(&vec![0.0; lengths_mm.len()], lengths_mm)?;
            player.hold(*hold_s)?;
            player.finish().map(|()| Vec::new())
        }
    }
}

/// The line: simulated, or a port.
fn open(prepared: &Prepared, options: &Options) -> Result<Box<dyn Link>, Error> {
    let faults: Result<Vec<Fault>, String> = options.faults.iter().map(|fault| fault.parse()).collect();
    let faults = faults.map_err(Error::NoSuchFault)?;
    if options.port == SIMULATED {
        return Ok(Box::new(SimulatedLink::new(simulation(prepared).with_faults(faults))));
    }
    let opened = SerialLink::open(&options.port, prepared.baud);
    opened
        .map(|link| Box::new(link) as Box<dyn Link>)
        .map_err(|e| Error::Live(LiveError { cause: Cause::Port(e), end: End::Off }))
}

/// Controllers as a design's family has them.
fn simulation(prepared: &Prepared) -> Simulation {
    let winches = prepared.stream.machine().winches.len();
    Simulation::of(prepared.family, winches).on_line(SIMULATED_LATENCY_S, f64::from(prepared.baud))
}

/// A player on a thread of its own. `wake` is called when its status has changed. Simulated controllers take the time that real ones would.
///
/// # Errors
/// As [`prepare`]; what comes later is told by its status.
pub fn remote(design: &Design, options: &Options, wake: impl Fn() + Send + Sync + 'static) -> Result<Remote, Error> {
    let prepared = prepare(design, options)?;
    let (port, baud) = (options.port.clone(), prepared.baud);
    let simulation = (port == SIMULATED).then(|| simulation(&prepared));
    let open: Open = Box::new(move || match simulation {
        Some(simulation) => Ok(Box::new(SimulatedLink::paced(simulation)) as Box<dyn Link>),
        None => Ok(Box::new(SerialLink::open(&port, baud)?)),
    });
    let (design, too_fast) = (design.clone(), options.too_fast);
    let allowed = Box::new(move |cancel: &AtomicBool| allowed(&design, too_fast, cancel));
    let motion = Motion { plan: prepared.plan, least_slot_s: prepared.least_slot_s, allowed };
    Ok(Remote::start(open, prepared.stream, motion, wake))
}

/// Whether a design's motors are strong enough for its motion, where their maker has said how strong they are. What is cancelled may be allowed.
fn allowed(design: &Design, too_fast: TooFast, cancel: &AtomicBool) -> Result<(), MotionError> {
    let acting = design.acting();
    let trajectory = Trajectory::of(&acting, too_fast)?;
    strong_enough(&acting, &trajectory, &demands(&acting, &trajectory, cancel)).map(drop)
}

/// Time until a simulated reply, s: that of a USB adapter.
const SIMULATED_LATENCY_S: f64 = crate::motion::line::LATENCY_S;
