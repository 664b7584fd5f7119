//! Drags and malformed files through the JSON interface: what the window does while a hand drags, without the window.

use crate::support::bodies::{Mesh, bar, largest_difference, neo_hookean};
use plushwright::problem::{Options, Quality, read, solve};
use serde_json::{Value, json};

const MU: f64 = 400.0;

/// A 0.3 m bar in SI units; a fibre on every edge, its left end pinned.
fn fiber_problem() -> (Mesh, Value) {
    let mesh = bar(0.3, 0.08, 12, 3);
    let fibers: Vec<Value> = mesh
        .fibers(3.0 * MU)
        .iter()
        .enumerate()
        .map(|(k, e)| {
            json!({"routing": e.routing, "K": e.stiffness, "epsilon": e.epsilon, "alpha0": e.alpha0, "winch": k})
        })
        .collect();
    let upper: Vec<f64> = fibers.iter().map(|e| 0.35 * e["alpha0"].as_f64().unwrap()).collect();
    let lower: Vec<f64> = fibers.iter().map(|e| -e["epsilon"].as_f64().unwrap()).collect();
    let pins: Vec<Value> =
        (0..=3).map(|j| json!({"node": mesh.at(0, j), "target": mesh.nodes[mesh.at(0, j)], "K": 1e4})).collect();
    let tip = mesh.at(12, 3);
    let problem = json!({
        "format": "plushwright-problem/1",
        "mesh": {"nodes": mesh.nodes, "triangles": mesh.triangles},
        "material": {"mu": MU, "kappa": 600.0},
        "elements": fibers,
        "pins": pins,
        "objective": {
            "targets": [{"node": tip, "xy": mesh.nodes[tip], "weight": 1.0}],
            "default_weight": 2e-5,
            "regulariser": 0.0,
        },
        "soft_ik": {"beta_upper": upper, "beta_lower": lower},
    });
    (mesh, problem)
}

/// Two tendons of two cables each (upper and lower side), one winch a side.
fn winch_problem() -> (Mesh, Value) {
    let (mesh, mut problem) = fiber_problem();
    let mut elements = Vec::new();
    for (winch, rows) in [(7, [3, 2]), (3, [0, 1])] {
        for j in rows {
            let routing: Vec<usize> = (0..=12).map(|i| mesh.at(i, j)).collect();
            elements.push(json!({"routing": routing, "K": 3.0 * MU, "epsilon": 1e-3, "alpha0": 0.3, "winch": winch}));
        }
    }
    problem["elements"] = json!(elements);
    problem["soft_ik"] = json!({"winch_ids": [7, 3], "beta_upper": [0.1, 0.1], "beta_lower": [-1e-3, 0.0]});
    problem["objective"]["default_weight"] = json!(0.0);
    (mesh, problem)
}

fn drag(problem: &mut Value, frames: Vec<[f64; 2]>, report: Vec<usize>) {
    let frames: Vec<[[f64; 2]; 1]> = frames.into_iter().map(|p| [p]).collect();
    problem["drag"] = json!({"frames": frames, "report": report, "tension_regulariser": 1e-4 * 0.3 * 0.3 / (MU * MU)});
}

fn answered(problem: &Value, quality: Quality) -> (Value, bool) {
    let (problem, unknown) = read(&problem.to_string()).unwrap();
    assert!(unknown.is_empty(), "{unknown:?}");
    let options = Options { quality, budget: std::time::Duration::from_secs(600), ..Options::default() };
    let answer = solve(&problem, &options).unwrap();
    (answer.document, answer.converged)
}

fn flat(v: &Value) -> Vec<f64> {
    match v {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        Value::Number(n) => vec![n.as_f64().unwrap()],
        other => panic!("{other} is not a number"),
    }
}

