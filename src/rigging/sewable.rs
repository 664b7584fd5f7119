//! The rules of sewing as figures that a search brings to zero.
//!
//! [`sewing::judge`] says which rules are broken; here every rule gives a number for every place where it could be, zero where it is
//! kept, in an order that depends on the layout's shape alone: so it can be differentiated by the points' places.

use super::layout::Layout;
use crate::outline::polygon::{distance_to_segment, length};
use crate::outline::{Outline, Point};
use crate::sewing::{self, Body, Rules};

/// The search keeps farther from a rule than it says: by this length, and this angle. What is found is rounded to files.
const MARGIN_MM: f64 = 0.3;
const MARGIN_DEGREES: f64 = 1.0;
/// A length outside of the body that counts as much as a whole rule, mm.
const OUTSIDE_MM: f64 = 10.0;

/// A body and the rules that cables in it should keep.
pub struct Sewable<'a> {
    pub rules: Rules,
    outline: &'a Outline,
    body: Body<'a>,
    gap_mm: f64,
}

impl<'a> Sewable<'a> {
    pub fn new(rules: Rules, outline: &'a Outline, gap_mm: f64) -> Self {
        let body = Body::new(outline);
        let housing_mm = sewing::largest_housing(&body, rules.housing_mm);
        Self { rules: Rules { housing_mm, ..rules }, outline, body, gap_mm }
    }

    /// Distance to the seam, negative outside of the body.
    pub fn depth(&self, p: Point) -> f64 {
        self.body.depth(p)
    }

    /// Length of a piece outside of the body, mm.
    pub fn outside(&self, a: Point, b: Point) -> f64 {
        sewing::outside(self.outline.polygons().map(|ring| &ring[..]), a, b)
    }

    /// Whether a layout keeps every rule.
    pub fn is_kept(&self, layout: &Layout) -> bool {
        let rigs = layout.rigs();
        let inside = |cable: &Vec<Point>| cable.windows(2).all(|s| self.outside(s[0], s[1]) == 0.0);
        rigs.iter().flat_map(|rig| &rig.cables).all(inside)
            && sewing::judge(&self.rules, &self.body, &rigs, self.gap_mm).is_empty()
    }

    /// By how much every rule is broken at every place: 0 where it is kept, 1 by about as much as the rule allows.
    pub fn violations(&self, layout: &Layout) -> Vec<f64> {
        let Rules { housing_mm, between_housings_mm, .. } = self.rules;
        let rigs = layout.rigs();
        let mut out = Vec::new();
        for (k, rig) in rigs.iter().enumerate() {
            out.push(below(self.depth(rig.winch), 0.5 * housing_mm));
            for other in &rigs[..k] {
                out.push(below(length(rig.winch, other.winch), housing_mm + between_housings_mm));
            }
            for (j, cable) in rig.cables.iter().enumerate() {
                self.cable(cable, &mut out);
                for (_, other) in rigs.iter().enumerate().filter(|(other, _)| *other != k) {
                    let pieces = cable.windows(2).map(|s| distance_to_segment(s[0], s[1], other.winch));
                    out.push(below(pieces.fold(f64::INFINITY, f64::min), 0.5 * housing_mm));
                }
                let others =
                    rigs.iter().enumerate().flat_map(|(i, rig)| rig.cables.iter().enumerate().map(move |c| (i, c)));
                for (_, (_, other)) in others.filter(|&(i, (l, _))| (i, l) != (k, j)) {
                    let shared = sewing::shared_mm(cable, other, self.rules.beside_mm + MARGIN_MM, self.rules.lead_mm);
                    out.push(above(shared, self.rules.along_mm - MARGIN_MM));
                }
            }
        }
        self.crowding(&rigs, &mut out);
        out
    }

    fn cable(&self, cable: &[Point], out: &mut Vec<f64>) {
        let rules = &self.rules;
        out.push(above(cable.len().saturating_sub(2) as f64, rules.most_holes as f64));
        for p in &cable[1..] {
            out.push(below(self.depth(*p), rules.hole_to_seam_mm));
        }
        for s in cable.windows(2) {
            out.push(self.outside(s[0], s[1]) / OUTSIDE_MM);
        }
        for p in cable.windows(3) {
            out.push(above(sewing::turn(p[0], p[1], p[2]), rules.turn_degrees - MARGIN_DEGREES));
        }
        out.push(above(sewing::turning(cable), rules.turning_degrees - MARGIN_DEGREES));
    }

    fn crowding(&self, rigs: &[sewing::Rig], out: &mut Vec<f64>) {
        let ends = rigs.iter().flat_map(|rig| rig.cables.iter().flat_map(|cable| cable[1..].iter().copied()));
        let holes: Vec<Point> = rigs.iter().map(|rig| rig.winch).chain(ends).collect();
        for (k, p) in holes.iter().enumerate() {
            out.extend(holes[..k].iter().map(|q| below(length(*p, *q), self.rules.hole_to_hole_mm)));
        }
    }
}

/// How far a length is below the least one and a margin, as a part of it.
fn below(is: f64, least: f64) -> f64 {
    if least > 0.0 { ((least + MARGIN_MM - is) / least).max(0.0) } else { 0.0 }
}

fn above(is: f64, most: f64) -> f64 {
    ((is - most) / most.max(1.0)).max(0.0)
}
