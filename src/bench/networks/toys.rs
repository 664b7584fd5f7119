//! Twelve toys that no search was tuned on: drawings of round parts, with pins and poses in which limbs bend.
//!
//! Each is drawn, imported, meshed and posed as a maker would; the poses follow from the limbs: muscles only contract, so a limb that
//! bends by an angle lies on an arc that is a little shorter than it was.

use super::super::BenchError;
use crate::design::Design;
use crate::operations::new_design::{self, Options};
use crate::operations::pose::{self, Move};
use crate::operations::{Context, FiberCount};
use crate::outline::drawing::{Drawing, Part, Primitive};
use crate::outline::{Import, Point};
use std::sync::atomic::AtomicBool;

/// A bent limb is this part of its length.
const CONTRACTED: f64 = 0.95;
/// Where a limb is taken: at its middle, and near its tip.
const TAKEN: [f64; 2] = [0.5, 0.95];

/// A round part between two points, mm: `(x, y, radius)` of its base and of its tip.
type Limb = [(f64, f64, f64); 2];

/// A toy: its parts, where it is held, and the poses, each of limbs (by number) that bend by degrees, counter-clockwise.
pub struct Toy {
    pub name: &'static str,
    limbs: &'static [Limb],
    pins: &'static [Point],
    poses: &'static [(&'static str, &'static [(usize, f64)])],
}

