//! Formats of pictures: what a file is called says which.

use super::error::CommandError;
use crate::files::{marked_jpeg, shown};
use image::codecs::jpeg::JpegEncoder;
use std::path::Path;

/// Quality of JPEG pictures, 1 to 100: edges of seams and cables stay crisp, at a third of the size of the best.
const JPEG_QUALITY: u8 = 90;

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    Png,
    Jpeg,
}

impl PictureFormat {
    /// That of a file's name; PNG where it has no ending.
    ///
    /// # Errors
    /// An ending of no format that is written.
    pub fn of(path: &Path) -> Result<Self, CommandError> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            None | Some("png") => Ok(Self::Png),
            Some("jpg" | "jpeg") => Ok(Self::Jpeg),
            Some(_) => Err(CommandError::Usage(format!(
                "{} has the ending of no picture that is written: call it {} or *.jpg",
                shown(path),
                shown(&path.with_extension("png"))
            ))),
        }
    }

    /// A PNG in this format.
    pub fn encoded(self, png: Vec<u8>) -> Result<Vec<u8>, CommandError> {
        if self == Self::Png {
            return Ok(png);
        }
        let failed = |error: image::ImageError| CommandError::Failed(format!("cannot encode the picture: {error}"));
        let picture = image::load_from_memory_with_format(&png, image::ImageFormat::Png).map_err(failed)?;
        let mut bytes = Vec::new();
        JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY).encode_image(&picture.to_rgb8()).map_err(failed)?;
        Ok(marked_jpeg(&bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_says_the_format() {
        let of = |name: &str| PictureFormat::of(Path::new(name));
        assert_eq!(of("a").unwrap(), PictureFormat::Png);
        assert_eq!(of("a.b/c.PNG").unwrap(), PictureFormat::Png);
        assert_eq!(of("a.JPEG").unwrap(), PictureFormat::Jpeg);
        assert!(of("a.gif").unwrap_err().line().contains("a.png"));
    }
}
