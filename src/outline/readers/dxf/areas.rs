//! Closed lines become areas: copies go, those that cross are united, those within others are holes, a frame around all is left out.

use crate::outline::grid::Grid;
use crate::outline::readers::ground::{self, Mark};
use crate::outline::regions::{self, Shapes};
use crate::outline::{Aside, Background, Note, OutlineError, Point, Why, polygon};
use i_overlay::core::fill_rule::FillRule;
use std::collections::BTreeMap;

/// A closed line and its copy lie so near each other, as a fraction of the drawing's size: less than scissors can part.
const COPY_FRACTION: f64 = 1e-3;
/// Closed lines that are compared with each other at most; more are taken as they are, each within another a hole.
const MAX_COMPARED: usize = 4000;
/// Pairs of sides that are tried for crossings at most.
const MAX_PAIRS: usize = 40_000_000;

/// What closed lines bound.
pub(super) struct Areas {
    pub shapes: Shapes,
    pub notes: Vec<Note>,
    pub asides: Vec<Aside>,
    pub copies: usize,
}

/// The areas within closed lines of a drawing of a size.
pub(super) fn of(contours: Vec<Vec<Point>>, size: f64, background: Background) -> Result<Areas, OutlineError> {
    if contours.len() > MAX_COMPARED {
        let shapes = regions::resolve(&contours, FillRule::EvenOdd)?;
        return Ok(Areas { shapes, notes: Vec::new(), asides: Vec::new(), copies: 0 });
    }
    let before = contours.len();
    let contours = without_copies(contours, COPY_FRACTION * size);
    let mut areas =
        Areas { shapes: Shapes::new(), notes: Vec::new(), asides: Vec::new(), copies: before - contours.len() };
    let group = crossing(&contours);
    let mut groups: BTreeMap<usize, Vec<Vec<Point>>> = BTreeMap::new();
    for (k, contour) in contours.into_iter().enumerate() {
        groups.entry(group[k]).or_default().push(counter_clockwise(contour));
    }
    let united: usize = groups.values().map(Vec::len).filter(|&n| n > 1).sum();
    if united > 0 {
        areas.notes.push(Note::United(united));
    }
    let groups: Vec<Shapes> =
        groups.values().map(|rings| regions::resolve(rings, FillRule::NonZero)).collect::<Result<_, _>>()?;
    let groups = without_frames(groups, background, &mut areas)?;
    let holes = depths(&groups).into_iter().filter(|depth| depth % 2 == 1).count();
    if holes > 0 {
        areas.notes.push(Note::HolesWithin(holes));
    }
    let rings = groups.into_iter().flatten().flatten().collect();
    areas.shapes = regions::resolve(&rings, FillRule::EvenOdd)?;
    Ok(areas)
}

fn counter_clockwise(mut contour: Vec<Point>) -> Vec<Point> {
    if polygon::signed_area(&contour) < 0.0 {
        contour.reverse();
    }
    contour
}

/// Without lines that lie on larger or earlier ones all around.
fn without_copies(contours: Vec<Vec<Point>>, reach: f64) -> Vec<Vec<Point>> {
    let mut kept: Vec<(Vec<Point>, (Point, Point), f64)> = Vec::new();
    for contour in contours {
        let (low, high) = polygon::bounding_box(&contour);
        let area = polygon::signed_area(&contour).abs();
        let near = |a: Point, b: Point| (a[0] - b[0]).abs() <= reach && (a[1] - b[1]).abs() <= reach;
        // What is hardly larger than the reach is no copy of its neighbour.
        let large = (high[0] - low[0]).min(high[1] - low[1]) > 10.0 * reach;
        let is_copy = kept.iter().any(|(other, (from, to), other_area)| {
            let exact = low == *from && high == *to && (area - other_area).abs() <= 1e-9 * area;
            exact
                || (large
                    && near(low, *from)
                    && near(high, *to)
                    && lies_on(&contour, other, reach)
                    && lies_on(other, &contour, reach))
        });
        if !is_copy {
            kept.push((contour, (low, high), area));
        }
    }
    kept.into_iter().map(|(contour, ..)| contour).collect()
}

