//! Painted areas to one clean outline: union, specks out, pieces and holes by choice, thin parts widened, smoothing,
//! simplification, placement.

use super::changes::{Changes, What};
use super::imported::{Asides, Imported, Why, placed};
use super::lines::{self, Lines};
use super::notes::Note;
use super::options::{Holes, Import, Pieces};
use super::readers::Painting;
use super::regions::{self, Shapes};
use super::simplify::simplify;
use super::thin::{self, Opened};
use super::{Outline, OutlineError, Point, even, gaps, islands, polygon, smooth};

/// Farthest that simplification may move the boundary, as a fraction of the longer side of the box: 0.03 mm on a
/// 300 mm plushie, a tenth of what scissors can follow. Larger values drop detail, smaller ones keep needless points.
const SIMPLIFY_FRACTION: f64 = 1e-4;
/// Islands and holes smaller than this part of the silhouette are specks: 20 mm^2 in 20 000 mm^2, the cross-section of
/// a pencil.
const SPECK_FRACTION: f64 = 1e-3;
/// All specks of a kind together are at most this part of the silhouette; the larger ones stay.
const SPECKS_FRACTION: f64 = 5e-3;
/// Silhouettes that fill less than this fraction of the square of their longer side are taken for lines.
const DEGENERATE_FRACTION: f64 = 1e-5;
/// Parts thinner than this fraction of the longer side of the box are hairlines, widened unless asked otherwise: 3 mm on
/// a 300 mm plushie. Thinner strips can be neither sewn nor meshed well.
const HAIRLINE_FRACTION: f64 = 0.01;
/// Area that widening hairlines may add, as a part of the silhouette.
const HAIRLINE_BUDGET: f64 = 0.01;
/// Area that hair may have, as a part of the silhouette: of more, it is what is drawn.
const HAIR_BUDGET: f64 = 0.2;
/// Diameter of the disc that joins a pinched point, as a fraction of the longer side of the box. Where two right angles meet
/// tip to tip, the chord from side to side is that over the square root of 2: a little wider than a hairline.
const PINCH_FRACTION: f64 = 1.5 * HAIRLINE_FRACTION;

/// One outline from what was painted.
pub(super) fn clean(painting: Painting, import: &Import) -> Result<Imported, OutlineError> {
    let Painting { shapes, unit_mm, notes, asides, evened } = painting;
    let mut changes = Changes { notes, ..Changes::default() };
    let mut aside = Asides(asides);
    let painted = shapes.len();
    let shapes = regions::union(shapes)?;
    let all = regions::area(&shapes);
    // Anything that is NaN or infinite is degenerate too.
    if shapes.is_empty() || !(all.is_finite() && all > 0.0) {
        return Err(OutlineError::Degenerate);
    }
    let units = Units::of(&shapes, unit_mm, import);
    if evened.points > 0 {
        changes.notes.push(Note::Evened { points: evened.points, within_mm: units.mm * evened.within });
    }
    let mut shapes = without_gaps(shapes, &units, import, &mut changes, &mut aside)?;
    if painted > 1 && import.gap_mm.is_none() {
        let before = regions::area(&shapes);
        let slits;
        (shapes, slits) = gaps::without_slits(shapes, gaps::SLIT_FRACTION * units.longer)?;
        let gained = regions::area(&shapes) / before - 1.0;
        changes.add(What::Slits, slits, gained, false);
        changes.unasked += gained.max(0.0);
    }
    let shapes = without_specks(shapes, all, &mut changes, &mut aside);
    let shapes = filled(shapes, &units, import, &mut changes, &mut aside)?;
    // Parts that touch in a point alone come as separate pieces.
    let (low, high) = regions::bounding_box(&shapes);
    let width = PINCH_FRACTION * (high[0] - low[0]).max(high[1] - low[1]);
    let before = regions::area(&shapes);
    let (shapes, touching) = thin::join_pinches(shapes, width)?;
    let widened_by = (regions::area(&shapes) - before) / before;
    changes.add(What::Pinches, touching, widened_by, false);
    changes.unasked += widened_by.max(0.0);
    let shapes = one_piece(shapes, import.pieces, &mut changes, &mut aside)?;
    if holes_area(&shapes) > regions::area(&shapes) {
        changes.notes.push(Note::MostlyLines);
    }
    let (low, high) = regions::bounding_box(&shapes);
    let longer = (high[0] - low[0]).max(high[1] - low[1]);
    let has_area = regions::area(&shapes) > DEGENERATE_FRACTION * longer * longer;
    if !has_area {
        return Err(OutlineError::Degenerate);
    }
    let scale = import.scale((low, high)).unwrap_or(unit_mm);
    changes.painted_mm2 = all * scale * scale;
    let shapes = placed(shapes, low, scale);
    let (shapes, longer) = (shapes, longer * scale);
    let shapes = shaped(shapes, longer, import, &mut changes)?;
    let (outline, box_mm) = outline(shapes, import)?;
    changes.outline_mm2 = outline.area();
    // Back to where it was before it was placed.
    let drawn_box = box_mm.map(|p| [p[0] / scale + low[0], p[1] / scale + low[1]]);
    Ok(Imported { asides: aside.placed(&outline, drawn_box), outline, changes, drawn_box, mesh: None, drawing: None })
}

