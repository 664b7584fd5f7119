//! A figure on a sheet of paper or a card that a picture shows.

use super::pixels::Pixels;
use super::sheet::Sheet;
use super::traced::{Traced, traced};
use crate::outline::readers::Painting;
use crate::outline::regions::{self, Shapes};
use crate::outline::{Aside, Background, Ground, Note, OutlineError, Why, polygon};

/// How far within the edge of a sheet a figure is looked for, as a part of the picture's longer side: the edge itself is neither.
const EDGE: f64 = 0.012;
/// What lies on a sheet covers this part of it.
const COVERS: std::ops::RangeInclusive<f64> = 0.03..=0.92;
/// Part of what lies on a sheet that must be in one piece.
const FIGURE: f64 = 0.6;
/// The darkest channel of a card's colour that is white.
const WHITE: f64 = 0.88;
/// Paper in a photo has channels as near to each other as this, and is brighter than what it lies on by as much.
const GREY: f64 = 0.25;
const BRIGHTER: f64 = 0.12;

/// What lies on a sheet.
pub(super) struct OnSheet {
    traced: Traced,
    pub level: f64,
    pub ground: Ground,
    /// Whether the figure is the silhouette, and not the sheet.
    pub counts: bool,
    sheet: Shapes,
    /// Width over height of a sheet that was straightened.
    straightened: Option<f64>,
}

impl OnSheet {
    pub fn take(self, painting: &mut Painting) {
        painting.notes.insert(0, Note::Background(self.ground));
        if let Some(width_to_height) = self.straightened {
            painting.notes.push(Note::Straightened { width_to_height });
        }
        painting
            .asides
            .push(Aside { why: Why::Background, areas: regions::difference(&self.sheet, &self.traced.shapes) });
        self.traced.take(painting);
    }
}

/// The figure within what was found in a picture, if that is a sheet or a card with a figure on it. `around`: the colour of what it lies on.
pub(super) fn on_sheet(
    pixels: &Pixels,
    found: &Traced,
    around: Option<[f64; 3]>,
    passes: usize,
    choice: Background,
) -> Result<Option<OnSheet>, OutlineError> {
    let size = [pixels.width as f64, pixels.height as f64];
    let Some(sheet) = Sheet::of(&found.shapes, size) else { return Ok(None) };
    let inner = sheet.shrunk(EDGE * size[0].max(size[1]));
    let Some(ring) = inner.first().and_then(|rings| rings.first()) else { return Ok(None) };
    let within: Vec<bool> = (0..pixels.values.len())
        .map(|k| {
            let (x, y) = (k % pixels.width, k / pixels.width);
            let opaque = !pixels.clear || pixels.values[k][3] > 0.5;
            opaque && polygon::contains(ring, [x as f64 + 0.5, -(y as f64 + 0.5)])
        })
        .collect();
    let Ok(ink) = pixels.ink(Some(&within), None) else { return Ok(None) };
    let Ok(mut on_it) = traced(ink.field.blurred(passes), ink.level) else { return Ok(None) };
    let solid = regions::union(on_it.shapes.iter().map(|rings| rings.iter().take(1).cloned().collect()).collect())?;
    let covered = regions::area(&solid);
    let whole = polygon::signed_area(&sheet.0);
    let largest = solid.iter().map(|rings| regions::piece_area(rings)).fold(0.0, f64::max);
    if !COVERS.contains(&(covered / whole)) || largest < FIGURE * covered {
        return Ok(None);
    }
    let paper = ink.colour.unwrap_or_default();
    let (dark, light) = (paper.into_iter().fold(1.0, f64::min), paper.into_iter().fold(0.0, f64::max));
    let is_paper = match around {
        None => dark >= WHITE,
        Some(table) => light - dark < GREY && dark > table.into_iter().fold(0.0, f64::max) + BRIGHTER,
    };
    let counts = is_paper || choice == Background::Drop;
    let ground = if around.is_none() { Ground::Card } else { Ground::Sheet };
    let mut straightened = None;
    let mut area = vec![vec![sheet.0.to_vec()]];
    if let Some((map, ratio)) = sheet.straightened([0.5 * size[0], -0.5 * size[1]]).filter(|_| sheet.is_askew()) {
        straightened = Some(ratio);
        for p in on_it.shapes.iter_mut().chain(&mut area).flatten().flatten() {
            *p = map.at(*p);
        }
    }
    Ok(Some(OnSheet { traced: on_it, level: ink.level, ground, counts, sheet: area, straightened }))
}
