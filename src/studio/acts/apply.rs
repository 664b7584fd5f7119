//! What panels and tools ask for, done.

use super::{animate, edit, filing, frame, motors, sheet, timing, wind};
use crate::studio::action::Action;
use crate::studio::jobs::Outcome;
use crate::studio::session::{Session, Task};

/// Does what is asked for. A command that cannot be done says why.
pub fn apply(session: &mut Session, action: Action) {
    match action {
        Action::Change(change) => edit::change(session, change),
        Action::Live(change) => edit::live(session, change),
        Action::Again(change) => edit::again(session, change),
        Action::Run(command, at) => match command.refused(session, at) {
            None => (command.run)(session, at),
            Some(why) => session.messages.info(why),
        },
        Action::Overlay(overlay) => session.overlay = overlay,
        Action::Typed(renaming) => session.renaming = renaming,
        Action::DragTarget(to) => edit::drag_target(session, to),
        Action::MovePart(part, to) => edit::move_part(session, part, to),
        Action::Wind(winch, wound_mm) => wind::wind(session, winch, wound_mm),
        Action::WindMotor(winch, length_mm) => motors::wind(session, winch, length_mm),
        Action::SetMotors(choice) => session.motors.choice = *choice,
        Action::SelectPose(pose) => edit::select_pose(session, pose),
        Action::Select(selection) => {
            session.picked.selection = selection;
            session.group.set(Vec::new());
            session.timing.keys.clear();
        }
        Action::Gather(handles) => edit::gather(session, handles),
        Action::GatherKeys(keys) => edit::gather_keys(session, keys),
        Action::Paste(text) => timing::paste_text(session, &text),
        Action::SetBrush(brush) => session.posing.brush = brush,
        Action::DragPin(index, to) => edit::drag_pin(session, index, to),
        Action::SetQuality(quality) => session.solver.quality = quality,
        Action::SetCamera(plushie, camera) => {
            session.look.set_camera(plushie, camera);
            (session.look.zoom, session.look.frame) = (None, None);
        }
        Action::Scrub(time_s) => animate::scrub(session, time_s),
        Action::SetProposeOptions(options) => super::discover::set_options(session, options),
        Action::SetResolution(resolution) => session.meshing.wanted = Some(resolution),
        Action::SetRig(choice) => session.rigging.choice = choice,
        Action::ShowProposal(index) => (session.discovery.shown, session.discovery.picked) = (index, true),
        Action::HoverProposal(hovered) => session.discovery.hovered = hovered,
        Action::SortProposals(order) => session.discovery.order = order,
        Action::TakeRig(index) => super::rig::take_point(session, index),
        Action::ShowStage(stage) => session.discovery.stage = stage,
        Action::Sketch(sketch) => sheet::sketch(session, sketch),
        Action::File(action) => filing::ask(session, action),
        Action::Start(task) => start(session, task),
        Action::Stop(owner) => session.tasks.stop(owner),
        Action::ShowPlaces(places) => frame::show_places(session, &places),
        Action::DismissMessage(id) => session.messages.dismiss(id),
        Action::Foretell(words) => session.foretold = words,
    }
}

fn start(session: &mut Session, Task { owner, name, work }: Task) {
    let running = session.jobs.start(name, move |cancel| Outcome::Told { owner, told: work(cancel) });
    session.tasks.begin(owner, running);
}
