//! The texts of the window are in the tables of its languages, all of them and no others, and none is shown past them.
//!
//! The sources are read as tokens: a literal is a text where it stands in `t`, `mark`, `tf!` or `tn!`, in the table of commands or in an
//! entry of a tool or a panel. Every other literal that has letters must be one of the things below that nobody reads.

use crate::support::sources::{Literal, literals};
use plushwright::motion::families;
use plushwright::physics::{Kind, MaterialKind, TermKind};
use plushwright::studio::commands;
use plushwright::studio::language::{ALL, Language};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Files that put no words into the window, and why.
const SILENT: [&str; 9] = [
    "studio/adapter.rs",           // the log of the program
    "studio/controls.rs",          // what a driven window tells programs
    "studio/keeper.rs",            // names of files
    "studio/language.rs",          // the tables themselves
    "studio/measure.rs",           // the table of the study on the terminal
    "studio/offscreen.rs",         // labels of the graphics adapter
    "studio/viewport/renderer.rs", // the same
    "studio/viewport/skin.rs",     // the same
    "studio/mod.rs",               // why there is no window, on the terminal
];
/// Calls whose literals nobody reads: identifiers of widgets, files and the system.
const NAMES: [&str; 16] = [
    "cfg",
    "concat",
    "folder",
    "from_id_salt",
    "has",
    "id_salt",
    "include_bytes",
    "include_str",
    "join",
    "load_texture",
    "prefix",
    "unique",
    "var_os",
    "with",
    "with_extension",
    "Grid::new",
];
/// Literals that are the same in every language, or are no words of the window.
const SAME: [&str; 25] = [
    "Plushwright",
    "Plushwright - {}{mark}",
    // Content of documents, which go from hand to hand.
    "Plushie",
    "Cushion",
    "Pose {}",
    // Names of files.
    "plush",
    "gif",
    "html",
    "plushie",
    "texture.png",
    "plushwright-",
    "import.plush",
    "settings.ron",
    "work",
    "open",
    "{}.plush",
    "{}-blueprint",
    // Identifiers.
    "layer.{name}",
    "look.{}",
    "language.{}",
    "canvas that was clicked last",
    "onion skins",
    // Put together of translated texts by the table of commands.
    "Panel {}",
    "Language of the window: {name}",
    // A key.
    "Cmd+",
];
/// Words of figures that are the same in every language.
const UNITS: [&str; 13] = ["N", "Hz", "N/mm", "baud", "mA", "mm", "ms", "px", "s", "x", "y", "µs", "e"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// The texts of the window that stand in its sources.
fn studio() -> Vec<(String, Literal)> {
    let mut files = Vec::new();
    below(&root().join("src/studio"), &mut files);
    files.sort();
    let name = |file: &Path| file.strip_prefix(root().join("src")).unwrap().to_string_lossy().replace('\\', "/");
    let heard = files
        .iter()
        .map(|file| (name(file), file))
        .filter(|(name, _)| !name.ends_with("tests.rs") && !SILENT.contains(&name.as_str()));
    heard
        .flat_map(|(name, file)| {
            literals(&fs::read_to_string(file).unwrap()).into_iter().map(move |l| (name.clone(), l))
        })
        .collect()
}

fn below(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            below(&path, files);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
}

/// Texts of the core that the window shows in its language: labels of its catalogues.
fn of_the_core() -> BTreeSet<String> {
    let mut texts = BTreeSet::new();
    let own = |command: &&commands::Command| !command.id.starts_with("language.") || command.id == "language.system";
    texts.extend(commands::all().filter(own).flat_map(|command| [command.label, command.tip]).map(str::to_owned));
    let materials = MaterialKind::all().iter().map(|kind| (vec![kind.label], kind.parameters));
    let terms = TermKind::all().iter().map(|kind| (vec![kind.label, kind.tip], kind.parameters));
    for (labels, parameters) in materials.chain(terms) {
        texts.extend(labels.into_iter().map(str::to_owned));
        texts.extend(parameters.iter().flat_map(|p| [p.label, p.tip]).map(str::to_owned));
    }
    texts.extend(families::ALL.iter().map(|family| family.title.to_owned()));
    let read = |file: &str| literals(&fs::read_to_string(root().join("src").join(file)).unwrap());
    let labels = |file: &str, function: &str| {
        let found = read(file).into_iter().filter(|literal| literal.function == function);
        found.map(|literal| literal.text).collect::<Vec<_>>()
    };
    texts.extend(labels("operations/network/mod.rs", "label"));
    texts.extend(labels("outline/drawing/primitive.rs", "name"));
    let mut looks = Vec::new();
    below(&root().join("src/picture/layers/looks"), &mut looks);
    for file in looks {
        let is_title =
            |literal: &Literal| ["Bar::rising", "Bar::ratio"].contains(&literal.call.as_str()) && literal.at == 0;
        let found = literals(&fs::read_to_string(file).unwrap()).into_iter().filter(is_title);
        texts.extend(found.map(|literal| literal.text));
    }
    texts
}

/// Whether a literal stands where the window takes its texts from.
fn is_text(literal: &Literal) -> bool {
    match literal.call.as_str() {
        "t" | "language::t" | "mark" => true,
        "tf!" => literal.at == 0,
        "tn!" => true,
        "Command::new" => literal.at > 0,
        _ => ["label", "tip", "hint"].contains(&literal.field.as_str()) || literal.field == "face_on",
    }
}

fn used() -> BTreeSet<String> {
    let said = studio().into_iter().filter(|(_, literal)| is_text(literal)).map(|(_, literal)| literal.text);
    said.chain(of_the_core()).collect()
}

fn table(language: &Language) -> BTreeMap<&str, &str> {
    language.texts().collect()
}

/// Places for values, in order of their names: `{count}`, `{mm:.1}`.
fn places(text: &str) -> Vec<&str> {
    let mut found: Vec<&str> = text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0)).collect();
    found.sort_unstable();
    found
}

