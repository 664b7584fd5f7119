//! The 3MF reader: any text as the model of a package.
//!
//! `cargo +nightly fuzz run outline_3mf`

#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;

fuzz_target!(|data: &[u8]| {
    let mut package = zip::ZipWriter::new(Cursor::new(Vec::new()));
    package.start_file("3D/3dmodel.model", SimpleFileOptions::default()).unwrap();
    package.write_all(data).unwrap();
    let file = package.finish().unwrap().into_inner();
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
    // And as it is.
    let _ = import(&[b"PK\x03\x04", data].concat(), &Import::default());
});
