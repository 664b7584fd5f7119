//! No circles between the files of a room: who reads one file needs only those below it.
//!
//! A file depends on another of its room when it names something that stands there; a face (`pub use` in a `mod.rs`) is looked through,
//! the declaration of a module is no dependence, and test modules are left out.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Circles that stay, by one file of each, and why.
const ALLOWED: &[(&str, &str)] = &[];

#[test]
fn no_files_of_a_room_depend_on_each_other_in_a_circle() {
    let found = circles(&Crate::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")));
    let wrong: Vec<String> = found
        .iter()
        .filter(|circle| !ALLOWED.iter().any(|(file, _)| circle.iter().any(|other| other == file)))
        .map(|circle| circle.join(", "))
        .collect();
    for (file, _) in ALLOWED {
        assert!(found.iter().flatten().any(|other| other == file), "{file} is in no circle any more");
    }
    assert!(wrong.is_empty(), "files that depend on each other in a circle:\n{}", wrong.join("\n"));
}

#[test]
fn circles_are_seen_through_faces_and_groups() {
    let text =
        |pairs: &[(&str, &str)]| Crate::from(pairs.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect());
    let open = [
        ("lib.rs", "pub mod r;"),
        ("r/mod.rs", "mod a; mod b; pub use a::A;"),
        ("r/a.rs", "pub struct A;"),
        ("r/b.rs", "use super::A;"),
    ];
    assert!(circles(&text(&open)).is_empty());
    let face = [
        ("lib.rs", "pub mod r;"),
        ("r/mod.rs", "mod a; mod b; pub use a::{A, B as C};"),
        ("r/a.rs", "use crate::r::b; pub struct A; pub struct B;"),
        ("r/b.rs", "fn f(c: super::C) {}"),
    ];
    assert_eq!(circles(&text(&face)), [["r/a.rs", "r/b.rs"]]);
    let head = [
        ("lib.rs", "pub mod r;"),
        ("r/mod.rs", "mod a; pub struct A; fn f() { a::g() }"),
        ("r/a.rs", "use super::A; pub fn g() {}"),
    ];
    assert_eq!(circles(&text(&head)), [["r/a.rs", "r/mod.rs"]]);
    let tests = [
        ("lib.rs", "pub mod r;"),
        ("r/mod.rs", "mod a; fn f() { a::g() } pub struct A;"),
        ("r/a.rs", "pub fn g() {}\n#[cfg(test)]\nmod tests { use super::super::A; }"),
    ];
    assert!(circles(&text(&tests)).is_empty());
}

/// The modules of the crate by path (`physics::model`), each with its file and its text without comments and tests.
struct Crate {
    modules: BTreeMap<Vec<String>, Module>,
}

struct Module {
    file: String,
    code: String,
    /// Whole paths that `use` names: public (a face) or not, and the name they go by here (`*` for all).
    uses: Vec<Use>,
}

struct Use {
    public: bool,
    path: Vec<String>,
    name: String,
}

impl Crate {
    fn read(source: &Path) -> Crate {
        let mut files = Vec::new();
        collect(source, source, &mut files);
        Crate::from(files)
    }

    fn from(files: Vec<(String, String)>) -> Crate {
        let mut modules = BTreeMap::new();
        for (file, text) in files {
            let code = without_tests(&text);
            let path = file.trim_end_matches(".rs").trim_end_matches("/mod");
            let path =
                if path == "lib" || path == "main" { Vec::new() } else { path.split('/').map(str::to_owned).collect() };
            let uses = uses(&code);
            modules.insert(path, Module { file, code, uses });
        }
        // Files that only tests declare.
        let declared = |path: &Vec<String>, all: &BTreeMap<Vec<String>, Module>| {
            let Some((name, parent)) = path.split_last() else { return true };
            all.get(parent).is_some_and(|m| mentions_pair(&m.code, "mod", name))
        };
        let only_tests: Vec<_> = modules.keys().filter(|path| !declared(path, &modules)).cloned().collect();
        for path in only_tests {
            modules.remove(&path);
        }
        Crate { modules }
    }

    /// The file in which what `path` names stands, seen from the module `from`.
    fn file(&self, from: &[String], path: &[String], depth: usize) -> Option<&str> {
        let (mut at, rest): (Vec<String>, &[String]) = match path.first()?.as_str() {
            "crate" => (Vec::new(), &path[1..]),
            "self" => (from.to_vec(), &path[1..]),
            "super" => (from.split_last()?.1.to_vec(), &path[1..]),
            first if self.modules.contains_key(&[from, &[first.to_owned()]].concat()) => (from.to_vec(), path),
            _ => return None,
        };
        for (k, segment) in rest.iter().enumerate() {
            if segment == "super" {
                at.pop();
                continue;
            }
            let child = [at.as_slice(), std::slice::from_ref(segment)].concat();
            if self.modules.contains_key(&child) {
                at = child;
                continue;
            }
            return self.defined(&at, &rest[k..], depth);
        }
        Some(&self.modules.get(&at)?.file)
    }

    /// The file in which the item `rest[0]` of the module `at` stands: there, or where its face leads.
    fn defined(&self, at: &[String], rest: &[String], depth: usize) -> Option<&str> {
        let module = self.modules.get(at)?;
        let face = module.uses.iter().filter(|u| u.public && depth < 8);
        for used in face.clone().filter(|u| u.name == rest[0]) {
            if let Some(file) = self.file(at, &[used.path.as_slice(), &rest[1..]].concat(), depth + 1) {
                return Some(file);
            }
        }
        if ["struct", "enum", "fn", "trait", "const", "static", "type"]
            .iter()
            .any(|kind| mentions_pair(&module.code, kind, &rest[0]))
        {
            return Some(&module.file);
        }
        for used in face.filter(|u| u.name == "*") {
            let path = [used.path.as_slice(), rest].concat();
            if let Some(file) = self.file(at, &path, depth + 1).filter(|&file| file != module.file) {
                return Some(file);
            }
        }
        Some(&module.file)
    }

    /// The files of the same room that each file depends on.
    fn edges(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let mut edges = BTreeMap::new();
        for (path, module) in self.modules.iter().filter(|(path, _)| !path.is_empty()) {
            let private = module.uses.iter().filter(|u| !u.public).map(|u| u.path.clone());
            let named = private.chain(paths(&without_uses(&module.code)));
            let files = named.filter_map(|named| self.file(path, &named, 0));
            let room = |file: &str| file.split(['/', '.']).next().map(str::to_owned);
            let inside = files.filter(|&file| file != module.file && room(file) == room(&module.file));
            edges.insert(module.file.as_str(), inside.collect());
        }
        edges
    }
}

fn collect(root: &Path, folder: &Path, found: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(root, &path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let name = path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
            if name != "main.rs" {
                found.push((name, fs::read_to_string(&path).unwrap()));
            }
        }
    }
}

