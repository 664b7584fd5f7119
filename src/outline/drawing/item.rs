//! What a hand takes hold of in a drawing, a part or a track, and the drawing with it changed.

use super::{Drawing, Primitive, Track, track};
use crate::outline::Point;

/// A part or a track, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item {
    Part(usize),
    Track(usize),
}

impl Drawing {
    pub fn has(&self, item: Item) -> bool {
        match item {
            Item::Part(k) => k < self.parts.len(),
            Item::Track(k) => k < self.tracks.len(),
        }
    }

    /// Where a hand can take hold of it; see [`Primitive::handles`]. Those of a track are its points.
    pub fn handles(&self, item: Item) -> Vec<Point> {
        match item {
            Item::Part(k) => self.parts.get(k).map(|part| part.primitive.handles()).unwrap_or_default(),
            Item::Track(k) => self.tracks.get(k).cloned().unwrap_or_default(),
        }
    }

    /// Where a point can be put in.
    pub fn middles(&self, item: Item) -> Vec<Point> {
        match item {
            Item::Part(k) => self.parts.get(k).map(|part| part.primitive.middles()).unwrap_or_default(),
            Item::Track(k) => self.tracks.get(k).map(|track| track::middles(track)).unwrap_or_default(),
        }
    }

    /// The topmost item at a place: a track within `reach`, or else the part that was drawn last, mm.
    pub fn under(&self, p: Point, reach: f64) -> Option<Item> {
        let on_track = self.tracks.iter().rposition(|track| track::distance(track, p) <= reach);
        let in_part = || self.parts.iter().rposition(|part| part.primitive.contains(p));
        on_track.map(Item::Track).or_else(|| in_part().map(Item::Part))
    }

    /// With one of its handles pulled to a place. Nothing gets smaller than `least`, mm.
    #[must_use]
    pub fn with_pulled(&self, item: Item, handle: usize, to: Point, least: f64) -> Self {
        self.with(
            item,
            |primitive| primitive.pulled(handle, to, least),
            |track| {
                if let Some(point) = track.get_mut(handle) {
                    *point = to;
                }
            },
        )
    }

    /// With one of its items moved by a vector.
    #[must_use]
    pub fn with_moved(&self, item: Item, by: Point) -> Self {
        let shift = |p: &mut Point| *p = [p[0] + by[0], p[1] + by[1]];
        self.with(item, |primitive| primitive.moved(by), |track| track.iter_mut().for_each(shift))
    }

    /// With a point put in after the one numbered `after`.
    #[must_use]
    pub fn with_point(&self, item: Item, after: usize, at: Point) -> Self {
        self.with(
            item,
            |primitive| primitive.with_point(after, at),
            |track| {
                if after < track.len() {
                    track.insert(after + 1, at);
                }
            },
        )
    }

    /// Without one of its points; `None` where it needs all that it has.
    pub fn without_point(&self, item: Item, index: usize) -> Option<Self> {
        let mut without = self.clone();
        match item {
            Item::Part(k) => {
                let part = without.parts.get_mut(k)?;
                part.primitive = part.primitive.without_point(index)?;
            }
            Item::Track(k) => {
                let track = without.tracks.get_mut(k).filter(|track| track.len() > 2 && index < track.len())?;
                track.remove(index);
            }
        }
        Some(without)
    }

    #[must_use]
    pub fn without(&self, item: Item) -> Self {
        let mut without = self.clone();
        match item {
            Item::Part(k) if k < without.parts.len() => drop(without.parts.remove(k)),
            Item::Track(k) if k < without.tracks.len() => drop(without.tracks.remove(k)),
            _ => {}
        }
        without
    }

    fn with(&self, item: Item, part: impl FnOnce(&Primitive) -> Primitive, track: impl FnOnce(&mut Track)) -> Self {
        let mut with = self.clone();
        match item {
            Item::Part(k) => {
                if let Some(found) = with.parts.get_mut(k) {
                    found.primitive = part(&found.primitive);
                }
            }
            Item::Track(k) => {
                if let Some(found) = with.tracks.get_mut(k) {
                    track(found);
                }
            }
        }
        with
    }
}

#[cfg(test)]
mod tests {
    use super::super::Part;
    use super::*;

    #[test]
    fn parts_and_tracks_are_taken_hold_of_alike() {
        let circle = Primitive::Circle { center: [0.0, 0.0], radius: 10.0 };
        let drawing = Drawing {
            parts: vec![Part::joined(circle)],
            tracks: vec![vec![[-5.0, 0.0], [5.0, 0.0]], vec![[-5.0, 4.0], [5.0, 4.0], [5.0, 9.0]]],
        };
        assert_eq!(drawing.under([0.0, 0.5], 1.0), Some(Item::Track(0)));
        assert_eq!(drawing.under([0.0, 2.0], 1.0), Some(Item::Part(0)));
        assert_eq!(drawing.under([20.0, 0.0], 1.0), None);
        let [part, track] = [Item::Part(0), Item::Track(1)];
        assert_eq!(drawing.middles(track), [[0.0, 4.0], [5.0, 6.5]]);
        assert!(drawing.middles(part).is_empty());
        for item in [part, track] {
            let moved = drawing.with_moved(item, [1.0, 2.0]);
            assert_eq!(moved.handles(item)[0], [drawing.handles(item)[0][0] + 1.0, drawing.handles(item)[0][1] + 2.0]);
            assert_eq!(moved.with_moved(item, [-1.0, -2.0]), drawing);
            assert!(!drawing.without(item).without(Item::Track(0)).has(item));
        }
        let longer = drawing.with_point(track, 1, [6.0, 6.0]);
        assert_eq!(longer.handles(track)[2], [6.0, 6.0]);
        assert_eq!(longer.without_point(track, 2), Some(drawing.clone()));
        assert_eq!(longer.with_pulled(track, 2, [7.0, 6.0], 0.1).handles(track)[2], [7.0, 6.0]);
        assert_eq!(drawing.without_point(Item::Track(0), 0), None);
        assert_eq!(drawing.without_point(part, 0), None);
        // What is not there changes nothing.
        for none in [Item::Part(7), Item::Track(7)] {
            assert!(drawing.handles(none).is_empty() && drawing.without_point(none, 0).is_none());
            assert_eq!((drawing.with_moved(none, [1.0; 2]), drawing.without(none)), (drawing.clone(), drawing.clone()));
        }
    }
}
