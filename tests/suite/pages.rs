//! README and `docs/`: every block of commands runs, every link leads somewhere.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// README and all pages below `docs/`.
fn pages() -> Vec<PathBuf> {
    let mut pages = vec![root().join("README.md")];
    let mut folders = vec![root().join("docs")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    pages
}

/// The lines of all blocks that are marked `sh`, a search for networks cut to its first round: what it finds is tested elsewhere.
fn commands(text: &str) -> String {
    let mut lines = Vec::new();
    let mut inside = false;
    for line in text.lines() {
        match line.trim_end() {
            "```sh" => inside = true,
            "```" => inside = false,
            line if inside && line.starts_with("plushwright rig ") => {
                let (before, after) = line.split_once(" --rounds ").unwrap_or((line, ""));
                let after = after.split_once(' ').map_or("", |(_, after)| after);
                lines.push(format!("{before} --rounds 1 {after}"));
            }
            line if inside => lines.push(line.to_owned()),
            _ => {}
        }
    }
    lines.join("\n")
}

#[cfg(unix)]
#[test]
fn every_block_of_commands_runs() {
    use std::os::unix::fs::symlink;
    let mut ran = 0;
    for page in pages() {
        let lines = commands(&fs::read_to_string(&page).unwrap());
        if lines.is_empty() {
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("bin")).unwrap();
        symlink(env!("CARGO_BIN_EXE_plushwright"), at("bin/plushwright")).unwrap();
        for name in ["assets", "examples"] {
            symlink(root().join(name), at(name)).unwrap();
        }
        let path = format!("{}:{}", at("bin").display(), std::env::var("PATH").unwrap_or_default());
        let mut shell = Command::new("sh");
        shell.args(["-eu", "-c", &lines]).current_dir(folder.path()).env("PATH", path);
        let output = shell.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.is_empty(), "{}: {lines}\n{said}", page.display());
        ran += 1;
    }
    assert!(ran >= 4, "{ran} pages with commands");
}

/// The name by which a heading is linked to.
fn anchor(heading: &str) -> String {
    let kept = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

fn has_anchor(page: &Path, wanted: &str) -> bool {
    let text = fs::read_to_string(page).unwrap();
    text.lines().filter(|line| line.starts_with('#')).any(|line| anchor(line) == wanted)
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let mut wrong = Vec::new();
    for page in pages() {
        let text = fs::read_to_string(&page).unwrap();
        for (at, _) in text.match_indices("](") {
            let link = text[at + 2..].split(')').next().unwrap_or_default();
            if link.starts_with("http") {
                continue;
            }
            let (file, heading) = link.split_once('#').map_or((link, None), |(file, heading)| (file, Some(heading)));
            let target = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            let found = target.exists() && heading.is_none_or(|heading| has_anchor(&target, heading));
            if !found {
                wrong.push(format!("{}: {link}", page.strip_prefix(root()).unwrap().display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A word that means something special is explained in one place.
#[test]
fn the_glossary_is_sorted_into_one_table() {
    let text = fs::read_to_string(root().join("docs/glossary.md")).unwrap();
    let words: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("| **")?.split("**").next()).collect();
    assert!(words.len() > 40, "{}", words.len());
    let mut once = words.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), words.len());
}
