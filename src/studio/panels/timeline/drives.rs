//! Simulated drives and the loads of winches, worked out on a thread for the design as it is.

use crate::design::{Design, animation};
use crate::engine::{Setpoint, solve_once};
use crate::motion::{Ghost, Load, winch_loads};
use crate::studio::action::{Action, Actions};
use crate::studio::jobs::Told;
use crate::studio::language::mark;
use crate::studio::session::{Session, Task};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What the drives of a design would do.
pub struct Drives {
    of: Arc<Design>,
    pub ghost: Result<Ghost, String>,
    /// Times, s, and the load of each winch then.
    pub loads: Vec<(f64, Vec<Load>)>,
}

const OWNER: &str = "timeline.drives";
/// Moments at which loads are worked out at most: what bounds the work.
const MOMENTS: usize = 12;

/// What is known of the design as it is, where it is asked for; what is not known yet is begun. `asked`: the design that was asked for last.
pub fn follow<'s>(session: &'s Session, asked: &mut Option<Arc<Design>>, actions: &mut Actions) -> Option<&'s Drives> {
    let design = session.acting();
    if !session.timing().drives || design.keyframes.len() < 2 {
        return None;
    }
    let known = session.tasks().told::<Drives>(OWNER).filter(|drives| Arc::ptr_eq(&drives.of, design));
    let begun = asked.as_ref().is_some_and(|asked| Arc::ptr_eq(asked, design));
    if known.is_none() && !begun && !session.is_dragging() {
        *asked = Some(design.clone());
        let design = design.clone();
        let work = Arc::new(move |cancel: &AtomicBool| -> Told { Arc::new(simulated(&design, cancel)) });
        actions.push(Action::Start(Task { owner: OWNER, name: mark("The simulated drives"), work }));
    }
    known
}

fn simulated(design: &Arc<Design>, cancel: &AtomicBool) -> Drives {
    let ghost = Ghost::of(design).map_err(|error| error.to_string());
    let mut moments: Vec<f64> = design.keyframes.iter().map(|keyframe| keyframe.time_s).collect();
    let between: Vec<f64> = moments.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    if moments.len() + between.len() <= MOMENTS {
        moments.extend(between);
    }
    moments.sort_by(f64::total_cmp);
    moments.truncate(MOMENTS);
    let mut loads = Vec::new();
    for time_s in moments {
        if cancel.load(Ordering::Relaxed) {
            break;
        }
        let setpoint = Setpoint::Activations(animation::activations_at(design, time_s));
        if let Some(shape) = solve_once(design, setpoint, [false, true], cancel).realizable {
            loads.push((time_s, winch_loads(design, &shape.tendon_tensions)));
        }
    }
    Drives { of: design.clone(), ghost, loads }
}
