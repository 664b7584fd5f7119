//! The reader of binary DXF: whatever follows the sentinel.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

fuzz_target!(|data: &[u8]| {
    let is_whole = data.starts_with(SENTINEL);
    let file = [if is_whole { &b""[..] } else { SENTINEL }, data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
