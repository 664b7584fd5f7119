//! The OBJ reader: any lines after a vertex.
//!
//! `cargo +nightly fuzz run outline_obj`

#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let file = [b"v 0 0\n".as_slice(), data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
