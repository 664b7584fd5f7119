//! Which declaration wins on each element (CSS Cascading Level 4, one author).

use super::properties::{Styles, TRANSFORMS, geometry};
use super::selector::Matcher;
use super::sheet::{self, Declaration, Rule};
use crate::outline::OutlineError;
use std::cell::Cell;
use std::collections::BTreeMap;
use usvg::roxmltree::{Document, Node};

/// Steps of matching selectors on elements: some seconds.
const MAX_STEPS: u64 = 100_000_000;

/// All rules of a drawing.
pub(super) struct Cascade {
    /// In the order of their weight, and of the file.
    rules: Vec<Rule>,
    /// Whether a selector is more than `usvg` reads.
    beyond: bool,
    /// Selectors that are not understood.
    pub unknown: Vec<String>,
}

impl Cascade {
    pub fn of(document: &Document) -> Self {
        let mut cascade = Self { rules: Vec::new(), beyond: false, unknown: Vec::new() };
        for node in document.descendants().filter(|node| node.is_element() && node.tag_name().name() == "style") {
            let text: String = node.children().filter_map(|child| child.text()).collect();
            cascade.beyond |= is_beyond(&text);
            cascade.rules.extend(sheet::rules(&text, &mut cascade.unknown));
        }
        // Stable: of equal weight the later one wins.
        cascade.rules.sort_by_key(|rule| rule.weight);
        cascade
    }

    /// Whether there is anything that `usvg` does not follow.
    pub fn is_needed(&self, document: &Document) -> bool {
        let moves = |declarations: &[Declaration]| {
            declarations.iter().any(|d| TRANSFORMS.contains(&d.name.as_str()) || is_form(&d.name))
        };
        self.beyond
            || self.rules.iter().any(|rule| moves(&rule.declarations))
            || document.descendants().filter_map(|node| Some((node, node.attribute("style")?))).any(|(node, style)| {
                sheet::declarations(style)
                    .iter()
                    .any(|d| TRANSFORMS.contains(&d.name.as_str()) || geometry(node).contains(&d.name.as_str()))
            })
    }

    /// The winning declarations of every element that has any.
    ///
    /// # Errors
    /// It would take too long.
    pub fn resolved<'a, 'i>(&self, document: &'a Document<'i>) -> Result<Styles<'a, 'i>, OutlineError> {
        let places = places(document);
        let matcher = Matcher { places: &places, steps: Cell::new(0), most_steps: MAX_STEPS };
        let mut styles = Vec::new();
        for node in document.descendants().filter(Node::is_element) {
            let mut plain: BTreeMap<String, String> = BTreeMap::new();
            let mut important: BTreeMap<String, String> = BTreeMap::new();
            let mut take = |declaration: &Declaration| {
                let to = if declaration.important { &mut important } else { &mut plain };
                to.insert(declaration.name.clone(), declaration.value.clone());
            };
            for rule in &self.rules {
                let too_long = OutlineError::TooComplex("has styles that take too long to apply");
                if matcher.holds(&rule.selector, node).ok_or(too_long)? {
                    rule.declarations.iter().for_each(&mut take);
                }
            }
            sheet::declarations(node.attribute("style").unwrap_or_default()).iter().for_each(&mut take);
            plain.extend(important);
            if !plain.is_empty() {
                styles.push((node, plain));
            }
        }
        Ok(styles)
    }
}

/// Whether a sheet has more than names, classes, ids, attributes, children and descendants: in conditions, or with functions, siblings or
/// pseudo-classes other than the first child.
fn is_beyond(css: &str) -> bool {
    css.split('}').any(|rule| {
        let head = rule.split('{').next().unwrap_or_default();
        let nested = rule.matches('{').count() > 1;
        let pseudo = head.matches(':').count() > head.matches(":first-child").count();
        nested || pseudo || head.contains(['+', '~', '@', '('])
    })
}

fn is_form(name: &str) -> bool {
    ["cx", "cy", "r", "rx", "ry", "x", "y", "d", "width", "height"].contains(&name)
}

/// Of each node by its number: the place among the elements around it and their count; the same among those of its name.
fn places(document: &Document) -> Vec<[usize; 4]> {
    let mut places = vec![[0; 4]; document.descendants().count() + 1];
    for parent in document.descendants() {
        let elements = || parent.children().filter(Node::is_element);
        let count = elements().count();
        let mut of_name: BTreeMap<&str, usize> = BTreeMap::new();
        for (k, child) in elements().enumerate() {
            let same = of_name.entry(child.tag_name().name()).or_default();
            *same += 1;
            places[child.id().get_usize()] = [k + 1, count, *same, 0];
        }
        for child in elements() {
            places[child.id().get_usize()][3] = of_name[child.tag_name().name()];
        }
    }
    places
}
