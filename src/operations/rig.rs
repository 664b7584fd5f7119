//! Winches and tendons for all poses, and the poses on a timeline where there is none.

use super::{Cancelled, Context, Progress, Unbalanced};
use crate::defaults;
use crate::design::edit::{self, EditError};
use crate::design::{CopyOnWrite, Design, Easing, Keyframe, Network};
use crate::mesh::Mesh;
use crate::motion;
use crate::rigging::{self, Found, RigError, Sewn, Wound};
use std::fmt;

pub use crate::rigging::{Method, RigOptions as Options, TendonChoice, Trims};

/// Why there is no rig.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Rig(RigError),
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<RigError> for Error {
    fn from(error: RigError) -> Self {
        match error {
            RigError::Cancelled => Self::Cancelled(Cancelled),
            error => Self::Rig(error),
        }
    }
}

/// A note for the rig's maker.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// What a keyframe winds is the best that was found.
    Unbalanced(Unbalanced),
    /// This keyframe was set for winches that are gone, by hand or for a pose that has no targets any more: it is at rest now.
    AtRest { time_s: f64 },
    /// Keyframes of poses wind what a search that was told to stop did on a coarser mesh.
    Coarse,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Unbalanced(unbalanced) => unbalanced.fmt(f),
            Self::Coarse => f.write_str(
                "the search was stopped on a coarser mesh, so keyframes come only near their poses until they are worked out again",
            ),
            Self::AtRest { time_s } => {
                write!(
                    f,
                    "the keyframe at {time_s} s was set by hand, or for a pose without targets, for the winches that were there; it is at rest now"
                )
            }
        }
    }
}

/// A rig, ready to be put into the design that it was found for.
#[derive(Clone, Debug, PartialEq)]
pub struct Rigged {
    pub networks: Vec<Network>,
    /// The timeline, where the design had none.
    pub keyframes: Vec<Keyframe>,
    pub notes: Vec<Note>,
    /// Whether the search was told to stop, and this is the best that it had by then. Keyframes wind what the search did: nothing
    /// was checked.
    pub interrupted: bool,
    /// What a hand leaves of each pose that has targets, where that was worked out.
    pub sewn: Vec<Option<Sewn>>,
    /// Whether the networks replace those that are there.
    fresh: bool,
    /// What it was found for.
    mesh: CopyOnWrite<Mesh>,
    present: Vec<Network>,
}

/// Looks for networks: solves, discovers, tries out. Where the design has no keyframes its poses are laid on the timeline one after the
/// other, with rest at both ends.
///
/// # Errors
/// There is nothing to rig for, or nothing found; [`Error::Cancelled`].
pub fn prepare(design: &Design, options: &Options, context: &mut Context) -> Result<Rigged, Error> {
    let cancel = context.cancel();
    let mut progress = |step| context.tell(&Progress::Rig(step));
    // Winches that are switched off are as if they were not there; they stay, unless all are forgotten.
    let acting = design.acting();
    let bare = options.fresh.then(|| without_networks(design));
    let from = bare.as_ref().unwrap_or(&acting);
    let found = rigging::rig(from, options, &mut progress, cancel)?;
    let interrupted = found.is_interrupted();
    let Found { design: mut rigged, wound, coarse } = found;
    if !options.keep {
        context.check()?;
    }
    let mut notes = Vec::new();
    let replaced = design.keyframes.is_empty() || options.fresh;
    if rigged.keyframes.is_empty() {
        lay_out(&mut rigged, &wound)?;
    } else if options.fresh {
        notes = key_again(&mut rigged, &design.keyframes, &wound);
    }
    if replaced {
        let keyed =
            |wound: &&Wound| rigged.keyframes.iter().any(|keyframe| keyframe.pose.as_ref() == Some(&wound.pose));
        let keyed: Vec<&Wound> = wound.iter().filter(keyed).collect();
        let shapes = keyed.iter().filter_map(|wound| Some((&wound.pose, wound.checked.as_ref()?)));
        notes.extend(shapes.filter_map(|(pose, shape)| Unbalanced::realizable(pose, shape)).map(Note::Unbalanced));
        if coarse && !keyed.is_empty() {
            notes.push(Note::Coarse);
        }
    }
    let networks = rigged.networks.split_off(from.networks.len());
    let mut keyframes = if replaced { rigged.keyframes } else { Vec::new() };
    if !options.fresh {
        keyframes.iter_mut().for_each(|keyframe| keyframe.activations_mm = design.of_all(&keyframe.activations_mm));
    }
    let (mesh, present) = (rigged.mesh, design.networks.clone());
    let sewn = wound.iter().map(|wound| wound.sewn).collect();
    Ok(Rigged { networks, keyframes, notes, interrupted, sewn, fresh: options.fresh, mesh, present })
}

