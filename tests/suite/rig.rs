//! `rig`: what it says is what `check` says, and what it makes can be sewn.

use crate::files::{place, run};
use serde_json::Value;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Stdio};

fn succeed(folder: &Path, args: &[&str]) -> String {
    let output = run(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Name, error and error at rest of every pose, and how many rules are broken, as `check` has them.
fn checked(folder: &Path, design: &str) -> (Vec<(String, f64, f64)>, usize) {
    let json: Value = serde_json::from_str(&succeed(folder, &["check", design, "--json"])).unwrap();
    let pose = |pose: &Value| {
        let figure = |key: &str| pose[key].as_f64().unwrap();
        (pose["name"].as_str().unwrap().to_owned(), figure("error_realizable"), figure("error_rest"))
    };
    (json["poses"].as_array().unwrap().iter().map(pose).collect(), json["sewing"].as_array().map_or(0, Vec::len))
}

#[test]
fn what_is_told_is_what_a_check_says_and_every_rule_is_kept() {
    let folder = place();
    let f = folder.path();
    let told = succeed(f, &["rig", "bar.plush", "-o", "new.plush", "--fresh", "--max-winches", "1", "--rounds", "4"]);
    let (poses, broken) = checked(f, "new.plush");
    assert_eq!(broken, 0);
    for (name, error, rest) in poses {
        let found = format!("{name} {:.2} %", 100.0 * error);
        assert!(told.contains(&found) && error < rest, "{found} in {told}");
    }
}

#[test]
fn what_sewing_by_hand_costs_is_told_as_a_check_tells_it() {
    let folder = place();
    let f = folder.path();
    let told = succeed(f, &["rig", "bar.plush", "-o", "new.plush", "--fresh", "--max-winches", "1", "--rounds", "1"]);
    let line = told.lines().find(|line| line.starts_with("sewn by hand, holes 2 mm off: ")).expect("told");
    let json: Value = serde_json::from_str(&succeed(f, &["check", "new.plush", "--json", "--sewn"])).unwrap();
    for pose in json["poses"].as_array().unwrap() {
        let [median, worst] = ["median", "worst"].map(|key| pose["error_realizable_sewn"][key].as_f64().unwrap());
        assert!(median <= worst && (median - pose["error_realizable"].as_f64().unwrap()).abs() < 0.1, "{pose}");
        let (_, figures) = line.split_once(&format!("{} ", pose["name"].as_str().unwrap())).expect("told");
        let told: f64 = figures.split(' ').next().unwrap().parse().unwrap();
        // Points are rounded in the file.
        assert!((told - 100.0 * median).abs() < 0.05, "{line} {pose}");
    }
    let table = succeed(f, &["check", "new.plush", "--sewn"]);
    assert!(table.contains("realizable sewn by hand, 5 times, holes 2 mm off"), "{table}");
    assert!(!succeed(f, &["check", "new.plush"]).contains("sewn by hand"));
}

#[test]
fn what_is_proposed_is_what_a_check_says_once_it_is_accepted() {
    let folder = place();
    let f = folder.path();
    succeed(f, &["network", "remove", "bar.plush", "--winch", "1"]);
    let usual = ["propose", "bar.plush", "--pose", "bend", "--tendons", "2"];
    let told: Value = serde_json::from_str(&succeed(f, &[&usual[..], &["--json"]].concat())).unwrap();
    let list = told["proposals"].as_array().unwrap();
    assert!(list.len() > 1 && told["accepted"].is_null(), "{told:#}");
    let before = std::fs::read(f.join("bar.plush")).unwrap();
    let table = succeed(f, &[&usual[..], &["--accept", "2", "-o", "new.plush"]].concat());
    assert!(table.contains("Networks for bend") && table.contains("new.plush: network 2 is "), "{table}");
    assert!(table.contains("`plushwright key new.plush --again`"), "{table}");
    assert_eq!(std::fs::read(f.join("bar.plush")).unwrap(), before);
    let (poses, broken) = checked(f, "new.plush");
    assert_eq!(list[1]["hard_to_sew"], broken);
    for (pose, (name, error, _)) in list[1]["poses"].as_array().unwrap().iter().zip(poses) {
        let told = pose["error_realizable"].as_f64().unwrap();
        assert!(pose["name"] == name && (told - error).abs() < 1e-6, "{pose} {error}");
    }
    let refused = |args: &[&str], code, why| {
        let output = run(f, &[&usual[..], args].concat());
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(code) && error.contains(why), "{error}");
    };
    refused(&["--accept", "99", "-o", "x.plush"], 2, "there is no network 99; there are 1 to ");
    refused(&["--accept", "0", "-o", "x.plush"], 2, "there is no network 0");
    assert!(!f.join("x.plush").exists());
}

#[cfg(unix)]
#[test]
fn what_was_found_before_an_interrupt_is_written() {
    let folder = place();
    let f = folder.path();
    let args = ["rig", "bar.plush", "-o", "new.plush", "--fresh", "--max-winches", "2", "--rounds", "10000"];
    let mut rig = Command::new(env!("CARGO_BIN_EXE_plushwright"))
        .args(args)
        .current_dir(f)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The first layouts are there once a round is told; the pipe stays open for what follows.
    let mut told = BufReader::new(rig.stdout.take().unwrap());
    let mut line = String::new();
    told.read_line(&mut line).unwrap();
    // The shell has `kill` built in; a bare machine has no program of that name.
    let kill = format!("kill -INT {}", rig.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
    let mut rest = String::new();
    told.read_to_string(&mut rest).unwrap();
    let ended = rig.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(130), "{line}{rest}{}", String::from_utf8_lossy(&ended.stderr));
    assert!(rest.contains("the best so far"), "{line}{rest}");
    let (poses, _) = checked(f, "new.plush");
    assert!(poses.iter().all(|(_, error, rest)| error < rest), "{poses:?}");
    // The timeline plays what the search had: as it was not checked, nearly what is worked out anew.
    let keys = || keyframes(&f.join("new.plush"));
    let told = keys();
    succeed(f, &["key", "new.plush", "--again"]);
    for (told, again) in told.iter().zip(keys()) {
        let difference = told.iter().zip(&again).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(difference < 1.0, "{told:?} {again:?}");
    }
    assert!(told.iter().flatten().any(|a| *a > 1.0), "{told:?}");
}

/// What every keyframe of a design winds.
fn keyframes(path: &Path) -> Vec<Vec<f64>> {
    let design = plushwright::design::file::read(path).unwrap();
    design.keyframes.into_iter().map(|keyframe| keyframe.activations_mm).collect()
}

#[test]
fn what_may_not_go_where_it_should_is_kept_beside_it() {
    let folder = place();
    let f = folder.path();
    let copy = |from: &str, to: &str| std::fs::copy(f.join(from), f.join(to)).unwrap();
    // Of the same name, so it may be what the same command wrote before: that is known at the end.
    copy("bar.plush", "new.plush");
    succeed(f, &["pose", "new.plush", "--name", "mine", "--target", "110,10=100,20"]);
    let before = std::fs::read(f.join("new.plush")).unwrap();
    let args = ["rig", "bar.plush", "-o", "new.plush", "--fresh", "--max-winches", "1", "--rounds", "1"];
    for found in ["new.found.plush", "new.found-2.plush"] {
        let refused = run(f, &args);
        let error = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(2), "{error}");
        assert!(
            error.contains("holds work that would be lost") && error.contains(&format!("is in {found}")),
            "{error}"
        );
        assert_eq!(std::fs::read(f.join("new.plush")).unwrap(), before);
        assert_eq!(checked(f, found).0.len(), 1);
    }
}

