//! Numerical extremes: the shortened table, the scenes of `examples/extremes/`, and time budgets.

use plushwright::bench::Session;
use plushwright::bench::extremes::Extremes;
use plushwright::problem::{Answered, Failure, Options, read, solve};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

#[test]
fn every_row_of_the_shortened_table_passes() {
    let cancel = AtomicBool::new(false);
    let session = Session { seed: 1, stop: &|| false, cancel: &cancel, progress: &|_| {}, found: &|_| {} };
    let judged = Extremes { short: true, only: None }.judge(&session).unwrap();
    assert!(judged.len() >= 25, "only {} rows", judged.len());
    let mut failing = Vec::new();
    for row in &judged {
        for (case, (_, short)) in row.row.cases.iter().zip(&row.outcomes) {
            if !short.is_empty() {
                failing.push(format!("{}, {}: {}", row.row.name, case.at, short.join("; ")));
            }
        }
    }
    assert!(failing.is_empty(), "{}", failing.join("\n"));
}

/// The whole sweeps, up to 100 000 fibres, printed as `plushwright bench extremes` prints them.
#[test]
#[ignore = "takes minutes; plushwright bench extremes does the same, optimised"]
fn every_row_of_the_whole_table_passes() {
    let cancel = AtomicBool::new(false);
    let session = Session { seed: 1, stop: &|| false, cancel: &cancel, progress: &|_| {}, found: &|_| {} };
    let (report, failed) = Extremes { short: false, only: std::env::var("ONLY").ok() }.run(&session).unwrap();
    println!("{}", report.text());
    assert_eq!(failed, None);
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/extremes")
}

/// What the table of the README says of each file: `solved`, or the words of its refusal or failure in quotes.
fn expected() -> BTreeMap<String, String> {
    let text = fs::read_to_string(folder().join("README.md")).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.strip_prefix("| `")?.split('|').map(str::trim).collect();
        let file = cells.first()?.strip_suffix('`')?;
        Some((file.to_owned(), (*cells.get(2)?).to_owned()))
    };
    text.lines().filter_map(row).collect()
}

fn answer(text: &str, budget: Duration) -> Result<Answered, String> {
    let (problem, _) = read(text).map_err(|e| e.to_string())?;
    solve(&problem, &Options { budget, ..Options::default() }).map_err(|e| e.to_string())
}

#[test]
fn the_scenes_end_as_their_table_says() {
    let expected = expected();
    let mut files: Vec<String> =
        fs::read_dir(folder()).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    files.retain(|name| name.ends_with(".json"));
    files.sort();
    assert_eq!(files.iter().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    assert!(files.len() >= 24);
    for (name, outcome) in expected {
        let text = fs::read_to_string(folder().join(&name)).unwrap();
        let clock = Instant::now();
        let answered = answer(&text, Duration::from_secs(10));
        assert!(clock.elapsed() < Duration::from_secs(12), "{name} took {:?}", clock.elapsed());
        let said = match &answered {
            Err(refusal) => refusal.clone(),
            Ok(a) if a.converged => "solved".into(),
            Ok(a) => a.document["error"].as_str().unwrap().to_owned(),
        };
        let words = outcome.trim_matches('"');
        assert!(said.contains(words), "{name}: {said}, expected {outcome}");
    }
}

/// A bar of many cells that bends under its fibres, with every kind of question.
fn slow(question: &str) -> String {
    let (columns, rows) = (120, 12);
    let at = |i: usize, j: usize| j * (columns + 1) + i;
    let (mut nodes, mut triangles, mut elements) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..=rows {
        for i in 0..=columns {
            nodes.push(format!("[{}, {}]", i as f64 / 120.0, j as f64 / 120.0));
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            triangles.push(format!("[{}, {}, {}]", at(i, j), at(i + 1, j), at(i + 1, j + 1)));
            triangles.push(format!("[{}, {}, {}]", at(i, j), at(i + 1, j + 1), at(i, j + 1)));
        }
    }
    for i in 0..columns {
        elements.push(format!(
            r#"{{"routing": [{}, {}], "K": 100, "epsilon": 1e-4, "alpha0": {}, "winch": {i}}}"#,
            at(i, rows),
            at(i + 1, rows),
            1.0 / 120.0
        ));
    }
    let pins: Vec<String> = (0..=rows)
        .map(|j| format!(r#"{{"node": {}, "target": [0, {}], "K": 1e3}}"#, at(0, j), j as f64 / 120.0))
        .collect();
    let contractions = vec!["0.004"; columns].join(", ");
    format!(
        r#"{{"format": "plushwright-problem/1", "mesh": {{"nodes": [{}], "triangles": [{}]}},
           "material": {{"mu": 1, "kappa": 2}}, "elements": [{}], "pins": [{}], "contractions": [{contractions}],
           "objective": {{"targets": [{{"node": {}, "xy": [0.3, 0.9]}}], "default_weight": 1e-5}} {question}}}"#,
        nodes.join(", "),
        triangles.join(", "),
        elements.join(", "),
        pins.join(", "),
        at(columns, rows)
    )
}

#[test]
fn whatever_the_time_budget_cuts_short_says_so() {
    let bounds = vec!["0.006"; 120].join(", ");
    let soft_ik = format!(r#", "soft_ik": {{"beta_upper": [{bounds}]}}"#);
    let drag = r#", "drag": {"frames": [[[0.3, 0.9]], [[0.2, 0.8]]], "report": [0], "tension_regulariser": 1e-4}"#;
    for (name, question) in [("statics", ""), ("soft_ik", soft_ik.as_str()), ("drag", drag)] {
        let text = slow(question);
        for milliseconds in [1, 20] {
            let clock = Instant::now();
            let answered = answer(&text, Duration::from_millis(milliseconds)).unwrap();
            let took = clock.elapsed();
            let all_in_time = |f: &Failure| matches!(f, Failure::TimeBudget { .. });
            assert!(answered.failures.iter().all(all_in_time), "{name}, {milliseconds} ms: {:?}", answered.failures);
            if milliseconds == 1 {
                assert!(!answered.converged, "{name}");
                let error = answered.document["error"].as_str().unwrap();
                assert!(error.contains("the time budget ended the search"), "{name}: {error}");
            }
            // Building the model and a factorisation, unoptimised on a busy machine.
            assert!(took < Duration::from_secs(4), "{name}, {milliseconds} ms: took {took:?}");
        }
    }
}

#[test]
fn a_loose_piece_is_named() {
    let text = fs::read_to_string(folder().join("two-pieces-one-falls.json")).unwrap();
    let answered = answer(&text, Duration::from_secs(10)).unwrap();
    let Some(Failure::FreeToMove { node, whole, .. }) = answered.failures.first() else {
        panic!("{:?}", answered.failures)
    };
    assert_eq!((*node, *whole), (21, false));
    // The best state is a body all the same.
    assert!(answered.document["x"].as_array().is_some_and(|x| x.len() > 21));
}
