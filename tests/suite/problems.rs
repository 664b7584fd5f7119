//! Every problem file against the answer of an independent program.

use plushwright::problem::{Options, read, solve};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/problems");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "json") && !f.to_string_lossy().ends_with(".answer.json"));
    files.sort();
    files
}

fn json_of(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn numbers(v: &Value) -> Vec<f64> {
    match v {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        Value::Number(n) => vec![n.as_f64().unwrap()],
        _ => vec![],
    }
}

fn largest_difference(a: &Value, b: &Value) -> f64 {
    let (a, b) = (numbers(a), numbers(b));
    assert_eq!(a.len(), b.len());
    a.iter().zip(&b).map(|(p, q)| (p - q).abs()).fold(0.0, f64::max)
}

fn largest(v: &Value) -> f64 {
    numbers(v).into_iter().fold(0.0, |m, a| m.max(a.abs()))
}

#[test]
fn every_case_agrees_with_its_answer() {
    let cases = cases();
    assert!(cases.len() >= 13, "only {} cases found", cases.len());
    let mut failures = Vec::new();
    for path in cases {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let expected = json_of(&path.with_extension("answer.json"));
        let text = std::fs::read_to_string(&path).unwrap();
        let (problem, _) = read(&text).unwrap();
        let answered = solve(&problem, &Options::default()).unwrap();
        let got = &answered.document;
        let mut check = |what: &str, error: f64, bound: f64| {
            println!("{name:32} {what:12} {error:9.2e} of {bound:9.2e}");
            if error.is_nan() || error > bound {
                failures.push(format!("{name}: {what} is off by {error:e}, allowed {bound:e}"));
            }
        };
        check("converged", if answered.converged { 0.0 } else { 1.0 }, 0.0);
        let nodes = numbers(&json_of(&path)["mesh"]["nodes"]);
        let extent = |axis: usize| {
            let values = nodes.iter().skip(axis).step_by(2);
            values.clone().fold(f64::MIN, |m, v| m.max(*v)) - values.fold(f64::MAX, |m, v| m.min(*v))
        };
        let body = extent(0).max(extent(1));
        let mu = problem.material.value("mu");
        let area = problem.mesh.triangles.iter().map(|t| {
            let [p, q, r] = t.map(|k| problem.mesh.nodes[k]);
            0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]))
        });
        let area: f64 = area.sum();
        let statics = &expected["statics"];
        check("x", largest_difference(&got["x"], &statics["x"]), 1e-8 * body);
        let energy = statics["energy"].as_f64().unwrap();
        let bound = (1e-8 * energy.abs()).max(1e-12 * mu * area);
        check("energy", (got["energy"].as_f64().unwrap() - energy).abs(), bound);
        for key in ["tensions", "pin_forces"] {
            if !statics[key].is_null() {
                let bound = (1e-6 * largest(&statics[key])).max(1e-6 * mu * body);
                check(key, largest_difference(&got[key], &statics[key]), bound);
            }
        }
        for key in ["grad_alpha_c", "grad_beta"] {
            let reference = &expected["objective"][key];
            if !reference.is_null() {
                check(key, largest_difference(&got[key], reference), 1e-5 * largest(reference));
            }
        }
        let reference = &expected["soft_ik"];
        if !reference.is_null() {
            let best = reference["objective_best"].as_f64().unwrap();
            let initial = reference["objective_initial"].as_f64().unwrap_or_else(|| got["objective"].as_f64().unwrap());
            let found = got["soft_ik"]["objective"].as_f64().unwrap();
            check("soft_ik", found - best, 1e-4 * (initial - best));
            let ik = problem.soft_ik.as_ref().unwrap();
            for (j, beta) in numbers(&got["soft_ik"]["beta"]).into_iter().enumerate() {
                let upper = ik.beta_upper.as_ref().and_then(|u| u[j]).unwrap_or(f64::INFINITY);
                let lower = ik.beta_lower.as_ref().and_then(|l| l[j]).unwrap_or(f64::NEG_INFINITY);
                assert!(beta <= upper + 1e-12 && beta >= lower - 1e-12, "{name}: beta[{j}] = {beta} is out of bounds");
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn a_node_of_no_triangle_changes_nothing() {
    for name in ["bar_fibres_tiny", "bar_tendons", "analytic_square_ik"] {
        let mut file = json_of(Path::new(&format!("tests/data/problems/{name}.json")));
        let answered = |file: &Value| solve(&read(&file.to_string()).unwrap().0, &Options::default()).unwrap().document;
        let without = answered(&file);
        // One that a pin holds where it is, and that nothing else knows of.
        let nodes = file["mesh"]["nodes"].as_array_mut().unwrap();
        let (at, stray) = (nodes[0].clone(), nodes.len());
        nodes.push(at.clone());
        file["pins"].as_array_mut().unwrap().push(json!({ "node": stray, "target": at, "K": 1.0 }));
        let with = answered(&file);
        let [a, b] = [&with, &without].map(|answer| answer["soft_ik"]["objective"].as_f64().unwrap());
        assert!((a - b).abs() <= 1e-6 * b.abs().max(1e-12), "{name}: {a:e} and {b:e}");
        let difference = largest_difference(&with["soft_ik"]["beta"], &without["soft_ik"]["beta"]);
        assert!(difference <= 1e-5 * largest(&without["soft_ik"]["beta"]), "{name}: {difference:e}");
    }
}
