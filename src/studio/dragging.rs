//! Dragging points of the body: each drag makes or moves a target, and is one undo step.

use super::action::Grab;
use super::change::{Change, Made};
use super::session::{Drag, Mode, Selection, Session};
use crate::design::Target;
use crate::outline::Point;

impl Session {
    pub(super) fn grab(&mut self, what: Grab, pointer: Point) {
        self.playback.playing = false;
        self.mode = Mode::Pose;
        self.discovery.shown = None;
        let from = |p: Point| [p[0] - pointer[0], p[1] - pointer[1]];
        match what {
            Grab::Target(index) => {
                let Some(pose) = self.pose else { return };
                let Some(target) = self.targets().get(index).copied() else { return };
                self.history.begin("Move target");
                self.selection = Selection::Target(index);
                self.drag = Some(Drag { pose, target: index, offset: from(target.to) });
            }
            Grab::Body(at, position) => {
                self.history.begin("Add target");
                let target = Target { at, to: position, weight: 1.0 };
                let change = Change::AddTarget { pose: self.pose, target };
                match self.history.preview(|design| change.apply(design)) {
                    Ok(made) => {
                        self.pick_out(made);
                        if let Made::Target { pose, index } = made {
                            self.drag = Some(Drag { pose, target: index, offset: from(position) });
                        }
                    }
                    Err(error) => {
                        self.history.cancel();
                        self.messages.error(error.to_string());
                    }
                }
            }
        }
    }

    pub(super) fn drag_to(&mut self, pointer: Point) {
        let Some(drag) = &self.drag else { return };
        let to = [pointer[0] + drag.offset[0], pointer[1] + drag.offset[1]];
        let change = Change::MoveTarget { pose: drag.pose, index: drag.target, to };
        if let Err(error) = self.history.preview(|design| change.apply(design)) {
            self.messages.error(error.to_string());
        }
    }

    pub(super) fn release(&mut self) {
        if self.drag.take().is_some() {
            self.history.commit();
        }
    }
}