/// The text without comments, and up to the tests that stand last.
fn without_tests(text: &str) -> String {
    let code: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    let mut kept = String::new();
    let mut lines = code.iter().peekable();
    while let Some(line) = lines.next() {
        if ["#[cfg(test)]", "#[cfg(all(test, unix))]"].contains(&line.trim()) {
            let next = lines.peek().map(|l| l.trim()).unwrap_or_default();
            if next.contains("mod ") && next.ends_with('{') {
                break;
            }
            lines.next();
            continue;
        }
        kept.push_str(line);
        kept.push('\n');
    }
    kept
}

/// The text without its `use` statements.
fn without_uses(code: &str) -> String {
    let mut rest = String::new();
    let mut last = 0;
    for (start, end) in statements(code) {
        rest.push_str(&code[last..start]);
        last = end;
    }
    rest + &code[last..]
}

/// Where `use` statements begin (at `use`) and end (behind the semicolon).
fn statements(code: &str) -> Vec<(usize, usize)> {
    let starts =
        code.match_indices("use ").filter(|(at, _)| code[..*at].chars().next_back().is_none_or(char::is_whitespace));
    starts.filter_map(|(at, _)| Some((at, at + code[at..].find(';')? + 1))).collect()
}

fn uses(code: &str) -> Vec<Use> {
    let mut found = Vec::new();
    for (start, end) in statements(code) {
        let line = code[..start].rsplit(['\n', ';']).next().unwrap_or_default();
        let mut leaves = Vec::new();
        expand(&[], &code[start + 4..end - 1], &mut leaves);
        found.extend(leaves.into_iter().map(|(path, name)| Use { public: line.contains("pub"), path, name }));
    }
    found
}

