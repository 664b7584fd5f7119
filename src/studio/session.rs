//! The state of the window, and everything that changes it.

use super::action::{Action, FileAction};
use super::canvas::{Camera, Plushie};
use super::change::{Change, Made};
use super::files::Files;
use super::jobs::{Finished, Jobs, Outcome, Running, Wake};
use super::keeping::Kept;
use super::meshing::Meshing;
use super::messages::Messages;
use super::rigging::Rigging;
use super::safety::Safety;
use super::sketching::{Sketch, Sketching};
use super::texturing::Texturing;
use crate::design::file::MAX_BYTES;
use crate::design::history::History;
use crate::design::{Design, Target, edit};
use crate::discovery::Parameters;
use crate::engine::worker::Worker;
use crate::engine::{Quality, Request, Shape};
use crate::files::Stamp;
use crate::outline::Point;
use crate::picture::palette::Theme;
use crate::picture::{Shown, Stage};
use crate::rigging::Proposal;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What is picked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selection {
    Nothing,
    /// Of the current pose.
    Target(usize),
    Pin(usize),
    Keyframe(usize),
    Network(usize),
}

/// What stands over the window for the keyboard's sake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// Every command by name.
    Palette,
    /// What every key does.
    Shortcuts,
}

/// What gets another name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Renamed {
    Pose(usize),
    Network(usize),
    Plushie,
}

/// Whether the views show a pose or the animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    Pose,
    Animation,
}

pub struct Playback {
    pub time_s: f64,
    pub playing: bool,
    pub looping: bool,
}

pub struct Look {
    pub theme: Theme,
    /// Which layers of the pictures.
    pub shown: Shown,
    pub views: Views,
    /// `None`: fits the body.
    pub camera: Option<Camera>,
    /// Times which the scale shall change about the middle, as soon as a view knows what it shows.
    pub zoom: Option<f32>,
}

/// Which views are shown: one at least. What is hidden is not solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    Both,
    Only(Plushie),
}

impl Views {
    pub fn shows(self, plushie: Plushie) -> bool {
        match self {
            Self::Both => true,
            Self::Only(shown) => shown == plushie,
        }
    }

    pub fn toggled(self, plushie: Plushie) -> Self {
        self.with(plushie, !self.shows(plushie))
    }

    /// With one of them shown or hidden. Where that leaves none, the other one comes back.
    pub fn with(self, plushie: Plushie, shown: bool) -> Self {
        let other = plushie.other();
        match (shown, self.shows(other)) {
            (true, true) => Self::Both,
            (true, false) => Self::Only(plushie),
            (false, _) => Self::Only(other),
        }
    }
}

/// Network discovery: what was asked, and what came of it.
pub struct Discovery {
    pub parameters: Parameters,
    pub running: Option<Running>,
    pub proposals: Vec<Arc<Proposal>>,
    /// Which proposal the views show.
    pub shown: Option<usize>,
    pub stage: Stage,
}

/// The newest good shapes.
#[derive(Default)]
pub struct Shapes {
    pub idealized: Option<Arc<Shape>>,
    pub realizable: Option<Arc<Shape>>,
}

/// Makes proposals for a design and the targets of a pose.
pub type Propose = Arc<dyn Fn(&Design, &[Target], &Parameters, &AtomicBool) -> Vec<Proposal> + Send + Sync>;
/// Writes the blueprint of a design into a folder.
pub type Export = Arc<dyn Fn(&Design, &Path) -> Result<(), String> + Send + Sync>;

/// The long work that is done elsewhere; tests put their own in.
#[derive(Clone)]
pub struct Services {
    pub propose: Propose,
    pub export: Export,
}

