//! The rules of sewing as figures that a search brings to zero.
//!
//! [`sewing::judge`] says which rules are broken; here every rule gives a number for every place where it could be, zero where it is
//! kept, in an order that depends on the layout's shape alone: so it can be differentiated by the points' places.

use super::depths::Depths;
use super::layout::{Layout, Spot};
use crate::outline::polygon::distance_to_segment;
use crate::outline::{Outline, Point, polygon};
use crate::sewing::{self, Body, Rules};

/// The search keeps farther from a rule than it says: by this length, and this angle. What is found is rounded to files.
const MARGIN_MM: f64 = 0.3;
const MARGIN_DEGREES: f64 = 1.0;
/// A length outside of the body that counts as much as a whole rule, mm.
const OUTSIDE_MM: f64 = 10.0;
/// Distance that the search keeps between pieces of cable and the seam, mm, and on how many places of a piece it looks. Nearer, a
/// piece has the least of its weight.
const CLEAR_MM: f64 = 1.0;
const PLACES: usize = 4;
const NEAR: f64 = 0.1;
/// A piece may be outside of a posed body by this length, mm: rounding at corners of the mesh.
const TOLERANCE_MM: f64 = 0.1;

/// A body and the rules that cables in it should keep.
pub struct Sewable<'a> {
    pub rules: Rules,
    /// In the seam, and in the rim of the mesh: chords of the seam's curves, inside of it or outside.
    depths: Depths<'a>,
    outline: &'a Outline,
    rim: &'a Outline,
    gap_mm: f64,
    /// Winches that are there and stay.
    fixed: Vec<sewing::Rig>,
}

impl<'a> Sewable<'a> {
    /// `rim`: the boundary of the mesh at rest.
    pub fn new(rules: Rules, outline: &'a Outline, rim: &'a Outline, gap_mm: f64, fixed: Vec<sewing::Rig>) -> Self {
        let bodies = [outline, rim].map(Body::new);
        let housing_mm = sewing::largest_housing(&bodies[0], rules.housing_mm);
        Self { rules: Rules { housing_mm, ..rules }, depths: Depths::new(bodies), outline, rim, gap_mm, fixed }
    }

    /// Distance to the seam, negative outside of the body; where it is `enough`, a distance that it has at least.
    pub fn depth(&self, p: Point, enough: f64) -> f64 {
        self.depths.up_to(p, enough)
    }

    /// By how much a point is nearer to the seam than it may be.
    fn shallow(&self, p: Point, least: f64) -> f64 {
        below(self.depth(p, least + MARGIN_MM), least)
    }

    /// Length of a piece outside of the body, mm.
    pub fn outside(&self, a: Point, b: Point) -> f64 {
        if self.depths.holds(a, b) {
            return 0.0;
        }
        let of = |outline: &Outline| sewing::outside(outline.polygons(), a, b);
        of(self.outline).max(of(self.rim))
    }

    /// Whether a layout keeps every rule at rest; what the winches that are there break among themselves does not count.
    pub fn is_kept(&self, layout: &Layout) -> bool {
        let rigs = layout.rigs();
        let inside = |cable: &Vec<Point>| cable.windows(2).all(|s| self.outside(s[0], s[1]) <= TOLERANCE_MM);
        rigs.iter().flat_map(|rig| &rig.cables).all(inside)
            && self.depths.bodies.iter().all(|body| {
                let broken = |rigs: &[sewing::Rig]| sewing::judge(&self.rules, body, rigs, self.gap_mm).len();
                broken(&[&rigs, &self.fixed[..]].concat()) == broken(&self.fixed)
            })
    }

    /// By how much every rule is broken at every place: 0 where it is kept, 1 by about as much as the rule allows.
    pub fn violations(&self, layout: &Layout) -> Vec<f64> {
        self.figures(layout, None, f64::INFINITY).values
    }

    /// The sum of the squares of [`Self::violations`], or a part of it that is more than the limit.
    pub fn broken(&self, layout: &Layout, limit: f64) -> f64 {
        self.figures(layout, None, limit).squares
    }

    /// [`Self::violations`] after one spot has moved; `known` before that. Only what may have changed is worked out.
    pub fn violations_after(&self, layout: &Layout, moved: Spot, known: &[f64]) -> Vec<f64> {
        self.figures(layout, Some((moved, known)), f64::INFINITY).values
    }

