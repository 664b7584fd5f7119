//! The built program, from outside: help, exit codes, one-line errors, outputs that appear whole or not at all.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const COMMANDS: [&str; 24] = [
    "demo",
    "new",
    "mesh",
    "remesh",
    "reshape",
    "drawing",
    "pose",
    "arrange",
    "starch",
    "propose",
    "rig",
    "network",
    "key",
    "retime",
    "check",
    "export",
    "play",
    "simulate-controller",
    "render",
    "solve",
    "discover",
    "bench",
    "completions",
    "man",
];

/// A bar that is wide enough for a few dozen fibres.
const OUTLINE: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="40mm" viewBox="0 0 120 40">
<rect width="120" height="40"/></svg>"#;

fn plushwright(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plushwright"))
        .args(args)
        .current_dir(folder)
        // A window would need a display; the tests below never want one.
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[track_caller]
fn succeed(folder: &Path, args: &[&str]) -> String {
    let output = plushwright(folder, args);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    stdout(&output)
}

/// The one line on standard error.
#[track_caller]
fn fail(folder: &Path, code: i32, args: &[&str]) -> String {
    let output = plushwright(folder, args);
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{args:?}: {error}");
    assert_eq!(error.lines().count(), 1, "{args:?}: {error}");
    assert!(error.starts_with("plushwright: ") && error.ends_with('\n'), "{args:?}: {error}");
    error
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A folder with `bar.svg` and its design `bar.plush`.
fn bar() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bar.svg"), OUTLINE).unwrap();
    let text = succeed(folder.path(), &["new", "bar.svg", "-o", "bar.plush", "--fibers", "60"]);
    assert!(text.contains("60 fibers") && text.contains("120.0 mm long"), "{text}");
    folder
}

#[test]
fn every_command_explains_itself_with_an_example() {
    let here = Path::new(".");
    let overview = succeed(here, &["--help"]);
    for command in COMMANDS {
        assert!(overview.contains(&format!("\n  {command} ")), "{command} is not listed");
        let help = succeed(here, &[command, "--help"]);
        assert!(
            help.contains("Usage: plushwright ") && help.contains(&format!("Example: plushwright {command}")),
            "{help}"
        );
    }
    assert_eq!(succeed(here, &["--version"]), format!("plushwright {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn wrong_usage_is_one_line_and_code_2() {
    let folder = bar();
    let f = folder.path();
    for args in [
        &["new"][..],
        &["chekc"],
        &["check"],
        &["check", "none.plush"],
        &["check", "bar.svg"],
        &["check", "bar.plush", "--frob"],
        &["check", "bar.plush", "--friction", "1.5"],
        &["check", "bar.plush", "--friction=-0.1"],
        &["check", "bar.plush", "--friction", "nan"],
        &["new", "bar.svg", "-o", "x.plush", "--height", "-3"],
        &["new", "bar.svg", "-o", "x.plush", "--fibers", "many"],
        &["new", "none.svg", "-o", "x.plush"],
        &["pose", "bar.plush", "--name", " ", "-o", "x.plush"],
        &["pose", "bar.plush", "--name", "p", "--pin", "1;2", "-o", "x.plush"],
        &["pose", "bar.plush", "--name", "p", "--target", "1,2=3", "-o", "x.plush"],
        &["pose", "bar.plush", "--name", "p", "--pin", "-60,10", "-o", "x.plush"],
        &["rig", "bar.plush", "-o", "x.plush", "--tendons", "3..1"],
        &["rig", "bar.plush", "-o", "x.plush"],
        &["network", "remove", "bar.plush", "--winch", "1", "-o", "x.plush"],
        &["network", "new", "bar.plush", "--through", "20,20", "-o", "x.plush"],
        &["network", "new", "bar.plush", "--through", "20,20", "--through", "-20,20", "-o", "x.plush"],
        &["key", "bar.plush", "--pose", "p", "--time", "0", "-o", "x.plush"],
        &["export", "bar.plush", "-o", "x"],
        &["render", "bar.plush", "-o", "x.png", "--pose", "none"],
        &["render", "bar.plush", "-o", "x.png", "--time", "1"],
        &["render", "bar.plush", "-o", "x.png", "--size", "0x9"],
        &["solve", "none.json"],
        &["solve", "bar.svg", "-o", "x.json"],
        &["solve", "bar.svg", "--method", "guess"],
        &["discover", "bar.svg", "-o", "x.json"],
        &["demo", "--out", "."],
    ] {
        fail(f, 2, args);
    }
    assert_eq!(names(f), ["bar.plush", "bar.svg"], "something was written on failure");
}

#[test]
fn errors_quote_the_bad_text() {
    let folder = bar();
    for bad in ["7", "1,2,3", "--name", "nan,0"] {
        let error = fail(folder.path(), 2, &["pose", "bar.plush", "--name", "p", "-o", "x.plush", "--pin", bad]);
        assert!(error.contains(&format!("`{bad}`")), "{error}");
    }
    let error = fail(folder.path(), 2, &["render", "bar.plush", "-o", "x.png", "--pose", "wave"]);
    assert!(error.contains("`wave`"), "{error}");
}

#[test]
fn an_output_that_cannot_be_written_is_code_1() {
    let folder = bar();
    fail(folder.path(), 1, &["new", "bar.svg", "-o", "none/bar.plush"]);
    fs::create_dir(folder.path().join("taken.png")).unwrap();
    fail(folder.path(), 1, &["render", "bar.plush", "-o", "taken.png", "--size", "64x32"]);
    assert_eq!(names(folder.path()), ["bar.plush", "bar.svg", "taken.png"]);
}

#[test]
fn a_pose_travels_from_the_command_line_to_the_check() {
    let folder = bar();
    let f = folder.path();
    let pose = ["pose", "bar.plush", "--name", "bend", "-o", "bar.plush"];
    // Half a millimetre beside the body still means its edge.
    let bend = [&pose[..], &["--pin", "-0.5,5", "--pin", "0,35", "--target", "115,20=105,38"]].concat();
    assert!(succeed(f, &bend).contains("pose bend has 1 targets; 2 pins, 1 poses"));
    // The same point again replaces its target and its pin; another point adds one.
    let again = [&pose[..], &["--pin", "0,35", "--target", "115,20=105,44", "--target", "60,20=60,24"]].concat();
    assert!(succeed(f, &again).contains("pose bend has 2 targets; 2 pins, 1 poses"));

    let json: serde_json::Value = serde_json::from_str(&succeed(f, &["check", "bar.plush", "--json"])).unwrap();
    let keys = |value: &serde_json::Value| {
        let mut keys: Vec<String> = value.as_object().unwrap().keys().cloned().collect();
        keys.sort();
        keys
    };
    assert_eq!(
        keys(&json),
        ["body_length_mm", "fibers", "format", "name", "nodes", "poses", "sewing", "tendons", "triangles", "winches"]
    );
    let bend = &json["poses"][0];
    assert_eq!(
        keys(bend),
        [
            "error_idealized",
            "error_realizable",
            "error_rest",
            "imbalance_idealized",
            "imbalance_realizable",
            "milliseconds_idealized",
            "milliseconds_realizable",
            "name",
            "targets"
        ]
    );
    assert_eq!((json["name"].as_str(), json["fibers"].as_u64()), (Some("bar"), Some(60)));
    assert_eq!(bend["targets"].as_u64(), Some(2));
    // sqrt((10^2 + 24^2 + 4^2) / 2) mm over a body of 120 mm.
    let rest = bend["error_rest"].as_f64().unwrap();
    assert!((rest - (692.0_f64 / 2.0).sqrt() / 120.0).abs() < 1e-6, "{rest}");
    assert!(bend["error_idealized"].as_f64().unwrap() < 0.5 * rest);
    // Without winches the realizable plushie stays where it is.
    assert!((bend["error_realizable"].as_f64().unwrap() - rest).abs() < 1e-3);

    let table = succeed(f, &["check", "bar.plush"]);
    assert!(table.contains("60 fibers") && table.contains("bend"), "{table}");
}

#[test]
fn a_body_that_was_just_made_begins_with_a_pose_of_its_own_or_the_name_that_is_given() {
    let folder = bar();
    let f = folder.path();
    let made = succeed(f, &["pose", "bar.plush", "--begin", "-o", "one.plush"]);
    assert!(made.contains("pose Wave has 1 targets"), "{made}");
    let made = succeed(f, &["pose", "bar.plush", "--begin", "--name", "nod", "-o", "two.plush"]);
    assert!(made.contains("pose nod has 1 targets"), "{made}");
    fail(f, 2, &["pose", "bar.plush", "-o", "three.plush"]);
}

#[test]
fn keyframes_of_poses_are_worked_out_again_where_targets_have_changed() {
    let folder = tempfile::tempdir().unwrap();
    let (f, pig) = (folder.path(), folder.path().join("pig.plush"));
    fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/pig.plush"), &pig).unwrap();
    let read = || plushwright::design::file::read(&pig).unwrap().keyframes;
    let wound = |keyframes: &[plushwright::design::Keyframe]| keyframes[1].activations_mm[0];
    let before = read();
    assert!(succeed(f, &["key", "pig.plush", "--again"]).contains("ear-and-leg at 1 s"));
    assert!((wound(&read()) - wound(&before)).abs() < 1e-6 * wound(&before), "{:?}", read());
    succeed(f, &["pose", "pig.plush", "--name", "ear-and-leg", "--target", "67,214=50,200", "--target", "83,10=70,30"]);
    succeed(f, &["key", "pig.plush", "--again"]);
    let after = read();
    assert!(wound(&after) < 0.9 * wound(&before), "{after:?}");
    assert!(after.len() == 3 && after[0] == before[0] && after[2] == before[2] && after[1].time_s == 1.0);
    assert!(fail(f, 2, &["key", "pig.plush", "--again", "--pose", "ear-and-leg"]).contains("--again"));
}

#[test]
fn friction_is_told_where_it_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    let old = include_str!("../../examples/pig.plush").replace("friction: 0.2", "friction: 0.0");
    fs::write(f.join("pig.plush"), old).unwrap();
    let table = succeed(f, &["check", "pig.plush", "--friction", "0.2"]);
    assert!(table.contains("realizable with friction at the holes") && table.contains("let out"), "{table}");
    let pose = |args: &[&str]| {
        let json: serde_json::Value = serde_json::from_str(&succeed(f, args)).unwrap();
        json["poses"][0].clone()
    };
    let asked = pose(&["check", "pig.plush", "--json", "--friction", "0.2"]);
    let [plain, pulled, let_out] =
        ["", "_friction", "_letting_out"].map(|end| asked[format!("error_realizable{end}")].as_f64().unwrap());
    assert!(pulled != plain && let_out != pulled && pulled < 0.1 && let_out < 0.1, "{asked}");
    let without = pose(&["check", "pig.plush", "--json"]);
    assert_eq!(without["error_realizable"].as_f64(), Some(plain));
    assert!(without.get("error_realizable_friction").is_none(), "{without}");
}

#[test]
fn a_picture_has_the_size_asked_for() {
    let folder = bar();
    succeed(folder.path(), &["render", "bar.plush", "-o", "bar.png", "--size", "320x180"]);
    let bytes = fs::read(folder.path().join("bar.png")).unwrap();
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!((number(16), number(20)), (320, 180));
    assert_eq!(names(folder.path()), ["bar.plush", "bar.png", "bar.svg"]);
}

/// One right triangle, one fibre on its long side, contracted by a tenth of a metre.
const PROBLEM: &str = r#"{"format": "plushwright-problem/1",
  "mesh": {"nodes": [[0,0],[1,0],[0,1]], "triangles": [[0,1,2]]},
  "material": {"mu": 1.0, "kappa": 1.0},
  "elements": [{"routing": [1,2], "K": 1.0, "epsilon": 0.001, "alpha0": 1.4142135623730951, "winch": 0}],
  "pins": [{"node": 0, "target": [0,0], "K": 100.0}, {"node": 1, "target": [1,0], "K": 100.0}],
  "contractions": [0.1]}"#;

#[test]
fn a_problem_is_answered_on_standard_output_or_in_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    fs::write(f.join("p.json"), PROBLEM).unwrap();
    let answer: serde_json::Value = serde_json::from_str(&succeed(f, &["solve", "p.json"])).unwrap();
    assert_eq!(answer["format"], "plushwright-answer/1");
    assert_eq!(answer["converged"], true);
    assert!(answer["tensions"][0].as_f64().unwrap() > 0.0);
    assert_eq!(succeed(f, &["solve", "p.json", "-o", "a.json"]), "");
    let written: serde_json::Value = serde_json::from_slice(&fs::read(f.join("a.json")).unwrap()).unwrap();
    assert_eq!(written["x"], answer["x"]);
    let keys: Vec<&String> = written.as_object().unwrap().keys().collect();
    let text = fs::read_to_string(f.join("a.json")).unwrap();
    let places: Vec<usize> = keys.iter().map(|key| text.find(&format!("\n  \"{key}\": ")).unwrap()).collect();
    assert!(places.is_sorted(), "keys are not in ascending order: {text}");

    fs::write(f.join("bad.json"), PROBLEM.replace("[0,1,2]", "[0,1,3]")).unwrap();
    let error = fail(f, 2, &["solve", "bad.json", "-o", "b.json"]);
    assert!(error.contains("mesh.triangles[0]"), "{error}");
    fs::write(f.join("cut.json"), &PROBLEM[..40]).unwrap();
    let error = fail(f, 2, &["solve", "cut.json", "-o", "b.json"]);
    assert!(error.contains("line"), "{error}");
    assert!(!f.join("b.json").exists());
}

