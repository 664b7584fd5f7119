//! Scenes to PNG, without a graphics adapter.

use super::color::Color;
use super::palette::Palette;
use super::pixels::Preview;
use super::plush::{self, Felt};
use super::ramp::Bar;
use super::scene::{Item, Scene};
use super::{letters, textured};
use crate::files::marked_png;
use crate::outline::Point;
use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, PixmapMut, Rect, Stroke, StrokeDash, Transform,
};

/// Empty border around each view, as a fraction of the picture's smaller side.
const MARGIN: f64 = 0.06;
/// Height of the picture at which a logical pixel (line widths, disc radii) is one pixel; others scale along, so that
/// a picture looks the same at every size.
const REFERENCE_HEIGHT: f64 = 720.0;
/// Height of what is kept free for a bar, its length and height, and that of its letters, logical pixels.
const BAR_ROOM: f64 = 66.0;
const BAR: [f32; 2] = [320.0, 12.0];
const LETTERS: f32 = 15.0;
const DIVIDER: Color = Color(0, 0, 0, 40);

/// A picture that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum RasterError {
    #[error("a picture of {0} x {1} pixels is empty or does not fit in memory")]
    Size(u32, u32),
    #[error("cannot encode the picture: {0}")]
    Encode(String),
}

/// Two views side by side as PNG, `size` in pixels. Both have the same scale and the same place in their half.
///
/// # Errors
/// A size that is empty or does not fit in memory, or a picture that cannot be encoded.
pub fn png(left: &Scene, right: &Scene, size: (u32, u32), background: Color) -> Result<Vec<u8>, RasterError> {
    png_with_bar(left, right, size, background, None)
}

/// [`png`] with a bar below that says what colours stand for.
///
/// # Errors
/// As [`png`].
pub fn png_with_bar(
    left: &Scene,
    right: &Scene,
    size: (u32, u32),
    background: Color,
    bar: Option<&Bar>,
) -> Result<Vec<u8>, RasterError> {
    let mut pixmap = Pixmap::new(size.0, size.1).ok_or(RasterError::Size(size.0, size.1))?;
    pixmap.fill(color(background));
    let half = f64::from(size.0) / 2.0;
    let bounds = Bounds::of([left, right]);
    let unit = f64::from(size.1) / REFERENCE_HEIGHT;
    let height = f64::from(size.1) - if bar.is_some() { BAR_ROOM * unit } else { 0.0 };
    for (scene, x0) in [(left, 0.0), (right, half)] {
        let view = View { unit: unit as f32, ..View::fit(&bounds, x0, half, height) };
        paint_scene(&mut pixmap.as_mut(), scene, &view);
    }
    paint_divider(&mut pixmap.as_mut(), (size.0, height as u32));
    if let Some(bar) = bar {
        paint_bar(&mut pixmap.as_mut(), bar, [half as f32, height as f32], unit as f32);
    }
    let bytes = pixmap.encode_png().map_err(|e| RasterError::Encode(e.to_string()))?;
    Ok(marked_png(&bytes))
}

/// One scene in the middle of a picture of a size, pixels.
///
/// # Errors
/// A size that is empty or does not fit in memory.
pub fn one(scene: &Scene, size: (u32, u32), background: Color) -> Result<Preview, RasterError> {
    let mut pixmap = Pixmap::new(size.0, size.1).ok_or(RasterError::Size(size.0, size.1))?;
    pixmap.fill(color(background));
    let view = View::fit(&Bounds::of([scene]), 0.0, f64::from(size.0), f64::from(size.1));
    paint_scene(&mut pixmap.as_mut(), scene, &view);
    // Nothing shines through: premultiplied or not is the same.
    Ok(Preview { width: size.0, height: size.1, pixels: pixmap.take() })
}

/// Points of mm (y up) to pixels, so that all of them are as large as a margin allows in a picture of a size.
pub(super) fn fitted<'a>(
    points: impl Iterator<Item = &'a Point>,
    (width, height): (u32, u32),
) -> impl Fn(&Point) -> [f32; 2] {
    let mut bounds = Bounds { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
    points.for_each(|p| bounds.add(p));
    let view = View::fit(&bounds, 0.0, f64::from(width), f64::from(height));
    move |p| [(view.x0 + view.scale * p[0]) as f32, (view.y0 - view.scale * p[1]) as f32]
}

/// Closed polygons as one path.
pub(super) fn path<'a>(rings: impl Iterator<Item = &'a [Point]>, place: &impl Fn(&Point) -> [f32; 2]) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for ring in rings {
        let mut points = ring.iter().map(place);
        let Some([x, y]) = points.next() else { continue };
        builder.move_to(x, y);
        points.for_each(|[x, y]| builder.line_to(x, y));
        builder.close();
    }
    builder.finish()
}

