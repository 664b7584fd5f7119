//! The drawing of a spool and a housing, with their dimensions.

use super::housing::{EAR_HOLE_MM, EAR_MM, EAR_THICKNESS_MM, FLOOR_MM, Housing, OUTLET_MM};
use super::spool::{SCREW_HOLE_MM, Spool};
use crate::fabrication::sheet::{Anchor, BLACK, Entity, GREY, Group, Sheet, Style, reference};
use crate::outline::Point;

/// Scale of the drawing and its paper, mm.
const SCALE: f64 = 2.0;
const MARGIN_MM: f64 = 18.0;
const TEXT_MM: f64 = 3.2;
/// Distance of a dimension's line from what it measures, and half the length of its end strokes, mm.
const OFF_MM: f64 = 8.0;
const TICK_MM: f64 = 1.4;

/// A sheet with the spool from the side, and the housing from the side and from its open end, at twice their size.
pub fn drawing(title: &str, words: &[String], spool: &Spool, housing: &Housing) -> Sheet {
    let mut pen = Pen::default();
    let (r, length) = (SCALE * spool.flange_radius_mm, SCALE * spool.length_mm());
    let (outer, room) = (SCALE * housing.outer_radius_mm, SCALE * housing.length_mm());
    let far = outer + SCALE * EAR_MM;
    let base = MARGIN_MM + 26.0 + far;
    let side = [MARGIN_MM + OFF_MM + 6.0, base];
    spool_side(&mut pen, spool, side, r, length);
    let cup = [side[0] + length + 34.0, base];
    housing_side(&mut pen, housing, cup, outer, room);
    let end = [cup[0] + room + 34.0 + far, base];
    housing_end(&mut pen, housing, end, outer);
    let width_mm = (end[0] + far + MARGIN_MM + 12.0).max(170.0);
    let top = base + far + 26.0;
    let height_mm = top + 6.0 * (words.len() + 2) as f64 + MARGIN_MM;
    let mut row = height_mm - MARGIN_MM;
    pen.words.text([MARGIN_MM, row], 5.0, Anchor::Start, title);
    for line in words {
        row -= 6.0;
        pen.words.text([MARGIN_MM, row], TEXT_MM, Anchor::Start, line.as_str());
    }
    for (at, text) in
        [(side[0] + 0.5 * length, "spool"), (cup[0] + 0.5 * room, "housing"), (end[0], "housing from its open end")]
    {
        pen.words.text([at, top - 6.0], TEXT_MM, Anchor::Middle, format!("{text}, scale {SCALE}:1"));
    }
    let Pen { lines, thin, words } = pen;
    Sheet {
        title: title.into(),
        width_mm,
        height_mm,
        groups: vec![lines, thin, words, reference([MARGIN_MM, MARGIN_MM])],
    }
}

fn spool_side(pen: &mut Pen, spool: &Spool, [x, y]: Point, r: f64, length: f64) {
    let steps = spool.profile();
    let edge = |side: f64| -> Vec<Point> {
        let ends =
            steps.iter().flat_map(|&(from, to, radius)| [from, to].map(|z| [x + SCALE * z, y + side * SCALE * radius]));
        ends.collect()
    };
    let mut rim = edge(1.0);
    rim.extend(edge(-1.0).into_iter().rev());
    pen.lines.entities.push(Entity::Polygon(rim));
    // Edges of flanges towards the viewer.
    for &(from, to, radius) in steps.iter().filter(|s| s.2 == spool.flange_radius_mm) {
        let h = SCALE * radius;
        for z in [from, to].map(|z| x + SCALE * z) {
            pen.thin.entities.push(Entity::Polyline(vec![[z, y - h], [z, y + h]]));
        }
    }
    let bore = 0.5 * SCALE * spool.shaft_mm;
    for h in [-bore, bore] {
        pen.thin.entities.push(Entity::Polyline(vec![[x, y + h], [x + length, y + h]]));
    }
    let screw = [x + 0.5 * SCALE * spool.hub_mm, y + 0.5 * SCALE * (spool.hub_radius_mm + 0.5 * spool.shaft_mm)];
    pen.thin.entities.push(Entity::Circle { center: screw, radius: 0.5 * SCALE * SCREW_HOLE_MM });
    pen.down([x + length, y - r], [x + length, y + r], x + length + OFF_MM, &diameter(2.0 * spool.flange_radius_mm));
    pen.across([x, y - r], [x + length, y - r], y - r - OFF_MM, &plain(spool.length_mm()));
    pen.across([x, y + r], [x + SCALE * spool.hub_mm, y + r], y + r + OFF_MM, &plain(spool.hub_mm));
    pen.down([x, y - bore], [x, y + bore], x - 0.8 * OFF_MM, &diameter(spool.shaft_mm));
}

