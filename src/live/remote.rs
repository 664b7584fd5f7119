//! A player on a thread of its own, for a window: told by orders, watched by its status, stopped when nobody watches.

use super::error::{Cause, End, LiveError};
use super::link::Link;
use super::player::{Player, Stage};
use crate::motion::{MotionError, Plan, Stream};
use std::collections::VecDeque;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// What to do next: begun when the one before is done. See [`Remote::order`] for what takes the place of what.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// Here is zero: only at rest, with cables just slack.
    SetZero,
    /// Play the motion, from zero and back to it.
    Play,
    /// Wind to these lengths by hand, mm.
    Wind(Vec<f64>),
    /// Back to zero, motors off.
    Home,
}

/// What the motors do.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// The controllers are being looked for.
    Connecting,
    /// They wait for an order; where the winches are told to be, mm.
    Ready(Vec<f64>),
    /// They are told that here is zero.
    Zeroing,
    /// Whether they may play the motion is worked out.
    Checking,
    Homing,
    /// Time in the motion, s, and where the winches are told to be, mm.
    Playing {
        time_s: f64,
        lengths_mm: Vec<f64>,
    },
    /// The line is closed; why, in a sentence, and whether somebody wanted it so.
    Ended {
        why: String,
        wanted: bool,
    },
}

/// The thread and what it is told.
pub struct Remote {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
}

/// Opens the line: on the thread, as that may take long.
pub type Open = Box<dyn FnOnce() -> io::Result<Box<dyn Link>> + Send>;

/// Whether the motors may play the motion: on the thread, as the answer may take long. Any will do once it is told to stop.
pub type Allowed = Box<dyn Fn(&AtomicBool) -> Result<(), MotionError> + Send>;

/// The motion that is played when that is ordered.
pub struct Motion {
    pub plan: Plan,
    /// No slot is shorter, s.
    pub least_slot_s: f64,
    /// Asked before each time.
    pub allowed: Allowed,
}

struct Shared {
    orders: Mutex<VecDeque<Order>>,
    come: Condvar,
    status: Mutex<Status>,
    cancel: AtomicBool,
    seen: Mutex<Instant>,
    wake: Box<dyn Fn() + Send + Sync>,
}

/// A window that shows nothing for so long is lost.
const LOST: Duration = Duration::from_millis(2000);
/// How often that is looked at.
const LOOK: Duration = Duration::from_millis(50);
/// How often it is looked whether winches that are wound by hand are there, s.
const STEP_S: f64 = 0.02;

impl Remote {
    /// Opens a line and waits for orders. `wake` is called when the status has changed.
    pub fn start(open: Open, stream: Box<dyn Stream>, motion: Motion, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let shared = Arc::new(Shared {
            orders: Mutex::default(),
            come: Condvar::new(),
            status: Mutex::new(Status::Connecting),
            cancel: AtomicBool::new(false),
            seen: Mutex::new(Instant::now()),
            wake: Box::new(wake),
        });
        let (own, watch) = (shared.clone(), shared.clone());
        let player = std::thread::spawn(move || own.run(open, &*stream, &motion));
        let watcher = std::thread::spawn(move || watch.watch());
        Self { shared, threads: vec![player, watcher] }
    }

    /// Gives an order, in the place of the last one that is not yet begun; but a zero that is to be set is never passed over, as all lengths after it
    /// count from there.
    pub fn order(&self, order: Order) {
        line_up(&mut held(&self.shared.orders), order);
        self.shared.come.notify_all();
    }

    /// Switches all motors off and closes the line.
    pub fn stop(&self) {
        self.shared.stop();
    }

    pub fn status(&self) -> Status {
        held(&self.shared.status).clone()
    }

    /// The window is there.
    pub fn seen(&self) {
        *held(&self.shared.seen) = Instant::now();
    }
}

impl Drop for Remote {
    fn drop(&mut self) {
        self.stop();
        for thread in self.threads.drain(..) {
            // A thread that broke has nothing to tell any more: its player has switched the motors off.
            let _ = thread.join();
        }
    }
}

impl Shared {
    fn stop(&self) {
        self.cancel.store(true, Ordering::SeqCst);
        self.come.notify_all();
    }

    fn tell(&self, status: Status) {
        *held(&self.status) = status;
        (self.wake)();
    }

    fn is_over(&self) -> bool {
        matches!(*held(&self.status), Status::Ended { .. })
    }

