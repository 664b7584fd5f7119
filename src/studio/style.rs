//! How the window looks: warm paper by day, warm charcoal by night.
//!
//! Panels have no fill of their own; the window is cleared to the background colour instead. A software rasteriser pays
//! for every layer of every pixel, and the large ones are saved that way.

use crate::numbers;
use crate::picture::Color;
use crate::picture::palette::{Palette, Theme, mix};
use eframe::egui::style::{NumberFormatter, Selection, WidgetVisuals};
use eframe::egui::{
    self, Color32, CornerRadius, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, Visuals, emath, vec2,
};

/// Radius of the corners of buttons and fields, logical pixels: from 5 on egui takes twice as many triangles to round a corner (106 a button, not 58),
/// and in software they are much of what a frame takes.
pub const CORNER: u8 = 4;

/// The colour of the tool itself: primary buttons, selection, playhead.
pub fn accent(theme: Theme) -> Color32 {
    match theme {
        Theme::Light => Color32::from_rgb(14, 116, 122),
        Theme::Dark => Color32::from_rgb(72, 190, 190),
    }
}

/// What is softened: the warm counterpart of [`accent`].
pub fn soft(theme: Theme) -> Color32 {
    match theme {
        Theme::Light => Color32::from_rgb(196, 108, 20),
        Theme::Dark => Color32::from_rgb(246, 178, 84),
    }
}

/// Text on [`accent`].
pub fn on_accent(theme: Theme) -> Color32 {
    match theme {
        Theme::Light => Color32::WHITE,
        Theme::Dark => Color32::from_rgb(10, 28, 28),
    }
}

pub fn color32(c: Color) -> Color32 {
    Color32::from_rgba_unmultiplied(c.0, c.1, c.2, c.3)
}

/// The theme that egui is in.
pub fn theme_of(visuals: &Visuals) -> Theme {
    if visuals.dark_mode { Theme::Dark } else { Theme::Light }
}

/// Sets fonts, spacing and both themes up; to be called once.
pub fn install(ctx: &egui::Context) {
    ctx.set_visuals_of(egui::Theme::Light, visuals(Theme::Light));
    ctx.set_visuals_of(egui::Theme::Dark, visuals(Theme::Dark));
    ctx.all_styles_mut(|style| {
        style.text_styles = [
            (TextStyle::Heading, 15.0, FontFamily::Proportional),
            (TextStyle::Body, 13.0, FontFamily::Proportional),
            (TextStyle::Button, 13.0, FontFamily::Proportional),
            (TextStyle::Small, 11.0, FontFamily::Proportional),
            (TextStyle::Monospace, 12.0, FontFamily::Monospace),
        ]
        .map(|(style, size, family)| (style, FontId::new(size, family)))
        .into();
        style.spacing.item_spacing = vec2(6.0, 6.0);
        style.spacing.button_padding = vec2(9.0, 4.0);
        style.spacing.interact_size = vec2(36.0, 24.0);
        style.spacing.window_margin = Margin::same(16);
        style.spacing.menu_margin = Margin::same(6);
        style.spacing.slider_width = 110.0;
        // Room for the scroll bar beside what is scrolled.
        style.spacing.scroll.floating_allocated_width = 6.0;
        style.number_formatter = NumberFormatter::new(|value, decimals| {
            numbers::unsigned_zero(emath::format_with_decimals_in_range(value, decimals))
        });
        style.interaction.selectable_labels = false;
        style.interaction.tooltip_delay = 0.4;
    });
}

pub fn set_theme(ctx: &egui::Context, theme: Theme) {
    ctx.set_theme(match theme {
        Theme::Light => egui::Theme::Light,
        Theme::Dark => egui::Theme::Dark,
    });
}

fn visuals(theme: Theme) -> Visuals {
    let palette = Palette::of(theme);
    let (mut v, ink) = match theme {
        Theme::Light => (Visuals::light(), Color(58, 46, 36, 255)),
        Theme::Dark => (Visuals::dark(), Color(236, 228, 218, 255)),
    };
    // Everything grey is a mix of paper and ink.
    let tone = |t: f32| color32(mix(palette.background, ink, t));
    let widget = |fill: f32, border: f32, text: f32| WidgetVisuals {
        weak_bg_fill: tone(fill),
        bg_fill: tone(fill + 0.04),
        bg_stroke: if border > 0.0 { Stroke::new(1.0, tone(border)) } else { Stroke::NONE },
        fg_stroke: Stroke::new(1.2, tone(text)),
        corner_radius: CornerRadius::same(CORNER),
        expansion: 0.0,
    };
    v.widgets.noninteractive = widget(0.0, 0.14, 0.82);
    v.widgets.inactive = widget(0.075, 0.0, 0.9);
    v.widgets.hovered = widget(0.13, 0.22, 1.0);
    v.widgets.active = widget(0.2, 0.3, 1.0);
    v.widgets.open = widget(0.12, 0.2, 1.0);
    let accent = accent(theme);
    let tint = Color(accent.r(), accent.g(), accent.b(), 255);
    v.selection = Selection {
        bg_fill: color32(mix(palette.background, tint, if theme == Theme::Light { 0.2 } else { 0.34 })),
        stroke: Stroke::new(1.2, color32(mix(tint, ink, 0.45))),
    };
    v.hyperlink_color = accent;
    v.text_cursor.stroke.color = accent;
    // A caret that blinks draws the whole window twice a second: a fifth of a core where that is done in software.
    v.text_cursor.blink = false;
    // A field is seen before anything stands in it.
    v.text_edit_bg_color = (theme == Theme::Light).then(|| tone(0.05));
    // Five to one against the paper, small as such text often is.
    v.weak_text_color = Some(tone(0.68));
    v.panel_fill = Color32::TRANSPARENT;
    v.faint_bg_color = tone(0.035);
    v.extreme_bg_color = if theme == Theme::Light { Color32::WHITE } else { color32(Color(20, 19, 18, 255)) };
    v.window_fill =
        color32(mix(palette.background, Color(255, 255, 255, 255), if theme == Theme::Light { 0.6 } else { 0.05 }));
    v.window_stroke = Stroke::new(1.0, tone(0.16));
    v.window_corner_radius = CornerRadius::same(10);
    v.menu_corner_radius = CornerRadius::same(8);
    v.warn_fg_color =
        if theme == Theme::Light { Color32::from_rgb(176, 92, 0) } else { Color32::from_rgb(246, 178, 84) };
    v.error_fg_color =
        if theme == Theme::Light { Color32::from_rgb(186, 28, 34) } else { Color32::from_rgb(255, 122, 112) };
    let shadow = Shadow { offset: [0, 4], blur: 16, spread: 0, color: Color32::from_black_alpha(40) };
    v.popup_shadow = shadow;
    v.window_shadow = shadow;
    v.slider_trailing_fill = true;
    v
}
