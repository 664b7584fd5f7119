//! The solver on a thread of its own, for the window: the interface never waits.
//!
//! One-place mailboxes in both directions: a newer request replaces one that has not been started, a newer outcome
//! replaces one that has not been taken. A running request is left to finish, so that shapes keep coming while somebody
//! drags; only when it has run longer than [`PATIENCE`] while a newer one waits is it told to stop, and then it answers
//! with the best state it has reached.
//!
//! A drag is followed with the effort its [`super::Quality`] allows, from one posture to the next, and may end short of
//! equilibrium or in a worse pose than can be reached. So once nothing newer waits, the same request is answered again with all
//! effort, and the answer replaces the first one where it is better. Anything newer stops that at once.

use super::{Effort, Outcome, Request, Setpoint, Shape, Solver, Warning};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long a request may run on while a newer one waits. Long enough that a normal solve (some tens of ms) always
/// finishes, short enough that a hard one does not freeze a drag.
pub const PATIENCE: Duration = Duration::from_millis(300);

/// A thorough answer replaces the interactive one where an error falls by more than this, in body lengths: below what
/// can be seen, a shape that changes by itself only disturbs.
const WORTH_SHOWING: f64 = 1e-3;

/// What came of a solver's call; `Err` is a caught panic.
type Solved = Result<Outcome, Box<dyn Any + Send>>;

/// Answers requests in the background. Dropping it cancels what runs and joins its threads.
pub struct Worker {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    slots: Mutex<Slots>,
    changed: Condvar,
    cancel: AtomicBool,
}

#[derive(Default)]
struct Slots {
    request: Option<Request>,
    outcome: Option<Outcome>,
    /// When the running request was started.
    started: Option<Instant>,
    /// What runs only betters an answer that is out already.
    bettering: bool,
    stop: bool,
}

impl Worker {
    /// Starts the threads. `wake` is called from there whenever an outcome is ready.
    pub fn spawn(wake: Box<dyn Fn() + Send>) -> Self {
        Self::late(wake, Duration::ZERO)
    }

    /// [`Worker::spawn`], each answer held back for a while: as a solver would be that is slow.
    pub fn late(wake: Box<dyn Fn() + Send>, by: Duration) -> Self {
        let mut solver = Solver::default();
        Self::with(wake, move |request, effort, cancel| {
            std::thread::sleep(by);
            let answer = catch_unwind(AssertUnwindSafe(|| solver.solve_with(request, effort, cancel)));
            if answer.is_err() {
                // What a panic left behind in there cannot be trusted.
                solver = Solver::default();
            }
            answer
        })
    }

    /// As [`Worker::spawn`] with another way to answer.
    fn with(
        wake: Box<dyn Fn() + Send>,
        solve: impl FnMut(&Request, Effort, &AtomicBool) -> Solved + Send + 'static,
    ) -> Self {
        let shared = Arc::new(Shared::default());
        let solver = std::thread::spawn({
            let shared = shared.clone();
            move || answer_requests(&shared, &*wake, solve)
        });
        let watch = std::thread::spawn({
            let shared = shared.clone();
            move || cancel_the_impatient(&shared)
        });
        Self { shared, threads: vec![solver, watch] }
    }

    /// Asks; replaces a request that has not been started yet.
    pub fn submit(&self, request: Request) {
        let mut slots = self.shared.lock();
        slots.request = Some(request);
        if slots.bettering {
            self.shared.cancel.store(true, Ordering::Relaxed);
        }
        drop(slots);
        self.shared.changed.notify_all();
    }

    /// Whether a thread of it has broken down: nothing will come any more.
    pub fn is_dead(&self) -> bool {
        self.threads.iter().any(JoinHandle::is_finished)
    }

    /// One whose thread breaks down at the first request.
    #[cfg(all(test, feature = "studio"))]
    pub(crate) fn mortal(wake: Box<dyn Fn() + Send>) -> Self {
        Self::with(wake, |_, _, _| panic!("a thread that is meant to break down"))
    }

    /// The newest outcome that has not been taken.
    pub fn take(&self) -> Option<Outcome> {
        self.shared.lock().outcome.take()
    }

    /// Whether anything is still to come: a request waits or runs, an answer is being bettered or has not been taken.
    pub fn is_busy(&self) -> bool {
        let slots = self.shared.lock();
        slots.request.is_some() || slots.started.is_some() || slots.outcome.is_some()
    }

