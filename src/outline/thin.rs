//! Parts too thin to sew are widened; parts that hang together by a hair or a point are joined.
//!
//! With `r` half the wanted width, the opening `(S - r) + r` of a silhouette `S` (shrunk, then grown) is what a disc of
//! radius `r` can reach inside it. The rest, `S` less its opening, are the corners, which a disc cannot reach either and
//! which stay, and the thin parts. Each piece of the rest borders on the opening along *cuts*: none (a thin figure of its
//! own), one (a corner, a spike or a whisker), or more (a neck). Necks, and pieces that reach far beyond their cut, are
//! grown to the wanted width.
//!
//! Two round parts that barely overlap leave no such piece between them, since their openings touch. But shrinking parts
//! them, and where the pieces of `S - r`, grown again, meet, a disc joins them.

use super::grid::Grid;
use super::regions::{self, Shapes};
use super::{OutlineError, Point, polygon};

/// The opening is taken this much larger, in `r`, so that its polygonal arcs leave no slivers along the boundary.
const SLIVER: f64 = 0.03;
/// Farther than this from its cut, in `r`, a piece is thin and no corner: a corner of 24 degrees reaches as far.
const CORNER_REACH: f64 = 3.8;
/// How near the silhouette's boundary a side is a part of it, in `r`; all others are cuts.
const ON_BOUNDARY: f64 = 1e-4;
/// Pieces smaller than this, in `r^2`, are leftovers of rounding.
const SPECK: f64 = 1e-3;
/// Most pieces that are looked at: time stays bounded on drawings made of hair.
const MAX_PIECES: usize = 2000;
/// Most pieces after shrinking whose meetings are looked for.
const MAX_LOBES: usize = 100;
/// From so many thin ends on they are hair: no animal has as many whiskers.
const HAIRS: usize = 40;
/// Tufts of hair are thinner than this, in `r`.
const TUFT: f64 = 3.0;
/// Tufts and the dents between them are smaller than this, in squares of half their width; what is larger is a limb or an armpit.
const TUFT_AREA: f64 = 6.0;
/// Part of what is thick that is one piece where necks hold nothing together.
const BODY: f64 = 0.95;
/// Corners of the disc that joins a pinched point.
const DISC: usize = 12;
/// Rounds of joining pinched points, each with larger discs.
const ROUNDS: usize = 5;

/// Without tufts and dents at the rim that a disc of a radius does not reach, limbs and bays kept.
fn combed(shapes: Shapes, radius: f64) -> Result<Shapes, OutlineError> {
    let least = TUFT_AREA * radius * radius;
    let opening = regions::grown(&regions::grown(&shapes, -radius), (1.0 + SLIVER) * radius);
    let mut limbs = regions::difference(&shapes, &opening);
    limbs.retain(|piece| regions::piece_area(piece) >= least);
    // Where a limb meets the body nothing is cut off between them.
    let combed =
        regions::union([regions::intersection(&opening, &shapes), regions::grown(&limbs, SLIVER * radius)].concat())?;
    let filled = regions::grown(&regions::grown(&combed, radius), -(1.0 + SLIVER) * radius);
    let mut dents = regions::difference(&filled, &combed);
    dents.retain(|piece| regions::piece_area(piece) < least);
    let mut whole = regions::union([combed, regions::grown(&dents, SLIVER * radius)].concat())?;
    whole.sort_by(|a, b| regions::piece_area(b).total_cmp(&regions::piece_area(a)));
    whole.truncate(1);
    Ok(whole)
}

/// Shapes with their thin parts widened.
pub(super) struct Widened {
    pub shapes: Shapes,
    pub parts: usize,
    /// Thin parts that stay as they are because widening them would change more than the allowed area.
    pub kept: usize,
}

/// What a disc of a width reaches of a silhouette, and what it does not.
pub(super) struct Opened {
    shapes: Shapes,
    r: f64,
    shrunk: Shapes,
    opening: Shapes,
    rest: Shapes,
    grid: Grid,
}

impl Opened {
    pub fn of(shapes: Shapes, width: f64) -> Self {
        let r = 0.5 * width;
        let shrunk = regions::grown(&shapes, -r);
        let opening = regions::grown(&shrunk, (1.0 + SLIVER) * r);
        let mut rest = regions::difference(&shapes, &opening);
        rest.retain(|piece| regions::piece_area(piece) > SPECK * r * r);
        let grid = Grid::new(shapes.iter().flatten().map(Vec::as_slice));
        Self { shapes, r, shrunk, opening, rest, grid }
    }

    pub fn shapes(&self) -> &Shapes {
        &self.shapes
    }

