//! The energy of a sheet that wrinkles, by how it is stretched, and its derivatives.

/// How hard a sheet pulls itself together, over how hard it resists being stretched: a hundredth of what the pressure does. It says where a part lies that hangs
/// slack, and it counts for nothing elsewhere.
const SHRINKING: f64 = 5e-5;
/// No sheet is stretched so far: beyond it the pressure would win, and blow up the body without end.
const MOST: f64 = 2.0;
/// Stretches that differ by less are taken for the same.
const SAME: f64 = 1e-9;

/// Columns of a deformation gradient: a sheet's two directions in space.
pub type Gradient = [[f64; 3]; 2];

/// Energy per area `1/2 sum_i max(0, s_i - 1)^2 + e/2 sum_i s_i^2` of the principal stretches `s_i`, and its derivative by the columns of `f`.
///
/// With `C = F^T F`, its eigenvalues `s_i^2` and eigenvectors `n_i`, the derivative is `2 F dW/dC`, `dW/dC = sum_i (max(0, s_i - 1) / s_i + e)/2 n_i n_i^T`.
pub fn density(f: &Gradient) -> (f64, Gradient) {
    let (c00, c11, c01) = (dot(f[0], f[0]), dot(f[1], f[1]), dot(f[0], f[1]));
    let (mean, half) = (0.5 * (c00 + c11), 0.5 * (c00 - c11));
    let r = half.hypot(c01);
    let stretch = [mean + r, mean - r].map(|v| v.max(0.0).sqrt());
    if stretch[0] > MOST {
        return (f64::INFINITY, [[0.0; 3]; 2]);
    }
    let over = stretch.map(|s| (s - 1.0).max(0.0));
    let g = [0, 1].map(|i| 0.5 * SHRINKING + if over[i] > 0.0 { 0.5 * over[i] / stretch[i] } else { 0.0 });
    let (cosine, sine) = if r > 1e-14 * mean { (half / r, c01 / r) } else { (1.0, 0.0) };
    let m00 = 0.5 * (g[0] * (1.0 + cosine) + g[1] * (1.0 - cosine));
    let m11 = 0.5 * (g[0] * (1.0 - cosine) + g[1] * (1.0 + cosine));
    let m01 = 0.5 * (g[0] - g[1]) * sine;
    let column = |p: f64, q: f64| [0, 1, 2].map(|k| 2.0 * (f[0][k] * p + f[1][k] * q));
    let energy = 0.5 * (over[0] * over[0] + over[1] * over[1] + SHRINKING * (c00 + c11));
    (energy, [column(m00, m01), column(m01, m11)])
}

/// The second derivative of the density at a deformation gradient `F = U S V^T`.
///
/// The density is a sum of one convex function `w` of each stretch, which gives the eigenvalues in closed form (as in Smith, de Goes and Kim, *Analytic
/// Eigensystems for Isotropic Distortion Energies*, 2019), none of them negative: `w''(s_i)` along `u_i v_i^T`, `(w'_1 + w'_2) / (s_1 + s_2)` for turning
/// within the sheet, `(w'_1 - w'_2) / (s_1 - s_2)` for shear, `w'_i / s_i` for `n v_i^T`, out of it.
pub struct Curvature {
    /// `u_1`, `u_2` and the normal `n`.
    frame: [[f64; 3]; 3],
    v: [[f64; 2]; 2],
    along: [f64; 2],
    out: [f64; 2],
    turn: f64,
    shear: f64,
}

impl Curvature {
    pub fn of(f: &Gradient) -> Self {
        let (c00, c11, c01) = (dot(f[0], f[0]), dot(f[1], f[1]), dot(f[0], f[1]));
        let (mean, half) = (0.5 * (c00 + c11), 0.5 * (c00 - c11));
        let r = half.hypot(c01);
        let (sine, cosine) = (0.5 * c01.atan2(half)).sin_cos();
        let v = [[cosine, sine], [-sine, cosine]];
        let s = [mean + r, mean - r].map(|v| v.max(0.0).sqrt());
        let image = v.map(|v| [0, 1, 2].map(|k| f[0][k] * v[0] + f[1][k] * v[1]));
        // Where a triangle has fallen flat, any frame does.
        let first = unit(image[0]).unwrap_or([1.0, 0.0, 0.0]);
        let normal = unit(cross(image[0], image[1])).unwrap_or_else(|| across(first));
        let slope = s.map(|s| (s - 1.0).max(0.0));
        let along = s.map(|s| if s > 1.0 { 1.0 } else { 0.0 });
        let apart = s[0] - s[1];
        Self {
            frame: [first, cross(normal, first), normal],
            v,
            along: along.map(|w| w + SHRINKING),
            out: [0, 1].map(|i| SHRINKING + if slope[i] > 0.0 { slope[i] / s[i] } else { 0.0 }),
            turn: SHRINKING + (slope[0] + slope[1]) / (s[0] + s[1]).max(f64::MIN_POSITIVE),
            shear: SHRINKING + if apart > SAME { (slope[0] - slope[1]) / apart } else { along[0] },
        }
    }

    /// The matrix between `p` and `q` where the columns of `F` change by `d[0] p, d[1] p` and by `e[0] q, e[1] q`.
    pub fn between(&self, d: [f64; 2], e: [f64; 2]) -> [[f64; 3]; 3] {
        let on = |d: [f64; 2]| self.v.map(|v| d[0] * v[0] + d[1] * v[1]);
        let (d, e) = (on(d), on(e));
        let (same, other) = (0.5 * (self.shear + self.turn), 0.5 * (self.shear - self.turn));
        let within = [
            [self.along[0] * d[0] * e[0] + same * d[1] * e[1], other * d[1] * e[0]],
            [other * d[0] * e[1], self.along[1] * d[1] * e[1] + same * d[0] * e[0]],
        ];
        let out = self.out[0] * d[0] * e[0] + self.out[1] * d[1] * e[1];
        let [u1, u2, n] = self.frame;
        [0, 1, 2].map(|i| {
            let [p, q] = [0, 1].map(|k| u1[i] * within[0][k] + u2[i] * within[1][k]);
            [0, 1, 2].map(|j| p * u1[j] + q * u2[j] + out * n[i] * n[j])
        })
    }
}

fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(a, a).sqrt();
    (length > 0.0).then(|| a.map(|v| v / length))
}

/// A direction across another one.
fn across(a: [f64; 3]) -> [f64; 3] {
    let other = if a[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
    unit(cross(a, other)).unwrap_or(other)
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
