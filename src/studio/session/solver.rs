//! What is asked of the solver, and what it answers. The newest request wins; the last good shapes stay.

use crate::design::Design;
use crate::engine::worker::Worker;
use crate::engine::{NEAR_EQUILIBRIUM, Quality, Request, Setpoint, Shape};
use crate::studio::jobs::Wake;
use std::sync::Arc;
use std::time::Duration;

/// The newest good shapes.
#[derive(Default)]
pub struct Shapes {
    pub idealized: Option<Arc<Shape>>,
    pub realizable: Option<Arc<Shape>>,
}

/// The worker, what it was asked and what is known.
pub struct Solver {
    pub worker: Worker,
    wake: Wake,
    pub shapes: Shapes,
    /// Of the user's, not of the document.
    pub quality: Quality,
    /// About the newest shapes.
    pub warning: Option<String>,
    /// The last request.
    pub asked: Option<Request>,
    /// The design whose mesh the shapes belong to.
    meshed: Arc<Design>,
    /// Outcomes before this one belong to another document.
    first_id: u64,
    answered_id: Option<u64>,
}

impl Solver {
    pub fn new(design: &Arc<Design>, wake: Wake) -> Self {
        Self {
            worker: Worker::spawn(Box::new({
                let wake = wake.clone();
                move || wake()
            })),
            wake,
            shapes: Shapes::default(),
            quality: Quality::Balanced,
            warning: None,
            asked: None,
            meshed: design.clone(),
            first_id: 0,
            answered_id: None,
        }
    }

    /// Lets every answer wait: what the window does with a slow solver is measured so.
    pub fn delay(&mut self, by: Duration) {
        let wake = self.wake.clone();
        self.worker = Worker::late(Box::new(move || wake()), by);
    }

    /// Another document or mesh: what is known or still to come is not wanted.
    pub fn forget(&mut self) {
        self.shapes = Shapes::default();
        self.warning = None;
        self.first_id = self.asked.as_ref().map_or(0, |asked| asked.id + 1);
        self.answered_id = None;
    }

    /// Whether the mesh is another one than that of the shapes, by whatever way. From now on it is that of the shapes.
    pub fn is_remeshed(&mut self, design: &Arc<Design>) -> bool {
        if Arc::ptr_eq(design, &self.meshed) {
            return false;
        }
        let before = std::mem::replace(&mut self.meshed, design.clone());
        before.mesh != design.mesh
    }

    /// Whether the shapes answer the newest request.
    pub fn is_settled(&self) -> bool {
        let resting = !self.worker.is_busy();
        resting && self.asked.as_ref().is_some_and(|asked| self.answered_id == Some(asked.id))
    }

    pub fn next_quality(&mut self) {
        let next = Quality::ALL.into_iter().skip_while(|quality| *quality != self.quality).nth(1);
        self.quality = next.unwrap_or(Quality::ALL[0]);
    }

    /// Starts the solver's thread again where it has broken down, and asks again what was asked. Whether that was so.
    pub fn revive(&mut self) -> bool {
        if !self.worker.is_dead() {
            return false;
        }
        let wake = self.wake.clone();
        self.worker = Worker::spawn(Box::new(move || wake()));
        if let Some(asked) = &self.asked {
            self.worker.submit(asked.clone());
        }
        true
    }

    /// Takes what the worker has found for a body of so many nodes.
    pub fn take(&mut self, nodes: usize) {
        let Some(outcome) = self.worker.take().filter(|outcome| outcome.id >= self.first_id) else { return };
        let fits = |shape: &Shape| {
            shape.nodes.len() == nodes && shape.nodes.iter().flatten().all(|coordinate| coordinate.is_finite())
        };
        let warning = |shape: &Option<Shape>| {
            let shape = shape.as_ref()?;
            shape.warning.clone().filter(|warning| !(warning.passes() && is_on_its_way(shape)))
        };
        let said = warning(&outcome.realizable).or_else(|| warning(&outcome.idealized));
        self.warning = said.map(|warning| warning.to_string());
        self.answered_id = Some(outcome.id);
        let refined = outcome.refined;
        for (slot, new) in [
            (&mut self.shapes.idealized, outcome.idealized.filter(fits)),
            (&mut self.shapes.realizable, outcome.realizable.filter(fits)),
        ] {
            let Some(mut shape) = new else { continue };
            if let Some(frame) = slot.as_ref().filter(|_| refined) {
                // What is told is what a frame takes, not what it took to refine the last one.
                shape.milliseconds = frame.milliseconds;
            }
            *slot = Some(Arc::new(shape));
        }
    }

    /// Submits what should be seen, if that is not what was asked last.
    pub fn ask(&mut self, design: Arc<Design>, setpoint: Setpoint, [show_idealized, show_realizable]: [bool; 2]) {
        let id = self.asked.as_ref().map_or(0, |asked| asked.id + 1);
        let request = Request { id, design, setpoint, quality: self.quality, show_idealized, show_realizable };
        if self.asked.as_ref().is_some_and(|asked| asked.id >= self.first_id && same(asked, &request)) {
            return;
        }
        self.worker.submit(request.clone());
        self.asked = Some(request);
    }
}

/// Whether a shape only waits for a hand to rest: near equilibrium, which the figures say, and about to be refined.
fn is_on_its_way(shape: &Shape) -> bool {
    !shape.converged && shape.residual > 0.0 && shape.distance_from_equilibrium() < NEAR_EQUILIBRIUM
}

/// Whether two requests have the same answer.
fn same(a: &Request, b: &Request) -> bool {
    Arc::ptr_eq(&a.design, &b.design)
        && same_setpoint(&a.setpoint, &b.setpoint)
        && (a.quality, a.show_idealized, a.show_realizable) == (b.quality, b.show_idealized, b.show_realizable)
}

fn same_setpoint(a: &Setpoint, b: &Setpoint) -> bool {
    match (a, b) {
        (Setpoint::Targets(a), Setpoint::Targets(b)) => a == b,
        (Setpoint::Activations(a), Setpoint::Activations(b)) => a == b,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_that_breaks_down_is_started_again_and_answers() {
        let design = Arc::new(crate::studio::blank::design());
        let mut solver = Solver::new(&design, Arc::new(|| ()));
        assert!(!solver.revive());
        solver.worker = Worker::mortal(Box::new(|| ()));
        solver.ask(design.clone(), Setpoint::Targets(Vec::new()), [true, true]);
        while !solver.worker.is_dead() {
            std::thread::yield_now();
        }
        assert!(solver.revive() && !solver.worker.is_dead());
        while solver.shapes.realizable.is_none() {
            solver.take(design.mesh.nodes.len());
            std::thread::yield_now();
        }
    }

    #[test]
    fn only_a_shape_far_from_equilibrium_is_worth_a_warning() {
        let shape =
            |residual: f64, converged: bool| Shape { residual, converged, force_scale: 1.0, ..Shape::default() };
        assert!(is_on_its_way(&shape(1e-5, false)));
        // Far off; a body that was not solved at all; a settled one whose warning is about something else.
        for said in [shape(0.5, false), shape(0.0, false), shape(1e-12, true)] {
            assert!(!is_on_its_way(&said));
        }
    }
}
