//! The bar of a view that says what its colours stand for.

use crate::picture::ramp::Bar;
use crate::studio::canvas::Canvas;
use crate::studio::language::{t, tf};
use crate::studio::style;
use eframe::egui::{Align2, FontId, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

/// Length and height, distance from the corner, logical pixels.
const SIZE: [f32; 2] = [190.0, 9.0];
const INSET: f32 = 16.0;
/// Steps of colour.
const STEPS: usize = 48;

/// In the lower right corner, with its title above and figures below.
pub fn show(ui: &mut Ui, canvas: &Canvas<'_>, bar: &Bar) {
    let rect = canvas.rect;
    let length = SIZE[0].min(rect.width() - 2.0 * INSET);
    if length < 80.0 || rect.height() < 120.0 {
        return;
    }
    let left = rect.right() - INSET - length;
    let top = rect.bottom() - INSET - 12.0 - SIZE[1];
    let painter = ui.painter_at(rect);
    let all = Rect::from_min_max(pos2(left - 8.0, top - 20.0), pos2(rect.right() - 8.0, rect.bottom() - 8.0));
    painter.rect_filled(all, 6.0, ui.visuals().window_fill.gamma_multiply(0.82));
    let step = length / STEPS as f32;
    for k in 0..STEPS {
        let color = style::color32(bar.color_at((k as f64 + 0.5) / STEPS as f64));
        let part = Rect::from_min_size(pos2(left + k as f32 * step, top), vec2(step + 0.5, SIZE[1]));
        painter.rect_filled(part, 0.0, color);
    }
    let titled = Bar { title: t(bar.title), ..bar.clone() };
    let (ink, weak, font) = (ui.visuals().text_color(), ui.visuals().weak_text_color(), FontId::proportional(11.0));
    painter.text(pos2(left, top - 4.0), Align2::LEFT_BOTTOM, titled.words(), font.clone(), ink);
    let ends = [Align2::LEFT_TOP, Align2::CENTER_TOP, Align2::RIGHT_TOP];
    for ((place, words), align) in bar.ticks().into_iter().zip(ends) {
        painter.text(pos2(left + place as f32 * length, top + SIZE[1] + 2.0), align, words, font.clone(), weak);
    }
    let response = ui.interact(all, ui.scope_id().with(("bar", rect.min.x as i64, rect.min.y as i64)), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, range(bar)));
}

/// Its range in a sentence.
fn range(bar: &Bar) -> String {
    let ticks = bar.ticks();
    let [low, high] = [&ticks[0].1, &ticks[2].1];
    let unit = if bar.unit.is_empty() { String::new() } else { format!(" {}", bar.unit) };
    tf!("{title} from {low} to {high}{unit}", title = t(bar.title), low, high, unit)
}
