//! The DXF reader and the clean-up: sections, or any entities.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let is_whole = data.starts_with(b"0\nSECTION");
    let file = [if is_whole { &b""[..] } else { b"0\nSECTION\n2\nENTITIES\n0\n" }, data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
