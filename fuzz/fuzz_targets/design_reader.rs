//! A design file is read or refused; what was read is valid, compiles, and comes back from its own text bit for bit.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::design::file::{parse, to_text};
use plushwright::engine::compile::{View, compile};

fuzz_target!(|text: &str| {
    let Ok(design) = parse(text) else { return };
    let written = to_text(&design).expect("a design can be written");
    let again = parse(&written).expect("what was written can be read");
    assert_eq!(to_text(&again).expect("a design can be written"), written);
    for view in [View::Realizable, View::Idealized] {
        let _ = compile(&design, view);
    }
});
