//! The frame in which a problem is solved: the body's own.
//!
//! A problem may be a micrometre or a kilometre across, lie a million body lengths from the origin, and be soft or hard. The
//! solvers see none of that: the centre of the rest shape's box becomes the origin, its longer side about 1, and the shear
//! modulus about 1. Units of length `s` and of modulus `m` are powers of two, so that scaling loses no digit:
//!
//! ```text
//! x = o + s x'     E = m s^2 E'     force, tension = m s f'     K, mu, kappa = m K'     density * g = (m/s) (density g)'
//! O = s^2 O'       lambda = s^2 lambda'                         rho = rho'/m^2          dO/dalpha_c = s dO'/dalpha_c'
//! ```

use super::file::Problem;

/// Origin `o`, unit of length `s` (m) and unit of modulus `m` (N/m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub origin: [f64; 2],
    pub length: f64,
    pub modulus: f64,
}

impl Frame {
    /// The frame of a problem with a body of some size.
    pub fn of(problem: &Problem) -> Self {
        let [low, high] = box_of(problem);
        let origin = [0, 1].map(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        Self { origin, length: power_of_two(size), modulus: power_of_two(problem.material.shear_modulus()) }
    }

    /// The problem as it looks in this frame.
    pub fn inside(&self, problem: &Problem) -> Problem {
        let (s, m) = (self.length, self.modulus);
        let mut inner = problem.clone();
        let point = |p: &mut [f64; 2]| *p = self.point_inside(*p);
        inner.mesh.nodes.iter_mut().for_each(point);
        inner.start.iter_mut().flatten().for_each(point);
        inner.material = problem.material.scaled(m, s);
        for e in &mut inner.elements {
            e.stiffness /= m;
            e.epsilon /= s;
            e.alpha0 /= s;
        }
        for pin in &mut inner.pins {
            point(&mut pin.target);
            pin.stiffness /= m;
        }
        let lengths = |list: &mut Vec<f64>| list.iter_mut().for_each(|v| *v /= s);
        inner.contractions.iter_mut().for_each(lengths);
        if let Some(objective) = &mut inner.objective {
            objective.regulariser /= s * s;
            objective.targets.iter_mut().for_each(|t| point(&mut t.xy));
        }
        if let Some(ik) = &mut inner.soft_ik {
            for bounds in [&mut ik.beta_upper, &mut ik.beta_lower] {
                bounds.iter_mut().flatten().flatten().for_each(|v| *v /= s);
            }
            ik.beta_start.iter_mut().for_each(lengths);
            ik.fixed_winches.iter_mut().flat_map(|f| f.values_mut()).for_each(|v| *v /= s);
        }
        if let Some(density) = &mut inner.surface_density {
            *density *= s / m;
        }
        for (parameter, values) in inner.terms.iter_mut().flat_map(|term| term.each_mut()) {
            values.iter_mut().for_each(|value| *value /= parameter.dimension.unit(m, s));
        }
        if let Some(drag) = &mut inner.drag {
            drag.frames.iter_mut().flatten().for_each(point);
            drag.tension_regulariser *= m * m;
        }
        inner
    }

    fn point_inside(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (p[axis] - self.origin[axis]) / self.length)
    }

    /// Coordinates of this frame as points of the file.
    pub fn points(&self, x: &[f64]) -> Vec<[f64; 2]> {
        x.chunks_exact(2).map(|p| [0, 1].map(|axis| self.origin[axis] + self.length * p[axis])).collect()
    }

    /// Unit of force and tension, N.
    pub fn force(&self) -> f64 {
        self.modulus * self.length
    }

    /// Unit of energy, J.
    pub fn energy(&self) -> f64 {
        self.modulus * self.length * self.length
    }

    /// Unit of the objective, m^2.
    pub fn objective(&self) -> f64 {
        self.length * self.length
    }
}

/// Lower left and upper right corner of the rest shape's box.
pub(super) fn box_of(problem: &Problem) -> [[f64; 2]; 2] {
    let nodes = &problem.mesh.nodes;
    let used = problem.mesh.triangles.iter().flatten().filter_map(|&n| nodes.get(n));
    used.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
        [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
    })
}

/// The largest power of two up to a positive value.
fn power_of_two(value: f64) -> f64 {
    2.0_f64.powi(value.log2().floor() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaling_is_exact() {
        for value in [1.0, 3.7e-6, 0.999_999, 1e3, 6.02e23] {
            let unit = power_of_two(value);
            assert!(unit <= value && value < 2.0 * unit);
            assert_eq!(value / unit * unit, value);
        }
    }
}
