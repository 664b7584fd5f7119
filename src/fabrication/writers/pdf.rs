//! Sheets, books and guides as PDF: a page a sheet, at its size in mm.

use super::layout;
use crate::fabrication::font;
use crate::fabrication::product::Content;
use crate::fabrication::sheet::{Anchor, Color, Entity, Group, Sheet};
use crate::outline::Point;
use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Point as At, Rect};
use krilla::num::NormalizedF32;
use krilla::page::PageSettings;
use krilla::paint::{Fill, FillRule, LineCap, LineJoin, Stroke, StrokeDash};
use krilla::surface::Surface;
use krilla::text::{Font, GlyphId, KrillaGlyph};
use krilla::{Document, SerializeSettings};

/// Points of 1/72 inch in a millimetre.
const POINTS_PER_MM: f64 = 72.0 / 25.4;
/// Distance of the control points of a quarter circle from its ends over its radius: off by 0.03 % at most.
const QUARTER: f64 = 0.552_284_749_831;

/// The bytes of a PDF file; `None` where a page has no size.
pub(super) fn write(content: &Content) -> Option<Vec<u8>> {
    match content {
        Content::Sheet(sheet) => pdf(std::slice::from_ref(sheet)),
        Content::Book(sheets) => pdf(sheets),
        Content::Guide(guide) => pdf(&layout::pages(guide)),
        _ => None,
    }
}

pub(super) fn pdf(sheets: &[Sheet]) -> Option<Vec<u8>> {
    // Without dates and random numbers: the same sheets are the same bytes.
    let settings = SerializeSettings { xmp_metadata: false, ..SerializeSettings::default() };
    let mut document = Document::new_with(settings);
    let font = Font::new(font::BYTES.into(), 0)?;
    for sheet in sheets {
        let size = PageSettings::from_wh(points(sheet.width_mm), points(sheet.height_mm))?;
        let mut page = document.start_page_with(size);
        let mut surface = page.surface();
        let mut pen = Pen { surface: &mut surface, font: &font, height: sheet.height_mm };
        sheet.groups.iter().for_each(|group| pen.group(group));
        surface.finish();
        page.finish();
    }
    document.finish().ok()
}

fn points(mm: f64) -> f32 {
    (mm * POINTS_PER_MM) as f32
}

/// Draws on a page; sheets have y up, pages down.
struct Pen<'a, 'b> {
    surface: &'a mut Surface<'b>,
    font: &'a Font,
    height: f64,
}

impl Pen<'_, '_> {
    fn at(&self, [x, y]: Point) -> (f32, f32) {
        (points(x), points(self.height - y))
    }

    fn group(&mut self, group: &Group) {
        let clip = group.clip.and_then(|[low, high]| {
            let ((left, bottom), (right, top)) = (self.at(low), self.at(high));
            let mut path = PathBuilder::new();
            path.push_rect(Rect::from_ltrb(left, top, right, bottom)?);
            path.finish()
        });
        if let Some(path) = &clip {
            self.surface.push_clip_path(path, &FillRule::NonZero);
        }
        for entity in &group.entities {
            self.entity(group, entity);
        }
        if clip.is_some() {
            self.surface.pop();
        }
    }

    fn entity(&mut self, group: &Group, entity: &Entity) {
        let style = &group.style;
        let path = match entity {
            Entity::Polygon(points) => self.line(points, true),
            Entity::Polyline(points) => self.line(points, false),
            Entity::Circle { center, radius } => self.circle(*center, *radius),
            Entity::Text { at, size_mm, anchor, text } => {
                let color = style.stroke.or(style.fill);
                return self.text(*at, *size_mm, *anchor, text, color);
            }
        };
        let Some(path) = path else { return };
        let open = matches!(entity, Entity::Polyline(_));
        self.surface.set_fill(style.fill.filter(|_| !open).map(fill));
        self.surface.set_stroke(style.stroke.map(|color| {
            Stroke {
                paint: paint(color).into(),
                width: points(style.stroke_mm),
                line_cap: if style.dash.is_empty() { LineCap::Round } else { LineCap::Butt },
                line_join: LineJoin::Round,
                dash: (!style.dash.is_empty())
                    .then(|| StrokeDash { array: style.dash.iter().map(|&v| points(v)).collect(), offset: 0.0 }),
                ..Stroke::default()
            }
        }));
        self.surface.draw_path(&path);
    }

