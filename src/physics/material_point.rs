//! A point of the material: what a contractile element passes, and moves with.

use super::double_double::DoubleDouble;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A node, or a point inside a triangle: `p(x) = sum_i w_i x_i` with weights that do not change. In files a node is its number.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum MaterialPoint {
    Node(usize),
    /// Boxed, as nearly all points are nodes and there are many of them.
    Inside(Box<Carriers>),
}

/// Weights nearer than this to those of a node are a node's: rounding of the search for the point's triangle.
const ON_NODE: f64 = 1e-9;

/// The nodes of a triangle and their weights.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Carriers {
    pub nodes: [usize; 3],
    pub weights: [f64; 3],
}

impl From<usize> for MaterialPoint {
    fn from(node: usize) -> Self {
        Self::Node(node)
    }
}

impl MaterialPoint {
    /// A point of a triangle: its node, where it lies on one.
    pub fn of_triangle(nodes: [usize; 3], weights: [f64; 3]) -> Self {
        let on = |k: usize| (0..3).all(|i| (weights[i] - f64::from(u8::from(i == k))).abs() <= ON_NODE);
        match (0..3).find(|&k| on(k)) {
            Some(k) => Self::Node(nodes[k]),
            None => Self::Inside(Box::new(Carriers { nodes, weights })),
        }
    }

    /// A routing through nodes.
    pub fn through(nodes: impl IntoIterator<Item = usize>) -> Vec<Self> {
        nodes.into_iter().map(Self::Node).collect()
    }

    /// The nodes that carry it and their weights: one or three.
    pub fn parts(&self) -> impl Iterator<Item = (usize, f64)> + Clone + use<> {
        let (count, nodes, weights) = match self {
            Self::Node(node) => (1, [*node; 3], [1.0; 3]),
            Self::Inside(carriers) => (3, carriers.nodes, carriers.weights),
        };
        (0..count).map(move |k| (nodes[k], weights[k]))
    }

    /// Its value in a field that has two entries a node, such as coordinates.
    #[inline]
    pub fn at(&self, field: &[f64]) -> [f64; 2] {
        match self {
            Self::Node(n) => [field[2 * n], field[2 * n + 1]],
            Self::Inside(carriers) => {
                let Carriers { nodes: [a, b, c], weights: w } = **carriers;
                [0, 1].map(|axis| w[0] * field[2 * a + axis] + w[1] * field[2 * b + axis] + w[2] * field[2 * c + axis])
            }
        }
    }

    /// [`at`](Self::at) in two words.
    pub(super) fn at_precisely(&self, field: &[DoubleDouble]) -> [DoubleDouble; 2] {
        match self {
            Self::Node(n) => [field[2 * n], field[2 * n + 1]],
            Self::Inside(_) => [0, 1].map(|axis| {
                let part = |(n, w): (usize, f64)| field[2 * n + axis] * DoubleDouble::from(w);
                self.parts().map(part).fold(DoubleDouble::ZERO, |sum, part| sum + part)
            }),
        }
    }

    /// Adds a force on it to those on its nodes: the transpose of [`at`](Self::at).
    #[inline]
    pub fn add(&self, [fx, fy]: [f64; 2], out: &mut [f64]) {
        match self {
            Self::Node(n) => {
                out[2 * n] += fx;
                out[2 * n + 1] += fy;
            }
            Self::Inside(carriers) => {
                for (n, w) in carriers.nodes.iter().zip(carriers.weights) {
                    out[2 * n] += w * fx;
                    out[2 * n + 1] += w * fy;
                }
            }
        }
    }

    /// Its place when the nodes are at `positions`.
    pub fn place(&self, positions: &[[f64; 2]]) -> [f64; 2] {
        match self {
            Self::Node(n) => positions[*n],
            Self::Inside(_) => {
                self.parts().fold([0.0; 2], |p, (n, w)| [p[0] + w * positions[n][0], p[1] + w * positions[n][1]])
            }
        }
    }

    /// The largest number of a node that carries it.
    pub fn last_node(&self) -> usize {
        self.parts().fold(0, |last, (n, _)| last.max(n))
    }

    /// The node, where it is one.
    pub fn node(&self) -> Option<usize> {
        match self {
            Self::Node(node) => Some(*node),
            Self::Inside(_) => None,
        }
    }
}

impl fmt::Display for MaterialPoint {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Node(node) => write!(f, "node {node}"),
            Self::Inside(carriers) => {
                let [a, b, c] = carriers.nodes;
                write!(f, "a point between nodes {a}, {b} and {c}")
            }
        }
    }
}

impl<'de> Deserialize<'de> for MaterialPoint {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl<'de> Visitor<'de> for Reader {
            type Value = MaterialPoint;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the number of a node, or nodes and weights of a point between them")
            }

            fn visit_u64<E: serde::de::Error>(self, node: u64) -> Result<MaterialPoint, E> {
                usize::try_from(node).map(MaterialPoint::Node).map_err(E::custom)
            }

            fn visit_i64<E: serde::de::Error>(self, node: i64) -> Result<MaterialPoint, E> {
                usize::try_from(node).map(MaterialPoint::Node).map_err(E::custom)
            }

            fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<MaterialPoint, E> {
                Err(E::custom(format_args!("{value} is not the number of a node")))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialPoint, A::Error> {
                let carriers = Carriers::deserialize(MapAccessDeserializer::new(map))?;
                Ok(MaterialPoint::of_triangle(carriers.nodes, carriers.weights))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_weights_of_a_node_make_one() {
        let of = |weights| MaterialPoint::of_triangle([4, 7, 9], weights).node();
        assert_eq!(of([0.0, 1.0, 0.0]), Some(7));
        assert_eq!(of([1e-12, 1e-12, 1.0 - 2e-12]), Some(9));
        for weights in
            [[0.1, 0.9, 0.0], [1.0, 1.0, 0.0], [f64::INFINITY, 0.0, 0.0], [2.0, -1.0, 0.0], [f64::NAN, 0.0, 1.0]]
        {
            assert_eq!(of(weights), None, "{weights:?}");
        }
    }

    #[test]
    fn forces_are_the_transpose_of_places() {
        let point = MaterialPoint::of_triangle([0, 2, 1], [0.2, 0.5, 0.3]);
        let field = [1.0, 2.0, 3.0, 5.0, 8.0, 13.0];
        let mut forces = [0.0; 6];
        point.add([0.7, -0.4], &mut forces);
        let [x, y] = point.at(&field);
        let work: f64 = forces.iter().zip(field).map(|(f, v)| f * v).sum();
        assert!((work - (0.7 * x - 0.4 * y)).abs() < 1e-14);
        assert_eq!(point.place(&[[1.0, 2.0], [3.0, 5.0], [8.0, 13.0]]), [x, y]);
    }
}