pub struct Session {
    pub(super) history: History,
    pub(super) path: Option<PathBuf>,
    /// The file that the document was read from: what it names is found from there.
    pub(super) origin: Option<PathBuf>,
    /// The texture of a document that was imported, until it is saved.
    pub(super) kept: Option<Kept>,
    pub(super) texturing: Texturing,
    pub(super) pose: Option<usize>,
    pub(super) selection: Selection,
    /// By their names, of the views and of the sheet.
    pub(super) tools: [&'static str; 2],
    pub(super) overlay: Option<Overlay>,
    /// A name that is being typed.
    pub(super) renaming: Option<(Renamed, String)>,
    pub(super) mode: Mode,
    pub(super) playback: Playback,
    pub(super) look: Look,
    /// Of the user's, not of the document.
    pub(super) quality: Quality,
    pub(super) discovery: Discovery,
    pub(super) meshing: Meshing,
    pub(super) sketching: Sketching,
    /// The design whose mesh the shapes and proposals belong to.
    pub(super) meshed: Arc<Design>,
    pub(super) shapes: Shapes,
    pub(super) messages: Messages,
    pub(super) files: Files,
    pub(super) safety: Safety,
    pub(super) jobs: Jobs,
    pub(super) services: Services,
    pub(super) worker: Worker,
    /// Of the solver, last.
    pub(super) asked: Option<Request>,
    /// Outcomes before this one belong to another document.
    pub(super) first_id: u64,
    pub(super) answered_id: Option<u64>,
    /// A keyframe that is worked out.
    pub(super) keying: Option<Running>,
    pub(super) rigging: Rigging,
    pub(super) warning: Option<String>,
}

impl Session {
    pub fn new(design: Design, path: Option<PathBuf>, wake: Wake, services: Services) -> Self {
        let on_outcome = wake.clone();
        let seen = path.as_deref().and_then(|path| Stamp::at(path, MAX_BYTES).ok());
        Self {
            pose: first_pose(&design),
            history: History::new(design.clone()),
            origin: path.clone(),
            path,
            kept: None,
            texturing: Texturing::default(),
            selection: Selection::Nothing,
            tools: [""; 2],
            overlay: None,
            renaming: None,
            mode: Mode::Pose,
            playback: Playback { time_s: 0.0, playing: false, looping: true },
            look: Look { theme: Theme::Light, shown: Shown::default(), views: Views::Both, camera: None, zoom: None },
            quality: Quality::Balanced,
            discovery: Discovery {
                parameters: Parameters::default(),
                running: None,
                proposals: Vec::new(),
                shown: None,
                stage: Stage::Result,
            },
            meshing: Meshing::default(),
            sketching: Sketching::default(),
            meshed: Arc::new(design.clone()),
            shapes: Shapes::default(),
            messages: Messages::default(),
            files: Files::default(),
            safety: Safety::seen(seen),
            jobs: Jobs::new(wake),
            services,
            worker: Worker::spawn(Box::new(move || on_outcome())),
            asked: None,
            first_id: 0,
            answered_id: None,
            keying: None,
            rigging: Rigging::default(),
            warning: None,
        }
    }

    /// Replaces the document; undo starts anew.
    pub(super) fn open(&mut self, design: Design, path: Option<PathBuf>) {
        self.cancel_propose();
        self.cancel_remesh();
        self.meshing.wanted = None;
        self.sketching = Sketching::default();
        self.pose = first_pose(&design);
        self.history = History::new(design);
        self.origin = path.clone();
        self.path = path;
        self.kept = None;
        self.texturing = Texturing::default();
        self.files.granted = None;
        self.unclaimed();
        self.selection = Selection::Nothing;
        self.mode = Mode::Pose;
        self.playback.time_s = 0.0;
        self.playback.playing = false;
        self.look.camera = None;
        self.discovery.proposals.clear();
        self.discovery.shown = None;
        self.shapes = Shapes::default();
        self.cancel_keying();
        self.cancel_rig();
        self.warning = None;
        self.first_id = self.asked.as_ref().map_or(0, |asked| asked.id + 1);
        self.answered_id = None;
    }

