//! `bench linear`: the same Hessians through every variant of the sparse factorisation, in one run, on one thread.
//!
//! The Hessians are those of statics at a deformed equilibrium: fibres contracted by a smooth random field. Times are those
//! of the numeric factorisation and of the solves; the symbolic analysis happens once per topology.

use super::ordering::nested_dissection;
use super::plot::{Plot, Series};
use super::shapes::{Field, Subject};
use super::statistics::{Summary, growth_exponent};
use super::{BenchError, Report, Session, Table};
use crate::physics::HessianForm;
use crate::physics::cholesky::{Cholesky, Kernel, Ordering, Variant};
use crate::physics::pattern::Pattern;
use crate::random::Random;
use std::time::Instant;

/// Measurements go on for this long, s, for every variant, and for at least [`LEAST_ROUNDS`] rounds.
const MEASURED_S: f64 = 0.2;
const LEAST_ROUNDS: usize = 7;
/// Factorisations whose median is the unit of time.
const UNIT_ROUNDS: usize = 5;
/// Right-hand sides solved together: those of four targets (two a target, and two more).
const COLUMNS: usize = 10;
/// The mesh's own numbering is tried up to this many fibres; beyond, its fill takes minutes.
const NATURAL_LIMIT: usize = 1500;
/// Part of the allowed contraction at which the Hessian is taken.
const STRENGTH: f64 = 0.7;

/// Shapes and sizes of the study.
pub struct Linear {
    pub shapes: Vec<String>,
    pub fibers: Vec<usize>,
}

/// A Hessian with its pattern.
pub struct Matrix {
    pub pattern: Pattern,
    pub values: Vec<f64>,
}

/// One variant on one matrix; times in ms.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    pub analysis: f64,
    pub factorization: Summary,
    pub solve: f64,
    /// `COLUMNS` right-hand sides together.
    pub solve_many: f64,
    pub factor_nonzeros: usize,
}

/// The variants that are worth a try on `subject`, by the names of the table.
pub fn variants(subject: &Subject) -> Vec<(&'static str, &'static str, Variant)> {
    const LOOSE: &[(usize, f64)] = &[(8, 1.0), (32, 0.8), (96, 0.2), (usize::MAX, 0.1)];
    const TIGHT: &[(usize, f64)] = &[(4, 0.5), (16, 0.2), (usize::MAX, 0.02)];
    let dissection = Ordering::Nodes(nested_dissection(&subject.design.mesh));
    let mut out = Vec::new();
    let orderings = [
        ("minimum degree", Ordering::MinimumDegree),
        ("minimum degree, nodes", Ordering::NodeMinimumDegree),
        ("nested dissection", dissection),
        ("natural", Ordering::Natural),
    ];
    let kernels = [
        ("simplicial", Kernel::Simplicial),
        ("supernodal", Kernel::Supernodal(&[])),
        ("supernodal, tight", Kernel::Supernodal(TIGHT)),
        ("supernodal, loose", Kernel::Supernodal(LOOSE)),
    ];
    for (ordering_name, ordering) in orderings {
        for (kernel_name, kernel) in kernels {
            // The library's own merging rule is tried with every order, the others with the orders that matter.
            let odd = matches!(kernel, Kernel::Supernodal(relax) if !relax.is_empty());
            let plain = matches!(ordering, Ordering::Natural | Ordering::MinimumDegree);
            let hopeless = ordering == Ordering::Natural && subject.fibers() > NATURAL_LIMIT;
            if hopeless || (odd && plain) {
                continue;
            }
            out.push((kernel_name, ordering_name, Variant { ordering: ordering.clone(), kernel }));
        }
    }
    out
}

