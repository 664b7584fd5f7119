//! The PNG reader, its tracing and the clean-up: whatever follows the signature. For JPEG, seed with files that begin so.
//!
//! `cargo +nightly fuzz run outline_picture`

#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let file = [if data.starts_with(b"\xff\xd8\xff") { b"".as_slice() } else { b"\x89PNG\r\n\x1a\n".as_slice() }, data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
