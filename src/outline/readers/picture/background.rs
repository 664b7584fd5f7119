//! How far each pixel is from the background.

/// Part of the shorter side that is the rim, where the background is looked for first.
const RIM: f64 = 0.04;
/// Rounds of fitting.
const ROUNDS: usize = 6;
/// Pixels nearer than this to the fit belong to the background of the next round, at least.
const NEAR: f64 = 0.06;
/// About so many pixels are fitted; more would not change the fit.
const SAMPLES: usize = 60_000;

/// Coefficients over 1, x, y, x^2, x y, y^2 with x and y between -1 and 1.
type Surface = [f64; 6];

/// A background, and the distance of every pixel's colour from it, 0 for none, about 1 for black on white.
pub(super) struct Found {
    pub difference: Vec<f32>,
    /// Its colour at the rim, half of that being brighter and half darker, red, green and blue from 0 to 1.
    pub colour: [f64; 3],
}

/// Finds the background by the rim of a picture, or of the part of it where `within` holds; elsewhere nothing differs from it.
pub(super) fn find(pixels: &[[f32; 4]], width: usize, height: usize, within: Option<&[bool]>) -> Found {
    let basis = |k: usize| -> Surface {
        let x = 2.0 * ((k % width) as f64 + 0.5) / width as f64 - 1.0;
        let y = 2.0 * ((k / width) as f64 + 0.5) / height as f64 - 1.0;
        [1.0, x, y, x * x, x * y, y * y]
    };
    let rim = ((width.min(height) as f64 * RIM) as usize).max(1);
    let counts = |k: usize| within.is_none_or(|within| within[k]);
    let on_rim = |k: usize| {
        let (x, y) = (k % width, k / width);
        if x < rim || y < rim || x + rim >= width || y + rim >= height {
            return counts(k);
        }
        // Of a part: what is near to where it ends.
        within.is_some() && counts(k) && ![k - rim, k + rim, k - rim * width, k + rim * width].into_iter().all(counts)
    };
    let step = (pixels.len() / SAMPLES).max(1);
    // An odd stride that shares no divisor with the width walks over all columns.
    let samples: Vec<usize> = (0..pixels.len()).step_by(step).filter(|&k| counts(k)).collect();
    let mut chosen: Vec<usize> = samples.iter().copied().filter(|&k| on_rim(k)).collect();
    if chosen.len() < 64 {
        chosen = (0..pixels.len()).filter(|&k| on_rim(k)).collect();
    }
    // The rim's median first: a figure that runs over the rim must not bend the surface.
    let mut surfaces = [0, 1, 2].map(|c| [median(pixels, &chosen, c), 0.0, 0.0, 0.0, 0.0, 0.0]);
    let mut near = 4.0 * NEAR;
    let colour = surfaces.map(|surface| surface[0]);
    for _ in 0..ROUNDS {
        let close: Vec<usize> =
            samples.iter().copied().filter(|&k| distance(&pixels[k], &surfaces, &basis(k)) < near).collect();
        if close.len() < 64 {
            break;
        }
        let fitted = [0, 1, 2].map(|c| fit(&close, &basis, |k| f64::from(pixels[k][c])));
        let [Some(r), Some(g), Some(b)] = fitted else { break };
        surfaces = [r, g, b];
        near = (0.7 * near).max(NEAR);
    }
    let away = |k: usize| if counts(k) { distance(&pixels[k], &surfaces, &basis(k)) as f32 } else { 0.0 };
    Found { difference: (0..pixels.len()).map(away).collect(), colour }
}

fn median(pixels: &[[f32; 4]], chosen: &[usize], channel: usize) -> f64 {
    let mut values: Vec<f32> = chosen.iter().map(|&k| pixels[k][channel]).collect();
    values.sort_by(f32::total_cmp);
    values.get(values.len() / 2).copied().map_or(1.0, f64::from)
}

/// Euclidean distance in colour, scaled so that black and white are 1 apart.
fn distance(pixel: &[f32; 4], surfaces: &[Surface; 3], basis: &Surface) -> f64 {
    let of = |surface: &Surface| surface.iter().zip(basis).map(|(a, b)| a * b).sum::<f64>();
    let square: f64 = surfaces.iter().zip(pixel).map(|(s, &p)| (f64::from(p) - of(s)).powi(2)).sum();
    (square / 3.0).sqrt()
}

/// Least squares by the normal equations, six unknowns; `None` where they are singular.
fn fit(chosen: &[usize], basis: &impl Fn(usize) -> Surface, value: impl Fn(usize) -> f64) -> Option<Surface> {
    let mut m = [[0.0; 7]; 6];
    for &k in chosen {
        let b = basis(k);
        let v = value(k);
        for (i, row) in m.iter_mut().enumerate() {
            for j in 0..6 {
                row[j] += b[i] * b[j];
            }
            row[6] += b[i] * v;
        }
    }
    for i in 0..6 {
        let pivot = (i..6).max_by(|&a, &b| m[a][i].abs().total_cmp(&m[b][i].abs()))?;
        m.swap(i, pivot);
        if m[i][i].abs() < 1e-9 * chosen.len() as f64 {
            return None;
        }
        for r in 0..6 {
            if r != i {
                let factor = m[r][i] / m[i][i];
                let pivot = m[i];
                for (value, p) in m[r].iter_mut().zip(pivot).skip(i) {
                    *value -= factor * p;
                }
            }
        }
    }
    Some(std::array::from_fn(|i| m[i][6] / m[i][i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uneven_light_on_paper_is_background_and_ink_is_not() {
        let (width, height) = (120, 80);
        let mut pixels = Vec::new();
        for y in 0..height {
            for x in 0..width {
                let light = 0.9 - 0.3 * (x as f32 / width as f32) - 0.1 * (y as f32 / height as f32).powi(2);
                let ink = (30..90).contains(&x) && (20..60).contains(&y);
                pixels.push([if ink { 0.15 } else { light }; 4]);
            }
        }
        let ink = find(&pixels, width, height, None).difference;
        for y in 0..height {
            for x in 0..width {
                let inside = (30..90).contains(&x) && (20..60).contains(&y);
                let d = ink[y * width + x];
                assert!(if inside { d > 0.35 } else { d < 0.05 }, "{x} {y} {d}");
            }
        }
    }
}
