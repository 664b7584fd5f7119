//! The SVG reader and the clean-up: whatever follows an opening bracket.
//!
//! `cargo +nightly fuzz run outline_svg`

#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let file = [b"<".as_slice(), data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