#[test]
fn every_text_of_the_window_is_in_every_language_and_none_is_there_in_vain() {
    let used = used();
    assert!(used.len() > 1000, "only {} texts were found", used.len());
    for language in &ALL[1..] {
        let table = table(language);
        let missing: Vec<_> = used.iter().filter(|text| !table.contains_key(text.as_str())).collect();
        let idle: Vec<_> = table.keys().filter(|text| !used.contains(**text)).collect();
        assert!(missing.is_empty(), "{} lacks:\n{missing:#?}", language.name);
        assert!(idle.is_empty(), "{} has texts that nothing shows:\n{idle:#?}", language.name);
    }
}

#[test]
fn values_have_the_same_places_in_every_language() {
    for language in &ALL[1..] {
        for (english, own) in table(language) {
            assert_eq!(places(english), places(own), "{english}");
            let names = |place: &&str| {
                let (name, decimals) = place.split_once(":.").unwrap_or((place, "0"));
                !name.contains(':') && !name.is_empty() && decimals.parse::<usize>().is_ok()
            };
            // What `fill` understands.
            assert!(places(own).iter().all(names), "{english}");
            let ends = |text: &str| [text.starts_with(char::is_whitespace), text.ends_with(char::is_whitespace)];
            assert_eq!(ends(english), ends(own), "{english}");
        }
    }
}

/// `“Height” sets another height` speaks of a control that has that name in every language.
#[test]
fn texts_call_other_texts_what_they_are_called() {
    for language in &ALL[1..] {
        let table = table(language);
        for (english, own) in &table {
            for quoted in english.split('“').skip(1).filter_map(|rest| Some(rest.split_once('”')?.0)) {
                if let Some(name) = table.get(quoted) {
                    assert!(own.contains(name), "{english}: “{quoted}” is called {name}");
                }
            }
        }
    }
}

#[test]
fn no_words_are_shown_past_the_tables() {
    let mut past = Vec::new();
    for (file, literal) in studio().into_iter().filter(|(_, literal)| !is_text(literal)) {
        let call = literal.call.trim_end_matches('!');
        let named = NAMES.contains(&call) || NAMES.contains(&call.rsplit("::").next().unwrap_or(call));
        let of_panel = ["top", "bottom", "left", "right"].iter().any(|side| call == format!("Panel::{side}"));
        let is_id = literal.field == "id" || call == "Command::new" || is_dotted(&literal.text);
        if !(named || of_panel || is_id || SAME.contains(&literal.text.as_str()) || is_figure(&literal.text)) {
            past.push(format!("{file}: {:?} in `{}`", literal.text, literal.call));
        }
    }
    assert!(past.is_empty(), "not in `t`, `mark`, `tf!` or `tn!`:\n{}", past.join("\n"));
}

/// `tool.drag`, `.svg`: what stands for something in code.
fn is_dotted(text: &str) -> bool {
    let plain = |part: &str| part.chars().all(|c| c.is_ascii_lowercase() || c == '-');
    text.contains('.') && text.split('.').all(plain)
}

/// Values, signs and units alone.
fn is_figure(text: &str) -> bool {
    let mut bare = String::new();
    let mut depth = 0;
    for c in text.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ if depth == 0 => bare.push(if c.is_alphabetic() || c == '/' { c } else { ' ' }),
            _ => {}
        }
    }
    bare.split_whitespace().all(|word| UNITS.contains(&word) || !word.contains(char::is_alphabetic))
}

#[test]
fn a_locale_is_a_language() {
    for (locale, code) in
        [("de", "de"), ("de_AT.UTF-8", "de"), ("de-CH", "de"), ("DE_de@euro", "de"), ("en_GB", "en"), ("C.UTF-8", "en")]
    {
        assert_eq!(Language::of(locale).map(|language| language.code), Some(code), "{locale}");
    }
    for locale in ["", "fr_FR.UTF-8", "deu"] {
        assert_eq!(Language::of(locale), None, "{locale}");
    }
}
