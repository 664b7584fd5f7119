//! Style sheets as browsers apply them, written into the elements where `usvg` does not follow them itself.
//!
//! `usvg` knows plain selectors and the older properties. Where a sheet has others (`:not()`, `@media`, siblings), or where styles move or
//! size elements (`transform`, `cx`, `width`, `d`), the whole cascade is done here: the text of the file is changed so that each element has
//! what it would have in a browser in its own `style`, `transform` and attributes, and the sheets are gone.

mod cascade;
mod properties;
mod selector;
mod sheet;
mod transform;

use crate::outline::{Note, OutlineError};
use cascade::Cascade;
use properties::{Styles, TRANSFORMS, geometry};
use std::collections::BTreeMap;
use transform::Reference;
use usvg::Tree;
use usvg::roxmltree::{Document, Node};

/// Letters of what is not followed that a note shows.
const SHOWN: usize = 40;
/// The name of elements whose box is asked for; what follows is a number.
const ASKED: &str = "plushwright-box-";

/// The text of a drawing with its styles in its elements; `None` where `usvg` reads them as well.
///
/// # Errors
/// Styles that would take too long.
pub(super) fn written(
    document: &Document,
    options: &usvg::Options,
    notes: &mut Vec<Note>,
) -> Result<Option<String>, OutlineError> {
    let cascade = Cascade::of(document);
    if !cascade.is_needed(document) {
        return Ok(None);
    }
    if document.descendants().any(|node| node.is_element() && !is_in_place(node)) {
        notes.push(Note::Styles("it stands in entities of the file".to_owned()));
        return Ok(None);
    }
    let mut writer = Writer { document, edits: Vec::new(), untold: cascade.unknown.clone() };
    let styles = cascade.resolved(document)?;
    let boxes = writer.boxes(&styles, options);
    writer.write(&styles, &boxes);
    for what in writer.untold.iter().take(3) {
        let what: String = what.chars().map(|c| if c.is_control() { ' ' } else { c }).take(SHOWN).collect();
        notes.push(Note::Styles(what));
    }
    let text = writer.text();
    Ok(Some(text))
}

/// Whether an element stands in the text where its parent does.
fn is_in_place(node: Node) -> bool {
    node.parent_element().is_none_or(|parent| {
        let (outer, inner) = (parent.range(), node.range());
        outer.start <= inner.start && inner.end <= outer.end
    })
}

/// Changes of a drawing's text.
struct Writer<'a, 'i> {
    document: &'a Document<'i>,
    /// Ranges of the text and what comes in their place.
    edits: Vec<(std::ops::Range<usize>, String)>,
    /// What could not be followed.
    untold: Vec<String>,
}

impl Writer<'_, '_> {
    /// The boxes of elements that are moved about their own.
    fn boxes(&self, styles: &Styles, options: &usvg::Options) -> BTreeMap<u32, Reference> {
        let asks = |style: &BTreeMap<String, String>| {
            style.contains_key("transform")
                && style.get("transform-box").is_some_and(|kind| ["fill-box", "content-box"].contains(&kind.as_str()))
        };
        let asked: Vec<Node> = styles.iter().filter(|(_, style)| asks(style)).map(|(node, _)| *node).collect();
        if asked.is_empty() {
            return BTreeMap::new();
        }
        // Drawn once with all geometry but those transforms, and with names.
        let mut drawn = Writer { document: self.document, edits: Vec::new(), untold: Vec::new() };
        for (node, style) in styles {
            let mut style = style.clone();
            TRANSFORMS.iter().for_each(|name| drop(style.remove(*name)));
            drawn.element(*node, &style, None);
            if let Some(k) = asked.iter().position(|other| other.id() == node.id()) {
                drawn.set(*node, "id", &format!("{ASKED}{k}"));
            }
        }
        let text = drawn.text();
        let Ok(document) = super::expansion::parse(&text) else { return BTreeMap::new() };
        let Ok(tree) = Tree::from_xmltree(&document, options) else { return BTreeMap::new() };
        let of = |(k, node): (usize, &Node)| {
            let found = tree.node_by_id(&format!("{ASKED}{k}"))?.bounding_box();
            let [x, y, width, height] = [found.x(), found.y(), found.width(), found.height()].map(f64::from);
            Some((node.id().get(), Reference { x, y, width, height }))
        };
        asked.iter().enumerate().filter_map(of).collect()
    }

