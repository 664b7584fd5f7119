//! The rooms of the crate and who may know whom.

use std::fs;
use std::path::{Path, PathBuf};

/// A source file: its path below `src/` and its text without comments.
struct Source {
    path: String,
    code: String,
}

impl Source {
    /// `mesh` for `mesh/generate.rs`, `defaults` for `defaults.rs`, `main` for `main.rs`.
    fn room(&self) -> &str {
        let first = self.path.split('/').next().unwrap_or_default();
        first.strip_suffix(".rs").unwrap_or(first)
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn sources() -> Vec<Source> {
    let mut found = Vec::new();
    collect(&root(), &mut found);
    found.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(found.len() > 20, "the sources were not found");
    found
}

fn collect(folder: &Path, found: &mut Vec<Source>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            let code = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>();
            let path = path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
            found.push(Source { path, code: code.join("\n") });
        }
    }
}

/// The rooms in the order of the table at the head of `lib.rs`.
fn rooms() -> Vec<String> {
    let text = fs::read_to_string(root().join("lib.rs")).unwrap();
    let row = |line: &str| Some(line.strip_prefix("//! | ")?.split('`').nth(1)?.to_owned());
    let rooms: Vec<String> = text.lines().filter_map(row).collect();
    for line in text.lines() {
        if let Some(module) = line.strip_prefix("pub mod ") {
            let module = module.trim_end_matches(';');
            assert!(rooms.iter().any(|room| room == module), "room `{module}` is missing in the table of lib.rs");
        }
    }
    rooms
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether `name` stands in `code` as a word of its own.
fn mentions(code: &str, name: &str) -> bool {
    code.match_indices(name).any(|(at, _)| {
        let before = code[..at].chars().next_back();
        let after = code[at + name.len()..].chars().next();
        !before.is_some_and(is_word) && !after.is_some_and(is_word)
    })
}

/// The first words of everything that is named by a path from the root of the crate, groups included.
fn named_rooms(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (at, prefix) in code.match_indices("crate::") {
        if code[..at].chars().next_back().is_some_and(is_word) {
            continue;
        }
        let rest = &code[at + prefix.len()..];
        let Some(group) = rest.strip_prefix('{') else {
            found.push(rest.chars().take_while(|&c| is_word(c)).collect());
            continue;
        };
        // `crate::{a, b::{c, d}}` names a and b.
        let (mut depth, mut word, mut heads) = (0, String::new(), true);
        for c in group.chars() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    found.push(std::mem::take(&mut word));
                    heads = true;
                }
                ':' if depth == 0 => heads = false,
                c if depth == 0 && heads && is_word(c) => word.push(c),
                _ => {}
            }
        }
        found.push(word);
    }
    found.retain(|name| !name.is_empty());
    found
}

#[test]
fn no_room_imports_from_one_further_down() {
    let rooms = rooms();
    let place = |name: &str| rooms.iter().position(|room| room == name);
    let mut wrong = Vec::new();
    for source in sources() {
        let Some(own) = place(source.room()) else { continue };
        for name in named_rooms(&source.code) {
            if place(&name).is_some_and(|other| other > own) {
                wrong.push(format!("src/{} imports from `{name}`, which is further down", source.path));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn two_files_name_the_sparse_linear_algebra() {
    let named: Vec<String> = sources().into_iter().filter(|s| mentions(&s.code, "faer")).map(|s| s.path).collect();
    assert_eq!(named, ["physics/cholesky.rs", "physics/indefinite.rs"]);
}

#[test]
fn only_the_studio_names_the_window() {
    const WINDOW: [&str; 7] = ["egui", "eframe", "egui_wgpu", "wgpu", "winit", "rfd", "bytemuck"];
    for source in sources().iter().filter(|s| s.room() != "studio") {
        for name in WINDOW {
            assert!(!mentions(&source.code, name), "src/{} names {name}", source.path);
        }
    }
}

#[test]
fn only_the_room_of_files_writes() {
    const WRITES: [&str; 9] = [
        "fs::write",
        "fs::rename",
        "fs::copy",
        "fs::hard_link",
        "File::create",
        "File::create_new",
        "remove_dir_all",
        "persist",
        "tempfile_in",
    ];
    // The window's own folder of state: locks in it, and what is not wanted any more.
    const STATE: [&str; 1] = ["studio/keeper.rs"];
    let others = |source: &Source| source.room() != "files" && !STATE.contains(&source.path.as_str());
    for source in sources().iter().filter(|source| others(source)) {
        // Tests stand last, and make what they need.
        let code = source.code.split("#[cfg(test)]").next().unwrap_or_default();
        for name in WRITES {
            assert!(!mentions(code, name), "src/{} has {name}: only `files` writes", source.path);
        }
    }
}

#[test]
fn only_the_commands_name_options_of_the_command_line() {
    let option = |code: &str| {
        code.match_indices("--").any(|(at, _)| {
            let before = code[..at].chars().next_back();
            let after = code[at + 2..].chars().next();
            after.is_some_and(|c| c.is_ascii_lowercase()) && before.is_some_and(|c| c != '-' && !is_word(c))
        })
    };
    assert!(option("\"; --holes fill makes\"") && option("\"--height\"") && !option("\"---x\"") && !option("a -- b"));
    for source in sources().iter().filter(|source| source.room() != "commands" && source.room() != "main") {
        let named: Vec<&str> = source.code.lines().filter(|line| option(line)).collect();
        assert!(named.is_empty(), "src/{} names an option of the command line: {named:?}", source.path);
        assert!(!source.code.contains("`plushwright "), "src/{} names a command", source.path);
    }
}

#[test]
fn only_the_room_of_files_asks_which_system_it_is_on() {
    // Whether there is a display, and what a key is called there; a port that is none, which only some systems have.
    const OWN: [&str; 6] = [
        "studio/mod.rs",
        "studio/session/files.rs",
        "studio/commands/command.rs",
        "commands/simulate_controller.rs",
        "live/mod.rs",
        "live/pseudo_terminal.rs",
    ];
    const SYSTEMS: [&str; 5] = ["cfg(unix", "cfg(windows", "cfg(target_os", "cfg!(target_os", "std::os::"];
    let others = |source: &Source| source.room() != "files" && !OWN.contains(&source.path.as_str());
    for source in sources().iter().filter(|source| others(source)) {
        let code = source.code.split("#[cfg(test)]").next().unwrap_or_default();
        let named: Vec<&&str> = SYSTEMS.iter().filter(|name| code.contains(**name)).collect();
        assert!(named.is_empty(), "src/{} has {named:?}: paths, files and signals are the room of files'", source.path);
    }
}

/// A file that grows beyond this many lines may hold two ideas. Worth a look, not a failure.
const LONG: usize = 400;

#[test]
fn long_files_are_pointed_out() {
    for source in sources() {
        let lines = source.code.lines().count();
        if lines > LONG {
            println!("warning: src/{} has {lines} lines (over {LONG})", source.path);
        }
    }
}

#[test]
fn paths_are_found_in_every_form() {
    let code =
        "use crate::mesh::Mesh; use crate::{outline, design::{self, Pin}, engine}; fn f(x: crate::picture::Scene)";
    let mut names = named_rooms(code);
    names.sort();
    assert_eq!(names, ["design", "engine", "mesh", "outline", "picture"]);
    assert!(mentions("use faer::x", "faer") && !mentions("faery", "faer"));
}
