//! What panels are made of.

use crate::studio::action::{Action, Actions};
use crate::studio::session::Session;
use crate::studio::style;
use eframe::egui::{
    Button, Color32, Context, Frame, Key, Margin, Response, RichText, ScrollArea, TextEdit, TextStyle, Ui,
};

/// Height of a button that takes the width of its panel, logical pixels.
const WIDE: f32 = 30.0;

/// Of side panels: no fill, see [`style`].
pub fn frame() -> Frame {
    Frame::new().inner_margin(Margin::symmetric(12, 10))
}

/// Of dialogs and pages over the window.
pub fn dialog_frame(ctx: &Context) -> Frame {
    Frame::popup(&ctx.global_style()).inner_margin(16.0)
}

/// A heading of a panel.
pub fn heading(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).strong().size(13.5));
}

/// The one button of a panel or a dialog that matters most: so wide, or as wide as its words are in this language.
pub fn primary(ui: &mut Ui, enabled: bool, text: &str, width: f32) -> Response {
    let theme = style::theme_of(ui.visuals());
    let font = TextStyle::Button.resolve(ui.style());
    let words = ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER).size().x;
    let width = width.max(words + 2.0 * ui.spacing().button_padding.x);
    let label = RichText::new(text).strong().color(style::on_accent(theme));
    let button = Button::new(label).fill(style::accent(theme));
    ui.add_enabled_ui(enabled, |ui| wide(ui, button, width)).inner
}

/// A button of a given width, its text in the middle.
pub fn wide(ui: &mut Ui, button: Button<'_>, width: f32) -> Response {
    ui.add_sized([width, WIDE], button)
}

/// A text field that is taken with Enter or a click elsewhere and dropped with Escape. The name, once it is taken.
pub fn name_field(ui: &mut Ui, session: &Session, label: &str, actions: &mut Actions) -> Option<String> {
    let (what, text) = session.renaming()?;
    let mut typed = text.clone();
    let field = TextEdit::singleline(&mut typed).desired_width(f32::INFINITY);
    let response = ui.add(field).accessible_name(label);
    if !response.has_focus() && !response.lost_focus() {
        response.request_focus();
    }
    if response.lost_focus() {
        actions.push(Action::Typed(None));
        return (!ui.input(|i| i.key_pressed(Key::Escape))).then_some(typed);
    }
    if typed != *text {
        actions.push(Action::Typed(Some((*what, typed))));
    }
    None
}

/// What comes and goes by itself, as threads report. Whether it is shown or not, the widgets after it keep their ids: a click or a drag that is
/// under way finds them again, and so does the keyboard.
pub fn passing(ui: &mut Ui, shown: bool, add: impl FnOnce(&mut Ui)) {
    if shown {
        ui.scope(add);
    } else {
        ui.skip_ahead_auto_ids(1);
    }
}

/// What is scrolled in a page over the window, as high as what is in it up to `most` logical pixels. At once: left to itself it grows with the page
/// around it, half of what is missing a frame, and what a hand is about to press moves.
pub fn scroll(most: f32) -> ScrollArea {
    ScrollArea::vertical().max_height(most).min_scrolled_height(most).auto_shrink([false, true])
}

/// An error as a sentence of its own.
pub fn sentence(error: &str) -> String {
    let mut letters = error.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{Id, RawInput};

    #[test]
    fn what_comes_and_goes_moves_no_ids() {
        let ctx = Context::default();
        let mut ids: Vec<Id> = Vec::new();
        for shown in [false, true, false] {
            let mut output = ctx.run_ui(RawInput::default(), |ui| {
                ui.horizontal(|ui| {
                    passing(ui, shown, |ui| {
                        let _ = (ui.button("Now"), ui.label("and then"));
                    });
                    ids.push(ui.button("Always").id);
                });
            });
            output.textures_delta.clear();
        }
        assert!(ids.windows(2).all(|pair| pair[0] == pair[1]), "{ids:?}");
    }
}
