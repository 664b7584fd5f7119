//! How many millimetres a px of a drawing measures.
//!
//! A size in mm, cm, in, pt, pc or Q is physical. All others are numbers of px, and what these were depends on the program: 96 to the inch
//! by CSS, 72 with Adobe Illustrator, 90 with Inkscape up to 0.91, and with Affinity as many as its export was set to, which the scale of
//! its outermost group tells.

use crate::outline::Sizing;
use usvg::Tree;
use usvg::roxmltree::{Document, Node};

/// Millimetres in an inch, and in a CSS px.
const MM_PER_INCH: f64 = 25.4;
pub(super) const MM_PER_PX: f64 = MM_PER_INCH / 96.0;
/// Namespace of Inkscape's own attributes.
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
/// Units of length that are physical.
const PHYSICAL: [&str; 6] = ["mm", "cm", "in", "pt", "pc", "q"];
/// Resolutions that a scale of points may stand for.
const DPI: std::ops::RangeInclusive<f64> = 36.0..=2400.0;

/// The size of a px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Size {
    pub mm_per_px: f64,
    /// How it was found, where the file does not state it.
    pub sizing: Option<Sizing>,
}

/// The size of a px of `tree`, which was made of `document`. `unit_mm`: that of a plain number, whatever the file says.
pub(super) fn of(document: &Document, tree: &Tree, unit_mm: Option<f64>) -> Size {
    let root = document.root_element();
    let stated = |name| root.attribute(name).map(str::trim).filter(|text| !text.is_empty());
    let view: Option<Vec<f64>> = stated("viewBox").map(numbers);
    let view = view.filter(|view| view.len() == 4 && view[2] > 0.0 && view[3] > 0.0);
    if let Some(mm) = unit_mm {
        let scale = view.map_or(1.0, |view| f64::from(tree.size().width()) / view[2]);
        return Size { mm_per_px: mm / scale, sizing: None };
    }
    let is_physical = |text: &str| {
        let text = text.to_ascii_lowercase();
        PHYSICAL.iter().any(|unit| text.strip_suffix(unit).is_some_and(|number| number.trim().parse::<f64>().is_ok()))
    };
    let of_dpi = |dpi: f64, sizing| Size { mm_per_px: MM_PER_INCH / dpi, sizing: Some(sizing) };
    if stated("width").is_some_and(is_physical) || stated("height").is_some_and(is_physical) {
        // Such a page without a box of its own holds old px.
        return match is_old_inkscape(root) && view.is_none() {
            true => of_dpi(90.0, Sizing::OldInkscape),
            false => Size { mm_per_px: MM_PER_PX, sizing: None },
        };
    }
    let percent = |name| stated(name).is_none_or(|text| text.ends_with('%'));
    if is_illustrators(document) {
        of_dpi(72.0, Sizing::Illustrator)
    } else if is_old_inkscape(root) {
        of_dpi(90.0, Sizing::OldInkscape)
    } else if let Some(dpi) = affinity_dpi(root).filter(|_| percent("width") && percent("height")) {
        of_dpi(dpi, Sizing::Dots(dpi))
    } else {
        of_dpi(96.0, Sizing::Css)
    }
}

fn numbers(text: &str) -> Vec<f64> {
    text.split([',', ' ', '\t', '\n', '\r'])
        .filter(|word| !word.is_empty())
        .filter_map(|word| word.parse().ok())
        .collect()
}

/// Whether a comment before the root says so, as `<!-- Generator: Adobe Illustrator 24.0, SVG Export Plug-In -->`.
fn is_illustrators(document: &Document) -> bool {
    let mut before = document.root().children().take_while(|node| !node.is_element()).filter(Node::is_comment);
    before.any(|comment| comment.text().is_some_and(|text| text.contains("Adobe Illustrator")))
}

fn is_old_inkscape(root: Node) -> bool {
    let version = root.attribute((INKSCAPE, "version")).unwrap_or_default();
    let mut parts = version.split(|c: char| !c.is_ascii_digit()).map(str::parse::<u32>);
    matches!((parts.next(), parts.next()), (Some(Ok(0)), Some(Ok(minor))) if minor < 92)
}

/// Dots to the inch by the scale of points in the outermost group: `matrix(4.16667,0,0,4.16667,0,0)` is 300.
fn affinity_dpi(root: Node) -> Option<f64> {
    let group = root.children().find(|node| node.is_element() && node.tag_name().name() == "g")?;
    let matrix = group.attribute("transform")?.trim().strip_prefix("matrix(")?.strip_suffix(')')?;
    let matrix = numbers(matrix);
    let upright = matrix.len() == 6 && matrix[0] == matrix[3] && matrix[1] == 0.0 && matrix[2] == 0.0;
    let dpi = 72.0 * matrix.first()?;
    // The digits of the file: 4.16667 times 72 is 300.0002.
    (upright && DPI.contains(&dpi) && (dpi - dpi.round()).abs() < 1e-3).then_some(dpi.round())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_physical_or_known_by_the_program_or_96_to_the_inch() {
        let size = |before: &str, attributes: &str, body: &str, unit| {
            let text = format!("{before}<svg xmlns='http://www.w3.org/2000/svg' {attributes}>{body}</svg>");
            let document = Document::parse(&text).unwrap();
            let tree = Tree::from_xmltree(&document, &usvg::Options::default()).unwrap();
            let Size { mm_per_px, sizing } = of(&document, &tree, unit);
            (mm_per_px, sizing)
        };
        let body = "<g transform='matrix(4.16667,0,0,4.16667,0,0)'><rect width='9' height='9'/></g>";
        let dots = |dpi: f64, sizing| (25.4 / dpi, Some(sizing));
        assert_eq!(size("", "width='10mm' height='9mm' viewBox='0 0 20 18'", body, None), (MM_PER_PX, None));
        assert_eq!(size("", "width='10' height='9'", body, None), dots(96.0, Sizing::Css));
        assert_eq!(
            size("", "width='100%' height='100%' viewBox='0 0 9 9'", body, None),
            dots(300.0, Sizing::Dots(300.0))
        );
        let illustrator = "<!-- Generator: Adobe Illustrator 24.0 -->";
        assert_eq!(size(illustrator, "viewBox='0 0 9 9'", body, None), dots(72.0, Sizing::Illustrator));
        let inkscape = format!("xmlns:inkscape='{INKSCAPE}' inkscape:version='0.91 r13725' width='10mm' height='9mm'");
        assert_eq!(size("", &inkscape, body, None), dots(90.0, Sizing::OldInkscape));
        assert_eq!(size("", &format!("{inkscape} viewBox='0 0 10 9'"), body, None), (MM_PER_PX, None));
        // A plain number of a page of 200 px that is 100 wide is two px.
        assert_eq!(size("", "width='200' height='200' viewBox='0 0 100 100'", body, Some(3.0)), (1.5, None));
    }
}
