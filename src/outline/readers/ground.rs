//! What lies below everything else and is no part of the figure: pages, sheets, cards, frames.
//!
//! Areas are judged in painting order, after clips and masks, by what they cover. What covers the page is a background. A rectangle that
//! all else lies on, and a line around all else, are one if the rest is a figure, and where there is little doubt: of white, sharp
//! corners and the size of the page it has two. A television or a signpost is a rectangle with a figure on it too; so of all others a note tells
//! that they count, and how they are left out.

use crate::outline::regions::{self, Shapes};
use crate::outline::{Background, Ground, Note, OutlineError, Point, polygon};

/// Something reaches an edge of the page within this part of the page's side.
const PAGE_FRACTION: f64 = 0.01;
/// A shape that fills so much of its box is a rectangle; less, and its corners are round.
const SHARP: f64 = 0.998;
/// A shape that fills so much of its box is a rectangle with round corners (a circle fills 0.785).
const ROUND: f64 = 0.88;
/// A rectangle whose sides measure so much of the page's was made as its background.
const PAGE_LIKE: f64 = 0.9;
/// Most shapes that make up a background together: sky, hills, water.
const MAX_SPLIT: usize = 8;
/// A line around everything covers less than this part of what it surrounds.
const FRAME: f64 = 0.25;
/// What lies on a sheet covers this part of it: less is a detail of a body, more is the outline of the body itself.
const COVERS: std::ops::RangeInclusive<f64> = 0.03..=0.92;
/// The middle of a line around a sheet runs along the sheet's rim: it surrounds as much as that, within this part of it.
const BORDER: f64 = 0.06;
/// Part of what lies on a sheet that must be in one piece, as a figure is and the letters on a button are not.
const FIGURE: f64 = 0.6;
/// Of the room within a frame: frames lie within frames.
const FILLED: f64 = 0.97;
/// Part of the room that paper leaves for a figure which that fills.
const FILLS: f64 = 0.8;
/// Marks that are tried as such paper, from below: each is laid over all others, and a page that is traced in colours may have hundreds of its size.
const MAX_PAPERS: usize = 8;
/// How far a figure may reach beyond the sheet that it lies on, as a part of the sheet's side, and how much of it.
const BEYOND: f64 = 0.05;
const BEYOND_AREA: f64 = 0.02;
/// Of white, sharp corners and a size like the page's a sheet has so many.
const SIGNS: usize = 2;
/// Grounds that may lie on each other.
const MAX_GROUNDS: usize = 4;

/// An area as it is painted.
#[derive(Clone, Debug, Default)]
pub(super) struct Mark {
    pub area: Shapes,
    /// Of its most opaque place, 0 to 1.
    pub opacity: f32,
    /// Whether its colour is that of paper.
    pub white: bool,
}

/// Splits marks (in painting order) into the figure and what lies below it, with what there is to say. `page`: the corners of the box
/// that the drawing was made in, if it has one.
pub(super) fn part(
    marks: Vec<Mark>,
    page: Option<[Point; 2]>,
    choice: Background,
) -> Result<(Vec<Mark>, Shapes, Vec<Note>), OutlineError> {
    let mut notes = Vec::new();
    if choice == Background::Keep || marks.len() < 2 {
        return Ok((marks, Shapes::new(), notes));
    }
    let mut figure = marks;
    let mut below = Shapes::new();
    let mut drop = |figure: &mut Vec<Mark>, range: std::ops::Range<usize>| {
        below.extend(figure.drain(range).flat_map(|mark| mark.area));
    };
    if let Some(k) = page.map(|page| surrounding(&figure, page)).transpose()?.flatten() {
        notes.push(Note::Background(Ground::Page));
        drop(&mut figure, k..k + 1);
        return Ok((figure, below, notes));
    }
    let mut pages = 0;
    while let Some(count) = page.and_then(|page| covering(&figure, page)) {
        pages += count;
        drop(&mut figure, 0..count);
    }
    match pages {
        0 => {}
        1 => notes.push(Note::Background(Ground::Page)),
        _ => notes.push(Note::Background(Ground::Shapes(pages))),
    }
    for _ in 0..MAX_GROUNDS {
        let Some(Found { marks, ground, sure }) = ground(&figure, page)? else { break };
        if !sure && choice == Background::Found {
            notes.push(Note::GroundCounts(ground));
            break;
        }
        notes.push(Note::Background(ground));
        marks.into_iter().rev().for_each(|at| drop(&mut figure, at..at + 1));
    }
    Ok((figure, below, notes))
}

