//! Selectors of style sheets (Selectors Level 4, without what a still picture never is).

use std::cell::Cell;
use usvg::roxmltree::Node;

/// How much a selector weighs against others: ids, then classes and the like, then names.
pub(super) type Weight = [u32; 3];

/// Compound selectors from the element outwards, each with how it relates to the one before.
#[derive(Clone, Debug)]
pub(super) struct Complex(Vec<(Relation, Vec<Simple>)>);

/// How the element of a compound lies to that of the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Relation {
    Itself,
    Ancestor,
    Parent,
    /// The element right before it.
    Neighbour,
    /// Any element before it.
    Earlier,
}

#[derive(Clone, Debug)]
enum Simple {
    Any,
    Name(String),
    Id(String),
    Class(String),
    /// An attribute, and how its value compares.
    Attribute(String, Option<(char, String)>),
    Not(Vec<Complex>),
    Is(Vec<Complex>),
    Root,
    Empty,
    /// The `a n + b`-th child, from the start or the end.
    Nth {
        a: i64,
        b: i64,
        from_end: bool,
        of_type: bool,
    },
    /// What only a reader's hand or the past of a page makes true.
    Never,
}

/// Compounds of a selector, and selectors within each other, that are read at most.
const MAX_COMPOUNDS: usize = 12;
const MAX_DEPTH: usize = 4;

/// The selectors between commas.
pub(super) fn parts(text: &str) -> Vec<&str> {
    let (mut depth, mut start) = (0_usize, 0);
    let mut parts = Vec::new();
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[start..]);
    parts
}

/// A selector and its weight; `None` for one that is not understood.
pub(super) fn parse(text: &str) -> Option<(Complex, Weight)> {
    let mut weight = [0; 3];
    let complex = Reader { rest: text.trim(), depth: 0 }.complex(&mut weight)?;
    Some((complex, weight))
}

struct Reader<'a> {
    rest: &'a str,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn complex(&mut self, weight: &mut Weight) -> Option<Complex> {
        let mut compounds = vec![(Relation::Itself, self.compound(weight)?)];
        loop {
            let before = self.rest;
            self.rest = self.rest.trim_start();
            let relation = match self.rest.chars().next() {
                None => break,
                Some('>') => Relation::Parent,
                Some('+') => Relation::Neighbour,
                Some('~') => Relation::Earlier,
                Some(_) if before.len() > self.rest.len() => Relation::Ancestor,
                Some(_) => return None,
            };
            if relation != Relation::Ancestor {
                self.rest = self.rest[1..].trim_start();
            }
            // Read from the left, but matched from the right.
            compounds.last_mut()?.0 = relation;
            compounds.push((Relation::Itself, self.compound(weight)?));
            if compounds.len() > MAX_COMPOUNDS {
                return None;
            }
        }
        compounds.reverse();
        Some(Complex(compounds))
    }

    fn compound(&mut self, weight: &mut Weight) -> Option<Vec<Simple>> {
        let mut simples = Vec::new();
        while let Some(c) = self.rest.chars().next() {
            let simple = match c {
                '*' => {
                    self.rest = &self.rest[1..];
                    Simple::Any
                }
                '#' | '.' => {
                    self.rest = &self.rest[1..];
                    let name = self.name()?;
                    weight[usize::from(c == '.')] += 1;
                    if c == '#' { Simple::Id(name) } else { Simple::Class(name) }
                }
                '[' => {
                    weight[1] += 1;
                    self.attribute()?
                }
                ':' => self.pseudo(weight)?,
                c if is_of_name(c) => {
                    weight[2] += 1;
                    Simple::Name(self.name()?)
                }
                _ => break,
            };
            simples.push(simple);
        }
        (!simples.is_empty()).then_some(simples)
    }

    fn name(&mut self) -> Option<String> {
        let end = self.rest.find(|c| !is_of_name(c)).unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(end);
        self.rest = rest;
        (!name.is_empty()).then(|| name.to_owned())
    }

    fn attribute(&mut self) -> Option<Simple> {
        let (inside, rest) = self.rest[1..].split_once(']')?;
        self.rest = rest;
        let Some((name, value)) = inside.split_once('=') else {
            return Some(Simple::Attribute(inside.trim().to_owned(), None));
        };
        let value = value.trim().trim_matches(['"', '\'']).to_owned();
        let kind = name.chars().last().filter(|c| "~|^$*".contains(*c)).unwrap_or('=');
        let name = name.trim_end_matches(['~', '|', '^', '$', '*']).trim().to_owned();
        Some(Simple::Attribute(name, Some((kind, value))))
    }

    fn pseudo(&mut self, weight: &mut Weight) -> Option<Simple> {
        self.rest = self.rest[1..].trim_start_matches(':');
        let name = self.name()?.to_ascii_lowercase();
        let inside = match self.rest.strip_prefix('(') {
            Some(rest) => {
                let end = matching(rest)?;
                self.rest = &rest[end + 1..];
                Some(rest[..end].trim())
            }
            None => None,
        };
        if ["not", "is", "where", "matches", "any"].contains(&name.as_str()) {
            return self.of_list(&name, inside?, weight);
        }
        weight[1] += 1;
        let nth = |(a, b), from_end, of_type| Simple::Nth { a, b, from_end, of_type };
        Some(match name.as_str() {
            "root" => Simple::Root,
            "empty" => Simple::Empty,
            "first-child" => nth((0, 1), false, false),
            "last-child" => nth((0, 1), true, false),
            "first-of-type" => nth((0, 1), false, true),
            "last-of-type" => nth((0, 1), true, true),
            "nth-child" => nth(steps(inside?)?, false, false),
            "nth-last-child" => nth(steps(inside?)?, true, false),
            "nth-of-type" => nth(steps(inside?)?, false, true),
            "nth-last-of-type" => nth(steps(inside?)?, true, true),
            "hover" | "active" | "focus" | "visited" | "target" | "focus-within" | "before" | "after" => Simple::Never,
            _ => return None,
        })
    }

    /// The heaviest selector of a list counts, none in `:where()`.
    fn of_list(&mut self, name: &str, inside: &str, weight: &mut Weight) -> Option<Simple> {
        if self.depth >= MAX_DEPTH {
            return None;
        }
        let mut heaviest = [0; 3];
        let mut list = Vec::new();
        for part in parts(inside) {
            let mut own = [0; 3];
            list.push(Reader { rest: part.trim(), depth: self.depth + 1 }.complex(&mut own)?);
            heaviest = heaviest.max(own);
        }
        if name != "where" {
            (0..3).for_each(|k| weight[k] += heaviest[k]);
        }
        Some(if name == "not" { Simple::Not(list) } else { Simple::Is(list) })
    }
}