/// The boundary of a silhouette in mm made fit to be sewn: thin parts widened, smoothed, simplified.
fn shaped(shapes: Shapes, longer: f64, import: &Import, changes: &mut Changes) -> Result<Shapes, OutlineError> {
    let area = regions::area(&shapes);
    // What was not asked for is measured against the shape after the last step that was.
    let mut reference = shapes.clone();
    // Offsets of polygons much finer than their distance take quadratic time.
    let shapes = simplified(shapes, 0.25 * SIMPLIFY_FRACTION * longer)?;
    let shapes = smooth_enough(shapes, longer, import, changes)?;
    let width = import.min_width_mm.unwrap_or(HAIRLINE_FRACTION * longer).min(longer);
    let shapes = if width > 0.0 {
        let (opened, shaved) = opened(shapes, width, import.min_width_mm.is_some(), changes)?;
        if shaved {
            reference.clone_from(opened.shapes());
        }
        widened(opened, width, import.min_width_mm.is_some(), changes)?
    } else {
        shapes
    };
    if import.min_width_mm.is_some() {
        reference.clone_from(&shapes);
    }
    let smooth = smoothed(shapes.clone(), import.smooth_mm.unwrap_or(0.0), changes)?;
    if import.smooth_mm.is_some_and(|smooth| smooth > 0.0) {
        changes.unasked += regions::unlike(&reference, &shapes) / area;
        reference.clone_from(&smooth);
    }
    let unjoined = regions::area(&smooth);
    let (shapes, pinches) = joined(smooth, longer)?;
    let shapes = simplified(shapes, SIMPLIFY_FRACTION * longer)?;
    changes.add(What::Pinches, pinches, (regions::area(&shapes) - unjoined) / area, false);
    changes.unasked += regions::unlike(&reference, &shapes) / area;
    Ok(shapes)
}

/// What a drawing's units measure, before it is known which of its parts count.
struct Units {
    low: Point,
    longer: f64,
    /// Millimetres in one.
    mm: f64,
}

impl Units {
    fn of(shapes: &Shapes, unit_mm: f64, import: &Import) -> Self {
        let (low, high) = regions::bounding_box(shapes);
        let mm = import.scale((low, high)).unwrap_or(unit_mm);
        Self { low, longer: (high[0] - low[0]).max(high[1] - low[1]), mm }
    }

    /// Where a place of the drawing lies in the outline, mm.
    fn place(&self, p: Point) -> Point {
        [0, 1].map(|axis| (p[axis] - self.low[axis]) * self.mm)
    }
}

/// Parts that all but touch joined.
fn without_gaps(
    shapes: Shapes,
    units: &Units,
    import: &Import,
    changes: &mut Changes,
    aside: &mut Asides,
) -> Result<Shapes, OutlineError> {
    // What is as wide as the drawing joins all of it.
    let gap = import.gap_mm.map_or(gaps::GAP_FRACTION * units.longer, |mm| (mm / units.mm).min(units.longer));
    let before = regions::area(&shapes);
    let gaps::Closed { shapes, bridges } = gaps::closed(shapes, gap, import.gap_mm.is_some())?;
    if !bridges.is_empty() {
        changes.notes.push(Note::GapsClosed { count: bridges.len(), gap_mm: gap * units.mm });
        if import.gap_mm.is_none() {
            changes.unasked += (regions::area(&shapes) / before - 1.0).max(0.0);
        }
        aside.add(Why::Closed, bridges);
    }
    Ok(shapes)
}

