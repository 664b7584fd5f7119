//! Where a gradient that fades out can be seen: a glow, a shadow and the tail of a comet end where they are hardly opaque.
//!
//! Along a gradient `t` runs from 0 to 1 and its opacity is piecewise linear. What is opaque enough lies between values of `t`: in strips
//! across a linear gradient, and between discs of a radial one, whose circle of `t` has its centre at `f + t (c - f)` and the radius
//! `fr + t (r - fr)`.

use crate::outline::Point;
use crate::outline::regions::{self, Shapes};
use i_overlay::core::fill_rule::FillRule;
use std::f64::consts::TAU;
use std::ops::Range;
use usvg::{Paint, SpreadMethod, Stop, Transform};

/// Points of a disc: within 0.1 % of its radius.
const DISC: usize = 96;

/// The part of the plane (px, y up) in which a paint is at least so opaque; `None` where that is all of it or nothing. `within`: the box of
/// what is painted, in its own coordinates; `place`: where these lie.
pub(super) fn dense(paint: &Paint, least: f32, within: [[f32; 2]; 2], place: Transform) -> Option<Shapes> {
    let gradient: &usvg::BaseGradient = match paint {
        Paint::LinearGradient(gradient) => gradient,
        Paint::RadialGradient(gradient) => gradient,
        _ => return None,
    };
    let parts = intervals(gradient.stops(), f64::from(least));
    let all = parts.iter().any(|part| part.start == f64::NEG_INFINITY && part.end == f64::INFINITY);
    if parts.is_empty() || all || gradient.spread_method() != SpreadMethod::Pad {
        return None;
    }
    let to_own = gradient.transform().invert()?;
    let [low, high] = within;
    let mut corners = [low, [high[0], low[1]], high, [low[0], high[1]]].map(|[x, y]| {
        let mut p = usvg::tiny_skia_path::Point::from_xy(x, y);
        to_own.map_point(&mut p);
        [f64::from(p.x), f64::from(p.y)]
    });
    corners.iter_mut().flatten().for_each(|v| *v = v.clamp(-1e9, 1e9));
    let rings = match paint {
        Paint::LinearGradient(g) => {
            let ends = [[g.x1(), g.y1()], [g.x2(), g.y2()]].map(|p| p.map(f64::from));
            parts.iter().filter_map(|part| strip(ends, part, &corners)).map(|strip| vec![strip]).collect()
        }
        Paint::RadialGradient(g) => {
            let focus = [g.fx(), g.fy(), g.fr().get()].map(f64::from);
            let outer = [g.cx(), g.cy(), g.r().get()].map(f64::from);
            parts.iter().filter_map(|part| annulus(focus, outer, part, &corners)).collect::<Vec<_>>()
        }
        _ => return None,
    };
    let transform = place.pre_concat(gradient.transform());
    let placed = |ring: &Vec<Point>| -> Vec<Point> {
        let at = |p: &Point| {
            let mut p = usvg::tiny_skia_path::Point::from_xy(p[0] as f32, p[1] as f32);
            transform.map_point(&mut p);
            [f64::from(p.x), -f64::from(p.y)]
        };
        ring.iter().map(at).collect()
    };
    let resolved = rings.iter().map(|rings: &Vec<Vec<Point>>| {
        regions::resolve(&rings.iter().map(placed).collect::<Vec<_>>(), FillRule::EvenOdd)
    });
    let parts: Shapes = resolved.collect::<Result<Vec<_>, _>>().ok()?.concat();
    regions::union(parts).ok()
}

/// Where along a gradient its opacity is at least so large; what lies before the first stop and after the last is like these.
fn intervals(stops: &[Stop], least: f64) -> Vec<Range<f64>> {
    let of = |stop: &Stop| (f64::from(stop.offset().get()), f64::from(stop.opacity().get()));
    let (Some(first), Some(last)) = (stops.first().map(of), stops.last().map(of)) else { return Vec::new() };
    let mut found = Vec::new();
    let mut open = (first.1 >= least).then_some(f64::NEG_INFINITY);
    for pair in stops.windows(2) {
        let ((from, a), (to, b)) = (of(&pair[0]), of(&pair[1]));
        let crossing = || from + (to - from) * ((least - a) / (b - a)).clamp(0.0, 1.0);
        match (a >= least, b >= least, open) {
            (true, false, Some(start)) => {
                found.push(start..crossing());
                open = None;
            }
            (false, true, None) => open = Some(crossing()),
            _ => {}
        }
    }
    found.extend(open.filter(|_| last.1 >= least).map(|start| start..f64::INFINITY));
    found.retain(|part| part.end > part.start);
    found
}

