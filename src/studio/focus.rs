//! The focus of the keyboard, always seen: a ring around whatever has it, drawn in one place, so that nothing can forget it.

use eframe::egui::{Color32, Context, Id, Key, LayerId, Order, Stroke, StrokeKind};

/// Room between what has the focus and its ring, logical pixels.
const ROOM: f32 = 2.0;

/// Whether the keyboard moves the focus: a click on something needs no ring around it.
#[derive(Default)]
pub struct Focus {
    by_keyboard: bool,
}

impl Focus {
    /// Draws the ring, over everything.
    pub fn paint(&mut self, ctx: &Context, color: Color32) {
        let (tab, pressed) = ctx.input(|i| (i.key_pressed(Key::Tab), i.pointer.any_pressed()));
        self.by_keyboard = tab || self.by_keyboard && !pressed;
        let Some(focused) = ctx.memory(|memory| memory.focused()).filter(|_| self.by_keyboard) else { return };
        let Some(response) = ctx.read_response(focused) else { return };
        // What is scrolled out of sight has no place to be ringed.
        let rect = response.interact_rect.intersect(ctx.content_rect().shrink(ROOM + 1.0));
        if rect.is_positive() {
            let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, Id::unique("ring of the focus")));
            painter.rect_stroke(rect.expand(ROOM), 4.0, Stroke::new(2.0, color), StrokeKind::Middle);
        }
    }
}
