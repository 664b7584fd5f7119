//! Pictures in memory.

/// A picture with pixels from left to right and from above, RGBA.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    pub width: u32,
    pub height: u32,
    pub pixels: Vec<u8>,
}
