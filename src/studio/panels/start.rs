//! The start page: work that was left behind, designs to begin with as pictures, recent files, and ways to a new plushie.

use super::widgets::{heading, primary, scroll};
use super::{buttons, dialogs};
use crate::design::{Design, bundled, file};
use crate::engine::Shape;
use crate::files::shown;
use crate::picture::palette::Theme;
use crate::picture::portrait;
use crate::picture::preview::Preview;
use crate::studio::action::{Action, Actions, FileAction};
use crate::studio::commands::files::{NEW, NEW_DRAWING, OPEN};
use crate::studio::jobs::Told;
use crate::studio::language::{mark, t, tf};
use crate::studio::pictures::Pictures;
use crate::studio::session::{Overlay, Session, Task};
use eframe::egui::{
    Align2, Context, FontId, Frame, Id, Label, Modal, Rect, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo,
    vec2,
};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The pictures, and what they were asked for.
#[derive(Default)]
pub struct State {
    pictures: Pictures,
    asked: Option<(Theme, Vec<PathBuf>, Option<PathBuf>)>,
}

/// Pictures of the examples, of recent files and of work that was left behind, each where it could be made.
struct Shots {
    theme: Theme,
    work: Option<(PathBuf, Option<Arc<Preview>>)>,
    examples: Vec<Option<Arc<Preview>>>,
    recent: Vec<(PathBuf, Option<Arc<Preview>>)>,
}

const OWNER: &str = "start.pictures";
/// Width of the page and size of a card, logical pixels; size of its picture, pixels.
const WIDTH: f32 = 700.0;
const MARGIN: f32 = 18.0;
const CARD: [f32; 2] = [164.0, 138.0];
const SIZE: (u32, u32) = (300, 216);
/// Recent files that are shown.
const RECENT: usize = 8;

pub fn show(ctx: &Context, session: &Session, state: &mut State, actions: &mut Actions) {
    if session.overlay() != Some(Overlay::Start) {
        return;
    }
    state.pictures.begin();
    let shots = follow(session, state, actions);
    let modal = Modal::new(Id::unique("start page"))
        .frame(Frame::popup(&ctx.global_style()).inner_margin(MARGIN))
        .show(ctx, |ui| {
            ui.set_width(WIDTH);
            ui.label(RichText::new("Plushwright").size(20.0).strong());
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                for command in [&NEW, &NEW_DRAWING, &OPEN] {
                    let before = actions.len();
                    buttons::text(ui, session, command, actions);
                    if actions.len() > before {
                        actions.insert(before, Action::Overlay(None));
                    }
                }
            });
            let most = 0.74 * ui.ctx().content_rect().height();
            scroll(most).show(ui, |ui| {
                left_behind(ui, session, state, shots, actions);
                examples(ui, state, shots, actions);
                recent(ui, session, state, shots, actions);
            });
            ui.add_space(8.0);
            if ui.button(t("Go on with what is open")).clicked() {
                actions.push(Action::Overlay(None));
            }
        });
    if modal.should_close() {
        actions.push(Action::Overlay(None));
    }
}

/// Work that another window left behind.
fn left_behind(ui: &mut Ui, session: &Session, state: &mut State, shots: Option<&Shots>, actions: &mut Actions) {
    let Some(work) = session.offered() else { return };
    ui.add_space(6.0);
    heading(ui, t("Not saved"));
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(CARD[0], CARD[1] - 28.0), Sense::hover());
        let found = shots.and_then(|shots| shots.work.as_ref()).filter(|(of, _)| of == work.folder());
        if let Some(picture) = found.and_then(|(_, picture)| picture.as_ref()) {
            state.pictures.paint(ui, picture, rect.shrink(6.0));
        }
        ui.vertical(|ui| {
            ui.label(RichText::new(&work.design.name).strong());
            ui.add(Label::new(dialogs::left_behind(work)).wrap());
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                if primary(ui, true, t("Recover"), 100.0).clicked() {
                    actions.push(Action::Overlay(None));
                    actions.push(Action::File(FileAction::Recover));
                }
                if ui.button(t("Discard it")).clicked() {
                    actions.push(Action::File(FileAction::DiscardWork));
                }
            });
        });
    });
}

