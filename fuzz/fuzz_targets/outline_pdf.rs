//! The PDF reader: any bytes as a PDF.
//!
//! `cargo +nightly fuzz run outline_pdf`

#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let file = [b"%PDF-1.7\n".as_slice(), data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
