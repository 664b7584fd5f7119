//! One numerical question as a file: `cargo run --release --example problem_file [PROBLEM.json]`.
//!
//! Reads a problem (`examples/problem-format.md`), answers it, and prints what the solver says of its answer. Without a file it takes a
//! square that hangs from two corners.

use plushwright::problem::{Options, answer, read};
use std::error::Error;

pub const HANGING: &str = r#"{
    "format": "plushwright-problem/1",
    "mesh": { "nodes": [[0, 0], [0.1, 0], [0.1, 0.1], [0, 0.1]], "triangles": [[0, 1, 2], [0, 2, 3]] },
    "material": { "mu": 800, "kappa": 2000 },
    "pins": [{ "node": 2, "target": [0.1, 0.1], "K": 20000 }, { "node": 3, "target": [0, 0.1], "K": 20000 }],
    "gravity": [0, -9.81],
    "surface_density": 2
}"#;

fn main() -> Result<(), Box<dyn Error>> {
    let text = match std::env::args_os().nth(1) {
        Some(path) => std::fs::read_to_string(path)?,
        None => HANGING.to_owned(),
    };
    println!("{}", run(&text)?);
    Ok(())
}

/// The answer to a problem, as JSON.
///
/// # Errors
/// A file that is no problem.
pub fn run(text: &str) -> Result<String, Box<dyn Error>> {
    let (problem, unknown) = read(text)?;
    unknown.iter().for_each(|key| println!("not understood: {key}"));
    let document = answer(&problem, &Options::default())?;
    Ok(serde_json::to_string_pretty(&document)?)
}
