//! Designs whose outlines are made from random numbers: limbs, spirals, hands and stars. Shapes that no solver was tuned on.

use super::BenchError;
use crate::defaults::PIN_STIFFNESS;
use crate::design::{Design, Pin};
use crate::mesh::{self, MeshError};
use crate::outline::polygon::{bounding_box, length, sides, signed_area};
use crate::outline::{Outline, Point};
use crate::random::Random;
use std::f64::consts::{PI, TAU};

pub const FAMILIES: [&str; 4] = ["limb", "spiral", "hand", "star"];

/// Longer sides of the silhouettes, mm.
const SIZES: [f64; 2] = [100.0, 250.0];
/// Points along a centre line, and on a round end.
const ALONG: usize = 40;
const ROUND: usize = 8;
/// Pins are the body points nearest to the base, which is this part of the body length wide.
const BASE: f64 = 0.06;
/// Outlines drawn at most until one is simple and has a mesh.
const TRIES: usize = 40;
/// A mesh may have this part more or fewer fibres than asked for, where the outline does not permit the exact count.
const COUNT_TOLERANCE: f64 = 0.05;

/// An outline and the place at which it is held, with the direction across.
struct Silhouette {
    outer: Vec<Point>,
    base: Point,
    across: Point,
}

/// A design of this family with about `fibers` fibres, held at its base by three pins. The same numbers give the same design.
///
/// # Errors
/// A family that does not exist, or no drawn outline of it that meshes.
pub fn design(family: &str, fibers: usize, random: &mut Random) -> Result<Design, BenchError> {
    for _ in 0..TRIES {
        let drawn = match family {
            "limb" => limb(random),
            "spiral" => spiral(random),
            "hand" => hand(random),
            _ => star(random),
        };
        let drawn = scaled(drawn, random.between(SIZES[0], SIZES[1]));
        if is_simple(&drawn.outer)
            && let Some(design) = held(family, &drawn, fibers)
        {
            return Ok(design);
        }
    }
    Err(BenchError::Nothing(format!("no {family} of {fibers} fibres in {TRIES} tries")))
}

fn held(family: &str, drawn: &Silhouette, fibers: usize) -> Option<Design> {
    let outline = Outline { outer: drawn.outer.clone(), holes: Vec::new() };
    let near = |nearest: usize| nearest.abs_diff(fibers) as f64 <= COUNT_TOLERANCE * fibers as f64;
    let mesh = match mesh::generate(&outline, fibers) {
        Err(MeshError::Unreachable { nearest, .. }) if near(nearest) => mesh::generate(&outline, nearest),
        other => other,
    };
    let mut design = Design::new(family, outline, mesh.ok()?);
    let reach = BASE * design.body_length_mm();
    for part in [-1.0, 0.0, 1.0] {
        let place = [0, 1].map(|axis| drawn.base[axis] + part * reach * drawn.across[axis]);
        let (at, _) = design.mesh.locate_nearest(place, &design.mesh.nodes)?;
        design.pins.push(Pin::at_rest(at, PIN_STIFFNESS));
    }
    design.validate().is_ok().then_some(design)
}

/// A thick curve whose direction wanders, thinner towards its end.
fn limb(random: &mut Random) -> Silhouette {
    let (turn, wave) = (random.between(-2.6, 2.6), random.between(-0.8, 0.8));
    let (thick, taper) = (random.between(0.06, 0.11), random.between(0.0, 0.5));
    let heading = |s: f64| 0.5 * PI + turn * (s - 0.5) + wave * (TAU * s).sin();
    let mut line = vec![[0.0, 0.0]];
    for k in 0..ALONG {
        let angle = heading((k as f64 + 0.5) / ALONG as f64);
        let [x, y] = line[k];
        line.push([x + angle.cos() / ALONG as f64, y + angle.sin() / ALONG as f64]);
    }
    ribbon(&line, |s| thick * (1.0 - taper * s))
}

/// An arm rolled up, held at its outer end.
fn spiral(random: &mut Random) -> Silhouette {
    let (turns, core) = (random.between(0.9, 1.7), random.between(0.25, 0.5));
    let pitch = 1.0 / turns;
    let side = if random.unit() < 0.5 { 1.0 } else { -1.0 };
    let point = |s: f64| {
        let (angle, radius) = (TAU * turns * s, core + (1.0 - s) * pitch * turns);
        [radius * angle.cos(), side * radius * angle.sin()]
    };
    let count = 2 * ALONG;
    let line: Vec<Point> = (0..=count).map(|k| point(k as f64 / count as f64)).collect();
    let (thick, taper) = (pitch * random.between(0.25, 0.36), random.between(0.0, 0.4));
    ribbon(&line, |s| thick * (1.0 - taper * s))
}