/// The triangle dragged away in a hundred frames: work for a while.
fn long_drag() -> String {
    let frames: Vec<String> = (0..20_000).map(|k| format!("[[{}, 1.2]]", f64::from(k % 100) / 100.0)).collect();
    let drag = format!(
        r#""objective": {{"targets": [{{"node": 2, "xy": [0, 1]}}]}},
           "drag": {{"frames": [{}], "report": [0], "tension_regulariser": 0.001}}}}"#,
        frames.join(",")
    );
    PROBLEM.replace(r#""contractions": [0.1]}"#, &drag)
}

#[test]
fn a_time_budget_ends_with_the_best_so_far_and_code_3() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    fs::write(f.join("drag.json"), long_drag()).unwrap();
    let error = fail(f, 3, &["solve", "drag.json", "-o", "a.json", "--budget-ms", "5"]);
    assert!(error.contains("time budget"), "{error}");
    let answer: serde_json::Value = serde_json::from_slice(&fs::read(f.join("a.json")).unwrap()).unwrap();
    assert_eq!(answer["converged"], false);
    assert!(answer["error"].as_str().unwrap().contains("time budget"), "{answer}");
    let done = answer["drag"]["milliseconds"].as_array().unwrap().len();
    assert!(done < 20_000, "{done} frames in 5 ms");
    // With time enough the same question is answered as without a budget.
    fs::write(f.join("p.json"), PROBLEM).unwrap();
    let plain: serde_json::Value = serde_json::from_str(&succeed(f, &["solve", "p.json"])).unwrap();
    let given: serde_json::Value =
        serde_json::from_str(&succeed(f, &["solve", "p.json", "--budget-ms", "60000"])).unwrap();
    assert_eq!(plain, given);
    for bad in ["0", "-5", "soon", "1.5"] {
        let error = fail(f, 2, &["solve", "p.json", "--budget-ms", bad]);
        assert!(error.contains(bad), "{error}");
    }
}

