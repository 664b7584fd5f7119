//! From the entities of a drawing to the curves that are seen.

use super::curves::Curve;
use super::entity::Entity;
use super::file::{File, Seen};
use super::hatch;
use super::place::Place;
use crate::outline::OutlineError;
use std::collections::BTreeMap;

/// The layer that every drawing has; in a block it is that of the insertion.
pub(super) const LAYER_0: &str = "0";
/// The layer that a piece's outline lies on in files of sewing patterns (ASTM D6673, AAMA).
pub(super) const CUT_LINE: &str = "1";
/// Deepest nesting of blocks.
const MAX_DEPTH: usize = 12;
/// Most entities after blocks are inserted.
const MAX_ENTITIES: usize = 300_000;
/// Kinds of entities that never bound anything and are not worth a word.
const NOTHING: [&str; 6] = ["ATTRIB", "ATTDEF", "SEQEND", "VERTEX", "VIEWPORT", "POINT"];

/// What is gathered while a drawing is walked.
pub(super) struct Drawn<'a> {
    file: &'a File<'a>,
    /// The layers that count, in lower case, as names of layers have no case; empty for all that are seen.
    chosen: &'a [String],
    /// The layers that something lies on, and whether they count.
    pub layers: BTreeMap<&'a str, bool>,
    pub curves: Vec<(Curve, Place)>,
    /// Curves around hatches.
    pub hatched: Vec<(Curve, Place)>,
    pub hatches: usize,
    /// What is not seen.
    pub hidden: usize,
    entities: usize,
    /// What cannot bound an area, by kind.
    pub skipped: BTreeMap<String, usize>,
}

impl<'a> Drawn<'a> {
    pub fn new(file: &'a File<'a>, chosen: &'a [String]) -> Self {
        let (layers, skipped) = (BTreeMap::new(), BTreeMap::new());
        let (curves, hatched) = (Vec::new(), Vec::new());
        Self { file, chosen, layers, curves, hatched, hatches: 0, hidden: 0, entities: 0, skipped }
    }

    /// Entities that stand for something on `around` where they lie on layer 0.
    pub fn draw(
        &mut self,
        entities: &'a [Entity<'a>],
        place: Place,
        around: &'a str,
        depth: usize,
    ) -> Result<(), OutlineError> {
        for entity in entities {
            self.entities += 1;
            if self.entities > MAX_ENTITIES || self.curves.len() > MAX_ENTITIES {
                return Err(OutlineError::TooComplex("has more than 300 000 entities"));
            }
            let layer = entity.text(8).filter(|name| *name != LAYER_0).unwrap_or(around);
            if entity.number(60) == Some(1.0) {
                self.hidden += 1;
                continue;
            }
            let own = if entity.is_flat() { Place::extruded(entity.normal()) } else { Place::IDENTITY };
            let place = place.after(&own);
            if entity.kind == "INSERT" {
                if self.chosen.is_empty() && self.file.seen(layer) == Seen::Frozen {
                    self.layers.insert(layer, false);
                    self.hidden += 1;
                } else {
                    self.insert(entity, place, layer, depth)?;
                }
                continue;
            }
            if NOTHING.contains(&entity.kind) || !self.counts(layer) {
                continue;
            }
            if entity.kind == "HATCH" {
                self.hatches += 1;
                self.hatched.extend(hatch::boundary(entity).into_iter().map(|curve| (curve, place)));
                continue;
            }
            if entity.kind == "POLYLINE" && entity.has_flag(64) {
                self.curves.extend(Curve::faces(entity).into_iter().map(|curve| (curve, place)));
                continue;
            }
            match Curve::of(entity) {
                Some(curve) => self.curves.push((curve, place)),
                None => *self.skipped.entry(entity.kind.to_lowercase()).or_default() += 1,
            }
        }
        Ok(())
    }

    /// Whether what lies on a layer counts; counts what does not because it is hidden.
    fn counts(&mut self, layer: &'a str) -> bool {
        let (chosen, file) = (self.chosen, self.file);
        let counts = *self.layers.entry(layer).or_insert_with(|| {
            if chosen.is_empty() { file.seen(layer) == Seen::Plainly } else { chosen.contains(&layer.to_lowercase()) }
        });
        self.hidden += usize::from(chosen.is_empty() && !counts);
        counts
    }

    /// The hidden layers that something lies on.
    pub fn hidden_layers(&self) -> Vec<String> {
        let hidden = self.layers.keys().filter(|layer| self.file.seen(layer) != Seen::Plainly);
        hidden.map(|layer| (*layer).to_owned()).collect()
    }

    /// A block, scaled, turned and repeated in rows and columns; `place` is that of its plane.
    fn insert(
        &mut self,
        entity: &'a Entity<'a>,
        place: Place,
        layer: &'a str,
        depth: usize,
    ) -> Result<(), OutlineError> {
        if depth >= MAX_DEPTH {
            return Err(OutlineError::TooComplex("has blocks nested more than twelve deep"));
        }
        let Some((base, content)) = entity.text(2).and_then(|name| self.file.blocks.get(name)) else { return Ok(()) };
        let scale = [41, 42, 43].map(|code| entity.number(code).unwrap_or(1.0));
        let turn = Place::turned(entity.number(50).unwrap_or(0.0).to_radians());
        let repeats = |code| entity.number(code).map_or(1, |n| n.clamp(1.0, 1e4) as usize);
        let steps = [44, 45].map(|code| entity.number(code).unwrap_or(0.0));
        let base = Place::moved(base.map(|v| -v));
        for row in 0..repeats(71) {
            for column in 0..repeats(70) {
                let shift = Place::moved([column as f64 * steps[0], row as f64 * steps[1], 0.0]);
                let there = place.after(&Place::moved(entity.point(10))).after(&turn).after(&shift);
                self.draw(content, there.after(&Place::scaled(scale)).after(&base), layer, depth + 1)?;
                self.entities += 1;
                if self.entities > MAX_ENTITIES {
                    return Err(OutlineError::TooComplex("has more than 300 000 entities"));
                }
            }
        }
        Ok(())
    }
}
