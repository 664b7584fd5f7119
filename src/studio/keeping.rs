//! The picture of an imported plushie, kept as its texture.
//!
//! Until the document is saved there is no folder for the picture to stand in beside it: it waits in a temporary one, which goes when
//! another document is opened or the window is closed. It is below the folder in which the window keeps its work, where it has one, so
//! that it is there still when that is recovered. Saving puts a copy beside the file, as `plushwright new --texture` does.

use crate::design::Design;
use crate::files;
use std::io;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// What the texture is called while it waits.
const NAME: &str = "texture.png";

/// A texture that was not saved with its document yet.
pub struct Kept(TempDir);

impl Kept {
    /// Puts a picture aside, and names it in the design.
    ///
    /// # Errors
    /// What the system says of a temporary file that cannot be written.
    pub fn new(design: &mut Design, png: &[u8], within: Option<&Path>) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix("plushwright-");
        let folder = within.map_or_else(|| builder.tempdir(), |within| builder.tempdir_in(within))?;
        files::write(&folder.path().join(NAME), png)?;
        design.texture = Some(NAME.to_owned());
        Ok(Self(folder))
    }

    /// Where the document might have been read from: what it names is found from there.
    pub fn origin(&self) -> PathBuf {
        self.0.path().join("import.plush")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{file, texture};
    use crate::studio::blank;
    use std::fs;

    #[test]
    fn the_picture_is_copied_beside_the_file_and_no_other_one_replaced() {
        let mut design = blank::design();
        let kept = Kept::new(&mut design, b"picture", None).unwrap();
        assert!(texture::find(&design, &kept.origin()).unwrap().unwrap().is_file());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pig.plush");
        fs::write(folder.path().join("pig.texture.png"), b"another").unwrap();
        for _ in 0..2 {
            file::save(&design, Some(kept.origin().as_path().into()), &path, None).unwrap();
            assert_eq!(file::read(&path).unwrap().texture.as_deref(), Some("pig.texture-2.png"));
        }
        assert_eq!(fs::read(folder.path().join("pig.texture.png")).unwrap(), b"another");
        assert_eq!(fs::read(folder.path().join("pig.texture-2.png")).unwrap(), b"picture");
        // A folder that goes with the window is no place for it, wherever that is.
        let home = folder.path().join("home.plush");
        let within = folder.path().join("state");
        fs::create_dir(&within).unwrap();
        let kept = Kept::new(&mut design, b"picture", Some(&within)).unwrap();
        let passing = texture::Origin { file: &kept.origin(), stays: false };
        file::save(&design, Some(passing), &home, None).unwrap();
        drop(kept);
        let saved = file::read(&home).unwrap();
        assert!(texture::find(&saved, &home).unwrap().unwrap().is_file());
        // A document that names something else keeps to it.
        design.texture = None;
        file::save(&design, Some(home.as_path().into()), &path, None).unwrap();
        assert_eq!(file::read(&path).unwrap().texture, None);
    }
}
