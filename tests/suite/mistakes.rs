//! What people type wrong in their first hour: each is answered by one line that leads on, and nothing is written.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::OnceLock;

/// A bar that is wide enough for a few dozen fibres.
const OUTLINE: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="40mm" viewBox="0 0 120 40">
<rect width="120" height="40"/></svg>"#;

/// A mistake, and what its answer holds: the way on.
const MISTAKES: [(&str, &[&str], &str); 24] = [
    ("a mistyped command", &["nwe", "bar.svg", "-o", "x.plush"], "did you mean `plushwright new`?"),
    ("a mistyped command alone", &["chekc"], "did you mean `plushwright check`?"),
    ("another word for a command", &["import", "bar.svg"], "did you mean `plushwright new`?"),
    ("a mistyped option", &["new", "bar.svg", "-o", "x.plush", "--fiber", "60"], "did you mean `--fibers`?"),
    (
        "a mistyped value",
        &["key", "bare.plush", "--pose", "up", "--time", "1", "--ease", "smoth"],
        "did you mean `smooth`?",
    ),
    ("no place for the design", &["new", "bar.svg"], "for example `plushwright new "),
    ("a mistyped file", &["new", "barr.svg", "-o", "x.plush"], "did you mean bar.svg?"),
    ("a mistyped design", &["check", "bear.plush"], "did you mean bare.plush?"),
    ("a drawing where a design is wanted", &["check", "bar.svg"], "`plushwright new bar.svg -o bar.plush`"),
    ("a drawing for the window", &["bar.svg"], "`plushwright new bar.svg -o bar.plush`"),
    (
        "a design where a drawing is wanted",
        &["new", "bare.plush", "-o", "x.plush"],
        "`plushwright bare.plush` opens it",
    ),
    ("a question where a design is wanted", &["check", "question.json"], "`plushwright solve question.json`"),
    ("a design where a question is wanted", &["solve", "bare.plush"], "`plushwright check bare.plush`"),
    ("the command behind the design", &["bare.plush", "check"], "`plushwright check bare.plush`"),
    ("the drawing as output", &["new", "bar.svg", "-o", "bar.svg"], "choose another name"),
    ("the design as output", &["render", "bare.plush", "-o", "bare.plush"], "choose another name"),
    ("a picture of another kind", &["render", "bare.plush", "-o", "bar.bmp"], "call it bar.png, *.jpg"),
    (
        "a pose without targets",
        &["pose", "bare.plush", "--name", "up"],
        "--target X,Y=X2,Y2, from a point of the body (X 0 to 120, Y 0 to 40 mm)",
    ),
    ("a target beside the body", &["pose", "bare.plush", "--name", "up", "--target", "500,20=1,1"], "nearest"),
    ("winches before poses", &["rig", "bare.plush"], "`plushwright pose bare.plush"),
    ("a blueprint before winches", &["export", "bare.plush", "-o", "x"], "run `plushwright rig` first"),
    ("more tendons than there can be", &["rig", "posed.plush", "--tendons", "40"], "from 1 to 16"),
    ("a mistyped pose", &["render", "posed.plush", "-o", "x.png", "--pose", "upp"], "did you mean `up`?"),
    ("a time beyond the timeline", &["render", "keyed.plush", "-o", "x.png", "--time", "99"], "from 0 to 2 s"),
];

/// A folder with a drawing, a bare design, one with a pose, one with a timeline, and a question in numbers.
fn first_hour() -> &'static Path {
    static PLACE: OnceLock<tempfile::TempDir> = OnceLock::new();
    let place = PLACE.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let f = folder.path();
        fs::write(f.join("bar.svg"), OUTLINE).unwrap();
        fs::write(f.join("question.json"), r#"{"format": "plushwright-problem/1"}"#).unwrap();
        succeed(f, &["new", "bar.svg", "-o", "bare.plush", "--fibres", "60"]);
        let up = ["--name", "up", "--pin", "5,5", "--pin", "5,35", "--target", "110,20=105,45"];
        succeed(f, &[&["pose", "bare.plush", "-o", "posed.plush"][..], &up].concat());
        let through = ["--through", "10,30", "--through", "60,33", "--through", "110,30"];
        succeed(f, &[&["network", "new", "posed.plush", "-o", "keyed.plush"][..], &through].concat());
        succeed(f, &["key", "keyed.plush", "--pose", "up", "--time", "2"]);
        folder
    });
    place.path()
}

fn run(folder: &Path, args: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_plushwright"));
    program.args(args).current_dir(folder).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap()
}

#[track_caller]
fn succeed(folder: &Path, args: &[&str]) -> String {
    let output = run(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Names and contents of all files.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    let mut files: Vec<_> = files
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(&path).unwrap()))
        .collect();
    files.sort();
    files
}

