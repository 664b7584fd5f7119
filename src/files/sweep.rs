//! What a killed process left behind is cleared away by the next one that writes in the same folder.
//!
//! Everything temporary is held locked while it is in use, and the system lets go of a lock when its process ends, however it ends: a
//! name of ours that is not locked belongs to nobody.

use std::fs::{self, File};
use std::path::Path;

pub(super) const PREFIX: &str = ".plushwright-";
pub(super) const SUFFIX: &str = ".tmp";
/// Letters between the two.
const LETTERS: usize = 6;

/// Removes temporary files and folders of ours that nobody holds. What cannot be removed stays: the next one tries again.
pub(super) fn sweep(folder: &Path) {
    // Elsewhere a lock may keep others from reading, and these systems remove what is open no more.
    if !cfg!(unix) {
        return;
    }
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if !entry.file_name().to_str().is_some_and(is_ours) {
            continue;
        }
        let path = entry.path();
        let Ok(kind) = entry.file_type() else { continue };
        if !(kind.is_file() || kind.is_dir()) {
            continue;
        }
        let Ok(file) = File::open(&path) else { continue };
        if file.try_lock().is_ok() {
            let _ = if kind.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
        }
    }
}

fn is_ours(name: &str) -> bool {
    let letters = name.strip_prefix(PREFIX).and_then(|rest| rest.strip_suffix(SUFFIX));
    letters.is_some_and(|letters| letters.len() == LETTERS && letters.bytes().all(|b| b.is_ascii_alphanumeric()))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn what_nobody_holds_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let others =
            [".plushwright-abc.tmp", ".plushwright-abcdef", "plushwright-abcdef.tmp", ".plushwright-ab.def.tmp"];
        for name in others.into_iter().chain([".plushwright-abcdef.tmp", ".plushwright-held00.tmp"]) {
            fs::write(at(name), "x").unwrap();
        }
        fs::create_dir(at(".plushwright-folder.tmp")).unwrap();
        fs::write(at(".plushwright-folder.tmp/a"), "x").unwrap();
        let held = File::open(at(".plushwright-held00.tmp")).unwrap();
        held.try_lock().unwrap();
        sweep(folder.path());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), others.len() + 1);
        drop(held);
        sweep(folder.path());
        assert!(others.iter().all(|name| at(name).exists()));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), others.len());
    }
}
