//! How large a drawing becomes when its references are followed.
//!
//! Clips, masks, patterns, markers and copies refer to other elements, which may refer to others again: a file of some
//! lines can stand for more elements than there are atoms in a plushie. What an element stands for is
//! `w = 1 + bytes / 64 + sum w(children) + sum w(references)`; each is found once, so the count takes the time of
//! reading the file, while following the references would take the time of `w`.

use crate::outline::OutlineError;
use std::collections::BTreeMap;
use usvg::roxmltree::{self, Document, Node, ParsingOptions};

/// Most elements that a drawing may stand for: reading so many takes some seconds and about a gigabyte.
const MAX_ELEMENTS: u64 = 1_000_000;
/// Bytes of attributes (path data, embedded pictures) that weigh as much as an element.
const BYTES: usize = 64;
/// Bytes of text that weigh as much as an element: every letter becomes an outline.
const LETTERS: usize = 4;
/// Bytes of path data for each place that a marker can stand at, at least.
const BYTES_OF_VERTEX: usize = 4;
/// Most rules of style sheets times elements: each rule is tried on each element.
const MAX_STYLING: usize = 100_000_000;

/// Refuses a drawing that stands for too many elements.
pub(super) fn check(document: &Document) -> Result<(), OutlineError> {
    if elements(document).is_some_and(|n| n <= MAX_ELEMENTS) {
        Ok(())
    } else {
        Err(OutlineError::TooComplex("stands for more than a million parts when its references are followed"))
    }
}

/// The elements of a file. Its own entities are resolved, within the bounds of the XML walk.
pub(super) fn parse(text: &str) -> Result<Document<'_>, roxmltree::Error> {
    Document::parse_with_options(text, ParsingOptions { allow_dtd: true, ..ParsingOptions::default() })
}

/// Whether an embedded drawing may be read; what is none is left to the reader.
pub(super) fn fits(data: &[u8]) -> bool {
    let text = std::str::from_utf8(data).unwrap_or_default();
    parse(text).map_or(true, |document| check(&document).is_ok())
}

/// What the root stands for; `None` where its styles alone are too many.
fn elements(document: &Document) -> Option<u64> {
    let nodes: Vec<Node> = document.descendants().collect();
    let style = Style::of(&nodes);
    if style.rules.saturating_mul(nodes.len()) > MAX_STYLING {
        return None;
    }
    let ids: BTreeMap<&str, usize> =
        nodes.iter().enumerate().filter_map(|(k, n)| n.attribute("id").map(|id| (id, k))).collect();
    let mut number = BTreeMap::new();
    for (k, node) in nodes.iter().enumerate() {
        number.insert(node.id().get(), k);
    }
    let mut marked = false;
    let follows: Vec<Vec<usize>> = nodes
        .iter()
        .map(|node| {
            let mut all: Vec<usize> = node.children().filter_map(|c| number.get(&c.id().get()).copied()).collect();
            let mut refer = |id: &str| all.extend(ids.get(id));
            for attribute in node.attributes() {
                let value = attribute.value();
                if attribute.name() == "href" {
                    value.trim().strip_prefix('#').into_iter().for_each(&mut refer);
                }
                urls(value).for_each(&mut refer);
                marked |= attribute.name().starts_with("marker") || value.contains("marker");
            }
            style.of_element(node).for_each(&mut refer);
            all
        })
        .collect();
    let weights = weights(&nodes, &follows);
    let mut total = weights.first().copied().unwrap_or(0);
    if marked || style.marked {
        // Inherited by all paths below, so any marker may stand at any vertex.
        let largest = nodes.iter().zip(&weights).filter(|(n, _)| n.has_tag_name_anywhere("marker")).map(|(_, w)| *w);
        let data = nodes.iter().flat_map(|n| ["d", "points"].map(|name| n.attribute(name).map_or(0, str::len)));
        let vertices = data.sum::<usize>() / BYTES_OF_VERTEX;
        total = total.saturating_add(largest.max().unwrap_or(0).saturating_mul(vertices as u64));
    }
    Some(total)
}

/// What each node stands for. A reference back to where it came from counts nothing: the reader drops it.
fn weights(nodes: &[Node], follows: &[Vec<usize>]) -> Vec<u64> {
    const UNKNOWN: u64 = u64::MAX;
    let mut weights = vec![UNKNOWN; nodes.len()];
    let mut open = vec![false; nodes.len()];
    for first in 0..nodes.len() {
        // Depth first with a stack of its own: chains of references may be as long as the file.
        let mut path = vec![(first, 0)];
        while let Some((node, next)) = path.pop() {
            if weights[node] != UNKNOWN {
                continue;
            }
            open[node] = true;
            let Some(&child) = follows[node].get(next) else {
                open[node] = false;
                let sum = follows[node].iter().map(|&c| if weights[c] == UNKNOWN { 0 } else { weights[c] });
                weights[node] = sum.fold(own(&nodes[node]), u64::saturating_add).min(UNKNOWN - 1);
                continue;
            };
            path.push((node, next + 1));
            if weights[child] == UNKNOWN && !open[child] {
                path.push((child, 0));
            }
        }
    }
    weights
}

