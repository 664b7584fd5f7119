//! Pieces laid on sheets of a size, on as few as a search finds.
//!
//! Pieces are masks of cells, grown by half the space between them, so that what does not overlap in cells keeps its distance exactly.

use crate::outline::Point;
use crate::outline::polygon::{bounding_box, length, lerp, sides};

/// Cells along the longer side of a sheet: pieces lie at most a cell farther apart than they have to.
const CELLS: f64 = 250.0;
/// Smallest cell, mm.
const LEAST_CELL_MM: f64 = 1.0;

/// The place of a piece: mirrored about the y axis if it is, turned, then moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laid {
    pub sheet: usize,
    pub mirrored: bool,
    /// Quarter turns, counter-clockwise.
    pub turns: u8,
    pub shift: Point,
}

impl Laid {
    pub fn point(&self, p: Point) -> Point {
        let q = turned(self.mirrored, self.turns, p);
        [q[0] + self.shift[0], q[1] + self.shift[1]]
    }

    pub fn points(&self, points: &[Point]) -> Vec<Point> {
        points.iter().map(|&p| self.point(p)).collect()
    }
}

/// A sheet to lay pieces on, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    pub size: [f64; 2],
    pub margin_mm: f64,
    pub between_mm: f64,
    /// Width and height of the lower left corner of every sheet that stays free, the margin included.
    pub reserved: [f64; 2],
}

/// Whether a piece is no larger than a bed, upright or lying.
fn fits(rim: &[Point], bed: &Bed) -> bool {
    let (low, high) = bounding_box(rim);
    let mut own = [high[0] - low[0], high[1] - low[1]];
    let mut room = bed.size.map(|side| side - 2.0 * bed.margin_mm);
    own.sort_by(f64::total_cmp);
    room.sort_by(f64::total_cmp);
    own[0] <= room[0] && own[1] <= room[1]
}

/// Lays pieces (their rims, and whether they are mirrored) on sheets; `None` for those that fit on none however they are turned.
pub fn nest(pieces: &[(&[Point], bool)], bed: &Bed) -> Vec<Option<Laid>> {
    let cell = (bed.size[0].max(bed.size[1]) / CELLS).max(LEAST_CELL_MM);
    let mask = |rim: &[Point], mirrored: bool, turns: u8| Mask::new(rim, mirrored, turns, cell, 0.5 * bed.between_mm);
    // A piece that fits in no way has no mask: it may be of any size.
    let masks: Vec<Vec<Mask>> = pieces
        .iter()
        .map(|&(rim, mirrored)| (0..4).filter(|_| fits(rim, bed)).map(|turns| mask(rim, mirrored, turns)).collect())
        .collect();
    // The largest first, as it has the fewest places; all of its turns are tried.
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by_key(|&i| std::cmp::Reverse(masks[i].first().map_or(0, |mask| mask.columns * mask.rows)));
    let tries = (0..4).map(|first| lay(&masks, &order, first, bed, cell));
    let cost = |laid: &[Option<(Laid, usize)>]| {
        let sheets = laid.iter().flatten().map(|l| l.0.sheet + 1).max().unwrap_or(0);
        (laid.iter().filter(|l| l.is_none()).count(), sheets, laid.iter().flatten().map(|l| l.1).max().unwrap_or(0))
    };
    let best = tries.min_by_key(|laid| cost(laid)).unwrap_or_default();
    best.into_iter().map(|laid| laid.map(|(laid, _)| laid)).collect()
}

