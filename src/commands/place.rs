//! Places on the command line, `X,Y` and `X,Y=X2,Y2` in mm.

use crate::design::Hold;
use crate::operations::pose::{Held, Move};
use crate::outline::Point;

/// Reads `X,Y`.
pub fn parse_point(text: &str) -> Result<Point, String> {
    let explain = || format!("expected X,Y in mm, found `{text}`");
    let (x, y) = text.split_once(',').ok_or_else(explain)?;
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(explain);
    Ok([number(x)?, number(y)?])
}

/// Reads `X,Y=X2,Y2`.
pub fn parse_move(text: &str) -> Result<Move, String> {
    let explain = || format!("expected X,Y=X2,Y2 in mm, found `{text}`");
    let (from, to) = text.split_once('=').ok_or_else(explain)?;
    Ok(Move { from: parse_point(from).map_err(|_| explain())?, to: parse_point(to).map_err(|_| explain())? })
}

/// Reads `X,Y=DEGREES`: a pin that slides.
pub fn parse_line(text: &str) -> Result<Held, String> {
    let (at, degrees) = place_and_number(text, "X,Y=DEGREES")?;
    Ok(Held { at, hold: Hold::Line { degrees } })
}

/// Reads `X,Y=RADIUS`: a pin that holds a region.
pub fn parse_region(text: &str) -> Result<Held, String> {
    let (at, radius_mm) = place_and_number(text, "X,Y=RADIUS")?;
    Ok(Held { at, hold: Hold::Region { radius_mm, degrees: 0.0 } })
}

fn place_and_number(text: &str, form: &str) -> Result<(Point, f64), String> {
    let explain = || format!("expected {form} with X,Y in mm, found `{text}`");
    let (at, number) = text.split_once('=').ok_or_else(explain)?;
    let number = number.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(explain)?;
    Ok((parse_point(at).map_err(|_| explain())?, number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_moves_read_back() {
        assert_eq!(parse_point("3,-4.5"), Ok([3.0, -4.5]));
        assert_eq!(parse_point("-1e1, 2"), Ok([-10.0, 2.0]));
        assert_eq!(parse_move("1,2=-3,4"), Ok(Move { from: [1.0, 2.0], to: [-3.0, 4.0] }));
    }

    #[test]
    fn bad_text_is_quoted() {
        for bad in ["", "1", "1;2", "1,2,3", "a,b", "nan,1", "1,inf"] {
            assert!(parse_point(bad).unwrap_err().contains(&format!("`{bad}`")), "{bad}");
        }
        for bad in ["1,2", "1,2=3", "1,2=3,4=5,6", "=1,2"] {
            assert!(parse_move(bad).unwrap_err().contains(&format!("`{bad}`")), "{bad}");
        }
    }
}
