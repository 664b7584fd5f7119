//! What the parts of a drawing cover together, cut into trapezoids that can be filled, and what there is to say about it.

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
    /// Width and height of the box around everything, mm.
    pub size: [f64; 2],
    /// Without specks.
    pub pieces: usize,
    pub holes: usize,
    /// Why there is no area, if so.
    pub trouble: Option<String>,
}

impl Surface {
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
        *self = Self { of: Some(drawing.clone()), regions, trapezoids, size, pieces, holes, trouble };
    }
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
