//! Formats of pictures: what a file is called says which.

use super::error::CommandError;
use crate::files::{marked_gif, marked_jpeg, shown};
use image::codecs::gif::{GifEncoder, Repeat};
use image::codecs::jpeg::JpegEncoder;
use image::{Delay, DynamicImage, Frame, ImageError, ImageFormat};
use std::path::Path;
use std::time::Duration;

/// Quality of JPEG pictures, 1 to 100: edges of seams and cables stay crisp, at a third of the size of the best.
const JPEG_QUALITY: u8 = 90;
/// Speed of the choice of colours for GIF, 1 (best) to 30: the pictures have few colours.
const GIF_SPEED: i32 = 10;

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    Png,
    Jpeg,
    /// The whole animation.
    Gif,
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
            Some(_) => Err(CommandError::Usage(format!(
                "{} has the ending of no picture that is written: call it {}, *.jpg, or *.gif for the whole animation",
                shown(path),
                shown(&path.with_extension("png"))
            ))),
        }
    }

    /// A PNG in this format; a GIF of it stands still.
    pub fn encoded(self, png: Vec<u8>) -> Result<Vec<u8>, CommandError> {
        match self {
            Self::Png => Ok(png),
            Self::Gif => moving(&[png], Duration::ZERO),
            Self::Jpeg => {
                let mut bytes = Vec::new();
                let encoder = JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY);
                decoded(&png)?.to_rgb8().write_with_encoder(encoder).map_err(failed)?;
                Ok(marked_jpeg(&bytes))
            }
        }
    }
}

/// PNGs one after the other as a GIF that begins anew for ever.
pub fn moving(pngs: &[Vec<u8>], step: Duration) -> Result<Vec<u8>, CommandError> {
    let mut bytes = Vec::new();
    let mut encoder = GifEncoder::new_with_speed(&mut bytes, GIF_SPEED);
    encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
    for png in pngs {
        let frame = Frame::from_parts(decoded(png)?.to_rgba8(), 0, 0, Delay::from_saturating_duration(step));
        encoder.encode_frame(frame).map_err(failed)?;
    }
    drop(encoder);
    Ok(marked_gif(&bytes))
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
    use crate::files::is_marked_gif;
    use image::AnimationDecoder;
    use image::codecs::gif::GifDecoder;
    use std::io::Cursor;

    #[test]
    fn the_name_says_the_format() {
        let of = |name: &str| PictureFormat::of(Path::new(name));
        assert_eq!(of("a").unwrap(), PictureFormat::Png);
        assert_eq!(of("a.b/c.PNG").unwrap(), PictureFormat::Png);
        assert_eq!(of("a.JPEG").unwrap(), PictureFormat::Jpeg);
        assert!(of("a.bmp").unwrap_err().line().contains("a.png"));
    }

    #[test]
    fn pictures_become_a_moving_one() {
        let png = |level: u8| {
            let mut bytes = Cursor::new(Vec::new());
            let picture = image::RgbImage::from_pixel(16, 8, image::Rgb([level, 0, 0]));
            picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
            bytes.into_inner()
        };
        let gif = moving(&[png(0), png(200)], Duration::from_millis(80)).unwrap();
        assert!(is_marked_gif(&gif));
        let frames = GifDecoder::new(Cursor::new(gif)).unwrap().into_frames().collect_frames().unwrap();
        let seen: Vec<(u8, u32)> =
            frames.iter().map(|f| (f.buffer().get_pixel(3, 3)[0], f.delay().numer_denom_ms().0)).collect();
        assert_eq!(seen, [(0, 80), (200, 80)]);
    }
}
