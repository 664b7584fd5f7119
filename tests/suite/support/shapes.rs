//! Outlines that are hard to mesh, from a seed: combs, spirals, stars, slots, rings, necks, noise, limbs that nearly touch.

use plushwright::outline::{Outline, Point, polygon};
use std::f64::consts::TAU;

/// A small generator of random numbers (xorshift), the same on every machine.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// From 0 to 1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

pub fn ring(centre: Point, n: usize, radius: impl Fn(f64) -> f64) -> Vec<Point> {
    let point = |i: usize| {
        let a = TAU * i as f64 / n as f64;
        [centre[0] + radius(a) * a.cos(), centre[1] + radius(a) * a.sin()]
    };
    (0..n).map(point).collect()
}

fn hole(centre: Point, n: usize, r: f64) -> Vec<Point> {
    ring(centre, n, |_| r).into_iter().rev().collect()
}

/// A strip of a width along a line, its ends cut off.
fn strip(line: &[Point], width: impl Fn(f64) -> f64) -> Vec<Point> {
    let n = line.len();
    let side = |i: usize, sign: f64| {
        let (a, b) = (line[i.saturating_sub(1)], line[(i + 1).min(n - 1)]);
        let l = polygon::length(a, b);
        let w = 0.5 * sign * width(i as f64 / (n - 1) as f64);
        [line[i][0] + w * (b[1] - a[1]) / l, line[i][1] - w * (b[0] - a[0]) / l]
    };
    (0..n).map(|i| side(i, 1.0)).chain((0..n).rev().map(|i| side(i, -1.0))).collect()
}

/// The `k`-th nasty outline of a seed, with its name; about 250 mm.
#[expect(clippy::too_many_lines, reason = "a table of a dozen shapes, each a few lines")]
pub fn nasty(k: usize, seed: u64) -> (String, Outline) {
    let mut random = Random::new(seed.wrapping_mul(31).wrapping_add(k as u64 + 1));
    let r = &mut random;
    let (name, outer, holes): (&str, Vec<Point>, Vec<Vec<Point>>) = match k % 12 {
        0 => {
            let teeth = 3 + (6.0 * r.unit()) as usize;
            let (gap, depth) = (r.between(0.15, 0.85), r.between(60.0, 180.0));
            let pitch = 250.0 / teeth as f64;
            let mut outer = vec![[0.0, 0.0], [250.0, 0.0]];
            for i in (0..teeth).rev() {
                let x = pitch * i as f64;
                outer.extend([
                    [x + pitch, 200.0],
                    [x + gap * pitch, 200.0],
                    [x + gap * pitch, 200.0 - depth],
                    [x, 200.0 - depth],
                ]);
            }
            // The last gap is open to the left.
            ("comb", outer, vec![])
        }
        1 => {
            let (turns, width) = (r.between(1.2, 2.2), r.between(10.0, 22.0));
            let line: Vec<Point> = (0..400)
                .map(|i| {
                    let t = i as f64 / 399.0;
                    let (a, d) = (TAU * turns * t, 20.0 + 110.0 * t);
                    [d * a.cos(), d * a.sin()]
                })
                .collect();
            ("spiral", strip(&line, |t| width * (0.5 + t)), vec![])
        }
        2 => {
            let (points, inner) = (4 + (5.0 * r.unit()) as usize, r.between(0.25, 0.7));
            let outer = ring([0.0; 2], 2 * points, |_| 1.0);
            let outer = outer.iter().enumerate().map(|(i, p)| {
                let d = if i % 2 == 0 { 125.0 } else { 125.0 * inner };
                [d * p[0], d * p[1]]
            });
            ("star", outer.collect(), vec![])
        }
        3 => {
            let mut holes = Vec::new();
            for i in 0..3 {
                let (x, w) = (40.0 + 60.0 * f64::from(i), r.between(4.0, 25.0));
                holes.push(vec![[x, 40.0], [x, 160.0], [x + w, 160.0], [x + w, 40.0]]);
            }
            ("slots", vec![[0.0, 0.0], [230.0, 0.0], [230.0, 200.0], [0.0, 200.0]], holes)
        }
        4 => {
            let wall = r.between(8.0, 40.0);
            let off = r.between(0.0, 0.6) * wall;
            ("ring", ring([0.0; 2], 200, |_| 120.0), vec![hole([off, 0.0], 160, 120.0 - wall)])
        }
        5 => {
            let neck = r.between(3.0, 15.0);
            let line: Vec<Point> = (0..300).map(|i| [250.0 * i as f64 / 299.0, 0.0]).collect();
            ("neck", strip(&line, |t| neck + 120.0 * (TAU * t).sin().powi(2)), vec![])
        }
        6 => {
            let waves: Vec<(f64, f64, f64)> =
                (2..40).map(|m| (f64::from(m), 0.5 * r.unit() / f64::from(m), TAU * r.unit())).collect();
            let radius =
                |a: f64| 110.0 * (1.0 + waves.iter().map(|(m, d, p)| d * (m * a + p).sin()).sum::<f64>()).max(0.2);
            ("noise", ring([0.0; 2], 900, radius), vec![])
        }
        7 => {
            let gap = r.between(1.0, 8.0);
            let x = 100.0 + gap;
            let outer = vec![
                [0.0, 0.0],
                [200.0 + gap, 0.0],
                [200.0 + gap, 220.0],
                [x, 220.0],
                [x, 60.0],
                [100.0, 60.0],
                [100.0, 220.0],
                [0.0, 220.0],
            ];
            ("near-touching limbs", outer, vec![])
        }
        8 => {
            let mut holes = Vec::new();
            for i in 0..4 {
                for j in 0..3 {
                    let c = [45.0 + 55.0 * f64::from(i), 45.0 + 55.0 * f64::from(j)];
                    holes.push(hole(c, 40, r.between(4.0, 24.0)));
                }
            }
            ("sieve", vec![[0.0, 0.0], [255.0, 0.0], [255.0, 200.0], [0.0, 200.0]], holes)
        }
        9 => {
            let rays = 8 + (5.0 * r.unit()) as i32;
            let depth = r.between(0.2, 0.5);
            let radius = |a: f64| 120.0 * (1.0 - depth + depth * (f64::from(rays) * a).cos().abs().powf(0.7));
            ("flower", ring([0.0; 2], 720, radius), vec![])
        }
        10 => {
            // Teeth of a saw on one side of a bar.
            let teeth = 10 + (10.0 * r.unit()) as usize;
            let pitch = 250.0 / teeth as f64;
            let depth = r.between(0.3, 1.2) * pitch;
            let mut outer = vec![[0.0, 0.0], [250.0, 0.0]];
            for i in (0..teeth).rev() {
                outer.extend([[pitch * (i + 1) as f64, 90.0], [pitch * (i as f64 + 0.5), 90.0 + depth]]);
            }
            outer.push([0.0, 90.0]);
            ("saw", outer, vec![])
        }
        _ => {
            let sharp = r.between(8.0, 40.0);
            ("wedge", vec![[0.0, 0.0], [240.0, -sharp], [160.0, 0.0], [240.0, sharp], [20.0, 90.0]], vec![])
        }
    };
    let mut outline = Outline { outer, holes };
    if polygon::signed_area(&outline.outer) < 0.0 {
        outline.outer.reverse();
    }
    (format!("{name} {k}, seed {seed}"), outline)
}
