//! A set of files on the disk as one folder: it is there whole, or not at all.
//!
//! A folder that stands in the place is exchanged in one step where the system can (Linux), never removed before the new one has its
//! name. It must be an earlier result of the same kind, which its manifest proves: that names every file in it, with its checksum.
//! Anything else that is in there, or was changed by hand, is somebody's work, and the folder is refused.

use super::paths::{parent, sync_folder, temporary};
use super::stamp::sha256;
use super::{place, read, signals, sweep};
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use thiserror::Error;

/// Name of the list of files, by which a folder is known as an earlier result.
pub const MANIFEST: &str = "manifest.json";
/// Largest manifest that is read, bytes: a hundred thousand files.
const MOST_MANIFEST: u64 = 16 << 20;
/// How often a place is looked at anew that others change at the same time.
const TRIES: usize = 5;

/// The contents of a folder of ours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// The maker of the folder, and the version of its format: `plushwright-bench/1`.
    pub format: String,
    /// Every file but the manifest itself.
    pub files: Vec<Listed>,
}

/// A file of a folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Listed {
    /// Path below the folder, with `/`.
    pub name: String,
    pub bytes: u64,
    /// Lower-case hexadecimal.
    pub sha256: String,
}

/// Why a folder was not written.
#[derive(Debug, Error)]
pub enum FolderError {
    #[error(
        "{} exists and is not an earlier result of the same kind ({found:?} is in it): choose another folder",
        super::shown(path)
    )]
    NotOurs { path: PathBuf, found: String },
    #[error("{} exists and {name:?} in it was changed by hand: choose another folder", super::shown(path))]
    Changed { path: PathBuf, name: String },
    #[error("cannot write {}: {source}", super::shown(path))]
    Write { path: PathBuf, source: io::Error },
}

impl Listed {
    pub fn of(name: &str, bytes: &[u8]) -> Self {
        Self { name: name.into(), bytes: bytes.len() as u64, sha256: sha256(bytes) }
    }
}

impl Manifest {
    pub fn of<'a>(format: &str, files: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> Self {
        Self { format: format.into(), files: files.into_iter().map(|(name, bytes)| Listed::of(name, bytes)).collect() }
    }
}

/// Writes a folder of files (path below the folder, content), one of which is the [`MANIFEST`] that names the others. `format` is what
/// the manifest of an earlier result that may make way begins with, up to the version: `plushwright-bench/`.
///
/// # Errors
/// Something else stands in the place; what the system says. The place is as it was before then.
pub fn write(dir: &Path, format: &str, files: &[(&str, &[u8])]) -> Result<(), FolderError> {
    let _writing = signals::writing();
    let failed = |source| FolderError::Write { path: dir.into(), source };
    // A link stays a link: the folder that it leads to is exchanged.
    let place = fs::canonicalize(dir).or_else(|_| place::end_of_links(dir)).map_err(failed)?;
    check(dir, format)?;
    let made = make_folders(parent(&place)).map_err(failed)?;
    let done = fill_and_name(dir, &place, format, files);
    if done.is_err() {
        made.iter().rev().for_each(|folder| drop(fs::remove_dir(folder)));
    }
    done
}

/// Whether something stands in the place of a folder that must make way for it: an empty folder or an earlier result.
///
/// # Errors
/// It is neither.
pub fn check(dir: &Path, format: &str) -> Result<bool, FolderError> {
    let failed = |source| FolderError::Write { path: dir.into(), source };
    let not_ours = |found: &str| FolderError::NotOurs { path: dir.into(), found: found.into() };
    match fs::metadata(dir) {
        Ok(found) if found.is_dir() => {}
        Ok(_) => return Err(not_ours("a file")),
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => return Err(not_ours("a file")),
        Err(error) => return Err(failed(error)),
    }
    let manifest = read(&dir.join(MANIFEST), MOST_MANIFEST).ok();
    let manifest = manifest.and_then(|bytes| serde_json::from_slice::<Manifest>(&bytes).ok());
    let listed = manifest.filter(|m| m.format.starts_with(format)).map(|m| m.files);
    let known = listed.is_some();
    let listed = listed.unwrap_or_default();
    let mut names = Vec::new();
    contents(dir, "", &listed, &mut names).map_err(failed)?;
    names.sort();
    for name in names {
        if known && name == MANIFEST {
            continue;
        }
        let Some(file) = listed.iter().find(|file| file.name == name) else { return Err(not_ours(&name)) };
        let is_same = || read(&dir.join(&name), file.bytes).is_ok_and(|bytes| sha256(&bytes) == file.sha256);
        if !is_same() {
            return Err(FolderError::Changed { path: dir.into(), name });
        }
    }
    Ok(true)
}

/// The names below a folder; of folders below it only those are entered that a listed file is in.
fn contents(dir: &Path, below: &str, listed: &[Listed], names: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(dir)? {
        let entry = entry?;
        let name = format!("{below}{}", entry.file_name().to_string_lossy());
        let inside = format!("{name}/");
        if entry.file_type()?.is_dir() && listed.iter().any(|file| file.name.starts_with(&inside)) {
            contents(&entry.path(), &inside, listed, names)?;
        } else {
            names.push(name);
        }
    }
    Ok(())
}

