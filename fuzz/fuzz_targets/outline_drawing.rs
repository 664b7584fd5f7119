//! The reader of drawings: any parts, and what comes of their outline.
//!
//! `cargo +nightly fuzz run outline_drawing`

#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let file = [b"(parts: [".as_slice(), data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
