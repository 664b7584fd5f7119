//! What a word or a file on the command line may have been meant for, where it is not what is wanted.

use crate::design::file::is_design;
use crate::files::{self, shown};
use crate::outline::{MAX_FILE_BYTES, readers};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

/// Least similarity (Jaro and Winkler, 0 to 1) at which a word is taken for a mistyped other one: `nwe` and `new` have 0.80, `wave` and
/// `leg` 0.
const LIKE: f64 = 0.78;
/// Most files of a folder that are compared with a name.
const MOST_FILES: usize = 10_000;
/// Words that people try, and the commands that do it.
const OTHER_WORDS: [(&str, &str); 22] = [
    ("animate", "key"),
    ("blueprint", "export"),
    ("build", "export"),
    ("completion", "completions"),
    ("create", "new"),
    ("draw", "render"),
    ("import", "new"),
    ("info", "check"),
    ("init", "new"),
    ("list", "network list"),
    ("make", "new"),
    ("manual", "man"),
    ("picture", "render"),
    ("print", "export"),
    ("refine", "remesh"),
    ("show", "render"),
    ("simulate", "check"),
    ("status", "check"),
    ("target", "pose"),
    ("tendon", "network"),
    ("timeline", "key"),
    ("winch", "network"),
];

/// The one of `known` that a word is most like, if it is like any.
pub fn closest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    let rated = known.into_iter().map(|name| (name, strsim::jaro_winkler(&word, &name.to_lowercase())));
    let rated = rated.filter(|(name, rate)| *rate >= LIKE || strsim::osa_distance(&word, name) <= 1);
    // Of equal ones the first, whatever the order of comparison.
    rated.fold(None, |best: Option<(&str, f64)>, one| best.filter(|b| b.1 >= one.1).or(Some(one))).map(|(name, _)| name)
}

/// The command that a word may have been meant for.
pub fn command<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let other = OTHER_WORDS.iter().find(|(other, _)| word.eq_ignore_ascii_case(other)).map(|&(_, command)| command);
    other.or_else(|| closest(word, known))
}

/// `did you mean ...?`, where something beside `path` is called much like it, and nothing is called so.
pub fn like(path: &Path) -> Option<String> {
    if path.exists() {
        return None;
    }
    let wanted = path.file_name()?.to_str()?;
    let entries = fs::read_dir(files::parent(path)).ok()?.flatten().take(MOST_FILES);
    let mut names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    // The ending says what it is: another one is another file.
    let ending = |name: &str| Path::new(name).extension().map(OsStr::to_ascii_lowercase);
    let alike = names.iter().map(String::as_str).filter(|name| ending(name) == ending(wanted));
    let found = closest(wanted, alike)?;
    Some(format!("did you mean {}?", shown(&path.with_file_name(found))))
}

/// What to do with a file that is no design where one is wanted; none where nothing better than its own fault can be said.
pub fn instead_of_design(path: &Path) -> Option<String> {
    let name = shown(path);
    if path.is_dir() {
        return design_in(path).map(|design| format!("did you mean {design}?"));
    }
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("plush")) {
        return None;
    }
    let bytes = files::read(path, MAX_FILE_BYTES as u64).ok()?;
    if let Some(command) = answers(&bytes) {
        return Some(format!("this is no design but a question in numbers; `plushwright {command} {name}` answers it"));
    }
    readers::reader_of(&bytes)?;
    let design = shown(&path.with_extension("plush"));
    Some(format!("this is an outline, no design; `plushwright new {name} -o {design}` makes one of it"))
}

/// What to do with a file that is a design where an outline is wanted.
pub fn instead_of_outline(path: &Path) -> Option<String> {
    let name = shown(path);
    is_design(path).then(|| {
        format!(
            "this is a design already; `plushwright {name}` opens it, `plushwright reshape {name} OUTLINE` gives it another outline"
        )
    })
}

/// What to do with a file that is a design where a question is wanted.
pub fn instead_of_question(path: &Path) -> Option<String> {
    let name = shown(path);
    is_design(path)
        .then(|| format!("this is a design, no question in numbers; `plushwright check {name}` says how good it is"))
}

/// The only design in a folder.
fn design_in(folder: &Path) -> Option<String> {
    let entries = fs::read_dir(folder).ok()?.flatten().take(MOST_FILES).map(|entry| entry.path());
    let mut designs = entries.filter(|path| path.extension().is_some_and(|ending| ending == "plush"));
    let only = designs.next()?;
    designs.next().is_none().then(|| shown(&only))
}

/// The command that answers a file of numbers.
fn answers(bytes: &[u8]) -> Option<&'static str> {
    /// Enough to read how a JSON file calls itself, bytes.
    const HEAD: usize = 4000;
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]);
    let says = |format: &str| head.contains(format);
    match () {
        () if says("plushwright-problem/") => Some("solve"),
        () if says("plushwright-network/") => Some("discover"),
        () => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistyped_word_is_known_and_another_word_is_not() {
        let known = ["new", "mesh", "remesh", "reshape", "render", "check", "key"];
        for (word, meant) in
            [("nwe", "new"), ("chekc", "check"), ("rendr", "render"), ("NEW", "new"), ("kay", "key"), ("import", "new")]
        {
            assert_eq!(command(word, known), Some(meant), "{word}");
        }
        assert_eq!(command("elephant", known), None);
    }

    #[test]
    fn a_mistyped_file_is_found_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("rabbit.svg"), "").unwrap();
        fs::write(folder.path().join("rabbit.plush"), "").unwrap();
        let asked = |name: &str| like(&folder.path().join(name));
        assert!(asked("rabit.svg").is_some_and(|text| text.ends_with("rabbit.svg?")));
        assert_eq!(asked("crane.svg"), None);
        assert_eq!(asked("rabbit.svg"), None);
    }
}
