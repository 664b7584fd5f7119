//! Pieces that lie within others: a gap all around, as colour leaves it to the line around it, parts what is one figure.

use super::regions::{self, Shapes};
use super::{OutlineError, Point, polygon};
use i_overlay::core::fill_rule::FillRule;

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
    // Of each piece the smallest hole around it, by its area, and whether pieces take that up.
    let mut around: Vec<Option<(f64, bool)>> = vec![None; shapes.len()];
    let mut contours: Vec<Vec<Point>> = Vec::new();
    let mut count = 0;
    for (k, rings) in shapes.iter().enumerate() {
        for hole in &rings[1..] {
            let (low, high) = polygon::bounding_box(hole);
            let column = by_x.partition_point(|(p, _)| p[0] < low[0])..by_x.partition_point(|(p, _)| p[0] <= high[0]);
            let lies_in =
                |(p, i): &&(Point, usize)| *i != k && (low[1]..=high[1]).contains(&p[1]) && polygon::contains(hole, *p);
            let within: Vec<usize> = by_x[column].iter().filter(lies_in).map(|(_, i)| *i).collect();
            let islands: Shapes = within.iter().map(|i| vec![shapes[*i][0].clone()]).collect();
            let room = polygon::signed_area(hole).abs();
            let taken = !islands.is_empty() && regions::area(&regions::union(islands)?) > COVERS * room;
            for i in within {
                if around[i].is_none_or(|(area, _)| room < area) {
                    around[i] = Some((room, taken));
                }
            }
            if taken {
                count += 1;
            } else {
                contours.push(hole.clone());
            }
        }
    }
    if count == 0 {
        return Ok(None);
    }
    // A hole that is filled covers the pieces in it, but what these leave open stays open: a ring in a hole makes no disc of it.
    let is_covered = |k: usize| around[k].is_some_and(|(_, taken)| taken);
    contours.extend(shapes.iter().enumerate().filter(|(k, _)| !is_covered(*k)).map(|(_, rings)| rings[0].clone()));
    Ok(Some((regions::resolve(&contours, FillRule::NonZero)?, count)))
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
        // A ring in a hole leaves its own hole open, and what lies in that is there.
        let (shapes, count) = joined(&vec![ring(10.0, 9.0), ring(8.0, 7.0), vec![square(3.0)]]).unwrap().unwrap();
        assert_eq!((shapes.len(), shapes.iter().map(Vec::len).sum::<usize>(), count), (2, 3, 1));
        assert!((regions::area(&shapes) - (400.0 - 196.0 + 36.0)).abs() < 1e-6);
    }
}
