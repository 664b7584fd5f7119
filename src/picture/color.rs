//! Colours.

/// An sRGB colour with alpha, straight (not premultiplied).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8, pub u8);