/// Drops the smallest islands and fills the smallest holes.
fn without_specks(shapes: Shapes, all: f64, changes: &mut Changes, aside: &mut Asides) -> Shapes {
    let limit = |mut areas: Vec<f64>| {
        areas.sort_by(f64::total_cmp);
        let mut sum = 0.0;
        let small = areas.iter().take_while(|area| {
            sum += **area;
            **area < SPECK_FRACTION * all && sum < SPECKS_FRACTION * all
        });
        let small: Vec<f64> = small.copied().collect();
        (small.last().copied().unwrap_or(-1.0), small.len(), small.iter().sum::<f64>() / all)
    };
    let ring_area = |ring: &Vec<Point>| polygon::signed_area(ring).abs();
    let (island, islands, lost) = limit(shapes.iter().map(|rings| regions::piece_area(rings)).collect());
    let (hole, holes, gained) = limit(shapes.iter().flat_map(|rings| rings.iter().skip(1)).map(ring_area).collect());
    changes.add(What::Specks, islands, lost, false);
    changes.add(What::Pinholes, holes, gained, false);
    changes.unasked += lost + gained;
    let (kept, specks): (Shapes, Shapes) = shapes.into_iter().partition(|rings| regions::piece_area(rings) > island);
    aside.add(Why::Specks, specks);
    kept.into_iter()
        .map(|rings| {
            rings.into_iter().enumerate().filter(|(k, r)| *k == 0 || ring_area(r) > hole).map(|x| x.1).collect()
        })
        .collect()
}

/// Without holes, where that is asked or the drawing is nothing but lines; what lay in a hole lies in the body then.
fn filled(
    shapes: Shapes,
    units: &Units,
    import: &Import,
    changes: &mut Changes,
    aside: &mut Asides,
) -> Result<Shapes, OutlineError> {
    if import.holes == Holes::Keep {
        return Ok(shapes);
    }
    let before = shapes.clone();
    let widest = import.join_mm.map_or(lines::OPENING_FRACTION * units.longer, |mm| mm / units.mm);
    let shapes = match lines::filled(shapes, widest)? {
        Lines::Body(shapes) => without_gaps_around(shapes, changes, aside)?,
        Lines::Open { shapes, opening } => {
            let (gap_mm, at) = (opening.opening * units.mm, units.place(opening.at));
            changes.notes.push(Note::NotClosed { gap_mm, at });
            shapes
        }
        Lines::Filled { shapes, opening, beside } => {
            if !beside.is_empty() {
                changes.notes.push(Note::OpenLines(beside.len()));
                aside.add(Why::Specks, beside);
            }
            changes.notes.push(match opening {
                Some(opening) => Note::Closed { gap_mm: opening.opening * units.mm, at: units.place(opening.at) },
                None => Note::LinesFilled,
            });
            aside.add(Why::Filled, regions::difference(&shapes, &before));
            // What is small beside the lines may be large beside what they enclose, and the other way round.
            let all = regions::area(&shapes);
            return Ok(without_specks(shapes, all, changes, aside));
        }
    };
    let count = shapes.iter().map(|rings| rings.len().saturating_sub(1)).sum();
    if import.holes != Holes::Fill || count == 0 {
        return Ok(shapes);
    }
    let shapes = regions::union(shapes.iter().map(|rings| rings.iter().take(1).cloned().collect()).collect())?;
    let area = regions::area(&before);
    changes.add(What::Holes, count, (regions::area(&shapes) - area) / area, true);
    aside.add(Why::Filled, regions::difference(&shapes, &before));
    Ok(shapes)
}

/// Holes filled that other pieces take up.
fn without_gaps_around(shapes: Shapes, changes: &mut Changes, aside: &mut Asides) -> Result<Shapes, OutlineError> {
    let Some((joined, count)) = islands::joined(&shapes)? else { return Ok(shapes) };
    changes.notes.push(Note::GapsAround(count));
    aside.add(Why::Filled, regions::difference(&joined, &shapes));
    Ok(joined)
}

fn holes_area(shapes: &Shapes) -> f64 {
    shapes.iter().flat_map(|rings| rings.iter().skip(1)).map(|ring| polygon::signed_area(ring).abs()).sum()
}

