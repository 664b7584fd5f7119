//! The solver on a thread of its own, for the window: the interface never waits.
//!
//! One-place mailboxes in both directions: a newer request replaces one that has not been started, a newer outcome
//! replaces one that has not been taken. A running request is left to finish, so that shapes keep coming while somebody
//! drags; only when it has run longer than [`PATIENCE`] while a newer one waits is it told to stop, and then it answers
//! with the best state it has reached.

use super::{Outcome, Request, Shape, Solver};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long a request may run on while a newer one waits. Long enough that a normal solve (some tens of ms) always
/// finishes, short enough that a hard one does not freeze a drag.
pub const PATIENCE: Duration = Duration::from_millis(300);

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
    stop: bool,
}

impl Worker {
    /// Starts the threads. `wake` is called from there whenever an outcome is ready.
    pub fn spawn(wake: Box<dyn Fn() + Send>) -> Self {
        let mut solver = Solver::default();
        Self::with(wake, move |request, cancel| {
            let answer = catch_unwind(AssertUnwindSafe(|| solver.solve(request, cancel)));
            if answer.is_err() {
                // What a panic left behind in there cannot be trusted.
                solver = Solver::default();
            }
            answer
        })
    }

    /// As [`Worker::spawn`] with another way to answer; `Err` is a caught panic.
    fn with(
        wake: Box<dyn Fn() + Send>,
        solve: impl FnMut(&Request, &AtomicBool) -> Result<Outcome, Box<dyn Any + Send>> + Send + 'static,
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
        self.shared.lock().request = Some(request);
        self.shared.changed.notify_all();
    }

    /// The newest outcome that has not been taken.
    pub fn take(&self) -> Option<Outcome> {
        self.shared.lock().outcome.take()
    }

    /// Whether a request waits or runs.
    pub fn is_busy(&self) -> bool {
        let slots = self.shared.lock();
        slots.request.is_some() || slots.started.is_some()
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

fn answer_requests(
    shared: &Shared,
    wake: &dyn Fn(),
    mut solve: impl FnMut(&Request, &AtomicBool) -> Result<Outcome, Box<dyn Any + Send>>,
) {
    let mut last: Option<Outcome> = None;
    loop {
        let request = {
            let mut slots = shared.lock();
            loop {
                if slots.stop {
                    return;
                }
                if let Some(request) = slots.request.take() {
                    slots.started = Some(Instant::now());
                    // Under the lock, so that a cancel meant for the request before cannot hit this one.
                    shared.cancel.store(false, Ordering::Relaxed);
                    break request;
                }
                slots = shared.wait(slots);
            }
        };
        let outcome =
            solve(&request, &shared.cancel).unwrap_or_else(|panic| after_panic(&request, last.as_ref(), &*panic));
        last = Some(outcome.clone());
        {
            let mut slots = shared.lock();
            slots.started = None;
            slots.outcome = Some(outcome);
        }
        shared.changed.notify_all();
        wake();
    }
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
            shape.warning = Some(format!("The solver failed ({what}); the last good shape is shown."));
            shape
        })
    };
    Outcome {
        id: request.id,
        idealized: shape(request.show_idealized, last.and_then(|o| o.idealized.as_ref())),
        realizable: shape(request.show_realizable, last.and_then(|o| o.realizable.as_ref())),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Question;
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
            question: Question::Targets(Vec::new()),
            show_idealized: true,
            show_realizable: true,
        }
    }

    fn rest(request: &Request) -> Outcome {
        let shape = Shape { nodes: request.design.mesh.nodes.clone(), ..Shape::default() };
        Outcome { id: request.id, idealized: Some(shape.clone()), realizable: Some(shape) }
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
        let worker = Worker::with(wake, move |request, _| {
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
        let worker = Worker::with(wake, |request, cancel| {
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
        let worker =
            Worker::with(wake, |request, _| if request.id == 1 { Err(Box::new("no good")) } else { Ok(rest(request)) });
        worker.submit(request(1));
        woken.recv_timeout(LONG).unwrap();
        let shape = worker.take().unwrap().realizable.unwrap();
        assert_eq!(shape.nodes.len(), 3);
        assert!(shape.warning.unwrap().contains("no good"));
        worker.submit(request(2));
        woken.recv_timeout(LONG).unwrap();
        assert_eq!(worker.take().unwrap().realizable.unwrap().warning, None);
    }

    #[test]
    fn dropping_stops_a_running_request() {
        let (wake, _woken) = waker();
        let worker = Worker::with(wake, |request, cancel| {
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