/// The mark that covers the page but for the figure, which the others are: so do programs that trace pictures draw paper.
fn surrounding(marks: &[Mark], page: [Point; 2]) -> Result<Option<usize>, OutlineError> {
    if marks.len() < 2 {
        return Ok(None);
    }
    let [low, high] = page;
    let slack = [0, 1].map(|axis| PAGE_FRACTION * (high[axis] - low[axis]));
    let reaches = |(_, mark): &(usize, &Mark)| {
        let (from, to) = regions::bounding_box(&mark.area);
        (0..2).all(|axis| from[axis] <= low[axis] + slack[axis] && to[axis] >= high[axis] - slack[axis])
    };
    for (k, mark) in marks.iter().enumerate().filter(reaches).take(MAX_PAPERS) {
        let (from, to) = regions::bounding_box(&mark.area);
        let whole = filled(&mark.area);
        let room = regions::difference(&whole, &mark.area);
        let covers = regions::area(&whole);
        let like_page = covers >= SHARP * (to[0] - from[0]) * (to[1] - from[1]);
        if !like_page || !COVERS.contains(&(regions::area(&room) / covers)) {
            continue;
        }
        let rest = marks.iter().enumerate().filter(|(i, _)| *i != k).flat_map(|(_, mark)| mark.area.iter().cloned());
        let rest = filled(&regions::union(rest.collect())?);
        let covered = regions::area(&rest);
        let fills = regions::area(&regions::intersection(&rest, &room)) >= FILLS * regions::area(&room);
        let hidden = k > 0 && regions::area(&regions::intersection(&rest, &mark.area)) > BEYOND_AREA * covered;
        let largest = rest.iter().max_by(|a, b| regions::piece_area(a).total_cmp(&regions::piece_area(b)));
        let is_figure = largest.is_some_and(|rings| {
            let (from, to) = polygon::bounding_box(&rings[0]);
            let area = regions::piece_area(rings);
            // What fills a rectangle in a frame may be a picture on a wall.
            area >= FIGURE * covered && (mark.white || area < ROUND * (to[0] - from[0]) * (to[1] - from[1]))
        });
        if fills && !hidden && is_figure {
            return Ok(Some(k));
        }
    }
    Ok(None)
}

/// How many marks from the lowest on cover the page together, as long as others lie on them.
fn covering(marks: &[Mark], page: [Point; 2]) -> Option<usize> {
    let [low, high] = page;
    let size = [high[0] - low[0], high[1] - low[1]];
    let window = vec![vec![rectangle(low, high)]];
    let mut together = Shapes::new();
    for (k, mark) in marks.iter().take(MAX_SPLIT).enumerate() {
        if k + 1 == marks.len() {
            return None;
        }
        together.extend(mark.area.iter().cloned());
        let (from, to) = regions::bounding_box(&together);
        let reaches = (0..2).all(|axis| {
            let slack = PAGE_FRACTION * size[axis];
            from[axis] <= low[axis] + slack && to[axis] >= high[axis] - slack
        });
        if !reaches {
            continue;
        }
        let (from, to) = ([0, 1].map(|i| from[i].max(low[i])), [0, 1].map(|i| to[i].min(high[i])));
        let box_area = (to[0] - from[0]) * (to[1] - from[1]);
        let shown = regions::intersection(&together, &window);
        if regions::area(&shown) >= SHARP * box_area {
            return Some(k + 1);
        }
    }
    None
}

/// What all other marks lie on or within.
struct Found {
    /// It and the line around it, in order.
    marks: Vec<usize>,
    ground: Ground,
    /// Whether it is surely no part of the figure.
    sure: bool,
}