/// The design before it had winches: its keyframes at rest.
fn without_networks(design: &Design) -> Design {
    let mut bare = design.clone();
    bare.networks.clear();
    bare.keyframes.iter_mut().for_each(|keyframe| keyframe.activations_mm.clear());
    bare
}

/// Every keyframe of a pose anew for the present winches; the others are at rest.
fn key_again(design: &mut Design, before: &[Keyframe], wound: &[Wound]) -> Vec<Note> {
    for Wound { pose, activations_mm, .. } in wound {
        for keyframe in design.keyframes.iter_mut().filter(|keyframe| keyframe.pose.as_ref() == Some(pose)) {
            keyframe.activations_mm.clone_from(activations_mm);
        }
    }
    let is_wound = |keyframe: &Keyframe| wound.iter().any(|wound| keyframe.pose.as_ref() == Some(&wound.pose));
    let at_rest = before.iter().filter(|k| !is_wound(k) && k.activations_mm.iter().any(|a| *a != 0.0));
    at_rest.map(|k| Note::AtRest { time_s: k.time_s }).collect()
}

/// Lays the poses on the timeline, [`defaults::KEYFRAME_SPACING_S`] apart or as far as the motors need, with rest at both ends.
fn lay_out(design: &mut Design, wound: &[Wound]) -> Result<(), EditError> {
    let at_rest = (None, vec![0.0; design.networks.len()]);
    let poses = wound.iter().map(|wound| (Some(wound.pose.clone()), wound.activations_mm.clone()));
    let stops = std::iter::once(at_rest.clone()).chain(poses).chain([at_rest]);
    for (index, (pose, activations_mm)) in stops.enumerate() {
        let time_s = index as f64 * defaults::KEYFRAME_SPACING_S;
        edit::set_keyframe(design, Keyframe { time_s, activations_mm, pose, easing: Easing::default() })?;
    }
    space_out(design);
    Ok(())
}

/// Moves keyframes apart until motors can follow, to tenths of a second.
fn space_out(design: &mut Design) {
    /// Rounding that does not cost another tenth, s.
    const ROUNDING_S: f64 = 1e-9;
    for k in 1..design.keyframes.len() {
        let needs =
            motion::smooth_s(design, &design.keyframes[k - 1].activations_mm, &design.keyframes[k].activations_mm);
        let spacing = ((needs - ROUNDING_S) * 10.0).ceil().max(10.0 * defaults::KEYFRAME_SPACING_S);
        let tenths = (10.0 * design.keyframes[k - 1].time_s).round() + spacing;
        design.keyframes[k].time_s = tenths / 10.0;
    }
}

impl Rigged {
    /// Whether it was found for another mesh or beside other networks than the design has by now.
    pub fn is_stale(&self, design: &Design) -> bool {
        design.mesh != self.mesh || design.networks != self.present
    }

    /// Puts the networks into the design, and the timeline where it has none. It must not be [stale](Self::is_stale).
    ///
    /// # Errors
    /// A network does not lie on the mesh.
    pub fn apply(self, design: &mut Design) -> Result<(), EditError> {
        if self.fresh {
            design.networks.clear();
            design.keyframes.clear();
        }
        for network in self.networks {
            edit::accept_network(design, network)?;
        }
        if design.keyframes.is_empty() {
            let poses = &design.poses;
            // A pose may have gone by now.
            let known = |keyframe: &Keyframe| {
                keyframe.pose.as_ref().is_none_or(|name| poses.iter().any(|pose| pose.name == *name))
            };
            design.keyframes = self.keyframes.into_iter().filter(known).collect();
        }
        Ok(())
    }
}

