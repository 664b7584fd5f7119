//! The state of the window, in parts.

use super::discovery::Discovery;
use super::document::Document;
use super::files::Files;
use super::filming::Filming;
use super::following::Following;
use super::group::Group;
use super::judging::Judging;
use super::look::Look;
use super::meshing::{Meshing, Resolution};
use super::motors::Motors;
use super::overlay::{Overlay, Renamed};
use super::picked::{Mode, Picked, Selection};
use super::playback::Playback;
use super::posing::Posing;
use super::rigging::Rigging;
use super::safety::Safety;
use super::sketching::Sketching;
use super::solo::Solo;
use super::solver::{Shapes, Solver};
use super::tasks::Tasks;
use super::texturing::{self, Texturing};
use super::timing::Timing;
use super::winding::Winding;
use crate::design::file::MAX_BYTES;
use crate::design::history::History;
use crate::design::texture::Origin;
use crate::design::{Design, Target};
use crate::engine::{Quality, Request};
use crate::files::Stamp;
use crate::operations::{Context, export};
use crate::outline::Drawing;
use crate::picture::Texture;
use crate::picture::layers::{Layer, Textured};
use crate::rigging::{Proposal, ProposeOptions};
use crate::studio::canvas::Hit;
use crate::studio::jobs::{self, Jobs, Running, Wake};
use crate::studio::keeper::Abandoned;
use crate::studio::language::t;
use crate::studio::messages::Messages;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Makes proposals for a design and the targets of a pose, and tells of them as they are found.
pub type Propose =
    Arc<dyn Fn(&Design, &[Target], &ProposeOptions, Found<'_>, &AtomicBool) -> Vec<Arc<Proposal>> + Send + Sync>;
/// Hears of the list of proposals as it grows.
pub type Found<'f> = &'f mut dyn FnMut(&[Arc<Proposal>]);
/// Writes the blueprint of a design into a folder, and returns its remarks.
pub type Export =
    Arc<dyn Fn(&Design, &Path, &export::Options, &mut Context<'_>) -> Result<Vec<String>, String> + Send + Sync>;

/// The long work that is done elsewhere; tests put their own in.
#[derive(Clone)]
pub struct Services {
    pub propose: Propose,
    pub export: Export,
}

/// Everything that the window knows. Panels and tools read it; only acts change it, each the parts that it is about.
pub struct Session {
    pub(crate) document: Document,
    pub(crate) picked: Picked,
    /// Targets and pins that are picked out together.
    pub(crate) group: Group,
    pub(crate) posing: Posing,
    pub(crate) look: Look,
    pub(crate) playback: Playback,
    pub(crate) timing: Timing,
    pub(crate) filming: Filming,
    pub(crate) solver: Solver,
    pub(crate) discovery: Discovery,
    pub(crate) rigging: Rigging,
    pub(crate) judging: Judging,
    pub(crate) solo: Solo,
    pub(crate) winding: Winding,
    pub(crate) meshing: Meshing,
    pub(crate) motors: Motors,
    pub(crate) sketching: Sketching,
    pub(crate) texturing: Texturing,
    pub(crate) following: Following,
    /// A keyframe that is worked out.
    pub(crate) keying: Option<Running>,
    pub(crate) messages: Messages,
    pub(crate) files: Files,
    pub(crate) safety: Safety,
    /// The tools that are taken, by name: of the views and of the sheet.
    pub(crate) tools: [&'static str; 2],
    /// The panel that is open, by name.
    pub(crate) panel: &'static str,
    /// Whether pictures can be drawn.
    pub(crate) gpu: bool,
    pub(crate) overlay: Option<Overlay>,
    /// What a press would do to what lies under the pointer, in English; nothing where the tool alone says it.
    pub(crate) foretold: Option<&'static str>,
    /// Whether the next step is shown.
    pub(crate) guided: bool,
    /// Text for the clipboard of the system, until the frame is over.
    pub(crate) clipboard: Option<String>,
    /// A name that is being typed.
    pub(crate) renaming: Option<(Renamed, String)>,
    pub(crate) jobs: Jobs,
    /// Jobs of panels, and what came of them.
    pub(crate) tasks: Tasks,
    pub(crate) services: Services,
}

impl Session {
    pub fn new(design: Design, path: Option<PathBuf>, wake: Wake, services: Services) -> Self {
        let seen = path.as_deref().and_then(|path| Stamp::at(path, MAX_BYTES).ok());
        let document = Document::new(design, path);
        Self {
            picked: Picked::first(document.design()),
            group: Group::default(),
            posing: Posing::default(),
            look: Look::default(),
            playback: Playback::default(),
            timing: Timing::default(),
            filming: Filming::default(),
            solver: Solver::new(document.design(), wake.clone()),
            document,
            discovery: Discovery::default(),
            rigging: Rigging::default(),
            judging: Judging::default(),
            solo: Solo::default(),
            winding: Winding::default(),
            meshing: Meshing::default(),
            motors: Motors::default(),
            sketching: Sketching::default(),
            texturing: Texturing::default(),
            following: Following::default(),
            keying: None,
            messages: Messages::default(),
            files: Files::default(),
            safety: Safety::seen(seen),
            tools: [""; 2],
            panel: "",
            gpu: false,
            overlay: None,
            foretold: None,
            guided: true,
            clipboard: None,
            renaming: None,
            jobs: Jobs::new(wake),
            tasks: Tasks::default(),
            services,
        }
    }

    /// Where the document was read from; what waits in a folder of the window's own does not stay there.
    pub(crate) fn origin(&self) -> Option<Origin<'_>> {
        let file = self.document.origin.as_deref()?;
        let own = self.safety.store.as_ref().is_some_and(|store| store.holds(file));
        Some(Origin { file, stays: !own && self.document.kept.is_none() })
    }

    /// The document as it is now.
    pub fn design(&self) -> &Arc<Design> {
        self.document.design()
    }

    /// The document as the views have it: with one network alone, where that is asked for.
    pub fn acting(&self) -> &Arc<Design> {
        self.solo.acting(self.design())
    }

    pub fn solo(&self) -> &Solo {
        &self.solo
    }

    /// The winches as a hand has wound them.
    pub fn winding(&self) -> &Winding {
        &self.winding
    }

    pub fn history(&self) -> &History {
        &self.document.history
    }

    /// The current pose; `None` is the rest shape.
    pub fn pose(&self) -> Option<usize> {
        self.picked.pose
    }

    /// Whether a dialog, the palette or a page stands over the window.
    pub fn is_covered(&self) -> bool {
        self.files.dialog.is_some() || self.overlay.is_some()
    }

    /// Which of these panels is open; the first one at first.
    pub fn panel(&self, all: &[&'static str]) -> &'static str {
        all.iter().copied().find(|&id| id == self.panel).or(all.first().copied()).unwrap_or_default()
    }

    /// The jobs of panels.
    pub fn tasks(&self) -> &Tasks {
        &self.tasks
    }

    /// Whether a tool is the one for its canvas.
    pub fn has_taken(&self, id: &str) -> bool {
        self.tools.contains(&id)
    }

    /// The overlay over the window.
    pub fn overlay(&self) -> Option<Overlay> {
        self.overlay
    }

    /// A name that is being typed.
    pub fn renaming(&self) -> Option<&(Renamed, String)> {
        self.renaming.as_ref()
    }

    /// The part that commands are about when nothing is pointed at.
    pub fn selected(&self) -> Hit {
        match self.picked.selection {
            Selection::Target(index) => Hit::Target(index),
            Selection::Pin(index) => Hit::Pin(index),
            Selection::Part(part) => Hit::Part(part),
            _ => Hit::Nothing,
        }
    }

    /// What the views show.
    pub fn mode(&self) -> Mode {
        self.picked.mode
    }

    pub fn selection(&self) -> Selection {
        self.picked.selection
    }

    /// Targets and pins that are picked out together.
    pub fn group(&self) -> &Group {
        &self.group
    }

    /// Keyframes that are picked out together, and what the motors make of the animation.
    pub fn timing(&self) -> &Timing {
        &self.timing
    }

    /// Numbers of the keyframes that are picked out, alone or together.
    pub fn keys(&self) -> Vec<usize> {
        match self.picked.selection {
            Selection::Keyframe(key) => vec![key],
            _ => self.timing.keys.clone(),
        }
    }

    /// Keyframes that follow their poses.
    pub fn following(&self) -> &Following {
        &self.following
    }

    /// A film that is being made.
    pub fn filming(&self) -> &Filming {
        &self.filming
    }

    /// The ways of posing that are on.
    pub fn posing(&self) -> &Posing {
        &self.posing
    }

    pub fn playback(&self) -> &Playback {
        &self.playback
    }

    pub fn discovery(&self) -> &Discovery {
        &self.discovery
    }

    pub fn shapes(&self) -> &Shapes {
        &self.solver.shapes
    }

    pub fn messages(&self) -> &Messages {
        &self.messages
    }

    pub fn look(&self) -> &Look {
        &self.look
    }

    /// Whether a thread is busy with a file, a keyframe or a rig.
    pub fn is_working(&self) -> bool {
        self.working().is_some()
    }

    /// The work that threads are busy with, ready to be shown.
    pub fn working(&self) -> Option<&'static str> {
        let keying = self.keying.is_some().then_some(t("Working out the keyframe"));
        let rigging = self.rigging.running.is_some() || self.rigging.curve.running.is_some();
        let rigging = rigging.then_some(t("Looking for winches and tendons"));
        let filming = self.filming.running.is_some().then_some(t("Drawing the animation"));
        let following = self.following.is_running().then_some(t("Working out keyframes again"));
        self.files.working.or(rigging).or(keying).or(filming).or(following)
    }

    /// Whether that work can be stopped.
    pub fn can_stop(&self) -> bool {
        self.files.running.is_some()
            || self.rigging.running.is_some()
            || self.rigging.curve.running.is_some()
            || self.keying.is_some()
            || self.filming.running.is_some()
            || self.following.is_running()
    }

    /// How far that work is, where it tells: steps, of how many.
    pub fn working_at(&self) -> Option<[usize; 2]> {
        match self.files.working {
            Some(_) => self.files.done.get(),
            None if self.filming.running.is_some() => self.filming.done.get(),
            None if self.following.is_running() => self.following.done.get(),
            None => None,
        }
    }

    /// Whether the window is about to close.
    pub fn is_closing(&self) -> bool {
        self.files.quit
    }

    /// Targets of the current pose; none at rest and while the animation is shown.
    pub fn targets(&self) -> &[Target] {
        match (self.picked.mode, self.picked.pose.and_then(|pose| self.design().poses.get(pose))) {
            (Mode::Pose, Some(pose)) => &pose.targets,
            _ => &[],
        }
    }

    /// Whether a hand is in the middle of a change.
    pub fn is_dragging(&self) -> bool {
        self.document.history.in_gesture()
    }

    /// Whether the shapes answer the newest request; while the outline is drawn there is none.
    pub fn is_settled(&self) -> bool {
        self.sketching.open || self.solver.is_settled()
    }

    /// Whether the hand rests and the shapes are being refined with all effort.
    pub fn is_refining(&self) -> bool {
        self.solver.worker.is_refining()
    }

    /// How much work a frame may take.
    pub fn quality(&self) -> Quality {
        self.solver.quality
    }

    /// The newest request to the solver.
    pub fn request(&self) -> Option<&Request> {
        self.solver.asked.as_ref()
    }

    /// The proposal that the views show.
    pub fn shown_proposal(&self) -> Option<&Arc<Proposal>> {
        self.discovery.shown()
    }

    /// The proposal that the views show now, picked or under the pointer.
    pub fn displayed_proposal(&self) -> Option<&Arc<Proposal>> {
        self.discovery.displayed()
    }

    /// The solver's warning about the newest shapes.
    pub fn solver_warning(&self) -> Option<&str> {
        self.solver.warning.as_deref()
    }

    /// Why networks cannot be proposed now, if so.
    pub fn cannot_propose(&self) -> Option<&'static str> {
        if self.discovery.running.is_some() && !self.discovery.is_stale() {
            Some(t("Discovery is running"))
        } else if self.picked.mode != Mode::Pose || self.targets().is_empty() {
            Some(t("Choose a pose with at least one target first: drag a point of the body"))
        } else {
            None
        }
    }

    pub fn meshing(&self) -> &Meshing {
        &self.meshing
    }

    /// Motors that are driven live.
    pub fn motors(&self) -> &Motors {
        &self.motors
    }

    pub fn resolution(&self) -> Resolution {
        self.meshing.resolution(&self.document.figures)
    }

    pub fn rigging(&self) -> &Rigging {
        &self.rigging
    }

    /// How near each pose comes, and which rules of sewing are broken.
    pub fn judging(&self) -> &Judging {
        &self.judging
    }

    /// Why no rig can be looked for now, if so.
    pub fn cannot_rig(&self) -> Option<&'static str> {
        if self.rigging.running.is_some() || self.rigging.curve.running.is_some() {
            return Some(t("A rig is being looked for"));
        }
        let posed = self.design().poses.iter().any(|pose| !pose.targets.is_empty());
        (!posed).then_some(t("Pose the plushie first: drag a point of the body"))
    }

    /// Files that were opened or saved lately, the newest first.
    pub fn recent(&self) -> &[PathBuf] {
        &self.safety.settings.recent
    }

    /// The work that is offered now.
    pub fn offered(&self) -> Option<&Abandoned> {
        self.safety.abandoned.last()
    }

    pub fn sketching(&self) -> &Sketching {
        &self.sketching
    }

    /// The drawing of the outline: the document's, or one traced from its outline.
    pub fn drawing(&self) -> &Drawing {
        self.sketching.drawing(self.design())
    }

    /// The texture of the document, as soon as it is read.
    pub fn texture(&self) -> Option<&Arc<Texture>> {
        match &self.texturing.found {
            texturing::Found::Picture(texture) => Some(texture),
            _ => None,
        }
    }

    /// Why a layer of the pictures cannot be shown, if so.
    pub fn cannot_show(&self, layer: &str) -> Option<&'static str> {
        if layer != Textured::NAME {
            return None;
        }
        match self.texturing.found {
            texturing::Found::Picture(_) => None,
            texturing::Found::Trouble => Some(t("The texture of this plushie is missing or broken")),
            texturing::Found::Nothing if self.texturing.path.is_some() => Some(t("The texture is being read")),
            texturing::Found::Nothing => {
                Some(t("This plushie has no texture; the import has “Keep the picture as texture”"))
            }
        }
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.discovery.cancel();
        self.look.onion.clear();
        self.meshing.cancel();
        self.rigging.cancel();
        self.judging.cancel();
        self.tasks.cancel();
        jobs::cancel(&mut self.keying);
        jobs::cancel(&mut self.filming.running);
    }
}