    pub fn apply(&mut self, action: Action) {
        match action {
            Action::Change(change) => self.change(change),
            Action::Live(change) => self.live(change),
            Action::Run(command, at) => match command.refused(self, at) {
                None => (command.run)(self, at),
                Some(why) => self.messages.info(why),
            },
            Action::Overlay(overlay) => self.overlay = overlay,
            Action::Typed(renaming) => self.renaming = renaming,
            Action::DragTarget(to) => self.drag_target(to),
            Action::SelectPose(pose) => self.select_pose(pose),
            Action::Select(selection) => self.selection = selection,
            Action::SetQuality(quality) => self.quality = quality,
            Action::SetCamera(camera) => {
                self.look.camera = Some(camera);
                self.look.zoom = None;
            }
            Action::Scrub(time_s) => self.scrub(time_s),
            Action::SetParameters(parameters) => self.discovery.parameters = parameters,
            Action::SetResolution(resolution) => self.meshing.wanted = Some(resolution),
            Action::SetRig(choice) => self.rigging.choice = choice,
            Action::ShowProposal(index) => self.discovery.shown = index,
            Action::ShowStage(stage) => self.discovery.stage = stage,
            Action::Sketch(sketch) => self.sketch(sketch),
            Action::File(action) => self.file(action),
            Action::DismissMessage(id) => self.messages.dismiss(id),
        }
    }

    /// Once a frame: takes what the threads have to report, moves the playhead, asks for what should be seen next.
    /// `hands_off`: nobody holds a button or types, so gestures are over.
    pub fn tick(&mut self, now_s: f64, passed_s: f64, hands_off: bool) {
        self.messages.tick(now_s);
        while let Some(finished) = self.jobs.next() {
            self.take_finished(finished);
        }
        self.take_outcome();
        if hands_off {
            self.history.commit();
        }
        if self.playback.playing {
            self.advance(passed_s);
        }
        self.clamp();
        self.follow_texture();
        // Nobody sees the plushies while the outline is drawn.
        if !self.sketching.open {
            self.ask();
        }
    }

    pub(super) fn change(&mut self, change: Change) {
        let label = change.label();
        match self.history.edit(label, |design| change.apply(design)) {
            Ok(made) => self.pick_out(made),
            Err(error) => self.messages.error(format!("{label}: {error}")),
        }
    }

    fn live(&mut self, change: Change) {
        let label = change.label();
        if self.history.undo_label() != Some(label) || !self.history.in_gesture() {
            self.history.begin(label);
        }
        match self.history.preview(|design| change.apply(design)) {
            Ok(made) => self.pick_out(made),
            // On the way through a refused value: the last good one stays, and the control shows it.
            Err(edit::EditError::TimeTaken(_)) => {}
            Err(error) => self.messages.error(format!("{label}: {error}")),
        }
    }

    /// Goes on with the gesture that made the target, or begins one that moves it.
    fn drag_target(&mut self, to: Point) {
        let (Selection::Target(index), Some(pose)) = (self.selection, self.pose) else { return };
        let change = Change::MoveTarget { pose, index, to };
        if !self.history.in_gesture() {
            return self.live(change);
        }
        if let Err(error) = self.history.preview(|design| change.apply(design)) {
            self.messages.error(error.to_string());
        }
    }

    pub(super) fn pick_out(&mut self, made: Made) {
        match made {
            Made::Nothing => {}
            Made::Pose(pose) => self.select_pose(Some(pose)),
            Made::Target { pose, index } => {
                self.pose = Some(pose);
                self.selection = Selection::Target(index);
            }
            Made::Keyframe(index) => self.selection = Selection::Keyframe(index),
            Made::Network(index) => self.selection = Selection::Network(index),
        }
        self.clamp();
    }

    pub(super) fn undo(&mut self) {
        self.travel("Undone", History::undo);
    }

    pub(super) fn redo(&mut self) {
        self.travel("Redone", History::redo);
    }

    /// Shows all of the body, or of the drawing.
    pub(super) fn fit(&mut self) {
        if self.sketching.open {
            self.sketching.camera = None;
        } else {
            self.look.camera = None;
        }
    }

    pub(super) fn zoom(&mut self, factor: f32) {
        self.look.zoom = Some(self.look.zoom.unwrap_or(1.0) * factor);
    }

    pub(super) fn next_quality(&mut self) {
        self.quality = match self.quality {
            Quality::Draft => Quality::Balanced,
            Quality::Balanced => Quality::Accurate,
            Quality::Accurate => Quality::Draft,
        };
    }

    /// Starts to edit the name of the current pose.
    pub(super) fn rename_pose(&mut self) {
        if let Some((index, pose)) = self.pose.and_then(|index| Some((index, self.design().poses.get(index)?))) {
            self.renaming = Some((Renamed::Pose(index), pose.name.clone()));
        }
    }