/// A body that falls has no equilibrium: what there is to say is said, what there is to write is written.
#[test]
fn a_shape_without_equilibrium_is_code_3() {
    use plushwright::design::{Gravity, MaterialPoint, Network, Pose, Tendon, file};
    let folder = bar();
    let f = folder.path();
    let mut design = file::read(&f.join("bar.plush")).unwrap();
    design.gravity = Some(Gravity { acceleration: [0.0, -9.81], surface_density: 1e-6 });
    let top: Vec<usize> = (0..design.mesh.nodes.len()).filter(|&n| design.mesh.nodes[n][1] > 39.9).collect();
    let tendon = Tendon { routing: MaterialPoint::through(top), ratio: 1.0, slack_mm: 0.0 };
    design.networks.push(Network::new("winch 1", vec![tendon]));
    design.poses.push(Pose { name: "fall".into(), targets: Vec::new() });
    file::write(&f.join("falling.plush"), &design).unwrap();

    let check = plushwright(f, &["check", "falling.plush", "--json"]);
    assert_eq!(check.status.code(), Some(3), "{check:?}");
    let figures: serde_json::Value = serde_json::from_str(&stdout(&check)).unwrap();
    assert!(figures["poses"][0]["imbalance_idealized"].as_f64().unwrap() > 1e-8, "{figures}");
    let error = String::from_utf8(check.stderr).unwrap();
    assert!(error.starts_with("plushwright: not converged: fall, idealized: ") && error.contains("pin"), "{error}");
    assert_eq!(error.lines().count(), 1);

    for args in [
        &["render", "falling.plush", "-o", "out.png", "--pose", "fall", "--size", "64x32"][..],
        &["render", "falling.plush", "-o", "out.png", "--size", "64x32"],
        &["key", "falling.plush", "--pose", "fall", "--time", "0", "-o", "out.plush"],
    ] {
        let output = plushwright(f, args);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{args:?}: {error}");
        assert!(error.contains("realizable: ") && error.lines().count() == 1, "{error}");
        let written = if args[0] == "key" { "out.plush" } else { "out.png" };
        fs::remove_file(f.join(written)).unwrap();
    }
}