/// The mark that all others lie on or within.
fn ground(marks: &[Mark], page: Option<[Point; 2]>) -> Result<Option<Found>, OutlineError> {
    if marks.len() < 2 {
        return Ok(None);
    }
    let boxes: Vec<(Point, Point)> = marks.iter().map(|mark| regions::bounding_box(&mark.area)).collect();
    for (k, mark) in marks.iter().enumerate() {
        let (low, high) = boxes[k];
        let slack = [0, 1].map(|axis| BEYOND * (high[axis] - low[axis]));
        let holds = boxes.iter().all(|(from, to)| {
            (0..2).all(|axis| from[axis] >= low[axis] - slack[axis] && to[axis] <= high[axis] + slack[axis])
        });
        let outer = filled(&mark.area);
        let whole = regions::area(&outer);
        let fills = whole / ((high[0] - low[0]) * (high[1] - low[1]));
        let frame = regions::area(&mark.area) < FRAME * whole;
        if !holds || outer.len() != 1 || fills.is_nan() || fills < ROUND || (k > 0 && !frame) {
            continue;
        }
        let border = if frame { Vec::new() } else { borders(marks, k, whole) };
        let is_rest = |i: &usize| *i != k && !border.contains(i);
        let rest = (0..marks.len()).filter(is_rest).flat_map(|i| marks[i].area.iter().cloned());
        let rest = filled(&regions::union(rest.collect())?);
        let covered: f64 = regions::area(&rest);
        let largest = rest.iter().map(|rings| regions::piece_area(rings)).fold(0.0, f64::max);
        // What fills a line up to its inner edge has it for its own outline.
        let (room, most) = if frame { (whole - regions::area(&mark.area), FILLED) } else { (whole, *COVERS.end()) };
        if !(*COVERS.start()..=most).contains(&(covered / room)) || largest < FIGURE * covered {
            continue;
        }
        if regions::area(&regions::difference(&rest, &outer)) > BEYOND_AREA * covered {
            continue;
        }
        let sharp = fills >= SHARP;
        let like_page = page
            .is_some_and(|[from, to]| (0..2).all(|axis| high[axis] - low[axis] >= PAGE_LIKE * (to[axis] - from[axis])));
        let ground = match (frame, sharp) {
            (true, _) => Ground::Frame,
            (false, true) => Ground::Sheet,
            (false, false) => Ground::Card,
        };
        let signs = [mark.white, sharp, like_page].into_iter().filter(|sign| *sign).count();
        // With a line around it, it may be drawn as a thing: a letter, a tile.
        let sure = frame || (signs >= SIGNS && (border.is_empty() || like_page));
        let mut marks = [vec![k], border].concat();
        marks.sort_unstable();
        return Ok(Some(Found { marks, ground, sure }));
    }
    Ok(None)
}

/// The lines along the rim of a mark that covers so much.
fn borders(marks: &[Mark], k: usize, whole: f64) -> Vec<usize> {
    let is_border = |i: &usize| {
        let around = regions::area(&filled(&marks[*i].area));
        let line = regions::area(&marks[*i].area);
        *i != k && line < FRAME * around && ((around - 0.5 * line) / whole - 1.0).abs() < BORDER
    };
    (0..marks.len()).filter(is_border).collect()
}

/// Without holes; what lay in one is part of it.
fn filled(area: &Shapes) -> Shapes {
    let outer: Shapes = area.iter().map(|rings| rings.iter().take(1).cloned().collect()).collect();
    if outer.len() < 2 { outer } else { regions::union(outer).unwrap_or_default() }
}

