//! Candidates as cards with pictures. The one under the pointer is shown in the views, where it strikes every pose in turn.

use super::proposal::{self, Struck};
use crate::design::{Design, edit};
use crate::engine::{Setpoint, Shape, solve_once};
use crate::picture::palette::Theme;
use crate::picture::portrait;
use crate::picture::preview::Preview;
use crate::rigging::Proposal;
use crate::studio::action::{Action, Actions};
use crate::studio::jobs::Told;
use crate::studio::language::{mark, t};
use crate::studio::pictures::Pictures;
use crate::studio::session::{Order, Session, Task};
use eframe::egui::{ComboBox, RichText, ScrollArea, Ui};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Pictures of cards, and what is known of the poses of one.
#[derive(Default)]
pub struct Gallery {
    pictures: Pictures,
    asked_cards: Option<(Vec<Arc<Proposal>>, Theme)>,
    asked_poses: Option<(Arc<Proposal>, Theme)>,
}

/// A picture of every proposal on a list.
struct Cards {
    of: Vec<Arc<Proposal>>,
    theme: Theme,
    /// None of one that cannot be drawn.
    pictures: Vec<Option<Arc<Preview>>>,
}

/// One proposal in every pose.
struct Poses {
    of: Arc<Proposal>,
    theme: Theme,
    struck: Vec<Struck>,
}

const CARDS: &str = "gallery.cards";
const POSES: &str = "gallery.poses";
/// Height of the list: at least, logical pixels, and at most as a part of the window where that is more.
const HEIGHT: f32 = 200.0;
const PART: f32 = 0.28;
/// Room for the buttons below it, logical pixels, so that they stay in sight.
const DECISION: f32 = 46.0;
/// Pictures, pixels: sharp at twice the size at which they are shown.
const SIZE: (u32, u32) = (224, 168);
/// How long a pose is held while all are struck, s.
const HELD_S: f64 = 0.8;
const ORDERS: [(Order, &str); 7] = [
    (Order::Found, mark("Best to make")),
    (Order::Error, mark("This pose")),
    (Order::Worst, mark("Worst pose")),
    (Order::Sewn, mark("Sewn by hand")),
    (Order::Force, mark("Least force")),
    (Order::Thread, mark("Least cable")),
    (Order::Holes, mark("Fewest holes")),
];

/// The cards.
pub fn show(ui: &mut Ui, session: &Session, gallery: &mut Gallery, actions: &mut Actions) {
    let discovery = session.discovery();
    order(ui, session, actions);
    gallery.pictures.begin();
    let theme = session.look().theme;
    let pictures = cards(session, gallery, theme, actions);
    let poses = discovery.displayed().and_then(|proposal| poses(session, gallery, proposal, theme, actions));
    let mut hovered = None;
    // So high that what is decided below them is seen without scrolling, where there is room.
    let above = ui.cursor().top() - ui.min_rect().top();
    let most = HEIGHT.max(PART * ui.ctx().content_rect().height());
    let height = (ui.clip_rect().height() - above - DECISION).clamp(HEIGHT, most);
    let rows = ScrollArea::vertical().id_salt("proposals").max_height(height).auto_shrink([false, true]);
    rows.show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 4.0;
        ui.add_enabled_ui(!discovery.is_stale(), |ui| {
            for index in discovery.sorted() {
                let found = &discovery.proposals[index];
                let of = pictures.and_then(|cards| cards.of.iter().position(|of| Arc::ptr_eq(of, found)));
                let picture = pictures.zip(of).and_then(|(cards, at)| cards.pictures.get(at)?.as_ref());
                let strip = poses.filter(|poses| Arc::ptr_eq(&poses.of, found)).map(|poses| poses.struck.as_slice());
                let paint = (&mut gallery.pictures, picture, strip.unwrap_or(&[]));
                if proposal::card(ui, session, index, found, paint, actions) {
                    hovered = Some(index);
                }
            }
        });
    });
    hover(ui, session, hovered.filter(|_| !discovery.is_stale()), poses, actions);
}

/// What the list is sorted by.
fn order(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut order = session.discovery().order;
    ui.horizontal(|ui| {
        let label = ui.label(RichText::new(t("Sorted by")).weak());
        let name = ORDERS.iter().find(|(of, _)| *of == order).map_or("", |(_, name)| t(name));
        let combo = ComboBox::from_id_salt("order of proposals").selected_text(name).show_ui(ui, |ui| {
            for (choice, name) in ORDERS {
                ui.selectable_value(&mut order, choice, t(name));
            }
        });
        combo.response.labelled_by(label.id);
    });
    if order != session.discovery().order {
        actions.push(Action::SortProposals(order));
    }
}

