//! `bench resolution`: the same pose at several resolutions, and with a coarse fibre set on a fine mesh (fig. 8 of the paper): how far
//! poses, activations and networks agree.
//!
//! Poses are compared at common body points. Activations are compared as fields: the relative contraction of the fibres that
//! pull, averaged with their rest lengths as weights around common points. Networks are compared by what they reach.

use super::drags::towards;
use super::plot::{Plot, Series};
use super::posing::{at_rest, free_fibers, optimum};
use super::shapes::{Subject, design};
use super::trade::{Common, first_pose, rms};
use super::{BenchError, Cell, Report, Session, Table};
use crate::design::{Design, FiberSet};
use crate::outline::Point;
use crate::rigging::{self, ProposeOptions};
use crate::soft_ik::{Posture, Question};

/// Radius over which activations are averaged, in body lengths.
const RADIUS: f64 = 0.08;
/// A fibre pulls where its tension is above this part of the largest.
const PULLING: f64 = 1e-3;

/// Shapes and sizes of the study.
pub struct Resolution {
    pub shapes: Vec<String>,
    /// Ascending; the last is the reference, and the mesh that carries the coarse fibre set.
    pub fibers: Vec<usize>,
    /// Fibres of the coarse set.
    pub coarse: usize,
    /// Networks are discovered up to this many fibres.
    pub networks_up_to: usize,
}

/// One resolution, solved.
struct Level {
    what: String,
    fibers: usize,
    triangles: usize,
    length: f64,
    target_error: f64,
    positions: Vec<Point>,
    field: Vec<f64>,
    network: Option<Network>,
}

/// The best network found for the pose. Errors in body lengths.
struct Network {
    holes: usize,
    before: f64,
    after: f64,
    winch: Point,
}

impl Resolution {
    /// Runs the study.
    ///
    /// # Errors
    /// A shape that cannot be meshed or posed, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let mut table = Table::new(
            "resolution",
            "The first pose of the design; distances and errors in body lengths, against the last mesh of all edges",
            &[
                "shape",
                "fibres",
                "triangles",
                "target error",
                "pose apart",
                "activations apart",
                "correlation",
                "holes",
                "error without network",
                "error with network",
                "winch apart",
            ],
        );
        let mut series = Vec::new();
        for shape in &self.shapes {
            let common = Common::of(shape)?;
            let mut levels = Vec::new();
            for &fibers in &self.fibers {
                session.next(&format!("{shape}, {fibers} fibres"))?;
                levels.push(self.level(shape, design(shape, fibers)?, String::new(), &common, session)?);
            }
            let Some(reference) = levels.len().checked_sub(1) else { continue };
            session.next(&format!("{shape}, coarse fibres on a fine mesh"))?;
            let fine = coarse_fibers(shape, self.coarse, design(shape, self.fibers[reference])?)?;
            levels.push(self.level(shape, fine, " on the fine mesh".into(), &common, session)?);
            // The finest mesh on which networks were asked for.
            let known = levels[..=reference].iter().rev().find_map(|level| level.network.as_ref());
            let mut curve = Vec::new();
            for level in &levels {
                let fine = &levels[reference];
                let apart = rms(&level.positions, &fine.positions) / level.length;
                let (distance, correlation) = compare(&level.field, &fine.field);
                let network = level.network.as_ref();
                let winch = network.zip(known);
                let winch = winch.map(|(a, b)| (a.winch[0] - b.winch[0]).hypot(a.winch[1] - b.winch[1]) / level.length);
                let row: Vec<Cell> = vec![
                    shape.clone().into(),
                    format!("{}{}", level.fibers, level.what).into(),
                    level.triangles.into(),
                    level.target_error.into(),
                    apart.into(),
                    distance.into(),
                    correlation.into(),
                    network.map(|n| n.holes as f64).into(),
                    network.map(|n| n.before).into(),
                    network.map(|n| n.after).into(),
                    winch.into(),
                ];
                table.push(row);
                if level.what.is_empty() {
                    curve.push((level.fibers as f64, apart));
                }
            }
            series.push(Series::line(shape.clone(), curve));
        }
        let plot = Plot {
            name: "resolution".into(),
            title: "How far a pose is from that on the finest mesh".into(),
            x_label: "muscle fibres".into(),
            y_label: "rms distance, body lengths".into(),
            log_x: true,
            log_y: true,
            series,
        };
        let title = "The same pose at several resolutions".to_owned();
        Ok(Report { title, tables: vec![table], plots: vec![plot], ..Default::default() })
    }

    fn level(
        &self,
        shape: &str,
        design: Design,
        what: String,
        common: &Common,
        session: &Session,
    ) -> Result<Level, BenchError> {
        let mut subject = Subject::of(shape, design)?;
        let (at, goals) = first_pose(&subject.design)?;
        let objective = towards(&subject, &at, &goals);
        let actuation = free_fibers(&subject);
        let mut question = Question { model: &mut subject.plushie.model, actuation: &actuation, objective: &objective };
        let rest = at_rest(&mut question, session.stop);
        let best = optimum(&mut question, &[&rest], session.stop);
        session.check()?;
        let lost = || BenchError::Nothing(format!("{shape}: the pose has no equilibrium"));
        let posture = best.ok_or_else(lost)?;
        let length = subject.length();
        let target_error = objective.target_error(&posture.x) / length;
        let field = activation_field(&subject, &posture, common, RADIUS * length);
        let network = if subject.fibers() <= self.networks_up_to { self.network(&subject, session) } else { None };
        session.check()?;
        Ok(Level {
            what,
            fibers: subject.fibers(),
            triangles: subject.design.mesh.triangles.len(),
            length,
            target_error,
            positions: common.positions(&subject.design, &posture.x),
            field,
            network,
        })
    }

    fn network(&self, subject: &Subject, session: &Session) -> Option<Network> {
        let targets = &subject.design.poses.first()?.targets;
        let best = rigging::propose(&subject.design, targets, &ProposeOptions::default(), &mut |_| (), session.cancel)
            .into_iter()
            .next()?;
        let winch = best.network.winch()?.place(&subject.design.mesh.nodes);
        Some(Network { holes: best.holes, before: best.error_before(), after: best.error_after(), winch })
    }
}

