//! Which networks no hand can sew: judged on a thread of its own, once for each design that differs in what is sewn.

use crate::design::Design;
use crate::fabrication::judge_design;
use crate::motion::winch_labels;
use crate::sewing::{Breach, most_severe};
use crate::studio::action::{Action, Actions};
use crate::studio::icons::{self, Icon};
use crate::studio::jobs::Told;
use crate::studio::session::{Session, Task};
use eframe::egui::{Label, Rect, RichText, Role, Sense, Ui, Vec2, WidgetInfo, vec2};
use std::sync::Arc;

/// Breaches that a tip tells one by one.
const TOLD: usize = 8;
/// Height of a mark: that of a row of the list, logical pixels.
const ROW: f32 = 24.0;
const MARK: f32 = 15.0;

/// A design and the rules of sewing that it breaks.
struct Judged {
    design: Arc<Design>,
    breaches: Vec<Breach>,
}

/// Knows for which design the newest judgement holds.
#[derive(Default)]
pub struct Sewable {
    design: Option<Arc<Design>>,
}

impl Sewable {
    /// The breaches known of the design as it is now; asks for a judgement where the newest one is of another. `owner`: the panel.
    pub fn breaches<'a>(&mut self, owner: &'static str, session: &'a Session, actions: &mut Actions) -> &'a [Breach] {
        let design = session.design();
        let told = session.tasks().told::<Judged>(owner);
        let holds = told.is_some_and(|told| self.holds(told, design));
        if !holds && session.tasks().running(owner).is_none() {
            actions.push(Action::Start(task(owner, design.clone())));
        }
        // Until the new one is there the old one stands, unless it is of other networks.
        told.filter(|told| holds || told.design.networks == design.networks).map_or(&[], |told| &told.breaches)
    }

    /// Whether a judgement is of this design, or of one that is sewn alike.
    fn holds(&mut self, told: &Judged, design: &Arc<Design>) -> bool {
        if self.design.as_ref().is_some_and(|known| Arc::ptr_eq(known, design)) {
            return true;
        }
        let holds = Arc::ptr_eq(&told.design, design) || sewn_alike(&told.design, design);
        self.design = holds.then(|| design.clone());
        holds
    }
}

/// Whether two designs are equal in all that the judgement reads.
fn sewn_alike(a: &Design, b: &Design) -> bool {
    a.networks == b.networks
        && a.sewing == b.sewing
        && a.fabrication == b.fabrication
        && a.pins == b.pins
        && a.outline == b.outline
        && a.mesh == b.mesh
}

fn task(owner: &'static str, design: Arc<Design>) -> Task {
    let work = move |_: &_| Arc::new(Judged { design: design.clone(), breaches: judge_design(&design) }) as Told;
    Task { owner, name: "Judging what can be sewn", work: Arc::new(work) }
}

/// A sign beside a network that breaks rules, with all of them in its tip. Nothing where it keeps them.
pub fn mark(ui: &mut Ui, design: &Design, index: usize, breaches: &[Breach]) {
    let own: Vec<Breach> = breaches.iter().filter(|b| b.winches().any(|winch| winch == index)).copied().collect();
    if own.is_empty() {
        return;
    }
    let (rect, response) = ui.allocate_exact_size(vec2(MARK, ROW), Sense::hover());
    let label = format!("Network {} is hard to sew", design.networks[index].name);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &label));
    let square = Rect::from_center_size(rect.center(), Vec2::splat(MARK));
    ui.painter().extend(icons::draw(Icon::Warning, square, ui.visuals().warn_fg_color));
    // Asked for while the pointer is there alone.
    response.on_hover_ui(|ui| {
        ui.label(format!("Hard to sew:\n{}", lines(&own, &winch_labels(design))));
    });
}

/// A line above the list where it is the body that no winch fits into.
pub fn body(ui: &mut Ui, breaches: &[Breach]) {
    if let Some(thin) = breaches.iter().find(|b| b.winches().next().is_none()) {
        ui.add(Label::new(RichText::new(format!("Hard to sew: {thin}.")).color(ui.visuals().warn_fg_color)).wrap());
    }
}

/// The most severe breaches, a line each, and how many others there are.
fn lines(breaches: &[Breach], names: &[String]) -> String {
    let mut lines: Vec<String> = most_severe(breaches, TOLD).iter().map(|b| b.words(names).to_string()).collect();
    if breaches.len() > TOLD {
        lines.push(format!("and {} more", breaches.len() - TOLD));
    }
    lines.join("\n")
}
