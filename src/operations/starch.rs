//! Starch: parts of a body that are stiffer or softer than the rest.

use super::pose::body_point;
use super::{Cancelled, Context};
use crate::design::Design;
use crate::design::edit::{self, EditError};
use crate::outline::Point;
use serde::{Deserialize, Serialize};

/// A dab of starch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// A place of the body at rest, mm.
    pub at: Point,
    /// Triangles whose middle is so near are starched, mm.
    pub radius_mm: f64,
    /// Stiffness there, as a multiple of the material's; 1 takes the starch away.
    pub factor: f64,
    /// Takes all starch of the body away first.
    pub clear: bool,
}

/// Why nothing was starched.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error("the radius must be a positive number of mm")]
    NoRadius,
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Default for Options {
    fn default() -> Self {
        Self { at: [0.0; 2], radius_mm: 20.0, factor: 4.0, clear: false }
    }
}

/// Starches a body at a place; how many triangles are of another stiffness than the material then.
///
/// # Errors
/// The place is not on the body, or the factor is out of range; the design is as it was then.
pub fn run(design: &mut Design, options: &Options, context: &Context) -> Result<usize, Error> {
    context.check()?;
    if options.radius_mm.is_nan() || options.radius_mm <= 0.0 {
        return Err(Error::NoRadius);
    }
    body_point(&design.mesh, options.at)?;
    let mut map = if options.clear { None } else { design.stiffness_map.clone() };
    map = dabbed(design, map, options.at, options.radius_mm, options.factor);
    edit::set_stiffness_map(design, map)?;
    Ok(starched(design))
}

/// Takes all starch away.
///
/// # Errors
/// None of a sound design.
pub fn clear(design: &mut Design) -> Result<(), EditError> {
    edit::set_stiffness_map(design, None)
}

/// Starches around a place of the body at rest, without asking whether it is on the body.
///
/// # Errors
/// The factor is out of range.
pub fn dab(design: &mut Design, at: Point, radius_mm: f64, factor: f64) -> Result<(), EditError> {
    let map = dabbed(design, design.stiffness_map.clone(), at, radius_mm, factor);
    edit::set_stiffness_map(design, map)
}

/// How many triangles are of another stiffness than the material.
pub fn starched(design: &Design) -> usize {
    design.stiffness_map.iter().flatten().filter(|&&factor| factor != 1.0).count()
}

/// A map with the factor on all triangles around a place, and on the one that it is in; none where it is 1 all over.
fn dabbed(design: &Design, map: Option<Vec<f64>>, at: Point, radius_mm: f64, factor: f64) -> Option<Vec<f64>> {
    let mesh = &design.mesh;
    let mut map = map.unwrap_or_else(|| vec![1.0; mesh.triangles.len()]);
    let inside = mesh.locate_nearest(at, &mesh.nodes).filter(|(_, miss)| *miss <= radius_mm).map(|(p, _)| p.triangle);
    for (k, (triangle, value)) in mesh.triangles.iter().zip(&mut map).enumerate() {
        let middle = [0, 1].map(|axis| triangle.iter().map(|&n| mesh.nodes[n][axis]).sum::<f64>() / 3.0);
        if inside == Some(k) || (middle[0] - at[0]).hypot(middle[1] - at[1]) <= radius_mm {
            *value = factor;
        }
    }
    map.iter().any(|&value| value != 1.0).then_some(map)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_dab_is_taken_away_by_one_of_factor_one() {
        let mut design = testing::sample();
        let before = design.clone();
        let go = AtomicBool::new(false);
        let dab = |factor: f64| Options { at: [30.0, 5.0], radius_mm: 6.0, factor, clear: false };
        // The triangle at the bottom has its middle at (30, 10).
        assert_eq!(run(&mut design, &dab(4.0), &Context::new(&go)), Ok(1));
        assert_eq!(design.stiffness_map, Some(vec![4.0, 1.0, 1.0, 1.0]));
        design.validate().unwrap();
        assert!(run(&mut design, &dab(1e9), &Context::new(&go)).is_err());
        let off = Options { at: [500.0, 5.0], ..dab(2.0) };
        assert!(matches!(run(&mut design, &off, &Context::new(&go)), Err(Error::Edit(EditError::OffBody { .. }))));
        assert_eq!(run(&mut design, &dab(1.0), &Context::new(&go)), Ok(0));
        assert_eq!(design, before);
    }
}