    /// Whether all that runs is meant to better an answer that is out already. `wake` is called when that ends.
    pub fn is_refining(&self) -> bool {
        let slots = self.shared.lock();
        slots.bettering && slots.request.is_none()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.shared.lock().stop = true;
        self.shared.cancel.store(true, Ordering::Relaxed);
        self.shared.changed.notify_all();
        for thread in self.threads.drain(..) {
            // Panics of the solver are caught inside; anything else must not bring the window down while it closes.
            let _ = thread.join();
        }
    }
}

impl Shared {
    /// The slots are plain data that is valid after every statement, so a poisoned lock is still good.
    fn lock(&self) -> MutexGuard<'_, Slots> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, slots: MutexGuard<'a, Slots>) -> MutexGuard<'a, Slots> {
        self.changed.wait(slots).unwrap_or_else(PoisonError::into_inner)
    }
}

fn answer_requests(shared: &Shared, wake: &dyn Fn(), mut solve: impl FnMut(&Request, Effort, &AtomicBool) -> Solved) {
    let mut last: Option<Outcome> = None;
    while let Some(request) = next_request(shared) {
        let solved = solve(&request, Effort::Interactive, &shared.cancel);
        let panicked = solved.is_err();
        let outcome = solved.unwrap_or_else(|panic| after_panic(&request, last.as_ref(), &*panic));
        last = Some(outcome.clone());
        let bettering = {
            let mut slots = shared.lock();
            slots.outcome = Some(outcome.clone());
            let worth_while = !panicked && can_be_bettered(&request, &outcome);
            slots.bettering = worth_while && slots.request.is_none() && !slots.stop;
            slots.started = slots.bettering.then(Instant::now);
            shared.cancel.store(slots.stop, Ordering::Relaxed);
            slots.bettering
        };
        shared.changed.notify_all();
        wake();
        if bettering {
            let better = solve(&request, Effort::Thorough, &shared.cancel).ok().filter(|new| is_better(new, &outcome));
            let mut slots = shared.lock();
            slots.started = None;
            slots.bettering = false;
            if let Some(better) = better {
                let better = Outcome { refined: true, ..better };
                last = Some(better.clone());
                slots.outcome = Some(better);
            }
            drop(slots);
            wake();
        }
    }
}

/// Waits for a request; `None` when the worker is dropped.
fn next_request(shared: &Shared) -> Option<Request> {
    let mut slots = shared.lock();
    loop {
        if slots.stop {
            return None;
        }
        if let Some(request) = slots.request.take() {
            slots.started = Some(Instant::now());
            // Under the lock, so that a cancel meant for the request before cannot hit this one.
            shared.cancel.store(false, Ordering::Relaxed);
            return Some(request);
        }
        slots = shared.wait(slots);
    }
}

/// Only an inverse problem has more than one answer; forces that do not balance yet can go on to.
fn can_be_bettered(request: &Request, outcome: &Outcome) -> bool {
    let searched = matches!(&request.setpoint, Setpoint::Targets(targets) if !targets.is_empty());
    searched || [&outcome.idealized, &outcome.realizable].into_iter().flatten().any(|shape| !shape.converged)
}

/// Equilibrium comes first: a state that falls short of it may only seem to be nearer to its targets.
fn is_better(new: &Outcome, old: &Outcome) -> bool {
    let views = [(&new.idealized, &old.idealized), (&new.realizable, &old.realizable)];
    let pairs = || views.into_iter().filter_map(|(new, old)| Some((new.as_ref()?, old.as_ref()?)));
    if pairs().any(|(new, old)| old.converged && !new.converged) {
        return false;
    }
    if pairs().any(|(new, old)| new.converged && !old.converged) {
        return true;
    }
    // What the hand has led to and winding from rest does not is left, though it may be nearer to the targets.
    let gain = |(new, old): (&Shape, &Shape)| {
        let gain = old.target_error - new.target_error;
        if new.wound && !old.wound { gain.abs() } else { gain }
    };
    pairs().map(gain).any(|gain| gain > WORTH_SHOWING) && pairs().map(gain).all(|gain| gain > -WORTH_SHOWING)
}

