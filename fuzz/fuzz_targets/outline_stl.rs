//! The STL reader: any triangles.
//!
//! `cargo +nightly fuzz run outline_stl`

#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

fuzz_target!(|data: &[u8]| {
    let file = {
        let count = (data.len() / 50) as u32;
        let whole = &data[..50 * count as usize];
        [&[b' '; 80][..], &count.to_le_bytes(), whole].concat()
    };
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
