//! Transforms as style sheets write them (CSS Transforms Level 1): `translate(10px, -5%) rotate(30deg)` about a `transform-origin`.

/// The box that percentages and the origin refer to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reference {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

/// An affine map `[a, b, c, d, e, f]`, as SVG writes it.
pub(super) type Matrix = [f64; 6];

const IDENTITY: Matrix = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0];

/// The map of a `transform` about an origin; `None` for what is none or is not followed (in space, relative to a font).
pub(super) fn matrix(transform: &str, origin: Option<&str>, reference: &Reference) -> Option<Matrix> {
    let mut map = IDENTITY;
    let mut rest = transform.trim();
    if rest == "none" {
        return Some(IDENTITY);
    }
    while !rest.is_empty() {
        let (name, after) = rest.split_once('(')?;
        let (inside, after) = after.split_once(')')?;
        let values: Vec<&str> = inside.split([',', ' ']).map(str::trim).filter(|word| !word.is_empty()).collect();
        map = times(&map, &function(name.trim(), &values, reference)?);
        rest = after.trim_start_matches([' ', ',', '\t', '\n', '\r']);
    }
    let [x, y] = place(origin.unwrap_or("0 0"), reference)?;
    let there = [1.0, 0.0, 0.0, 1.0, x, y];
    let back = [1.0, 0.0, 0.0, 1.0, -x, -y];
    let map = times(&times(&there, &map), &back);
    map.iter().all(|v| v.is_finite()).then_some(map)
}

fn function(name: &str, values: &[&str], reference: &Reference) -> Option<Matrix> {
    let number = |k: usize| values.get(k)?.parse::<f64>().ok();
    let along = |k: usize, side| length(values.get(k)?, side);
    let turn = |k: usize| angle(values.get(k)?);
    let (wide, high) = (reference.width, reference.height);
    Some(match name {
        "matrix" if values.len() == 6 => {
            let mut matrix = IDENTITY;
            for (k, value) in matrix.iter_mut().enumerate() {
                *value = number(k)?;
            }
            matrix
        }
        "translate" | "translate3d" => {
            [1.0, 0.0, 0.0, 1.0, along(0, wide)?, if values.len() > 1 { along(1, high)? } else { 0.0 }]
        }
        "translateX" => [1.0, 0.0, 0.0, 1.0, along(0, wide)?, 0.0],
        "translateY" => [1.0, 0.0, 0.0, 1.0, 0.0, along(0, high)?],
        "scale" => {
            let x = share(values.first()?)?;
            [x, 0.0, 0.0, values.get(1).map_or(Some(x), |y| share(y))?, 0.0, 0.0]
        }
        "scaleX" => [share(values.first()?)?, 0.0, 0.0, 1.0, 0.0, 0.0],
        "scaleY" => [1.0, 0.0, 0.0, share(values.first()?)?, 0.0, 0.0],
        "rotate" | "rotateZ" => {
            let (sin, cos) = turn(0)?.sin_cos();
            [cos, sin, -sin, cos, 0.0, 0.0]
        }
        "skew" => [1.0, if values.len() > 1 { turn(1)?.tan() } else { 0.0 }, turn(0)?.tan(), 1.0, 0.0, 0.0],
        "skewX" => [1.0, 0.0, turn(0)?.tan(), 1.0, 0.0, 0.0],
        "skewY" => [1.0, turn(0)?.tan(), 0.0, 1.0, 0.0, 0.0],
        _ => return None,
    })
}

/// The point that an origin names.
fn place(text: &str, reference: &Reference) -> Option<[f64; 2]> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let (first, second) = (*words.first()?, words.get(1).copied().unwrap_or("center"));
    // "top left" is "left top".
    let swapped = ["top", "bottom"].contains(&first) || ["left", "right"].contains(&second);
    let (x, y) = if swapped { (second, first) } else { (first, second) };
    let along = |word: &str, side: f64| match word {
        "left" | "top" => Some(0.0),
        "center" => Some(0.5 * side),
        "right" | "bottom" => Some(side),
        word => length(word, side),
    };
    Some([reference.x + along(x, reference.width)?, reference.y + along(y, reference.height)?])
}

/// A length in px; `side` is what 100 % are.
pub(super) fn length(text: &str, side: f64) -> Option<f64> {
    let (number, unit) = split(text)?;
    Some(
        number
            * match unit {
                "" | "px" => 1.0,
                "%" => side / 100.0,
                "mm" => 96.0 / 25.4,
                "cm" => 960.0 / 25.4,
                "q" => 24.0 / 25.4,
                "in" => 96.0,
                "pt" => 96.0 / 72.0,
                "pc" => 16.0,
                _ => return None,
            },
    )
}

fn angle(text: &str) -> Option<f64> {
    let (number, unit) = split(text)?;
    Some(match unit {
        "deg" | "" => number.to_radians(),
        "rad" => number,
        "grad" => (0.9 * number).to_radians(),
        "turn" => std::f64::consts::TAU * number,
        _ => return None,
    })
}

fn share(text: &str) -> Option<f64> {
    let (number, unit) = split(text)?;
    match unit {
        "" => Some(number),
        "%" => Some(number / 100.0),
        _ => None,
    }
}

fn split(text: &str) -> Option<(f64, &str)> {
    let end = text.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).unwrap_or(text.len());
    // A number may have an exponent, which begins as a unit does.
    let end = match text[end..].strip_prefix(['e', 'E']) {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit() || "+-".contains(c)) => {
            let exponent = rest.find(|c: char| !(c.is_ascii_digit() || "+-".contains(c))).unwrap_or(rest.len());
            end + 1 + exponent
        }
        _ => end,
    };
    Some((text[..end].parse().ok()?, &text[end..]))
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    [
        a[0] * b[0] + a[2] * b[1],
        a[1] * b[0] + a[3] * b[1],
        a[0] * b[2] + a[2] * b[3],
        a[1] * b[2] + a[3] * b[3],
        a[0] * b[4] + a[2] * b[5] + a[4],
        a[1] * b[4] + a[3] * b[5] + a[5],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Reference = Reference { x: 10.0, y: 20.0, width: 100.0, height: 50.0 };

    fn at(transform: &str, origin: Option<&str>, [x, y]: [f64; 2]) -> [f64; 2] {
        let m = matrix(transform, origin, &BOX).unwrap();
        [m[0] * x + m[2] * y + m[4], m[1] * x + m[3] * y + m[5]].map(|v| (v * 1e9).round() / 1e9)
    }

    #[test]
    fn functions_follow_each_other_about_the_origin() {
        assert_eq!(at("translate(10px, 10%)", None, [1.0, 1.0]), [11.0, 6.0]);
        // The quarter turn about the middle of the box keeps the middle.
        for origin in ["center", "50% 50%", "50px 25px"] {
            assert_eq!(at("rotate(90deg)", Some(origin), [60.0, 45.0]), [60.0, 45.0]);
            assert_eq!(at("rotate(.25turn)", Some(origin), [61.0, 45.0]), [60.0, 46.0]);
        }
        assert_eq!(at("scale(2) translateX(1e1px)", Some("top left"), [10.0, 20.0]), [30.0, 20.0]);
        assert_eq!(at("matrix(1,0,0,1,3,4) skewX(45deg)", Some("left top"), [10.0, 21.0]), [14.0, 25.0]);
        assert_eq!(matrix("rotate3d(1, 0, 0, 5deg)", None, &BOX), None);
        assert_eq!(matrix("translate(2em)", None, &BOX), None);
    }
}
