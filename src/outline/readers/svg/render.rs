//! A drawing as a picture.

use super::tree::parsed;
use crate::outline::resample::{MAX_TEXTURE_PX, fitted};
use crate::outline::{Import, OutlineError, Point};
use image::RgbaImage;
use tiny_skia::Pixmap;
use usvg::{Group, ImageKind, Node, Paint, Rect, Transform, Tree};

/// Most pixels that are painted, those that lie over each other counted each: some seconds.
const MAX_PAINTED: f64 = 3e9;
/// Most pixels of pictures that are in work at the same time, one for each group that is clipped, masked or faded as a whole within
/// another: about a gigabyte.
const MAX_STACKED: f64 = 1.2e8;
/// Most pixels of embedded pictures, each use counted: some seconds.
const MAX_DECODED: f64 = 2e8;
/// What a group that is composed as a whole costs: it is cleared, cut and copied.
const COMPOSING: f64 = 4.0;
/// What a step of a filter costs besides: a blur takes several passes, between two conversions of colour.
const FILTERING: f64 = 64.0;
/// How far beyond the box a group that is composed as a whole is painted at most, in sizes of the box: what resvg allows.
const LAYER_MARGIN: f32 = 2.0;
/// A drawing that leaves fewer pixels than this on the longer side is refused.
const LEAST_PX: f64 = 64.0;

/// The picture of the drawing between the corners of a box (px, y up), with fewer pixels the more lies over each other.
pub(in crate::outline) fn texture(
    svg: &[u8],
    import: &Import,
    [low, high]: [Point; 2],
) -> Result<RgbaImage, OutlineError> {
    drawn(&parsed(svg, import)?.tree, [low, high], f64::from(MAX_TEXTURE_PX))
}

/// The picture of what lies between the corners of a box (px, y up), its longer side of so many pixels, or fewer the more lies over each other.
pub(super) fn drawn(tree: &Tree, [low, high]: [Point; 2], most: f64) -> Result<RgbaImage, OutlineError> {
    let size = [high[0] - low[0], high[1] - low[1]];
    let window = Rect::from_xywh(low[0] as f32, -high[1] as f32, size[0] as f32, size[1] as f32)
        .ok_or(OutlineError::Degenerate)?;
    let mut work = Work { window: Some(window), painted: 0.0, stacked: 1.0, most_stacked: 1.0, decoded: 0.0 };
    work.add(tree.root());
    let longer = size[0].max(size[1]);
    // Pixels of the box if its longer side had one.
    let unit = size[0] / longer * (size[1] / longer);
    let affordable = (MAX_PAINTED / work.painted.max(1.0)).min(MAX_STACKED / work.most_stacked);
    let longest = (affordable / unit).sqrt().min(most);
    if longest < LEAST_PX || work.decoded > MAX_DECODED {
        return Err(OutlineError::TooComplex("paints too much over itself"));
    }
    let [width, height] = fitted(size.map(|side| side / longer * longest), longest);
    let mut pixels = Pixmap::new(width, height).ok_or(OutlineError::Degenerate)?;
    let scale = [f64::from(width) / size[0], f64::from(height) / size[1]];
    let place = [scale[0], 0.0, 0.0, scale[1], -low[0] * scale[0], high[1] * scale[1]].map(|v| v as f32);
    let [sx, ky, kx, sy, tx, ty] = place;
    resvg::render(tree, Transform::from_row(sx, ky, kx, sy, tx, ty), &mut pixels.as_mut());
    let mut picture = RgbaImage::new(width, height);
    for (pixel, shown) in picture.pixels_mut().zip(pixels.pixels()) {
        let colour = shown.demultiply();
        pixel.0 = [colour.red(), colour.green(), colour.blue(), colour.alpha()];
    }
    Ok(picture)
}

/// How much there is to paint, in pictures of the box.
struct Work {
    /// The box, where the bounds of what is painted are known in the same px; not within clips, masks and patterns.
    window: Option<Rect>,
    painted: f64,
    /// Pictures in work now, and the most at the same time.
    stacked: f64,
    most_stacked: f64,
    /// Pixels of all embedded pictures.
    decoded: f64,
}

impl Work {
    fn add(&mut self, group: &Group) {
        let pictures = if group.should_isolate() {
            // Each step of a filter makes another one.
            let steps: usize = group.filters().iter().map(|filter| filter.primitives().len()).sum();
            let part = self.part(group.abs_layer_bounding_box().to_rect(), LAYER_MARGIN);
            self.painted += FILTERING * steps as f64 * part;
            (1 + steps) as f64 * part
        } else {
            0.0
        };
        self.open(pictures);
        for node in group.children() {
            match node {
                Node::Group(child) => self.add(child),
                Node::Path(path) => {
                    self.painted += self.part(path.abs_stroke_bounding_box(), 0.0);
                    let paints = [path.fill().map(usvg::Fill::paint), path.stroke().map(usvg::Stroke::paint)];
                    for paint in paints.into_iter().flatten() {
                        if let Paint::Pattern(pattern) = paint {
                            self.aside(pattern.root());
                        }
                    }
                }
                Node::Text(text) => self.add(text.flattened()),
                Node::Image(image) => match image.kind() {
                    ImageKind::SVG(tree) => self.aside(tree.root()),
                    _ => self.decoded += f64::from(image.size().width()) * f64::from(image.size().height()),
                },
            }
        }
        let mut clip = group.clip_path();
        while let Some(path) = clip {
            self.aside(path.root());
            clip = path.clip_path();
        }
        let mut mask = group.mask();
        while let Some(cover) = mask {
            self.aside(cover.root());
            mask = cover.mask();
        }
        self.stacked -= pictures;
    }

    fn open(&mut self, pictures: f64) {
        self.stacked += pictures;
        self.most_stacked = self.most_stacked.max(self.stacked);
        self.painted += COMPOSING * pictures;
    }

    /// What is painted into a picture of its own, as large as the box at worst.
    fn aside(&mut self, group: &Group) {
        let window = self.window.take();
        self.open(1.0);
        self.add(group);
        self.stacked -= 1.0;
        self.window = window;
    }

    /// How much of the box, and of so many boxes around it, `bounds` cover, in boxes.
    fn part(&self, bounds: Rect, margin: f32) -> f64 {
        let Some(window) = self.window else { return 1.0 };
        let overlap = |from: f32, to: f32, low: f32, side: f32| {
            let (from, to) = ((from - low) / side, (to - low) / side);
            f64::from((to.min(1.0 + margin) - from.max(-margin)).max(0.0))
        };
        overlap(bounds.left(), bounds.right(), window.left(), window.width())
            * overlap(bounds.top(), bounds.bottom(), window.top(), window.height())
    }
}
