//! The programs in `examples/`, but for their command lines.
#![allow(dead_code)]

#[path = "../../examples/drag.rs"]
mod drag;
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
