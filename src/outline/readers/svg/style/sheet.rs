//! The rules of style sheets: selectors with declarations, in the order of the file.

use super::selector::{self, Complex, Weight};

/// A selector with what it declares.
pub(super) struct Rule {
    pub selector: Complex,
    pub weight: Weight,
    pub declarations: Vec<Declaration>,
}

/// One property.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Declaration {
    pub name: String,
    pub value: String,
    pub important: bool,
}

/// Deepest nesting of conditions (`@media`) that is read.
const MAX_DEPTH: usize = 8;

/// The rules of a sheet, of those that hold on a screen; selectors that are not understood go to `unknown`.
pub(super) fn rules(css: &str, unknown: &mut Vec<String>) -> Vec<Rule> {
    let mut rules = Vec::new();
    read(&without_comments(css), 0, &mut rules, unknown);
    rules
}

fn read(css: &str, depth: usize, rules: &mut Vec<Rule>, unknown: &mut Vec<String>) {
    let mut rest = css.trim_start();
    while !rest.is_empty() {
        let open = find(rest, '{');
        let end = find(rest, ';');
        if rest.starts_with('@') && end < open {
            rest = rest.get(end + 1..).unwrap_or_default().trim_start();
            continue;
        }
        let Some(body) = rest.get(open + 1..) else { return };
        let close = closing(body);
        let (head, block) = (rest[..open].trim(), &body[..close]);
        match head.strip_prefix('@') {
            Some(condition) if is_for_screens(condition) && depth < MAX_DEPTH => read(block, depth + 1, rules, unknown),
            Some(_) => {}
            None => {
                let declarations = declarations(block);
                for text in selector::parts(head) {
                    match selector::parse(text) {
                        Some((selector, weight)) => {
                            rules.push(Rule { selector, weight, declarations: declarations.clone() });
                        }
                        None => unknown.push(text.trim().to_owned()),
                    }
                }
            }
        }
        rest = body.get(close + 1..).unwrap_or_default().trim_start();
    }
}

/// Whether an at-rule is a condition that a screen meets: `media screen`, `media all and ...`, `supports ...`.
fn is_for_screens(condition: &str) -> bool {
    let mut words = condition.split_whitespace();
    match words.next() {
        Some("media") => {
            let rest: Vec<String> = words.map(str::to_ascii_lowercase).collect();
            rest.is_empty() || rest.iter().any(|word| word.starts_with("screen") || word.starts_with("all"))
        }
        Some("supports" | "layer") => true,
        _ => false,
    }
}

/// The declarations in braces or of a `style` attribute.
pub(super) fn declarations(text: &str) -> Vec<Declaration> {
    let mut all = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let end = find(rest, ';');
        let one = &rest[..end];
        rest = rest.get(end + 1..).unwrap_or_default();
        let Some((name, value)) = one.split_once(':') else { continue };
        let value = value.trim();
        let bare = value.strip_suffix("important").and_then(|rest| rest.trim_end().strip_suffix('!'));
        let (name, important) = (name.trim().to_ascii_lowercase(), bare.is_some());
        let value = bare.unwrap_or(value).trim().to_owned();
        if !name.is_empty() && !value.is_empty() {
            all.push(Declaration { name, value, important });
        }
    }
    all
}

/// Where a character stands first, outside of quotes and brackets; the end where it does not.
fn find(text: &str, wanted: char) -> usize {
    let (mut quote, mut depth) = (None, 0_usize);
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (Some(_), _) => {}
            (None, c) if c == wanted && depth == 0 => return at,
            (None, '"' | '\'') => quote = Some(c),
            (None, '(' | '[') => depth += 1,
            (None, ')' | ']') => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    text.len()
}

/// Where the brace that was opened before the text is closed.
fn closing(text: &str) -> usize {
    let mut depth = 0_usize;
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => return at,
            '}' => depth -= 1,
            _ => {}
        }
    }
    text.len()
}

fn without_comments(css: &str) -> String {
    let mut plain = String::with_capacity(css.len());
    let mut rest = css;
    while let Some((before, after)) = rest.split_once("/*") {
        plain.push_str(before);
        plain.push(' ');
        rest = after.split_once("*/").map_or("", |found| found.1);
    }
    plain.push_str(rest);
    plain.replace("<!--", " ").replace("-->", " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_read_with_their_conditions_comments_and_weights() {
        let css = "@import 'a;b'; /* g {} */ .a, g > .b:not(.c) { fill : red ; stroke: url(#a;b) !important }\
                   @media print { p { x: 1 } } @media screen and (min-width: 1px) { q { y: 2 } } r:hover? {z:1} s{t:u}";
        let mut unknown = Vec::new();
        let rules = rules(css, &mut unknown);
        assert_eq!(unknown, ["r:hover?"]);
        let declared: Vec<String> = rules
            .iter()
            .map(|rule| rule.declarations.iter().map(|d| d.name.as_str()).collect::<Vec<_>>().join(" "))
            .collect();
        assert_eq!(declared, ["fill stroke", "fill stroke", "y", "t"]);
        assert_eq!(
            rules.iter().map(|rule| rule.weight).collect::<Vec<_>>(),
            [[0, 1, 0], [0, 2, 1], [0, 0, 1], [0, 0, 1]]
        );
        assert!(rules[0].declarations[1].important && rules[0].declarations[1].value == "url(#a;b)");
    }
}