/// Every path of a tree of `use`, with the name that it goes by.
fn expand(prefix: &[String], tree: &str, found: &mut Vec<(Vec<String>, String)>) {
    let tree = tree.trim();
    if tree.is_empty() {
        return;
    }
    if let Some(open) = tree.find('{') {
        let head = tree[..open].trim().trim_end_matches("::");
        let prefix: Vec<String> = prefix
            .iter()
            .cloned()
            .chain(head.split("::").filter(|s| !s.is_empty()).map(|s| s.trim().to_owned()))
            .collect();
        let inner = tree[open + 1..].trim_end().trim_end_matches('}');
        // Closing braces of inner groups at the very end were trimmed as well: put them back.
        let missing = inner.matches('{').count().saturating_sub(inner.matches('}').count());
        let inner = format!("{inner}{}", "}".repeat(missing));
        let (mut depth, mut start) = (0, 0);
        for (at, c) in inner.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    expand(&prefix, &inner[start..at], found);
                    start = at + 1;
                }
                _ => {}
            }
        }
        expand(&prefix, &inner[start..], found);
        return;
    }
    let (path, alias) =
        tree.split_once(" as ").map_or((tree, None), |(path, alias)| (path, Some(alias.trim().to_owned())));
    let mut path: Vec<String> = prefix.iter().cloned().chain(path.split("::").map(|s| s.trim().to_owned())).collect();
    let last = path.last().cloned().unwrap_or_default();
    if last == "self" || last == "*" {
        path.pop();
    }
    let own = if last == "self" { path.last().cloned().unwrap_or_default() } else { last };
    found.push((path, alias.unwrap_or(own)));
}

/// Paths of two words or more in plain code, from their first word on.
fn paths(code: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let bytes = code.as_bytes();
    let word = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
    let mut at = 0;
    while at < bytes.len() {
        if !word(bytes[at]) || at > 0 && (word(bytes[at - 1]) || bytes[at - 1] == b':') {
            at += 1;
            continue;
        }
        let mut path = Vec::new();
        let mut end = at;
        loop {
            let start = end;
            while end < bytes.len() && word(bytes[end]) {
                end += 1;
            }
            path.push(code[start..end].to_owned());
            if end + 2 < bytes.len() && &bytes[end..end + 2] == b"::" && word(bytes[end + 2]) {
                end += 2;
            } else {
                break;
            }
        }
        if path.len() > 1 {
            found.push(path);
        }
        at = end.max(at + 1);
    }
    found
}

/// Whether `kind name` stands in `code`, `name` as a word of its own.
fn mentions_pair(code: &str, kind: &str, name: &str) -> bool {
    let pair = format!("{kind} {name}");
    let word = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(&pair).any(|(at, _)| {
        !code[..at].chars().next_back().is_some_and(word) && !code[at + pair.len()..].chars().next().is_some_and(word)
    })
}

/// Groups of files that can reach each other, each sorted, in order.
fn circles(all: &Crate) -> Vec<Vec<String>> {
    let edges = all.edges();
    let reach: BTreeMap<&str, BTreeSet<&str>> = edges
        .keys()
        .map(|&start| {
            let (mut seen, mut open) = (BTreeSet::new(), vec![start]);
            while let Some(file) = open.pop() {
                open.extend(edges.get(file).into_iter().flatten().filter(|&&next| seen.insert(next)));
            }
            (start, seen)
        })
        .collect();
    let mut found = BTreeSet::new();
    for (&file, seen) in reach.iter().filter(|(file, seen)| seen.contains(*file)) {
        let group = seen.iter().filter(|&other| reach[other].contains(file)).map(|&other| other.to_owned());
        found.insert(group.collect::<Vec<String>>());
    }
    found.into_iter().collect()
}
