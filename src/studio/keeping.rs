//! The picture of an imported plushie, kept as its texture.
//!
//! Until the document is saved there is no folder for the picture to stand in beside it: it waits in a temporary one, which goes when
//! another document is opened or the window is closed. Saving puts a copy beside the file, as `plushwright new --texture` does.

use crate::design::Design;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// What the texture is called while it waits.
const NAME: &str = "texture.png";
/// Names beside the file that are tried: what is there already and is another picture stays.
const MOST_NAMES: usize = 1000;

/// A texture that was not saved with its document yet.
pub struct Kept(TempDir);

impl Kept {
    /// Puts a picture aside, and names it in the design.
    ///
    /// # Errors
    /// What the system says of a temporary file that cannot be written.
    pub fn new(design: &mut Design, png: &[u8]) -> io::Result<Self> {
        let folder = tempfile::Builder::new().prefix("plushwright-").tempdir()?;
        fs::write(folder.path().join(NAME), png)?;
        design.texture = Some(NAME.to_owned());
        Ok(Self(folder))
    }

    /// Where the document might have been read from: what it names is found from there.
    pub fn origin(&self) -> PathBuf {
        self.0.path().join("import.plush")
    }

    /// The design as it is to be written to `path`, with a copy of its texture beside that: `NAME.texture.png`, or with a number where
    /// that is another picture.
    ///
    /// # Errors
    /// What the system says of a copy that cannot be made.
    pub fn beside(&self, design: &Design, path: &Path) -> io::Result<Design> {
        if design.texture.as_deref() != Some(NAME) {
            return Ok(design.clone());
        }
        let png = fs::read(self.0.path().join(NAME))?;
        for k in 1..=MOST_NAMES {
            let end = if k == 1 { "texture.png".to_owned() } else { format!("texture-{k}.png") };
            let copy = path.with_extension(end);
            let Some(name) = copy.file_name().and_then(|name| name.to_str()) else { break };
            match fs::read(&copy) {
                Ok(present) if present != png => continue,
                Ok(_) => {}
                Err(error) if error.kind() == io::ErrorKind::NotFound => fs::write(&copy, &png)?,
                Err(_) => continue,
            }
            return Ok(Design { texture: Some(name.to_owned()), ..design.clone() });
        }
        Err(io::Error::other(format!("no name for the texture beside {}", path.display())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::blank;

    #[test]
    fn the_picture_is_copied_beside_the_file_and_no_other_one_replaced() {
        let mut design = blank::design();
        let kept = Kept::new(&mut design, b"picture").unwrap();
        assert!(crate::design::file::texture_path(&design, &kept.origin()).unwrap().is_file());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pig.plush");
        fs::write(folder.path().join("pig.texture.png"), b"another").unwrap();
        for _ in 0..2 {
            let saved = kept.beside(&design, &path).unwrap();
            assert_eq!(saved.texture.as_deref(), Some("pig.texture-2.png"));
        }
        assert_eq!(fs::read(folder.path().join("pig.texture.png")).unwrap(), b"another");
        assert_eq!(fs::read(folder.path().join("pig.texture-2.png")).unwrap(), b"picture");
        // A document that names something else keeps to it.
        design.texture = None;
        assert_eq!(kept.beside(&design, &path).unwrap(), design);
    }
}
