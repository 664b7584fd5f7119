//! A problem that is not refused is answered: within its time, and without a figure that is not finite.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::problem::{Options, read, solve};
use serde_json::Value;
use std::time::Duration;

/// Nodes and elements up to which an answer takes milliseconds.
const SMALL: usize = 60;

fn is_sound(value: &Value) -> bool {
    match value {
        Value::Null => false,
        Value::Array(items) => items.iter().all(is_sound),
        Value::Object(map) => map.values().all(is_sound),
        _ => true,
    }
}

fuzz_target!(|text: &str| {
    let Ok((problem, _)) = read(text) else { return };
    if problem.mesh.nodes.len().max(problem.elements.len()) > SMALL {
        return;
    }
    let options = Options { budget: Duration::from_millis(200), all: true, ..Options::default() };
    if let Ok(answered) = solve(&problem, &options) {
        assert!(is_sound(&answered.document));
        assert_eq!(answered.converged, answered.failures.is_empty());
    }
});
