//! What must hold for any problem, design or text: a short, seeded run. `scripts/properties` does the long one, `fuzz/` goes on
//! without end.

use plushwright::bench::Session;
use plushwright::bench::properties::{End, Properties};
use plushwright::design::file;
use plushwright::problem::{Options, read, solve};
use plushwright::random::Random;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

#[test]
fn random_problems_and_edits_keep_their_properties() {
    let cancel = AtomicBool::new(false);
    let session = Session { seed: 2, stop: &|| false, cancel: &cancel, progress: &|_| {}, found: &|_| {} };
    let found = Properties { problems: 200, first: 0 }.try_out(&session).unwrap();
    assert!(found.violations.is_empty(), "{:#?}", found.violations);
    let count = |end: End| End::ALL.iter().position(|e| *e == end).map_or(0, |k| found.ends[k]);
    // The run shows something only if all kinds occur.
    assert!(count(End::Answered) > 100 && count(End::Refused) > 4 && count(End::FreeToMove) > 3, "{found:?}");
    assert!(found.edits > 10, "{found:?}");
}

/// Sequences of edits that come to a St. Venant-Kirchhoff body pulled far harder than it can bear: pressed flat, its triangles
/// were turned over by rounding.
#[test]
fn a_body_pressed_flat_is_shown_whole() {
    let cancel = AtomicBool::new(false);
    let session = Session { seed: 1, stop: &|| false, cancel: &cancel, progress: &|_| {}, found: &|_| {} };
    for first in [18_500, 26_100, 37_500] {
        let found = Properties { problems: 1, first }.try_out(&session).unwrap();
        assert!(found.violations.is_empty() && found.sequences == 1, "{:#?}", found.violations);
    }
}

/// The long run without a release build: `PROBLEMS=100000 FIRST=0 cargo test --test suite properties -- --ignored --nocapture`.
#[test]
#[ignore = "takes long; scripts/properties does the same, optimised"]
fn a_long_run() {
    let number = |name: &str, default: usize| std::env::var(name).map_or(default, |v| v.parse().unwrap());
    let cancel = AtomicBool::new(false);
    let session =
        Session { seed: 1, stop: &|| false, cancel: &cancel, progress: &|what| eprintln!("{what}"), found: &|_| {} };
    let run = Properties { problems: number("PROBLEMS", 100_000), first: number("FIRST", 0) };
    let found = run.try_out(&session).unwrap();
    println!("{:?} {:?}", End::ALL, found);
    assert!(found.violations.is_empty());
}

/// Files to begin with: small ones, so that a change hits something.
fn texts(folder: &str, extension: &str, longest: u64) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut paths: Vec<_> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.to_string_lossy().ends_with(extension) && fs::metadata(p).is_ok_and(|m| m.len() <= longest));
    paths.sort();
    paths.iter().map(|p| fs::read(p).unwrap()).collect()
}

/// What replaces a number of a file.
const NUMBERS: [&str; 16] = [
    "0",
    "-0.0",
    "-1",
    "1e308",
    "-1e308",
    "5e-324",
    "1e-320",
    "1e999",
    "NaN",
    "null",
    "18446744073709551616",
    "0.1",
    "1e9",
    "[]",
    "\"\"",
    "7",
];

/// A few changes: a number becomes another, bytes flip, go or come again.
fn mutated(random: &mut Random, text: &[u8]) -> String {
    let mut bytes = text.to_vec();
    for _ in 0..1 + random.index(3) {
        let at = random.index(bytes.len());
        match random.index(6) {
            0 => bytes[at] ^= 1 << random.index(7),
            1 => drop(bytes.drain(at..(at + 1 + random.index(20)).min(bytes.len()))),
            2 => bytes.insert(at, b"{}[](),:\"\\-.e0\xff\0"[random.index(16)]),
            3 => bytes.truncate(at + 1),
            _ => {
                let digit = |b: &u8| b.is_ascii_digit() || b"+-.e".contains(b);
                let Some(start) = bytes[at..].iter().position(u8::is_ascii_digit).map(|k| at + k) else { continue };
                let end = bytes[start..].iter().position(|b| !digit(b)).map_or(bytes.len(), |k| start + k);
                bytes.splice(start..end, NUMBERS[random.index(NUMBERS.len())].bytes());
            }
        }
        if bytes.is_empty() {
            break;
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn is_finite(value: &Value) -> bool {
    match value {
        Value::Null => false,
        Value::Array(items) => items.iter().all(is_finite),
        Value::Object(map) => map.values().all(is_finite),
        _ => true,
    }
}

#[test]
fn mutilated_problem_files_are_refused_or_answered() {
    let mut files = texts("tests/data/problems", ".json", 4000);
    files.extend(texts("examples/extremes", ".json", 6000));
    files.retain(|f| !String::from_utf8_lossy(f).contains("plushwright-answer"));
    assert!(files.len() >= 10);
    let (mut refused, mut answered) = (0, 0);
    let options = Options { budget: Duration::from_millis(40), all: true, ..Options::default() };
    for number in 0..1000 {
        let mut random = Random::of(5, "problem text", number);
        let chosen = random.index(files.len());
        let text = mutated(&mut random, &files[chosen]);
        let Ok((problem, _)) = read(&text) else {
            refused += 1;
            continue;
        };
        if let Ok(answer) = solve(&problem, &options) {
            assert!(is_finite(&answer.document), "{number}: {text}");
            assert_eq!(answer.converged, answer.failures.is_empty(), "{number}");
            answered += 1;
        }
    }
    assert!(refused > 200 && answered > 50, "{refused} refused, {answered} answered");
}

#[test]
fn mutilated_design_files_are_refused_or_whole() {
    let files = texts("examples", ".plush", 60_000);
    assert!(!files.is_empty());
    let (mut refused, mut read) = (0, 0);
    for number in 0..150 {
        let mut random = Random::of(5, "design text", number);
        let chosen = random.index(files.len());
        let text = mutated(&mut random, &files[chosen]);
        match file::parse(&text) {
            Err(error) => {
                assert!(!error.to_string().is_empty());
                refused += 1;
            }
            Ok(design) => {
                let written = file::to_text(&design).unwrap();
                let again = file::parse(&written).unwrap();
                assert_eq!(file::to_text(&again).unwrap(), written, "{number}");
                read += 1;
            }
        }
    }
    assert!(refused > 20 && read > 5, "{refused} refused, {read} read");
}
