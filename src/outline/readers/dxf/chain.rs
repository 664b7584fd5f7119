//! Lines that meet end to end become closed outlines.

use crate::outline::{Point, polygon};
use std::collections::BTreeMap;

/// Ends this near each other meet, as a fraction of the drawing's size: the gaps that CAD programs leave.
const GAP_FRACTION: f64 = 1e-4;

/// Closed outlines, and how many lines belong to none.
pub(super) struct Closed {
    pub contours: Vec<Vec<Point>>,
    pub open: usize,
}

/// Joins lines into closed outlines. Of two equal outlines one is dropped: drawn twice is not a hole.
pub(super) fn closed(lines: Vec<(Vec<Point>, bool)>, size: f64) -> Closed {
    let gap = GAP_FRACTION * size;
    let mut contours = Vec::new();
    let mut open: Vec<Vec<Point>> = Vec::new();
    for (line, closed) in lines {
        let (Some(&first), Some(&last)) = (line.first(), line.last()) else { continue };
        if closed || (line.len() > 3 && polygon::length(first, last) <= gap) {
            contours.push(line);
        } else if line.len() >= 2 && polygon::perimeter(&line) > gap {
            open.push(line);
        }
    }
    let mut ends = Ends::new(&open, gap);
    let mut used = vec![false; open.len()];
    let mut left = 0;
    for start in 0..open.len() {
        if std::mem::replace(&mut used[start], true) {
            continue;
        }
        let mut chain = open[start].clone();
        let mut parts = 1;
        while let (Some(&first), Some(&last)) = (chain.first(), chain.last()) {
            if chain.len() > 3 && polygon::length(first, last) <= gap {
                break;
            }
            let Some((next, backwards)) = ends.take(last, &open, &mut used) else { break };
            parts += 1;
            if backwards {
                chain.extend(open[next].iter().rev().skip(1));
            } else {
                chain.extend(open[next].iter().skip(1));
            }
        }
        let meets = chain.first().zip(chain.last()).is_some_and(|(a, b)| polygon::length(*a, *b) <= gap);
        if meets && chain.len() > 3 { contours.push(chain) } else { left += parts }
    }
    contours.retain(|c| c.len() >= 3);
    Closed { contours: without_twins(contours, gap), open: left }
}

/// The ends of lines in square cells as wide as a gap.
struct Ends {
    cells: BTreeMap<(i64, i64), Vec<usize>>,
    gap: f64,
}

impl Ends {
    fn new(open: &[Vec<Point>], gap: f64) -> Self {
        let mut ends = Self { cells: BTreeMap::new(), gap };
        for (k, line) in open.iter().enumerate() {
            for p in [line[0], line[line.len() - 1]] {
                let cell = ends.cell(p);
                ends.cells.entry(cell).or_default().push(k);
            }
        }
        ends
    }

    fn cell(&self, p: Point) -> (i64, i64) {
        ((p[0] / self.gap).floor() as i64, (p[1] / self.gap).floor() as i64)
    }

    /// The unused line with the end nearest to `p`, and whether that is its last point.
    fn take(&mut self, p: Point, open: &[Vec<Point>], used: &mut [bool]) -> Option<(usize, bool)> {
        let (x, y) = self.cell(p);
        let mut best: Option<(f64, usize, bool)> = None;
        for dx in -1..=1 {
            for dy in -1..=1 {
                let Some(cell) = self.cells.get_mut(&(x.saturating_add(dx), y.saturating_add(dy))) else { continue };
                cell.retain(|&k| !used[k]);
                for &k in cell.iter() {
                    let line = &open[k];
                    for (end, backwards) in [(line[0], false), (line[line.len() - 1], true)] {
                        let away = polygon::length(p, end);
                        if away <= self.gap && best.is_none_or(|b| away < b.0) {
                            best = Some((away, k, backwards));
                        }
                    }
                }
            }
        }
        let (_, k, backwards) = best?;
        used[k] = true;
        Some((k, backwards))
    }
}

/// Without outlines that have the area and box of an earlier one.
fn without_twins(contours: Vec<Vec<Point>>, gap: f64) -> Vec<Vec<Point>> {
    let mut seen: BTreeMap<[i64; 5], ()> = BTreeMap::new();
    let mut kept = Vec::with_capacity(contours.len());
    for contour in contours {
        let (low, high) = polygon::bounding_box(&contour);
        let area = polygon::signed_area(&contour).abs().sqrt();
        let key = [low[0], low[1], high[0], high[1], area].map(|v| (v / gap).round() as i64);
        if seen.insert(key, ()).is_none() {
            kept.push(contour);
        }
    }
    kept
}
