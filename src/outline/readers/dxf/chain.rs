//! Lines that meet end to end become closed outlines.
//!
//! Ends that lie at one place are joined first, of several the pair that goes on most nearly straight; then what is left, the nearest ends
//! first, within the tolerance. So a large tolerance does no harm where lines do meet. Lines that lead nowhere come last,
//! as they bound nothing.

use crate::outline::{Point, polygon};
use std::cell::Cell;
use std::collections::BTreeMap;

/// Ends this near each other lie at one place, as a fraction of the drawing's size: the gaps that CAD programs leave.
const SAME_FRACTION: f64 = 1e-4;
/// Ends this near each other meet unless asked otherwise, as a fraction of the drawing's size: 4 mm on 200 mm.
pub(super) const JOIN_FRACTION: f64 = 0.02;
/// A line and its copy lie so near each other all along, as a fraction of the drawing's size and of their length.
const COPY_FRACTION: f64 = 5e-4;
const COPY_OF_LENGTH: f64 = 0.05;
/// A line whose own ends meet is at least so many times as long as they are apart.
const LOOP: f64 = 3.0;
/// Pairs of ends that are compared at most.
const MAX_PAIRS: usize = 4_000_000;
/// Ends that are looked at to find where lines lead at most; beyond that, all lead on.
const MAX_TRIES: usize = 40_000_000;
/// Lines in a row that are found to lead nowhere.
const DEAD_LINES: usize = 8;

/// Closed outlines, and what became of the other lines.
#[derive(Default)]
pub(super) struct Closed {
    pub contours: Vec<Vec<Point>>,
    /// Lines that belong to none.
    pub open: usize,
    /// Places where ends did not quite meet, and the farthest that they were apart.
    pub joined: usize,
    pub farthest: f64,
    /// Lines that were there before.
    pub copies: usize,
    /// How far apart the nearest ends are that stay loose.
    pub nearest_loose: Option<f64>,
}

/// Joins lines into closed outlines, across gaps up to `join`.
pub(super) fn closed(lines: Vec<(Vec<Point>, bool)>, size: f64, join: f64) -> Closed {
    let same = (SAME_FRACTION * size).min(join.max(f64::MIN_POSITIVE));
    let mut result = Closed::default();
    let mut open: Vec<Vec<Point>> = Vec::new();
    for (line, closed) in lines {
        let (Some(&first), Some(&last)) = (line.first(), line.last()) else { continue };
        if closed || (line.len() > 3 && polygon::length(first, last) <= same) {
            result.contours.push(line);
        } else if line.len() >= 2 && length(&line) > same {
            open.push(line);
        }
    }
    result.copies = drop_copies(&mut open, COPY_FRACTION * size);
    let mut partner: Vec<Option<(usize, f64)>> = vec![None; 2 * open.len()];
    let dead = dead_ends(&open, join.max(same));
    matched(&open, &dead, &mut partner, same, true);
    matched(&open, &dead, &mut partner, join, false);
    chains(&open, &partner, same, &mut result);
    result.contours.retain(|contour| contour.len() >= 3);
    result
}

fn length(line: &[Point]) -> f64 {
    line.windows(2).map(|pair| polygon::length(pair[0], pair[1])).sum()
}

/// Drops lines that lie on earlier ones from end to end, either way round.
fn drop_copies(open: &mut Vec<Vec<Point>>, reach: f64) -> usize {
    let mut kept: Vec<(Vec<Point>, Point, f64)> = Vec::new();
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    let before = open.len();
    for line in open.drain(..) {
        let long = length(&line);
        let middle = along(&line, 0.5 * long);
        let near = reach.min(COPY_OF_LENGTH * long);
        let is_copy = around(middle, reach).filter_map(|at| cells.get(&at)).flatten().any(|&k: &usize| {
            let (other, at, other_long) = &kept[k];
            polygon::length(*at, middle) <= near
                && (long - other_long).abs() <= 2.0 * near
                && [false, true].into_iter().any(|back| follows(&line, other, long, *other_long, back, near))
        });
        if !is_copy {
            cells.entry(cell(middle, reach)).or_default().push(kept.len());
            kept.push((line, middle, long));
        }
    }
    open.extend(kept.into_iter().map(|(line, ..)| line));
    before - open.len()
}

/// The cell of a place in a grid of squares as wide as `reach`.
fn cell(p: Point, reach: f64) -> [i64; 2] {
    p.map(|v| (v / reach).floor() as i64)
}

/// The cells in which lies what is within `reach` of a place.
fn around(p: Point, reach: f64) -> impl Iterator<Item = [i64; 2]> {
    let [x, y] = cell(p, reach);
    (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| [x.saturating_add(dx), y.saturating_add(dy)]))
}