/// Every reported frame is a shape that can be shown, in balance, and within the limits.
fn check_frames(mesh: &Mesh, problem: &Value, answer: &Value) {
    let body = mesh.body(neo_hookean(), None);
    let winch_of = |e: usize| problem["elements"][e]["winch"].as_i64().unwrap();
    let mut ids: Vec<i64> = (0..problem["elements"].as_array().unwrap().len()).map(winch_of).collect();
    ids.sort_unstable();
    ids.dedup();
    if let Some(order) = problem["soft_ik"]["winch_ids"].as_array() {
        ids = order.iter().map(|v| v.as_i64().unwrap()).collect();
    }
    let (upper, lower) = (flat(&problem["soft_ik"]["beta_upper"]), flat(&problem["soft_ik"]["beta_lower"]));
    for frame in answer["drag"]["reported"].as_array().unwrap() {
        let k = frame["frame"].as_u64().unwrap();
        let x = flat(&frame["x"]);
        assert_eq!(x.len(), 2 * mesh.nodes.len());
        assert!(x.iter().all(|v| v.is_finite()));
        assert!(body.smallest_determinant(&x) > 0.0, "frame {k} is inverted");
        let residual = frame["residual"].as_f64().unwrap();
        assert!(residual <= 1e-8 * MU * 0.3, "frame {k}: residual {residual:e}");
        let contractions = flat(&frame["alpha_c"]);
        for (e, c) in contractions.iter().enumerate() {
            let j = ids.iter().position(|id| *id == winch_of(e)).unwrap();
            assert!(*c <= upper[j] + 1e-12 && *c >= lower[j] - 1e-12, "frame {k}: element {e} at {c}");
            let first = (0..e).find(|f| winch_of(*f) == winch_of(e));
            assert!(first.is_none_or(|f| contractions[f] == *c), "frame {k}: one winch, two contractions");
        }
        // The figures reported belong to the shape reported.
        let nodes: Vec<usize> = problem["objective"]["targets"]
            .as_array()
            .unwrap()
            .iter()
            .map(|t| t["node"].as_u64().unwrap() as usize)
            .collect();
        let goals = &problem["drag"]["frames"][k as usize];
        let sum: f64 = nodes
            .iter()
            .enumerate()
            .map(|(t, n)| {
                let g = flat(&goals[t]);
                (x[2 * n] - g[0]).powi(2) + (x[2 * n + 1] - g[1]).powi(2)
            })
            .sum();
        let error = answer["drag"]["target_error"][k as usize].as_f64().unwrap();
        // Rounding of the distance, which may be many body lengths.
        assert!((error - (sum / nodes.len() as f64).sqrt()).abs() < 1e-12 * error.max(1.0));
    }
}

/// Out along an arc within reach, and back to the start, in `frames` frames; the last ones stay there.
fn there_and_back(start: [f64; 2], reach: f64, frames: usize) -> Vec<[f64; 2]> {
    (0..frames)
        .map(|k| {
            let phase = (k as f64 / (frames - 10) as f64).min(1.0) * std::f64::consts::TAU;
            let out = 0.5 * (1.0 - phase.cos());
            [start[0] - reach * 0.4 * out * out, start[1] + reach * out]
        })
        .collect()
}

#[test]
fn a_bar_follows_the_hand_and_returns_to_rest() {
    let (mesh, mut problem) = fiber_problem();
    let tip = mesh.nodes[mesh.at(12, 3)];
    for (quality, lag, rest) in
        [(Quality::Draft, 0.01, 0.01), (Quality::Balanced, 2e-3, 3e-3), (Quality::Accurate, 2e-3, 3e-3)]
    {
        drag(&mut problem, there_and_back(tip, 0.1, 30), (0..30).collect());
        let (answer, converged) = answered(&problem, quality);
        check_frames(&mesh, &problem, &answer);
        let errors = flat(&answer["drag"]["target_error"]);
        let worst = errors.iter().fold(0.0_f64, |m, e| m.max(*e));
        let iterations: f64 = flat(&answer["drag"]["iterations"]).iter().sum();
        let time: f64 = flat(&answer["drag"]["milliseconds"]).iter().sum();
        let last = &answer["drag"]["reported"][29];
        let home = largest_difference(&flat(&last["x"]), &mesh.flat());
        println!(
            "{quality:?}: worst error {worst:.2e} m, {iterations} iterations, {time:.0} ms, at the end {home:.2e} from rest"
        );
        assert!(converged);
        assert_eq!(errors.len(), 30);
        assert!(worst < lag * 0.3, "{quality:?}: the target is lost by {worst}");
        assert!(home < rest * 0.3, "{quality:?}: {home} from rest");
    }
}