fn is_of_name(c: char) -> bool {
    c.is_alphanumeric() || c == '-' || c == '_' || !c.is_ascii()
}

/// Where the bracket is closed that was opened before the text.
fn matching(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' if depth == 0 => return Some(at),
            ')' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// `2n+1`, `odd`, `even`, `3`, `-n+2`.
fn steps(text: &str) -> Option<(i64, i64)> {
    let text: String = text.to_ascii_lowercase().chars().filter(|c| !c.is_whitespace()).collect();
    match text.as_str() {
        "odd" => return Some((2, 1)),
        "even" => return Some((2, 0)),
        _ => {}
    }
    let Some((a, b)) = text.split_once('n') else { return Some((0, text.parse().ok()?)) };
    let a = match a {
        "" | "+" => 1,
        "-" => -1,
        a => a.parse().ok()?,
    };
    Some((a, if b.is_empty() { 0 } else { b.parse().ok()? }))
}

/// Matches selectors on elements, with a bound on the steps it takes.
pub(super) struct Matcher<'a> {
    /// Of each element: its place among its siblings from 1, and how many there are; of all, and of its name.
    pub places: &'a [[usize; 4]],
    pub steps: Cell<u64>,
    pub most_steps: u64,
}

impl Matcher<'_> {
    /// Whether a selector holds for an element; `None` when it takes too long.
    pub fn holds(&self, complex: &Complex, node: Node) -> Option<bool> {
        self.from(&complex.0, node)
    }

    fn from(&self, compounds: &[(Relation, Vec<Simple>)], node: Node) -> Option<bool> {
        self.steps.set(self.steps.get() + 1);
        if self.steps.get() > self.most_steps {
            return None;
        }
        let Some(((_, simples), rest)) = compounds.split_first() else { return Some(true) };
        for simple in simples {
            if !self.simple(simple, node)? {
                return Some(false);
            }
        }
        let Some((relation, _)) = rest.first() else { return Some(true) };
        match relation {
            Relation::Itself => self.from(rest, node),
            Relation::Parent => node.parent_element().map_or(Some(false), |parent| self.from(rest, parent)),
            Relation::Ancestor => self.any(rest, node.ancestors().skip(1).filter(Node::is_element)),
            Relation::Neighbour => {
                let before = node.prev_siblings().skip(1).find(Node::is_element);
                before.map_or(Some(false), |before| self.from(rest, before))
            }
            Relation::Earlier => self.any(rest, node.prev_siblings().skip(1).filter(Node::is_element)),
        }
    }

    fn any<'n, 'i: 'n>(
        &self,
        compounds: &[(Relation, Vec<Simple>)],
        mut nodes: impl Iterator<Item = Node<'n, 'i>>,
    ) -> Option<bool> {
        nodes.try_fold(false, |found, node| Some(found || self.from(compounds, node)?))
    }

    fn simple(&self, simple: &Simple, node: Node) -> Option<bool> {
        Some(match simple {
            Simple::Any => true,
            Simple::Never => false,
            Simple::Name(name) => node.tag_name().name() == name,
            Simple::Id(id) => node.attribute("id") == Some(id),
            Simple::Class(class) => {
                node.attribute("class").is_some_and(|all| all.split_whitespace().any(|c| c == class))
            }
            Simple::Attribute(name, wanted) => node.attribute(name.as_str()).is_some_and(|value| match wanted {
                None => true,
                Some(('~', word)) => value.split_whitespace().any(|w| w == word),
                Some(('|', start)) => {
                    value == start || value.strip_prefix(start.as_str()).is_some_and(|r| r.starts_with('-'))
                }
                Some(('^', start)) => !start.is_empty() && value.starts_with(start.as_str()),
                Some(('$', end)) => !end.is_empty() && value.ends_with(end.as_str()),
                Some(('*', part)) => !part.is_empty() && value.contains(part.as_str()),
                Some((_, whole)) => value == whole,
            }),
            Simple::Not(list) => !self.one_of(list, node)?,
            Simple::Is(list) => self.one_of(list, node)?,
            Simple::Root => node.parent_element().is_none(),
            Simple::Empty => !node.has_children(),
            Simple::Nth { a, b, from_end, of_type } => {
                let [place, count, of_name, count_of_name] = *self.places.get(node.id().get_usize())?;
                let (place, count) = if *of_type { (of_name, count_of_name) } else { (place, count) };
                let n = if *from_end { count + 1 - place } else { place } as i64 - b;
                if *a == 0 { n == 0 } else { n % a == 0 && n / a >= 0 }
            }
        })
    }

    fn one_of(&self, list: &[Complex], node: Node) -> Option<bool> {
        list.iter().try_fold(false, |found, complex| Some(found || self.holds(complex, node)?))
    }
}
