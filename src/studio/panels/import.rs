//! How an outline is read, and what would be read: a part of the import's dialog.

use super::widgets::sentence;
use crate::mesh::MAX_FIBERS;
use crate::operations::FiberCount;
use crate::operations::preview::Previewed;
use crate::outline::{Background, Holes, Import, Pieces, Remedy};
use crate::picture::preview::Preview;
use crate::studio::language::t;
use crate::studio::session::{ImportChoice, PathDialog, Session};
use crate::studio::words;
use eframe::egui::load::SizedTexture;
use eframe::egui::{
    CollapsingHeader, ColorImage, DragValue, Grid, Id, Image, RichText, ScrollArea, TextEdit, TextureHandle,
    TextureOptions, Ui, emath,
};
use std::ops::RangeInclusive;

/// What can be typed for the silhouette's height and width, mm, and for the number of fibres; 0 for what is usual.
const SIZES_MM: RangeInclusive<f64> = 0.0..=5000.0;
const FIBERS: RangeInclusive<f64> = 0.0..=MAX_FIBERS as f64;
/// The largest length of the clean-up, mm.
const LARGEST_MM: f64 = 1000.0;
/// Sides of the preview in the window.
const SHOWN_PX: f32 = 220.0;

/// The settings of an import, and what would be read with them.
pub fn settings(ui: &mut Ui, session: &Session, edited: &mut PathDialog) {
    let ImportChoice { options, layers, blocks } = &mut *edited.import;
    ui.horizontal(|ui| {
        let tip = t("Of the silhouette; 0: the size that the file has");
        let mut height = options.import.height_mm.unwrap_or(0.0);
        or_usual(ui, (t("Height"), tip), &mut height, (t("as in the file"), " mm"), SIZES_MM);
        options.import.height_mm = (height > 0.0).then_some(height);
        ui.add_space(12.0);
        let tip = t("Of the silhouette, in place of its height; 0: the size that the file has");
        let mut width = options.import.width_mm.unwrap_or(0.0);
        or_usual(ui, (t("Width"), tip), &mut width, (t("as in the file"), " mm"), SIZES_MM);
        // One follows from the other.
        if width > 0.0 && options.import.width_mm != Some(width) {
            options.import.height_mm = None;
        }
        options.import.width_mm = (width > 0.0 && options.import.height_mm.is_none()).then_some(width);
        ui.add_space(12.0);
        let tip = t("0: those of a file that brings its own mesh; otherwise 414, or more where the outline needs them");
        let mut fibers = match options.fibers {
            FiberCount::Usual => 0.0,
            FiberCount::AtLeast(fibers) | FiberCount::Exactly(fibers) => fibers as f64,
        };
        or_usual(ui, (t("Muscle fibres"), tip), &mut fibers, (t("as usual"), ""), FIBERS);
        let fibers = fibers.round() as usize;
        options.fibers = FiberCount::asked((fibers > 0).then_some(fibers));
    });
    ui.horizontal(|ui| {
        let mut largest = options.import.pieces == Pieces::Largest;
        ui.checkbox(&mut largest, t("Largest piece only"))
            .on_hover_text(t("Of a drawing in several pieces, which is refused otherwise"));
        options.import.pieces = if largest { Pieces::Largest } else { Pieces::Refuse };
        ui.add_space(12.0);
        let tip = t("Holes of a drawing in thin lines alone are filled; or keep them, or fill all");
        let holes = [(Holes::Found, t("as found")), (Holes::Keep, t("keep")), (Holes::Fill, t("fill"))];
        choice(ui, (t("Holes"), tip), &mut options.import.holes, &holes);
    });
    let tip =
        t("Show on the plushie what the drawing or picture shows; saving puts it beside the plushie, NAME.texture.png");
    ui.checkbox(&mut options.texture, t("Keep the picture as texture")).on_hover_text(tip);
    names(
        ui,
        t("Layers"),
        t("Of an SVG or DXF drawing: the names of those that count, between commas"),
        t("all"),
        layers,
    );
    names(
        ui,
        t("Blocks"),
        t("Of a DXF drawing: the names of blocks to read in its place, between commas"),
        t("none"),
        blocks,
    );
    CollapsingHeader::new(t("Reading and clean-up"))
        .id_salt("import details")
        .show(ui, |ui| details(ui, &mut options.import));
    shown(ui, session, edited);
}

