//! The elements of an SVG file, everything resolved.

use super::{expansion, layers};
use crate::outline::OutlineError;
use std::sync::{Arc, LazyLock};
use usvg::{ImageHrefResolver, Tree};

/// The drawing with everything resolved, or the chosen layers of it.
pub(super) fn tree(svg: &[u8], layers: &[String]) -> Result<Tree, OutlineError> {
    let unreadable = |reason: String| OutlineError::Unreadable { format: "SVG", reason };
    let text = std::str::from_utf8(svg).map_err(|error| unreadable(error.to_string()))?;
    let document = expansion::parse(text).map_err(|error| unreadable(error.to_string()))?;
    expansion::check(&document)?;
    let chosen;
    let document = if layers.is_empty() {
        document
    } else {
        chosen = layers::chosen(&document, layers)?;
        drop(document);
        expansion::parse(&chosen).map_err(|error| unreadable(error.to_string()))?
    };
    Tree::from_xmltree(&document, &options()).map_err(|error| unreadable(error.to_string()))
}

/// The bundled fonts: text is set in the first one, whatever the drawing asks for, so that it looks the same everywhere.
static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    fonts.load_font_data(epaint_default_fonts::HACK_REGULAR.to_vec());
    Arc::new(fonts)
});

/// The default options, with references to files outside the SVG cut off, which a silhouette
/// does not need, and embedded drawings read within the same bounds.
fn options() -> usvg::Options<'static> {
    let mut options = usvg::Options { fontdb: FONTS.clone(), ..usvg::Options::default() };
    options.image_href_resolver.resolve_string = Box::new(|_, _| None);
    let embedded = ImageHrefResolver::default_data_resolver();
    options.image_href_resolver.resolve_data = Box::new(move |mime, data, options| {
        let drawing = ["image/svg+xml", "text/plain"].contains(&mime);
        if drawing && !expansion::fits(&data) { None } else { embedded(mime, data, options) }
    });
    options.font_resolver.select_font = Box::new(|_, fonts| fonts.faces().next().map(|face| face.id));
    options
}
