//! From the bytes of a file to one clean outline.

use super::readers::{ReadingOption, reader_of, unknown, unpacked};
use super::{Import, Imported, MAX_FILE_BYTES, OutlineError};
use std::io::Read;
use std::path::Path;

/// Reads a file's bytes and cleans the silhouette.
///
/// # Errors
/// See [`OutlineError`]. Never panics, and ends within some seconds, whatever the bytes are.
pub fn import(bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
    import.check()?;
    if bytes.len() > MAX_FILE_BYTES {
        return Err(OutlineError::TooLarge);
    }
    let bytes = &*unpacked(bytes)?;
    let reader = reader_of(bytes).ok_or_else(|| unknown(bytes))?;
    if !import.layers.is_empty() && !reader.options().contains(&ReadingOption::Layers) {
        return Err(OutlineError::NoLayers(reader.names()[1]));
    }
    if !import.blocks.is_empty() && !reader.options().contains(&ReadingOption::Blocks) {
        return Err(OutlineError::NoBlocks(reader.names()[1]));
    }
    reader.read(bytes, import)
}

/// [`import`] of a file; one that is too large is not read at all.
///
/// # Errors
/// As [`import`], and what the system says of a file that cannot be read.
pub fn import_file(path: &Path, import: &Import) -> Result<Imported, OutlineError> {
    self::import(&read_file(path)?, import)
}

/// The bytes of a file with an outline.
///
/// # Errors
/// What the system says of a file that cannot be read. Of one that is too large, no more is read than it takes to be
/// refused.
pub fn read_file(path: &Path) -> Result<Vec<u8>, OutlineError> {
    let unopened = |error: std::io::Error| OutlineError::Unopened(error.to_string());
    let file = std::fs::File::open(path).map_err(unopened)?;
    let mut bytes = Vec::new();
    // A pipe or device has no length: one byte more than allowed tells.
    file.take(MAX_FILE_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(unopened)?;
    Ok(bytes)
}