/// A palm with three to five fingers that spread.
fn hand(random: &mut Random) -> Silhouette {
    let fingers = 3 + random.index(3);
    let (palm, gap) = (random.between(0.5, 0.9), random.between(0.25, 0.45));
    let spread = random.between(0.15, 0.45);
    let pitch = 1.0 / fingers as f64;
    let mut outer = vec![[0.0, 0.0], [1.0, 0.0], [1.0, palm]];
    for finger in (0..fingers).rev() {
        let middle = (finger as f64 + 0.5) * pitch;
        let radius = 0.5 * pitch * (1.0 - gap);
        let tilt = spread * (1.0 - 2.0 * middle);
        let (up, right) = ([-tilt.sin(), tilt.cos()], [tilt.cos(), tilt.sin()]);
        let reach = random.between(0.5, 1.1);
        let at = |across: f64, along: f64| {
            [middle + across * right[0] + along * up[0], palm + across * right[1] + along * up[1]]
        };
        outer.push(at(radius, 0.02));
        for k in 0..=ROUND {
            let angle = PI * k as f64 / ROUND as f64;
            outer.push(at(radius * angle.cos(), reach + radius * angle.sin()));
        }
        outer.push(at(-radius, 0.02));
    }
    outer.push([0.0, palm]);
    Silhouette { outer, base: [0.5, 0.0], across: [1.0, 0.0] }
}

/// Three to seven arms about a centre, which is held.
fn star(random: &mut Random) -> Silhouette {
    let arms = 3 + random.index(5);
    let (depth, phase) = (random.between(0.45, 0.7), random.between(0.0, TAU));
    let sharp = random.between(0.6, 1.6);
    let count = 12 * arms;
    let reach: Vec<f64> = (0..arms).map(|_| random.between(0.8, 1.0)).collect();
    let point = |k: usize| {
        let turn = TAU * k as f64 / count as f64;
        let wave = (0.5 + 0.5 * (arms as f64 * turn).cos()).powf(sharp);
        let nearest = ((k + 6) / 12) % arms;
        let radius = reach[nearest] * (1.0 - depth) + reach[nearest] * depth * wave;
        [radius * (turn + phase).cos(), radius * (turn + phase).sin()]
    };
    Silhouette { outer: (0..count).map(point).collect(), base: [0.0, 0.0], across: [1.0, 0.0] }
}

/// The outline of a thick line of half width `half(s)`, round at its end and held at its start.
fn ribbon(line: &[Point], half: impl Fn(f64) -> f64) -> Silhouette {
    let last = line.len() - 1;
    let direction = |k: usize| {
        let (a, b) = (line[k.saturating_sub(1)], line[(k + 1).min(last)]);
        let size = length(a, b);
        [(b[0] - a[0]) / size, (b[1] - a[1]) / size]
    };
    let side = |k: usize, sign: f64| {
        let ([dx, dy], w) = (direction(k), half(k as f64 / last as f64));
        [line[k][0] + sign * w * dy, line[k][1] - sign * w * dx]
    };
    let mut outer: Vec<Point> = (0..=last).map(|k| side(k, 1.0)).collect();
    let ([dx, dy], w) = (direction(last), half(1.0));
    for k in 1..ROUND {
        let (sin, cos) = (PI * k as f64 / ROUND as f64).sin_cos();
        let [x, y] = line[last];
        outer.push([x + w * (cos * dy + sin * dx), y + w * (sin * dy - cos * dx)]);
    }
    outer.extend((0..=last).rev().map(|k| side(k, -1.0)));
    let [dx, dy] = direction(0);
    Silhouette { outer, base: line[0], across: [dy, -dx] }
}

/// A silhouette scaled to this longer side, counter-clockwise.
fn scaled(mut drawn: Silhouette, size: f64) -> Silhouette {
    let (low, high) = bounding_box(&drawn.outer);
    let factor = size / (high[0] - low[0]).max(high[1] - low[1]);
    let place = |p: Point| [factor * (p[0] - low[0]), factor * (p[1] - low[1])];
    drawn.outer.iter_mut().for_each(|p| *p = place(*p));
    drawn.base = place(drawn.base);
    if signed_area(&drawn.outer) < 0.0 {
        drawn.outer.reverse();
    }
    drawn
}

/// Whether no two sides cross that are not neighbours.
fn is_simple(polygon: &[Point]) -> bool {
    let turn = |a: Point, b: Point, c: Point| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let all: Vec<(Point, Point)> = sides(polygon).collect();
    let crosses = |(a, b): (Point, Point), (c, d): (Point, Point)| {
        turn(a, b, c) * turn(a, b, d) <= 0.0 && turn(c, d, a) * turn(c, d, b) <= 0.0
    };
    (0..all.len()).all(|i| {
        let others = i + 2..all.len();
        others.filter(|j| (j + 1) % all.len() != i).all(|j| !crosses(all[i], all[j]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_family_gives_sound_designs_and_the_same_ones_again() {
        for family in FAMILIES {
            for number in 0..3 {
                let draw = || design(family, 300, &mut Random::of(1, family, number)).unwrap();
                let design = draw();
                assert_eq!(design, draw(), "{family}");
                assert!(design.validate().is_ok() && design.pins.len() == 3);
                let size = design.body_length_mm();
                assert!((0.99 * SIZES[0]..1.01 * SIZES[1]).contains(&size), "{family}: {size} mm");
                assert!(design.mesh.edges().len().abs_diff(300) <= 15);
            }
        }
    }

    #[test]
    fn a_bow_tie_is_not_simple() {
        assert!(is_simple(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]));
        assert!(!is_simple(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]));
    }
}