    /// Stops when the window is lost.
    fn watch(&self) {
        while !self.cancel.load(Ordering::SeqCst) && !self.is_over() {
            std::thread::sleep(LOOK);
            if held(&self.seen).elapsed() > LOST {
                self.stop();
            }
        }
    }

    fn run(&self, open: Open, stream: &dyn Stream, motion: &Motion) {
        let outcome = open().map_err(|e| LiveError { cause: Cause::Port(e), end: End::Off });
        let outcome = outcome.and_then(|mut link| self.serve(&mut *link, stream, motion));
        let error = match outcome {
            Err(error) => error,
            Ok(()) => LiveError { cause: Cause::Cancelled, end: End::Off },
        };
        let wanted = matches!(error.cause, Cause::Cancelled);
        self.tell(Status::Ended { why: error.to_string(), wanted });
    }

    fn serve(&self, link: &mut dyn Link, stream: &dyn Stream, motion: &Motion) -> Result<(), LiveError> {
        // Zero may have to be set first: beyond the travel, everything else is refused when it is asked for.
        let mut player = Player::found(stream, link, &self.cancel)?;
        let mut told_mm = player.places_mm()?;
        loop {
            self.tell(Status::Ready(told_mm.clone()));
            match self.next(&mut player)? {
                None => {
                    let end = player.halt();
                    return Err(LiveError { cause: Cause::Cancelled, end });
                }
                Some(Order::SetZero) => {
                    self.tell(Status::Zeroing);
                    player.set_zero()?;
                }
                Some(Order::Play) => {
                    self.tell(Status::Checking);
                    if let Err(error) = (motion.allowed)(&self.cancel) {
                        return Err(LiveError { cause: error.into(), end: player.halt() });
                    }
                    let tell = &mut |stage| self.tell(Status::from(stage));
                    drop(player.play(&motion.plan, motion.least_slot_s, tell)?)
                }
                Some(Order::Home) => {
                    self.tell(Status::Homing);
                    player.finish()?;
                }
                Some(Order::Wind(to_mm)) => {
                    player.wind(&told_mm, &to_mm)?;
                    told_mm = to_mm;
                    continue;
                }
            }
            told_mm = vec![0.0; told_mm.len()];
        }
    }

    /// The next order, once winches that are wound by hand have come to where they were told: until then a newer one may take its place. None when
    /// it is to stop.
    fn next(&self, player: &mut Player) -> Result<Option<Order>, LiveError> {
        while !self.cancel.load(Ordering::SeqCst) {
            if !player.is_still() {
                player.hold(STEP_S)?;
                continue;
            }
            let orders = held(&self.orders);
            let mut orders = if orders.is_empty() {
                self.come.wait_timeout(orders, LOOK).unwrap_or_else(PoisonError::into_inner).0
            } else {
                orders
            };
            if let Some(order) = orders.pop_front() {
                return Ok(Some(order));
            }
        }
        Ok(None)
    }
}

/// Takes an order into those that wait: at most a zero to be set, and one behind it.
fn line_up(waiting: &mut VecDeque<Order>, order: Order) {
    if waiting.back().is_some_and(|last| *last != Order::SetZero) {
        waiting.pop_back();
    }
    if waiting.back() != Some(&order) {
        waiting.push_back(order);
    }
}

impl From<Stage> for Status {
    fn from(stage: Stage) -> Self {
        match stage {
            Stage::Homing => Self::Homing,
            Stage::Playing { time_s, lengths_mm } => Self::Playing { time_s, lengths_mm },
        }
    }
}

/// What a thread that broke has held is still whole.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_order_waits_but_a_zero_is_never_passed_over() {
        let wind = |mm: f64| Order::Wind(vec![mm]);
        let waiting = |orders: &[Order]| {
            let mut waiting = VecDeque::new();
            orders.iter().for_each(|order| line_up(&mut waiting, order.clone()));
            Vec::from(waiting)
        };
        assert_eq!(waiting(&[wind(1.0), Order::Play, wind(2.0)]), [wind(2.0)]);
        let zero = Order::SetZero;
        assert_eq!(waiting(&[wind(1.0), zero.clone(), zero.clone(), wind(2.0), wind(3.0)]), [zero.clone(), wind(3.0)]);
        assert_eq!(waiting(&[zero.clone(), wind(1.0), zero.clone()]), [zero]);
    }
}