pub const ALL: [Toy; 12] = [
    Toy {
        name: "bear",
        limbs: &[
            [(100.0, 80.0, 62.0), (100.0, 110.0, 52.0)],
            [(100.0, 165.0, 46.0), (100.0, 195.0, 46.0)],
            [(60.0, 120.0, 22.0), (-20.0, 150.0, 17.0)],
            [(140.0, 120.0, 22.0), (220.0, 150.0, 17.0)],
            [(70.0, 50.0, 26.0), (55.0, -30.0, 22.0)],
            [(130.0, 50.0, 26.0), (145.0, -30.0, 22.0)],
            [(65.0, 225.0, 18.0), (60.0, 238.0, 17.0)],
            [(135.0, 225.0, 18.0), (140.0, 238.0, 17.0)],
        ],
        pins: &[[85.0, 80.0], [115.0, 80.0], [100.0, 105.0]],
        poses: &[("wave", &[(3, 45.0)]), ("hug", &[(2, 40.0), (3, -40.0)])],
    },
    Toy {
        name: "fish",
        limbs: &[
            [(40.0, 80.0, 34.0), (95.0, 80.0, 48.0)],
            [(95.0, 80.0, 46.0), (240.0, 80.0, 16.0)],
            [(235.0, 80.0, 16.0), (275.0, 118.0, 12.0)],
            [(235.0, 80.0, 16.0), (275.0, 42.0, 12.0)],
        ],
        pins: &[[50.0, 80.0], [85.0, 95.0], [85.0, 65.0]],
        poses: &[("left", &[(1, 30.0)]), ("right", &[(1, -30.0)])],
    },
    Toy {
        name: "cactus",
        limbs: &[
            [(60.0, 30.0, 30.0), (60.0, 230.0, 26.0)],
            [(60.0, 95.0, 17.0), (-5.0, 110.0, 16.0)],
            [(-5.0, 110.0, 16.0), (-10.0, 165.0, 14.0)],
            [(60.0, 120.0, 17.0), (125.0, 135.0, 16.0)],
            [(125.0, 135.0, 16.0), (130.0, 190.0, 14.0)],
        ],
        pins: &[[48.0, 20.0], [72.0, 20.0], [60.0, 45.0]],
        poses: &[("sway", &[(0, -24.0)])],
    },
    Toy {
        name: "snake",
        limbs: &[
            [(0.0, 20.0, 15.0), (70.0, 20.0, 19.0)],
            [(70.0, 20.0, 19.0), (130.0, 60.0, 20.0)],
            [(130.0, 60.0, 20.0), (200.0, 60.0, 19.0)],
            [(200.0, 60.0, 19.0), (265.0, 30.0, 20.0)],
            [(265.0, 30.0, 20.0), (290.0, 32.0, 22.0)],
        ],
        pins: &[[115.0, 50.0], [140.0, 60.0], [165.0, 60.0]],
        poses: &[("rear", &[(3, 45.0), (0, 35.0)])],
    },
    Toy {
        name: "star",
        limbs: &[
            [(120.0, 120.0, 42.0), (120.0, 235.0, 14.0)],
            [(120.0, 120.0, 42.0), (229.0, 156.0, 14.0)],
            [(120.0, 120.0, 42.0), (188.0, 27.0, 14.0)],
            [(120.0, 120.0, 42.0), (52.0, 27.0, 14.0)],
            [(120.0, 120.0, 42.0), (11.0, 156.0, 14.0)],
        ],
        pins: &[[108.0, 112.0], [132.0, 112.0], [120.0, 134.0]],
        poses: &[("turn", &[(0, 20.0), (1, 20.0), (4, 20.0)]), ("greet", &[(1, 32.0), (4, -32.0)])],
    },
    Toy {
        name: "crab",
        limbs: &[
            [(70.0, 60.0, 44.0), (150.0, 60.0, 44.0)],
            [(40.0, 85.0, 17.0), (-5.0, 160.0, 20.0)],
            [(180.0, 85.0, 17.0), (225.0, 160.0, 20.0)],
            [(55.0, 35.0, 13.0), (15.0, -20.0, 11.0)],
            [(165.0, 35.0, 13.0), (205.0, -20.0, 11.0)],
            [(90.0, 25.0, 13.0), (75.0, -25.0, 11.0)],
            [(130.0, 25.0, 13.0), (145.0, -25.0, 11.0)],
        ],
        pins: &[[90.0, 60.0], [130.0, 60.0], [110.0, 80.0]],
        poses: &[("snap", &[(1, -32.0), (2, 32.0)])],
    },
    Toy {
        name: "giraffe",
        limbs: &[
            [(60.0, 110.0, 32.0), (150.0, 115.0, 34.0)],
            [(160.0, 130.0, 26.0), (215.0, 265.0, 17.0)],
            [(215.0, 265.0, 17.0), (262.0, 255.0, 14.0)],
            [(50.0, 95.0, 17.0), (42.0, 0.0, 14.0)],
            [(85.0, 90.0, 17.0), (82.0, 0.0, 14.0)],
            [(130.0, 90.0, 17.0), (133.0, 0.0, 14.0)],
            [(162.0, 95.0, 17.0), (172.0, 0.0, 14.0)],
        ],
        pins: &[[70.0, 110.0], [105.0, 110.0], [140.0, 112.0]],
        poses: &[("graze", &[(1, -35.0)]), ("walk", &[(3, 24.0), (6, -24.0)])],
    },
    Toy {
        name: "bird",
        limbs: &[
            [(150.0, 70.0, 48.0), (150.0, 95.0, 44.0)],
            [(150.0, 140.0, 32.0), (150.0, 152.0, 32.0)],
            [(115.0, 85.0, 26.0), (5.0, 105.0, 15.0)],
            [(185.0, 85.0, 26.0), (295.0, 105.0, 15.0)],
            [(150.0, 35.0, 24.0), (150.0, -25.0, 20.0)],
        ],
        pins: &[[138.0, 80.0], [162.0, 80.0], [150.0, 100.0]],
        poses: &[
            ("up", &[(2, -28.0), (3, 28.0)]),
            ("down", &[(2, 28.0), (3, -28.0)]),
            ("bank", &[(2, 28.0), (3, 28.0)]),
        ],
    },
    Toy {
        name: "tree",
        limbs: &[
            [(100.0, 25.0, 26.0), (100.0, 120.0, 24.0)],
            [(100.0, 110.0, 22.0), (40.0, 200.0, 24.0)],
            [(100.0, 115.0, 22.0), (105.0, 235.0, 24.0)],
            [(100.0, 110.0, 22.0), (168.0, 195.0, 24.0)],
        ],
        pins: &[[88.0, 20.0], [112.0, 20.0], [100.0, 45.0]],
        poses: &[("wind", &[(1, -20.0), (2, -20.0), (3, -20.0)])],
    },
    Toy {
        name: "glove",
        limbs: &[
            [(70.0, 45.0, 42.0), (95.0, 80.0, 46.0)],
            [(60.0, 85.0, 17.0), (38.0, 175.0, 13.0)],
            [(82.0, 95.0, 17.0), (78.0, 205.0, 14.0)],
            [(106.0, 95.0, 17.0), (116.0, 200.0, 14.0)],
            [(128.0, 85.0, 16.0), (152.0, 170.0, 12.0)],
            [(45.0, 50.0, 17.0), (-20.0, 95.0, 14.0)],
        ],
        pins: &[[65.0, 40.0], [95.0, 45.0], [85.0, 70.0]],
        poses: &[("pinch", &[(5, -38.0), (1, 30.0)])],
    },
    Toy {
        name: "gingerbread",
        limbs: &[
            [(100.0, 100.0, 42.0), (100.0, 130.0, 38.0)],
            [(100.0, 190.0, 38.0), (100.0, 205.0, 38.0)],
            [(75.0, 140.0, 20.0), (0.0, 130.0, 18.0)],
            [(125.0, 140.0, 20.0), (200.0, 130.0, 18.0)],
            [(82.0, 80.0, 24.0), (60.0, -10.0, 21.0)],
            [(118.0, 80.0, 24.0), (140.0, -10.0, 21.0)],
        ],
        pins: &[[88.0, 110.0], [112.0, 110.0], [100.0, 130.0]],
        poses: &[("left-up", &[(2, -45.0)]), ("right-up", &[(3, 45.0)]), ("kick", &[(5, 35.0)])],
    },
    Toy {
        name: "rabbit",
        limbs: &[
            [(90.0, 55.0, 50.0), (90.0, 80.0, 44.0)],
            [(90.0, 130.0, 36.0), (90.0, 145.0, 36.0)],
            [(72.0, 160.0, 16.0), (55.0, 255.0, 15.0)],
            [(108.0, 160.0, 16.0), (125.0, 255.0, 15.0)],
            [(55.0, 70.0, 16.0), (15.0, 45.0, 14.0)],
            [(125.0, 70.0, 16.0), (165.0, 45.0, 14.0)],
        ],
        pins: &[[78.0, 60.0], [102.0, 60.0], [90.0, 130.0]],
        poses: &[("droop", &[(2, 45.0), (3, -45.0)])],
    },
];

