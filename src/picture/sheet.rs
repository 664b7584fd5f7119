//! Sheets that are cut and printed, as pictures.

use super::pixels::Preview;
use super::raster::RasterError;
use crate::outline::svg::fonts;
use tiny_skia::{Color, Pixmap, Transform};
use usvg::{Options, Tree};

/// An SVG of ours as a picture on white, its longer side so many pixels.
///
/// # Errors
/// What is no SVG, or a size that is empty or does not fit in memory.
pub fn sheet(svg: &[u8], longest: u32) -> Result<Preview, RasterError> {
    let options = Options { fontdb: fonts(), ..Options::default() };
    let tree = Tree::from_data(svg, &options).map_err(|error| RasterError::Encode(error.to_string()))?;
    let size = tree.size();
    let scale = longest as f32 / size.width().max(size.height());
    let [width, height] = [size.width(), size.height()].map(|side| (side * scale).ceil().max(1.0) as u32);
    let mut pixmap = Pixmap::new(width, height).ok_or(RasterError::Size(width, height))?;
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(Preview { width, height, pixels: pixmap.take() })
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_sheet_is_drawn_where_its_lines_are() {
        let svg = br##"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="100mm" viewBox="0 0 200 100">
<rect x="0" y="0" width="100" height="100" fill="#ff0000"/></svg>"##;
        let picture = super::sheet(svg, 40).unwrap();
        assert_eq!((picture.width, picture.height, picture.pixels.len()), (40, 20, 3200));
        let pixel = |x: usize, y: usize| &picture.pixels[4 * (40 * y + x)..][..4];
        assert_eq!((pixel(10, 10), pixel(30, 10)), (&[255, 0, 0, 255][..], &[255; 4][..]));
        assert!(super::sheet(b"no sheet", 40).is_err());
    }
}
