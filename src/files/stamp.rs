//! Whether a file is still what was read.

use super::read;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::io;
use std::path::Path;

/// A file's content by its SHA-256: times of change are too coarse, and tools set them back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stamp([u8; 32]);

impl Stamp {
    pub fn of(bytes: &[u8]) -> Self {
        Self(Sha256::digest(bytes).into())
    }

    /// Of the file of at most `most` bytes that is there now.
    ///
    /// # Errors
    /// Those of [`read`].
    pub fn at(path: &Path, most: u64) -> io::Result<Self> {
        read(path, most).map(|bytes| Self::of(&bytes))
    }

    /// Whether the file is still there as it was, or nothing is. What became a folder, a pipe or larger than `most` bytes is not.
    ///
    /// # Errors
    /// What the system says of a file that cannot be read.
    pub fn may_be_replaced(&self, path: &Path, most: u64) -> io::Result<bool> {
        use io::ErrorKind::{FileTooLarge, InvalidInput, IsADirectory, NotFound};
        match Self::at(path, most) {
            Ok(now) => Ok(now == *self),
            Err(error) if error.kind() == NotFound => Ok(true),
            Err(error) if matches!(error.kind(), FileTooLarge | IsADirectory | InvalidInput) => Ok(false),
            Err(error) => Err(error),
        }
    }
}

/// SHA-256 in lower-case hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_file_a_folder_and_a_large_one_are_changes_and_nothing_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let stamp = Stamp::of(b"old");
        let may = || stamp.may_be_replaced(&path, 3).unwrap();
        assert!(may());
        for (bytes, same) in [(&b"old"[..], true), (b"new", false), (b"older", false)] {
            std::fs::write(&path, bytes).unwrap();
            assert_eq!(may(), same);
        }
        std::fs::remove_file(&path).unwrap();
        std::fs::create_dir(&path).unwrap();
        assert!(!may());
    }
}
