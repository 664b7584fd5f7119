//! Tracks: lines inside the body along which edges of its mesh shall run, so that a thread can follow them.

use crate::outline::{Point, polygon};

/// The points of a track in their order, mm; straight between them. What leaves the body is cut off when it is meshed.
pub type Track = Vec<Point>;

pub(super) fn check(track: &[Point], most: f64) -> Result<(), (String, &'static str)> {
    if track.len() < 2 {
        return Err((String::new(), "a track needs at least two points"));
    }
    match track.iter().position(|p| !p.iter().all(|v| v.abs() <= most)) {
        Some(k) => Err((format!("[{k}]"), "a coordinate must lie between -1e7 and 1e7 mm")),
        None => Ok(()),
    }
}

/// Length along a track, mm.
pub fn length(track: &[Point]) -> f64 {
    track.windows(2).map(|w| polygon::length(w[0], w[1])).sum()
}

/// Distance of a place from a track; infinite for one without a piece.
pub(super) fn distance(track: &[Point], p: Point) -> f64 {
    track.windows(2).map(|w| polygon::distance_to_segment(w[0], w[1], p)).fold(f64::INFINITY, f64::min)
}

pub(super) fn middles(track: &[Point]) -> Vec<Point> {
    track.windows(2).map(|w| polygon::lerp(w[0], w[1], 0.5)).collect()
}