fn one_piece(
    mut shapes: Shapes,
    choice: Pieces,
    changes: &mut Changes,
    aside: &mut Asides,
) -> Result<Shapes, OutlineError> {
    let pieces = shapes.len();
    if pieces <= 1 {
        return Ok(shapes);
    }
    let all = regions::area(&shapes);
    // The first of equally large ones.
    shapes.sort_by(|a, b| regions::piece_area(b).total_cmp(&regions::piece_area(a)));
    let largest = regions::piece_area(&shapes[0]) / all;
    if choice == Pieces::Refuse {
        return Err(OutlineError::Pieces { pieces, largest: 100.0 * largest });
    }
    aside.add(Why::Pieces, shapes.split_off(1));
    changes.add(What::Pieces, pieces - 1, 1.0 - largest, true);
    Ok(shapes)
}

/// What is thin of a silhouette, hair shaved off where there is much of it and a width is not asked for; whether it was.
fn opened(shapes: Shapes, width: f64, asked: bool, changes: &mut Changes) -> Result<(Opened, bool), OutlineError> {
    let opened = Opened::of(shapes, width);
    if asked {
        return Ok((opened, false));
    }
    let Some((smooth, hairs)) = opened.shaved()? else { return Ok((opened, false)) };
    let cut = regions::unlike(opened.shapes(), &smooth) / regions::area(opened.shapes());
    if cut > HAIR_BUDGET {
        return Ok((opened, false));
    }
    changes.add(What::Hairs, hairs, cut, false);
    Ok((Opened::of(smooth, width), true))
}

fn widened(opened: Opened, width: f64, asked: bool, changes: &mut Changes) -> Result<Shapes, OutlineError> {
    let shapes = opened.shapes().clone();
    let before = regions::area(&shapes);
    let budget = if asked { f64::INFINITY } else { HAIRLINE_BUDGET * before };
    let thin::Widened { shapes: wide, parts, kept } = opened.widened(budget)?;
    if wide.len() != 1 {
        return Ok(shapes);
    }
    changes.add(What::ThinParts, parts, (regions::area(&wide) - before) / before, asked);
    if kept > 0 {
        changes.notes.push(Note::ThinParts { count: kept, width_mm: width });
    }
    Ok(wide)
}

fn smoothed(shapes: Shapes, tolerance: f64, changes: &mut Changes) -> Result<Shapes, OutlineError> {
    if tolerance <= 0.0 {
        return Ok(shapes);
    }
    let smooth = smooth::smooth(shapes.clone(), tolerance)?;
    changes.add(What::Smoothing, 1, regions::unlike(&shapes, &smooth) / regions::area(&shapes), true);
    Ok(smooth)
}

/// Evened where it is rougher than scissors can follow, unless smoothing is asked for or refused.
fn smooth_enough(shapes: Shapes, longer: f64, import: &Import, changes: &mut Changes) -> Result<Shapes, OutlineError> {
    let within = even::EVEN_FRACTION * longer;
    if import.smooth_mm.is_some() || !even::is_rough(&shapes, within) {
        return Ok(shapes);
    }
    let points = shapes.iter().flatten().map(Vec::len).sum();
    let smooth = smooth::smooth(shapes, within)?;
    changes.notes.retain(|note| !matches!(note, Note::Evened { .. }));
    changes.notes.push(Note::Evened { points, within_mm: within });
    Ok(smooth)
}

/// Without points in which the boundary touches itself.
fn joined(shapes: Shapes, longer: f64) -> Result<(Shapes, usize), OutlineError> {
    let (shapes, joined) = thin::join_pinches(shapes, PINCH_FRACTION * longer)?;
    match thin::pinches(&shapes).first() {
        Some(&[x, y]) => Err(OutlineError::Pinched { x, y }),
        None => Ok((shapes, joined)),
    }
}

/// Simplified to `tolerance`; as it was where that would make the boundary touch itself.
fn simplified(shapes: Shapes, tolerance: f64) -> Result<Shapes, OutlineError> {
    let thin: Shapes =
        shapes.iter().map(|rings| rings.iter().map(|ring| simplify(ring, tolerance)).collect()).collect();
    if thin.iter().flatten().any(|ring| ring.len() < 3) {
        return Ok(shapes);
    }
    let clean = regions::union(thin)?;
    let sound = clean.len() == shapes.len()
        && clean.iter().map(Vec::len).eq(shapes.iter().map(Vec::len))
        && thin::pinches(&clean).is_empty();
    Ok(if sound { clean } else { shapes })
}