#[test]
fn every_mistake_of_a_first_hour_is_answered_by_one_line_that_leads_on() {
    let f = first_hour();
    let before = contents(f);
    let mut wrong = Vec::new();
    for (mistake, args, way) in MISTAKES {
        let output = run(f, args);
        let line = String::from_utf8(output.stderr).unwrap();
        if output.status.code() != Some(2) || line.lines().count() != 1 || !line.contains(way) {
            wrong.push(format!("{mistake}, {args:?}: {:?} {line}", output.status.code()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(contents(f) == before, "something was written");
}

#[test]
fn commands_that_change_a_design_write_it_back_where_no_other_place_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    fs::copy(first_hour().join("keyed.plush"), f.join("a.plush")).unwrap();
    let mut last = fs::read(f.join("a.plush")).unwrap();
    for args in [
        &["pose", "a.plush", "--name", "down", "--target", "110,20=105,10"][..],
        &["key", "a.plush", "--pose", "down", "--time", "4"],
        &["remesh", "a.plush", "--fibres", "90"],
        &["network", "colour", "a.plush", "--winch", "1", "--colour", "a01020"],
        &["rig", "a.plush", "--fresh", "--max-winches", "1", "--rounds", "1"],
    ] {
        succeed(f, args);
        let now = fs::read(f.join("a.plush")).unwrap();
        assert!(now != last, "{args:?}");
        last = now;
    }
    assert_eq!(contents(f).len(), 1);
}

#[test]
fn what_is_printed_for_programs_says_its_format() {
    let f = first_hour();
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("x.plush");
    let (to, picture) = (to.to_str().unwrap(), folder.path().join("x.jpg"));
    for (args, format) in [
        (&["new", "bar.svg", "-o", to, "--fibers", "60"][..], "plushwright-new/1"),
        (&["mesh", "bare.plush"], "plushwright-mesh/1"),
        (&["remesh", "keyed.plush", "-o", to, "--fibers", "80", "--force"], "plushwright-remesh/1"),
        (&["reshape", "keyed.plush", "bar.svg", "-o", to, "--force"], "plushwright-reshape/1"),
        (&["pose", "keyed.plush", "--name", "up", "--pin", "5,20", "-o", to, "--force"], "plushwright-pose/1"),
        (&["key", "keyed.plush", "--pose", "up", "--time", "3", "-o", to, "--force"], "plushwright-key/1"),
        (&["network", "list", "keyed.plush"], "plushwright-networks/1"),
        (&["network", "mute", "keyed.plush", "--winch", "1", "-o", to, "--force"], "plushwright-network-change/1"),
        (&["propose", "keyed.plush", "--pose", "up", "--tendons", "1"], "plushwright-propose/1"),
        (&["rig", "keyed.plush", "--max-winches", "1", "--rounds", "1", "-o", to, "--force"], "plushwright-rig/1"),
        (&["check", "keyed.plush"], "plushwright-check/1"),
        (&["render", "keyed.plush", "--pose", "up", "-o", picture.to_str().unwrap()], "plushwright-render/1"),
    ] {
        let text = succeed(f, &[args, &["--json"]].concat());
        let record: serde_json::Value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{args:?}: {e}: {text}"));
        assert_eq!(record["format"], format, "{text}");
    }
    // The picture's format follows its name, and it may be written again.
    assert!(fs::read(&picture).unwrap().starts_with(b"\xff\xd8\xff\xe0"));
    assert!(image::open(&picture).is_ok_and(|picture| picture.width() == 1280));
    succeed(f, &["render", "keyed.plush", "-o", picture.to_str().unwrap(), "--size", "64x32"]);
}

#[test]
fn help_and_version_are_commands_and_options() {
    let f = Path::new(".");
    assert_eq!(succeed(f, &["help", "rig"]), succeed(f, &["rig", "--help"]));
    assert!(succeed(f, &["help"]).contains("\n  completions "));
    assert_eq!(succeed(f, &["-v"]), succeed(f, &["--version"]));
    assert!(succeed(f, &["completions", "bash"]).contains("--fibers"));
    let page = succeed(f, &["man", "rig"]);
    assert!(page.contains(".TH plushwright-rig") && page.contains("max\\-winches"), "{page}");
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), &["man", "--out", "man"]);
    assert!(folder.path().join("man/plushwright-network-move.1").is_file());
    assert!(folder.path().join("man/plushwright.1").is_file());
}

#[test]
fn a_log_is_written_where_it_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log.txt");
    let output = run(first_hour(), &["check", "none.plush", "--log", log.to_str().unwrap(), "-v"]);
    assert_eq!(output.status.code(), Some(2));
    let text = fs::read_to_string(log).unwrap();
    assert!(
        text.contains("plushwright ") && text.contains("check none.plush") && text.contains("exit code 2"),
        "{text}"
    );
    assert!(String::from_utf8(output.stderr).unwrap().lines().count() > 1);
}

/// What reads no further has what it wanted, and the work is done to its end.
#[cfg(unix)]
#[test]
fn a_reader_that_ends_early_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("x.plush");
    for args in [
        &["--help"][..],
        &["man"],
        &["completions", "zsh"],
        &["check", "keyed.plush"],
        &["rig", "posed.plush", "--max-winches", "1", "--rounds", "1", "-o", to.to_str().unwrap()],
    ] {
        let mut program = Command::new(env!("CARGO_BIN_EXE_plushwright"));
        program.args(args).current_dir(first_hour()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = program.spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert!(
            output.status.success() && output.stderr.is_empty(),
            "{args:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
    assert!(to.is_file());
}
