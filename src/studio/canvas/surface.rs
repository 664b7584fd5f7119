//! What the parts of a drawing cover together, cut into trapezoids that can be filled; which stretches of its tracks lie in it; and what
//! there is to say about it.

use crate::outline::drawing::Regions;
use crate::outline::{Drawing, Point, polygon};

/// Pieces smaller than this part of the whole do not count.
const SPECK_FRACTION: f64 = 1e-3;

/// The covered area of the drawing it was last asked for.
#[derive(Default)]
pub struct Surface {
    of: Option<Drawing>,
    pub regions: Regions,
    /// Corners in their order around each; they cover the regions exactly, mm.
    pub trapezoids: Vec<[Point; 4]>,
    /// The tracks in stretches that lie inside or outside.
    pub tracks: Vec<Vec<Stretch>>,
    /// Width and height of the box around everything, mm.
    pub size: [f64; 2],
    /// Without specks.
    pub pieces: usize,
    pub holes: usize,
    /// Why there is no area, if so.
    pub trouble: Option<String>,
}

/// A straight stretch of a track, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    pub ends: [Point; 2],
    /// Whether it lies in the body.
    pub inside: bool,
}

impl Surface {
    /// Whether something of a track is outside, where no mesh can follow it.
    pub fn is_cut_off(&self, track: usize) -> bool {
        self.tracks.get(track).is_some_and(|stretches| stretches.iter().any(|stretch| !stretch.inside))
    }

    pub fn follow(&mut self, drawing: &Drawing) {
        if self.of.as_ref() == Some(drawing) {
            return;
        }
        let (regions, trouble) = match drawing.regions() {
            Ok(regions) => (regions, None),
            Err(error) => (Regions::new(), Some(error.to_string())),
        };
        let area = |rings: &Vec<Vec<Point>>| rings.iter().map(|r| polygon::signed_area(r)).sum::<f64>();
        let all: f64 = regions.iter().map(area).sum();
        let whole = regions.iter().filter(|rings| area(rings) > SPECK_FRACTION * all);
        let (pieces, holes) = whole.fold((0, 0), |(p, h), rings| (p + 1, h + rings.len() - 1));
        let points: Vec<Point> = regions.iter().filter_map(|rings| rings.first()).flatten().copied().collect();
        let (low, high) = polygon::bounding_box(&points);
        let size = if points.is_empty() { [0.0; 2] } else { [high[0] - low[0], high[1] - low[1]] };
        let trapezoids = trapezoids(&regions);
        let tracks = drawing.tracks.iter().map(|track| stretches(track, &regions)).collect();
        *self = Self { of: Some(drawing.clone()), regions, trapezoids, tracks, size, pieces, holes, trouble };
    }
}

/// Cuts a track where it crosses the boundary.
fn stretches(track: &[Point], regions: &Regions) -> Vec<Stretch> {
    let cross = |u: Point, v: Point| u[0] * v[1] - u[1] * v[0];
    let way = |a: Point, b: Point| [b[0] - a[0], b[1] - a[1]];
    let inside = |p: Point| regions.iter().flatten().filter(|ring| polygon::contains(ring, p)).count() % 2 == 1;
    let mut cut = Vec::new();
    for piece in track.windows(2) {
        let [a, b] = [piece[0], piece[1]];
        let meets = |(c, d): (Point, Point)| {
            let (along, side, off) = (way(a, b), way(c, d), way(a, c));
            let (t, u) = (cross(off, side) / cross(along, side), cross(off, along) / cross(along, side));
            (t > 0.0 && t < 1.0 && (0.0..=1.0).contains(&u)).then_some(t)
        };
        let mut stops: Vec<f64> = regions.iter().flatten().flat_map(|r| polygon::sides(r)).filter_map(meets).collect();
        stops.extend([0.0, 1.0]);
        stops.sort_by(f64::total_cmp);
        cut.extend(stops.windows(2).filter(|w| w[0] < w[1]).map(|w| Stretch {
            ends: [polygon::lerp(a, b, w[0]), polygon::lerp(a, b, w[1])],
            inside: inside(polygon::lerp(a, b, w[0].midpoint(w[1]))),
        }));
    }
    cut
}

/// Cuts regions at the heights of all their corners.
fn trapezoids(regions: &Regions) -> Vec<[Point; 4]> {
    let mut sides: Vec<(Point, Point)> =
        regions.iter().flatten().flat_map(|ring| polygon::sides(ring)).filter(|(a, b)| a[1] != b[1]).collect();
    for side in &mut sides {
        if side.0[1] > side.1[1] {
            *side = (side.1, side.0);
        }
    }
    sides.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
    let mut heights: Vec<f64> = regions.iter().flatten().flatten().map(|p| p[1]).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    let mut cut = Vec::new();
    let mut active: Vec<(Point, Point)> = Vec::new();
    let mut coming = sides.into_iter().peekable();
    for band in heights.windows(2) {
        let [low, high] = [band[0], band[1]];
        active.retain(|side| side.1[1] > low);
        while let Some(side) = coming.next_if(|side| side.0[1] <= low) {
            active.push(side);
        }
        let at = |(a, b): (Point, Point), y: f64| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        active.sort_by(|&a, &b| (at(a, low) + at(a, high)).total_cmp(&(at(b, low) + at(b, high))));
        // Between the first and the second is inside, between the second and the third outside.
        for pair in active.chunks_exact(2) {
            let [a, b] = [pair[0], pair[1]];
            cut.push([[at(a, low), low], [at(b, low), low], [at(b, high), high], [at(a, high), high]]);
        }
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::drawing::{Part, Primitive};

    #[test]
    fn a_track_is_cut_where_it_crosses_the_boundary() {
        let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
        let regions = vec![vec![square(0.0, 30.0), square(10.0, 20.0)]];
        let found = stretches(&[[-5.0, 15.0], [25.0, 15.0], [25.0, 5.0]], &regions);
        let expected = [(-5.0, 0.0, false), (0.0, 10.0, true), (10.0, 20.0, false), (20.0, 25.0, true)];
        for (stretch, (from, to, inside)) in found.iter().zip(expected) {
            assert_eq!(*stretch, Stretch { ends: [[from, 15.0], [to, 15.0]], inside });
        }
        assert!(found.len() == 5 && found[4].inside);
    }

    #[test]
    fn trapezoids_cover_the_regions_exactly() {
        let circle = |x: f64, radius: f64| Primitive::Circle { center: [x, 3.0], radius };
        let drawing = Drawing {
            parts: vec![
                Part::joined(circle(0.0, 50.0)),
                Part::joined(Primitive::Capsule { ends: [[40.0, 0.0], [120.0, 60.0]], radii: [20.0, 5.0] }),
                Part { primitive: circle(5.0, 20.0), cut: true },
                Part::joined(circle(500.0, 30.0)),
            ],
            ..Drawing::default()
        };
        let mut surface = Surface::default();
        surface.follow(&drawing);
        let area: f64 = surface.regions.iter().flatten().map(|r| polygon::signed_area(r)).sum();
        let covered: f64 = surface.trapezoids.iter().map(|t| polygon::signed_area(t)).sum();
        assert!((covered / area - 1.0).abs() < 1e-9, "{covered} {area}");
        assert_eq!((surface.pieces, surface.holes), (2, 1));
        assert!(surface.trapezoids.iter().all(|t| polygon::signed_area(t) > -1e-6));
        surface.follow(&Drawing::default());
        assert!(surface.trapezoids.is_empty() && surface.pieces == 0);
    }
}
