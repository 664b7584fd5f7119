//! Figures of a design: sizes, and how close each pose comes to its targets.

use super::error::CommandError;
use super::key::{self, solve};
use super::output::say;
use crate::design::{Design, Pose};
use crate::engine::target_error;
use crate::engine::{Question, Warning};
use serde::Serialize;
use std::io::Write;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// What `check` reports. Errors are rms distances of the targets in body lengths.
#[derive(Clone, Debug, Serialize)]
pub struct Figures {
    pub name: String,
    pub fibers: usize,
    pub nodes: usize,
    pub triangles: usize,
    pub winches: usize,
    pub tendons: usize,
    pub body_length_mm: f64,
    pub poses: Vec<PoseFigures>,
}

#[derive(Clone, Debug, Serialize)]
pub struct PoseFigures {
    pub name: String,
    pub targets: usize,
    pub error_rest: f64,
    pub error_idealized: f64,
    pub error_realizable: f64,
    /// The worst error of the realizable plushie where one winch is a millimetre off; absent without winches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_realizable_1mm_off: Option<f64>,
    /// Whether that is so much worse that the pose counts as narrow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub narrow: Option<bool>,
    pub milliseconds_idealized: f64,
    pub milliseconds_realizable: f64,
    /// Largest unbalanced force as a part of the forces at work.
    pub imbalance_idealized: f64,
    pub imbalance_realizable: f64,
    /// Which plushies did not come to equilibrium, and how far from it they are; the command ends with these.
    #[serde(skip)]
    pub unbalanced: Vec<String>,
    /// What the solver had to say; shown in the table only.
    #[serde(skip)]
    pub warnings: Vec<String>,
}

impl Figures {
    /// What is to be said of poses that did not come to equilibrium.
    pub fn unbalanced(&self) -> Vec<String> {
        self.poses.iter().flat_map(|pose| pose.unbalanced.iter().cloned()).collect()
    }
}

/// Solves every pose from rest, as many at a time as the machine has cores. Each pose has a solver of its own, so that its figures do
/// not depend on how many there are.
pub fn figures(design: &Design, cancel: &AtomicBool) -> Result<Figures, CommandError> {
    let solved = every_pose(&design.poses, |pose| pose_figures(design, pose, cancel));
    let poses: Vec<PoseFigures> = solved.into_iter().collect::<Result<_, _>>()?;
    Ok(Figures {
        name: design.name.clone(),
        fibers: design.fiber_routings().len(),
        nodes: design.mesh.nodes.len(),
        triangles: design.mesh.triangles.len(),
        winches: design.networks.len(),
        tendons: design.networks.iter().map(|n| n.tendons.len()).sum(),
        body_length_mm: design.body_length_mm(),
        poses,
    })
}

/// `solve` of every pose, in the order of the poses.
fn every_pose<T: Send>(poses: &[Pose], solve: impl Fn(&Pose) -> T + Sync) -> Vec<T> {
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get()).min(poses.len());
    if threads <= 1 {
        return poses.iter().map(solve).collect();
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(pose) = poses.get(index) else { return done };
            done.push((index, solve(pose)));
        }
    };
    let mut done: Vec<(usize, T)> = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let mut done = work();
        for other in others {
            match other.join() {
                Ok(more) => done.extend(more),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        done
    });
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, value)| value).collect()
}

fn pose_figures(design: &Design, pose: &Pose, cancel: &AtomicBool) -> Result<PoseFigures, CommandError> {
    let shapes = solve(design, Question::Targets(pose.targets.clone()), [true, true], cancel)?;
    let unbalanced = key::unbalanced(&pose.name, &shapes);
    let [idealized, realizable] = shapes;
    let note = |view: &str, warning: &Option<Warning>| warning.as_ref().map(|w| format!("{}, {view}: {w}", pose.name));
    Ok(PoseFigures {
        name: pose.name.clone(),
        targets: pose.targets.len(),
        error_rest: target_error(design, &pose.targets, &design.mesh.nodes),
        error_idealized: idealized.target_error,
        error_realizable: realizable.target_error,
        error_realizable_1mm_off: realizable.play.map(|play| play.error),
        narrow: realizable.play.map(|_| matches!(realizable.warning, Some(Warning::Narrow { .. }))),
        milliseconds_idealized: idealized.milliseconds,
        milliseconds_realizable: realizable.milliseconds,
        imbalance_idealized: idealized.distance_from_equilibrium(),
        imbalance_realizable: realizable.distance_from_equilibrium(),
        unbalanced,
        warnings: [note("idealized", &idealized.warning), note("realizable", &realizable.warning)]
            .into_iter()
            .flatten()
            .collect(),
    })
}

/// Prints the figures as a table.
pub fn print(figures: &Figures, out: &mut dyn Write) -> Result<(), CommandError> {
    say(
        out,
        &format!(
            "{}: {} fibers, {} nodes, {} triangles, {} winches, {} tendons, {:.1} mm long",
            figures.name,
            figures.fibers,
            figures.nodes,
            figures.triangles,
            figures.winches,
            figures.tendons,
            figures.body_length_mm
        ),
    )?;
    if figures.poses.is_empty() {
        return Ok(());
    }
    let width = figures.poses.iter().map(|p| p.name.chars().count()).max().unwrap_or(0).max(4);
    say(out, "")?;
    let above = "         rms target error (% of body length)         solved in (ms)  unbalanced forces (part)";
    say(out, &format!("{:width$}  {above}", ""))?;
    let columns = "targets     rest  idealized  realizable  idealized  realizable  idealized  realizable";
    say(out, &format!("{:width$}  {columns}", "pose"))?;
    for p in &figures.poses {
        say(
            out,
            &format!(
                "{:width$}  {:7}  {:7.2}  {:9.2}  {:10.2}  {:9.1}  {:10.1}  {:9.0e}  {:10.0e}",
                p.name,
                p.targets,
                100.0 * p.error_rest,
                100.0 * p.error_idealized,
                100.0 * p.error_realizable,
                p.milliseconds_idealized,
                p.milliseconds_realizable,
                p.imbalance_idealized,
                p.imbalance_realizable
            ),
        )?;
    }
    for warning in figures.poses.iter().flat_map(|p| &p.warnings) {
        say(out, &format!("note: {warning}"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_keep_their_order_and_are_solved_once() {
        let pose = |k: usize| Pose { name: format!("{k}"), ..Pose::default() };
        for count in [0, 1, 2, 37] {
            let poses: Vec<Pose> = (0..count).map(pose).collect();
            let calls = AtomicUsize::new(0);
            let solved = every_pose(&poses, |pose| {
                calls.fetch_add(1, Ordering::Relaxed);
                pose.name.clone()
            });
            assert_eq!(calls.into_inner(), count);
            assert!(solved.iter().zip(&poses).all(|(name, pose)| *name == pose.name) && solved.len() == count);
        }
    }
}
