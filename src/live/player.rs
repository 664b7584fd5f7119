//! The player: tells controllers what to do, one command after the other, each with its reply, every start at its time.
//!
//! Whatever goes wrong, it switches all motors off before it says so; also when it is dropped while they are on.

use super::error::{Cause, End, LiveError};
use super::link::Link;
use super::report::Played;
use crate::motion::{Beat, Move, Plan, Stream, beats, left_out, slot_s};
use std::sync::atomic::{AtomicBool, Ordering};

/// Motors on a line.
pub struct Player<'a> {
    stream: &'a dyn Stream,
    link: &'a mut dyn Link,
    cancel: &'a AtomicBool,
    /// What has come of a reply that is not whole.
    received: Vec<u8>,
    /// A command and its reply, s: the slowest but one of those that asked where winches are, as a busy host may hold up one.
    round_trip_s: f64,
    motors: Motors,
    /// When the winches stand still that were last wound by hand, on the link's clock, s.
    still_s: f64,
}

/// What the motors were last told.
#[derive(Clone, Copy, PartialEq)]
enum Motors {
    Off,
    /// They may be on, and in whatever mode: setting zero does that, and switching on that broke off.
    Unsure,
    /// They are on and wait for moves.
    Ready,
}

/// What a player is doing.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// Winds back to zero.
    Homing,
    /// Plays the motion: time in it, and where the winches are told to be, mm.
    Playing { time_s: f64, lengths_mm: Vec<f64> },
}

/// Longest wait for a reply, s: a command and its reply take some 10 ms at 9600 baud, and USB adapters add 16.
pub const PATIENCE_S: f64 = 0.5;
/// Longest wait for the first one, s: boards that are reset when their port is opened take two seconds to begin.
const FIRST_PATIENCE_S: f64 = 3.0;
/// Longest wait for a motor to say that it is off, s, but on a line with slow replies: others are still to be told.
const HALT_PATIENCE_S: f64 = 0.15;
/// The line is quiet when nothing came for so long, s.
const QUIET_S: f64 = 0.02;
/// Whether to stop is looked at this often while waiting, s.
const LOOK_S: f64 = 0.02;
/// So far beyond its travel a winch may stand at the beginning, mm: what a stopped drive gives way under load.
pub const LIMIT_TOLERANCE_MM: f64 = 0.5;
/// So near to zero a winch is back, mm: a drive under load stands a little off its target.
const HOME_TOLERANCE_MM: f64 = 0.3;
/// How often it is looked where winches are on their way to zero, s.
const HOMING_LOOK_S: f64 = 0.1;
/// A start that is this late is not the line's jitter: it cannot keep up, s.
const TOO_LATE_S: f64 = 1.0;
/// Moves are loaded this many times before their time that loading takes: some replies come late.
const LOAD_MARGIN: f64 = 1.5;
/// Questions where each winch is, by which replies are timed.
const PROBES: usize = 3;

impl<'a> Player<'a> {
    /// Finds the controllers, and sees that every winch stands within its travel. Motors stay as they are.
    ///
    /// # Errors
    /// [`LiveError`]: nobody answers, or a winch stands beyond its travel.
    pub fn connect(stream: &'a dyn Stream, link: &'a mut dyn Link, cancel: &'a AtomicBool) -> Result<Self, LiveError> {
        let mut player = Self::found(stream, link, cancel)?;
        player.guard(|player| player.check_places())?;
        Ok(player)
    }

    /// As [`Player::connect`], for winches that are to be told that here is zero: they may stand anywhere.
    ///
    /// # Errors
    /// [`LiveError`]: nobody answers.
    pub fn found(stream: &'a dyn Stream, link: &'a mut dyn Link, cancel: &'a AtomicBool) -> Result<Self, LiveError> {
        let (received, motors) = (Vec::new(), Motors::Off);
        let mut player = Self { stream, link, cancel, received, round_trip_s: 0.0, motors, still_s: 0.0 };
        player.guard(|player| {
            player.wake()?;
            player.quiet()?;
            player.place_within(0, FIRST_PATIENCE_S)?;
            let mut trips_s = Vec::new();
            for _ in 0..PROBES {
                for winch in 0..player.winches() {
                    let asked_s = player.link.now_s();
                    player.place(winch)?;
                    trips_s.push(player.link.now_s() - asked_s);
                }
            }
            trips_s.sort_by(f64::total_cmp);
            player.round_trip_s = trips_s.iter().rev().nth(1).copied().unwrap_or(0.0);
            Ok(())
        })?;
        Ok(player)
    }

    /// Where the winches are, mm.
    ///
    /// # Errors
    /// [`LiveError`]; motors are switched off.
    pub fn places_mm(&mut self) -> Result<Vec<f64>, LiveError> {
        self.guard(|player| (0..player.winches()).map(|winch| player.place(winch)).collect())
    }

