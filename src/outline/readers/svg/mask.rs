//! What a mask lets through.

use super::walk::Walk;
use crate::outline::OutlineError;
use crate::outline::regions::{self, Shapes};
use usvg::{Group, Mask, MaskType, Node, Paint, Transform};

/// Luminance times opacity below which nothing shows through: what an eye cannot tell from black.
const DARK: f32 = 0.02;

impl Walk {
    /// The area that a mask lets through at least in part: what it paints in anything but black, in painting order, since
    /// black on top closes again. A mask by opacity lets through all that it paints.
    pub(super) fn shown(&mut self, mask: &Mask, place: Transform) -> Result<Shapes, OutlineError> {
        let mut open = Shapes::new();
        self.show(mask.root(), place, 1.0, mask.kind() == MaskType::Luminance, &mut open)?;
        let rect = mask.rect();
        let corners = [
            [rect.left(), rect.top()],
            [rect.right(), rect.top()],
            [rect.right(), rect.bottom()],
            [rect.left(), rect.bottom()],
        ];
        let corner = |[x, y]: [f32; 2]| {
            let mut p = usvg::tiny_skia_path::Point::from_xy(x, y);
            place.map_point(&mut p);
            [f64::from(p.x), -f64::from(p.y)]
        };
        let window = regions::union(vec![vec![corners.map(corner).to_vec()]])?;
        Ok(regions::intersection(&open, &window))
    }

    fn show(
        &mut self,
        group: &Group,
        place: Transform,
        opacity: f32,
        luminance: bool,
        open: &mut Shapes,
    ) -> Result<(), OutlineError> {
        self.visit()?;
        let place = place.pre_concat(group.transform());
        let opacity = opacity * group.opacity().get();
        for node in group.children() {
            match node {
                Node::Group(child) if child.clip_path().is_some() || child.mask().is_some() => {
                    // What is cut inside a mask is taken to be of one kind: the rare case, read the simple way.
                    let area = self.area(child, place)?;
                    *open = regions::union([std::mem::take(open), area].concat())?;
                }
                Node::Group(child) => self.show(child, place, opacity, luminance, open)?,
                Node::Text(text) => self.show(text.flattened(), place, opacity, luminance, open)?,
                Node::Path(path) if path.is_visible() => {
                    self.visit()?;
                    if let Some(fill) = path.fill() {
                        let area = self.fill(path, place)?;
                        paint(open, area, fill.paint(), opacity * fill.opacity().get(), luminance)?;
                    }
                    if let Some(stroke) = path.stroke() {
                        let area = self.stroke(path, place)?;
                        paint(open, area, stroke.paint(), opacity * stroke.opacity().get(), luminance)?;
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// Opens or closes an area of a mask. A gradient or pattern counts as bright.
fn paint(open: &mut Shapes, area: Shapes, paint: &Paint, opacity: f32, luminance: bool) -> Result<(), OutlineError> {
    let bright = match paint {
        Paint::Color(c) if luminance => {
            // Coefficients of luminance in SVG 1.1, 14.4 (sRGB values weighted as they are: only zero matters).
            (0.2126 * f32::from(c.red) + 0.7152 * f32::from(c.green) + 0.0722 * f32::from(c.blue)) / 255.0
        }
        _ => 1.0,
    };
    if bright * opacity > DARK {
        *open = regions::union([std::mem::take(open), area].concat())?;
    } else if opacity > 1.0 - DARK {
        *open = regions::difference(open, &area);
    }
    Ok(())
}
