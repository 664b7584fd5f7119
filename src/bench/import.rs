//! How well do outlines that nobody here drew become meshes?
//!
//! Every file of a folder goes through import and meshing, each in a thread of its own, so that a panic or a hang costs
//! one file. The table says how many gave a mesh, why the others did not, how good the meshes are and how long it took.

use super::report::{Cell, Report, Table};
use super::statistics::Summary;
use super::{BenchError, Session};
use crate::mesh::{self, MeshSpec};
use crate::outline::{self, Import, OutlineError};
use grade::Grade;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

mod grade;

/// Longest time for one file, after which it counts as a hang.
const PATIENCE: Duration = Duration::from_secs(60);
/// Names of files shown per problem.
const SHOWN: usize = 8;
/// Features narrower than this part of the height cannot be followed by a few hundred fibres.
const NARROW_FRACTION: f64 = 0.03;

/// Files and numbers of fibres of the study.
pub struct Imports {
    pub folder: PathBuf,
    pub import: Import,
    pub fibers: Vec<usize>,
    /// Only so many files, evenly spread over the sorted list; 0 for all.
    pub limit: usize,
}

/// What became of a file.
struct Outcome {
    path: PathBuf,
    /// Time of reading and clean-up, ms.
    import_ms: f64,
    result: Result<Sound, Refusal>,
}

struct Sound {
    unasked: f64,
    narrow: bool,
    meshes: Vec<Meshed>,
}

/// A mesh at one of the asked numbers of fibres.
struct Meshed {
    ms: f64,
    /// The count that was meshed in the end, where the asked one is impossible.
    result: Result<(Grade, Option<usize>), String>,
}

struct Refusal {
    cause: &'static str,
    text: String,
}

