//! The PDF reader: a file, or whatever follows its first line.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(
    // The reader of the outline catches what the library panics at, and refuses the file; a panic that gets through still ends the run.
    init: std::panic::set_hook(Box::new(|_| ())),
    |data: &[u8]| {
    let is_whole = data.starts_with(b"%PDF-");
    let file = [if is_whole { &b""[..] } else { b"%PDF-1.7\n" }, data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
