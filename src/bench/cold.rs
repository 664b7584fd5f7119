//! `bench cold`: from rest at once to targets 40 % of the body length away. How much of the achievable decrease of `O` is missing
//! in the answer that so many factorisations give, and how many it takes to come within 1 %. All that an answer needs is
//! counted: the iterations, and settling what they reached.

use super::drags::{places, points, positions, towards};
use super::plot::{Plot, Series};
use super::posing::{at_rest, free_fibers, optimum};
use super::shapes::{Field, Subject, original};
use super::statistics::Summary;
use super::{BenchError, Cell, Report, Session, Table};
use crate::physics::Model;
use crate::random::Random;
use crate::soft_ik::tension::AllAtOnce;
use crate::soft_ik::{Budget, Method, Posture, Question};

/// How far the targets are, in body lengths.
const FAR: f64 = 0.4;
/// Factorisations after which the missing part is read off.
const MARKS: [usize; 4] = [10, 20, 40, 80];
/// Longest run, iterations. Each is begun anew for an answer, so the longer ones are spaced by a part of their length.
const MOST: usize = 200;
const SPACING: usize = 40;
/// The part that counts as good.
const GOOD: f64 = 0.01;
/// Random postures from which the best known optimum is sought, besides rest and the answer itself.
const STARTS: usize = 4;
/// Iterations of the default method in that search.
const SEARCH_ITERATIONS: usize = 300;

/// Shapes, size and drags of the study.
pub struct Cold {
    pub shapes: Vec<String>,
    pub fibers: usize,
    pub targets: Vec<usize>,
    /// Drags of each shape and number of targets.
    pub draws: usize,
}

/// `O` of the answers, each after so many factorisations.
type Course = Vec<(usize, f64)>;

impl Cold {
    /// Runs the study.
    ///
    /// # Errors
    /// A shape that cannot be meshed, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let mut headings = vec!["shape", "fibres", "targets", "draw", "O rest", "O best"];
        let marks = MARKS.map(|k| format!("after {k}"));
        headings.extend(marks.iter().map(String::as_str));
        headings.push("factorisations to 1 %");
        let mut table = Table::new(
            "cold",
            "Missing part (O - O best) / (O rest - O best) after so many factorisations; O in mm^2",
            &headings,
        );
        let mut curves = Vec::new();
        let mut at_forty: Vec<f64> = Vec::new();
        let mut needed: Vec<f64> = Vec::new();
        let mut drags = 0;
        for shape in &self.shapes {
            let mut subject = Subject::new(shape, self.fibers)?;
            let mut courses: Vec<Vec<(usize, f64)>> = Vec::new();
            for &count in &self.targets {
                for draw in 0..self.draws {
                    session.next(&format!("{shape}, {count} targets, draw {}", draw + 1))?;
                    let (rest, best, course) = self.drag(&mut subject, count, draw as u64, session)?;
                    let missing: Course = course.iter().map(|(k, o)| (*k, (o - best) / (rest - best))).collect();
                    let after = |k: usize| missing_after(&missing, k);
                    // From there on it stays good.
                    let enough = missing.iter().rev().take_while(|c| c.1 <= GOOD).last().map(|c| c.0);
                    let mut row: Vec<Cell> =
                        vec![shape.clone().into(), subject.fibers().into(), count.into(), (draw + 1).into()];
                    row.extend([rest.into(), best.into()]);
                    row.extend(MARKS.map(|k| Cell::from(after(k))));
                    row.push(enough.map_or(Cell::AtLeast(MOST as f64), Cell::from));
                    table.push(row);
                    drags += 1;
                    at_forty.push(after(40));
                    needed.push(enough.map_or(f64::INFINITY, |k| k as f64));
                    courses.push(missing);
                }
            }
            curves.push(Series::line(shape.clone(), median_course(&courses)));
        }
        let good = at_forty.iter().filter(|part| **part <= GOOD).count();
        let worst = Summary::of(at_forty.iter().copied()).worst;
        let median = Summary::of(needed.iter().copied()).median;
        let remarks = vec![format!(
            "Within 40 factorisations {good} of {drags} drags are within 1 %; the worst misses {}. Median to 1 %: {}.",
            super::figures::significant(worst),
            super::figures::significant(median)
        )];
        let plot = Plot {
            name: "cold".into(),
            title: "Missing part of the decrease (median over drags)".into(),
            x_label: "factorisations".into(),
            y_label: "(O - O best) / (O rest - O best)".into(),
            log_x: false,
            log_y: true,
            series: curves,
        };
        let title = format!("Cold drags of {FAR} body lengths at {} fibres, seed {}", self.fibers, session.seed);
        Ok(Report { title, tables: vec![table], remarks, plots: vec![plot] })
    }

    /// `O` at rest, the best `O` known, and the course of the drag.
    fn drag(
        &self,
        subject: &mut Subject,
        count: usize,
        draw: u64,
        session: &Session,
    ) -> Result<(f64, f64, Course), BenchError> {
        let mut random = Random::of(session.seed, &format!("{} cold {count}", subject.name), draw);
        let at = points(subject, &places(&subject.name, count, &mut random)?);
        let begin = positions(&towards(subject, &at, &vec![[0.0; 2]; count]), &subject.plushie.model.rest);
        let away = FAR * subject.length();
        let goals: Vec<_> = begin
            .iter()
            .map(|p| {
                let d = random.direction();
                [p[0] + away * d[0], p[1] + away * d[1]]
            })
            .collect();
        let objective = towards(subject, &at, &goals);
        let others = starts(subject, &mut random)?;
        let actuation = free_fibers(subject);
        let model: &mut Model = &mut subject.plushie.model;
        let mut question = Question { model, actuation: &actuation, objective: &objective };
        let rest = at_rest(&mut question, session.stop);
        let (course, last) = self.course(&mut question, &rest, session.stop);
        let mut best = course.iter().map(|c| c.1).fold(rest.objective, f64::min);
        let settled = others.iter().map(|beta| settle(&mut question, beta, session.stop));
        let settled: Vec<Posture> = settled.collect();
        let starts: Vec<&Posture> = [&rest, &last].into_iter().chain(&settled).collect();
        best = optimum(&mut question, &starts, session.stop).map_or(best, |p| best.min(p.objective));
        session.check()?;
        let budget = Budget { iterations: SEARCH_ITERATIONS, stop: session.stop };
        let zero = vec![0.0; actuation.winches.len()];
        best = best.min(crate::soft_ik::solve(&mut question, &zero, &budget).posture.objective);
        session.check()?;
        Ok((rest.objective, best, course))
    }

    /// The answers of ever longer runs from rest, by the factorisations that each took.
    fn course(&self, question: &mut Question, rest: &Posture, stop: &dyn Fn() -> bool) -> (Course, Posture) {
        let mut course = Vec::new();
        let mut last = rest.clone();
        let mut iterations = 1;
        while iterations <= MOST && !stop() {
            let answer = AllAtOnce::default().solve(question, rest, &Budget { iterations, stop });
            last = answer.posture;
            course.push((answer.factorizations, last.objective));
            if answer.converged {
                break;
            }
            iterations += 1 + iterations / SPACING;
        }
        course.sort_by_key(|c| c.0);
        (course, last)
    }
}