/// The edges of a coarse mesh as fibres of a fine one: straight, between the nodes nearest to their ends.
fn coarse_fibers(shape: &str, coarse: usize, fine: Design) -> Result<Design, BenchError> {
    let mesh = design(shape, coarse)?.mesh;
    let nearest: Vec<usize> = mesh.nodes.iter().map(|p| fine.mesh.nearest_node(*p, &fine.mesh.nodes)).collect();
    let routings = mesh.edges().into_iter().map(|edge| edge.map(|n| nearest[n]).to_vec());
    let routings = routings.filter(|r| r[0] != r[1]).collect();
    let mut design = fine;
    design.fibers.set = FiberSet::Routings(routings);
    Ok(design)
}

/// The mean relative contraction of the pulling fibres around every common place.
fn activation_field(subject: &Subject, posture: &Posture, common: &Common, radius: f64) -> Vec<f64> {
    let plushie = &subject.plushie;
    let elements = &plushie.model.contractile.elements;
    let tension = |k: usize| {
        let (e, ratio) = plushie.fibers[k].members[0];
        elements[e].tension(elements[e].length(&posture.x) - elements[e].alpha0 + ratio * posture.beta[k])
    };
    let tensions: Vec<f64> = (0..plushie.fibers.len()).map(tension).collect();
    let largest = tensions.iter().fold(0.0_f64, |m, t| m.max(*t));
    let fibers: Vec<(Point, f64, f64)> = (0..plushie.fibers.len())
        .map(|k| {
            let (e, ratio) = plushie.fibers[k].members[0];
            let (routing, rest) = (&elements[e].routing, &plushie.model.rest);
            let (a, b) = (routing[0].at(rest), routing[routing.len() - 1].at(rest));
            let relative = (ratio * posture.beta[k] / elements[e].alpha0).max(0.0);
            let pulls = tensions[k] > PULLING * largest;
            ([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], elements[e].alpha0, if pulls { relative } else { 0.0 })
        })
        .collect();
    let mean = |place: &Point| {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (middle, length, contraction) in &fibers {
            let (dx, dy) = ((middle[0] - place[0]) / radius, (middle[1] - place[1]) / radius);
            let weight = length * (1.0 - dx * dx - dy * dy).max(0.0).powi(2);
            sum += weight * contraction;
            weights += weight;
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    };
    common.places().iter().map(mean).collect()
}

/// The distance of two fields relative to the second's size, and their correlation.
fn compare(a: &[f64], b: &[f64]) -> (f64, f64) {
    let dot = |u: &[f64], v: &[f64]| u.iter().zip(v).map(|(x, y)| x * y).sum::<f64>();
    let difference: Vec<f64> = a.iter().zip(b).map(|(x, y)| x - y).collect();
    let centred = |u: &[f64]| {
        let mean = u.iter().sum::<f64>() / u.len().max(1) as f64;
        u.iter().map(|x| x - mean).collect::<Vec<f64>>()
    };
    let (ca, cb) = (centred(a), centred(b));
    let distance = (dot(&difference, &difference) / dot(b, b)).sqrt();
    (distance, dot(&ca, &cb) / (dot(&ca, &ca) * dot(&cb, &cb)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_fields_agree_and_opposite_ones_do_not() {
        let field = [0.1, 0.3, 0.2, 0.0];
        let (distance, correlation) = compare(&field, &field);
        assert!(distance == 0.0 && (correlation - 1.0).abs() < 1e-15);
        let opposite = field.map(|v| 0.3 - v);
        assert!((compare(&opposite, &field).1 + 1.0).abs() < 1e-15);
    }

    #[test]
    fn coarse_fibres_lie_on_the_fine_mesh() {
        let fine = coarse_fibers("pig", 414, design("pig", 1055).unwrap()).unwrap();
        assert!(fine.validate().is_ok());
        let count = fine.fiber_routings().len();
        // Few fall together on the fine mesh: fewer than the 3 % by which a fibre count may be off.
        assert!((402..=414).contains(&count), "{count}");
    }
}