fn examples(ui: &mut Ui, state: &mut State, shots: Option<&Shots>, actions: &mut Actions) {
    ui.add_space(6.0);
    heading(ui, t("Examples"));
    ui.horizontal_wrapped(|ui| {
        for (index, example) in bundled::ALL.iter().enumerate() {
            let picture = shots.and_then(|shots| shots.examples.get(index)?.as_ref());
            if card(ui, state, picture, example.name, &tf!("Open example {name}", name = example.name)) {
                actions.push(Action::Overlay(None));
                actions.push(Action::File(FileAction::OpenExample(index)));
            }
        }
    });
}

fn recent(ui: &mut Ui, session: &Session, state: &mut State, shots: Option<&Shots>, actions: &mut Actions) {
    if session.recent().is_empty() {
        return;
    }
    ui.add_space(6.0);
    heading(ui, t("Recent"));
    ui.horizontal_wrapped(|ui| {
        for path in session.recent().iter().take(RECENT) {
            let found = shots.and_then(|shots| shots.recent.iter().find(|(of, _)| of == path));
            let picture = found.and_then(|(_, picture)| picture.as_ref());
            let name = shown(path.file_stem().map_or(path, Path::new));
            if card(ui, state, picture, &name, &tf!("Open {path}", path = shown(path))) {
                actions.push(Action::Overlay(None));
                actions.push(Action::File(FileAction::OpenPath(path.clone())));
            }
        }
    });
}

/// A picture with a name below; whether it was pressed.
fn card(ui: &mut Ui, state: &mut State, picture: Option<&Arc<Preview>>, name: &str, tip: &str) -> bool {
    let (rect, response) = ui.allocate_exact_size(CARD.into(), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, tip));
    let visuals = ui.visuals();
    let on = response.hovered() || response.has_focus();
    let stroke = if on { visuals.widgets.hovered.bg_stroke } else { visuals.widgets.noninteractive.bg_stroke };
    let color = if on { visuals.strong_text_color() } else { visuals.text_color() };
    ui.painter().rect_stroke(rect, 8.0, Stroke::new(1.0, stroke.color), StrokeKind::Inside);
    let below = rect.center_bottom() - vec2(0.0, 8.0);
    ui.painter().text(below, Align2::CENTER_BOTTOM, name, FontId::proportional(13.0), color);
    if let Some(picture) = picture {
        let place = Rect::from_min_max(rect.min + vec2(6.0, 6.0), rect.max - vec2(6.0, 28.0));
        state.pictures.paint(ui, picture, place);
    }
    response.on_hover_text(tip).clicked()
}

/// The pictures that are there; where others are wanted, they are begun.
fn follow<'s>(session: &'s Session, state: &mut State, actions: &mut Actions) -> Option<&'s Shots> {
    let (theme, recent) = (session.look().theme, session.recent());
    let offered = session.offered().map(|work| work.folder().to_owned());
    let begun =
        state.asked.as_ref().is_some_and(|(of, files, work)| *of == theme && files == recent && *work == offered);
    if !begun {
        state.asked = Some((theme, recent.to_vec(), offered));
        let recent: Vec<PathBuf> = recent.iter().take(RECENT).cloned().collect();
        let left = session.offered().map(|work| (work.folder().to_owned(), Design::clone(&work.design)));
        let work =
            Arc::new(move |cancel: &AtomicBool| -> Told { Arc::new(drawn(theme, left.clone(), &recent, cancel)) });
        actions.push(Action::Start(Task { owner: OWNER, name: mark("Pictures of designs"), work }));
    }
    session.tasks().told::<Shots>(OWNER).filter(|shots| shots.theme == theme)
}

fn drawn(theme: Theme, left: Option<(PathBuf, Design)>, recent: &[PathBuf], cancel: &AtomicBool) -> Shots {
    let picture = |design: Option<Design>| {
        let design = Arc::new(design.filter(|_| !cancel.load(Ordering::Relaxed))?);
        let rest = Arc::new(Shape { nodes: design.mesh.nodes.clone(), ..Shape::default() });
        portrait(&design, &rest, None, &[], theme, SIZE).ok().map(Arc::new)
    };
    let examples = bundled::ALL.iter().map(|example| picture(example.design().ok())).collect();
    let recent = recent.iter().map(|path| (path.clone(), picture(file::read(path).ok()))).collect();
    let work = left.map(|(folder, design)| (folder, picture(Some(design))));
    Shots { theme, work, examples, recent }
}
