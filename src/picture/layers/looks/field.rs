//! A figure for every triangle of the body, as colours.

use crate::design::Design;
use crate::engine::Shape;
use crate::outline::Point;
use crate::picture::layers::layer::Shared;
use crate::picture::layers::marks::body;
use crate::picture::layers::subject::Subject;
use crate::picture::ramp::{Bar, ground};
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;
use nalgebra::Matrix2;

/// Triangles with their figures, and what the colours stand for.
#[derive(Debug, PartialEq)]
pub struct Field {
    design: Shared<Design>,
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    bar: Bar,
}

impl Field {
    /// `bar`: of the figures of both plushies together, so that their colours compare.
    pub fn of(
        subject: &Subject<'_>,
        figure: impl Fn(&Design, usize, &Matrix2<f64>) -> f64,
        bar: impl Fn(&[f64]) -> Bar,
    ) -> Self {
        let both = [Some(subject.shape), subject.beside];
        let all = both.into_iter().flatten().flat_map(|shape| figures(subject.design, shape, &figure));
        let all: Vec<f64> = all.collect();
        let (design, silhouette) = (Shared::of(subject.design), Shared::of(&subject.silhouette));
        Self { design, silhouette, shape: Shared::of(subject.shape), bar: bar(&all) }
    }

    pub fn bar(&self) -> &Bar {
        &self.bar
    }

    pub fn draw(&self, figure: impl Fn(&Design, usize, &Matrix2<f64>) -> f64, items: &mut Vec<Item>) {
        items.extend(body(&self.silhouette, &self.shape, ground(self.bar.theme)));
        let colors = figures(&self.design, &self.shape, &figure).iter().map(|&v| self.bar.color(v)).collect();
        let (points, triangles) = (self.shape.nodes.clone(), self.design.mesh.triangles.clone());
        items.push(Item::Cells { points, triangles, colors });
    }
}

/// A figure of each triangle's deformation gradient; none for a shape of another mesh.
fn figures(design: &Design, shape: &Shape, figure: &impl Fn(&Design, usize, &Matrix2<f64>) -> f64) -> Vec<f64> {
    let mesh = &design.mesh;
    if shape.nodes.len() != mesh.nodes.len() {
        return Vec::new();
    }
    let edges = |nodes: &[Point], t: &[usize; 3]| {
        let [a, b, c] = t.map(|n| nodes[n]);
        Matrix2::new(b[0] - a[0], c[0] - a[0], b[1] - a[1], c[1] - a[1])
    };
    let gradient = |t: &[usize; 3]| {
        let rest = edges(&mesh.nodes, t).try_inverse().unwrap_or_else(Matrix2::identity);
        edges(&shape.nodes, t) * rest
    };
    mesh.triangles.iter().enumerate().map(|(k, t)| figure(design, k, &gradient(t))).collect()
}