/// Shows what is under the pointer, in one pose after the other where they are known.
fn hover(ui: &Ui, session: &Session, hovered: Option<usize>, poses: Option<&Poses>, actions: &mut Actions) {
    let before = &session.discovery().hovered;
    let Some(index) = hovered else {
        if before.is_some() {
            actions.push(Action::HoverProposal(None));
        }
        return;
    };
    let found = session.discovery().proposals.get(index);
    let of = poses.filter(|poses| found.is_some_and(|found| Arc::ptr_eq(&poses.of, found)));
    let turns = of.filter(|poses| poses.struck.len() > 1 && !session.look().still);
    let shape = turns.map(|poses| {
        ui.ctx().request_repaint_after(Duration::from_secs_f64(0.25 * HELD_S));
        let turn = (ui.input(|i| i.time) / HELD_S) as usize % poses.struck.len();
        poses.struck[turn].shape.clone()
    });
    let same = |a: &Option<Arc<Shape>>, b: &Option<Arc<Shape>>| match (a, b) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        (None, None) => true,
        _ => false,
    };
    if !before.as_ref().is_some_and(|(known, struck)| *known == index && same(struck, &shape)) {
        actions.push(Action::HoverProposal(Some((index, shape))));
    }
}

/// The pictures of the list, as far as they are made; others are begun.
fn cards<'s>(session: &'s Session, gallery: &mut Gallery, theme: Theme, actions: &mut Actions) -> Option<&'s Cards> {
    let list = &session.discovery().proposals;
    let known = session.tasks().told::<Cards>(CARDS).filter(|cards| cards.theme == theme);
    let alike = |of: &[Arc<Proposal>]| of.len() == list.len() && of.iter().zip(list).all(|(a, b)| Arc::ptr_eq(a, b));
    let begun = gallery.asked_cards.as_ref().is_some_and(|(of, of_theme)| alike(of) && *of_theme == theme);
    if !known.is_some_and(|cards| alike(&cards.of)) && !begun && !list.is_empty() {
        gallery.asked_cards = Some((list.clone(), theme));
        let (of, design) = (list.clone(), session.design().clone());
        let work = Arc::new(move |cancel: &AtomicBool| -> Told {
            let drawn = |proposal: &Arc<Proposal>| picture(&design, &proposal.preview, proposal, theme);
            let go_on = |_: &&Arc<Proposal>| !cancel.load(Ordering::Relaxed);
            let pictures = of.iter().take_while(go_on).map(drawn).collect();
            Arc::new(Cards { of: of.clone(), theme, pictures })
        });
        actions.push(Action::Start(Task { owner: CARDS, name: mark("Pictures of proposals"), work }));
    }
    known
}

/// A proposal in every pose, as far as that is known; otherwise it is begun.
fn poses<'s>(
    session: &'s Session,
    gallery: &mut Gallery,
    proposal: &Arc<Proposal>,
    theme: Theme,
    actions: &mut Actions,
) -> Option<&'s Poses> {
    let known = session.tasks().told::<Poses>(POSES);
    let known = known.filter(|poses| Arc::ptr_eq(&poses.of, proposal) && poses.theme == theme);
    let begun =
        gallery.asked_poses.as_ref().is_some_and(|(of, of_theme)| Arc::ptr_eq(of, proposal) && *of_theme == theme);
    // While networks are looked for all processors are busy with that.
    let idle = session.discovery().running.is_none();
    if known.is_none() && !begun && idle && session.design().poses.len() > 1 {
        gallery.asked_poses = Some((proposal.clone(), theme));
        let (of, design) = (proposal.clone(), session.design().clone());
        let work = Arc::new(move |cancel: &AtomicBool| -> Told {
            Arc::new(Poses { of: of.clone(), theme, struck: struck(&design, &of, theme, cancel) })
        });
        actions.push(Action::Start(Task { owner: POSES, name: mark("A proposal in every pose"), work }));
    }
    known
}

/// Winds a design with a proposal to all its poses.
fn struck(design: &Arc<Design>, proposal: &Arc<Proposal>, theme: Theme, cancel: &AtomicBool) -> Vec<Struck> {
    let mut with = Design::clone(design);
    if edit::accept_network(&mut with, proposal.network.clone()).is_err() {
        return Vec::new();
    }
    let with = Arc::new(with);
    let mut struck = Vec::new();
    for pose in with.poses.iter().filter(|pose| !pose.targets.is_empty()) {
        if cancel.load(Ordering::Relaxed) {
            break;
        }
        let setpoint = Setpoint::Targets(pose.targets.clone());
        let Some(shape) = solve_once(&with, setpoint, [false, true], cancel).realizable.map(Arc::new) else { continue };
        if let Some(picture) = picture(design, &shape, proposal, theme) {
            struck.push(Struck { name: pose.name.clone(), picture, shape });
        }
    }
    struck
}

fn picture(design: &Arc<Design>, shape: &Arc<Shape>, proposal: &Proposal, theme: Theme) -> Option<Arc<Preview>> {
    portrait(design, shape, Some(&proposal.network), &[], theme, SIZE).ok().map(Arc::new)
}
