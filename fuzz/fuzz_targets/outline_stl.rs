//! The STL reader: a text, or any triangles, their number put right.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};

/// Bytes before the triangles, and of each.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

fuzz_target!(|data: &[u8]| {
    let file = if data.starts_with(b"solid") {
        data.to_vec()
    } else {
        let triangles = data.get(HEADER..).unwrap_or(data);
        let count = triangles.len() / TRIANGLE;
        [&[b' '; HEADER - 4][..], &(count as u32).to_le_bytes(), &triangles[..TRIANGLE * count]].concat()
    };
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