#[test]
fn more_winches_and_tendons_are_compared_in_a_table_a_file_and_a_plot() {
    let folder = place();
    let f = folder.path();
    let numbers = ["--fresh", "--max-winches", "1", "--tendons", "1..2", "--rounds", "1"];
    let files = ["--csv", "curve.csv", "--plot", "curve.svg"];
    let args = [&["rig", "bar.plush", "-o", "best.plush", "--explore"][..], &numbers, &files].concat();
    let told = succeed(f, &args);
    let csv = std::fs::read_to_string(f.join("curve.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert!(rows[0][0] == "up to winches" && rows[0].last() == Some(&"bend") && rows.len() == 3, "{csv}");
    assert_eq!((&rows[1][..2], &rows[2][..2]), (&["1", "1"][..], &["1", "2"][..]));
    let worst = |row: &[&str]| row[6].parse::<f64>().unwrap();
    assert!(worst(&rows[2]) <= worst(&rows[1]), "{csv}");
    let svg = std::fs::read_to_string(f.join("curve.svg")).unwrap();
    assert!(svg.contains("tendons of each winch") && svg.contains("<svg"), "{svg}");
    assert!(told.contains("up to 1 winch of 2 tendons") && told.contains("worst pose (% of rest)"), "{told}");
    // The best of them is kept, and a check says the figure of the table: with the friction that a new design has.
    let json: Value = serde_json::from_str(&succeed(f, &["check", "best.plush", "--json"])).unwrap();
    let error = json["poses"][0]["error_realizable_friction"].as_f64().unwrap();
    let told: f64 = rows[2].last().unwrap().parse().unwrap();
    assert!((told - 100.0 * error).abs() < 0.01, "{told} {error}");
    // Its own files are written again, those of others are not.
    succeed(f, &[&args[..], &["--force"]].concat());
    std::fs::write(f.join("curve.csv"), "mine").unwrap();
    assert_eq!(run(f, &args).status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(f.join("curve.csv")).unwrap(), "mine");
}

#[test]
fn compared_rigs_are_one_record_for_programs_and_a_winch_too_many_is_refused() {
    let folder = place();
    let f = folder.path();
    let args =
        ["rig", "bar.plush", "-o", "best.plush", "--fresh", "--max-winches", "1", "--tendons", "1", "--rounds", "1"];
    let told = succeed(f, &[&args[..], &["--explore", "--json"]].concat());
    let record: Value = serde_json::from_str(&told).unwrap_or_else(|error| panic!("{error}: {told}"));
    let points = record["points"].as_array().unwrap();
    assert_eq!((points.len(), record["interrupted"].as_bool()), (1, Some(false)));
    let check: Value = serde_json::from_str(&succeed(f, &["check", "best.plush", "--json"])).unwrap();
    assert_eq!(record["poses"][0]["error_realizable"], check["poses"][0]["error_realizable"]);
    // Where the pose is reached, one more winch is worth nothing, and none is added.
    let more = ["rig", "best.plush", "-o", "more.plush", "--max-winches", "1", "--tendons", "1", "--rounds", "1"];
    let mut output = run(f, &more);
    for _ in 0..3 {
        if !output.status.success() {
            break;
        }
        let noted = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(noted.contains("keyframes of bend wind what they did before"), "{noted}");
        std::fs::rename(f.join("more.plush"), f.join("best.plush")).unwrap();
        output = run(f, &more);
    }
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(3) && words.contains("no further network"), "{words}");
}

#[test]
fn parameters_of_algorithm_2_belong_to_it() {
    let folder = place();
    let f = folder.path();
    let refused = run(f, &["rig", "bar.plush", "-o", "x.plush", "--phi", "0.5"]);
    assert_eq!(refused.status.code(), Some(2));
    let refused = String::from_utf8(refused.stderr).unwrap();
    assert!(refused.contains("--phi is a parameter of --method algorithm2"), "{refused}");
    let args = ["--method", "algorithm2", "--phi", "0.5", "--fresh", "--max-winches", "1", "--tendons", "1"];
    let told = succeed(f, &[&["rig", "bar.plush", "-o", "x.plush"][..], &args].concat());
    assert!(told.contains("candidate networks"), "{told}");
    let (poses, _) = checked(f, "x.plush");
    assert!(poses.iter().all(|(_, error, rest)| error < rest));
}

#[test]
fn a_fresh_rig_solves_poses_anew_and_tells_what_was_set_by_hand() {
    let folder = place();
    let f = folder.path();
    let text = std::fs::read_to_string(f.join("bar.plush")).unwrap();
    let by_hand = text.replacen("pose: Some(\"bend\"), ", "", 1).replacen(", pose: Some(\"bend\")", "", 1);
    assert_ne!(by_hand, text, "a keyframe of the pose in {text}");
    std::fs::write(f.join("bar.plush"), by_hand).unwrap();
    let fresh = ["--fresh", "--max-winches", "1", "--rounds", "1"];
    let told = succeed(f, &[&["rig", "bar.plush", "-o", "new.plush"][..], &fresh].concat());
    assert!(told.contains("note: the keyframe at ") && told.contains("set by hand"), "{told}");
    std::fs::write(f.join("bar.plush"), text).unwrap();
    let told = succeed(f, &[&["rig", "bar.plush", "-o", "again.plush", "--force"][..], &fresh].concat());
    assert!(!told.contains("note:"), "{told}");
    let again = std::fs::read_to_string(f.join("again.plush")).unwrap();
    let keyed = again.lines().find(|line| line.contains("pose: Some(\"bend\")")).unwrap();
    assert!(keyed.contains("activations_mm: [") && !keyed.contains("activations_mm: [0.0]"), "{keyed}");
}
