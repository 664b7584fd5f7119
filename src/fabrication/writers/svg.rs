//! Sheets as SVG: sizes in mm with a matching view box, so that one unit is one millimetre in every program.

use crate::fabrication::product::Content;
use crate::fabrication::sheet::{Anchor, Color, Entity, Group, Sheet};
use crate::outline::Point;
use std::fmt::Write as _;

/// The bytes of an SVG file.
pub(super) fn write(content: &Content) -> Option<Vec<u8>> {
    match content {
        Content::Sheet(sheet) | Content::Cut(sheet) => Some(svg(sheet).into_bytes()),
        _ => None,
    }
}

/// The text of a sheet. Coordinates are flipped (y down) and rounded to 0.1 micrometre.
fn svg(sheet: &Sheet) -> String {
    String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n") + &element(sheet)
}

/// The element `svg` of a sheet, for pages that hold it. Groups of one piece stand in a group with the piece's name.
pub(super) fn element(sheet: &Sheet) -> String {
    let (w, h) = (number(sheet.width_mm), number(sheet.height_mm));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\">\n"
    );
    svg += &format!("  <title>{}</title>\n", escaped(&sheet.title));
    for groups in sheet.groups.chunk_by(|a, b| a.piece.is_some() && a.piece == b.piece) {
        let piece = groups[0].piece.as_ref();
        if let Some(piece) = piece {
            svg += &format!("  <g id=\"{}\">\n", escaped(piece));
        }
        for group in groups {
            write_group(&mut svg, sheet.height_mm, group);
        }
        if piece.is_some() {
            svg += "  </g>\n";
        }
    }
    svg += "</svg>\n";
    svg
}

fn write_group(svg: &mut String, height: f64, group: &Group) {
    let style = &group.style;
    if let Some([low, high]) = group.clip {
        let (x, y) = (number(low[0]), number(height - high[1]));
        let (w, h) = (number(high[0] - low[0]), number(high[1] - low[1]));
        let name = escaped(&group.name);
        *svg += &format!(
            "  <clipPath id=\"{name}-clip\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n"
        );
    }
    *svg += &format!(
        "  <g id=\"{}\" fill=\"{}\" stroke=\"{}\"",
        escaped(&group.name),
        paint(style.fill),
        paint(style.stroke)
    );
    if style.stroke.is_some() {
        *svg += &format!(
            " stroke-width=\"{}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"",
            number(style.stroke_mm)
        );
    }
    if style.stroke.is_some() && !style.dash.is_empty() {
        let lengths: Vec<String> = style.dash.iter().map(|&v| number(v)).collect();
        *svg += &format!(" stroke-dasharray=\"{}\"", lengths.join(" "));
    }
    if group.clip.is_some() {
        *svg += &format!(" clip-path=\"url(#{}-clip)\"", escaped(&group.name));
    }
    *svg += ">\n";
    for entity in &group.entities {
        match entity {
            Entity::Polygon(points) => *svg += &format!("    <path d=\"{}Z\"/>\n", path(points, height)),
            // Lines have no inside.
            Entity::Polyline(points) if style.fill.is_some() => {
                *svg += &format!("    <path d=\"{}\" fill=\"none\"/>\n", path(points, height));
            }
            Entity::Polyline(points) => *svg += &format!("    <path d=\"{}\"/>\n", path(points, height)),
            Entity::Circle { center, radius } => {
                let (x, y) = (number(center[0]), number(height - center[1]));
                *svg += &format!("    <circle cx=\"{x}\" cy=\"{y}\" r=\"{}\"/>\n", number(*radius));
            }
            Entity::Text { at, size_mm, anchor, text } => {
                let (x, y, size) = (number(at[0]), number(height - at[1]), number(*size_mm));
                let color = paint(style.stroke.or(style.fill));
                let anchor = match anchor {
                    Anchor::Start => "start",
                    Anchor::Middle => "middle",
                };
                *svg += &format!(
                    "    <text x=\"{x}\" y=\"{y}\" font-family=\"Ubuntu, sans-serif\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
                     fill=\"{color}\" stroke=\"none\">{}</text>\n",
                    escaped(text)
                );
            }
        }
    }
    *svg += "  </g>\n";
}

fn path(points: &[Point], height: f64) -> String {
    let mut d = String::new();
    for (i, p) in points.iter().enumerate() {
        let command = if i == 0 { 'M' } else { 'L' };
        // Writing to a string cannot fail.
        let _ = write!(d, "{command}{} {}", number(p[0]), number(height - p[1]));
    }
    d
}

/// Four decimals at most, without trailing zeros.
pub(super) fn number(v: f64) -> String {
    let text = format!("{v:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn paint(color: Option<Color>) -> String {
    color.map_or("none".into(), |Color(r, g, b)| format!("#{r:02X}{g:02X}{b:02X}"))
}

/// Text as XML content or attribute; characters that XML has no way to hold become a question mark.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('?'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::sheet::{RED, Style};

    #[test]
    fn golden_text() {
        let mut group = Group::new("cut", Style::hairline(RED));
        group.entities.push(Entity::Polygon(vec![[0.0, 0.0], [30.0, 0.0], [0.0, 20.00004]]));
        group.entities.push(Entity::Circle { center: [10.5, 20.0], radius: 0.75 });
        group.text([1.0, 2.0], 4.0, Anchor::Middle, "<R & D> \"\u{1}\"");
        let sheet = Sheet { title: "a < b".into(), width_mm: 30.0, height_mm: 20.0, groups: vec![group] };
        let expected = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"30mm\" height=\"20mm\" viewBox=\"0 0 30 20\">
  <title>a &lt; b</title>
  <g id=\"cut\" fill=\"none\" stroke=\"#FF0000\" stroke-width=\"0.01\" stroke-linecap=\"round\" stroke-linejoin=\"round\">
    <path d=\"M0 20L30 20L0 0Z\"/>
    <circle cx=\"10.5\" cy=\"0\" r=\"0.75\"/>
    <text x=\"1\" y=\"18\" font-family=\"Ubuntu, sans-serif\" font-size=\"4\" text-anchor=\"middle\" fill=\"#FF0000\" \
stroke=\"none\">&lt;R &amp; D&gt; &quot;?&quot;</text>
  </g>
</svg>
";
        assert_eq!(super::svg(&sheet), expected);
    }
}