impl Toy {
    /// The toy as a design of so many fibres, or the fewest that its outline allows where that is more.
    ///
    /// # Errors
    /// It makes no design, which a test excludes.
    pub fn design(&self, fibers: usize) -> Result<Design, BenchError> {
        let nothing = |why: String| BenchError::Nothing(format!("{}: {why}", self.name));
        let part = |&[a, b]: &Limb| Part {
            primitive: Primitive::Capsule { ends: [[a.0, a.1], [b.0, b.1]], radii: [a.2, b.2] },
            cut: false,
        };
        let drawing = Drawing { parts: self.limbs.iter().map(part).collect(), tracks: Vec::new() };
        let text = drawing.to_text().map_err(|error| nothing(error.to_string()))?;
        let options = Options {
            name: self.name.into(),
            import: Import::default(),
            fibers: FiberCount::AtLeast(fibers),
            texture: false,
        };
        let go = AtomicBool::new(false);
        let context = Context::new(&go);
        let made = new_design::run(text.as_bytes(), &options, &context).map_err(|error| nothing(error.to_string()))?;
        let mut design = made.design;
        let origin = self.origin();
        let here = |p: Point| [p[0] - origin[0], p[1] - origin[1]];
        for (k, (name, bends)) in self.poses.iter().enumerate() {
            let targets = bends.iter().flat_map(|&(limb, degrees)| self.bent(limb, degrees));
            let targets = targets.map(|(from, to)| Move { from: here(from), to: here(to) }).collect();
            let pins = if k == 0 { self.pins.iter().copied().map(here).collect() } else { Vec::new() };
            let posed = pose::run(
                &mut design,
                &pose::Options { name: (*name).into(), pins, targets, ..Default::default() },
                &context,
            );
            posed.map_err(|error| nothing(error.to_string()))?;
        }
        Ok(design)
    }

    /// The lower left corner of its box: where designs have their origin.
    fn origin(&self) -> Point {
        let ends = || self.limbs.iter().flatten();
        let least = |of: fn(&(f64, f64, f64)) -> f64| ends().map(|end| of(end) - end.2).fold(f64::INFINITY, f64::min);
        [least(|end| end.0), least(|end| end.1)]
    }

    /// Places along a limb, and where they go when it bends.
    fn bent(&self, limb: usize, degrees: f64) -> Vec<(Point, Point)> {
        let [a, b] = self.limbs[limb];
        let along = [b.0 - a.0, b.1 - a.1];
        let whole = degrees.to_radians();
        let place = |&part: &f64| {
            let from = [a.0 + part * along[0], a.1 + part * along[1]];
            // A chord of an arc that turns evenly: by half of the angle so far.
            let half = 0.5 * part * whole;
            let chord = CONTRACTED * part * if half == 0.0 { 1.0 } else { half.sin() / half };
            let (sin, cos) = half.sin_cos();
            let to = [a.0 + chord * (cos * along[0] - sin * along[1]), a.1 + chord * (sin * along[0] + cos * along[1])];
            (from, to)
        };
        TAKEN.iter().map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::defaults;

    #[test]
    fn every_toy_is_a_design_with_poses_away_from_rest() {
        for toy in &ALL {
            let design = toy.design(defaults::FIBERS).unwrap();
            design.validate().unwrap();
            assert_eq!(design.pins.len(), 3, "{}", toy.name);
            for pose in &design.poses {
                let rest = crate::engine::target_error(&design, &pose.targets, &design.mesh.nodes);
                assert!((0.02..0.3).contains(&rest), "{} {}: {rest}", toy.name, pose.name);
            }
        }
        assert!(ALL.iter().filter(|toy| toy.poses.len() > 1).count() >= 4);
    }
}