/// The one region left, its lower left corner at the origin, as large as asked (the steps before may have moved its rim), and
/// the corners of its box before that.
fn outline(shapes: Shapes, import: &Import) -> Result<(Outline, [Point; 2]), OutlineError> {
    let (low, high) = regions::bounding_box(&shapes);
    let scale = import.scale((low, high)).unwrap_or(1.0);
    let mut rings = match <[_; 1]>::try_from(placed(shapes, low, scale)) {
        Ok([rings]) => rings,
        Err(shapes) if shapes.is_empty() => return Err(OutlineError::Degenerate),
        Err(shapes) => return Err(OutlineError::Pieces { pieces: shapes.len(), largest: f64::NAN }),
    };
    if !rings.iter().flatten().flatten().all(|v| v.is_finite()) {
        return Err(OutlineError::Degenerate);
    }
    let holes = rings.split_off(1);
    Ok((Outline { outer: rings.pop().unwrap_or_default(), holes }, [low, high]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, s: f64) -> Vec<Vec<Point>> {
        vec![vec![[x, y], [x + s, y], [x + s, y + s], [x, y + s]]]
    }

    fn painting(shapes: Shapes, unit_mm: f64) -> Painting {
        Painting { shapes, unit_mm, ..Painting::default() }
    }

    #[test]
    fn overlapping_areas_become_one_and_specks_go() {
        let shapes = vec![square(5.0, 5.0, 10.0), square(10.0, 10.0, 10.0), square(40.0, 0.0, 0.1)];
        let Imported { outline, changes, .. } = clean(painting(shapes, 2.0), &Import::default()).unwrap();
        assert_eq!(outline.outer.len(), 8);
        assert!((outline.area() - 4.0 * 175.0).abs() < 1e-6);
        let (low, high) = outline.bounding_box();
        assert!(low == [0.0, 0.0] && (high[0] - 30.0).abs() < 1e-6 && (high[1] - 30.0).abs() < 1e-6);
        assert_eq!(changes.steps.len(), 1);
        assert_eq!((changes.steps[0].what, changes.steps[0].count), (What::Specks, 1));
        assert!((changes.unasked - 0.01 / 175.0).abs() < 1e-5);
    }

    #[test]
    fn pieces_and_holes_are_kept_by_choice() {
        let ring = |x: f64, s: f64| {
            let hole: Vec<Point> = square(x + 0.25 * s, 0.25 * s, 0.5 * s)[0].iter().rev().copied().collect();
            vec![square(x, 0.0, s)[0].clone(), hole]
        };
        let shapes = || vec![ring(0.0, 20.0), ring(30.0, 10.0), square(9.0, 9.0, 2.0)];
        let refused = clean(painting(shapes(), 1.0), &Import::default());
        let Err(OutlineError::Pieces { pieces: 3, largest }) = refused else { panic!("{refused:?}") };
        assert!((largest - 100.0 * 300.0 / 379.0).abs() < 1e-6);
        let largest = Import { pieces: Pieces::Largest, ..Import::default() };
        let kept = clean(painting(shapes(), 1.0), &largest).unwrap();
        assert_eq!((kept.outline.holes.len(), kept.changes.steps[0].count), (1, 2));
        let fill = Import { holes: Holes::Fill, ..largest };
        let kept = clean(painting(shapes(), 1.0), &fill).unwrap();
        assert!((kept.outline.area() - 400.0).abs() < 1e-6 && kept.outline.holes.is_empty());
        assert!(kept.changes.unasked < 1e-9, "{:?}", kept.changes);
    }

    #[test]
    fn a_hole_that_touches_the_rim_in_a_point_is_parted_from_it() {
        let outer = vec![[0.0, 0.0], [80.0, 0.0], [80.0, 80.0], [40.0, 80.0], [0.0, 80.0]];
        let hole = vec![[40.0, 80.0], [60.0, 40.0], [40.0, 20.0], [20.0, 40.0]];
        let shapes = vec![vec![outer, hole]];
        let Imported { outline, changes, .. } = clean(painting(shapes, 1.0), &Import::default()).unwrap();
        assert_eq!(outline.holes.len(), 1);
        assert!(changes.unasked < 0.02 && !changes.steps.is_empty(), "{changes:?}");
    }

    #[test]
    fn numbers_that_are_none_are_degenerate() {
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let shapes = vec![vec![vec![[0.0, 0.0], [bad, 0.0], [0.0, bad]]]];
            assert_eq!(clean(painting(shapes, 1.0), &Import::default()).err(), Some(OutlineError::Degenerate), "{bad}");
        }
    }
}