    fn write(&mut self, styles: &Styles, boxes: &BTreeMap<u32, Reference>) {
        let view = view_of(self.document.root_element());
        for (node, style) in styles {
            let reference = boxes.get(&node.id().get()).copied().unwrap_or(view);
            self.element(*node, style, Some(&reference));
        }
        for sheet in self.document.descendants().filter(|node| node.tag_name().name() == "style") {
            for text in sheet.children().filter(Node::is_text) {
                self.edits.push((text.range(), String::new()));
            }
        }
    }

    /// Writes the style of one element, with its transform where there is a box to refer to.
    fn element(&mut self, node: Node, style: &BTreeMap<String, String>, reference: Option<&Reference>) {
        let mut style = style.clone();
        if let Some((transform, reference)) = style.remove("transform").zip(reference) {
            let origin = style.remove("transform-origin");
            style.remove("transform-box");
            match transform::matrix(&transform, origin.as_deref(), reference) {
                Some(map) => {
                    let map = map.map(|v| v.to_string()).join(" ");
                    self.set(node, "transform", &format!("matrix({map})"));
                }
                None => self.untold.push(format!("transform: {transform}")),
            }
        }
        for name in geometry(node) {
            let Some(value) = style.remove(*name) else { continue };
            let value = match *name {
                "d" => value
                    .trim()
                    .strip_prefix("path(")
                    .and_then(|rest| rest.trim_end().strip_suffix(')'))
                    .map(|path| path.trim().trim_matches(['"', '\'']).to_owned()),
                _ if value == "auto" => continue,
                _ => Some(value.clone()),
            };
            match value {
                Some(value) => self.set(node, name, &value),
                None => self.untold.push((*name).to_owned()),
            }
        }
        let text: String = style.iter().map(|(name, value)| format!("{name}:{value};")).collect();
        if node.attribute("style").unwrap_or_default() != text {
            self.set(node, "style", &text);
        }
    }

    /// Gives an element an attribute, in place of the one it has.
    fn set(&mut self, node: Node, name: &str, value: &str) {
        let written = format!("{name}=\"{}\"", escaped(value));
        if let Some(attribute) = node.attributes().find(|a| a.namespace().is_none() && a.name() == name) {
            self.edits.push((attribute.range(), written));
            return;
        }
        let start = node.range().start + 1;
        let rest = &self.document.input_text()[start..];
        let end = start + rest.find(|c: char| c.is_whitespace() || c == '/' || c == '>').unwrap_or(rest.len());
        self.edits.push((end..end, format!(" {written}")));
    }

    fn text(mut self) -> String {
        let text = self.document.input_text();
        // Stable, so that what is written at one place stays in order.
        self.edits.sort_by_key(|(range, _)| range.start);
        let mut written = String::with_capacity(text.len() + 64 * self.edits.len());
        let mut copied = 0;
        for (range, new) in &self.edits {
            written.push_str(text.get(copied..range.start).unwrap_or_default());
            written.push_str(new);
            copied = range.end.max(copied);
        }
        written.push_str(&text[copied..]);
        written
    }
}

/// The box of the page in its own coordinates; its corner is the origin, whatever the `viewBox` begins with.
fn view_of(root: Node) -> Reference {
    let view: Vec<f64> = root
        .attribute("viewBox")
        .map(|text| text.split([',', ' ']).filter_map(|word| word.trim().parse().ok()).collect())
        .unwrap_or_default();
    let side = |k: usize, name| match view.get(k) {
        Some(side) => *side,
        None => root.attribute(name).and_then(|text| transform::length(text.trim(), 100.0)).unwrap_or(0.0),
    };
    Reference { x: 0.0, y: 0.0, width: side(2, "width"), height: side(3, "height") }
}

fn escaped(value: &str) -> String {
    value.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests;
