//! The reader of drawings: any parts, and what comes of their outline.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let is_whole = data.starts_with(b"(");
    let file = [if is_whole { &b""[..] } else { b"(parts: [" }, data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