#[test]
fn winches_of_several_cables_follow_too() {
    let (mesh, mut problem) = winch_problem();
    let tip = mesh.nodes[mesh.at(12, 3)];
    drag(&mut problem, there_and_back(tip, 0.1, 30), (0..30).collect());
    let (answer, converged) = answered(&problem, Quality::Balanced);
    check_frames(&mesh, &problem, &answer);
    let errors = flat(&answer["drag"]["target_error"]);
    let frames = flat(&problem["drag"]["frames"]);
    let farthest = frames.chunks_exact(2).map(|p| (p[0] - tip[0]).hypot(p[1] - tip[1])).fold(0.0, f64::max);
    let worst = errors.iter().fold(0.0_f64, |m, e| m.max(*e));
    println!("winches: worst error {worst:.3e} m of a pull of {farthest:.3e} m");
    assert!(converged);
    // Two winches and two coordinates, but a shape of their own.
    assert!(worst < 0.4 * farthest, "{worst} of {farthest}");
    let home = largest_difference(&flat(&answer["drag"]["reported"][29]["x"]), &mesh.flat());
    assert!(home < 1e-2 * 0.3, "{home} from rest");
}

#[test]
fn the_pose_returns_when_a_target_comes_back_from_far_away() {
    for (name, (mesh, mut problem)) in [("fibres", fiber_problem()), ("winches", winch_problem())] {
        let tip = mesh.nodes[mesh.at(12, 3)];
        let goal = [tip[0] - 0.03, tip[1] + 0.08];
        drag(&mut problem, vec![goal; 20], vec![19]);
        let (fresh, _) = answered(&problem, Quality::Accurate);
        for away in [[tip[0] + 30.0, tip[1]], [tip[0] - 20.0, tip[1] - 22.0], [0.0, 3e5]] {
            let mut frames = vec![goal; 5];
            frames.extend([away; 15]);
            frames.extend([goal; 40]);
            drag(&mut problem, frames, (0..60).collect());
            let (answer, converged) = answered(&problem, Quality::Balanced);
            check_frames(&mesh, &problem, &answer);
            let x = flat(&answer["drag"]["reported"][59]["x"]);
            let difference = largest_difference(&x, &flat(&fresh["drag"]["reported"][0]["x"]));
            let error = answer["drag"]["target_error"][59].as_f64().unwrap();
            let time = flat(&answer["drag"]["milliseconds"]).iter().fold(0.0_f64, |m, t| m.max(*t));
            println!(
                "{name}, {away:?}: {difference:.2e} m from the fresh pose, target error {error:.2e} m, slowest frame {time:.0} ms"
            );
            assert!(converged);
            assert!(difference < 1e-3 * 0.3, "{name}, {away:?}: {difference} m from the fresh pose");
        }
    }
}

#[test]
fn the_same_drag_gives_the_same_bits() {
    let (mesh, mut problem) = fiber_problem();
    let tip = mesh.nodes[mesh.at(12, 3)];
    drag(&mut problem, there_and_back(tip, 0.5, 12), (0..12).collect());
    let run = || answered(&problem, Quality::Balanced).0["drag"]["reported"].clone();
    assert_eq!(run(), run());
}

