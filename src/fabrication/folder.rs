//! Puts a set of files on the disk as one folder: it is there whole, or not at all.

use super::{ExportError, File, MANIFEST, Manifest};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes the files to a new folder beside `dir`, flushes them, and gives the folder its name. A failure or a crash
/// before that leaves `dir` as it was.
pub(super) fn write(dir: &Path, files: &[File]) -> Result<(), ExportError> {
    let failed = |source| ExportError::Write { path: dir.into(), source };
    // A link stays a link: the folder it points to is replaced.
    let dir = fs::canonicalize(dir).unwrap_or_else(|_| dir.to_path_buf());
    let earlier = earlier_export(&dir)?;
    let parent = match dir.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    };
    fs::create_dir_all(&parent).map_err(failed)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".plushwright-").suffix(".tmp");
    // A temporary folder is private by default; a blueprint gets what the user's umask says.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
    let fresh = builder.tempdir_in(&parent).map_err(failed)?;
    for file in files {
        write_file(&fresh.path().join(file.name), &file.bytes).map_err(failed)?;
    }
    sync_folder(fresh.path());
    if earlier {
        replace(fresh.path(), &dir, &builder, &parent).map_err(failed)?;
    } else {
        fs::rename(fresh.path(), &dir).map_err(failed)?;
    }
    // It has its name now and is no longer temporary.
    let _ = fresh.keep();
    sync_folder(&parent);
    Ok(())
}

/// Whether something must make way for `dir`: an empty folder or an export of ours. Anything else is refused.
fn earlier_export(dir: &Path) -> Result<bool, ExportError> {
    let not_ours = |found: String| ExportError::NotOurs { path: dir.into(), found };
    let entries = match fs::read_dir(dir) {
        Ok(entries) => entries,
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(false),
        Err(e) if e.kind() == io::ErrorKind::NotADirectory => return Err(not_ours("a file".into())),
        Err(source) => return Err(ExportError::Write { path: dir.into(), source }),
    };
    let mut names = Vec::new();
    for entry in entries {
        let entry = entry.map_err(|source| ExportError::Write { path: dir.into(), source })?;
        names.push(entry.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    let listed: Vec<String> = fs::read(dir.join(MANIFEST))
        .ok()
        .and_then(|bytes| serde_json::from_slice::<Manifest>(&bytes).ok())
        .filter(|m| m.format.starts_with("plushwright-blueprint/"))
        .map(|m| m.files.into_iter().map(|f| f.name).chain([MANIFEST.to_string()]).collect())
        .unwrap_or_default();
    match names.into_iter().find(|name| !listed.contains(name)) {
        Some(stranger) => Err(not_ours(stranger)),
        None => Ok(true),
    }
}

/// Two renames: the old folder steps aside, the new one takes its name. If the second fails the old one comes back.
fn replace(fresh: &Path, dir: &Path, builder: &tempfile::Builder, parent: &Path) -> io::Result<()> {
    let aside = builder.tempdir_in(parent)?;
    let old = aside.path().join("old");
    fs::rename(dir, &old)?;
    if let Err(error) = fs::rename(fresh, dir) {
        if fs::rename(&old, dir).is_err() {
            // Better an untidy folder than a lost one.
            let _ = aside.keep();
        }
        return Err(error);
    }
    Ok(())
}

fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = fs::File::create_new(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Not every system can flush a folder; the files themselves are safe.
fn sync_folder(path: &Path) {
    #[cfg(unix)]
    if let Ok(folder) = fs::File::open(path) {
        let _ = folder.sync_all();
    }
    #[cfg(not(unix))]
    let _ = path;
}
