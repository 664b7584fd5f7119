//! The threads of a design: what to cut, and the way of each through the felt.

use crate::defaults::CABLE_MM;
use crate::design::Design;
use crate::fabrication::cables::{holes, points, tendon_length_mm};
use crate::motion::winch_labels;
use crate::outline::Point;
use std::f64::consts::PI;

/// Turns on the spool that hold a thread there.
const WRAP_TURNS: f64 = 1.5;
/// Thread for a knot at either end, and for a hand to pull by, mm.
const KNOT_MM: f64 = 30.0;
const HAND_MM: f64 = 80.0;
/// Lengths to cut are rounded up to this, mm.
const ROUND_MM: f64 = 5.0;

/// A tendon as a hand threads it, on either face.
#[derive(Clone, Debug, PartialEq)]
pub struct Thread {
    pub network: usize,
    pub winch: String,
    /// Counted from 1.
    pub tendon: usize,
    /// From the winch to its end, mm, and the numbers of its holes.
    pub points: Vec<Point>,
    pub holes: Vec<usize>,
    /// At rest, and to cut, mm.
    pub length_mm: f64,
    pub cut_mm: f64,
    pub ratio: f64,
    pub slack_mm: f64,
}

impl Thread {
    /// The groove of the spool, counted from the hub.
    pub fn groove(&self, back: bool) -> usize {
        2 * self.tendon - 1 + usize::from(back)
    }

    /// One line for a list: number, lengths, holes from the winch outward, and what departs from the plain cable.
    pub fn words(&self) -> String {
        let through: Vec<String> = self.holes.iter().map(usize::to_string).collect();
        let mut text = format!(
            "{}: {:.1} mm, holes {}, cut {:.0} mm",
            self.tendon,
            self.length_mm,
            through.join("-"),
            self.cut_mm
        );
        if self.ratio != 1.0 {
            text += &format!(", spool x {:.3}", self.ratio);
        }
        if self.slack_mm != 0.0 {
            text += &format!(", slack {:.1} mm", self.slack_mm);
        }
        text
    }

    /// The way in words: over and under the felt in turn.
    pub fn way(&self) -> String {
        let steps = self.holes.iter().enumerate().skip(1);
        let steps: Vec<String> =
            steps.map(|(k, hole)| format!("{} to {hole}", if k % 2 == 1 { "over" } else { "under" })).collect();
        format!("out at {}; {}; knot", self.holes.first().copied().unwrap_or(0), steps.join("; "))
    }
}

/// All threads, network by network.
pub fn threads(design: &Design) -> Vec<Thread> {
    let all = holes(design);
    let names = winch_labels(design);
    let mut threads = Vec::new();
    for (network, (n, winch)) in design.networks.iter().zip(names).enumerate() {
        for (tendon, t) in (1..).zip(&n.tendons) {
            let points = points(design, t);
            let number = |p: &Point| all.iter().position(|h| h == p).map_or(0, |i| i + 1);
            let length_mm = tendon_length_mm(design, t);
            let around = 2.0 * PI * (design.fabrication.spool_radius_mm * t.ratio).max(CABLE_MM);
            let cut = length_mm + WRAP_TURNS * around + 2.0 * KNOT_MM + HAND_MM;
            threads.push(Thread {
                network,
                winch: winch.clone(),
                tendon,
                holes: points.iter().map(number).collect(),
                points,
                length_mm,
                cut_mm: (cut / ROUND_MM).ceil() * ROUND_MM,
                ratio: t.ratio,
                slack_mm: t.slack_mm,
            });
        }
    }
    threads
}
