//! A sheet that wrinkles but hardly stretches, under the pressure of its stuffing.

use super::stretch::{Curvature, Gradient, cross, density, dot};
use crate::mesh::Mesh;
use crate::outline::polygon::length;

/// Strain that the pressure would cause in a sheet as wide as the body's deepest place, dimensionless. Larger: the sheet stretches (sizes are off by
/// about as much); smaller: many more iterations.
const STRAIN: f64 = 0.005;
/// Height of the dome that the search starts from, over the distance to the rim.
const START_SLOPE: f64 = 0.8;

/// The relaxed energy of a sheet that wrinkles ([`density`]), of unit stiffness, less pressure times half the volume.
pub struct Membrane {
    triangles: Vec<[usize; 3]>,
    area: Vec<f64>,
    /// Inverse of the matrix of the two sides at rest, row by row.
    inverse: Vec<[f64; 4]>,
    is_rim: Vec<bool>,
    depth: Vec<f64>,
    pressure: f64,
}

impl Membrane {
    pub fn new(mesh: &Mesh, rim: &[Vec<usize>]) -> Self {
        let mut is_rim = vec![false; mesh.nodes.len()];
        rim.iter().flatten().for_each(|&node| is_rim[node] = true);
        let on_rim: Vec<_> = rim.iter().flatten().map(|&node| mesh.nodes[node]).collect();
        let depth: Vec<f64> =
            mesh.nodes.iter().map(|&p| on_rim.iter().map(|&q| length(p, q)).fold(f64::INFINITY, f64::min)).collect();
        let deepest = depth.iter().copied().fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let (mut area, mut inverse, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for &t in &mesh.triangles {
            let [a, b, c] = t.map(|n| mesh.nodes[n]);
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
            let twice = u[0] * v[1] - u[1] * v[0];
            if twice > 0.0 {
                triangles.push(t);
                area.push(0.5 * twice);
                inverse.push([v[1] / twice, -v[0] / twice, -u[1] / twice, u[0] / twice]);
            }
        }
        Self { triangles, area, inverse, is_rim, depth, pressure: STRAIN / deepest }
    }

    /// A start: every node raised by its distance to the rim.
    pub fn dome(&self, mesh: &Mesh) -> Vec<[f64; 3]> {
        let raised = |(p, depth): (&[f64; 2], &f64)| [p[0], p[1], START_SLOPE * depth];
        let mut nodes: Vec<[f64; 3]> = mesh.nodes.iter().zip(&self.depth).map(raised).collect();
        for (node, is_rim) in nodes.iter_mut().zip(&self.is_rim) {
            if *is_rim {
                node[2] = 0.0;
            }
        }
        nodes
    }

    /// Volume between both sheets, mm^3.
    pub fn volume(&self, x: &[[f64; 3]]) -> f64 {
        2.0 * self.triangles.iter().map(|t| dot(x[t[0]], cross(x[t[1]], x[t[2]])) / 6.0).sum::<f64>()
    }

    /// The energy and its gradient, which is 0 across the plane of the rim.
    pub fn energy(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) -> f64 {
        gradient.fill([0.0; 3]);
        let mut energy = 0.0;
        for ((t, &area), d) in self.triangles.iter().zip(&self.area).zip(&self.inverse) {
            let [a, b, c] = t.map(|n| x[n]);
            let (density, stress) = density(&gradient_of([a, b, c], d));
            energy += area * density;
            let gu = [0, 1, 2].map(|k| area * (stress[0][k] * d[0] + stress[1][k] * d[1]));
            let gv = [0, 1, 2].map(|k| area * (stress[0][k] * d[2] + stress[1][k] * d[3]));
            let p = self.pressure / 6.0;
            let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
            energy -= p * dot(a, bc);
            for k in 0..3 {
                gradient[t[0]][k] -= gu[k] + gv[k] + p * bc[k];
                gradient[t[1]][k] += gu[k] - p * ca[k];
                gradient[t[2]][k] += gv[k] - p * ab[k];
            }
        }
        for (g, is_rim) in gradient.iter_mut().zip(&self.is_rim) {
            if *is_rim {
                g[2] = 0.0;
            }
        }
        energy
    }

    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Whether a node lies on the rim, where it stays in the plane.
    pub fn is_rim(&self) -> &[bool] {
        &self.is_rim
    }

    /// The second derivative of a triangle's energy: a matrix for every two corners.
    pub fn second(&self, triangle: usize, x: &[[f64; 3]]) -> [[[[f64; 3]; 3]; 3]; 3] {
        let (d, area) = (&self.inverse[triangle], self.area[triangle]);
        let at = self.triangles[triangle].map(|n| x[n]);
        let curvature = Curvature::of(&gradient_of(at, d));
        // How the columns of the deformation gradient change with each corner.
        let by = [[-d[0] - d[2], -d[1] - d[3]], [d[0], d[1]], [d[2], d[3]]];
        std::array::from_fn(|a| {
            std::array::from_fn(|b| {
                let sheet = curvature.between(by[a], by[b]).map(|row| row.map(|v| area * v));
                if a == b {
                    return sheet;
                }
                // Of a . (b x c): the cross product with the third corner.
                let sign = if (a + 1) % 3 == b { 1.0 } else { -1.0 };
                let [p, q, r] = at[3 - a - b].map(|v| sign * self.pressure / 6.0 * v);
                let pressure = [[0.0, -r, q], [r, 0.0, -p], [-q, p, 0.0]];
                [0, 1, 2].map(|i| [0, 1, 2].map(|j| sheet[i][j] + pressure[i][j]))
            })
        })
    }

    /// A force that is large here: the pressure on the area around a node.
    pub fn force_scale(&self) -> f64 {
        let area: f64 = self.area.iter().sum();
        self.pressure * area / self.is_rim.len().max(1) as f64
    }
}

/// The deformation gradient of a triangle with its corners at these places, with the inverse of its sides at rest.
fn gradient_of([a, b, c]: [[f64; 3]; 3], inverse: &[f64; 4]) -> Gradient {
    let (u, v) = (minus(b, a), minus(c, a));
    [0, 1].map(|j| [0, 1, 2].map(|k| u[k] * inverse[j] + v[k] * inverse[2 + j]))
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet of 60 x 40 mm, wider and lower than it was cut, every node somewhere else: taut, slack and both.
    fn sheet() -> (Membrane, Vec<[f64; 3]>) {
        let outer = vec![[0.0, 0.0], [60.0, 0.0], [60.0, 40.0], [0.0, 40.0]];
        let mesh = crate::mesh::generate(&crate::outline::Outline { outer, holes: vec![] }, 80).unwrap();
        let membrane = Membrane::new(&mesh, &mesh.boundary());
        let mut x = membrane.dome(&mesh);
        for (i, p) in x.iter_mut().enumerate() {
            (p[0], p[1]) = (p[0] * 1.1 + (i as f64).sin(), p[1] * 0.95 + (1.7 * i as f64).sin());
        }
        (membrane, x)
    }

    #[test]
    fn the_gradient_is_that_of_the_energy() {
        let (membrane, x) = sheet();
        let mut gradient = vec![[0.0; 3]; x.len()];
        membrane.energy(&x, &mut gradient);
        let direction: Vec<[f64; 3]> = (0..x.len())
            .map(|i| {
                [
                    (i as f64).cos(),
                    (2.0 * i as f64).sin(),
                    if membrane.is_rim[i] { 0.0 } else { (3.0 * i as f64).cos() },
                ]
            })
            .collect();
        let expected: f64 = gradient.iter().zip(&direction).map(|(g, d)| dot(*g, *d)).sum();
        let mut unused = gradient.clone();
        let mut off = |h: f64| {
            let moved = |s: f64| -> Vec<[f64; 3]> {
                x.iter().zip(&direction).map(|(p, d)| [0, 1, 2].map(|k| p[k] + s * d[k])).collect()
            };
            let (up, down) = (membrane.energy(&moved(h), &mut unused), membrane.energy(&moved(-h), &mut unused));
            ((up - down) / (2.0 * h) - expected).abs() / expected.abs()
        };
        let (coarse, fine) = (off(1e-3), off(1e-4));
        assert!(fine < 1e-6 && fine < 0.1 * coarse.max(1e-9), "{coarse} {fine}");
    }

    #[test]
    fn the_second_derivative_is_that_of_the_gradient() {
        let (membrane, x) = sheet();
        let free = |i: usize, k: usize| k < 2 || !membrane.is_rim[i];
        let direction: Vec<[f64; 3]> = (0..x.len())
            .map(|i| [0, 1, 2].map(|k| if free(i, k) { (1.3 * (3 * i + k) as f64).sin() } else { 0.0 }))
            .collect();
        let mut expected = vec![[0.0; 3]; x.len()];
        for (k, t) in membrane.triangles.iter().enumerate() {
            let second = membrane.second(k, &x);
            for (a, row) in t.iter().zip(&second) {
                for (b, block) in t.iter().zip(row) {
                    for (sum, row) in expected[*a].iter_mut().zip(block) {
                        *sum += dot(*row, direction[*b]);
                    }
                }
            }
        }
        let gradient_at = |s: f64| {
            let moved: Vec<[f64; 3]> =
                x.iter().zip(&direction).map(|(p, d)| [0, 1, 2].map(|k| p[k] + s * d[k])).collect();
            let mut gradient = vec![[0.0; 3]; x.len()];
            membrane.energy(&moved, &mut gradient);
            gradient
        };
        let h = 1e-6;
        let (up, down) = (gradient_at(h), gradient_at(-h));
        let mut largest: f64 = 0.0;
        for i in 0..x.len() {
            for k in (0..3).filter(|&k| free(i, k)) {
                let found = (up[i][k] - down[i][k]) / (2.0 * h);
                largest = largest.max((found - expected[i][k]).abs());
            }
        }
        let size = expected.as_flattened().iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        assert!(largest < 1e-6 * size, "{largest} of {size}");
    }
}