/// Makes the folders that lead to a place; those that were missing, the uppermost first.
fn make_folders(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let missing: Vec<PathBuf> =
        folder.ancestors().take_while(|folder| !folder.exists()).map(Path::to_path_buf).collect();
    fs::create_dir_all(folder)?;
    Ok(missing.into_iter().rev().collect())
}

fn fill_and_name(dir: &Path, place: &Path, format: &str, files: &[(&str, &[u8])]) -> Result<(), FolderError> {
    let failed = |source| FolderError::Write { path: dir.into(), source };
    sweep::sweep(parent(place));
    let (fresh, _held) = fresh_beside(place).map_err(failed)?;
    for (name, bytes) in files {
        write_new(&fresh.path().join(name), bytes).map_err(failed)?;
    }
    sync_folder(fresh.path());
    for _ in 0..TRIES {
        if check(dir, format)? {
            become_like(fresh.path(), place).map_err(failed)?;
            // Nobody else takes it for one that was left behind while it has the temporary name.
            let _old = File::open(place).ok().filter(|old| old.try_lock().is_ok());
            exchange(fresh.path(), place).map_err(failed)?;
            // Somebody may have put something into the old one in the last moment.
            if let Err(error) = check(fresh.path(), format) {
                put_back(fresh, place, exchange).map_err(failed)?;
                return Err(match error {
                    FolderError::NotOurs { found, .. } => FolderError::NotOurs { path: dir.into(), found },
                    FolderError::Changed { name, .. } => FolderError::Changed { path: dir.into(), name },
                    FolderError::Write { source, .. } => failed(source),
                });
            }
            // The old one has the temporary name now, and goes with it.
            drop(fresh);
            sync_folder(parent(place));
            return Ok(());
        }
        match fs::rename(fresh.path(), place) {
            Ok(()) => {
                // It has its name and is no longer temporary.
                let _ = fresh.keep();
                sync_folder(parent(place));
                return Ok(());
            }
            // Another process was faster; its folder is looked at.
            Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => {}
            Err(error) => return Err(failed(error)),
        }
    }
    Err(failed(io::Error::other("others keep changing it")))
}

/// Gives the old folder, which has the temporary name, its place again. Where that cannot be done it stays beside the place under a name
/// that anybody understands: `NAME.old-...`.
fn put_back(old: TempDir, place: &Path, exchange: impl Fn(&Path, &Path) -> io::Result<()>) -> io::Result<()> {
    let Err(error) = exchange(old.path(), place) else { return Ok(()) };
    // Nothing here removes it any more, and nothing later what has no temporary name.
    let old = old.keep();
    let into = |(aside, kept): (TempDir, PathBuf)| {
        fs::rename(&old, &kept)?;
        let _ = aside.keep();
        Ok(kept)
    };
    let kept = aside(place).and_then(into).unwrap_or_else(|_| old.clone());
    Err(io::Error::new(error.kind(), format!("{error}; what was there is in {}", super::shown(&kept))))
}

/// A new folder beside a place, held so that nobody takes it for one that was left behind.
fn fresh_beside(place: &Path) -> io::Result<(TempDir, Option<File>)> {
    #[cfg_attr(not(unix), allow(unused_mut))]
    let mut builder = temporary();
    // A temporary folder is private by default; a result gets what the user's umask says.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
    // Without the temporary name that the error states.
    let make = || builder.tempdir_in(parent(place)).map_err(|error| io::Error::from(error.kind()));
    let mut fresh = make()?;
    for _ in 0..TRIES {
        let held = File::open(fresh.path()).ok().filter(|file| file.try_lock().is_ok());
        if fresh.path().exists() {
            return Ok((fresh, held));
        }
        fresh = make()?;
    }
    Err(io::Error::other("others keep changing it"))
}

fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if let Some(folder) = path.parent().filter(|folder| !folder.exists()) {
        fs::create_dir_all(folder)?;
    }
    let mut file = File::create_new(path)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    sync_folder(parent(path));
    Ok(())
}

fn become_like(fresh: &Path, old: &Path) -> io::Result<()> {
    let found = fs::metadata(old)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, chown};
        let new = fs::metadata(fresh)?;
        if (new.uid(), new.gid()) != (found.uid(), found.gid()) {
            chown(fresh, Some(found.uid()), Some(found.gid()))?;
        }
    }
    fs::set_permissions(fresh, found.permissions())
}

/// Two folders change places.
fn exchange(fresh: &Path, place: &Path) -> io::Result<()> {
    #[cfg(target_os = "linux")]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        use rustix::io::Errno;
        match renameat_with(CWD, fresh, CWD, place, RenameFlags::EXCHANGE) {
            Ok(()) => return Ok(()),
            // A file system or an old system without it.
            Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => {}
            Err(error) => return Err(error.into()),
        }
    }
    exchange_in_steps(fresh, place)
}