fn own(node: &Node) -> u64 {
    let bytes: usize = node.attributes().map(|a| a.value().len()).sum();
    let letters = if node.is_text() { node.text().map_or(0, |t| t.trim().len()) } else { 0 };
    (1 + bytes / BYTES + letters / LETTERS) as u64
}

/// The names in `url(#name)`.
fn urls(text: &str) -> impl Iterator<Item = &str> {
    text.split("url(").skip(1).filter_map(|rest| {
        let id = rest.trim_start().trim_start_matches(['"', '\'']).strip_prefix('#')?;
        Some(id.split([')', '"', '\'']).next().unwrap_or_default().trim())
    })
}

/// The references in style sheets by the last part of their selectors: `.class`, `#id`, a tag, or `*` for all others.
#[derive(Default)]
struct Style {
    rules: usize,
    marked: bool,
    references: BTreeMap<String, Vec<String>>,
}

impl Style {
    fn of(nodes: &[Node]) -> Self {
        let mut style = Self::default();
        let sheets = nodes.iter().filter(|n| n.has_tag_name_anywhere("style"));
        for rule in sheets
            .flat_map(|n| n.descendants())
            .filter(Node::is_text)
            .filter_map(|n| n.text())
            .flat_map(|t| t.split('}'))
        {
            style.rules += 1;
            let Some((before, body)) = rule.rsplit_once('{') else { continue };
            style.marked |= body.contains("marker");
            let ids: Vec<String> = urls(body).map(str::to_owned).collect();
            if ids.is_empty() {
                continue;
            }
            let selectors = before.rsplit('{').next().unwrap_or_default();
            for selector in selectors.split(',') {
                style.references.entry(key(selector)).or_default().extend_from_slice(&ids);
            }
        }
        style
    }

    fn of_element(&self, node: &Node) -> impl Iterator<Item = &str> {
        let mut keys = vec!["*".to_owned(), node.tag_name().name().to_owned()];
        if !self.references.is_empty() {
            keys.extend(node.attribute("id").map(|id| format!("#{id}")));
            keys.extend(node.attribute("class").iter().flat_map(|c| c.split_whitespace()).map(|c| format!(".{c}")));
        }
        keys.into_iter().filter_map(move |key| self.references.get(&key)).flatten().map(String::as_str)
    }
}

/// A plain `.class`, `#id` or tag at the end of a selector; `*` for what is not as plain.
fn key(selector: &str) -> String {
    let last = selector.split([' ', '\t', '\n', '\r', '>', '+', '~']).rfind(|s| !s.is_empty()).unwrap_or_default();
    let name = last.trim_start_matches(['.', '#']);
    let plain = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || "-_".contains(c));
    if plain && last.len() - name.len() <= 1 { last.to_owned() } else { "*".to_owned() }
}

trait Tagged {
    /// Whether the element is called so, in whatever namespace.
    fn has_tag_name_anywhere(&self, name: &str) -> bool;
}

impl Tagged for Node<'_, '_> {
    fn has_tag_name_anywhere(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(body: &str) -> Option<u64> {
        let text = format!("<svg xmlns='http://www.w3.org/2000/svg'>{body}</svg>");
        elements(&Document::parse(&text).unwrap())
    }

    /// A chain of `n` clips, each of which refers to the one before twice.
    fn chain(n: usize, clipped: impl Fn(usize) -> String) -> String {
        let clip = |i: usize| format!("<clipPath id='c{}'>{}</clipPath>", i + 1, clipped(i).repeat(2));
        (0..n).map(clip).collect()
    }

    #[test]
    fn plain_elements_count_once() {
        // The document itself and the root count too.
        assert_eq!(count("<g><rect/><rect/></g><circle/>"), Some(6));
        assert_eq!(count("<rect id='r'/><use href='#r'/><use href='#r'/>"), Some(2 + 1 + 2 + 2));
    }

    #[test]
    fn references_multiply_however_they_are_written() {
        for way in ["<rect clip-path='url(#c{})'/>", "<rect style='clip-path: url( \"#c{}\" )'/>", "<use href='#c{}'/>"]
        {
            let few = count(&chain(5, |i| way.replace("{}", &i.to_string()))).unwrap();
            assert!((50..500).contains(&few), "{few}");
            assert!(count(&chain(70, |i| way.replace("{}", &i.to_string()))).unwrap() > MAX_ELEMENTS);
        }
        let rules: String = (0..70).map(|i| format!("g .k{i}, #x {{ clip-path: url(#c{i}) }}")).collect();
        let body = format!("<style>{rules}</style>{}", chain(70, |i| format!("<rect class='a k{i}'/>")));
        assert!(count(&body).unwrap() > MAX_ELEMENTS);
    }

    #[test]
    fn circles_of_references_end() {
        assert!(count("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>").unwrap() < 20);
    }

    #[test]
    fn markers_count_at_every_vertex() {
        let marker = format!("<marker id='m'>{}</marker>", "<rect/>".repeat(1000));
        let path = format!("<path d='M0 0{}'/>", "h1v1".repeat(2000));
        assert!(count(&format!("{marker}{path}")).unwrap() < 2000);
        assert!(count(&format!("{marker}<g marker-mid='url(#m)'>{path}</g>")).unwrap() > MAX_ELEMENTS);
    }
}