/// Whether two lines lie near each other at their ends and between.
fn follows(a: &[Point], b: &[Point], a_long: f64, b_long: f64, back: bool, near: f64) -> bool {
    [0.0, 0.25, 0.75, 1.0].into_iter().all(|t| {
        let u = if back { 1.0 - t } else { t };
        polygon::length(along(a, t * a_long), along(b, u * b_long)) <= near
    })
}

/// The point of a line after some of its length.
fn along(line: &[Point], mut way: f64) -> Point {
    for pair in line.windows(2) {
        let side = polygon::length(pair[0], pair[1]);
        if way <= side && side > 0.0 {
            return polygon::lerp(pair[0], pair[1], way / side);
        }
        way -= side;
    }
    line[line.len() - 1]
}

/// End `2 k` is the first point of line `k`, `2 k + 1` its last; also the point that the line comes from there.
fn end(open: &[Vec<Point>], e: usize) -> (Point, Point) {
    let line = &open[e / 2];
    if e.is_multiple_of(2) { (line[0], line[1]) } else { (line[line.len() - 1], line[line.len() - 2]) }
}

/// Which lines lead nowhere: no other line that leads on begins within `reach` of one of their ends, nor do their own ends meet.
fn dead_ends(open: &[Vec<Point>], reach: f64) -> Vec<bool> {
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for e in 0..2 * open.len() {
        cells.entry(cell(end(open, e).0, reach)).or_default().push(e);
    }
    let mut dead = vec![false; open.len()];
    // A row of many lines may lead nowhere: its last ones first.
    let tries = Cell::new(0);
    for _ in 0..DEAD_LINES {
        let mut found = Vec::new();
        for line in (0..open.len()).filter(|&line| !dead[line]) {
            let leads_on = |e: usize| {
                let p = end(open, e).0;
                around(p, reach).any(|at| {
                    cells.get(&at).into_iter().flatten().any(|&f| {
                        tries.set(tries.get() + 1);
                        tries.get() > MAX_TRIES || (f / 2 != line && polygon::length(p, end(open, f).0) <= reach)
                    })
                })
            };
            let (from, to) = (end(open, 2 * line).0, end(open, 2 * line + 1).0);
            if polygon::length(from, to) > reach && !(leads_on(2 * line) && leads_on(2 * line + 1)) {
                found.push(line);
            }
        }
        if found.is_empty() {
            break;
        }
        for line in found {
            dead[line] = true;
        }
        for ends in cells.values_mut() {
            ends.retain(|&e| !dead[e / 2]);
        }
    }
    dead
}

/// Joins loose ends within `reach`: those of lines that lead on first, and of these the straightest pairs, or the nearest.
fn matched(open: &[Vec<Point>], dead: &[bool], partner: &mut [Option<(usize, f64)>], reach: f64, by_turn: bool) {
    let loose: Vec<usize> = (0..partner.len()).filter(|&e| partner[e].is_none()).collect();
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for &e in &loose {
        cells.entry(cell(end(open, e).0, reach)).or_default().push(e);
    }
    let mut pairs: Vec<(f64, usize, usize, f64)> = Vec::new();
    for &e in &loose {
        let (p, p_from) = end(open, e);
        for at in around(p, reach) {
            for &f in cells.get(&at).into_iter().flatten().filter(|&&f| f > e) {
                let (q, q_from) = end(open, f);
                let away = polygon::length(p, q);
                if away > reach || (e / 2 == f / 2 && length(&open[e / 2]) < LOOP * away.max(reach * 1e-3)) {
                    continue;
                }
                let key = if by_turn { turn(p_from, p, q_from) } else { away };
                pairs.push((key, e, f, away));
            }
        }
        if pairs.len() > MAX_PAIRS {
            break;
        }
    }
    let last = |pair: &(f64, usize, usize, f64)| dead[pair.1 / 2] || dead[pair.2 / 2];
    pairs.sort_by(|a, b| last(a).cmp(&last(b)).then(a.0.total_cmp(&b.0)).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    for (_, e, f, away) in pairs {
        if partner[e].is_none() && partner[f].is_none() {
            (partner[e], partner[f]) = (Some((f, away)), Some((e, away)));
        }
    }
}

/// How far from straight on it goes from `a` over `p` to `b`, rad.
fn turn(a: Point, p: Point, b: Point) -> f64 {
    let (u, v) = ([p[0] - a[0], p[1] - a[1]], [b[0] - p[0], b[1] - p[1]]);
    (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]).abs()
}

