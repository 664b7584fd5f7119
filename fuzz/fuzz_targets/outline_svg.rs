//! The SVG reader and the clean-up: a file in any encoding, packed or not, or whatever follows an opening bracket.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let is_whole =
        [&b"<"[..], b"\xff\xfe", b"\xfe\xff", b"\xef\xbb\xbf", b"\x1f\x8b"].iter().any(|start| data.starts_with(start));
    let file = [if is_whole { &b""[..] } else { b"<" }, data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
