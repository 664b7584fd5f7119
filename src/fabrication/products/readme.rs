//! The page that goes with a blueprint: how to use its files, and what to mind with this design.

use crate::fabrication::error::ExportError;
use crate::fabrication::product::{Content, Part, Product, Source};

/// The page `README`, of all parts before it.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let text = text(source);
    Ok(Part { products: vec![Product::new("README", Content::Page(text))], guide: String::new(), remarks: Vec::new() })
}

fn text(source: &Source<'_>) -> String {
    let remarks: Vec<String> = source.remarks.iter().map(|r| format!("  - {r}\n")).collect();
    let mind = if remarks.is_empty() { String::new() } else { format!("Watch out\n{}\n", remarks.concat()) };
    let guides: Vec<String> =
        source.sections.iter().map(|part| format!("{}\n{}", part.files.join(", "), part.guide)).collect();
    let (name, version) = (&source.design.name, env!("CARGO_PKG_VERSION"));
    format!("Blueprint of {name:?}, made by plushwright {version}\n\n{mind}{}", guides.join("\n"))
}