fn lies_on(a: &[Point], b: &[Point], reach: f64) -> bool {
    let grid = Grid::new(std::iter::once(b));
    a.iter().all(|p| grid.is_near(*p, reach))
}

/// For each closed line the number of the group of lines that it crosses, directly or by way of others.
fn crossing(contours: &[Vec<Point>]) -> Vec<usize> {
    let mut group: Vec<usize> = (0..contours.len()).collect();
    let root = |group: &mut Vec<usize>, mut k: usize| {
        while group[k] != k {
            group[k] = group[group[k]];
            k = group[k];
        }
        k
    };
    let boxes: Vec<(Point, Point)> = contours.iter().map(|contour| polygon::bounding_box(contour)).collect();
    let mut pairs = 0;
    for a in 0..contours.len() {
        for b in a + 1..contours.len() {
            let apart = (0..2).any(|i| boxes[a].0[i] > boxes[b].1[i] || boxes[b].0[i] > boxes[a].1[i]);
            if apart || root(&mut group, a) == root(&mut group, b) {
                continue;
            }
            if pairs < MAX_PAIRS && cross(&contours[a], &contours[b], (boxes[a], boxes[b]), &mut pairs) {
                let (a, b) = (root(&mut group, a), root(&mut group, b));
                group[a.max(b)] = a.min(b);
            }
        }
    }
    (0..contours.len()).map(|k| root(&mut group, k)).collect()
}