    /// Tells the controllers that here is zero, and their limits. Only at rest, with cables just slack.
    ///
    /// # Errors
    /// [`LiveError`]; motors are switched off.
    pub fn set_zero(&mut self) -> Result<(), LiveError> {
        self.guard(|player| {
            player.settle()?;
            // Some families find zero with their motors on.
            player.motors = Motors::Unsure;
            player.tell_all(player.stream.setup())
        })
    }

    /// Winds back to zero, slowly, and leaves the motors on.
    ///
    /// # Errors
    /// [`LiveError`]; motors are switched off.
    pub fn home(&mut self) -> Result<(), LiveError> {
        self.guard(|player| player.go_home())
    }

    /// Winds back to zero, plays a plan in slots of at least `least_slot_s`, winds back again, and switches the motors off.
    ///
    /// # Errors
    /// [`LiveError`]; motors are switched off.
    pub fn play(&mut self, plan: &Plan, least_slot_s: f64, tell: &mut dyn FnMut(Stage)) -> Result<Played, LiveError> {
        self.guard(|player| {
            tell(Stage::Homing);
            player.go_home()?;
            let played = player.play_beats(plan, least_slot_s, tell)?;
            tell(Stage::Homing);
            player.go_home()?;
            player.rest()?;
            Ok(played)
        })
    }

    /// Winds by hand: from where the winches were told to be to other lengths, mm, slowly; returns when they are told, not when they are there:
    /// what is told next, but for [`Player::halt`], waits until they are.
    ///
    /// # Errors
    /// [`LiveError`]: a length beyond the travel, or a fault; motors are switched off.
    pub fn wind(&mut self, from_mm: &[f64], to_mm: &[f64]) -> Result<(), LiveError> {
        self.guard(|player| player.wind_to(from_mm, to_mm))
    }

    /// Whether the winches have come to where they were last wound by hand.
    pub fn is_still(&self) -> bool {
        self.link.now_s() >= self.still_s
    }

    /// Holds what is wound, s.
    ///
    /// # Errors
    /// [`LiveError`]: it was cancelled; motors are switched off.
    pub fn hold(&mut self, duration_s: f64) -> Result<(), LiveError> {
        self.guard(|player| player.wait_until(player.link.now_s() + duration_s))
    }

    /// Winds back to zero and switches the motors off.
    ///
    /// # Errors
    /// [`LiveError`]; motors are switched off.
    pub fn finish(&mut self) -> Result<(), LiveError> {
        self.guard(|player| {
            player.go_home()?;
            player.rest()
        })
    }

    /// Switches all motors off at once.
    pub fn halt(&mut self) -> End {
        self.motors = Motors::Off;
        // What is still to come belongs to commands before.
        let _ = self.quiet();
        self.received.clear();
        let told =
            self.stream.halt().iter().all(|command| self.link.send(&self.stream.framing().encode(command)).is_ok());
        let patience_s = HALT_PATIENCE_S.max(2.0 * self.round_trip_s);
        let mut silent = Vec::new();
        for command in self.stream.confirm_halt() {
            let _ = self.quiet();
            let reply = if told { self.uncancelled(&command, patience_s) } else { Err(Cause::Cancelled) };
            if reply.is_err() {
                silent.push(self.who(&command));
            }
        }
        silent.dedup();
        if silent.is_empty() { End::SwitchedOff } else { End::Unconfirmed(silent) }
    }

    fn winches(&self) -> usize {
        self.stream.machine().winches.len()
    }

    /// Does something; what goes wrong ends with motors off.
    fn guard<T>(&mut self, what: impl FnOnce(&mut Self) -> Result<T, Cause>) -> Result<T, LiveError> {
        what(self).map_err(|cause| {
            let end = if self.motors == Motors::Off { End::Off } else { self.halt() };
            LiveError { cause, end }
        })
    }

    /// Who a command is for, in words.
    fn who(&self, command: &str) -> String {
        match self.stream.addressed(command).filter(|winch| *winch < self.winches()) {
            Some(winch) => self.named(winch),
            None => "the controller".into(),
        }
    }

    fn named(&self, winch: usize) -> String {
        format!("winch {:?} ({})", self.stream.machine().winches[winch], self.stream.address(winch))
    }

    fn check_cancel(&self) -> Result<(), Cause> {
        if self.cancel.load(Ordering::SeqCst) { Err(Cause::Cancelled) } else { Ok(()) }
    }

    fn put(&mut self, command: &str) -> Result<(), Cause> {
        self.link.send(&self.stream.framing().encode(command)).map_err(Cause::Broken)
    }

