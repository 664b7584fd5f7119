//! Pieces that lie within others: a gap all around, as colour leaves it to the line around it, parts what is one figure.

use super::regions::{self, Shapes};
use super::{OutlineError, Point, polygon};

/// A hole is filled where the pieces in it cover this part of it: they are the figure, and the hole a gap around them.
const COVERS: f64 = 0.5;

/// The shapes with holes filled that other pieces take up for the most part, and how many; `None` where there is no such hole.
///
/// # Errors
/// The union is too complex.
pub(super) fn joined(shapes: &Shapes) -> Result<Option<(Shapes, usize)>, OutlineError> {
    if shapes.len() < 2 || shapes.iter().all(|rings| rings.len() < 2) {
        return Ok(None);
    }
    // A halftone has thousands of pieces and of holes: pieces are looked for in the column of a hole.
    let mut by_x: Vec<(Point, usize)> = shapes.iter().enumerate().map(|(k, rings)| (rings[0][0], k)).collect();
    by_x.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let mut count = 0;
    let mut all: Shapes = Vec::with_capacity(shapes.len());
    for (k, rings) in shapes.iter().enumerate() {
        let mut kept = rings[..1].to_vec();
        for hole in &rings[1..] {
            let (low, high) = polygon::bounding_box(hole);
            let column = by_x.partition_point(|(p, _)| p[0] < low[0])..by_x.partition_point(|(p, _)| p[0] <= high[0]);
            let lies_in =
                |(p, i): &&(Point, usize)| *i != k && (low[1]..=high[1]).contains(&p[1]) && polygon::contains(hole, *p);
            let islands: Shapes =
                by_x[column].iter().filter(lies_in).map(|(_, i)| vec![shapes[*i][0].clone()]).collect();
            let room = polygon::signed_area(hole).abs();
            if !islands.is_empty() && regions::area(&regions::union(islands)?) > COVERS * room {
                count += 1;
            } else {
                kept.push(hole.clone());
            }
        }
        all.push(kept);
    }
    if count == 0 { Ok(None) } else { Ok(Some((regions::union(all)?, count))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(r: f64) -> Vec<Point> {
        vec![[-r, -r], [r, -r], [r, r], [-r, r]]
    }

    #[test]
    fn a_hole_that_an_island_fills_is_none_and_a_pond_with_a_duck_is() {
        let ring = |outer: f64, inner: f64| vec![square(outer), square(inner).into_iter().rev().collect()];
        let (shapes, count) = joined(&vec![ring(10.0, 9.0), ring(8.0, 7.0), vec![square(6.0)]]).unwrap().unwrap();
        assert_eq!((shapes.len(), shapes[0].len(), count), (1, 1, 2));
        assert!((regions::area(&shapes) - 400.0).abs() < 1e-6);
        let pond = vec![ring(10.0, 9.0), vec![square(3.0)]];
        assert_eq!(joined(&pond).unwrap(), None);
    }
}
