//! Pressure of crumpling: how hard the felt is pressed together, where real felt would fold.

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

/// Mean compressive stress in the plane, force per length: `max(0, -tr(sigma) / 2)` with the Cauchy stress `sigma = P F^T / det F`.
#[derive(Debug, PartialEq)]
pub struct Crumpling(Field);

/// End of the bar where nothing is pressed, as a part of the shear modulus.
const LEAST: f64 = 1e-2;

fn figure(design: &Design, triangle: usize, f: &Matrix2<f64>) -> f64 {
    let stiffness = design.stiffness_map.as_ref().and_then(|map| map.get(triangle)).copied().unwrap_or(1.0);
    let j = f.determinant();
    if j <= 0.0 {
        return f64::INFINITY;
    }
    let stress = design.material.build().stress(f) * f.transpose() / j;
    (-0.5 * stiffness * stress.trace()).max(0.0)
}

impl Layer for Crumpling {
    const NAME: &'static str = "crumpling";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let least = LEAST * subject.design.material.build().shear_modulus();
        let bar = |all: &[f64]| Bar::rising("Pressure of crumpling", "N/mm", all, least, subject.theme);
        Some(Self(Field::of(subject, figure, bar)))
    }

    fn draw(&self, items: &mut Vec<Item>) {
        self.0.draw(figure, items);
    }
}

impl Look for Crumpling {
    const LABEL: &'static str = "Crumpling";
    const TIP: &'static str = "Pressure in the body: where it is high, real felt folds";
    const REPLACES: &'static [&'static str] = &[Textured::NAME, Fibers::NAME];

    fn bar(&self) -> Option<Bar> {
        Some(self.0.bar().clone())
    }
}
