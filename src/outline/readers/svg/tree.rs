//! The elements of an SVG file, everything resolved.

use super::size::{self, Size};
use super::{expansion, layers, style};
use crate::outline::readers::{encoding, foreign, picture};
use crate::outline::{Import, Note, OutlineError};
use std::sync::{Arc, LazyLock};
use usvg::roxmltree::Document;
use usvg::{ImageHrefResolver, Tree};

/// A drawing as it was read.
pub(super) struct Parsed {
    pub tree: Tree,
    pub size: Size,
    /// What is not followed.
    pub notes: Vec<Note>,
}

/// The drawing with everything resolved, or the chosen layers of it.
pub(super) fn parsed(svg: &[u8], import: &Import) -> Result<Parsed, OutlineError> {
    let text = encoding::xml(svg).map_err(unreadable)?;
    if foreign::is_page(&text) {
        return Err(foreign::of_root("html").unwrap_or(OutlineError::UnknownFormat));
    }
    let document = document(&text)?;
    is_drawing(&document)?;
    expansion::check(&document)?;
    let flowed = document.descendants().filter(|node| node.tag_name().name() == "flowRoot").count();
    let mut notes = Vec::new();
    if flowed > 0 {
        notes.push(Note::FlowedText(flowed));
    }
    let styled = style::written(&document, &options(), &mut notes)?;
    let document = styled.as_deref().map_or(Ok(document), self::document)?;
    if styled.is_some() {
        expansion::check(&document)?;
    }
    let chosen = if import.layers.is_empty() { None } else { Some(layers::chosen(&document, &import.layers)?) };
    let document = chosen.as_deref().map_or(Ok(document), self::document)?;
    let tree = Tree::from_xmltree(&document, &options()).map_err(|error| unreadable(error.to_string()))?;
    let size = size::of(&document, &tree, import.unit_mm);
    Ok(Parsed { tree, size, notes })
}

fn document(text: &str) -> Result<Document<'_>, OutlineError> {
    expansion::parse(text).map_err(|error| unreadable(error.to_string()))
}

/// Refuses XML that is something else.
fn is_drawing(document: &Document) -> Result<(), OutlineError> {
    let name = document.root_element().tag_name().name();
    if name == "svg" {
        return Ok(());
    }
    let name: String = name.chars().take(24).collect();
    Err(foreign::of_root(&name)
        .unwrap_or_else(|| unreadable(format!("it is XML of another kind, its root is <{name}>"))))
}

fn unreadable(reason: String) -> OutlineError {
    OutlineError::Unreadable { format: "SVG", reason }
}

/// The bundled fonts: text is set in the first one, whatever the drawing asks for, so that it looks the same everywhere.
static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.load_font_data(epaint_default_fonts::HACK_REGULAR.to_vec());
    Arc::new(fonts)
});

/// The fonts that text in drawings is set in.
pub fn fonts() -> Arc<usvg::fontdb::Database> {
    FONTS.clone()
}

/// The default options, with references to files outside the SVG cut off, which a silhouette
/// does not need, and embedded drawings and pictures read within the same bounds.
fn options() -> usvg::Options<'static> {
    let mut options = usvg::Options { fontdb: FONTS.clone(), ..usvg::Options::default() };
    options.image_href_resolver.resolve_string = Box::new(|_, _| None);
    let embedded = ImageHrefResolver::default_data_resolver();
    options.image_href_resolver.resolve_data = Box::new(move |mime, data, options| {
        let drawing = ["image/svg+xml", "text/plain"].contains(&mime);
        let fits = if drawing { expansion::fits(&data) } else { picture::fits(&data) };
        if fits { embedded(mime, data, options) } else { None }
    });
    options.font_resolver.select_font = Box::new(|_, fonts| fonts.faces().next().map(|face| face.id));
    options
}
