//! The picture of a plushie: what its file shows within the silhouette's box.

use super::readers::{decoded, reader_of, unknown, unpacked};
use super::resample::{MAX_TEXTURE_PX, fitted, shrunk};
use super::{Import, Imported, MAX_FILE_BYTES, OutlineError};
use crate::files;
use image::{ImageFormat, RgbaImage};
use std::io::{self, Cursor};
use std::path::Path;

/// A PNG of what the file shows in the box of its silhouette: RGBA, its corners those of the box after the clean-up, its longer side at
/// most [`MAX_TEXTURE_PX`]. `bytes` and `import` are those that gave `imported`. Only chosen layers are in it, and
/// beyond the rim of a picture its outermost pixels go on.
///
/// # Errors
/// A format without colours; a drawing that takes too long to paint. See [`OutlineError`].
pub fn texture(bytes: &[u8], import: &Import, imported: &Imported) -> Result<Vec<u8>, OutlineError> {
    let bytes = &*unpacked(bytes)?;
    let reader = reader_of(bytes).ok_or_else(|| unknown(bytes))?;
    let picture = reader.texture(bytes, import, imported.drawn_box)?;
    let mut png = Cursor::new(Vec::new());
    let unwritable = |e: image::ImageError| OutlineError::Unreadable { format: "texture", reason: e.to_string() };
    picture.write_to(&mut png, ImageFormat::Png).map_err(unwritable)?;
    Ok(files::marked_png(&png.into_inner()))
}

/// Reads a texture back, a PNG or JPEG; a side longer than [`MAX_TEXTURE_PX`] is averaged down.
///
/// # Errors
/// What the system says of the file, or what is wrong with the picture.
pub fn read_texture(path: &Path) -> Result<RgbaImage, OutlineError> {
    let unread = |error: io::Error| match error.kind() {
        io::ErrorKind::FileTooLarge => OutlineError::TooLarge,
        _ => OutlineError::Unopened(error.to_string()),
    };
    let bytes = files::read(path, MAX_FILE_BYTES as u64).map_err(unread)?;
    let picture = decoded(&bytes)?;
    let size = [picture.width(), picture.height()];
    let fitted = fitted(size.map(f64::from), f64::from(MAX_TEXTURE_PX));
    Ok(if fitted == size { picture } else { shrunk(&picture, fitted) })
}