/// The exchange in three steps, each taken back where the next fails. Between the first two the old folder stands beside its place under a
/// name that anybody understands: `NAME.old-...`.
fn exchange_in_steps(fresh: &Path, place: &Path) -> io::Result<()> {
    let (aside, old) = aside(place)?;
    fs::rename(place, &old)?;
    if let Err(error) = fs::rename(fresh, place) {
        if fs::rename(&old, place).is_err() {
            // Better an untidy folder than a lost one.
            let _ = aside.keep();
        }
        return Err(error);
    }
    if fs::rename(&old, fresh).is_err() {
        let _ = aside.keep();
    }
    Ok(())
}

/// A folder beside a place for what stands there, and the path that it gets in it.
fn aside(place: &Path) -> io::Result<(TempDir, PathBuf)> {
    let name = place.file_name().unwrap_or_default();
    let prefix = format!("{}.old-", name.to_string_lossy());
    let aside = tempfile::Builder::new().prefix(&prefix).tempdir_in(parent(place))?;
    let path = aside.path().join(name);
    Ok((aside, path))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORMAT: &str = "plushwright-test/";

    fn put(dir: &Path, files: &[(&str, &str)]) -> Result<(), FolderError> {
        let files: Vec<(&str, &[u8])> = files.iter().map(|&(name, text)| (name, text.as_bytes())).collect();
        let manifest = serde_json::to_vec(&Manifest::of("plushwright-test/1", files.iter().copied())).unwrap();
        write(dir, FORMAT, &[files, vec![(MANIFEST, &manifest[..])]].concat())
    }

    #[test]
    fn a_folder_is_exchanged_and_one_with_anything_else_in_it_refused() {
        let folder = tempfile::tempdir().unwrap();
        let dir = folder.path().join("new/result");
        put(&dir, &[("a", "1"), ("sub/b", "2")]).unwrap();
        put(&dir, &[("a", "3")]).unwrap();
        assert_eq!(fs::read(dir.join("a")).unwrap(), b"3");
        assert!(!dir.join("sub").exists());
        put(&dir, &[("a", "1"), ("sub/b", "2")]).unwrap();
        for stranger in ["notes", "sub/notes"] {
            fs::write(dir.join(stranger), "mine").unwrap();
            let refused = put(&dir, &[("a", "4")]).unwrap_err();
            assert!(matches!(&refused, FolderError::NotOurs { found, .. } if found == stranger), "{refused}");
            fs::remove_file(dir.join(stranger)).unwrap();
        }
        fs::write(dir.join("sub/b"), "5").unwrap();
        let refused = put(&dir, &[("a", "4")]).unwrap_err();
        assert!(matches!(&refused, FolderError::Changed { name, .. } if name == "sub/b"), "{refused}");
        assert_eq!(fs::read(dir.join("a")).unwrap(), b"1");
        // Of another kind: its manifest does not count.
        assert!(check(&dir, "plushwright-other/").is_err());
        assert_eq!(fs::read_dir(folder.path().join("new")).unwrap().count(), 1);
        // What was made on the way to a refusal is gone.
        assert!(put(&folder.path().join("x/y"), &[("a", "1"), ("a", "1")]).is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn an_old_folder_that_cannot_be_put_back_stays_beside_its_place() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("result");
        fs::create_dir(&place).unwrap();
        fs::write(place.join("new"), "ours").unwrap();
        let (old, held) = fresh_beside(&place).unwrap();
        fs::write(old.path().join("notes"), "mine").unwrap();
        let refused = |_: &Path, _: &Path| Err(io::Error::from(io::ErrorKind::PermissionDenied));
        let error = put_back(old, &place, refused).unwrap_err();
        drop(held);
        // Whoever writes there next clears away what is temporary.
        sweep::sweep(folder.path());
        let names = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().path());
        let aside: Vec<PathBuf> = names.filter(|path| *path != place).collect();
        assert!(matches!(&aside[..], [aside] if aside.to_string_lossy().contains("result.old-")), "{aside:?}");
        let kept = aside[0].join("result");
        assert_eq!(fs::read_to_string(kept.join("notes")).unwrap(), "mine");
        assert!(error.to_string().contains(kept.to_str().unwrap()) && place.join("new").exists(), "{error}");
    }

    #[test]
    fn without_an_exchange_in_one_step_the_folders_still_change_places() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        for dir in [&a, &b] {
            fs::create_dir(dir).unwrap();
            fs::write(dir.join("name"), dir.to_str().unwrap()).unwrap();
        }
        exchange_in_steps(&a, &b).unwrap();
        assert_eq!(fs::read_to_string(a.join("name")).unwrap(), b.to_str().unwrap());
        assert_eq!(fs::read_to_string(b.join("name")).unwrap(), a.to_str().unwrap());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
        exchange(&a, &b).unwrap();
        assert_eq!(fs::read_to_string(a.join("name")).unwrap(), a.to_str().unwrap());
    }
}