impl Imports {
    /// Tries every file.
    ///
    /// # Errors
    /// A folder without files, or an interrupt.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let mut files = Vec::new();
        collect(&self.folder, &mut files);
        files.sort();
        if self.limit > 0 && files.len() > self.limit {
            let all = files.len();
            files = (0..self.limit).map(|i| files[i * all / self.limit].clone()).collect();
        }
        if files.is_empty() {
            let folder = self.folder.display();
            return Err(BenchError::Nothing(format!("{folder}: no SVG, PNG, JPEG, DXF, OBJ or drawing files")));
        }
        let mut outcomes = Vec::with_capacity(files.len());
        for (k, path) in files.iter().enumerate() {
            session.next(&format!("{} of {}: {}", k + 1, files.len(), path.display()))?;
            outcomes.push(self.guarded(path));
        }
        Ok(self.report(&outcomes))
    }

    /// Tries one file in a thread of its own.
    fn guarded(&self, path: &Path) -> Outcome {
        let (send, receive) = channel();
        let (file, import, fibers) = (path.to_owned(), self.import.clone(), self.fibers.clone());
        std::thread::spawn(move || send.send(attempt(file, &import, &fibers)));
        receive.recv_timeout(PATIENCE).unwrap_or_else(|error| {
            let cause = if error == RecvTimeoutError::Timeout { "HANG" } else { "PANIC" };
            let result = Err(Refusal { cause, text: cause.to_owned() });
            Outcome { path: path.to_owned(), import_ms: f64::NAN, result }
        })
    }

    fn report(&self, outcomes: &[Outcome]) -> Report {
        let sound: Vec<&Sound> = outcomes.iter().filter_map(|o| o.result.as_ref().ok()).collect();
        let mut files = Table::new("files", "What became of the files", &["outcome", "files", "%", "examples"]);
        let row = |what: &str, of: &[&Outcome]| {
            let part = 100.0 * of.len() as f64 / outcomes.len() as f64;
            let name = |o: &&Outcome| o.path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            let names: Vec<String> = of.iter().take(SHOWN).map(name).collect();
            vec![Cell::from(what), of.len().into(), part.into(), names.join(" ").into()]
        };
        let fine: Vec<&Outcome> = outcomes.iter().filter(|o| o.result.is_ok()).collect();
        files.push(vec!["read".into(), outcomes.len().into(), 100.0.into(), "".into()]);
        files.push(vec![
            "one clean outline".into(),
            fine.len().into(),
            (100.0 * fine.len() as f64 / outcomes.len() as f64).into(),
            "".into(),
        ]);
        let mut causes: Vec<&str> =
            outcomes.iter().filter_map(|o| o.result.as_ref().err()).map(|refusal| refusal.cause).collect();
        causes.sort_unstable();
        causes.dedup();
        for cause in &causes {
            let of: Vec<&Outcome> =
                outcomes.iter().filter(|o| o.result.as_ref().is_err_and(|r| r.cause == *cause)).collect();
            files.push(row(cause, &of));
        }
        let mut tables = vec![files, self.meshes(&sound), self.shapes(&sound), times(outcomes)];
        let mut remarks = Vec::new();
        let one_piece =
            outcomes.iter().filter(|o| o.result.as_ref().err().is_none_or(|r| !NOT_ONE_PIECE.contains(&r.cause)));
        let one_piece = one_piece.count();
        for (k, &fibers) in self.fibers.iter().enumerate() {
            let meshed = sound.iter().filter(|s| s.meshes[k].result.is_ok()).count();
            let exact = sound.iter().filter(|s| matches!(s.meshes[k].result, Ok((_, None)))).count();
            remarks.push(format!(
                "{fibers} fibres: of {one_piece} silhouettes in one piece {meshed} gave a mesh ({:.2} %), {exact} with the asked number",
                100.0 * meshed as f64 / one_piece.max(1) as f64
            ));
        }
        tables.push(self.problems(outcomes));
        Report {
            title: format!("Import of {}, {} files", self.folder.display(), outcomes.len()),
            tables,
            remarks,
            plots: Vec::new(),
        }
    }

    fn meshes(&self, sound: &[&Sound]) -> Table {
        let headings = [
            "fibres",
            "meshes",
            "as asked",
            "with more",
            "refused",
            "off by, max %",
            "triangles",
            "under 20 deg, %",
            "meshes under 5 deg",
            "least angle, deg",
            "unsound",
            "ms, median",
            "ms, 95 %",
            "ms, max",
        ];
        let mut table = Table::new("meshes", "Meshing", &headings);
        for (k, &fibers) in self.fibers.iter().enumerate() {
            let all: Vec<&Meshed> = sound.iter().map(|s| &s.meshes[k]).collect();
            let grades: Vec<(&Grade, Option<usize>)> =
                all.iter().filter_map(|m| m.result.as_ref().ok()).map(|(grade, more)| (grade, *more)).collect();
            let asked = || grades.iter().filter(|g| g.1.is_none());
            let triangles: usize = grades.iter().map(|g| g.0.triangles).sum();
            let slim: usize = grades.iter().map(|g| g.0.below_20_deg).sum();
            let off = asked().map(|g| 100.0 * (g.0.fibers as f64 / fibers as f64 - 1.0).abs()).fold(0.0, f64::max);
            let ms = Summary::of(all.iter().map(|m| m.ms));
            table.push(vec![
                fibers.into(),
                grades.len().into(),
                asked().count().into(),
                (grades.len() - asked().count()).into(),
                (all.len() - grades.len()).into(),
                off.into(),
                triangles.into(),
                (100.0 * slim as f64 / triangles.max(1) as f64).into(),
                grades.iter().filter(|g| g.0.below_5_deg > 0).count().into(),
                grades.iter().map(|g| g.0.least_angle_deg).fold(f64::INFINITY, f64::min).into(),
                grades.iter().filter(|g| !g.0.sound).count().into(),
                ms.median.into(),
                ms.p95.into(),
                ms.worst.into(),
            ]);
        }
        table
    }

    /// Meshes against the cleaned outlines.
    fn shapes(&self, sound: &[&Sound]) -> Table {
        let headings = [
            "fibres",
            "outlines",
            "meshes",
            "area off, median %",
            "area off, max %",
            "over 1 %",
            "boundary off, median % of height",
            "boundary off, max %",
            "over 0.5 %",
        ];
        let mut table =
            Table::new("shapes", "Meshes against the cleaned outlines (meshes with the asked number)", &headings);
        for (k, &fibers) in self.fibers.iter().enumerate() {
            for (name, narrow) in [("no feature under 3 % of the height", false), ("with narrower features", true)] {
                let of = sound.iter().filter(|s| s.narrow == narrow);
                let grades: Vec<&Grade> = of
                    .filter_map(|s| s.meshes[k].result.as_ref().ok())
                    .filter(|g| g.1.is_none())
                    .map(|g| &g.0)
                    .collect();
                let area: Vec<f64> = grades.iter().map(|g| 100.0 * g.area_off).collect();
                let stray: Vec<f64> = grades.iter().map(|g| 100.0 * g.boundary_off).collect();
                table.push(vec![
                    fibers.into(),
                    name.into(),
                    grades.len().into(),
                    Summary::of(area.iter().copied()).median.into(),
                    Summary::of(area.iter().copied()).worst.into(),
                    area.iter().filter(|a| **a > 1.0).count().into(),
                    Summary::of(stray.iter().copied()).median.into(),
                    Summary::of(stray.iter().copied()).worst.into(),
                    stray.iter().filter(|a| **a > 0.5).count().into(),
                ]);
            }
        }
        table
    }

    /// The first files of every kind of trouble.
    fn problems(&self, outcomes: &[Outcome]) -> Table {
        let mut table = Table::new("problems", "Files to look at", &["problem", "file", "what"]);
        let mut push = |problem: &str, of: Vec<(&Path, String)>| {
            for (path, what) in of.into_iter().take(SHOWN) {
                table.push(vec![problem.into(), path.display().to_string().into(), what.into()]);
            }
        };
        for (k, fibers) in self.fibers.iter().enumerate() {
            let meshed = |f: &dyn Fn(&Sound, &Meshed) -> Option<String>| {
                let of = outcomes.iter().filter_map(|o| Some((o.path.as_path(), o.result.as_ref().ok()?)));
                of.filter_map(|(path, s)| Some((path, f(s, &s.meshes[k])?))).collect::<Vec<_>>()
            };
            push(&format!("{fibers}: refused"), meshed(&|_, m| m.result.as_ref().err().cloned()));
            let grade = |m: &Meshed| m.result.as_ref().ok().map(|g| (g.0.clone(), g.1));
            push(
                &format!("{fibers}: under 5 degrees"),
                meshed(&|_, m| Some(format!("{:.1}", grade(m).filter(|g| g.0.below_5_deg > 0)?.0.least_angle_deg))),
            );
            push(
                &format!("{fibers}: boundary"),
                meshed(&|s, m| {
                    let g = grade(m).filter(|g| g.1.is_none() && g.0.boundary_off > 0.005 && !s.narrow)?;
                    Some(format!("{:.2} %", 100.0 * g.0.boundary_off))
                }),
            );
        }
        let refused = |cause: &str| {
            let of = outcomes.iter().filter_map(|o| Some((o.path.as_path(), o.result.as_ref().err()?)));
            of.filter(|(_, r)| r.cause == cause).map(|(p, r)| (p, r.text.clone())).collect::<Vec<_>>()
        };
        for cause in ["HANG", "PANIC", "pinched", "degenerate", "too complex", "unreadable", "no font"] {
            push(cause, refused(cause));
        }
        let over = outcomes.iter().filter_map(|o| Some((o.path.as_path(), o.result.as_ref().ok()?.unasked)));
        push(
            "clean-up over 2 %",
            over.filter(|o| o.1 > 0.02).map(|(p, u)| (p, format!("{:.1} %", 100.0 * u))).collect(),
        );
        table
    }
}