    fn figures<'k>(&self, layout: &Layout, moved: Option<(Spot, &'k [f64])>, limit: f64) -> Figures<'k> {
        let Rules { housing_mm, between_housings_mm, .. } = self.rules;
        // Those that stay come last: no spot is theirs.
        let (rigs, own) = ([&layout.rigs(), &self.fixed[..]].concat(), layout.winches.len());
        let mut out = Figures { moved, values: Vec::new(), squares: 0.0, limit };
        for (k, rig) in rigs.iter().enumerate().take(own) {
            out.put(out.winch(k), || self.shallow(rig.winch, 0.5 * housing_mm));
            for (i, other) in rigs.iter().enumerate().filter(|(i, _)| *i < k || *i >= own) {
                let apart = || below(distance(rig.winch, other.winch), housing_mm + between_housings_mm);
                out.put(out.winch(k) || out.winch(i), apart);
            }
            for cable in self.fixed.iter().flat_map(|rig| &rig.cables) {
                out.put(out.winch(k), || below(passing(cable, rig.winch), 0.5 * housing_mm));
            }
            for (j, cable) in rig.cables.iter().enumerate() {
                self.cable(k, j, cable, &mut out);
                for (i, other) in rigs.iter().enumerate().filter(|(i, _)| *i != k) {
                    out.put(out.cable(k, j) || out.winch(i), || below(passing(cable, other.winch), 0.5 * housing_mm));
                }
                let others =
                    rigs.iter().enumerate().flat_map(|(i, rig)| rig.cables.iter().enumerate().map(move |c| (i, c)));
                for (i, (l, other)) in others.filter(|&(i, (l, _))| (i, l) != (k, j)) {
                    out.put(out.cable(k, j) || out.cable(i, l), || {
                        let beside = self.rules.beside_mm + MARGIN_MM;
                        let shared = sewing::shared_mm(cable, other, beside, self.rules.lead_mm);
                        above(shared, self.rules.along_mm - MARGIN_MM)
                    });
                }
            }
        }
        self.crowding(layout, &mut out);
        out
    }

    fn cable(&self, winch: usize, own: usize, cable: &[Point], out: &mut Figures) {
        let rules = &self.rules;
        let changed = |out: &Figures, k: usize| out.place(winch, own, k);
        out.put(out.cable(winch, own), || above(cable.len().saturating_sub(2) as f64, rules.most_holes as f64));
        for (k, p) in cable.iter().enumerate().skip(1) {
            out.put(changed(out, k), || self.shallow(*p, rules.hole_to_seam_mm));
        }
        for (k, s) in cable.windows(2).enumerate() {
            out.put(changed(out, k) || changed(out, k + 1), || {
                let place = |i: usize| polygon::lerp(s[0], s[1], i as f64 / (PLACES + 1) as f64);
                let near: f64 = (1..=PLACES).map(|i| self.shallow(place(i), CLEAR_MM)).sum();
                self.outside(s[0], s[1]) / OUTSIDE_MM + NEAR * near
            });
        }
        for p in cable.windows(3) {
            out.put(out.cable(winch, own), || {
                above(sewing::turn(p[0], p[1], p[2]), rules.turn_degrees - MARGIN_DEGREES)
            });
        }
        out.put(out.cable(winch, own), || above(sewing::turning(cable), rules.turning_degrees - MARGIN_DEGREES));
    }

    fn crowding(&self, layout: &Layout, out: &mut Figures) {
        let spots = layout.spots();
        for (k, &spot) in spots.iter().enumerate() {
            let p = layout.point(spot);
            for &other in &spots[..k] {
                let apart = || below(distance(p, layout.point(other)), self.rules.hole_to_hole_mm);
                out.put(out.spot(spot) || out.spot(other), apart);
            }
            for rig in &self.fixed {
                let ends = rig.cables.iter().flat_map(|cable| cable.iter().skip(1));
                for hole in std::iter::once(&rig.winch).chain(ends) {
                    out.put(out.spot(spot), || below(distance(p, *hole), self.rules.hole_to_hole_mm));
                }
            }
        }
    }
}

/// Figures that are being put together, of which some may be known from before a spot has moved.
struct Figures<'k> {
    moved: Option<(Spot, &'k [f64])>,
    values: Vec<f64>,
    squares: f64,
    /// When the squares are more, nothing more is worked out.
    limit: f64,
}