/// The box around everything that is drawn, mm.
struct Bounds {
    low: Point,
    high: Point,
}

impl Bounds {
    fn of<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> Self {
        let mut bounds = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        for item in scenes.into_iter().flat_map(|scene| &scene.items) {
            match item {
                Item::Mesh { points, .. }
                | Item::Body { points, .. }
                | Item::Cells { points, .. }
                | Item::Picture { points, .. }
                | Item::Line { points, .. } => points.iter().for_each(|p| bounds.add(p)),
                Item::Plush(felt) => felt.points.iter().for_each(|p| bounds.add(p)),
                Item::Strands(strands) => strands.points().iter().for_each(|p| bounds.add(p)),
                Item::Disc { center, .. } => bounds.add(center),
            }
        }
        if bounds.low[0] > bounds.high[0] { Self { low: [0.0; 2], high: [1.0; 2] } } else { bounds }
    }

    fn add(&mut self, p: &Point) {
        if p.iter().all(|v| v.is_finite()) {
            self.low = [self.low[0].min(p[0]), self.low[1].min(p[1])];
            self.high = [self.high[0].max(p[0]), self.high[1].max(p[1])];
        }
    }
}

/// mm (y up) to pixels (y down): `(x0 + scale x, y0 - scale y)`.
struct View {
    x0: f64,
    y0: f64,
    /// Pixels a mm.
    scale: f64,
    /// Pixels a logical pixel.
    unit: f32,
}

impl View {
    /// `bounds` as large as a margin allows, in the middle of the column at `x` that is `width` wide.
    fn fit(bounds: &Bounds, x: f64, width: f64, height: f64) -> Self {
        let margin = MARGIN * width.min(height);
        let extent = |axis: usize| (bounds.high[axis] - bounds.low[axis]).max(f64::MIN_POSITIVE);
        let scale = ((width - 2.0 * margin) / extent(0)).min((height - 2.0 * margin) / extent(1));
        let center = |axis: usize| 0.5 * (bounds.low[axis] + bounds.high[axis]);
        Self {
            x0: x + 0.5 * width - scale * center(0),
            y0: 0.5 * height + scale * center(1),
            scale,
            unit: (height / REFERENCE_HEIGHT) as f32,
        }
    }

    fn exact(&self, p: &Point) -> Point {
        [self.x0 + self.scale * p[0], self.y0 - self.scale * p[1]]
    }

    fn place(&self, p: &Point) -> (f32, f32) {
        let [x, y] = self.exact(p);
        (x as f32, y as f32)
    }
}

fn paint_scene(pixmap: &mut PixmapMut, scene: &Scene, view: &View) {
    for item in &scene.items {
        match item {
            Item::Mesh { points, triangles, color } => {
                if let Some(path) = mesh_path(points, triangles, view) {
                    pixmap.fill_path(&path, &paint(*color), FillRule::Winding, Transform::identity(), None);
                }
            }
            Item::Body { silhouette, points, color } => {
                if let Some(path) = mesh_path(points, &silhouette.triangles, view) {
                    pixmap.fill_path(&path, &paint(*color), FillRule::Winding, Transform::identity(), None);
                }
            }
            Item::Cells { points, triangles, colors } => {
                for (triangle, &Color(r, g, b, _)) in triangles.iter().zip(colors) {
                    if let Some(at) = corners(triangle, points) {
                        let color = [r, g, b, 255].map(f64::from);
                        textured::triangle(pixmap, at.map(|p| view.exact(&p)), |_| color);
                    }
                }
            }
            Item::Plush(felt) => paint_felt(pixmap, felt, view),
            Item::Picture { points, places, triangles, texture } => {
                for triangle in triangles {
                    if let (Some(at), Some(on_it)) = (corners(triangle, points), corners(triangle, places)) {
                        let at = at.map(|p| view.exact(&p));
                        let texels = textured::texels(at, on_it, texture);
                        textured::triangle(pixmap, at, |w| texture.color(textured::mean(w, on_it), texels));
                    }
                }
            }
            Item::Line { points, width, color, closed } => {
                if let Some(path) = line_path(points, *closed, view) {
                    stroke(pixmap, &path, width * view.unit, *color);
                }
            }
            Item::Strands(strands) => {
                for (points, width, color) in strands.iter() {
                    if let Some(path) = line_path(points, false, view) {
                        stroke(pixmap, &path, width * view.unit, color);
                    }
                }
            }
            Item::Disc { center, radius, fill, stroke: edge } => {
                let (x, y) = view.place(center);
                if let Some(path) = PathBuilder::from_circle(x, y, radius * view.unit) {
                    pixmap.fill_path(&path, &paint(*fill), FillRule::Winding, Transform::identity(), None);
                    if let Some((width, color)) = edge {
                        stroke(pixmap, &path, width * view.unit, *color);
                    }
                }
            }
        }
    }
}