/// The Hessian of `subject` at a deformed equilibrium.
///
/// # Errors
/// No equilibrium at the contractions, or the study was cancelled.
pub fn deformed_hessian(subject: &mut Subject, session: &Session) -> Result<Matrix, BenchError> {
    let mut random = Random::of(session.seed, &subject.name, 0);
    let original = super::shapes::original(&subject.name)?;
    let field = Field::random(&mut random, &original.mesh.nodes, subject.length());
    let contractions = subject.contractions(&field, STRENGTH);
    let rest = subject.plushie.model.rest.clone();
    let x = subject.settle(&contractions, &rest, session.stop)?;
    let model = &mut subject.plushie.model;
    if model.factorize(&x, HessianForm::Exact).is_err() {
        return Err(BenchError::Nothing(format!("{}: the Hessian is not positive definite", subject.name)));
    }
    Ok(Matrix { pattern: model.pattern().clone(), values: model.hessian_values().to_vec() })
}

/// Times of the variants, `None` for one that cannot factorise the matrix. They take turns, so that whatever else the machine
/// does falls on all of them alike.
///
/// # Errors
/// The study was cancelled.
pub fn measure(
    matrix: &Matrix,
    variants: &[Variant],
    with_solves: bool,
    session: &Session,
) -> Result<Vec<Option<Measured>>, BenchError> {
    let n = matrix.pattern.dimension();
    let right: Vec<f64> = (0..COLUMNS * n).map(|i| 1.0 + (i % 7) as f64).collect();
    let mut z = right.clone();
    let mut runs = Vec::new();
    for variant in variants {
        session.check()?;
        let clock = Instant::now();
        let cholesky = Cholesky::with(&matrix.pattern, variant);
        runs.push(cholesky.map(|cholesky| Run { cholesky, analysis: milliseconds(clock), times: Default::default() }));
    }
    let began = Instant::now();
    let enough = MEASURED_S * variants.len() as f64;
    let mut rounds = 0;
    while rounds < LEAST_ROUNDS || began.elapsed().as_secs_f64() < enough {
        rounds += 1;
        for slot in &mut runs {
            session.check()?;
            let Some(run) = slot else { continue };
            let clock = Instant::now();
            if run.cholesky.factorize(&matrix.pattern, &matrix.values).is_err() {
                *slot = None;
                continue;
            }
            run.times[0].push(milliseconds(clock));
            if with_solves {
                z.copy_from_slice(&right);
                let clock = Instant::now();
                run.cholesky.solve(&mut z[..n]);
                run.times[1].push(milliseconds(clock));
                z.copy_from_slice(&right);
                let clock = Instant::now();
                run.cholesky.solve_many(&mut z, COLUMNS);
                run.times[2].push(milliseconds(clock));
            }
        }
    }
    Ok(runs.into_iter().map(|run| run.map(Run::summary)).collect())
}

/// A variant while it is measured.
struct Run {
    cholesky: Cholesky,
    analysis: f64,
    /// Factorisations, solves of one right-hand side, solves of [`COLUMNS`].
    times: [Vec<f64>; 3],
}

impl Run {
    fn summary(self) -> Measured {
        let [factorization, solve, solve_many] = self.times.map(Summary::of);
        Measured {
            analysis: self.analysis,
            factorization,
            solve: solve.median,
            solve_many: solve_many.median,
            factor_nonzeros: self.cholesky.factor_nonzeros(),
        }
    }
}

/// The numeric factorisation by the fastest variant: the unit in which frames are measured, timed again among them.
pub struct Unit {
    matrix: Matrix,
    cholesky: Cholesky,
}

impl Unit {
    /// Measures the fastest variant on a shape's Hessian: the unit of other studies' times.
    ///
    /// # Errors
    /// As [`deformed_hessian`] and [`measure`].
    pub fn of(subject: &mut Subject, session: &Session) -> Result<Self, BenchError> {
        let matrix = deformed_hessian(subject, session)?;
        let tried: Vec<Variant> = variants(subject).into_iter().map(|(_, _, variant)| variant).collect();
        let measured = measure(&matrix, &tried, false, session)?;
        let times =
            measured.iter().zip(&tried).filter_map(|(m, variant)| Some((m.as_ref()?.factorization.median, variant)));
        let fastest = times.min_by(|a, b| a.0.total_cmp(&b.0));
        let cholesky = fastest.and_then(|(_, variant)| Cholesky::with(&matrix.pattern, variant));
        let none = || BenchError::Nothing(format!("{}: no variant factorises the Hessian", subject.name));
        Ok(Self { cholesky: cholesky.ok_or_else(none)?, matrix })
    }