/// The strip across a linear gradient, as far as the corners of a box reach.
fn strip([from, to]: [Point; 2], part: &Range<f64>, corners: &[Point; 4]) -> Option<Vec<Point>> {
    let u = [to[0] - from[0], to[1] - from[1]];
    let square = u[0] * u[0] + u[1] * u[1];
    if square.is_nan() || square <= 0.0 {
        return None;
    }
    let along = |p: &Point| ((p[0] - from[0]) * u[0] + (p[1] - from[1]) * u[1]) / square;
    let across = |p: &Point| ((p[1] - from[1]) * u[0] - (p[0] - from[0]) * u[1]) / square;
    let reach = |of: &dyn Fn(&Point) -> f64| {
        corners.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
    };
    let ((t_low, t_high), (s_low, s_high)) = (reach(&along), reach(&across));
    let (start, end) = (part.start.max(t_low), part.end.min(t_high));
    let at = |t: f64, s: f64| [from[0] + t * u[0] - s * u[1], from[1] + t * u[1] + s * u[0]];
    (end > start).then(|| vec![at(start, s_low), at(end, s_low), at(end, s_high), at(start, s_high)])
}

/// What lies between two circles of a radial gradient (centre and radius each, `t` 0 and 1), the outer ring first.
fn annulus(focus: [f64; 3], outer: [f64; 3], part: &Range<f64>, corners: &[Point; 4]) -> Option<Vec<Vec<Point>>> {
    let at = |t: f64| [0, 1, 2].map(|i| focus[i] + t * (outer[i] - focus[i]));
    let disc = |[x, y, r]: [f64; 3]| -> Vec<Point> {
        (0..DISC).map(|i| TAU * i as f64 / DISC as f64).map(|a| [x + r * a.cos(), y + r * a.sin()]).collect()
    };
    let far = corners.iter().map(|p| (p[0] - outer[0]).hypot(p[1] - outer[1])).fold(outer[2], f64::max);
    let end = if part.end.is_finite() { at(part.end) } else { [outer[0], outer[1], 2.0 * far] };
    let mut rings = vec![disc(end)];
    // A disc of no size is none.
    rings.extend(Some(part.start).filter(|t| *t > 0.0).map(at).filter(|circle| circle[2] > 0.0).map(disc));
    (end[2] > 0.0).then_some(rings)
}

#[cfg(test)]
mod tests {
    use crate::outline::{Import, Note, import};
    use std::f64::consts::PI;

    fn area(gradient: &str, body: &str) -> f64 {
        let page = "xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'";
        let text = format!("<svg {page}><defs>{gradient}</defs>{body}</svg>");
        let read = import(text.as_bytes(), &Import::default()).unwrap();
        assert!(read.changes.notes.iter().any(|note| matches!(note, Note::Faint { .. })), "{:?}", read.changes.notes);
        read.outline.area()
    }

    #[test]
    fn a_gradient_counts_where_it_is_opaque() {
        // Down to 40 % at 60 % of the way.
        let stops = "<stop offset='0'/><stop offset='1' stop-opacity='0'/>";
        let bar = "<rect x='10' y='30' width='80' height='40' fill='url(#g)'/>";
        let linear = |more: &str| format!("<linearGradient id='g' {more}>{stops}</linearGradient>");
        for more in ["", "gradientUnits='userSpaceOnUse' x1='10' x2='90'", "gradientTransform='matrix(-1 0 0 1 1 0)'"] {
            assert!((area(&linear(more), bar) / (0.6 * 3200.0) - 1.0).abs() < 1e-3, "{more}");
        }
        let radial = format!("<radialGradient id='g' fx='0.6'>{stops}</radialGradient>");
        let glow = "<circle cx='50' cy='50' r='40' fill='url(#g)'/>";
        // The circle of t = 0.6: 0.6 of the radius.
        assert!((area(&radial, glow) / (PI * 24.0 * 24.0) - 1.0).abs() < 5e-3);
        let ring = "<radialGradient id='g'><stop offset='0.5' stop-opacity='0'/><stop offset='0.5'/></radialGradient>";
        assert!((area(ring, glow) / (PI * (1600.0 - 400.0)) - 1.0).abs() < 5e-3);
    }

    #[test]
    fn a_shadow_that_fades_does_not_count() {
        let stops = "<stop offset='0' stop-opacity='0.6'/><stop offset='1' stop-opacity='0'/>";
        let shadow = format!("<radialGradient id='g'>{stops}</radialGradient>");
        let body =
            "<ellipse cx='50' cy='80' rx='45' ry='10' fill='url(#g)'/><rect x='30' y='20' width='40' height='62'/>";
        let found = area(&shadow, body);
        // A third of the radii stays: 15 x 3.3 about (50, 80), within the body but for its lower rim.
        assert!((found / (40.0 * 62.0) - 1.0).abs() < 0.02, "{found}");
    }
}
