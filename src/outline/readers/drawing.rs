//! A silhouette from a file of drawn parts.

use super::finish::finish;
use super::{OutlineReader, Painting, ReadingOption};
use crate::outline::{Drawing, Import, Imported, OutlineError};

pub(super) struct OfParts;

impl OutlineReader for OfParts {
    fn names(&self) -> [&'static str; 2] {
        ["a drawing of parts", "drawings of parts"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["ron"]
    }

    /// A parenthesis, and the first words.
    fn can_read(&self, bytes: &[u8]) -> bool {
        is_drawing(bytes)
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        Drawing::read(bytes)?.import(import)
    }
}

impl Drawing {
    /// One clean outline of what is drawn, and the drawing itself moved (and scaled, where a size is asked for) to where the
    /// outline is: with its lower left corner in the origin. Where that was is [`Imported::drawn_box`].
    ///
    /// # Errors
    /// As [`crate::outline::import()`]: nothing drawn, several pieces.
    pub fn import(&self, import: &Import) -> Result<Imported, OutlineError> {
        let mut imported = finish(self.painting()?, import)?;
        let [low, high] = imported.drawn_box;
        let (_, made) = imported.outline.bounding_box();
        let scale = if import.asks_size() { made[1] / (high[1] - low[1]) } else { 1.0 };
        imported.drawing = Some(self.moved(low.map(|v| -v)).scaled(scale));
        Ok(imported)
    }

    fn painting(&self) -> Result<Painting, OutlineError> {
        if self.parts.iter().all(|part| part.cut) {
            return Err(OutlineError::NothingPainted("the drawing has no part that is not cut out"));
        }
        let shapes = self.regions()?;
        if shapes.is_empty() {
            return Err(OutlineError::NothingPainted("all that is drawn is cut out again"));
        }
        Ok(Painting { shapes, unit_mm: 1.0, ..Painting::default() })
    }
}

/// Whether a file begins as drawings do: a parenthesis, and the first words.
fn is_drawing(bytes: &[u8]) -> bool {
    /// Comments may stand before the first words.
    const HEAD: usize = 4000;
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]);
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<String>();
    let code = code.trim_start_matches('\u{feff}').trim_start();
    code.strip_prefix("Drawing")
        .unwrap_or(code)
        .trim_start()
        .strip_prefix('(')
        .is_some_and(|inside| ["parts", "tracks"].iter().any(|name| inside.trim_start().starts_with(name)))
}