/// Follows joined ends around.
fn chains(open: &[Vec<Point>], partner: &[Option<(usize, f64)>], same: f64, result: &mut Closed) {
    let mut used = vec![false; open.len()];
    let mut loose: Vec<Point> = Vec::new();
    for start in 0..open.len() {
        if used[start] {
            continue;
        }
        let (mut chain, mut parts, mut gaps) = (Vec::new(), 0, Vec::new());
        // Enters a line at one end and leaves at the other.
        let mut enter = 2 * start;
        let is_closed = loop {
            used[enter / 2] = true;
            parts += 1;
            let line = &open[enter / 2];
            if enter.is_multiple_of(2) {
                chain.extend(line)
            } else {
                chain.extend(line.iter().rev())
            }
            let Some((next, away)) = partner[enter ^ 1] else { break false };
            gaps.push(away);
            if next == 2 * start {
                break true;
            }
            if used[next / 2] {
                break false;
            }
            enter = next;
        };
        if is_closed && chain.len() > 3 {
            let wide: Vec<f64> = gaps.into_iter().filter(|away| *away > same).collect();
            result.joined += wide.len();
            result.farthest = wide.into_iter().fold(result.farthest, f64::max);
            chain.dedup_by(|a, b| polygon::length(*a, *b) <= 1e-3 * same);
            result.contours.push(chain);
            continue;
        }
        // The other way from where it began.
        let mut enter = 2 * start;
        while let Some((next, _)) = partner[enter].filter(|(next, _)| !used[next / 2]) {
            used[next / 2] = true;
            parts += 1;
            enter = next ^ 1;
        }
        result.open += parts;
        loose.extend([chain[chain.len() - 1], end(open, enter).0]);
    }
    const COMPARED: usize = 400;
    let some = &loose[..loose.len().min(COMPARED)];
    let pairs = some.iter().enumerate().flat_map(|(k, p)| some[k + 1..].iter().map(|q| polygon::length(*p, *q)));
    result.nearest_loose = pairs.min_by(f64::total_cmp);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sides of a hexagon of size 100 with all their ends moved by a little, in a mixed order and direction.
    fn hexagon(off: f64) -> Vec<(Vec<Point>, bool)> {
        let corner = |i: usize| {
            let a = std::f64::consts::TAU * i as f64 / 6.0;
            [50.0 * a.cos(), 50.0 * a.sin()]
        };
        let side = |i: usize| {
            let (a, b) = (corner(i), corner(i + 1));
            let away = |p: Point, s: f64| [p[0] + s * off, p[1] - s * off];
            let line = vec![away(a, 0.5), away(b, -0.5)];
            (if i.is_multiple_of(2) { line } else { line.into_iter().rev().collect() }, false)
        };
        [3, 0, 5, 1, 4, 2].map(side).to_vec()
    }

    #[test]
    fn ends_are_joined_within_the_tolerance_and_told() {
        for (off, join, contours) in [(0.0, 2.0, 1), (0.3, 2.0, 1), (0.3, 0.1, 0), (3.0, 2.0, 0), (3.0, 5.0, 1)] {
            let found = closed(hexagon(off), 100.0, join);
            assert_eq!((found.contours.len(), found.open), (contours, 6 * (1 - contours)), "{off} {join}");
            if contours == 1 {
                assert!((polygon::signed_area(&found.contours[0]).abs() / 6495.2 - 1.0).abs() < 0.002 + 0.02 * off);
                assert_eq!(found.joined, if off > 0.0 { 6 } else { 0 });
                assert!((found.farthest - off * 2_f64.sqrt()).abs() < 1e-9);
            } else {
                assert!((found.nearest_loose.unwrap() - off * 2_f64.sqrt()).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn lines_drawn_twice_count_once() {
        let mut twice = hexagon(0.0);
        twice.extend(hexagon(0.0).into_iter().map(|(line, closed)| (line.into_iter().rev().collect(), closed)));
        twice.extend(hexagon(0.01).into_iter().take(2));
        let found = closed(twice, 100.0, 2.0);
        assert_eq!((found.contours.len(), found.open, found.copies), (1, 0, 8));
    }

    #[test]
    fn where_three_lines_meet_the_straight_way_goes_on() {
        let mut lines = hexagon(0.0);
        lines.push((vec![[50.0, 0.0], [90.0, 1.0]], false));
        lines.push((vec![[-50.0, 0.0], [0.0, 0.0]], false));
        let found = closed(lines, 100.0, 2.0);
        assert_eq!((found.contours.len(), found.open), (1, 2));
    }
}
