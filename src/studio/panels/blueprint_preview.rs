//! The blueprint before it is written: its sheets as they will be cut, what the motors are told, and remarks.

use super::widgets::scroll;
use crate::design::Design;
use crate::fabrication::{Remark, Watch, blueprint_watched};
use crate::operations::export;
use crate::picture::preview::Preview;
use crate::picture::sheet;
use crate::studio::action::{Action, Actions, FileAction};
use crate::studio::jobs::Told;
use crate::studio::language::{mark, t, tf};
use crate::studio::pictures::Pictures;
use crate::studio::session::{Done, Session, Task};
use crate::studio::words;
use eframe::egui::{Button, Label, RichText, Role, ScrollArea, Sense, Spinner, Ui, WidgetInfo, vec2};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Which page is shown, and what was asked for.
#[derive(Default)]
pub struct State {
    pictures: Pictures,
    page: usize,
    /// How far it is.
    done: Done,
    asked: Option<(Arc<Design>, export::Options)>,
}

/// A blueprint in memory.
struct Made {
    of: Arc<Design>,
    options: export::Options,
    pages: Result<Vec<Page>, String>,
    remarks: Vec<Remark>,
}

/// A file of it, as it is shown.
struct Page {
    name: String,
    content: Content,
}

enum Content {
    Sheet(Arc<Preview>),
    /// The first lines.
    Text(String),
}

const OWNER: &str = "blueprint.preview";
/// The longer side of a sheet, pixels, and the height of what is shown, logical pixels.
const LONGEST: u32 = 900;
const HEIGHT: f32 = 250.0;
/// Height of the remarks, logical pixels: others are scrolled to.
const REMARKS: f32 = 120.0;
/// What the button beside a remark does.
const SHOW: &str = mark("Close this, and look at the place on the body");
/// Lines of a table or a program that are shown, and files of each kind.
const LINES: usize = 40;
const FILES: usize = 24;

/// The preview, or the button that makes it.
pub fn show(ui: &mut Ui, session: &Session, options: &export::Options, state: &mut State, actions: &mut Actions) {
    let design = session.design();
    let is = |of: &Arc<Design>, asked: &export::Options| Arc::ptr_eq(of, design) && asked == options;
    let made = session.tasks().told::<Made>(OWNER).filter(|made| is(&made.of, &made.options));
    state.pictures.begin();
    if let Some(made) = made {
        return pages(ui, made, state, actions);
    }
    let running = session.tasks().running(OWNER).is_some();
    if running && state.asked.as_ref().is_some_and(|(of, asked)| is(of, asked)) {
        ui.horizontal(|ui| {
            ui.add(Spinner::new());
            let at = state
                .done
                .get()
                .map_or_else(String::new, |[done, of]| tf!(", part {number} of {of}", number = done + 1, of));
            ui.label(tf!("Making the preview{at}", at));
            if ui.button(t("Cancel preview")).on_hover_text(t("Stop making it")).clicked() {
                state.asked = None;
                actions.push(Action::Stop(OWNER));
            }
        });
    } else if ui.button(t("Preview")).on_hover_text(t("Sheets as they will be cut, motor files and remarks")).clicked()
    {
        state.page = 0;
        (state.asked, state.done) = (Some((design.clone(), options.clone())), Done::default());
        let (of, options, done, wake) = (design.clone(), options.clone(), state.done.clone(), session.jobs.wake());
        let work = Arc::new(move |cancel: &AtomicBool| -> Told {
            let mut watch = |now: usize, of: usize| {
                done.say(now, of);
                wake();
                !cancel.load(Ordering::Relaxed)
            };
            Arc::new(made_of(&of, &options, cancel, &mut watch))
        });
        actions.push(Action::Start(Task { owner: OWNER, name: mark("The preview of the blueprint"), work }));
    }
}

fn pages(ui: &mut Ui, made: &Made, state: &mut State, actions: &mut Actions) {
    let pages = match &made.pages {
        Ok(pages) => pages,
        Err(why) => {
            ui.label(RichText::new(why).color(ui.visuals().error_fg_color));
            return;
        }
    };
    let last = pages.len().saturating_sub(1);
    state.page = state.page.min(last);
    ui.horizontal(|ui| {
        if ui.add_enabled(state.page > 0, Button::new(t("Back"))).clicked() {
            state.page -= 1;
        }
        if ui.add_enabled(state.page < last, Button::new(t("Next page"))).clicked() {
            state.page += 1;
        }
        let name = pages.get(state.page).map_or("", |page| &page.name);
        ui.label(tf!("{page} of {pages}: {name}", page = state.page + 1, pages = pages.len(), name));
    });
    let size = vec2(ui.available_width(), HEIGHT);
    match pages.get(state.page).map(|page| &page.content) {
        Some(Content::Sheet(picture)) => {
            let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
            response.widget_info(|| WidgetInfo::labeled(Role::Image, true, t("Sheet")));
            state.pictures.paint(ui, picture, rect);
        }
        Some(Content::Text(text)) => {
            ScrollArea::both().id_salt("file of the blueprint").max_height(HEIGHT).show(ui, |ui| {
                ui.set_min_height(HEIGHT);
                ui.add(Label::new(RichText::new(text).monospace().small()).extend());
            });
        }
        None => {}
    }
    remarks(ui, made, actions);
}

/// What its maker should know; what is somewhere on the body can be shown there.
fn remarks(ui: &mut Ui, made: &Made, actions: &mut Actions) {
    scroll(REMARKS).id_salt("remarks of the blueprint").show(ui, |ui| {
        for remark in &made.remarks {
            ui.horizontal_top(|ui| {
                let words = RichText::new(&remark.text).small();
                if !remark.places.is_empty() && ui.small_button(t("Show me")).on_hover_text(t(SHOW)).clicked() {
                    actions.push(Action::File(FileAction::CloseDialog));
                    actions.push(Action::ShowPlaces(remark.places.clone()));
                }
                ui.add(Label::new(words).wrap());
            });
        }
    });
}

fn made_of(design: &Arc<Design>, options: &export::Options, cancel: &AtomicBool, watch: Watch<'_>) -> Made {
    let (pages, remarks) = match blueprint_watched(design, options, watch) {
        Err(error) => (Err(words::unexported(&error)), Vec::new()),
        Ok((files, manifest)) => {
            let has = |name: &str, endings: &[&str]| endings.iter().any(|ending| name.ends_with(ending));
            let sheets = files.iter().filter(|file| has(&file.name, &[".svg"])).take(FILES);
            let sheets = sheets.take_while(|_| !cancel.load(Ordering::Relaxed));
            let drawn = sheets.filter_map(|file| {
                let picture = sheet(&file.bytes, LONGEST).ok()?;
                Some(Page { name: file.name.clone(), content: Content::Sheet(Arc::new(picture)) })
            });
            let texts = files.iter().filter(|file| has(&file.name, &[".csv", ".txt", ".ino", ".py"])).take(FILES);
            let told = texts.map(|file| {
                let text = String::from_utf8_lossy(&file.bytes);
                let text = text.lines().take(LINES).collect::<Vec<_>>().join("\n");
                Page { name: file.name.clone(), content: Content::Text(text) }
            });
            (Ok(drawn.chain(told).collect()), manifest.remarks)
        }
    };
    Made { of: design.clone(), options: options.clone(), pages, remarks }
}