    /// The silhouette without hair, and how many hairs there were: the opening, with necks kept and gaps between tufts closed. `None` where few
    /// parts are that thin: whiskers and the like are there to be seen.
    pub fn shaved(&self) -> Result<Option<(Shapes, usize)>, OutlineError> {
        let r = self.r;
        let is_end = |piece: &&Vec<Vec<Point>>| cuts(piece, &self.grid, r).1 == 1;
        let ends = self.rest.iter().filter(is_end).take(MAX_PIECES);
        let hairs = ends.filter(|piece| is_thin(piece, &self.grid, r)).count();
        if hairs < HAIRS {
            return Ok(None);
        }
        let whole = regions::area(&self.opening);
        let body = self.opening.iter().map(|piece| regions::piece_area(piece)).fold(0.0, f64::max);
        // Necks hold a body together, or are hairs that cross.
        let mut kept = self.opening.clone();
        if body <= BODY * whole {
            kept.extend(self.rest.iter().filter(|piece| !is_end(piece)).cloned());
            kept = regions::union(kept)?;
        }
        let closed = regions::grown(&regions::grown(&kept, r), -(1.0 + SLIVER) * r);
        let mut shaved = regions::union([kept, closed].concat())?;
        // Tufts that hung together by hairs alone.
        shaved.sort_by(|a, b| regions::piece_area(b).total_cmp(&regions::piece_area(a)));
        shaved.truncate(1);
        Ok(Some((combed(shaved, TUFT * r)?, hairs)))
    }

    /// Widens what is thinner, the smallest parts first, as long as no more than `budget` of area is added.
    pub fn widened(self, budget: f64) -> Result<Widened, OutlineError> {
        let Self { shapes, r, shrunk, mut rest, grid, .. } = self;
        rest.sort_by(|a, b| regions::piece_area(a).total_cmp(&regions::piece_area(b)));
        let thin: Vec<Vec<Vec<Point>>> =
            rest.into_iter().take(MAX_PIECES).filter(|piece| is_thin(piece, &grid, r)).collect();
        let joints: Vec<Shapes> = joints(&shapes, &shrunk, r).into_iter().map(|p| vec![vec![disc(p, r)]]).collect();
        let total = thin.len() + joints.len();
        let mut added = Shapes::new();
        let (mut parts, mut spent) = (0, 0.0);
        let widened = thin.into_iter().map(|piece| {
            let grow = vec![piece];
            let area = regions::area(&grow);
            let length: f64 = grow.iter().flatten().map(|ring| polygon::perimeter(ring)).sum();
            // A strip of length l and width w has area l w and perimeter 2 l: its width is 2 A / P.
            let wide = 2.0 * area / length;
            regions::grown(&grow, (r - 0.5 * wide).max(0.1 * r))
        });
        for grow in joints.into_iter().chain(widened) {
            let more = regions::area(&regions::difference(&grow, &shapes));
            if spent + more > budget {
                break;
            }
            spent += more;
            added.extend(grow);
            parts += 1;
        }
        let shapes = if parts > 0 { regions::union([shapes, added].concat())? } else { shapes };
        Ok(Widened { shapes, parts, kept: total.saturating_sub(parts) })
    }
}

/// Where the pieces that shrinking parted meet when they are grown again, unless across a gap.
fn joints(shapes: &Shapes, shrunk: &Shapes, r: f64) -> Vec<Point> {
    if !(2..=MAX_LOBES).contains(&shrunk.len()) {
        return Vec::new();
    }
    let lobes: Vec<Shapes> =
        shrunk.iter().map(|rings| regions::grown(&vec![rings.clone()], (1.0 + SLIVER) * r)).collect();
    let boxes: Vec<(Point, Point)> = lobes.iter().map(regions::bounding_box).collect();
    let apart = |a: usize, b: usize| {
        (0..2).any(|axis| boxes[a].0[axis] > boxes[b].1[axis] || boxes[b].0[axis] > boxes[a].1[axis])
    };
    let mut found = Vec::new();
    for a in 0..lobes.len() {
        for b in (a + 1..lobes.len()).filter(|&b| !apart(a, b)) {
            for meeting in regions::intersection(&lobes[a], &lobes[b]) {
                let (low, high) = regions::bounding_box(&vec![meeting]);
                let middle = polygon::lerp(low, high, 0.5);
                let inside = shapes.iter().flatten().filter(|ring| polygon::contains(ring, middle)).count() % 2 == 1;
                if inside {
                    found.push(middle);
                }
            }
        }
    }
    found
}

/// How many parts of the regions, and how many gaps between them, are thinner than `width`.
pub(super) fn narrow_parts(shapes: &Shapes, width: f64) -> usize {
    let narrow = Narrow::of(shapes, width);
    narrow.parts() + narrow.gaps()
}

