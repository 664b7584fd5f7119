//! The chosen layers of a drawing.
//!
//! A layer is anything that is painted and has a name: the `id` or the `inkscape:label` of a group or a single element, at
//! any depth. What is in no chosen layer is wrapped into `<defs>`: there nothing is painted, but clips, masks, gradients and
//! elements that a chosen layer refers to are still found, and what a layer inherits from the groups around it (transforms,
//! styles, clips, opacity) stays as it was. The text is changed and not the tree that `usvg` makes of it, since that has
//! neither labels nor all of the groups.

use crate::outline::OutlineError;
use crate::outline::readers::layers;
use std::collections::BTreeSet;
use usvg::roxmltree::{Document, Node};

const SVG: &str = "http://www.w3.org/2000/svg";
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
/// What is painted where it stands, and may hold more of it.
const GROUPS: [&str; 4] = ["svg", "g", "a", "switch"];
/// What is painted where it stands.
const SHAPES: [&str; 11] =
    ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "text", "image", "use", "foreignObject"];
/// What decides which child of a `switch` is painted.
const CONDITIONS: [&str; 3] = ["requiredFeatures", "requiredExtensions", "systemLanguage"];

/// The text of a drawing in which the layers with these names alone are painted.
///
/// # Errors
/// A name that no layer has; layers that are written in entities of the file, which share their text.
pub(super) fn chosen(document: &Document, names: &[String]) -> Result<String, OutlineError> {
    let root = document.root_element();
    let mut all = Vec::new();
    let mut stack = vec![root];
    while let Some(node) = stack.pop() {
        all.push(node);
        stack.extend(painted_children(node).rev());
    }
    let there: BTreeSet<&str> = all.iter().flat_map(|node| names_of(*node)).collect();
    layers::check(names, |name| there.contains(name), listed(&all).into_iter())?;
    let is_chosen = |node: Node| names_of(node).any(|name| names.iter().any(|asked| asked == name));
    // The groups around chosen layers stay open; the walk up ends where another one has come by.
    let mut open: BTreeSet<u32> = BTreeSet::new();
    for node in all.iter().filter(|node| is_chosen(**node)) {
        for around in node.ancestors().skip(1) {
            if !open.insert(around.id().get()) {
                break;
            }
        }
    }
    let text = document.input_text();
    let mut kept = String::with_capacity(text.len() + text.len() / 4);
    let mut copied = 0;
    let mut stack = vec![root];
    while let Some(node) = stack.pop() {
        if is_chosen(node) {
            continue;
        }
        let range = node.range();
        if open.contains(&node.id().get()) {
            for child in painted_children(node).rev() {
                if child.range().start < range.start || child.range().end > range.end {
                    let reason = "its layers stand in entities, from which none can be chosen".into();
                    return Err(OutlineError::Unreadable { format: "SVG", reason });
                }
                stack.push(child);
            }
            continue;
        }
        kept += &text[copied..range.start];
        kept += &format!("<defs xmlns='{SVG}'");
        for attribute in node.attributes().filter(|a| CONDITIONS.contains(&a.name())) {
            kept.push(' ');
            kept += &text[attribute.range()];
        }
        kept.push('>');
        kept += &text[range.clone()];
        kept += "</defs>";
        copied = range.end;
    }
    kept += &text[copied..];
    Ok(kept)
}

fn painted_children<'a, 'i>(node: Node<'a, 'i>) -> impl DoubleEndedIterator<Item = Node<'a, 'i>> {
    let children = is_one_of(node, &GROUPS).then(|| node.children());
    children.into_iter().flatten().filter(|child| is_one_of(*child, &GROUPS) || is_one_of(*child, &SHAPES))
}

fn is_one_of(node: Node, names: &[&str]) -> bool {
    let tag = node.tag_name();
    node.is_element() && matches!(tag.namespace(), None | Some(SVG)) && names.contains(&tag.name())
}

fn label<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    node.attribute((INKSCAPE, "label"))
}

fn names_of<'a>(node: Node<'a, '_>) -> impl Iterator<Item = &'a str> {
    [node.attribute("id"), label(node)].into_iter().flatten()
}

/// The names worth telling: those of Inkscape's layers; without any, those of the groups, or else of all elements.
fn listed<'a>(all: &[Node<'a, '_>]) -> Vec<&'a str> {
    let within = all.get(1..).unwrap_or_default();
    let named = |is_layer: &dyn Fn(Node) -> bool| -> Vec<&'a str> {
        within
            .iter()
            .filter(|node| is_layer(**node))
            .filter_map(|node| label(*node).or_else(|| node.attribute("id")))
            .collect()
    };
    let is_layer = |node: Node| node.attribute((INKSCAPE, "groupmode")) == Some("layer");
    [named(&is_layer), named(&|node| is_one_of(node, &GROUPS)), named(&|_| true)]
        .into_iter()
        .find(|names| !names.is_empty())
        .unwrap_or_default()
}