/// Each piece at the first place that is free, from below; of its turns, the one that ends lowest. With it the row where it ends.
fn lay(masks: &[Vec<Mask>], order: &[usize], first: usize, bed: &Bed, cell: f64) -> Vec<Option<(Laid, usize)>> {
    let mut laid = vec![None; masks.len()];
    let mut sheets: Vec<Mask> = Vec::new();
    for (k, &piece) in order.iter().enumerate() {
        if masks[piece].is_empty() {
            continue;
        }
        let turns = if k == 0 { first..first + 1 } else { 0..4 };
        for sheet in 0..=sheets.len() {
            if sheet == sheets.len() {
                sheets.push(Mask::bed(bed, cell));
            }
            let places = turns.clone().filter_map(|t| Some((sheets[sheet].first_free(&masks[piece][t])?, t)));
            let Some(([x, y], t)) = places.min_by_key(|&([x, y], t)| (y + masks[piece][t].rows, x, t)) else {
                if sheets[sheet].is_bare {
                    sheets.pop();
                    break;
                }
                continue;
            };
            let mask = &masks[piece][t];
            sheets[sheet].take(mask, x, y);
            let at = |k: usize, n: usize| bed.margin_mm + n as f64 * cell - mask.low[k];
            let shift = [at(0, x), at(1, y)];
            let place = Laid { sheet, mirrored: mask.mirrored, turns: t as u8, shift };
            laid[piece] = Some((place, y + mask.rows));
            break;
        }
    }
    laid
}

