//! What is asked about a film of the animation.

use crate::operations::film::Kind;
use crate::studio::language::{mark, t};
use crate::studio::session::PathDialog;
use eframe::egui::{DragValue, Ui};
use std::path::Path;

/// The kinds, what they are called, and what they are for.
const KINDS: [(Kind, &str, &str); 3] = [
    (Kind::Gif, mark("GIF"), mark("Plays everywhere; few colours")),
    (Kind::Page, mark("Page"), mark("A file that a browser plays in a loop, in full colour")),
    (Kind::Pictures, mark("Pictures"), mark("A folder of numbered PNG pictures, for other programs")),
];
/// Smallest and largest sides, pixels, and pictures in a second.
const SIDES: std::ops::RangeInclusive<u32> = 16..=4096;
const RATES: std::ops::RangeInclusive<f64> = 1.0..=60.0;

/// Asks for the kind, the size and the rate. The ending of the path follows the kind.
pub(super) fn settings(ui: &mut Ui, dialog: &mut PathDialog) {
    let before = dialog.film.kind;
    ui.horizontal(|ui| {
        for (kind, label, tip) in KINDS {
            ui.radio_value(&mut dialog.film.kind, kind, t(label)).on_hover_text(t(tip));
        }
    });
    if dialog.film.kind != before {
        let path = Path::new(dialog.path.trim());
        let path = match dialog.film.kind {
            Kind::Gif => path.with_extension("gif"),
            Kind::Page => path.with_extension("html"),
            Kind::Pictures => path.with_extension(""),
        };
        dialog.path = path.to_string_lossy().into_owned();
    }
    ui.horizontal(|ui| {
        let (width, height) = &mut dialog.film.size;
        for (name, side) in [(t("Width"), width), (t("Height"), height)] {
            let label = ui.label(name);
            ui.add(DragValue::new(side).range(SIDES).suffix(" px")).labelled_by(label.id);
        }
        let label = ui.label(t("Pictures a second"));
        let mut rate = 1.0 / dialog.film.step_s;
        let field = DragValue::new(&mut rate).range(RATES).speed(0.1).max_decimals(1);
        if ui.add(field).labelled_by(label.id).changed() {
            dialog.film.step_s = 1.0 / rate;
        }
    });
    ui.checkbox(&mut dialog.film.texture, t("With its texture"));
}
