//! Input at the pace of the frames: what a hand did within one long frame is seen step by step.
//!
//! egui looks for the widget under the pointer once a frame, at the pointer's last position, and tells a drag from a click by
//! what moved while a button was down. Where a frame takes long, a quick hand presses, moves on and lets go within one: the
//! press would go to whatever lies under the end of that way, and the drag would be none.

use eframe::egui::Event;

/// Keeps for the next frame the moves that follow a press, and a release that follows moves.
#[derive(Default)]
pub struct Pacing {
    held: Vec<Event>,
}

impl Pacing {
    /// Leaves in `events` what this frame should see. Whether something waits for the next.
    pub fn pace(&mut self, events: &mut Vec<Event>) -> bool {
        self.held.append(events);
        std::mem::swap(&mut self.held, events);
        self.held.extend(cut(events).into_iter().flat_map(|at| events.split_off(at)));
        !self.held.is_empty()
    }
}

/// Where the next frame's events begin.
fn cut(events: &[Event]) -> Option<usize> {
    let (mut pressed, mut moved) = (false, false);
    for (at, event) in events.iter().enumerate() {
        match event {
            Event::PointerMoved(_) if pressed => return Some(at),
            Event::PointerMoved(_) => moved = true,
            Event::PointerButton { pressed: true, .. } => pressed = true,
            Event::PointerButton { pressed: false, .. } if moved && !pressed => return Some(at),
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{Modifiers, PointerButton, Pos2, pos2};

    fn button(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
    }

    #[test]
    fn a_press_is_seen_before_the_moves_that_follow() {
        let [a, b, c] = [1.0, 2.0, 3.0].map(|x| pos2(x, 0.0));
        let all =
            [Event::PointerMoved(a), button(a, true), Event::PointerMoved(b), Event::PointerMoved(c), button(c, false)];
        let mut pacing = Pacing::default();
        let mut events = all.to_vec();
        assert!(pacing.pace(&mut events));
        assert_eq!(events, all[..2]);
        // What came since follows what was held, in order.
        let mut events = vec![Event::PointerMoved(a), button(a, true), button(a, false), Event::PointerMoved(b)];
        let last = events.clone();
        assert!(pacing.pace(&mut events));
        assert_eq!(events, all[2..4], "the drag before its end");
        let mut events = Vec::new();
        assert!(pacing.pace(&mut events));
        assert_eq!(events, [&all[4..], &last[..3]].concat());
        let mut events = Vec::new();
        assert!(!pacing.pace(&mut events));
        assert_eq!(events, last[3..]);
    }

    #[test]
    fn moves_without_a_press_and_clicks_are_left_alone() {
        let at = pos2(1.0, 0.0);
        let all = [Event::PointerMoved(at), Event::PointerMoved(at), button(at, true), button(at, false)];
        let mut events = all.to_vec();
        assert!(!Pacing::default().pace(&mut events));
        assert_eq!(events, all);
    }
}