/// Tells a request that outlasts [`PATIENCE`] to stop once a newer one waits.
fn cancel_the_impatient(shared: &Shared) {
    let mut slots = shared.lock();
    while !slots.stop {
        let left = match (&slots.request, slots.started) {
            (Some(_), Some(started)) => PATIENCE.saturating_sub(started.elapsed()),
            _ => {
                slots = shared.wait(slots);
                continue;
            }
        };
        if left.is_zero() {
            shared.cancel.store(true, Ordering::Relaxed);
            slots = shared.wait(slots);
        } else {
            slots = shared.changed.wait_timeout(slots, left).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

/// The last good shapes (or the rest shape), with a warning that says what happened.
fn after_panic(request: &Request, last: Option<&Outcome>, panic: &(dyn Any + Send)) -> Outcome {
    let what = panic
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "unknown reason".to_owned());
    let nodes = &request.design.mesh.nodes;
    let shape = |shown: bool, last: Option<&Shape>| {
        shown.then(|| {
            let good = last.filter(|s| s.nodes.len() == nodes.len()).cloned();
            let mut shape = good.unwrap_or_else(|| Shape {
                nodes: nodes.clone(),
                activations_mm: vec![0.0; request.design.networks.len()],
                ..Shape::default()
            });
            shape.converged = false;
            let text = format!("The solver failed ({what}); the last good shape is shown.");
            shape.warning = Some(Warning::Solver(text));
            shape
        })
    };
    Outcome {
        id: request.id,
        idealized: shape(request.show_idealized, last.and_then(|o| o.idealized.as_ref())),
        realizable: shape(request.show_realizable, last.and_then(|o| o.realizable.as_ref())),
        refined: false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Quality, Setpoint};
    use super::*;
    use crate::design::Design;
    use std::sync::atomic::AtomicUsize;
    use std::sync::mpsc;

    fn request(id: u64) -> Request {
        let mesh = crate::mesh::Mesh { nodes: vec![[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]], triangles: vec![[0, 1, 2]] };
        let outline = crate::outline::Outline { outer: mesh.nodes.clone(), holes: Vec::new() };
        let design = Design::new("triangle", outline, mesh);
        Request {
            id,
            design: Arc::new(design),
            setpoint: Setpoint::Targets(Vec::new()),
            quality: Quality::Balanced,
            show_idealized: true,
            show_realizable: true,
        }
    }

    fn rest(request: &Request) -> Outcome {
        let shape = Shape { nodes: request.design.mesh.nodes.clone(), converged: true, ..Shape::default() };
        Outcome { id: request.id, idealized: Some(shape.clone()), realizable: Some(shape), refined: false }
    }

    fn waker() -> (Box<dyn Fn() + Send>, mpsc::Receiver<()>) {
        let (send, receive) = mpsc::channel();
        (
            Box::new(move || {
                let _ = send.send(());
            }),
            receive,
        )
    }

    const LONG: Duration = Duration::from_secs(20);

    #[test]
    fn the_newest_request_wins() {
        let (wake, woken) = waker();
        let (open, gate) = mpsc::channel::<()>();
        let solved = Arc::new(AtomicUsize::new(0));
        let count = solved.clone();
        let worker = Worker::with(wake, move |request, _, _| {
            count.fetch_add(1, Ordering::Relaxed);
            let _ = gate.recv();
            Ok(rest(request))
        });
        worker.submit(request(1));
        while solved.load(Ordering::Relaxed) == 0 {
            std::thread::yield_now();
        }
        for id in 2..=9 {
            worker.submit(request(id));
        }
        open.send(()).unwrap();
        woken.recv_timeout(LONG).unwrap();
        open.send(()).unwrap();
        woken.recv_timeout(LONG).unwrap();
        assert_eq!(worker.take().unwrap().id, 9);
        assert!(worker.take().is_none());
        assert_eq!(solved.load(Ordering::Relaxed), 2);
    }

    #[test]
    fn a_long_request_is_cancelled_only_for_a_newer_one() {
        let (wake, woken) = waker();
        let worker = Worker::with(wake, |request, _, cancel| {
            let started = Instant::now();
            while request.id == 1 && !cancel.load(Ordering::Relaxed) && started.elapsed() < LONG {
                std::thread::sleep(Duration::from_millis(1));
            }
            Ok(rest(request))
        });
        worker.submit(request(1));
        assert!(woken.recv_timeout(2 * PATIENCE).is_err(), "nothing newer waits, so it may run on");
        worker.submit(request(2));
        woken.recv_timeout(LONG / 2).unwrap();
        woken.recv_timeout(LONG / 2).unwrap();
        assert_eq!(worker.take().unwrap().id, 2);
        assert!(!worker.is_busy());
    }

    #[test]
    fn a_panic_becomes_a_warning_and_the_worker_lives_on() {
        let (wake, woken) = waker();
        let worker = Worker::with(
            wake,
            |request, _, _| if request.id == 1 { Err(Box::new("no good")) } else { Ok(rest(request)) },
        );
        worker.submit(request(1));
        woken.recv_timeout(LONG).unwrap();
        let shape = worker.take().unwrap().realizable.unwrap();
        assert_eq!(shape.nodes.len(), 3);
        assert!(shape.warning.unwrap().to_string().contains("no good"));
        worker.submit(request(2));
        woken.recv_timeout(LONG).unwrap();
        assert_eq!(worker.take().unwrap().realizable.unwrap().warning, None);
    }

    #[test]
    fn a_pose_is_answered_at_once_and_bettered_while_nothing_newer_waits() {
        let (wake, woken) = waker();
        let worker = Worker::with(wake, |request, effort, cancel| {
            let started = Instant::now();
            let thorough = effort == Effort::Thorough;
            // The first is bettered only after a newer one has stopped that.
            while thorough && request.id == 1 && !cancel.load(Ordering::Relaxed) && started.elapsed() < LONG {
                std::thread::sleep(Duration::from_millis(1));
            }
            let error = if thorough && request.id == 2 { 0.1 } else { 0.5 };
            let mut outcome = rest(request);
            for shape in [&mut outcome.idealized, &mut outcome.realizable].into_iter().flatten() {
                shape.target_error = error;
            }
            Ok(outcome)
        });
        let at = crate::mesh::BodyPoint { triangle: 0, weights: [1.0, 0.0, 0.0] };
        let target = crate::design::Target { at, to: [9.0, 9.0], weight: 1.0 };
        let pose = |id| Request { setpoint: Setpoint::Targets(vec![target]), ..request(id) };
        worker.submit(pose(1));
        woken.recv_timeout(LONG).unwrap();
        assert_eq!(worker.take().unwrap().id, 1);
        assert!(worker.is_busy() && worker.is_refining());
        worker.submit(pose(2));
        let mut newest = None;
        while worker.is_busy() {
            woken.recv_timeout(LONG).unwrap();
            newest = worker.take().or(newest);
        }
        let outcome = newest.unwrap();
        assert!(outcome.refined && !worker.is_refining());
        assert_eq!((outcome.id, outcome.realizable.unwrap().target_error), (2, 0.1));
    }

    #[test]
    fn equilibrium_comes_before_a_nearer_target() {
        let outcome = |converged: bool, target_error: f64| {
            let mut outcome = rest(&request(1));
            for shape in [&mut outcome.idealized, &mut outcome.realizable].into_iter().flatten() {
                (shape.converged, shape.target_error) = (converged, target_error);
            }
            outcome
        };
        for (new, old, expected) in [
            ((true, 0.2), (false, 0.1), true),
            ((false, 0.1), (true, 0.2), false),
            ((true, 0.1), (true, 0.2), true),
            ((true, 0.2), (true, 0.2), false),
        ] {
            assert_eq!(is_better(&outcome(new.0, new.1), &outcome(old.0, old.1)), expected, "{new:?} {old:?}");
        }
        // A hidden view has no say.
        let hidden = |outcome: Outcome| Outcome { realizable: None, ..outcome };
        assert!(is_better(&hidden(outcome(true, 0.1)), &hidden(outcome(true, 0.2))));
    }

    #[test]
    fn dropping_stops_a_running_request() {
        let (wake, _woken) = waker();
        let worker = Worker::with(wake, |request, _, cancel| {
            let started = Instant::now();
            while !cancel.load(Ordering::Relaxed) && started.elapsed() < LONG {
                std::thread::sleep(Duration::from_millis(1));
            }
            Ok(rest(request))
        });
        worker.submit(request(1));
        while !worker.is_busy() {
            std::thread::yield_now();
        }
        let started = Instant::now();
        drop(worker);
        assert!(started.elapsed() < LONG / 2);
    }
}