#[test]
fn a_file_with_a_drag_is_answered_for_its_drag_unless_all_is_asked() {
    let (mesh, mut problem) = winch_problem();
    drag(&mut problem, vec![mesh.nodes[mesh.at(12, 3)]; 2], vec![1]);
    let (answer, _) = answered(&problem, Quality::Balanced);
    let keys: Vec<&str> = answer.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(keys, ["converged", "drag", "format"]);
    let (read, _) = read(&problem.to_string()).unwrap();
    let all = solve(&read, &Options { all: true, ..Options::default() }).unwrap().document;
    for key in ["x", "energy", "tensions", "pin_forces", "residual", "objective", "grad_beta", "soft_ik", "drag"] {
        assert!(!all[key].is_null(), "{key} is absent");
    }
    assert_eq!(all["drag"]["reported"].as_array().unwrap().len(), 1);
}

/// Sets the value at a JSON pointer; the last step of the pointer may be a new key.
fn set(problem: &mut Value, pointer: &str, value: Value) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match problem.pointer_mut(parent).unwrap_or_else(|| panic!("{parent} is absent")) {
        Value::Object(map) => drop(map.insert(key.into(), value)),
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        other => panic!("{other} has no parts"),
    }
}

#[test]
fn every_contradiction_is_refused_by_key_and_index() {
    let cases: Vec<(&str, Value, &str)> = vec![
        ("/format", json!("plushwright-problem/9"), "format"),
        ("/format", json!(3), "format"),
        ("/mesh", json!(null), "mesh"),
        ("/mesh/nodes", json!(7), "mesh.nodes"),
        ("/mesh/nodes/4", json!([1.0]), "mesh.nodes[4]"),
        ("/mesh/nodes/4", json!([1.0, null]), "mesh.nodes[4]"),
        ("/mesh/triangles", json!([]), "mesh.triangles"),
        ("/mesh/triangles/2", json!([0, 1, 9999]), "mesh.triangles[2]"),
        ("/mesh/triangles/2", json!([0, 1, -1]), "mesh.triangles[2]"),
        ("/mesh/triangles/1", json!([0, 13, 1]), "mesh.triangles[1]"),
        ("/mesh/triangles/5", json!([0, 1, 2]), "mesh.triangles[5]"),
        ("/mesh/triangles/5", json!([0, 1]), "mesh.triangles[5]"),
        ("/material", json!(null), "material"),
        ("/material/mu", json!(0.0), "material.mu"),
        ("/material/mu", json!(-1.0), "material.mu"),
        ("/material/kappa", json!(-0.1), "material.kappa"),
        ("/material/kappa", json!("soft"), "material"),
        ("/elements/1/routing", json!([3]), "elements[1].routing"),
        ("/elements/1/routing", json!([]), "elements[1].routing"),
        ("/elements/1/routing", json!([3, 4, 4]), "elements[1].routing[2]"),
        ("/elements/1/routing", json!([3, 4000]), "elements[1].routing[1]"),
        ("/elements/3/K", json!(-5.0), "elements[3].K"),
        ("/elements/0/epsilon", json!(0.0), "elements[0].epsilon"),
        ("/elements/0/alpha0", json!(0.0), "elements[0].alpha0"),
        ("/elements/2", json!({"routing": [0, 1]}), "elements[2]"),
        ("/pins/1/node", json!(777), "pins[1].node"),
        ("/pins/1/K", json!(-1.0), "pins[1].K"),
        ("/pins/0/target", json!([0.0]), "pins[0]"),
        ("/contractions", json!([0.0]), "contractions"),
        ("/objective/targets/0/node", json!(500), "objective.targets[0].node"),
        ("/objective/targets/0/weight", json!(-1.0), "objective.targets[0].weight"),
        ("/objective/default_weight", json!(-1.0), "objective.default_weight"),
        ("/objective/regulariser", json!(-1.0), "objective.regulariser"),
        ("/objective", json!(null), "objective"),
        ("/soft_ik/winch_ids", json!([7, 9]), "soft_ik.winch_ids[1]"),
        ("/soft_ik/winch_ids", json!([7, 7]), "soft_ik.winch_ids[1]"),
        ("/soft_ik/winch_ids", json!([7]), "soft_ik.beta_upper"),
        ("/soft_ik/beta_upper", json!([0.1]), "soft_ik.beta_upper"),
        ("/soft_ik/beta_lower", json!([0.0, 0.0, 0.0]), "soft_ik.beta_lower"),
        ("/soft_ik/beta_lower", json!([0.0, 0.2]), "soft_ik.beta_lower[1]"),
        ("/soft_ik/beta_start", json!([0.0]), "soft_ik.beta_start"),
        ("/soft_ik/fixed_winches", json!({"12": 0.0}), "soft_ik.fixed_winches.12"),
        ("/soft_ik/fixed_winches", json!({"left": 0.0}), "soft_ik.fixed_winches.left"),
        ("/soft_ik/fixed_winches", json!({"7": 0.0}), "soft_ik.winch_ids[0]"),
        ("/start", json!([[0.0, 0.0]]), "start"),
        ("/gravity", json!([0.0, -9.81]), "surface_density"),
        ("/gravity", json!([0.0]), "gravity"),
        ("/surface_density", json!(-1.0), "surface_density"),
        ("/drag/report", json!([0, 2]), "drag.report[1]"),
        ("/drag/report", json!([-1]), "drag.report[0]"),
        ("/drag/frames/1", json!([]), "drag.frames[1]"),
        ("/drag/frames/1", json!([[0.0, 0.0], [1.0, 1.0]]), "drag.frames[1]"),
        ("/drag/frames/0/0", json!([0.0]), "drag.frames[0]"),
        ("/drag/tension_regulariser", json!(-1.0), "drag.tension_regulariser"),
    ];
    let (mesh, mut problem) = winch_problem();
    drag(&mut problem, vec![mesh.nodes[mesh.at(12, 3)]; 2], vec![1]);
    read(&problem.to_string()).unwrap();
    let mut failures = Vec::new();
    for (pointer, value, key) in cases {
        let mut broken = problem.clone();
        set(&mut broken, pointer, value.clone());
        match read(&broken.to_string()) {
            Ok(_) => failures.push(format!("{pointer} = {value}: accepted")),
            Err(e) => {
                let line = e.to_string();
                if !line.starts_with(&format!("{key}:")) || line.contains('\n') {
                    failures.push(format!("{pointer} = {value}: \"{line}\" does not name {key}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn malformed_json_and_numbers_that_are_none_name_their_place() {
    let (mesh, mut problem) = winch_problem();
    drag(&mut problem, vec![mesh.nodes[mesh.at(12, 3)]; 2], vec![1]);
    let text = serde_json::to_string_pretty(&problem).unwrap();
    let cut = &text[..text.len() / 2];
    for broken in [cut, "", "[1, 2", "{\"format\": }", "nonsense", "{\"a\": NaN}"] {
        let line = read(broken).unwrap_err().to_string();
        assert!(line.contains("line") && line.contains("column") && !line.contains('\n'), "{line}");
    }
    for broken in ["[]", "3", "null", "\"text\""] {
        assert!(read(broken).unwrap_err().to_string().starts_with("problem:"));
    }
    // Too large for a number: JSON has no infinity.
    let line = read(&text.replacen("400.0", "1e999", 1)).unwrap_err().to_string();
    assert!(line.contains("material.mu") || line.contains("line"), "{line}");
    // a-b-a is a legal routing; unknown keys are reported, not refused.
    set(&mut problem, "/elements/0/routing", json!([3, 4, 3]));
    set(&mut problem, "/colour", json!("red"));
    assert_eq!(read(&problem.to_string()).unwrap().1, ["colour"]);
}