    /// Waits until nothing comes any more, and forgets it.
    fn quiet(&mut self) -> Result<(), Cause> {
        let end_s = self.link.now_s() + PATIENCE_S;
        while self.link.now_s() < end_s && !self.link.receive(QUIET_S).map_err(Cause::Broken)?.is_empty() {}
        self.received.clear();
        Ok(())
    }

    /// Sends a command; its reply, whatever it is.
    fn exchange(&mut self, command: &str, patience_s: f64) -> Result<String, Cause> {
        self.put(command)?;
        let end_s = self.link.now_s() + patience_s;
        loop {
            while let Some(reply) = self.stream.framing().take_reply(&mut self.received) {
                if !self.stream.is_aside(&reply) {
                    return Ok(reply);
                }
            }
            self.check_cancel()?;
            let rest_s = end_s - self.link.now_s();
            // A host that was held up still finds what has come meanwhile.
            let bytes = self.link.receive(rest_s.clamp(0.0, LOOK_S)).map_err(Cause::Broken)?;
            if bytes.is_empty() && rest_s <= 0.0 {
                let (who, command) = (self.who(command), command.to_owned());
                return Err(Cause::NoReply { who, command, patience_s });
            }
            self.received.extend(bytes);
        }
    }

    /// Sends a command and sees that it was taken.
    fn tell(&mut self, command: &str) -> Result<(), Cause> {
        self.check_cancel()?;
        let reply = self.exchange(command, PATIENCE_S)?;
        self.stream.taken(command, &reply).map_err(|reply| self.refused(command, reply))
    }

    /// As [`Player::tell`], while there is no time to stop.
    fn uncancelled(&mut self, command: &str, patience_s: f64) -> Result<(), Cause> {
        let never = AtomicBool::new(false);
        let (stream, link, received, motors) = (self.stream, &mut *self.link, Vec::new(), Motors::Off);
        let reply = Player { stream, link, cancel: &never, received, round_trip_s: 0.0, motors, still_s: 0.0 }
            .exchange(command, patience_s)?;
        self.stream.taken(command, &reply).map_err(|reply| self.refused(command, reply))
    }

    fn refused(&self, command: &str, reply: String) -> Cause {
        Cause::Refused { who: self.who(command), command: command.to_owned(), reply }
    }

    fn tell_all(&mut self, commands: Vec<String>) -> Result<(), Cause> {
        commands.iter().try_for_each(|command| self.tell(command))
    }

    /// Where a winch is, mm.
    fn place(&mut self, winch: usize) -> Result<f64, Cause> {
        self.place_within(winch, PATIENCE_S)
    }

    fn place_within(&mut self, winch: usize, patience_s: f64) -> Result<f64, Cause> {
        self.check_cancel()?;
        let command = self.stream.locate(winch);
        let reply = self.exchange(&command, patience_s)?;
        self.stream.place_mm(winch, &reply).ok_or_else(|| Cause::Refused {
            who: self.named(winch),
            reply: format!("{reply:?}"),
            command,
        })
    }

    /// Refuses winches that stand beyond their travel.
    fn check_places(&mut self) -> Result<(), Cause> {
        for winch in 0..self.winches() {
            let (at_mm, travel_mm) = (self.place(winch)?, self.stream.machine().travel_mm[winch]);
            if !(-LIMIT_TOLERANCE_MM..=travel_mm + LIMIT_TOLERANCE_MM).contains(&at_mm) {
                return Err(Cause::Beyond { who: self.named(winch), at_mm, travel_mm });
            }
        }
        Ok(())
    }

    /// Brings controllers to listen that a line was just opened to, or that were switched off.
    fn wake(&mut self) -> Result<(), Cause> {
        let commands = self.stream.wake();
        if commands.is_empty() || self.motors != Motors::Off {
            return Ok(());
        }
        let asleep = match self.exchange(&self.stream.locate(0), PATIENCE_S) {
            Ok(reply) => self.stream.sleeps(&reply),
            // A board that is just beginning does not sleep.
            Err(Cause::NoReply { .. }) => false,
            Err(cause) => return Err(cause),
        };
        commands.iter().try_for_each(|command| self.put(command))?;
        self.quiet()?;
        if asleep { self.tell_all(self.stream.unlock()) } else { Ok(()) }
    }

    /// Waits for winches that were wound by hand, and for controllers that were switched off.
    fn settle(&mut self) -> Result<(), Cause> {
        self.wait_until(self.still_s)?;
        self.wake()
    }

    fn switch_on(&mut self) -> Result<(), Cause> {
        self.motors = Motors::Unsure;
        self.tell_all(self.stream.ready())?;
        self.motors = Motors::Ready;
        Ok(())
    }

    fn rest(&mut self) -> Result<(), Cause> {
        self.tell_all(self.stream.off())?;
        self.motors = Motors::Off;
        Ok(())
    }

