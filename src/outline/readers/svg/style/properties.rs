//! Properties that are attributes elsewhere.

use std::collections::BTreeMap;
use usvg::roxmltree::Node;

/// Properties that move an element.
pub(super) const TRANSFORMS: [&str; 3] = ["transform", "transform-origin", "transform-box"];

/// What an element is given by styles, by the order of their weight.
pub(super) type Styles<'a, 'i> = Vec<(Node<'a, 'i>, BTreeMap<String, String>)>;

/// The properties that give an element its form, which are its attributes elsewhere.
pub(super) fn geometry(node: Node) -> &'static [&'static str] {
    match node.tag_name().name() {
        "circle" => &["cx", "cy", "r"],
        "ellipse" => &["cx", "cy", "rx", "ry"],
        "rect" => &["x", "y", "width", "height", "rx", "ry"],
        "image" | "use" => &["x", "y", "width", "height"],
        "path" => &["d"],
        _ => &[],
    }
}
