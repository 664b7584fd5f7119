//! A target acts on a small patch of the body, not on a point.
//!
//! A force at a point of an elastic plane displaces that point without limit as the mesh gets finer (Kelvin's solution grows
//! with the logarithm of the distance), so a pose that hangs on points would change with every refinement. The place of a
//! target is therefore read off the nodes around it by moving least squares with linear terms: weights that sum to one and
//! reproduce every affine motion exactly, so that the patch turns and stretches with the body and rests where the point does.
//! On a coarse mesh, where the patch holds hardly more than the point's own triangle, it is the point itself.

use crate::mesh::{BodyPoint, Mesh};
use crate::outline::Point;
use nalgebra::{Matrix3, Vector3};

/// Radius of a patch as a part of the body length: about a fingertip on a plushie of 300 mm.
const RADIUS: f64 = 0.03;
/// With fewer nodes in its radius a target is a point: three would be enough for an affine motion, but then a single
/// node decides.
const FEWEST_NODES: usize = 8;
/// Largest sum of the weights' sizes. In a tip a patch lies on one side of its point and must extrapolate; beyond this it is
/// too lopsided for that.
const LARGEST_WEIGHT: f64 = 3.0;

/// The nodes that carry a target at `at`, and their weights.
pub fn patch(mesh: &Mesh, at: &BodyPoint) -> (Vec<usize>, Vec<f64>) {
    let center = mesh.position(at, &mesh.nodes);
    let nodes = around(mesh, at, center, RADIUS * mesh.body_length());
    let weights = (nodes.len() >= FEWEST_NODES).then(|| moving_least_squares(mesh, &nodes, center)).flatten();
    match weights {
        Some(weights) => (nodes, weights),
        None => point(mesh, at),
    }
}

/// The nodes that carry a body point, and their weights; nodes of weight zero are left out.
pub fn point(mesh: &Mesh, at: &BodyPoint) -> (Vec<usize>, Vec<f64>) {
    let nodes = mesh.triangles[at.triangle];
    nodes.iter().zip(at.weights).filter(|(_, w)| *w != 0.0).map(|(n, w)| (*n, w)).unzip()
}

/// The nodes of a region about a point: those within the radius that hang together with it there, and those of its triangle.
pub fn region(mesh: &Mesh, at: &BodyPoint, radius: f64) -> Vec<usize> {
    let center = mesh.position(at, &mesh.nodes);
    let own = mesh.triangles[at.triangle];
    connected(mesh, at, |n| own.contains(&n) || distance(mesh.nodes[n], center) <= radius)
}

/// Nodes nearer than `radius`, connected with the point within that radius: the limb next to it does not count.
fn around(mesh: &Mesh, at: &BodyPoint, center: Point, radius: f64) -> Vec<usize> {
    let near = |n: usize| distance(mesh.nodes[n], center) < radius;
    if (0..mesh.nodes.len()).filter(|&n| near(n)).count() < FEWEST_NODES {
        return Vec::new();
    }
    connected(mesh, at, near)
}

/// Nodes of a kind that are connected with the point by triangles with such nodes.
fn connected(mesh: &Mesh, at: &BodyPoint, near: impl Fn(usize) -> bool) -> Vec<usize> {
    let near: Vec<bool> = (0..mesh.nodes.len()).map(near).collect();
    let triangles: Vec<&[usize; 3]> = mesh.triangles.iter().filter(|t| t.iter().any(|&n| near[n])).collect();
    let mut found = vec![false; mesh.nodes.len()];
    for &node in &mesh.triangles[at.triangle] {
        found[node] = near[node];
    }
    loop {
        let mut grown = false;
        for t in &triangles {
            if t.iter().any(|&n| found[n]) {
                for &n in t.iter() {
                    grown |= near[n] && !found[n];
                    found[n] |= near[n];
                }
            }
        }
        if !grown {
            return (0..found.len()).filter(|&n| found[n]).collect();
        }
    }
}

/// `w_i = phi_i p_i^T (sum_j phi_j p_j p_j^T)^-1 p_0` with `p = (1, dx, dy)` and `phi = (1 - d^2/r^2)^2`, `r` a little
/// beyond the farthest node.
fn moving_least_squares(mesh: &Mesh, nodes: &[usize], center: Point) -> Option<Vec<f64>> {
    let farthest = nodes.iter().map(|&n| distance(mesh.nodes[n], center)).fold(0.0, f64::max);
    let radius = 1.05 * farthest;
    let basis = |n: usize| {
        let p = mesh.nodes[n];
        Vector3::new(1.0, (p[0] - center[0]) / radius, (p[1] - center[1]) / radius)
    };
    let bump = |p: &Vector3<f64>| (1.0 - p.y * p.y - p.z * p.z).powi(2);
    let mut moments = Matrix3::zeros();
    for &n in nodes {
        let p = basis(n);
        moments += bump(&p) * p * p.transpose();
    }
    let factor = moments.cholesky()?.solve(&Vector3::new(1.0, 0.0, 0.0));
    let weights: Vec<f64> = nodes
        .iter()
        .map(|&n| {
            let p = basis(n);
            bump(&p) * p.dot(&factor)
        })
        .collect();
    let size: f64 = weights.iter().map(|w| w.abs()).sum();
    (size <= LARGEST_WEIGHT).then_some(weights)
}

