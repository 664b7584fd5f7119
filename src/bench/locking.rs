//! How much linear triangles lock: the tip deflection of a cantilever under its own small weight, over `kappa/mu`.
//!
//! Measured against a closed form, Timoshenko's beam, so that no fine mesh that locks itself stands in the way. For the
//! two-dimensional solid of eq. 5 at small strain (`lambda = kappa`) the modulus of a bar is `E = 4 mu (kappa + mu) / (kappa + 2 mu)`;
//! a bar of length `L` and height `h` under the load `q` per length bends by
//! `q L^4 / (8 E I) + q L^2 / (2 k mu h)` with `I = h^3/12` and the shear factor `k = 5/6`. Below one the mesh is too stiff.

use super::plot::{Plot, Series};
use super::shapes::Subject;
use super::{BenchError, Session, Table};
use crate::design::{Design, FiberSet, Gravity, Pin};
use crate::mesh;
use crate::outline::Outline;
use crate::physics::NeoHookean;

/// Ratios `kappa/mu`; 1.5 is the default material.
const RATIOS: [f64; 7] = [0.5, 1.5, 5.0, 10.0, 30.0, 100.0, 1000.0];
/// Shear modulus, N/mm.
const MU: f64 = crate::defaults::MU;
/// Length and height of the bar, mm: slender enough for beam theory, as thick as a limb.
const BAR: [f64; 2] = [200.0, 20.0];
/// Deflection at the closed form's stiffest, as a part of the length: small strains, far above rounding.
const DEFLECTION: f64 = 0.002;
/// Stiffness of each pin of the clamped end, N/mm: rigid beside the bar.
const CLAMP: f64 = 1e5;
/// m/s^2, downwards.
const ACCELERATION: f64 = 9.81;

pub struct Locking {
    /// Numbers of mesh edges.
    pub edges: Vec<usize>,
}

impl Locking {
    /// Runs the study.
    ///
    /// # Errors
    /// A mesh without equilibrium, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<(Table, Plot), BenchError> {
        let mut table = Table::new(
            "locking",
            "Locking: tip deflection of a 200 mm x 20 mm cantilever, relative to beam theory (1: none)",
            &["edges", "nodes at the clamp", "kappa/mu", "relative"],
        );
        let mut series = Vec::new();
        for &edges in &self.edges {
            session.next(&format!("locking, {edges} edges"))?;
            let mut curve = Vec::new();
            for ratio in RATIOS {
                session.check()?;
                let (clamped, relative) = relative_deflection(edges, ratio, session)?;
                table.push(vec![edges.into(), clamped.into(), ratio.into(), relative.into()]);
                curve.push((ratio, relative));
            }
            series.push(Series::line(format!("{edges} edges"), curve));
        }
        let plot = Plot {
            name: "locking".into(),
            title: "Locking of linear triangles: a cantilever".into(),
            x_label: "kappa/mu".into(),
            y_label: "deflection relative to beam theory".into(),
            log_x: true,
            log_y: false,
            series,
        };
        Ok((table, plot))
    }
}

/// Load per length that bends the bar by [`DEFLECTION`] where it is stiffest (`kappa` without end: `E = 4 mu`), N/mm.
fn load() -> f64 {
    let [length, height] = BAR;
    8.0 * (4.0 * MU) * (height.powi(3) / 12.0) * DEFLECTION / length.powi(3)
}

/// Deflection of the tip by beam theory, mm.
fn beam(ratio: f64) -> f64 {
    let ([length, height], kappa) = (BAR, ratio * MU);
    let modulus = 4.0 * MU * (kappa + MU) / (kappa + 2.0 * MU);
    let bending = load() * length.powi(4) / (8.0 * modulus * height.powi(3) / 12.0);
    bending + load() * length.powi(2) / (2.0 * (5.0 / 6.0) * MU * height)
}

/// Nodes at the clamp, and the deflection of the tip relative to beam theory.
fn relative_deflection(edges: usize, ratio: f64, session: &Session) -> Result<(usize, f64), BenchError> {
    let [length, height] = BAR;
    let outer = vec![[0.0, 0.0], [length, 0.0], [length, height], [0.0, height]];
    let outline = Outline { outer, holes: Vec::new() };
    let mesh = mesh::generate(&outline, edges).map_err(|source| BenchError::Mesh { shape: "bar".into(), source })?;
    let clamped = (0..mesh.nodes.len()).filter(|&n| mesh.nodes[n][0] == 0.0).filter_map(|n| mesh.node_point(n));
    let pins: Vec<Pin> = clamped.map(|at| Pin::at_rest(at, CLAMP)).collect();
    let tip: Vec<usize> = (0..mesh.nodes.len()).filter(|&n| mesh.nodes[n][0] == length).collect();
    let mut design = Design::new("bar", outline, mesh);
    design.pins = pins;
    design.fibers.set = FiberSet::Routings(Vec::new());
    design.material = NeoHookean { mu: MU, kappa: ratio * MU }.into();
    let surface_density = load() / (height * ACCELERATION);
    design.gravity = Some(Gravity { acceleration: [0.0, -ACCELERATION], surface_density });
    let clamped = design.pins.len();
    let mut subject = Subject::of("bar", design)?;
    let rest = subject.plushie.model.rest.clone();
    let x = subject.settle(&[], &rest, session.stop)?;
    let down: f64 = tip.iter().map(|n| rest[2 * n + 1] - x[2 * n + 1]).sum();
    Ok((clamped, down / (tip.len() as f64 * beam(ratio))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_fine_mesh_of_an_ordinary_material_bends_as_a_beam() {
        let cancel = AtomicBool::new(false);
        let session = Session { seed: 1, stop: &|| false, cancel: &cancel, progress: &|_| {}, found: &|_| {} };
        let (_, fine) = relative_deflection(3000, 1.5, &session).unwrap();
        assert!((fine - 1.0).abs() < 0.03, "{fine}");
        let (_, coarse) = relative_deflection(300, 1000.0, &session).unwrap();
        assert!(coarse < 0.9, "{coarse}");
    }
}
