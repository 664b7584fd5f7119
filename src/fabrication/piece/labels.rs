//! Places for words that cross no line and no other words.

use crate::fabrication::font;
use crate::outline::Point;
use crate::outline::polygon::{self, bounding_box, distance_to_segment};

/// Space kept free around words, mm.
const SPACE_MM: f64 = 0.6;
/// Height of a line of words over its letters' size: with what hangs below the base line.
const HEIGHT: f64 = 0.95;
const BELOW: f64 = 0.22;
/// How far from its place a label may stand, mm, and the steps and directions in which a free place is looked for.
const FARTHEST_MM: f64 = 24.0;
const STEP_MM: f64 = 1.2;
const DIRECTIONS: usize = 16;

/// What is in the way of words, mm on a sheet.
#[derive(Clone, Debug, Default)]
pub struct Labels {
    segments: Vec<[Point; 2]>,
    discs: Vec<(Point, f64)>,
    boxes: Vec<[Point; 2]>,
    /// Where words stay inside, if anywhere.
    within: Option<Vec<Point>>,
}

impl Labels {
    /// Words are to stay inside a polygon.
    pub fn within(polygon: Vec<Point>) -> Self {
        let mut labels = Self::default();
        labels.polygon(&polygon);
        labels.within = Some(polygon);
        labels
    }

    pub fn polyline(&mut self, points: &[Point]) {
        self.segments.extend(points.windows(2).map(|s| [s[0], s[1]]));
    }

    pub fn polygon(&mut self, points: &[Point]) {
        self.segments.extend(polygon::sides(points).map(|(a, b)| [a, b]));
    }

    pub fn disc(&mut self, center: Point, radius: f64) {
        self.discs.push((center, radius));
    }

    /// A place for words as near as there is to `to`, for their left end on the base line; the place is taken from then on. None where all
    /// is full.
    pub fn place(&mut self, text: &str, size_mm: f64, to: Point) -> Option<Point> {
        let width = font::room_mm(text, size_mm);
        let rings = (0..=(FARTHEST_MM / STEP_MM) as usize).map(|k| k as f64 * STEP_MM);
        let tries = rings.flat_map(|r| {
            (0..DIRECTIONS).map(move |k| {
                // To the upper right first.
                let angle = std::f64::consts::FRAC_PI_4 + std::f64::consts::TAU * k as f64 / DIRECTIONS as f64;
                let (sine, cosine) = angle.sin_cos();
                // The near edge of the box at a distance r.
                let reach = [cosine * (r + 0.5 * width), sine * (r + 0.5 * HEIGHT * size_mm)];
                [to[0] + reach[0] - 0.5 * width, to[1] + reach[1] - 0.5 * HEIGHT * size_mm + BELOW * size_mm]
            })
        });
        let free = tries.into_iter().find(|&at| self.is_free(boxed(at, width, size_mm)))?;
        self.boxes.push(boxed(free, width, size_mm));
        Some(free)
    }

    /// The same at one of several places, the first that is free as it is: words are centred there.
    pub fn place_at(&mut self, text: &str, size_mm: f64, places: impl IntoIterator<Item = Point>) -> Option<Point> {
        let width = font::room_mm(text, size_mm);
        let start = |p: Point| [p[0] - 0.5 * width, p[1] - 0.4 * size_mm];
        let free = places.into_iter().map(start).find(|&at| self.is_free(boxed(at, width, size_mm)))?;
        self.boxes.push(boxed(free, width, size_mm));
        Some(free)
    }

    fn is_free(&self, [low, high]: [Point; 2]) -> bool {
        let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
        let inside = |p: Point| (0..2).all(|k| low[k] < p[k] && p[k] < high[k]);
        let crosses = |s: &[Point; 2]| {
            let (a, b) = bounding_box(s);
            if (0..2).any(|k| a[k] > high[k] || b[k] < low[k]) {
                return false;
            }
            inside(s[0]) || inside(s[1]) || polygon::sides(&corners).any(|(c, d)| cross(s[0], s[1], c, d))
        };
        let meets = |&(center, radius): &(Point, f64)| {
            inside(center) || polygon::sides(&corners).any(|(c, d)| distance_to_segment(c, d, center) < radius)
        };
        let overlaps = |b: &[Point; 2]| (0..2).all(|k| b[0][k] < high[k] && low[k] < b[1][k]);
        !self.boxes.iter().any(overlaps)
            && !self.discs.iter().any(meets)
            && !self.segments.iter().any(crosses)
            && self.within.as_ref().is_none_or(|ring| corners.iter().all(|&c| polygon::contains(ring, c)))
    }
}

fn boxed(at: Point, width: f64, size_mm: f64) -> [Point; 2] {
    let low = [at[0] - SPACE_MM, at[1] - BELOW * size_mm - SPACE_MM];
    [low, [at[0] + width + SPACE_MM, at[1] + (HEIGHT - BELOW) * size_mm + SPACE_MM]]
}

/// Whether two segments cross.
fn cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_cross_nothing_and_stay_inside() {
        let mut labels = Labels::within(vec![[0.0, 0.0], [100.0, 0.0], [100.0, 60.0], [0.0, 60.0]]);
        labels.polyline(&[[0.0, 30.0], [100.0, 30.0]]);
        labels.disc([50.0, 20.0], 3.0);
        let mut taken: Vec<[Point; 2]> = Vec::new();
        for _ in 0..12 {
            let Some(at) = labels.place("12", 4.0, [50.0, 20.0]) else { continue };
            let own = boxed(at, font::room_mm("12", 4.0), 4.0);
            assert!(own[0][0] > 0.0 && own[1][0] < 100.0 && own[0][1] > 0.0 && own[1][1] < 60.0);
            assert!(own[1][1] <= 30.0 || own[0][1] >= 30.0, "{own:?}");
            assert!(taken.iter().all(|b| (0..2).any(|k| b[0][k] >= own[1][k] || own[0][k] >= b[1][k])));
            taken.push(own);
        }
        assert!(taken.len() >= 8);
        assert_eq!(labels.place("too long for this place by far, and farther than that", 8.0, [50.0, 20.0]), None);
    }
}
