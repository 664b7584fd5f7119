//! Pieces that lie within others: a gap all around, as colour leaves it to the line around it, parts what is one figure.

use super::regions::{self, Shapes};
use super::{OutlineError, polygon};

/// A hole is filled where the pieces in it cover this part of it: they are the figure, and the hole a gap around them.
const COVERS: f64 = 0.5;

/// Fills holes that other pieces take up for the most part; also how many.
///
/// # Errors
/// The union is too complex.
pub(super) fn joined(shapes: Shapes) -> Result<(Shapes, usize), OutlineError> {
    if shapes.len() < 2 || shapes.iter().all(|rings| rings.len() < 2) {
        return Ok((shapes, 0));
    }
    let mut count = 0;
    let mut all: Shapes = Vec::with_capacity(shapes.len());
    for (k, rings) in shapes.iter().enumerate() {
        let mut kept = rings[..1].to_vec();
        for hole in &rings[1..] {
            let islands =
                shapes.iter().enumerate().filter(|(i, other)| *i != k && polygon::contains(hole, other[0][0]));
            let islands: Shapes = islands.map(|(_, other)| vec![other[0].clone()]).collect();
            let room = polygon::signed_area(hole).abs();
            if !islands.is_empty() && regions::area(&regions::union(islands)?) > COVERS * room {
                count += 1;
            } else {
                kept.push(hole.clone());
            }
        }
        all.push(kept);
    }
    if count == 0 { Ok((shapes, 0)) } else { Ok((regions::union(all)?, count)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::Point;

    fn square(r: f64) -> Vec<Point> {
        vec![[-r, -r], [r, -r], [r, r], [-r, r]]
    }

    #[test]
    fn a_hole_that_an_island_fills_is_none_and_a_pond_with_a_duck_is() {
        let ring = |outer: f64, inner: f64| vec![square(outer), square(inner).into_iter().rev().collect()];
        let (shapes, count) = joined(vec![ring(10.0, 9.0), ring(8.0, 7.0), vec![square(6.0)]]).unwrap();
        assert_eq!((shapes.len(), shapes[0].len(), count), (1, 1, 2));
        assert!((regions::area(&shapes) - 400.0).abs() < 1e-6);
        let pond = vec![ring(10.0, 9.0), vec![square(3.0)]];
        assert_eq!(joined(pond.clone()).unwrap(), (pond, 0));
    }
}
