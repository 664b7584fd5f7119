//! The DXF reader and the clean-up: any entities.
//!
//! `cargo +nightly fuzz run outline_dxf`

#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let file = [b"0\nSECTION\n2\nENTITIES\n0\n".as_slice(), data].concat();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