/// [`prepare`] and [`Rigged::apply`] in one.
///
/// # Errors
/// As both; the design is as it was then.
pub fn run(design: &mut Design, options: &Options, context: &mut Context) -> Result<Rigged, Error> {
    let rigged = prepare(design, options, context)?;
    super::changed(design, |design| rigged.clone().apply(design))?;
    Ok(rigged)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_design_without_poses_and_a_cancelled_one_stay_as_they_are() {
        let mut design = testing::sample();
        let before = design.clone();
        let stop = AtomicBool::new(true);
        let stopped = run(&mut design, &Options::default(), &mut Context::new(&stop));
        assert_eq!(stopped, Err(Error::Cancelled(Cancelled)));
        assert_eq!(design, before);
        design.poses.iter_mut().for_each(|pose| pose.targets.clear());
        let go = AtomicBool::new(false);
        assert_eq!(run(&mut design, &Options::default(), &mut Context::new(&go)), Err(Error::Rig(RigError::NoTargets)));
    }

    #[test]
    fn a_rig_is_put_only_into_the_design_that_it_was_found_for() {
        let mut design = testing::sample();
        let added = Network { name: "more".into(), ..design.networks[0].clone() };
        let rigged = Rigged {
            networks: vec![added],
            keyframes: Vec::new(),
            notes: Vec::new(),
            interrupted: false,
            sewn: Vec::new(),
            fresh: false,
            mesh: design.mesh.clone(),
            present: design.networks.clone(),
        };
        assert!(!rigged.is_stale(&design));
        rigged.clone().apply(&mut design).unwrap();
        design.validate().unwrap();
        assert_eq!(design.networks.len(), 3);
        assert!(design.keyframes.iter().all(|keyframe| keyframe.activations_mm.len() == 3));
        assert!(rigged.is_stale(&design));
    }

    #[test]
    fn keyframes_wind_what_their_poses_were_found_with() {
        let mut design = testing::sample();
        let pose = design.poses[0].name.clone();
        let found = [Wound { pose: pose.clone(), activations_mm: vec![3.0, 5.0], checked: None, sewn: None }];
        let windings = |design: &Design| -> Vec<(Option<String>, Vec<f64>)> {
            design.keyframes.iter().map(|k| (k.pose.clone(), k.activations_mm.clone())).collect()
        };
        design.keyframes.clear();
        lay_out(&mut design, &found).unwrap();
        let rest = (None, vec![0.0; 2]);
        assert_eq!(windings(&design), [rest.clone(), (Some(pose.clone()), vec![3.0, 5.0]), rest.clone()]);
        assert!(design.keyframes.windows(2).all(|k| k[1].time_s >= k[0].time_s + defaults::KEYFRAME_SPACING_S));
        // Anew, for other winches: the one that was set by hand is told, and rests.
        let mut before = design.clone();
        before.keyframes[2].activations_mm = vec![1.0, 0.0];
        design.keyframes[1].activations_mm = vec![0.0; 2];
        let notes = key_again(&mut design, &before.keyframes, &found);
        let told = [Note::AtRest { time_s: before.keyframes[2].time_s }];
        assert_eq!(notes, told);
        // Nor does a pose that has no targets any more say what it is to be.
        before.keyframes[2].pose = Some("gone".into());
        assert_eq!(key_again(&mut design.clone(), &before.keyframes, &found), told);
        assert_eq!(windings(&design), [rest.clone(), (Some(pose), vec![3.0, 5.0]), rest]);
    }

    #[test]
    fn options_are_read_from_a_file_and_what_is_missing_has_its_default() {
        let options: Options = ron::from_str("(max_winches: 1, tendons: PerWinch([2]))").unwrap();
        assert_eq!(options.tendons, TendonChoice::PerWinch(vec![2]));
        assert_eq!(Options { tendons: TendonChoice::default(), max_winches: 3, ..options }, Options::default());
    }
}
