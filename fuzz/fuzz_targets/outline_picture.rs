//! The readers of pictures, tracing and clean-up: a file of any format, or whatever follows the signature of a PNG.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

const STARTS: [&[u8]; 7] = [b"\x89PNG", b"\xff\xd8\xff", b"GIF8", b"BM", b"II*\0", b"MM\0*", b"RIFF"];

fuzz_target!(|data: &[u8]| {
    let is_whole = STARTS.iter().any(|start| data.starts_with(start));
    let file = [if is_whole { &b""[..] } else { b"\x89PNG\r\n\x1a\n" }, data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
