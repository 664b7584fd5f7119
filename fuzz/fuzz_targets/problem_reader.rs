//! A problem file is read or refused; what was read is written and read again as the same problem.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::problem::read;

fuzz_target!(|text: &str| {
    let Ok((problem, _)) = read(text) else { return };
    let written = problem.to_text().expect("what was read can be written");
    let (again, _) = read(&written).expect("what was written can be read");
    assert_eq!(again.to_text().expect("what was read can be written"), written);
});