/// The values of a triangle's corners.
fn corners<T: Copy>(triangle: &[usize; 3], of: &[T]) -> Option<[T; 3]> {
    let [a, b, c] = triangle.map(|n| of.get(n).copied());
    Some([a?, b?, c?])
}

fn paint_felt(pixmap: &mut PixmapMut, felt: &Felt, view: &View) {
    let silhouette = &felt.silhouette;
    let base = [felt.color.0, felt.color.1, felt.color.2].map(|c| f32::from(c) / 255.0);
    let pixel_mm = (1.0 / view.scale) as f32;
    let skin = felt.texture.as_ref().map(|(texture, _)| texture).zip(felt.places());
    for triangle in &silhouette.triangles {
        let (Some(at), Some(rest)) = (corners(triangle, &felt.points), corners(triangle, &silhouette.rest)) else {
            continue;
        };
        let (Some(slopes), Some(heights)) = (corners(triangle, &felt.slopes), corners(triangle, &silhouette.heights))
        else {
            continue;
        };
        let at = at.map(|p| view.exact(&p));
        let slopes = slopes.map(|s| s.map(f64::from));
        let on_it = skin.as_ref().and_then(|(texture, places)| Some((texture, corners(triangle, places)?)));
        let on_it = on_it.map(|(texture, places)| (texture, places, textured::texels(at, places, texture)));
        textured::triangle(pixmap, at, |weights| {
            let over = on_it
                .map_or([0.0; 4], |(texture, places, texels)| texture.color(textured::mean(weights, places), texels));
            let left = 1.0 - over[3] as f32 / 255.0;
            let color: [f32; 3] = std::array::from_fn(|k| over[k] as f32 / 255.0 + left * base[k]);
            let slope = textured::mean(weights, slopes).map(|v| v as f32);
            let [height] = textured::mean(weights, heights.map(|h| [h]));
            let place = textured::mean(weights, rest).map(|v| v as f32);
            let [r, g, b] = plush::shade(color, slope, height as f32, place, pixel_mm).map(|c| 255.0 * f64::from(c));
            [r, g, b, 255.0]
        });
    }
}