fn housing_side(pen: &mut Pen, housing: &Housing, [x, y]: Point, outer: f64, room: f64) {
    let inner = SCALE * housing.inner_radius_mm;
    pen.lines.entities.push(ring([x, y - outer], [x + room, y + outer]));
    pen.thin.entities.push(ring([x + SCALE * FLOOR_MM, y - inner], [x + room, y + inner]));
    for side in [1.0, -1.0] {
        let (low, high) = (y + side * outer, y + side * (outer + SCALE * EAR_MM));
        pen.lines.entities.push(ring([x, low.min(high)], [x + room, low.max(high)]));
        let middle = 0.5 * (low + high);
        for z in housing.ear_holes_mm() {
            pen.lines
                .entities
                .push(Entity::Circle { center: [x + SCALE * z, middle], radius: 0.5 * SCALE * EAR_HOLE_MM });
        }
    }
    let far = outer + SCALE * EAR_MM;
    pen.across([x, y - far], [x + room, y - far], y - far - OFF_MM, &plain(housing.length_mm()));
    pen.down([x + room, y - far], [x + room, y + far], x + room + OFF_MM, &plain(housing.span_mm()));
}

fn housing_end(pen: &mut Pen, housing: &Housing, [x, y]: Point, outer: f64) {
    let inner = SCALE * housing.inner_radius_mm;
    pen.lines.entities.push(Entity::Circle { center: [x, y], radius: outer });
    pen.lines.entities.push(Entity::Circle { center: [x, y], radius: inner });
    let half = 0.5 * SCALE * EAR_THICKNESS_MM;
    for side in [1.0, -1.0] {
        let (a, b) = (x + side * outer, x + side * (outer + SCALE * EAR_MM));
        pen.lines.entities.push(ring([a.min(b), y - half], [a.max(b), y + half]));
    }
    let outlet = 0.5 * SCALE * OUTLET_MM;
    for side in [1.0, -1.0] {
        let (low, high) = (y + side * inner, y + side * outer);
        pen.thin.entities.push(ring([x - outlet, low.min(high)], [x + outlet, low.max(high)]));
    }
    let far = outer + SCALE * EAR_MM;
    pen.down(
        [x + outer, y - outer],
        [x + outer, y + outer],
        x + far + OFF_MM,
        &diameter(2.0 * housing.outer_radius_mm),
    );
    pen.across([x - outlet, y + outer], [x + outlet, y + outer], y + outer + 0.6 * OFF_MM, &plain(OUTLET_MM));
    pen.across(
        [x - inner, y - outer],
        [x + inner, y - outer],
        y - outer - OFF_MM,
        &diameter(2.0 * housing.inner_radius_mm),
    );
}

/// Groups of lines, and of dimensions.
struct Pen {
    lines: Group,
    thin: Group,
    words: Group,
}

impl Default for Pen {
    fn default() -> Self {
        Self {
            lines: Group::new("lines", Style::line(BLACK, 0.4)),
            thin: Group::new("dimensions", Style::line(GREY, 0.3)),
            words: Group::new("words", Style::filled(BLACK)),
        }
    }
}

impl Pen {
    /// A dimension between two places, on a level line at `y`.
    fn across(&mut self, a: Point, b: Point, y: f64, text: &str) {
        for p in [a, b] {
            self.thin.entities.push(Entity::Polyline(vec![p, [p[0], y]]));
            self.thin
                .entities
                .push(Entity::Polyline(vec![[p[0] - TICK_MM, y - TICK_MM], [p[0] + TICK_MM, y + TICK_MM]]));
        }
        self.thin.entities.push(Entity::Polyline(vec![[a[0], y], [b[0], y]]));
        self.words.text([0.5 * (a[0] + b[0]), y + 1.2], TEXT_MM, Anchor::Middle, text);
    }

    /// The same on an upright line at `x`; the words stand beside its upper end.
    fn down(&mut self, a: Point, b: Point, x: f64, text: &str) {
        for p in [a, b] {
            self.thin.entities.push(Entity::Polyline(vec![p, [x, p[1]]]));
            self.thin
                .entities
                .push(Entity::Polyline(vec![[x - TICK_MM, p[1] - TICK_MM], [x + TICK_MM, p[1] + TICK_MM]]));
        }
        self.thin.entities.push(Entity::Polyline(vec![[x, a[1]], [x, b[1]]]));
        self.words.text([x, b[1] + 2.0], TEXT_MM, Anchor::Middle, text);
    }
}

fn ring(low: Point, high: Point) -> Entity {
    Entity::Polygon(vec![low, [high[0], low[1]], high, [low[0], high[1]]])
}

fn plain(mm: f64) -> String {
    let text = format!("{mm:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn diameter(mm: f64) -> String {
    format!("\u{d8} {}", plain(mm))
}
