//! The writers: how products become files. One file each, one line each in [`WRITERS`].

mod csv;
mod stl;
mod svg;
mod text;

use super::product::{Content, Product};

/// A file format.
#[derive(Clone, Copy, Debug)]
pub struct Writer {
    /// Of its files.
    pub extension: &'static str,
    /// The bytes of a product; `None` for a kind that the format does not know.
    pub write: fn(&Content) -> Option<Vec<u8>>,
}

/// All formats. A product is written in each that knows its kind.
pub const WRITERS: &[Writer] = &[
    Writer { extension: "svg", write: svg::write },
    Writer { extension: "csv", write: csv::write },
    Writer { extension: "txt", write: text::write },
    Writer { extension: "stl", write: stl::write },
];

/// The files of a product: name and bytes.
pub fn written(product: &Product) -> impl Iterator<Item = (String, Vec<u8>)> {
    let file = |writer: &Writer| {
        let extension = product.content.extension().unwrap_or(writer.extension);
        Some((format!("{}.{extension}", product.name), (writer.write)(&product.content)?))
    };
    WRITERS.iter().filter_map(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::{Sheet, Solid, Table};
    use crate::motion::{Framing, Program};

    #[test]
    fn every_kind_is_written_and_no_two_files_have_one_name() {
        let kinds = [
            Content::Sheet(Sheet::default()),
            Content::Solid(Solid::default()),
            Content::Table(Table::default()),
            Content::Program { program: Program::new(Framing::Sdo), extension: "bin" },
            Content::Text { text: String::new(), extension: "ino" },
            Content::Page(String::new()),
        ];
        for content in kinds {
            let names: Vec<String> = written(&Product::new("x", content.clone())).map(|(name, _)| name).collect();
            let mut once = names.clone();
            once.dedup();
            assert!(!names.is_empty() && once == names, "{content:?}: {names:?}");
        }
    }
}
