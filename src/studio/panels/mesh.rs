//! The mesh: how good it is, and another resolution for it.

use super::buttons;
use super::panel::{Entry, Panel};
use super::widgets::heading;
use crate::design::{CopyOnWrite, MeshFigures};
use crate::mesh::quality::{HISTOGRAM_BARS, HISTOGRAM_STEP_DEG, MeshQuality};
use crate::mesh::{MAX_FIBERS, Mesh};
use crate::studio::action::{Action, Actions};
use crate::studio::commands::document::REMESH;
use crate::studio::language::{t, tf};
use crate::studio::session::FINEST;
use crate::studio::session::Session;
use crate::studio::style;
use eframe::egui::{
    Align2, DragValue, FontId, Grid, Rect, RichText, Role, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2,
};

/// Below this angle a triangle is poor, degrees.
const POOR_DEG: f64 = 20.0;
/// As wide as the longest name, so that all values stand in one column, logical pixels.
const NAME_WIDTH: f32 = 116.0;
/// Size of the histogram, logical pixels.
const HISTOGRAM_HEIGHT: f32 = 84.0;
const LEGEND_HEIGHT: f32 = 16.0;

pub static ENTRY: Entry = Entry {
    id: "panel.mesh",
    label: "Mesh",
    tip: "How good the mesh is, and another resolution for it",
    make: || Box::new(State::default()),
};

/// The figures, worked out once a mesh.
#[derive(Default)]
struct State {
    figures: Option<(CopyOnWrite<Mesh>, MeshFigures)>,
}

impl Panel for State {
    fn show(&mut self, ui: &mut Ui, session: &Session, actions: &mut Actions) {
        show(ui, session, self, actions);
    }
}

fn show(ui: &mut Ui, session: &Session, state: &mut State, actions: &mut Actions) {
    let design = session.design();
    let known = state.figures.as_ref().is_some_and(|(mesh, _)| *mesh == design.mesh);
    if !known {
        state.figures = Some((design.mesh.clone(), MeshFigures::of(design)));
    }
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        heading(ui, t("Resolution"));
        resolution(ui, session, actions);
        ui.add_space(10.0);
        let Some((_, figures)) = &state.figures else { return };
        heading(ui, t("Smallest angles of the triangles"));
        histogram(ui, &figures.quality);
        ui.add_space(10.0);
        heading(ui, t("Mesh"));
        Grid::new("mesh figures").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
            for (name, tip, value) in rows(figures) {
                ui.label(RichText::new(name).weak()).on_hover_text(tip);
                ui.label(value).on_hover_text(tip);
                ui.end_row();
            }
        });
    });
}

fn resolution(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let before = session.resolution();
    let mut wanted = before;
    Grid::new("resolution").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        for (name, tip, value, range) in [
            (
                t("Muscle fibres"),
                t("How many edges the mesh of the fibres shall have"),
                &mut wanted.fibers,
                3..=MAX_FIBERS,
            ),
            (
                t("Finer body"),
                t("Simulate on a mesh this many times finer than the fibres' own"),
                &mut wanted.finer,
                1..=FINEST,
            ),
        ] {
            let label = ui.label(name).on_hover_text(tip);
            let speed = (*value as f64 * 0.01).max(0.05);
            let drag = DragValue::new(value).range(range).speed(speed);
            ui.add_sized([130.0, 24.0], drag).labelled_by(label.id).on_hover_text(tip);
            ui.end_row();
        }
    });
    if wanted != before {
        actions.push(Action::SetResolution(wanted));
    }
    ui.add_space(2.0);
    match session.meshing().running {
        None => {
            let width = ui.available_width();
            buttons::primary(ui, session, &REMESH, true, width, actions);
        }
        Some(_) => buttons::meshing(ui, session, actions),
    }
}