/// All triangles as one path, all turning the same way: painted together they leave no seams between them.
fn mesh_path(points: &[Point], triangles: &[[usize; 3]], view: &View) -> Option<Path> {
    let mut path = PathBuilder::new();
    for triangle in triangles {
        let [a, b, c] = triangle.map(|n| points.get(n));
        let (Some(a), Some(b), Some(c)) = (a, b, c) else { continue };
        let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let (second, third) = if turn < 0.0 { (c, b) } else { (b, c) };
        for (index, p) in [a, second, third].into_iter().enumerate() {
            let (x, y) = view.place(p);
            if index == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        path.close();
    }
    path.finish()
}

fn line_path(points: &[Point], closed: bool, view: &View) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (index, p) in points.iter().enumerate() {
        let (x, y) = view.place(p);
        if index == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn stroke(pixmap: &mut PixmapMut, path: &Path, width: f32, line: Color) {
    let stroke = Stroke { width, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
    pixmap.stroke_path(path, &paint(line), &stroke, Transform::identity(), None);
}

/// A thin dashed line between the two views.
fn paint_divider(pixmap: &mut PixmapMut, (width, height): (u32, u32)) {
    let (x, height) = (width as f32 / 2.0, height as f32);
    let unit = height / REFERENCE_HEIGHT as f32;
    let Some(rect) = Rect::from_ltrb(x, height * MARGIN as f32, x, height * (1.0 - MARGIN as f32)) else { return };
    let mut path = PathBuilder::new();
    path.move_to(rect.left(), rect.top());
    path.line_to(rect.left(), rect.bottom());
    let Some(path) = path.finish() else { return };
    let stroke =
        Stroke { width: unit.max(1.0), dash: StrokeDash::new(vec![6.0 * unit, 6.0 * unit], 0.0), ..Stroke::default() };
    pixmap.stroke_path(&path, &paint(DIVIDER), &stroke, Transform::identity(), None);
}

/// A bar under a place in the middle of its title, with three figures below.
fn paint_bar(pixmap: &mut PixmapMut, bar: &Bar, [middle, top]: [f32; 2], unit: f32) {
    let [length, height] = BAR.map(|v| v * unit);
    let (left, base) = (middle - 0.5 * length, top + 22.0 * unit);
    let steps = length.ceil().max(1.0);
    for k in 0..steps as usize {
        let (from, to) = (left + length * k as f32 / steps, left + length * (k + 1) as f32 / steps);
        if let Some(rect) = Rect::from_ltrb(from, base, to, base + height) {
            let solid = Paint { anti_alias: false, ..paint(bar.color_at((k as f64 + 0.5) / f64::from(steps))) };
            pixmap.fill_rect(rect, &solid, Transform::identity(), None);
        }
    }
    let ink = Palette::of(bar.theme).pin;
    let mut write = |text: &str, [x, y]: [f32; 2]| {
        let size = LETTERS * unit;
        if let Some(path) = letters::path(text, size, [x - 0.5 * letters::width(text, size), y]) {
            pixmap.fill_path(&path, &paint(ink), FillRule::Winding, Transform::identity(), None);
        }
    };
    write(&bar.words(), [middle, base - 6.0 * unit]);
    for (place, words) in bar.ticks() {
        write(&words, [left + place as f32 * length, base + height + 16.0 * unit]);
    }
}

fn paint(c: Color) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(color(c));
    paint
}

fn color(Color(r, g, b, a): Color) -> tiny_skia::Color {
    tiny_skia::Color::from_rgba8(r, g, b, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHITE: Color = Color(255, 255, 255, 255);
    const RED: Color = Color(255, 0, 0, 255);

    fn square() -> Scene {
        let points = vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        // One triangle turns the other way round, as in a body folded over itself.
        Scene { items: vec![Item::Mesh { points, triangles: vec![[0, 1, 2], [0, 3, 2]], color: RED }] }
    }

    fn pixel(png: &[u8], x: u32, y: u32) -> [u8; 3] {
        let pixmap = Pixmap::decode_png(png).unwrap();
        let p = pixmap.pixel(x, y).unwrap();
        [p.red(), p.green(), p.blue()]
    }

    #[test]
    fn both_views_fill_their_half_and_nothing_else() {
        let bytes = png(&square(), &Scene::default(), (400, 200), WHITE).unwrap();
        use crate::files::is_marked_png;
        assert!(is_marked_png(&bytes) && !is_marked_png(&Pixmap::decode_png(&bytes).unwrap().encode_png().unwrap()));
        for (x, y) in [(100, 100), (30, 20), (170, 180), (60, 140), (140, 60)] {
            assert_eq!(pixel(&bytes, x, y), [255, 0, 0], "{x} {y}");
        }
        for (x, y) in [(2, 100), (300, 100), (100, 2)] {
            assert_eq!(pixel(&bytes, x, y), [255, 255, 255], "{x} {y}");
        }
    }

    #[test]
    fn neighbouring_triangles_leave_no_seam() {
        let bytes = png(&square(), &Scene::default(), (401, 203), WHITE).unwrap();
        let pixmap = Pixmap::decode_png(&bytes).unwrap();
        let pink = (30..170).flat_map(|x| (30..170).map(move |y| (x, y))).filter(|&(x, y)| {
            let p = pixmap.pixel(x, y).unwrap();
            p.green() > 0
        });
        assert_eq!(pink.count(), 0);
    }

    #[test]
    fn y_points_up() {
        let mark = Item::Disc { center: [5.0, 9.0], radius: 8.0, fill: Color(0, 0, 255, 255), stroke: None };
        let mut scene = square();
        scene.items.push(mark);
        let bytes = png(&Scene::default(), &scene, (400, 200), WHITE).unwrap();
        assert_eq!(pixel(&bytes, 300, 30), [0, 0, 255]);
        assert_eq!(pixel(&bytes, 300, 170), [255, 0, 0]);
    }

    #[test]
    fn an_impossible_size_is_refused() {
        assert!(matches!(png(&square(), &square(), (0, 10), WHITE), Err(RasterError::Size(0, 10))));
    }
}