pub(super) fn rectangle(low: Point, high: Point) -> Vec<Point> {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// Whether the shapes are one upright rectangle that holds a box.
pub(super) fn holds_box(shapes: &Shapes, (low, high): (Point, Point)) -> bool {
    let [rings] = shapes.as_slice() else { return false };
    let [ring] = rings.as_slice() else { return false };
    let (from, to) = polygon::bounding_box(ring);
    ring.len() == 4
        && (0..2).all(|axis| from[axis] <= low[axis] && to[axis] >= high[axis])
        && polygon::signed_area(ring) > (1.0 - 1e-9) * (to[0] - from[0]) * (to[1] - from[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(rings: Vec<Vec<Point>>, white: bool) -> Mark {
        Mark { area: vec![rings], opacity: 1.0, white }
    }

    fn square(low: f64, high: f64) -> Vec<Point> {
        rectangle([low; 2], [high; 2])
    }

    fn diamond(r: f64) -> Vec<Point> {
        vec![[50.0 + r, 50.0], [50.0, 50.0 + r], [50.0 - r, 50.0], [50.0, 50.0 - r]]
    }

    fn parted(marks: Vec<Mark>, choice: Background) -> (usize, Vec<Note>) {
        let (figure, _, notes) = part(marks, Some([[0.0; 2], [100.0; 2]]), choice).unwrap();
        (figure.len(), notes)
    }

    #[test]
    fn what_covers_the_page_is_background_in_one_piece_or_several() {
        let figure = mark(vec![diamond(30.0)], false);
        let page = mark(vec![square(0.0, 100.0)], false);
        let sky = mark(vec![rectangle([0.0, 40.0], [100.0, 100.0])], false);
        let hill = mark(vec![vec![[0.0, 0.0], [100.0, 0.0], [100.0, 40.0], [50.0, 60.0], [0.0, 40.0]]], false);
        let found = Background::Found;
        assert_eq!(parted(vec![page.clone(), figure.clone()], found), (1, vec![Note::Background(Ground::Page)]));
        let both = parted(vec![sky.clone(), hill, figure.clone()], found);
        assert_eq!(both, (1, vec![Note::Background(Ground::Shapes(2))]));
        assert_eq!(parted(vec![sky, figure.clone()], found), (2, vec![]));
        assert_eq!(parted(vec![page.clone(), figure], Background::Keep), (2, vec![]));
        // Alone, it is the figure.
        assert_eq!(parted(vec![page.clone(), page], found).0, 1);
    }

    #[test]
    fn paper_that_a_figure_is_cut_out_of_is_background_wherever_it_is_painted() {
        let paper = |white| mark(vec![square(0.0, 100.0), diamond(30.0).into_iter().rev().collect()], white);
        let halves = [[50.0, 80.0], [50.0, 20.0]].map(|tip| mark(vec![vec![[20.0, 50.0], tip, [80.0, 50.0]]], false));
        let halves = halves.map(|mut half| {
            half.area = regions::union(half.area).unwrap();
            half
        });
        let found = (2, vec![Note::Background(Ground::Page)]);
        for white in [true, false] {
            assert_eq!(parted([vec![paper(white)], halves.to_vec()].concat(), Background::Found), found);
            assert_eq!(parted([halves.to_vec(), vec![paper(white)]].concat(), Background::Found), found);
        }
        // A picture in its frame, and a page with a hole.
        let frame = mark(vec![square(0.0, 100.0), square(20.0, 80.0).into_iter().rev().collect()], false);
        assert_eq!(parted(vec![mark(vec![square(20.0, 80.0)], false), frame], Background::Found).0, 2);
        assert_eq!(parted(vec![paper(true)], Background::Found), (1, vec![]));
    }

    #[test]
    fn a_sheet_is_left_out_where_it_is_white_or_a_frame_and_told_elsewhere() {
        let figure = mark(vec![diamond(15.0)], false);
        let sheet = |white| mark(vec![square(20.0, 80.0)], white);
        let found = Background::Found;
        assert_eq!(parted(vec![sheet(true), figure.clone()], found), (1, vec![Note::Background(Ground::Sheet)]));
        let told = parted(vec![sheet(false), figure.clone()], found);
        assert_eq!(told, (2, vec![Note::GroundCounts(Ground::Sheet)]));
        assert_eq!(parted(vec![sheet(false), figure.clone()], Background::Drop).0, 1);
        let line = mark(vec![square(20.0, 80.0), square(21.0, 79.0).into_iter().rev().collect()], false);
        assert_eq!(parted(vec![figure.clone(), line], found), (1, vec![Note::Background(Ground::Frame)]));
        // A tile with a line around it is a thing, unless it is as large as the page; a line is no frame of what fills it.
        let tile = |low: f64, high: f64| {
            let line = vec![square(low - 1.0, high + 1.0), square(low + 1.0, high - 1.0).into_iter().rev().collect()];
            vec![mark(vec![square(low, high)], true), figure.clone(), mark(line, false)]
        };
        assert_eq!(parted(tile(20.0, 80.0), found), (3, vec![Note::GroundCounts(Ground::Sheet)]));
        assert_eq!(parted(tile(3.0, 97.0), found), (1, vec![Note::Background(Ground::Sheet)]));
        // Letters on a button are no figure, and the line around a body is no figure on it.
        let dot = |x: f64| mark(vec![rectangle([x, 40.0], [x + 5.0, 60.0])], false);
        assert_eq!(parted(vec![sheet(true), dot(30.0), dot(50.0)], found), (3, vec![]));
        assert_eq!(parted(vec![sheet(true), mark(vec![square(19.9, 80.1)], false)], found), (2, vec![]));
    }
}