    fn line(&self, line: &[Point], closed: bool) -> Option<Path> {
        let mut path = PathBuilder::new();
        for (i, &p) in line.iter().enumerate() {
            let (x, y) = self.at(p);
            if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        if closed {
            path.close();
        }
        path.finish()
    }

    fn circle(&self, [x, y]: Point, r: f64) -> Option<Path> {
        let mut path = PathBuilder::new();
        let k = QUARTER * r;
        let (start_x, start_y) = self.at([x + r, y]);
        path.move_to(start_x, start_y);
        let mut ends = [[x + r, y + k], [x + k, y + r], [x, y + r]];
        for _ in 0..4 {
            let [(a, b), (c, d), (e, f)] = ends.map(|p| self.at(p));
            path.cubic_to(a, b, c, d, e, f);
            // The next quarter: turned by 90 degrees around the middle.
            ends = ends.map(|p| [x - (p[1] - y), y + (p[0] - x)]);
        }
        path.close();
        path.finish()
    }

    fn text(&mut self, at: Point, size_mm: f64, anchor: Anchor, text: &str, color: Option<Color>) {
        let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let shift = if anchor == Anchor::Middle { 0.5 * font::width_mm(&text, size_mm) } else { 0.0 };
        let glyphs: Vec<KrillaGlyph> = text
            .char_indices()
            .map(|(i, c)| {
                let set = font::set(c);
                let id = GlyphId::new(set.glyph);
                KrillaGlyph::new(id, set.width as f32, 0.0, 0.0, 0.0, i..i + c.len_utf8(), None)
            })
            .collect();
        if glyphs.is_empty() {
            return;
        }
        self.surface.set_fill(color.map(fill));
        self.surface.set_stroke(None);
        let (x, y) = self.at([at[0] - shift, at[1]]);
        self.surface.draw_glyphs(At::from_xy(x, y), &glyphs, self.font.clone(), &text, points(size_mm), false);
    }
}

fn paint(Color(r, g, b): Color) -> rgb::Color {
    rgb::Color::new(r, g, b)
}

fn fill(color: Color) -> Fill {
    Fill { paint: paint(color).into(), opacity: NormalizedF32::ONE, rule: FillRule::EvenOdd }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::sheet::{RED, Style};

    #[test]
    fn pages_have_their_size_in_points_and_the_same_bytes_each_time() {
        let mut group = Group::new("cut", Style::line(RED, 0.3).dashed(&[2.0, 1.0]));
        group.entities.push(Entity::Polygon(vec![[0.0, 0.0], [30.0, 0.0], [0.0, 20.0]]));
        group.entities.push(Entity::Circle { center: [10.5, 20.0], radius: 0.75 });
        group.text([1.0, 2.0], 4.0, Anchor::Middle, "R & D \u{3042}");
        let sheet = Sheet { title: "a".into(), width_mm: 254.0, height_mm: 127.0, groups: vec![group] };
        let bytes = pdf(&[sheet.clone(), sheet.clone()]).unwrap();
        assert!(bytes.starts_with(b"%PDF-"));
        let text = String::from_utf8_lossy(&bytes);
        assert_eq!(text.matches("/MediaBox[0 0 720 360]").count() + text.matches("/MediaBox [0 0 720 360]").count(), 2);
        assert_eq!(pdf(&[sheet.clone(), sheet]).unwrap(), bytes);
        assert_eq!(pdf(&[Sheet::default()]), None);
    }
}
