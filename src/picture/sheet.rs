//! Sheets that are cut and printed, as pictures.

use super::pixels::Preview;
use super::raster::RasterError;
use crate::outline::svg::fonts;
use tiny_skia::{Color, Pixmap, Transform};
use usvg::{Options, Tree};

/// Width of the thinnest lines, pixels: hairlines that machines cut would hardly be seen.
const THINNEST_PX: f32 = 1.6;
/// Pixels of an SVG in a millimetre, at 96 to the inch.
const PX_PER_MM: f32 = 96.0 / 25.4;

/// An SVG of ours, which is in mm, as a picture on white, its longer side so many pixels. Hairlines are drawn as wide as can be seen.
///
/// # Errors
/// What is no SVG, or a size that is empty or does not fit in memory.
pub fn sheet(svg: &[u8], longest: u32) -> Result<Preview, RasterError> {
    let mut options = Options { fontdb: fonts(), ..Options::default() };
    options.font_resolver.select_font = Box::new(|_, fonts| fonts.faces().next().map(|face| face.id));
    let parsed = |svg: &[u8]| Tree::from_data(svg, &options).map_err(|error| RasterError::Encode(error.to_string()));
    let size = parsed(svg)?.size();
    let scale = longest as f32 / size.width().max(size.height());
    let tree = parsed(widened(&String::from_utf8_lossy(svg), THINNEST_PX / (scale * PX_PER_MM)).as_bytes())?;
    let [width, height] = [size.width(), size.height()].map(|side| (side * scale).ceil().max(1.0) as u32);
    let mut pixmap = Pixmap::new(width, height).ok_or(RasterError::Size(width, height))?;
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(Preview { width, height, pixels: pixmap.take() })
}

/// The drawing with no line thinner than this, mm.
fn widened(svg: &str, least_mm: f32) -> String {
    const NAME: &str = "stroke-width=\"";
    let mut pieces = svg.split(NAME);
    let mut out = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (width, rest) = piece.split_once('"').unwrap_or((piece, ""));
        let thin = width.parse::<f32>().is_ok_and(|width| width < least_mm);
        let width = if thin { least_mm.to_string() } else { width.to_owned() };
        out.push_str(&format!("{NAME}{width}\"{rest}"));
    }
    out
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
        let lines = r#"<path stroke-width="0.01" d=""/><path stroke-width="3" d=""/>"#;
        assert_eq!(super::widened(lines, 0.5), r#"<path stroke-width="0.5" d=""/><path stroke-width="3" d=""/>"#);
    }
}