    fn travel(&mut self, done: &str, step: impl FnOnce(&mut History) -> Option<String>) {
        if let Some(label) = step(&mut self.history) {
            self.messages.info(format!("{done}: {label}"));
        }
        self.discovery.shown = None;
        self.clamp();
    }

    /// After any change of the document: nothing may point beyond it.
    pub(super) fn clamp(&mut self) {
        self.follow_mesh();
        self.clamp_sketch();
        let design = self.history.current();
        if self.pose.is_some_and(|pose| pose >= design.poses.len()) {
            self.pose = design.poses.len().checked_sub(1);
        }
        let targets = self.pose.and_then(|p| design.poses.get(p)).map_or(0, |p| p.targets.len());
        let gone = match self.selection {
            Selection::Nothing => false,
            Selection::Target(i) => i >= targets,
            Selection::Pin(i) => i >= design.pins.len(),
            Selection::Keyframe(i) => i >= design.keyframes.len(),
            Selection::Network(i) => i >= design.networks.len(),
        };
        if gone {
            self.selection = Selection::Nothing;
        }
    }

    fn select_pose(&mut self, pose: Option<usize>) {
        self.pose = pose;
        self.mode = Mode::Pose;
        self.playback.playing = false;
        self.selection = Selection::Nothing;
        self.discovery.shown = None;
        self.clamp();
    }

    pub(super) fn delete_selected(&mut self) {
        match (self.selection, self.pose) {
            (Selection::Target(index), Some(pose)) => self.change(Change::RemoveTarget { pose, index }),
            (Selection::Pin(index), _) => self.change(Change::RemovePin(index)),
            (Selection::Keyframe(index), _) => self.change(Change::RemoveKeyframe(index)),
            (Selection::Network(index), _) => self.change(Change::RemoveNetwork(index)),
            _ => return,
        }
        self.selection = Selection::Nothing;
    }

    pub(super) fn escape(&mut self) {
        if self.discovery.running.is_some() && !self.history.in_gesture() && !self.sketching.open {
            return self.cancel_propose();
        }
        if self.history.in_gesture() {
            self.history.cancel();
        } else if self.files.dialog.is_some() {
            self.file(FileAction::CloseDialog);
        } else if self.sketching.open {
            self.sketch(Sketch::Select(None, None));
        } else if self.mode == Mode::Animation {
            self.playback.playing = false;
            self.mode = Mode::Pose;
        } else {
            self.selection = Selection::Nothing;
            self.discovery.shown = None;
        }
        self.clamp();
    }

    fn take_finished(&mut self, Finished { serial, outcome }: Finished) {
        match outcome {
            Outcome::Proposed(proposals) => self.take_proposals(serial, proposals),
            Outcome::Remeshed(made) => self.take_mesh(serial, made),
            Outcome::Reshaped(made) => self.take_body(serial, made),
            Outcome::Rigged(rigged) => self.take_rig(serial, rigged),
            Outcome::Keyed(keyed) => self.take_key(serial, keyed),
            Outcome::Imported(result) => self.take_import(result),
            Outcome::Exported { folder, result } => self.take_export(&folder, result),
            Outcome::Textured { path, texture } => self.take_texture(path, texture),
            Outcome::Picked { path, at_once } => self.take_path(path, at_once),
            Outcome::Broken { job, why } => {
                self.break_off(serial);
                self.messages.error(format!("{job} failed: {why}"));
            }
        }
    }

    /// Nobody waits for a job any more that broke.
    fn break_off(&mut self, serial: u64) {
        let jobs = [
            &mut self.discovery.running,
            &mut self.meshing.running,
            &mut self.rigging.running,
            &mut self.keying,
            &mut self.files.running,
        ];
        for running in jobs {
            if Running::is(running.as_ref(), serial) {
                *running = None;
            }
        }
        if self.files.running.is_none() {
            self.files.working = None;
        }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.cancel_propose();
        self.cancel_remesh();
        self.cancel_keying();
        self.cancel_rig();
    }
}

fn first_pose(design: &Design) -> Option<usize> {
    (!design.poses.is_empty()).then_some(0)
}