/// A star of three contracted edges: the winch sits in its middle.
const NETWORK: &str = r#"{"format": "plushwright-network/1",
  "nodes": [[0,0],[1,0],[0,1],[-1,0]], "edges": [[0,1],[0,2],[0,3]], "weights": [0.3,0.2,0.1],
  "parameters": {"SEED_NUM": 3, "JOIN_DEPTH": 0, "JOIN_LEN": 1, "TENDON_NUM": TENDONS, "PHI": 1.0}}"#;

#[test]
fn a_network_without_an_answer_is_written_with_code_3() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    fs::write(f.join("two.json"), NETWORK.replace("TENDONS", "2")).unwrap();
    let answer: serde_json::Value = serde_json::from_str(&succeed(f, &["discover", "two.json"])).unwrap();
    assert_eq!(answer["winch"], 0);
    assert_eq!(answer["tendons"].as_array().unwrap().len(), 2);
    fs::write(f.join("four.json"), NETWORK.replace("TENDONS", "4")).unwrap();
    fail(f, 3, &["discover", "four.json", "-o", "answer.json"]);
    let written: serde_json::Value = serde_json::from_slice(&fs::read(f.join("answer.json")).unwrap()).unwrap();
    assert_eq!(written["converged"], false);
}

/// An interrupt during the demo ends it at once, and what was made so far disappears.
#[cfg(unix)]
#[test]
fn an_interrupt_is_code_130_and_leaves_nothing() {
    use std::io::Read;
    let folder = tempfile::tempdir().unwrap();
    let mut demo = Command::new(env!("CARGO_BIN_EXE_plushwright"))
        .args(["demo", "--out", "result"])
        .current_dir(folder.path())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    // The first line is printed once the outline is drawn: from then on there is something to clean up.
    let mut first = [0];
    demo.stdout.as_mut().unwrap().read_exact(&mut first).unwrap();
    // The shell has `kill` built in; a bare machine has no program of that name.
    let kill = format!("kill -INT {}", demo.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
    let output = demo.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "plushwright: cancelled\n");
    assert_eq!(names(folder.path()), Vec::<String>::new());
}