    /// The time of one factorisation, ms: the median of `UNIT_ROUNDS`.
    pub fn time(&mut self) -> f64 {
        let once = |_| {
            let clock = Instant::now();
            // It has factorised this matrix before.
            let _ = self.cholesky.factorize(&self.matrix.pattern, &self.matrix.values);
            milliseconds(clock)
        };
        Summary::of((0..UNIT_ROUNDS).map(once)).median
    }
}

impl Linear {
    /// Times every variant on every shape.
    ///
    /// # Errors
    /// A shape that does not exist or cannot be meshed, no equilibrium, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let mut table = Table::new(
            "linear",
            "Numeric factorisation and solves of one Hessian, ms (medians unless said otherwise)",
            &[
                "shape",
                "fibres",
                "unknowns",
                "in H",
                "kernel",
                "order",
                "in L",
                "analysis",
                "factor, least",
                "factor",
                "solve 1",
                "solve 10",
            ],
        );
        let mut curves: Vec<Series> = Vec::new();
        let mut remarks = Vec::new();
        for name in &self.shapes {
            for &fibers in &self.fibers {
                session.next(&format!("{name}, {fibers} fibres"))?;
                let mut subject = Subject::new(name, fibers)?;
                let matrix = deformed_hessian(&mut subject, session)?;
                let mut best: Option<(f64, String)> = None;
                let named = variants(&subject);
                let tried: Vec<Variant> = named.iter().map(|(_, _, variant)| variant.clone()).collect();
                let measured = measure(&matrix, &tried, true, session)?;
                for ((kernel, order, _), m) in named.into_iter().zip(measured) {
                    let Some(m) = m else { continue };
                    table.push(vec![
                        subject.name.clone().into(),
                        subject.fibers().into(),
                        matrix.pattern.dimension().into(),
                        matrix.pattern.nonzeros().into(),
                        kernel.into(),
                        order.into(),
                        m.factor_nonzeros.into(),
                        m.analysis.into(),
                        m.factorization.least.into(),
                        m.factorization.median.into(),
                        m.solve.into(),
                        m.solve_many.into(),
                    ]);
                    let label = format!("{kernel}, {order}");
                    let point = (subject.fibers() as f64, m.factorization.median);
                    match curves.iter_mut().find(|c| c.label == label) {
                        Some(curve) => curve.points.push(point),
                        None => curves.push(Series::line(label.clone(), vec![point])),
                    }
                    if best.as_ref().is_none_or(|(time, _)| point.1 < *time) {
                        best = Some((point.1, label));
                    }
                }
                if let Some((time, label)) = best {
                    let time = super::figures::significant(time);
                    remarks.push(format!("{name}, {} fibres: fastest is {label}, {time} ms", subject.fibers()));
                }
            }
        }
        for curve in &curves {
            if let Some(exponent) = growth_exponent(&curve.points) {
                remarks.push(format!("{}: time grows as fibres^{exponent:.2}", curve.label));
            }
        }
        let plot = Plot {
            name: "linear".into(),
            title: "One numeric factorisation".into(),
            x_label: "muscle fibres".into(),
            y_label: "ms".into(),
            log_x: true,
            log_y: true,
            series: curves,
        };
        let title = format!("Sparse Cholesky variants on Hessians at a deformed equilibrium, seed {}", session.seed);
        Ok(Report { title, tables: vec![table], remarks, plots: vec![plot] })
    }
}

fn milliseconds(clock: Instant) -> f64 {
    1e3 * clock.elapsed().as_secs_f64()
}