/// Whether two closed lines cross: each side of one that reaches into the box of both is tried on those of the other.
fn cross(a: &[Point], b: &[Point], (of_a, of_b): ((Point, Point), (Point, Point)), pairs: &mut usize) -> bool {
    let low = [0, 1].map(|i| of_a.0[i].max(of_b.0[i]));
    let high = [0, 1].map(|i| of_a.1[i].min(of_b.1[i]));
    let inside = |(p, q): &(Point, Point)| (0..2).all(|i| p[i].min(q[i]) <= high[i] && p[i].max(q[i]) >= low[i]);
    let mut sides: Vec<(Point, Point)> = polygon::sides(b).filter(inside).collect();
    // By their lower end, so that the search can stop.
    sides.sort_by(|s, t| s.0[1].min(s.1[1]).total_cmp(&t.0[1].min(t.1[1])));
    let turn = |p: Point, q: Point, r: Point| (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
    polygon::sides(a).filter(inside).any(|(p, q)| {
        let (from, to) = (p[1].min(q[1]), p[1].max(q[1]));
        let end = sides.partition_point(|s| s.0[1].min(s.1[1]) <= to);
        *pairs += end;
        sides[..end]
            .iter()
            .filter(|s| s.0[1].max(s.1[1]) >= from)
            .any(|&(r, s)| turn(p, q, r) * turn(p, q, s) < 0.0 && turn(r, s, p) * turn(r, s, q) < 0.0)
    })
}

/// How many others each group lies within.
fn depths(groups: &[Shapes]) -> Vec<usize> {
    let boxes: Vec<(Point, Point)> = groups.iter().map(regions::bounding_box).collect();
    let within = |a: usize, b: usize| {
        let held = (0..2).all(|i| boxes[a].0[i] >= boxes[b].0[i] && boxes[a].1[i] <= boxes[b].1[i]);
        held && a != b && {
            // They do not cross, but may touch: most points tell.
            let outer: Vec<&Vec<Point>> = groups[b].iter().filter_map(|rings| rings.first()).collect();
            let points: Vec<&Point> = groups[a].iter().filter_map(|rings| rings.first()).flatten().collect();
            let step = (points.len() / 9).max(1);
            let (mut inside, mut all) = (0, 0);
            for p in points.into_iter().step_by(step) {
                all += 1;
                inside += usize::from(outer.iter().any(|ring| polygon::contains(ring, *p)));
            }
            2 * inside > all
        }
    };
    (0..groups.len()).map(|a| (0..groups.len()).filter(|&b| within(a, b)).count()).collect()
}

/// Without rectangles around everything.
fn without_frames(groups: Vec<Shapes>, background: Background, areas: &mut Areas) -> Result<Vec<Shapes>, OutlineError> {
    let is_title = titles(&groups);
    let all = groups.clone();
    let (groups, titles): (Vec<_>, Vec<_>) = groups.into_iter().zip(is_title).partition(|(_, title)| !title);
    let [groups, titles]: [Vec<Shapes>; 2] =
        [groups, titles].map(|of| of.into_iter().map(|(group, _)| group).collect());
    let depths = depths(&groups);
    let boxes: Vec<(Point, Point)> = groups.iter().map(regions::bounding_box).collect();
    let within = |i: usize, k: usize| i != k && is_within(boxes[i], boxes[k]);
    // As they would be drawn: what is around others is a line, what lies within an area.
    let marks = groups.iter().enumerate().map(|(k, area)| {
        let clear = || (0..groups.len()).filter(|&i| within(i, k)).all(|i| !runs_along(&groups[i], boxes[k]));
        let around = depths[k] < MAX_FRAMES && is_rectangle(area) && clear();
        Mark { area: if around { as_line(area) } else { area.clone() }, opacity: 1.0, white: false }
    });
    let marks: Vec<Mark> = marks.collect();
    let boxes: Vec<(Point, Point)> = marks.iter().map(|mark| regions::bounding_box(&mark.area)).collect();
    let (figure, mut frames, notes) = ground::part(marks, None, background)?;
    if frames.is_empty() {
        return Ok(all);
    }
    areas.notes.extend(notes);
    frames.extend(titles.into_iter().flatten());
    areas.asides.push(Aside { why: Why::Background, areas: frames });
    let kept: Vec<(Point, Point)> = figure.iter().map(|mark| regions::bounding_box(&mark.area)).collect();
    Ok(groups.into_iter().zip(boxes).filter(|(_, own)| kept.contains(own)).map(|(group, _)| group).collect())
}

/// Which groups are fields of a drawing's title block: small rectangles that lie along a frame with a figure in it, and what is in them.
fn titles(groups: &[Shapes]) -> Vec<bool> {
    let boxes: Vec<(Point, Point)> = groups.iter().map(regions::bounding_box).collect();
    let sizes: Vec<f64> = groups.iter().map(regions::area).collect();
    let frames: Vec<usize> = (0..groups.len()).filter(|&k| is_rectangle(&groups[k])).collect();
    let within = |i: usize, k: usize| i != k && is_within(boxes[i], boxes[k]);
    let is_field = |i: usize, k: usize| {
        within(i, k) && sizes[i] < TITLE * sizes[k] && is_rectangle(&groups[i]) && runs_along(&groups[i], boxes[k])
    };
    let has_figure = |i: usize, k: usize| {
        (0..groups.len())
            .any(|j| within(j, k) && !within(j, i) && sizes[j] > sizes[i] && !runs_along(&groups[j], boxes[k]))
    };
    let fields: Vec<usize> =
        (0..groups.len()).filter(|&i| frames.iter().any(|&k| is_field(i, k) && has_figure(i, k))).collect();
    (0..groups.len()).map(|i| fields.iter().any(|&field| i == field || within(i, field))).collect()
}

fn is_within(inner: (Point, Point), outer: (Point, Point)) -> bool {
    (0..2).all(|axis| inner.0[axis] >= outer.0[axis] && inner.1[axis] <= outer.1[axis])
}

/// A field of a title block covers less than this part of the frame.
const TITLE: f64 = 0.12;
/// Frames within each other.
const MAX_FRAMES: usize = 3;
/// Part of its box that a rectangle fills.
const RECTANGLE: f64 = 0.998;
/// Part of its outline that an area within a frame may have on it.
const SHARED: f64 = 0.25;
/// Width of a frame's line as a part of its shorter side.
const LINE: f64 = 0.004;

fn is_rectangle(area: &Shapes) -> bool {
    let (low, high) = regions::bounding_box(area);
    area.len() == 1 && area[0].len() == 1 && regions::area(area) > RECTANGLE * (high[0] - low[0]) * (high[1] - low[1])
}

/// Whether an area has much of its outline on the sides of a rectangle: then that is no frame, but an area of which this is cut off.
fn runs_along(area: &Shapes, (low, high): (Point, Point)) -> bool {
    let near = LINE * (high[0] - low[0]).min(high[1] - low[1]);
    let on = |p: Point, q: Point| {
        (0..2).any(|i| [low[i], high[i]].iter().any(|side| [p, q].iter().all(|end| (end[i] - side).abs() < near)))
    };
    let sides = || area.iter().filter_map(|rings| rings.first()).flat_map(|ring| polygon::sides(ring));
    let long: f64 = sides().map(|(p, q)| polygon::length(p, q)).sum();
    let along: f64 = sides().filter(|&(p, q)| on(p, q)).map(|(p, q)| polygon::length(p, q)).sum();
    along > SHARED * long
}

fn as_line(area: &Shapes) -> Shapes {
    let (low, high) = regions::bounding_box(area);
    let width = LINE * (high[0] - low[0]).min(high[1] - low[1]);
    let inner = ground::rectangle(low.map(|v| v + width), high.map(|v| v - width));
    regions::difference(area, &vec![vec![inner]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn circle(x: f64, y: f64, r: f64) -> Vec<Point> {
        (0..200).map(|i| TAU * f64::from(i) / 200.0).map(|a| [x + r * a.cos(), y + r * a.sin()]).collect()
    }

    fn areas(contours: Vec<Vec<Point>>) -> (f64, Vec<Note>, usize) {
        let found = of(contours, 200.0, Background::Found).unwrap();
        (regions::area(&found.shapes), found.notes, found.copies)
    }

    #[test]
    fn lines_that_cross_are_one_area_and_lines_within_are_holes() {
        // Two circles of radius 50 whose middles are 50 apart cover 2 pi / 3 + sqrt(3) / 2 too little of both.
        let both = 2500.0 * (4.0 * PI / 3.0 + 3_f64.sqrt() / 2.0);
        let (area, notes, _) = areas(vec![circle(0.0, 0.0, 50.0), circle(50.0, 0.0, 50.0), circle(25.0, 0.0, 10.0)]);
        assert!((area / (both - 100.0 * PI) - 1.0).abs() < 1e-3, "{area}");
        assert_eq!(notes, [Note::United(2), Note::HolesWithin(1)]);
    }

    #[test]
    fn copies_and_near_copies_count_once() {
        let near = circle(0.05, 0.0, 50.0);
        let within: Vec<Point> = circle(0.0, 0.0, 49.9).into_iter().rev().collect();
        let (area, notes, copies) = areas(vec![circle(0.0, 0.0, 50.0), circle(0.0, 0.0, 50.0), near, within]);
        assert!((area / (2500.0 * PI) - 1.0).abs() < 1e-3 && notes.is_empty());
        assert_eq!(copies, 3);
    }

    #[test]
    fn frames_around_a_figure_are_left_out_and_a_plate_with_holes_is_not() {
        let frame = |s: f64| ground::rectangle([-s, -s], [s, s]);
        let (area, notes, _) = areas(vec![frame(100.0), circle(0.0, 0.0, 50.0), frame(95.0)]);
        assert!((area / (2500.0 * PI) - 1.0).abs() < 1e-3, "{area} {notes:?}");
        assert_eq!(notes.len(), 2);
        let (area, notes, _) = areas(vec![frame(100.0), circle(60.0, 60.0, 8.0), circle(-60.0, 60.0, 8.0)]);
        assert!((area / (40_000.0 - 128.0 * PI) - 1.0).abs() < 1e-3, "{area}");
        assert_eq!(notes, [Note::HolesWithin(2)]);
        // A title block in the corner of its frame, with a cell.
        let block = ground::rectangle([40.0, -95.0], [95.0, -75.0]);
        let cell = ground::rectangle([45.0, -90.0], [60.0, -80.0]);
        let (area, ..) = areas(vec![frame(100.0), block, cell, circle(0.0, 0.0, 50.0), frame(95.0)]);
        assert!((area / (2500.0 * PI) - 1.0).abs() < 1e-3, "{area}");
        // A plate with a corner cut off.
        let square = |side: f64| ground::rectangle([0.0; 2], [side; 2]);
        let (area, notes, _) = areas(vec![square(120.0), square(100.0)]);
        assert!((area - 4400.0).abs() < 1.0, "{area} {notes:?}");
    }
}
