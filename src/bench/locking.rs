//! How much linear triangles lock: the displacement under a fixed load, relative to that of a fine mesh, over `kappa/mu`.
//!
//! The load is gravity across the pinned body, without fibres. Below one the mesh is too stiff. The fine mesh is of linear
//! triangles too and locks a little itself, so that the figures flatter at large ratios.

use super::plot::{Plot, Series};
use super::shapes::Subject;
use super::trade::{Common, bare};
use super::{BenchError, Cell, Session, Table};
use crate::design::{Design, Gravity, Material};

/// Ratios `kappa/mu`; 1.5 is the default material.
const RATIOS: [f64; 6] = [0.5, 1.5, 5.0, 20.0, 100.0, 1000.0];
/// Shear modulus, N/mm.
const MU: f64 = crate::defaults::MU;
/// Weight of the body as a part of shear modulus times body length.
const WEIGHT: f64 = 0.2;
/// m/s^2, to the side.
const ACCELERATION: [f64; 2] = [9.81, 0.0];

pub struct Locking {
    pub shapes: Vec<String>,
    pub fibers: Vec<usize>,
    pub reference: usize,
}

impl Locking {
    pub fn run(&self, session: &Session) -> Result<(Table, Plot), BenchError> {
        let mut table = Table::new(
            "locking",
            "Locking: rms displacement under a load to the side, relative to the reference mesh (1: none)",
            &["shape", "fibres", "kappa/mu", "displacement / body", "relative"],
        );
        let mut series = Vec::new();
        for shape in &self.shapes {
            session.next(&format!("{shape}, locking, reference"))?;
            let common = Common::of(shape)?;
            let fine = self.displacements(shape, self.reference, &common, session)?;
            for &fibers in &self.fibers {
                session.next(&format!("{shape}, locking, {fibers} fibres"))?;
                let coarse = self.displacements(shape, fibers, &common, session)?;
                let mut curve = Vec::new();
                for ((ratio, coarse), fine) in RATIOS.iter().zip(&coarse).zip(&fine) {
                    let row: Vec<Cell> = vec![
                        shape.clone().into(),
                        fibers.into(),
                        (*ratio).into(),
                        (*coarse).into(),
                        (coarse / fine).into(),
                    ];
                    table.push(row);
                    curve.push((*ratio, coarse / fine));
                }
                series.push(Series::line(format!("{shape}, {fibers} fibres"), curve));
            }
        }
        let plot = Plot {
            name: "locking".into(),
            title: "Locking of linear triangles".into(),
            x_label: "kappa/mu".into(),
            y_label: "displacement relative to the fine mesh".into(),
            log_x: true,
            log_y: false,
            series,
        };
        Ok((table, plot))
    }

    /// The rms displacement at every ratio, in body lengths.
    fn displacements(
        &self,
        shape: &str,
        fibers: usize,
        common: &Common,
        session: &Session,
    ) -> Result<Vec<f64>, BenchError> {
        let design = bare(shape, fibers)?;
        let length = design.body_length_mm();
        // The same weight on every mesh, whose areas differ by the curvature of the outline.
        let surface_density = WEIGHT * MU * length / (ACCELERATION[0] * design.mesh.area());
        let mut out = Vec::new();
        for ratio in RATIOS {
            session.check()?;
            let loaded = Design {
                material: Material::NeoHookean { mu: MU, kappa: ratio * MU },
                gravity: Some(Gravity { acceleration: ACCELERATION, surface_density }),
                ..design.clone()
            };
            let mut subject = Subject::of(shape, loaded)?;
            let rest = subject.plushie.model.rest.clone();
            let x = subject.settle(&[], &rest, session.stop)?;
            out.push(common.displacement(&subject.design, &x) / length);
        }
        Ok(out)
    }
}