/// Bars of triangles by their smallest angle, 0 to 60 degrees.
fn histogram(ui: &mut Ui, quality: &MeshQuality) {
    let size = vec2(ui.available_width(), HISTOGRAM_HEIGHT + LEGEND_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let text = tf!("Histogram of smallest angles, least {degrees:.1} degrees", degrees = quality.min_angle_deg);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &text));
    let bars = Rect::from_min_size(rect.min, vec2(rect.width(), HISTOGRAM_HEIGHT));
    let width = bars.width() / HISTOGRAM_BARS as f32;
    let most = quality.histogram.iter().copied().max().unwrap_or(0).max(1) as f32;
    let theme = style::theme_of(ui.visuals());
    let (good, poor) = (style::accent(theme), ui.visuals().warn_fg_color);
    let weak = ui.visuals().weak_text_color();
    let painter = ui.painter();
    for (k, &count) in quality.histogram.iter().enumerate() {
        let left = bars.left() + k as f32 * width;
        // One triangle among thousands can still be seen.
        let height = if count == 0 { 0.0 } else { (count as f32 / most * bars.height()).max(1.5) };
        let bar = Rect::from_min_max(pos2(left + 1.0, bars.bottom() - height), pos2(left + width - 1.0, bars.bottom()));
        let color = if (k as f64) * HISTOGRAM_STEP_DEG < POOR_DEG { poor } else { good };
        painter.rect_filled(bar, 1.0, color);
    }
    painter.hline(bars.x_range(), bars.bottom(), (1.0, weak));
    for k in (0..=HISTOGRAM_BARS).step_by(4) {
        let align = match k {
            0 => Align2::LEFT_TOP,
            HISTOGRAM_BARS => Align2::RIGHT_TOP,
            _ => Align2::CENTER_TOP,
        };
        let at = pos2(bars.left() + k as f32 * width, bars.bottom() + 2.0);
        painter.text(at, align, format!("{}°", k as f64 * HISTOGRAM_STEP_DEG), FontId::proportional(11.0), weak);
    }
    if let Some(pointer) = response.hover_pos() {
        let k = (((pointer.x - bars.left()) / width) as usize).min(HISTOGRAM_BARS - 1);
        let from = k as f64 * HISTOGRAM_STEP_DEG;
        response.on_hover_text(tf!(
            "{count} triangles from {from:.0} to {to:.0} degrees",
            count = quality.histogram[k],
            from,
            to = from + HISTOGRAM_STEP_DEG
        ));
    }
}

/// Every figure with its name and what it means, short enough for the panel.
fn rows(figures: &MeshFigures) -> [(&'static str, &'static str, String); 9] {
    let MeshFigures { quality: q, fit, .. } = figures;
    let percent = 100.0 * q.below_20_deg as f64 / q.triangles.max(1) as f64;
    let symmetric = match (figures.symmetric_outline, figures.symmetric_mesh) {
        (true, true) => t("outline and mesh"),
        (true, false) => t("outline only"),
        (false, _) => t("no"),
    };
    let boundary = format!("{:.2} mm, {:.2} %", fit.boundary_mm, 100.0 * fit.boundary_fraction);
    [
        (t("Nodes"), t("Corners of the triangles"), q.nodes.to_string()),
        (t("Triangles"), t("Of the body that is simulated"), q.triangles.to_string()),
        (
            t("Smallest angle"),
            t("Of any triangle"),
            tf!("{least:.1}°, mean {mean:.1}°", least = q.min_angle_deg, mean = q.mean_min_angle_deg),
        ),
        (t("Below 20°"), t("Triangles with an angle that sharp"), format!("{}, {percent:.2} %", q.below_20_deg)),
        (
            t("Edges"),
            t("Shortest and longest"),
            tf!("{shortest:.1} to {longest:.1} mm", shortest = q.min_edge, longest = q.max_edge),
        ),
        (t("One triangle across"), t("Places where the body is too stiff, one triangle thick"), q.bridges.to_string()),
        (t("Area off"), t("From that of the outline"), format!("{:+.2} %", 100.0 * fit.area_error)),
        (t("Boundary off"), t("Farthest from the outline, and as a part of its height"), boundary),
        (t("Symmetric"), t("Whether it is its own mirror image"), symmetric.to_owned()),
    ]
}
