//! `soft_ik` of problem files: the file's own objective, at any number of fibres, against scipy's L-BFGS-B from zero and from taut
//! with a statics of its own (`scripts/peers inverse --seed 1`; `best.json` holds the lower of its two values).

use plushwright::problem::{Options, answer, read};
use serde_json::{Value, json};
use std::path::Path;

fn text(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/soft_ik");
    std::fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn the_default_method_is_as_good_as_a_quasi_newton_method_from_two_starts() {
    let best: Value = serde_json::from_str(&text("best.json")).unwrap();
    for (name, best) in best.as_object().unwrap() {
        let (problem, _) = read(&text(&format!("{name}.json"))).unwrap();
        let found = answer(&problem, &Options::default()).unwrap();
        let ik = found.soft_ik.unwrap();
        let ratio = ik.objective / best.as_f64().unwrap();
        println!("{name}: {ratio:.5} of the best known, {} starts", ik.starts);
        assert!(ratio <= 1.001, "{name}: {ratio}");
        assert!(found.converged && ik.converged && ik.minimises == "objective", "{name}");
        assert!(ik.projected_gradient.unwrap() <= ik.tolerance, "{name}");
    }
}

#[test]
fn an_answer_to_another_objective_is_not_called_converged() {
    let (problem, _) = read(&text("L_174_fibres.json")).unwrap();
    let found = answer(&problem, &Options { method: "tension".into(), ..Options::default() }).unwrap();
    let ik = found.soft_ik.unwrap();
    assert_eq!(ik.minimises, "tension-regularised");
    assert!(!ik.converged && !found.converged && ik.projected_gradient.unwrap() > ik.tolerance);
    assert!(found.error.unwrap().contains("projected gradient"));
}

#[test]
fn the_gradient_that_is_written_is_that_of_the_file() {
    // Posed as a statics question at the answer, the file's own sensitivities give the same projected gradient.
    let mut file: Value = serde_json::from_str(&text("ring_106_fibres.json")).unwrap();
    let (problem, _) = read(&file.to_string()).unwrap();
    let ik = answer(&problem, &Options { method: "gradient".into(), ..Options::default() }).unwrap().soft_ik.unwrap();
    file["contractions"] = json!(ik.alpha_c);
    file["start"] = json!(ik.x);
    let (problem, _) = read(&file.to_string()).unwrap();
    let at = answer(&problem, &Options { method: "contraction".into(), ..Options::default() }).unwrap();
    let bound = |key: &str, j: usize| file["soft_ik"][key].get(j).and_then(Value::as_f64);
    let largest = at.grad_beta.unwrap().into_iter().enumerate().map(|(j, g)| {
        let low = bound("beta_lower", j).is_some_and(|b| ik.beta[j] <= b) && g > 0.0;
        let high = bound("beta_upper", j).is_some_and(|b| ik.beta[j] >= b) && g < 0.0;
        if low || high { 0.0 } else { g.abs() * file["elements"][j]["alpha0"].as_f64().unwrap() }
    });
    let largest = largest.fold(0.0, f64::max);
    let written = ik.projected_gradient.unwrap();
    assert!((largest - written).abs() <= 1e-6 * written, "{largest:e} is not {written:e}");
}