/// Causes of files that have no silhouette in one piece.
const NOT_ONE_PIECE: [&str; 5] = ["several pieces", "nothing painted", "unreadable", "no font", "too large"];

fn times(outcomes: &[Outcome]) -> Table {
    let mut table = Table::new(
        "clean-up",
        "Import and clean-up",
        &["files", "ms, median", "ms, 95 %", "ms, max", "area changed unasked, median %", "max %", "over 2 %"],
    );
    let ms = Summary::of(outcomes.iter().map(|o| o.import_ms).filter(|ms| ms.is_finite()));
    let unasked: Vec<f64> = outcomes.iter().filter_map(|o| o.result.as_ref().ok()).map(|s| 100.0 * s.unasked).collect();
    let changed = Summary::of(unasked.iter().copied());
    table.push(vec![
        outcomes.len().into(),
        ms.median.into(),
        ms.p95.into(),
        ms.worst.into(),
        changed.median.into(),
        changed.worst.into(),
        unasked.iter().filter(|u| **u > 2.0).count().into(),
    ]);
    table
}

fn attempt(path: PathBuf, import: &Import, fibers: &[usize]) -> Outcome {
    let start = Instant::now();
    let refuse = |cause, text| Err(Refusal { cause, text });
    let imported = match outline::import_file(&path, import) {
        Ok(imported) => imported,
        Err(error) => {
            let result = refuse(cause(&error), error.to_string());
            return Outcome { path, import_ms: milliseconds(start), result };
        }
    };
    let import_ms = milliseconds(start);
    let outline = imported.outline;
    let (_, high) = outline.bounding_box();
    let meshes = fibers.iter().map(|&count| {
        let start = Instant::now();
        let made = mesh::build_or_finer(&outline, &MeshSpec::fibers(count));
        let ms = milliseconds(start);
        let result = made
            .map(|(meshed, made_for)| (Grade::of(&meshed.mesh, &outline), Some(made_for).filter(|&n| n != count)))
            .map_err(|error| error.to_string());
        Meshed { ms, result }
    });
    let meshes = meshes.collect();
    let narrow = outline.has_narrow_parts(NARROW_FRACTION * high[1]);
    Outcome { path, import_ms, result: Ok(Sound { unasked: imported.changes.unasked, narrow, meshes }) }
}

fn cause(error: &OutlineError) -> &'static str {
    match error {
        OutlineError::Unopened(_) | OutlineError::Unreadable { .. } | OutlineError::UnknownFormat => "unreadable",
        OutlineError::TooLarge => "too large",
        OutlineError::TooComplex(_) => "too complex",
        OutlineError::NothingPainted(_) => "nothing painted",
        OutlineError::NoFont(_) => "no font",
        OutlineError::Pieces { .. } => "several pieces",
        OutlineError::Pinched { .. } => "pinched",
        _ => "degenerate",
    }
}

fn milliseconds(start: Instant) -> f64 {
    1e3 * start.elapsed().as_secs_f64()
}

/// All files below a folder that may hold outlines. What cannot be listed is passed over.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let path = entry.path();
        // Links may go around in circles.
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            collect(&path, files);
        } else if path
            .extension()
            .is_some_and(|e| outline::extensions().iter().any(|known| e.eq_ignore_ascii_case(known)))
        {
            files.push(path);
        }
    }
}