    fn go_home(&mut self) -> Result<(), Cause> {
        self.settle()?;
        self.check_places()?;
        self.switch_on()?;
        // Slower than motions are.
        self.motors = Motors::Unsure;
        self.tell_all(self.stream.load_home())?;
        self.tell_all(self.stream.go_home())?;
        let within_s = self.stream.machine().stopping_s() + self.stream.home_s();
        let end_s = self.link.now_s() + within_s;
        for winch in 0..self.winches() {
            loop {
                let at_mm = self.place(winch)?;
                if at_mm.abs() <= HOME_TOLERANCE_MM {
                    break;
                }
                if self.link.now_s() > end_s {
                    return Err(Cause::NotHome { who: self.named(winch), at_mm, within_s });
                }
                self.wait_until(self.link.now_s() + HOMING_LOOK_S)?;
            }
        }
        Ok(())
    }

    fn wait_until(&mut self, time_s: f64) -> Result<(), Cause> {
        while self.link.now_s() < time_s {
            self.check_cancel()?;
            self.link.wait_until(time_s.min(self.link.now_s() + LOOK_S));
        }
        self.check_cancel()
    }

    fn play_beats(&mut self, plan: &Plan, least_slot_s: f64, tell: &mut dyn FnMut(Stage)) -> Result<Played, Cause> {
        self.switch_on()?;
        let slot_s = slot_s(self.stream, self.round_trip_s, least_slot_s);
        let early_s = self.stream.queued() as f64 * slot_s;
        let mut played = Played { slot_s, round_trip_s: self.round_trip_s, ..Played::default() };
        let mut began_s = None;
        let mut lengths_mm = plan.at(plan.span_s()[0]);
        let beats = beats(plan, self.stream, slot_s, f64::INFINITY);
        if let Some(winch) = left_out(plan, &beats) {
            return Err(Cause::LeftOut { who: self.named(winch), slot_s });
        }
        for Beat { due_s, moves } in beats {
            // Not earlier than needed: what is loaded may already count for the move before.
            let loads = moves.iter().map(|step| self.stream.load(step).len()).sum::<usize>();
            if let (Some(began_s), true) = (began_s, loads > 0) {
                self.wait_until(began_s + due_s - early_s - LOAD_MARGIN * loads as f64 * self.round_trip_s)?;
            }
            for step in &moves {
                self.tell_all(self.stream.load(step))?;
            }
            // The clock starts when the first move is loaded.
            let due_s = *began_s.get_or_insert(self.link.now_s()) + due_s;
            // Moves that wait in a queue are sent before their time, and are late only after it.
            self.wait_until(due_s - early_s)?;
            let late_s = (self.link.now_s() - due_s).max(0.0);
            if late_s > TOO_LATE_S {
                return Err(Cause::TooSlow { slot_s, late_s });
            }
            played.late.push(late_s);
            moves.iter().for_each(|step| lengths_mm[step.winch] = step.to_mm);
            self.tell_all(self.stream.go(&moves))?;
            tell(Stage::Playing { time_s: due_s - began_s.unwrap_or(due_s), lengths_mm: lengths_mm.clone() });
        }
        // The last moves are still on their way.
        let [begin, end] = plan.span_s();
        let began_s = began_s.unwrap_or(self.link.now_s());
        self.wait_until(began_s + end - begin)?;
        played.lasted_s = self.link.now_s() - began_s;
        Ok(played)
    }

    fn wind_to(&mut self, from_mm: &[f64], to_mm: &[f64]) -> Result<(), Cause> {
        let machine = self.stream.machine();
        for (winch, (&asked_mm, &travel_mm)) in to_mm.iter().zip(&machine.travel_mm).enumerate() {
            if !(0.0..=travel_mm).contains(&asked_mm) {
                return Err(Cause::Asked { who: self.named(winch), asked_mm, travel_mm });
            }
        }
        let speed = machine.gently().speed;
        self.settle()?;
        if self.motors != Motors::Ready {
            self.switch_on()?;
        }
        let longest = from_mm.iter().zip(to_mm).map(|(from, to)| (to - from).abs()).fold(0.0, f64::max);
        let duration_s = (longest / speed).max(LOOK_S);
        let one = |winch: usize| Move { winch, from_mm: from_mm[winch], to_mm: to_mm[winch], duration_s };
        let moves: Vec<Move> = (0..to_mm.len()).map(one).collect();
        if self.stream.moves_together() {
            self.tell_all(self.stream.go(&moves))?;
        } else {
            for step in moves.iter().filter(|step| step.from_mm != step.to_mm) {
                self.tell_all(self.stream.load(step))?;
                self.tell_all(self.stream.go(&[*step]))?;
            }
        }
        self.still_s = self.link.now_s() + duration_s;
        Ok(())
    }
}

impl Drop for Player<'_> {
    fn drop(&mut self) {
        if self.motors != Motors::Off {
            self.halt();
        }
    }
}
