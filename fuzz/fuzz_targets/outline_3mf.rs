//! The 3MF reader: a package, or any text as the model of one.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::outline::{Import, Pieces, import};
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;

const ZIP: &[u8] = b"PK\x03\x04";

fn package(model: &[u8]) -> Vec<u8> {
    let mut package = zip::ZipWriter::new(Cursor::new(Vec::new()));
    package.start_file("3D/3dmodel.model", SimpleFileOptions::default()).unwrap();
    package.write_all(model).unwrap();
    package.finish().unwrap().into_inner()
}

fuzz_target!(|data: &[u8]| {
    let file = if data.starts_with(ZIP) { data.to_vec() } else { package(data) };
    let _ = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() });
});
