//! Pictures that panels show: each becomes a texture once, and is let go when it is shown no more.

use crate::picture::preview::Preview;
use eframe::egui::{ColorImage, Context, Rect, TextureHandle, TextureOptions, Ui, Vec2, pos2, vec2};
use std::sync::Arc;

/// Textures of a panel's pictures.
#[derive(Default)]
pub struct Pictures {
    made: Vec<Made>,
}

struct Made {
    /// Kept alive, so that equal addresses mean equal things.
    of: Arc<Preview>,
    texture: TextureHandle,
    shown: bool,
}

impl Pictures {
    /// Once a frame, before any is shown: those that were not shown in the last one are let go.
    pub fn begin(&mut self) {
        self.made.retain_mut(|made| std::mem::take(&mut made.shown));
    }

    /// Draws a picture into a rectangle, as large as it fits.
    pub fn paint(&mut self, ui: &Ui, picture: &Arc<Preview>, rect: Rect) {
        let texture = self.texture(ui.ctx(), picture).id();
        let place = fitted(vec2(picture.width as f32, picture.height as f32), rect);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture, place, whole, eframe::egui::Color32::WHITE);
    }

    fn texture(&mut self, ctx: &Context, picture: &Arc<Preview>) -> TextureHandle {
        if let Some(made) = self.made.iter_mut().find(|made| Arc::ptr_eq(&made.of, picture)) {
            made.shown = true;
            return made.texture.clone();
        }
        let size = [picture.width as usize, picture.height as usize];
        let image = ColorImage::from_rgba_unmultiplied(size, &picture.pixels);
        let texture = ctx.load_texture("picture", image, TextureOptions::LINEAR);
        self.made.push(Made { of: picture.clone(), texture: texture.clone(), shown: true });
        texture
    }
}

/// A size as large as it fits into the middle of a rectangle.
fn fitted(size: Vec2, rect: Rect) -> Rect {
    let scale = (rect.width() / size.x.max(1.0)).min(rect.height() / size.y.max(1.0));
    Rect::from_center_size(rect.center(), size * scale)
}
