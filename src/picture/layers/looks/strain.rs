//! Strain: how much larger or smaller each piece of the body is than at rest, `det F`.

use super::field::Field;
use crate::design::Design;
use crate::picture::layers::fibers::Fibers;
use crate::picture::layers::layer::Layer;
use crate::picture::layers::look::Look;
use crate::picture::layers::subject::Subject;
use crate::picture::layers::texture::Textured;
use crate::picture::ramp::Bar;
use crate::picture::scene::Item;
use nalgebra::Matrix2;

/// Area of the deformed body over that at rest.
#[derive(Debug, PartialEq)]
pub struct Strain(Field);

/// The bar reaches from the inverse of this to it at least, and at most.
const RANGE: [f64; 2] = [1.1, 4.0];

fn figure(_: &Design, _: usize, f: &Matrix2<f64>) -> f64 {
    f.determinant()
}

impl Layer for Strain {
    const NAME: &'static str = "strain";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        Some(Self(Field::of(subject, figure, |all| {
            Bar::ratio("Area by area at rest (det F)", all, RANGE, subject.theme)
        })))
    }

    fn draw(&self, items: &mut Vec<Item>) {
        self.0.draw(figure, items);
    }
}

impl Look for Strain {
    const LABEL: &'static str = "Strain";
    const TIP: &'static str =
        "How much the body is pressed together (blue) or pulled apart (orange): area by area at rest";
    const REPLACES: &'static [&'static str] = &[Textured::NAME, Fibers::NAME];

    fn bar(&self) -> Option<Bar> {
        Some(self.0.bar().clone())
    }
}