/// What is missing in the answer of at most `k` factorisations.
fn missing_after(course: &[(usize, f64)], k: usize) -> f64 {
    course.iter().take_while(|c| c.0 <= k).last().map_or(1.0, |c| c.1)
}

/// Random smooth activations.
fn starts(subject: &Subject, random: &mut Random) -> Result<Vec<Vec<f64>>, BenchError> {
    let nodes = original(&subject.name)?.mesh.nodes.clone();
    let one = |random: &mut Random| {
        let field = Field::random(random, &nodes, subject.length());
        let contractions = subject.contractions(&field, 0.8);
        subject.plushie.fibers.iter().map(|w| contractions[w.members[0].0] / w.members[0].1).collect()
    };
    Ok((0..STARTS).map(|_| one(random)).collect())
}

fn settle(question: &mut Question, beta: &[f64], stop: &dyn Fn() -> bool) -> Posture {
    let rest = question.model.rest.clone();
    question.settle(beta, &rest, stop).0
}

/// At every count of factorisations that occurs, the median over the courses of what is missing then.
fn median_course(courses: &[Course]) -> Vec<(f64, f64)> {
    let mut counts: Vec<usize> = courses.iter().flatten().map(|c| c.0).collect();
    counts.sort_unstable();
    counts.dedup();
    counts
        .into_iter()
        .map(|k| {
            let now = courses.iter().map(|course| missing_after(course, k));
            (k as f64, Summary::of(now).median)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_course_waits_for_those_that_have_not_begun() {
        let courses = vec![vec![(2, 0.5), (4, 0.1)], vec![(3, 0.2)], vec![(5, 0.0)]];
        assert_eq!(median_course(&courses), [(2.0, 1.0), (3.0, 0.5), (4.0, 0.2), (5.0, 0.1)]);
    }
}