#[test]
fn without_a_display_the_studio_says_so() {
    let folder = bar();
    fail(folder.path(), 4, &["bar.plush"]);
}

#[test]
fn studies_print_tables_and_leave_csv_and_plots() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let text = succeed(here, &["bench", "linear", "--fibers", "177", "--seed", "3", "--out", "linear"]);
    assert!(text.contains("seed 3") && text.contains("supernodal") && text.contains("fastest is"), "{text}");
    assert_eq!(names(&here.join("linear")), ["linear.csv", "linear.svg", "manifest.json", "report.txt"]);
    let csv = fs::read_to_string(here.join("linear/linear.csv")).unwrap();
    assert!(csv.starts_with("shape,fibres,") && csv.lines().count() > 8, "{csv}");

    let drag = ["bench", "drag", "--fibers", "177", "--targets", "1", "--frames", "6", "--baseline", "0", "--json"];
    let [first, second] = [succeed(here, &drag), succeed(here, &drag)].map(|text| {
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        value["tables"]["drag-errors"]["rows"].clone()
    });
    // Times differ from run to run, results do not.
    assert_eq!(first, second);
    assert_eq!(first.as_array().unwrap().len(), 2);
    assert_eq!(first[0]["not showable"], 0);

    let bounds = ["--winches", "1", "--tendons", "1", "--rounds", "0", "--fibers", "100", "--json"];
    let networks = [["bench", "networks", "--shapes", "cactus"].as_slice(), &bounds].concat();
    let value: serde_json::Value = serde_json::from_str(&succeed(here, &networks)).unwrap();
    let rows = value["tables"]["networks"]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    assert!(rows.iter().all(|row| row["error"].as_f64().is_some_and(|error| error < 1.0)), "{rows:?}");
    assert_eq!(rows[3]["rules broken"], 0);

    let line = fail(here, 2, &["bench", "cold", "--shapes", "cow", "--out", "cold"]);
    assert!(line.contains("cow") && line.contains("pig"), "{line}");
    assert_eq!(names(here), ["linear"]);
}