fn turned(mirrored: bool, turns: u8, p: Point) -> Point {
    let [x, y] = if mirrored { [-p[0], p[1]] } else { p };
    match turns % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

/// Cells in rows of words of 64.
#[derive(Clone, Debug)]
struct Mask {
    columns: usize,
    rows: usize,
    words: usize,
    bits: Vec<u64>,
    /// The corner of the first cell in the coordinates of the turned piece, mm.
    low: Point,
    mirrored: bool,
    /// A bed on which nothing lies yet.
    is_bare: bool,
}

impl Mask {
    fn empty(columns: usize, rows: usize, low: Point, mirrored: bool) -> Self {
        let words = columns.div_ceil(64);
        Self { columns, rows, words, bits: vec![0; words * rows], low, mirrored, is_bare: true }
    }

    fn new(rim: &[Point], mirrored: bool, turns: u8, cell: f64, grown: f64) -> Self {
        let ring: Vec<Point> = rim.iter().map(|&p| turned(mirrored, turns, p)).collect();
        let (low, high) = bounding_box(&ring);
        let low = low.map(|v| v - grown);
        let count = |k: usize| ((high[k] + grown - low[k]) / cell).ceil().max(1.0) as usize;
        let mut mask = Self::empty(count(0), count(1), low, mirrored);
        mask.fill(&ring, cell);
        let reach = grown + cell;
        for (a, b) in sides(&ring) {
            let steps = (2.0 * length(a, b) / cell).ceil().max(1.0);
            for i in 0..=steps as usize {
                mask.stamp(lerp(a, b, i as f64 / steps), reach, cell);
            }
        }
        mask
    }

    /// Cells whose middle is inside.
    fn fill(&mut self, ring: &[Point], cell: f64) {
        for row in 0..self.rows {
            let y = self.low[1] + (row as f64 + 0.5) * cell;
            let mut crossings: Vec<f64> = sides(ring)
                .filter(|(a, b)| (a[1] > y) != (b[1] > y))
                .map(|(a, b)| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
                .collect();
            crossings.sort_by(f64::total_cmp);
            for pair in crossings.chunks_exact(2) {
                let column = |x: f64| ((x - self.low[0]) / cell).max(0.0) as usize;
                for i in column(pair[0])..=column(pair[1]).min(self.columns - 1) {
                    self.bits[row * self.words + i / 64] |= 1 << (i % 64);
                }
            }
        }
    }

    /// Cells whose middle is within `reach` of a place.
    fn stamp(&mut self, p: Point, reach: f64, cell: f64) {
        let range = |k: usize, count: usize| {
            let from = ((p[k] - reach - self.low[k]) / cell).max(0.0) as usize;
            let to = ((p[k] + reach - self.low[k]) / cell).max(0.0) as usize;
            from..(to + 1).min(count)
        };
        for row in range(1, self.rows) {
            for i in range(0, self.columns) {
                let middle = [self.low[0] + (i as f64 + 0.5) * cell, self.low[1] + (row as f64 + 0.5) * cell];
                if length(middle, p) <= reach {
                    self.bits[row * self.words + i / 64] |= 1 << (i % 64);
                }
            }
        }
    }

    /// An empty sheet but for its corner.
    fn bed(bed: &Bed, cell: f64) -> Self {
        let count = |k: usize| ((bed.size[k] - 2.0 * bed.margin_mm) / cell).max(0.0) as usize;
        let mut mask = Self::empty(count(0), count(1), [0.0; 2], false);
        let taken =
            |k: usize, most: usize| (((bed.reserved[k] - bed.margin_mm) / cell).ceil().max(0.0) as usize).min(most);
        for row in 0..taken(1, mask.rows) {
            for i in 0..taken(0, mask.columns) {
                mask.bits[row * mask.words + i / 64] |= 1 << (i % 64);
            }
        }
        mask
    }

    /// The lowest, then leftmost place where another mask overlaps nothing.
    fn first_free(&self, other: &Self) -> Option<[usize; 2]> {
        let (ys, xs) = (self.rows.checked_sub(other.rows)?, self.columns.checked_sub(other.columns)?);
        (0..=ys).flat_map(|y| (0..=xs).map(move |x| [x, y])).find(|&[x, y]| !self.overlaps(other, x, y))
    }

    fn overlaps(&self, other: &Self, x: usize, y: usize) -> bool {
        (0..other.rows).any(|row| {
            (0..other.words).any(|w| {
                let bits = other.bits[row * other.words + w];
                bits != 0 && self.window(y + row, x + 64 * w) & bits != 0
            })
        })
    }

    /// 64 cells of a row from a column on.
    fn window(&self, row: usize, column: usize) -> u64 {
        let at = |w: usize| if w < self.words { self.bits[row * self.words + w] } else { 0 };
        let (w, shift) = (column / 64, column % 64);
        if shift == 0 { at(w) } else { at(w) >> shift | at(w + 1) << (64 - shift) }
    }

    fn take(&mut self, other: &Self, x: usize, y: usize) {
        self.is_bare = false;
        for row in 0..other.rows {
            for i in (0..other.columns).filter(|i| other.bits[row * other.words + i / 64] >> (i % 64) & 1 == 1) {
                let column = x + i;
                self.bits[(y + row) * self.words + column / 64] |= 1 << (column % 64);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bed(width: f64, height: f64) -> Bed {
        Bed { size: [width, height], margin_mm: 10.0, between_mm: 5.0, reserved: [120.0, 20.0] }
    }

    #[test]
    fn two_hooks_share_a_sheet_that_their_boxes_do_not() {
        let hook = [[0.0, 0.0], [200.0, 0.0], [200.0, 50.0], [50.0, 50.0], [50.0, 200.0], [0.0, 200.0]];
        let laid = nest(&[(&hook, false), (&hook, true)], &bed(300.0, 320.0));
        let [Some(a), Some(b)] = laid[..] else { panic!("{laid:?}") };
        assert_eq!((a.sheet, b.sheet), (0, 0));
        let (a, b) = (a.points(&hook), b.points(&hook));
        let apart = a.iter().map(|&p| crate::outline::polygon::distance(&b, p)).fold(f64::INFINITY, f64::min);
        assert!(apart >= 5.0, "{apart}");
        let (low, high) = bounding_box(&[a, b].concat());
        assert!(low[0] >= 10.0 && low[1] >= 10.0 && high[0] <= 290.0 && high[1] <= 310.0, "{low:?} {high:?}");
    }

    #[test]
    fn what_does_not_fit_goes_on_another_sheet_or_on_none() {
        let square = [[0.0, 0.0], [150.0, 0.0], [150.0, 150.0], [0.0, 150.0]];
        let laid = nest(&[(&square, false), (&square, true)], &bed(229.0, 305.0));
        let sheets: Vec<usize> = laid.iter().flatten().map(|l| l.sheet).collect();
        assert!(sheets.len() == 2 && sheets.contains(&0) && sheets.contains(&1), "{laid:?}");
        assert_eq!(nest(&[(&square, false)], &bed(100.0, 400.0)), [None]);
    }
}