/// Whether there are any; where a part tells, as of a body with hair, the gaps are not looked for.
pub(super) fn has_narrow_parts(shapes: &Shapes, width: f64) -> bool {
    let narrow = Narrow::of(shapes, width);
    narrow.parts() > 0 || narrow.gaps() > 0
}

/// Regions whose parts and gaps are compared with a disc of radius `r`.
struct Narrow<'a> {
    shapes: &'a Shapes,
    r: f64,
    grid: Grid,
}

impl<'a> Narrow<'a> {
    fn of(shapes: &'a Shapes, width: f64) -> Self {
        Self { shapes, r: 0.5 * width, grid: Grid::new(shapes.iter().flatten().map(Vec::as_slice)) }
    }

    fn parts(&self) -> usize {
        let opening = regions::grown(&regions::grown(self.shapes, -self.r), (1.0 + SLIVER) * self.r);
        self.count(regions::difference(self.shapes, &opening))
    }

    fn gaps(&self) -> usize {
        let closing = regions::grown(&regions::grown(self.shapes, self.r), -(1.0 + SLIVER) * self.r);
        self.count(regions::difference(&closing, self.shapes))
    }

    fn count(&self, rest: Shapes) -> usize {
        let r = self.r;
        let rest = rest.into_iter().filter(|piece| regions::piece_area(piece) > SPECK * r * r);
        rest.take(MAX_PIECES).filter(|piece| is_thin(piece, &self.grid, r)).count()
    }
}

/// Whether a piece of the rest is a neck, or reaches far from its cut.
fn is_thin(piece: &[Vec<Point>], grid: &Grid, r: f64) -> bool {
    let (cuts, runs) = cuts(piece, grid, r);
    if runs != 1 {
        return true;
    }
    let reach =
        |p: &Point| cuts.iter().map(|&(a, b)| polygon::distance_to_segment(a, b, *p)).fold(f64::INFINITY, f64::min);
    piece.iter().flatten().any(|p| reach(p) > CORNER_REACH * r)
}

/// The sides of a piece of the rest along which it borders on the opening, and in how many runs.
fn cuts(piece: &[Vec<Point>], grid: &Grid, r: f64) -> (Vec<(Point, Point)>, usize) {
    let mut cuts: Vec<(Point, Point)> = Vec::new();
    let mut runs = 0;
    for ring in piece {
        let on_cut: Vec<bool> =
            polygon::sides(ring).map(|(a, b)| !grid.is_near(polygon::lerp(a, b, 0.5), ON_BOUNDARY * r)).collect();
        let n = on_cut.len();
        let starts = (0..n).filter(|&i| on_cut[i] && !on_cut[(i + n - 1) % n]).count();
        // A ring that is a cut all around has no start.
        runs += if starts == 0 && on_cut.contains(&true) { 1 } else { starts };
        cuts.extend(polygon::sides(ring).zip(&on_cut).filter(|(_, cut)| **cut).map(|(side, _)| side));
    }
    (cuts, runs)
}

/// Joins the places where the boundary touches itself in a point by a disc of diameter `width`; returns how many.
pub(super) fn join_pinches(mut shapes: Shapes, width: f64) -> Result<(Shapes, usize), OutlineError> {
    let mut joined = 0;
    for round in 0..ROUNDS {
        let points = pinches(&shapes);
        if points.is_empty() {
            break;
        }
        joined += if round == 0 { points.len() } else { 0 };
        let radius = 0.5 * width * 1.5_f64.powi(round as i32);
        let discs = points.iter().map(|&p| vec![disc(p, radius)]);
        shapes = regions::union(shapes.iter().cloned().chain(discs).collect())?;
    }
    Ok((shapes, joined))
}

/// Points that the boundary passes more than once.
pub(super) fn pinches(shapes: &Shapes) -> Vec<Point> {
    let mut points: Vec<Point> = shapes.iter().flatten().flatten().copied().collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut twice: Vec<Point> = points.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
    twice.dedup();
    twice
}

