//! The OBJ reader: a file, or any lines after a vertex.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let is_whole = [&b"#"[..], b"o ", b"v "].iter().any(|start| data.starts_with(start));
    let file = [if is_whole { &b""[..] } else { b"v 0 0\n" }, data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
