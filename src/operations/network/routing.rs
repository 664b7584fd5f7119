//! What changes of networks are made of: places of the body, tendons by their numbers.

use crate::design::edit::{self, EditError};
use crate::design::{Design, MaterialPoint, Network, Tendon};
use crate::operations::pose::{body_point, rounded};
use crate::outline::{Point, polygon};

/// The point of the body at rest that a place means, to the micrometre.
pub fn material_point(design: &Design, place: Point) -> Result<MaterialPoint, EditError> {
    let at = body_point(&design.mesh, rounded(place))?;
    Ok(MaterialPoint::of_triangle(design.mesh.triangles[at.triangle], at.weights))
}

/// The points of the body that places mean; one at least.
pub fn through(design: &Design, places: &[Point]) -> Result<Vec<MaterialPoint>, EditError> {
    if places.is_empty() {
        return Err(EditError::NoEnd);
    }
    places.iter().map(|&place| material_point(design, place)).collect()
}

/// A number that is less than how many there are.
pub fn check(what: &'static str, index: usize, len: usize) -> Result<(), EditError> {
    if index < len { Ok(()) } else { Err(EditError::Missing { what, index, len }) }
}

pub fn network(design: &mut Design, index: usize) -> Result<&mut Network, EditError> {
    check("network", index, design.networks.len())?;
    Ok(&mut design.networks[index])
}

pub fn tendon(network: &mut Network, index: usize) -> Result<&mut Tendon, EditError> {
    check("tendon", index, network.tendons.len())?;
    Ok(&mut network.tendons[index])
}

/// Changes a network, unless that is refused or unsound.
pub fn with_network<T>(
    design: &mut Design,
    index: usize,
    change: impl FnOnce(&mut Network) -> Result<T, EditError>,
) -> Result<T, EditError> {
    let mut changed = network(design, index)?.clone();
    let outcome = change(&mut changed)?;
    edit::set_network(design, index, changed)?;
    Ok(outcome)
}

/// Takes a tendon from its winch, and the winch away where it has no other. The tendon, and whether the winch is still there.
pub fn take_tendon(design: &mut Design, winch: usize, index: usize) -> Result<(Tendon, bool), EditError> {
    let count = network(design, winch)?.tendons.len();
    check("tendon", index, count)?;
    if count == 1 {
        let mut network = edit::remove_network(design, winch)?;
        return Ok((network.tendons.remove(index), false));
    }
    let taken = with_network(design, winch, |network| Ok(network.tendons.remove(index)))?;
    Ok((taken, true))
}

/// A place for a second winch, mm: a housing and the space between two away from the first, towards the first holes of its tendons; where
/// that leaves the body, at the nearest place on it.
pub fn beside(design: &Design, winch: usize, tendons: &[Tendon]) -> Point {
    let nodes = &design.mesh.nodes;
    let from = design.networks[winch].winch().map_or([0.0; 2], |point| point.place(nodes));
    let holes = tendons.iter().filter_map(|tendon| tendon.routing.get(1)).map(|point| point.place(nodes));
    let count = tendons.len().max(1) as f64;
    let mean = holes.fold([0.0; 2], |sum, p| [sum[0] + p[0] / count, sum[1] + p[1] / count]);
    let length = polygon::length(from, mean);
    // Holes all around: any direction is as good.
    let way = if length > 0.0 { [(mean[0] - from[0]) / length, (mean[1] - from[1]) / length] } else { [1.0, 0.0] };
    let apart = design.sewing.housing_mm + design.sewing.between_housings_mm;
    let place = [from[0] + apart * way[0], from[1] + apart * way[1]];
    design.mesh.locate_nearest(place, nodes).map_or(from, |(at, _)| design.mesh.position(&at, nodes))
}