#[test]
fn an_outline_is_drawn_changed_and_put_under_a_finished_design() {
    let folder = bar();
    let here = folder.path();
    succeed(
        here,
        &["pose", "bar.plush", "-o", "bar.plush", "--name", "up", "--target", "110,20=110,60", "--pin", "5,20"],
    );
    assert!(succeed(here, &["drawing", "bar.plush"]).contains("Path(points"));
    succeed(here, &["drawing", "bar.plush", "-o", "bar.ron"]);
    let text = fs::read_to_string(here.join("bar.ron")).unwrap();
    // A head on the left end, which moves the corner of the box by 20 mm and 10 mm.
    let head = "(parts: [(primitive: Circle(center: (10, 20), radius: 30)),";
    fs::write(here.join("bar.ron"), text.replacen("(\n    parts: [", head, 1)).unwrap();
    let said = succeed(here, &["reshape", "bar.plush", "bar.ron", "-o", "head.plush", "--fibers", "150"]);
    assert!(said.contains("fibers 60 -> 15") && said.contains("parts carried over"), "{said}");
    let design = plushwright::design::file::read(&here.join("head.plush")).unwrap();
    let (low, high) = design.outline.bounding_box();
    assert!(low == [0.0; 2] && (high[0] - 140.0).abs() < 0.1 && (high[1] - 60.0).abs() < 0.1, "{high:?}");
    let to = design.poses[0].targets[0].to;
    assert!((to[0] - 130.0).abs() < 0.1 && (to[1] - 70.0).abs() < 0.1, "{to:?}");
    assert_eq!(design.drawing.as_ref().unwrap().parts.len(), 2);
    // The same parts make a design of their own, at another size too.
    let said = succeed(here, &["new", "bar.ron", "-o", "own.plush", "--fibers", "150", "--height", "120"]);
    assert!(said.contains("280.0 mm long") || said.contains("279.9 mm long"), "{said}");
    fs::write(
        here.join("two.ron"),
        "(parts: [(primitive: Circle(center: (0, 0), radius: 30)), (primitive: Circle(center: (99, 0), radius: 30))])",
    )
    .unwrap();
    assert!(fail(here, 2, &["reshape", "bar.plush", "two.ron", "-o", "no.plush"]).contains("2 separate pieces"));
    fs::write(here.join("bad.ron"), "(parts: [(primitive: Circle(center: (0, 0), radius: 0))])").unwrap();
    assert!(fail(here, 2, &["new", "bad.ron", "-o", "no.plush"]).contains("parts[0].radius"));
    assert!(!here.join("no.plush").exists());
}