/// Names between commas.
fn names(ui: &mut Ui, name: &str, tip: &str, none: &str, text: &mut String) {
    ui.horizontal(|ui| {
        let label = ui.label(name);
        let field = TextEdit::singleline(text).hint_text(none).desired_width(f32::INFINITY);
        ui.add(field).labelled_by(label.id).on_hover_text(tip);
    });
}

/// The picture of what would be read, with a line for each guess, and a button for each that has another answer.
/// Its place is kept before it is there, so that nothing moves away from under the pointer.
fn shown(ui: &mut Ui, session: &Session, edited: &mut PathDialog) {
    ui.add_space(4.0);
    ui.horizontal_top(|ui| {
        ui.set_min_height(SHOWN_PX);
        let Some((seen, fresh)) = session.files.preview.of(&edited.path, &edited.import) else {
            ui.weak(t("What would be read is shown here."));
            return;
        };
        // What was asked for last has its own line.
        let tells = fresh && edited.trouble.is_none();
        match seen {
            Ok(previewed) => {
                picture(ui, session.files.preview.serial(), &previewed.picture);
                ScrollArea::vertical()
                    .id_salt("preview notes")
                    .max_height(SHOWN_PX)
                    .min_scrolled_height(SHOWN_PX)
                    .show(ui, |ui| {
                        ui.vertical(|ui| told(ui, previewed, tells, &mut edited.import.options.import));
                    });
            }
            Err(why) if tells => {
                ui.label(RichText::new(sentence(why)).color(ui.visuals().error_fg_color));
            }
            Err(_) => {}
        }
    });
}

/// The size, what the colours mean, and each guess.
fn told(ui: &mut Ui, previewed: &Previewed, tells: bool, import: &mut Import) {
    let [width, height] = previewed.size_mm;
    ui.label(format!("{width:.0} x {height:.0} mm"));
    for line in &previewed.legend {
        ui.label(RichText::new(line).small());
    }
    if let Some(error) = previewed.refused.as_ref().filter(|_| tells) {
        ui.label(RichText::new(sentence(&words::outline(error))).color(ui.visuals().error_fg_color));
        switch(ui, error.remedy(), import);
    }
    for change in &previewed.changes.steps {
        ui.label(RichText::new(change.line()).small());
        switch(ui, change.remedy(), import);
    }
    for note in &previewed.changes.notes {
        ui.label(RichText::new(words::note(note)).small());
        switch(ui, note.remedy(), import);
    }
}

fn picture(ui: &mut Ui, serial: u64, picture: &Preview) {
    let id = Id::unique("preview of an import");
    let known: Option<(u64, TextureHandle)> = ui.data(|data| data.get_temp(id));
    let texture = match known.filter(|(made_of, _)| *made_of == serial) {
        Some((_, texture)) => texture,
        None => {
            let size = [picture.width as usize, picture.height as usize];
            let image = ColorImage::from_rgba_unmultiplied(size, &picture.pixels);
            let texture = ui.ctx().load_texture("preview", image, TextureOptions::LINEAR);
            ui.data_mut(|data| data.insert_temp(id, (serial, texture.clone())));
            texture
        }
    };
    let sized = SizedTexture::new(texture.id(), [SHOWN_PX, SHOWN_PX]);
    ui.add(Image::from_texture(sized)).accessible_name(t("What would be read"));
}

/// The other answer to a guess, where one press gives it.
fn switch(ui: &mut Ui, remedy: Option<Remedy>, import: &mut Import) {
    let (label, set): (&str, fn(&mut Import)) = match remedy {
        Some(Remedy::Background) => (t("Keep it"), |import| import.background = Background::Keep),
        Some(Remedy::DropBackground) => (t("Leave it out"), |import| import.background = Background::Drop),
        Some(Remedy::Holes) => (t("Fill the holes"), |import| import.holes = Holes::Fill),
        Some(Remedy::KeepHoles) => (t("Keep the holes"), |import| import.holes = Holes::Keep),
        Some(Remedy::Opacity) => (t("Count all that shows"), |import| import.threshold = Some(1)),
        Some(Remedy::Pieces) => (t("Take the largest piece"), |import| import.pieces = Pieces::Largest),
        Some(Remedy::Smooth) => (t("Leave it as it is"), |import| import.smooth_mm = Some(0.0)),
        Some(Remedy::Gap) => (t("Leave them open"), |import| import.gap_mm = Some(0.0)),
        _ => return,
    };
    if ui.small_button(label).clicked() {
        set(import);
    }
}