impl Figures<'_> {
    fn put(&mut self, changed: bool, value: impl FnOnce() -> f64) {
        if self.squares > self.limit {
            return;
        }
        let value = match self.moved {
            Some((_, known)) if !changed => known[self.values.len()],
            _ => value(),
        };
        self.squares += value * value;
        self.values.push(value);
    }

    fn spot(&self, spot: Spot) -> bool {
        self.moved.is_none_or(|(moved, _)| moved == spot)
    }

    fn winch(&self, winch: usize) -> bool {
        self.spot(Spot { winch, cable: None })
    }

    /// Whether any point of a cable has moved.
    fn cable(&self, winch: usize, cable: usize) -> bool {
        let own = |moved: Spot| moved.winch == winch && moved.cable.is_none_or(|(c, _)| c == cable);
        self.moved.is_none_or(|(moved, _)| own(moved))
    }

    /// Whether a point of a cable has moved, its winch the first.
    fn place(&self, winch: usize, cable: usize, k: usize) -> bool {
        self.spot(Spot { winch, cable: k.checked_sub(1).map(|k| (cable, k)) })
    }
}

/// How near a cable passes a point, mm.
fn passing(cable: &[Point], p: Point) -> f64 {
    cable.windows(2).map(|s| distance_to_segment(s[0], s[1], p)).fold(f64::INFINITY, f64::min)
}

/// `polygon::length`, without its care for figures near the ends of the range.
fn distance(a: Point, b: Point) -> f64 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    (dx * dx + dy * dy).sqrt()
}

/// By how much pieces of cables leave a posed body, as [`Sewable::violations`] counts: its rings and cables in the pose, mm.
pub fn posed_violation<'c>(rings: &[Vec<Point>], cables: impl Iterator<Item = &'c [Point]>) -> f64 {
    let outside = |s: &[Point]| sewing::outside(rings.iter().map(Vec::as_slice), s[0], s[1]) - TOLERANCE_MM;
    let pieces = cables.flat_map(|cable| cable.windows(2));
    pieces.map(|s| (outside(s).max(0.0) / OUTSIDE_MM).powi(2)).sum()
}

/// How far a length is below the least one and a margin, as a part of it.
fn below(is: f64, least: f64) -> f64 {
    if least > 0.0 { ((least + MARGIN_MM - is) / least).max(0.0) } else { 0.0 }
}

fn above(is: f64, most: f64) -> f64 {
    ((is - most) / most.max(1.0)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use crate::rigging::layout::Placed;

    /// A square of 200 mm with layouts of three winches in it, and a little beyond.
    fn random_layout(random: &mut Random) -> Layout {
        let mut point = || [random.between(-10.0, 210.0), random.between(-10.0, 210.0)];
        let winch = |count: usize, point: &mut dyn FnMut() -> Point| Placed {
            at: point(),
            cables: (0..count).map(|k| (0..=k).map(|_| point()).collect::<Vec<_>>().into()).collect(),
        };
        Layout { winches: [1, 2, 3].map(|count| winch(count, &mut point)).to_vec() }
    }

    /// A winch that stays.
    fn fixed() -> Vec<sewing::Rig> {
        vec![sewing::Rig { winch: [30.0, 170.0], cables: vec![vec![[30.0, 170.0], [100.0, 190.0]]] }]
    }

    fn square() -> Outline {
        Outline { outer: vec![[0.0, 0.0], [200.0, 0.0], [200.0, 200.0], [0.0, 200.0]], holes: vec![] }
    }

    #[test]
    fn a_moved_spot_changes_what_it_touches_and_nothing_else() {
        let outline = square();
        let sewable = Sewable::new(Rules::default(), &outline, &outline, 60.0, fixed());
        let random = &mut Random::new(3);
        for _ in 0..20 {
            let layout = random_layout(random);
            let known = sewable.violations(&layout);
            for spot in layout.spots() {
                let mut moved = layout.clone();
                let p = moved.point_mut(spot);
                *p = [p[0] + random.between(-30.0, 30.0), p[1] + random.between(-30.0, 30.0)];
                assert_eq!(sewable.violations_after(&moved, spot, &known), sewable.violations(&moved), "{spot:?}");
            }
        }
    }

    #[test]
    fn without_violations_every_rule_is_kept() {
        let outline = square();
        let sewable = Sewable::new(Rules::default(), &outline, &outline, 60.0, fixed());
        let random = &mut Random::new(9);
        let (mut kept, mut broken) = (0, 0);
        for _ in 0..4000 {
            let mut layout = random_layout(random);
            // One winch with a tendon or two keeps them now and then.
            layout.winches.truncate(1 + random.index(2));
            let sum: f64 = sewable.violations(&layout).iter().sum();
            if sum == 0.0 {
                kept += 1;
                assert!(sewable.is_kept(&layout), "{layout:?}");
            }
            broken += usize::from(!sewable.is_kept(&layout));
            assert!(sum > 0.0 || sewable.is_kept(&layout));
        }
        assert!(kept > 20 && broken > 1000, "{kept} kept, {broken} broken");
    }
}