#[test]
fn a_mesh_is_measured_and_changed() {
    let folder = bar();
    let here = folder.path();
    let text = succeed(here, &["mesh", "bar.plush", "-o", "mesh.png", "--size", "320x160"]);
    assert!(text.contains("smallest angle") && text.contains("mirror images of themselves"), "{text}");
    assert!(fs::read(here.join("mesh.png")).unwrap().starts_with(b"\x89PNG"));
    let figures: serde_json::Value = serde_json::from_str(&succeed(here, &["mesh", "bar.plush", "--json"])).unwrap();
    assert_eq!((&figures["fibers"], &figures["symmetric_mesh"]), (&60.into(), &true.into()));

    let text = succeed(here, &["remesh", "bar.plush", "-o", "fine.plush", "--fibers", "200"]);
    assert!(text.contains("fibers 60 -> 200"), "{text}");
    succeed(here, &["remesh", "bar.plush", "-o", "both.plush", "--fibers", "60", "--finer", "2", "--json"]);
    let figures: serde_json::Value = serde_json::from_str(&succeed(here, &["mesh", "both.plush", "--json"])).unwrap();
    assert_eq!(figures["fibers"], 60);
    assert!(figures["quality"]["edges"].as_u64().unwrap() > 200);
    let track = ["remesh", "bar.plush", "-o", "track.plush", "--edge", "8", "--track", "10,20 110,20"];
    assert!(succeed(here, &track).contains("track.plush"));
    // The track stays with the drawing: it is in its text, and another mesh follows it as well.
    let text = succeed(here, &["drawing", "track.plush"]);
    assert!(text.contains("tracks: [") && text.contains("(110.0"), "{text}");
    succeed(here, &["remesh", "track.plush", "-o", "track.plush", "--fibers", "150"]);
    fs::write(here.join("bar.ron"), text).unwrap();
    succeed(here, &["new", "bar.ron", "-o", "drawn.plush", "--fibers", "150"]);
    for design in ["track.plush", "drawn.plush"] {
        let design = plushwright::design::file::read(&here.join(design)).unwrap();
        assert_eq!(design.tracks(), [[[10.0, 20.0], [110.0, 20.0]]]);
        let along =
            design.mesh.edges().iter().flatten().filter(|&&n| (design.mesh.nodes[n][1] - 20.0).abs() < 1e-9).count();
        assert!(along > 20, "{along} ends of edges on the track");
    }
    succeed(here, &["remesh", "track.plush", "-o", "track.plush", "--fibers", "150", "--no-tracks"]);
    assert!(!succeed(here, &["drawing", "track.plush"]).contains("tracks"));
    fs::write(here.join("bad.ron"), "(parts: [], tracks: [[(0, 0)]])").unwrap();
    assert!(fail(here, 2, &["new", "bad.ron", "-o", "no.plush"]).contains("tracks[0]"));
    assert!(fail(here, 2, &["remesh", "bar.plush", "-o", "no.plush"]).contains("--fibers"));
    assert!(!here.join("no.plush").exists());
}

#[test]
fn networks_are_listed_changed_and_what_is_hard_to_sew_told() {
    let folder = bar();
    let f = folder.path();
    let network = |action: &str, args: &[&str]| {
        succeed(f, &[&["network", action, "bar.plush", "-o", "bar.plush"][..], args].concat())
    };
    let told = network("new", &["--through", "20,20", "--through", "60,30", "--through", "110,20"]);
    assert!(told.starts_with("bar.plush: new winch; 1 winch, 1 tendon\n"), "{told}");
    let told = network("move", &["--winch", "winch 1", "--tendon", "1", "--hole", "1", "--to", "60,38"]);
    assert!(told.contains("hard to sew: winch 1, tendon 1: hole 1 from the winch is 2.0 mm from the seam"), "{told}");
    network("color", &["--winch", "1", "--color", "#0a141e"]);
    network("mute", &["--winch", "1"]);
    let listed: serde_json::Value =
        serde_json::from_str(&succeed(f, &["network", "list", "bar.plush", "--json"])).unwrap();
    assert_eq!(
        (&listed["winches"][0]["muted"], &listed["winches"][0]["color"]),
        (&true.into(), &serde_json::json!([10, 20, 30]))
    );
    let hole: Vec<f64> = serde_json::from_value(listed["winches"][0]["tendons"][0]["places"][1].clone()).unwrap();
    assert!((hole[0] - 60.0).abs() < 1e-9 && (hole[1] - 38.0).abs() < 1e-9, "{hole:?}");
    assert!(
        succeed(f, &["network", "list", "bar.plush"]).contains("1 winch 1 (switched off)\n  tendon 1: 20.000,20.000 ")
    );
    assert!(succeed(f, &["check", "bar.plush"]).contains("switched off: winch 1"));
    for args in [
        &["network", "color", "bar.plush", "--winch", "1", "--color", "red", "-o", "bar.plush"][..],
        &[
            "network",
            "move",
            "bar.plush",
            "--winch",
            "1",
            "--tendon",
            "0",
            "--hole",
            "1",
            "--to",
            "9,9",
            "-o",
            "bar.plush",
        ],
        &[
            "network",
            "move",
            "bar.plush",
            "--winch",
            "1",
            "--tendon",
            "1",
            "--hole",
            "3",
            "--to",
            "9,9",
            "-o",
            "bar.plush",
        ],
        &["network", "hand-over", "bar.plush", "--winch", "1", "--tendon", "1", "--to", "2", "-o", "bar.plush"],
    ] {
        fail(f, 2, args);
    }
}
