//! Formats of pictures: what a file is called says which.

use super::error::CommandError;
use crate::files::{marked_jpeg, shown};
use crate::picture::film;
use image::codecs::jpeg::JpegEncoder;
use image::{DynamicImage, ImageError, ImageFormat};
use std::path::Path;
use std::time::Duration;

/// Quality of JPEG pictures, 1 to 100: edges of seams and cables stay crisp, at a third of the size of the best.
const JPEG_QUALITY: u8 = 90;

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    Png,
    Jpeg,
    /// The whole animation.
    Gif,
    /// A page that plays the whole animation.
    Page,
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
            Some("gif") => Ok(Self::Gif),
            Some("html" | "htm") => Ok(Self::Page),
            Some(_) => Err(CommandError::Usage(format!(
                "{} has the ending of no picture that is written: call it {}, *.jpg, or *.gif or *.html for the whole animation",
                shown(path),
                shown(&path.with_extension("png"))
            ))),
        }
    }

    /// A PNG in this format; a GIF of it stands still.
    pub fn encoded(self, png: Vec<u8>) -> Result<Vec<u8>, CommandError> {
        match self {
            Self::Png => Ok(png),
            Self::Page => Ok(film::page(&[png], Duration::ZERO, "").into_bytes()),
            Self::Gif => film::gif(&[png], Duration::ZERO).map_err(CommandError::Failed),
            Self::Jpeg => {
                let mut bytes = Vec::new();
                let encoder = JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY);
                decoded(&png)?.to_rgb8().write_with_encoder(encoder).map_err(failed)?;
                Ok(marked_jpeg(&bytes))
            }
        }
    }
}

fn decoded(png: &[u8]) -> Result<DynamicImage, CommandError> {
    image::load_from_memory_with_format(png, ImageFormat::Png).map_err(failed)
}

fn failed(error: ImageError) -> CommandError {
    CommandError::Failed(format!("cannot encode the picture: {error}"))
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
        assert!(of("a.bmp").unwrap_err().line().contains("a.png"));
    }
}
