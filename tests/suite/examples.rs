//! The programs in `examples/`, but for their command lines.
#![allow(dead_code)]

#[path = "../../examples/drag.rs"]
mod drag;
#[path = "../../examples/icons.rs"]
mod icons;
#[path = "../../examples/outline_to_blueprint.rs"]
mod outline_to_blueprint;
#[path = "../../examples/problem_file.rs"]
mod problem_file;

#[test]
fn a_drag_runs_frame_by_frame() {
    drag::run().expect("it runs");
}

#[test]
fn an_outline_becomes_a_blueprint() {
    let folder = tempfile::tempdir().expect("a folder");
    outline_to_blueprint::run(&folder.path().join("blueprint")).expect("it runs");
    assert!(folder.path().join("blueprint/pattern.svg").is_file());
}

#[test]
fn a_problem_is_answered() {
    let answer = problem_file::run(problem_file::HANGING).expect("it runs");
    assert!(answer.contains("\"converged\": true"));
}

/// `cargo run --example icons -- assets/icon` after a drawing of an icon has changed.
#[test]
fn the_icons_are_those_of_their_drawings() {
    let folder = tempfile::tempdir().expect("a folder");
    icons::run(folder.path()).expect("it runs");
    let kept = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/icon");
    let pixels = |path: std::path::PathBuf| image::open(path).expect("a picture").to_rgba8();
    for size in std::fs::read_dir(folder.path()).expect("sizes") {
        let size = size.expect("a size").file_name();
        for name in ["plushwright.png", "application-x-plushwright.png"] {
            let at = |root: &std::path::Path| pixels(root.join(&size).join(name));
            assert!(at(folder.path()) == at(&kept), "{size:?} {name}");
        }
    }
}