/// What is seldom asked for.
fn details(ui: &mut Ui, import: &mut Import) {
    ui.horizontal(|ui| {
        let tip = t("Paper, cards and frames that everything else lies on: what is surely one is left out; or leave out any, or keep it");
        let grounds =
            [(Background::Found, t("as found")), (Background::Drop, t("leave out")), (Background::Keep, t("keep"))];
        choice(ui, (t("Background"), tip), &mut import.background, &grounds);
    });
    Grid::new("import details").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
        let tip = t("How far smoothing may move the boundary; corners stay. -1: where it is finer than scissors follow; 0: not at all");
        optional(ui, (t("Smooth"), tip), &mut import.smooth_mm);
        ui.end_row();
        let tip = t("Parts less than this apart are joined; -1: what scissors cannot part; 0: none");
        optional(ui, (t("Gaps up to"), tip), &mut import.gap_mm);
        ui.end_row();
        let tip = t("Ends of lines less than this apart are joined; -1: a small part of the size; 0: none");
        optional(ui, (t("Join ends up to"), tip), &mut import.join_mm);
        ui.end_row();
        // A least width of nothing widens nothing, which is not the usual.
        let tip = t("Parts thinner than this are widened; -1: hairlines alone, as long as that changes little; 0: none");
        optional(ui, (t("Least width"), tip), &mut import.min_width_mm);
        ui.end_row();
        let tip = t("What a plain number of a DXF or OBJ file or a pixel measures; 0: what the file says");
        let mut unit = import.unit_mm.unwrap_or(0.0);
        or_usual(ui, (t("Unit"), tip), &mut unit, (t("as in the file"), " mm"), 0.0..=LARGEST_MM);
        import.unit_mm = (unit > 0.0).then_some(unit);
        ui.end_row();
        let tip = t("Pictures: difference from the background, 0 to 255, from which a pixel is ink; -1: it is found");
        let mut level = import.threshold.map_or(-1.0, f64::from);
        or_usual(ui, (t("Ink from"), tip), &mut level, (t("as found"), ""), -1.0..=255.0);
        import.threshold = (level >= 0.0).then_some(level as u8);
        ui.end_row();
    });
}

/// One of a few, as buttons beside each other.
fn choice<T: PartialEq + Copy>(ui: &mut Ui, (name, tip): (&str, &str), value: &mut T, all: &[(T, &str)]) {
    ui.label(name).on_hover_text(tip);
    for (one, label) in all {
        let button = ui.selectable_value(value, *one, *label).on_hover_text(tip);
        button.accessible_name(format!("{name}: {label}"));
    }
}

/// A length that has a usual value, which -1 stands for.
fn optional(ui: &mut Ui, label: (&str, &str), value: &mut Option<f64>) {
    let mut shown = value.unwrap_or(-1.0);
    or_usual(ui, label, &mut shown, (t("as usual"), " mm"), -1.0..=LARGEST_MM);
    *value = (shown >= 0.0).then_some(shown);
}

/// A number whose least value stands for what is usual, and is shown as that in words.
fn or_usual(
    ui: &mut Ui,
    (name, tip): (&str, &str),
    value: &mut f64,
    (usual, unit): (&'static str, &'static str),
    range: RangeInclusive<f64>,
) {
    let least = *range.start();
    let label = ui.label(name).on_hover_text(tip);
    let shown = move |value: f64, decimals: RangeInclusive<usize>| match value {
        value if value <= least => usual.to_owned(),
        value => format!("{}{unit}", emath::format_with_decimals_in_range(value, decimals)),
    };
    let typed = move |text: &str| match text.trim() {
        text if text.is_empty() || text == usual => Some(least),
        text => text.trim_end_matches(unit.trim_start()).trim().parse().ok(),
    };
    let drag = DragValue::new(value).range(range).speed(1.0).custom_formatter(shown).custom_parser(typed);
    ui.add(drag).labelled_by(label.id).on_hover_text(tip);
}
