//! Small bodies for the tests of the solvers: bars with fibres, tendons and pins.

use super::Random;
use plushwright::physics::{
    Body, Contractile, Element, Energy, Hyperelastic, MaterialPoint, Model, NeoHookean, PinSpring, Pins,
};

/// Nodes and counter-clockwise triangles.
#[derive(Clone)]
pub struct Mesh {
    pub nodes: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
    pub columns: usize,
    pub rows: usize,
}

/// A `length` x `height` rectangle in `columns` x `rows` cells of two triangles, the diagonals alternating.
pub fn bar(length: f64, height: f64, columns: usize, rows: usize) -> Mesh {
    let mut mesh = Mesh { nodes: Vec::new(), triangles: Vec::new(), columns, rows };
    for j in 0..=rows {
        for i in 0..=columns {
            mesh.nodes.push([length * i as f64 / columns as f64, height * j as f64 / rows as f64]);
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            let [a, b, c, d] = [mesh.at(i, j), mesh.at(i + 1, j), mesh.at(i + 1, j + 1), mesh.at(i, j + 1)];
            let pair = if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            mesh.triangles.extend(pair);
        }
    }
    mesh
}

impl Mesh {
    /// The node in column `i` and row `j`.
    pub fn at(&self, i: usize, j: usize) -> usize {
        j * (self.columns + 1) + i
    }

    pub fn flat(&self) -> Vec<f64> {
        self.nodes.iter().flatten().copied().collect()
    }

    /// Inner nodes moved at random by up to `amount` of a cell.
    pub fn jittered(mut self, amount: f64, random: &mut Random) -> Self {
        let cell = self.nodes[1][0] - self.nodes[0][0];
        for j in 1..self.rows {
            for i in 1..self.columns {
                let k = self.at(i, j);
                for axis in 0..2 {
                    self.nodes[k][axis] += cell * amount * random.between(-1.0, 1.0);
                }
            }
        }
        self
    }

    /// Every edge once, the smaller node first.
    pub fn edges(&self) -> Vec<[usize; 2]> {
        let mut edges: Vec<[usize; 2]> = self
            .triangles
            .iter()
            .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// An element along `routing` with its rest length in the rest shape.
    pub fn element(&self, routing: &[usize], stiffness: f64, epsilon: f64) -> Element {
        let mut e =
            Element { routing: MaterialPoint::through(routing.iter().copied()), stiffness, epsilon, alpha0: 1.0 };
        e.alpha0 = e.length(&self.flat());
        e
    }

    /// A fibre on every edge: `epsilon` is a hundredth of its length.
    pub fn fibers(&self, stiffness: f64) -> Vec<Element> {
        let fiber = |e: &[usize; 2]| {
            let mut fiber = self.element(e, stiffness, 1.0);
            fiber.epsilon = 0.01 * fiber.alpha0;
            fiber
        };
        self.edges().iter().map(fiber).collect()
    }

    /// Pins on the nodes of the left end.
    pub fn left_pins(&self, stiffness: f64) -> Pins {
        let pin = |j| PinSpring::node(self.at(0, j), self.nodes[self.at(0, j)], stiffness);
        Pins { pins: (0..=self.rows).map(pin).collect() }
    }

    pub fn body(&self, material: Box<dyn Hyperelastic>, stiffness: Option<&[f64]>) -> Body {
        Body::new(&self.nodes, &self.triangles, material, stiffness).expect("the mesh is valid")
    }

    pub fn model(
        &self,
        material: Box<dyn Hyperelastic>,
        elements: Vec<Element>,
        pins: Pins,
        terms: Vec<Box<dyn Energy>>,
    ) -> Model {
        Model::new(&self.nodes, self.body(material, None), Contractile::new(elements), pins, terms)
            .expect("the mesh is valid")
    }
}

pub fn neo_hookean() -> Box<dyn Hyperelastic> {
    Box::new(NeoHookean { mu: 1.0, kappa: 2.0 })
}

pub fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, a| m.max(a.abs()))
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub fn plus(x: &[f64], t: f64, d: &[f64]) -> Vec<f64> {
    x.iter().zip(d).map(|(x, d)| x + t * d).collect()
}

pub fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |m, (a, b)| m.max((a - b).abs()))
}

/// Positions turned by `angle` about the origin, then moved.
pub fn moved(x: &[f64], angle: f64, by: [f64; 2]) -> Vec<f64> {
    let (s, c) = angle.sin_cos();
    x.chunks_exact(2).flat_map(|p| [c * p[0] - s * p[1] + by[0], s * p[0] + c * p[1] + by[1]]).collect()
}