fn disc(centre: Point, radius: f64) -> Vec<Point> {
    let angle = |i: usize| std::f64::consts::TAU * (i as f64 + 0.5) / DISC as f64;
    (0..DISC).map(|i| [centre[0] + radius * angle(i).cos(), centre[1] + radius * angle(i).sin()]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(x: f64, y: f64, w: f64, h: f64) -> Vec<Vec<Point>> {
        vec![vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]]
    }

    #[test]
    fn a_hairline_neck_becomes_as_wide_as_asked() {
        let dumbbell =
            vec![rectangle(0.0, 0.0, 40.0, 40.0), rectangle(39.0, 19.9, 22.0, 0.2), rectangle(60.0, 0.0, 40.0, 40.0)];
        let before = regions::union(dumbbell).unwrap();
        let Widened { shapes, parts, kept } = Opened::of(before.clone(), 4.0).widened(f64::INFINITY).unwrap();
        assert_eq!((shapes.len(), parts, kept), (1, 1, 0));
        let more = regions::area(&shapes) - regions::area(&before);
        assert!((more / (20.0 * 3.8) - 1.0).abs() < 0.1, "{more}");
        // The corners of the squares are where they were.
        for corner in [[0.0, 0.0], [0.0, 40.0], [40.0, 40.0], [100.0, 0.0]] {
            let near = shapes.iter().flatten().flatten().any(|p| polygon::length(*p, corner) < 1e-6);
            assert!(near, "{corner:?}");
        }
        // Without a budget it stays, and is counted.
        let Widened { shapes, parts, kept } = Opened::of(before.clone(), 4.0).widened(10.0).unwrap();
        assert_eq!((parts, kept), (0, 1));
        assert_eq!(regions::area(&shapes), regions::area(&before));
    }

    #[test]
    fn a_whisker_is_thin_and_a_corner_is_not() {
        let star = vec![vec![vec![[0.0, 0.0], [100.0, 0.0], [50.0, 90.0]]]];
        assert_eq!(Opened::of(star, 4.0).widened(f64::INFINITY).unwrap().parts, 0);
        let whisker = regions::union(vec![rectangle(0.0, 0.0, 40.0, 40.0), rectangle(39.0, 20.0, 30.0, 0.5)]).unwrap();
        assert_eq!(Opened::of(whisker, 4.0).widened(f64::INFINITY).unwrap().parts, 1);
        // A hair between two large discs that barely overlap is a neck, however short.
        let lens: Vec<Vec<Vec<Point>>> = [0.0, 99.99]
            .map(|x| {
                vec![
                    (0..400)
                        .map(|i| {
                            let a = std::f64::consts::TAU * f64::from(i) / 400.0;
                            [x + 50.0 * a.cos(), 50.0 * a.sin()]
                        })
                        .collect(),
                ]
            })
            .to_vec();
        let discs = regions::union(lens).unwrap();
        assert_eq!(discs.len(), 1);
        assert_eq!(Opened::of(discs, 4.0).widened(f64::INFINITY).unwrap().parts, 1);
    }

    #[test]
    fn two_squares_that_touch_in_a_corner_become_one() {
        let touching =
            regions::union(vec![rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 10.0, 10.0, 10.0)]).unwrap();
        let (joined, pinched) = join_pinches(touching, 1.0).unwrap();
        assert_eq!((joined.len(), pinched), (1, 1));
        assert!(pinches(&joined).is_empty());
        assert!((regions::area(&joined) - 200.0).abs() < 1.0);
    }

    /// A disc of radius 50 with so many hairs of 0.6 by 20 around it.
    fn hairy(count: usize) -> Shapes {
        let ring = |n: usize, r: f64| -> Vec<Point> {
            (0..n).map(|i| std::f64::consts::TAU * i as f64 / n as f64).map(|a| [r * a.cos(), r * a.sin()]).collect()
        };
        let hair = |i: usize| {
            let a = std::f64::consts::TAU * i as f64 / count as f64;
            let (along, across) = ([a.cos(), a.sin()], [-a.sin(), a.cos()]);
            let at = |r: f64, w: f64| [r * along[0] + w * across[0], r * along[1] + w * across[1]];
            vec![vec![at(40.0, -0.3), at(70.0, -0.3), at(70.0, 0.3), at(40.0, 0.3)]]
        };
        regions::union(std::iter::once(vec![ring(400, 50.0)]).chain((0..count).map(hair)).collect()).unwrap()
    }

    #[test]
    fn much_hair_is_shaved_off_and_whiskers_stay() {
        let disc = std::f64::consts::PI * 2500.0;
        let (shaved, hairs) = Opened::of(hairy(80), 1.4).shaved().unwrap().expect("hair");
        assert_eq!((hairs, shaved.len()), (80, 1));
        assert!((regions::area(&shaved) / disc - 1.0).abs() < 0.01, "{}", regions::area(&shaved));
        let (low, high) = regions::bounding_box(&shaved);
        assert!(high[0] - low[0] < 103.0 && high[1] - low[1] < 103.0, "{low:?} {high:?}");
        assert!(Opened::of(hairy(12), 1.4).shaved().unwrap().is_none());
        assert!(Opened::of(hairy(0), 1.4).shaved().unwrap().is_none());
    }
}