fn distance(p: Point, q: Point) -> f64 {
    (q[0] - p[0]).hypot(q[1] - p[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Design, Pin, bundled};
    use crate::engine::compile::{View, compile};

    fn pig(fibers: usize) -> Design {
        let pig = bundled::ALL.iter().map(|b| b.design().unwrap()).find(|d| d.name == "pig").unwrap();
        let mesh = crate::mesh::generate(&pig.outline, fibers).unwrap();
        let pins: Vec<Pin> = pig
            .pins
            .iter()
            .map(|pin| {
                let at = mesh.locate_nearest(pig.mesh.position(&pin.at, &pig.mesh.nodes), &mesh.nodes).unwrap().0;
                Pin { at, ..*pin }
            })
            .collect();
        Design { mesh: mesh.into(), pins, networks: Vec::new(), poses: Vec::new(), keyframes: Vec::new(), ..pig }
    }

    fn mesh(fibers: usize) -> Mesh {
        Mesh::clone(&pig(fibers).mesh)
    }

    /// Some points of the body: nodes on the outline as well as inside.
    fn places(mesh: &Mesh) -> Vec<BodyPoint> {
        (0..mesh.nodes.len()).step_by(mesh.nodes.len() / 40).filter_map(|n| mesh.node_point(n)).collect()
    }

    #[test]
    fn an_affine_motion_carries_a_patch_like_its_point() {
        let mesh = mesh(10_000);
        let turned = |p: Point| [2.0 + 0.3 * p[0] - 1.1 * p[1], 5.0 + 0.9 * p[0] + 0.4 * p[1]];
        let mut patches = 0;
        for at in places(&mesh) {
            let (nodes, weights) = patch(&mesh, &at);
            patches += (nodes.len() >= FEWEST_NODES) as usize;
            let there = turned(mesh.position(&at, &mesh.nodes));
            for (axis, place) in there.into_iter().enumerate() {
                let read: f64 = nodes.iter().zip(&weights).map(|(&n, w)| w * turned(mesh.nodes[n])[axis]).sum();
                assert!((read - place).abs() < 1e-9 * mesh.body_length());
            }
        }
        assert!(patches >= 40, "{patches}");
    }

    #[test]
    fn on_a_coarse_mesh_a_target_is_a_point() {
        let mesh = mesh(414);
        for at in places(&mesh) {
            assert_eq!(patch(&mesh, &at), point(&mesh, &at));
        }
    }

    #[test]
    fn a_patch_is_small_and_connected() {
        let mesh = mesh(10_000);
        for at in places(&mesh) {
            let center = mesh.position(&at, &mesh.nodes);
            let (nodes, _) = patch(&mesh, &at);
            let far = nodes.iter().map(|&n| distance(mesh.nodes[n], center)).fold(0.0, f64::max);
            assert!(far <= RADIUS * mesh.body_length());
            assert!(nodes.iter().any(|n| mesh.triangles[at.triangle].contains(n)));
        }
    }

    /// How far a target moves under a unit force on it settles down with refinement; that of a point grows on.
    #[test]
    fn the_compliance_of_a_patch_stays_as_the_mesh_gets_finer() {
        let compliance = |fibers: usize, patched: bool| {
            let design = pig(fibers);
            let mut plushie = compile(&design, View::Idealized).unwrap();
            let mesh = &design.mesh;
            let middle = [0.5 * mesh.body_length(), 0.35 * mesh.body_length()];
            let (at, _) = mesh.locate_nearest(middle, &mesh.nodes).unwrap();
            let (nodes, weights) = if patched { patch(mesh, &at) } else { point(mesh, &at) };
            let model = &mut plushie.model;
            let rest = model.rest.clone();
            model.factorize_for_descent(&rest).unwrap();
            let mut force = vec![0.0; rest.len()];
            for (&n, w) in nodes.iter().zip(&weights) {
                force[2 * n] += w;
            }
            let load = force.clone();
            model.solve(&mut force);
            load.iter().zip(&force).map(|(f, u)| f * u).sum::<f64>()
        };
        let growth = |patched| compliance(20_000, patched) / compliance(5_000, patched) - 1.0;
        let (of_patch, of_point) = (growth(true), growth(false));
        assert!(of_point > 0.1 && of_patch.abs() < 0.3 * of_point, "patch {of_patch}, point {of_point}");
    }
}
