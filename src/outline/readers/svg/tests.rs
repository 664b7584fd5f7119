//! Drawings as text, and what is read of them.

use super::*;
use crate::outline::Background;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

fn svg(attributes: &str, body: &str) -> Vec<u8> {
    format!("<svg xmlns='http://www.w3.org/2000/svg' {attributes}>{body}</svg>").into_bytes()
}

#[test]
fn a_square_of_100_mm_is_that_in_every_unit() {
    for size in ["100mm", "10cm", "3.937007874in", "283.4645669pt", "377.9527559px", "377.9527559"] {
        for (view, body) in [
            ("viewBox='0 0 50 50'", "<rect width='50' height='50'/>"),
            ("", "<rect width='100%' height='100%' style='fill:red'/>"),
            ("viewBox='-1 -1 2 2'", "<path transform='rotate(90)' d='M-1-1h2v2h-2z'/>"),
        ] {
            let outline = read(&svg(&format!("width='{size}' height='{size}' {view}"), body), None).unwrap();
            let (low, high) = outline.bounding_box();
            assert_eq!((low, outline.outer.len()), ([0.0, 0.0], 4), "{size} {view}");
            assert!((high[0] - 100.0).abs() < 1e-4 && (high[1] - 100.0).abs() < 1e-4, "{size} {view} {high:?}");
            assert!((outline.area() - 1e4).abs() < 0.02);
        }
    }
}

#[test]
fn the_asked_height_wins_and_y_points_up() {
    let wedge = svg("width='10mm' height='20mm' viewBox='0 0 10 20'", "<path d='M2 2h6l-3 12z'/>");
    let outline = read(&wedge, Some(240.0)).unwrap();
    let (_, high) = outline.bounding_box();
    assert!((high[1] - 240.0).abs() < 1e-9 && (high[0] - 120.0).abs() < 1e-3);
    // The tip, at the bottom of the page, is at the bottom here too.
    assert!(outline.contains([60.0, 20.0]) && outline.contains([10.0, 235.0]) && !outline.contains([10.0, 20.0]));
    assert!(crate::outline::polygon::signed_area(&outline.outer) > 0.0);
}

#[test]
fn circles_meet_their_closed_form() {
    let disc =
        read(&svg("width='100mm' height='100mm' viewBox='0 0 100 100'", "<circle cx='50' cy='50' r='40'/>"), None);
    let area = disc.unwrap().area();
    assert!((area / (std::f64::consts::PI * 1600.0) - 1.0).abs() < 1e-3, "{area}");
    let ring = svg(
        "width='100mm' height='100mm' viewBox='0 0 100 100'",
        "<circle cx='50' cy='50' r='40' fill='none' stroke='black' stroke-width='10'/>",
    );
    let ring = read(&ring, None).unwrap();
    assert_eq!(ring.holes.len(), 1);
    let expected = std::f64::consts::PI * (45.0 * 45.0 - 35.0 * 35.0);
    assert!((ring.area() / expected - 1.0).abs() < 1e-3, "{}", ring.area());
    assert!(crate::outline::polygon::signed_area(&ring.holes[0]) < 0.0);
}

#[test]
fn fills_strokes_clips_and_references_are_united() {
    let body = "<defs><clipPath id='c'><rect x='0' y='0' width='50' height='100'/></clipPath>\
                <rect id='r' width='30' height='20'/></defs>\
                <g clip-path='url(#c)'><rect x='10' y='10' width='80' height='20'/></g>\
                <use href='#r' x='40' y='20'/>\
                <path d='M20 20V80' stroke='blue' stroke-width='10' fill='none'/>\
                <rect x='0' y='0' width='100' height='100' opacity='0'/>\
                <rect x='0' y='0' width='100' height='100' visibility='hidden'/>";
    let outline = read(&svg("width='100mm' height='100mm' viewBox='0 0 100 100'", body), None).unwrap();
    let (_, high) = outline.bounding_box();
    assert!((high[0] - 60.0).abs() < 1e-3 && (high[1] - 70.0).abs() < 1e-3, "{high:?}");
    assert!((outline.area() - (40.0 * 20.0 + 30.0 * 20.0 - 100.0 + 50.0 * 10.0)).abs() < 0.1, "{}", outline.area());
}

#[test]
fn faults_are_told_apart() {
    let attributes = "width='100' height='100'";
    let no_svg = |bytes: &[u8]| matches!(read(bytes, None), Err(OutlineError::Unreadable { format: "SVG", .. }));
    assert!(no_svg(b"\x89PNG") && no_svg(b"<note/>") && no_svg(b""));
    let nothing = |body: &str| matches!(read(&svg(attributes, body), None), Err(OutlineError::NothingPainted(_)));
    assert!(nothing("") && nothing("<path d='M0 0L50 50'/>") && nothing("<rect width='9' height='9' fill='none'/>"));
    assert!(nothing("<rect width='50' height='50' fill='url(#none)'/>"));
    let dots = "<circle cx='10' cy='10' r='5'/><circle cx='30' cy='10' r='5'/><circle cx='50' cy='10' r='5'/>";
    assert!(matches!(read(&svg(attributes, dots), None), Err(OutlineError::Pieces { pieces: 3, .. })));
    let hair = "<rect width='100' height='0.0005'/>";
    assert_eq!(read(&svg(attributes, hair), None), Err(OutlineError::Degenerate));
    let square = svg(attributes, "<rect width='50' height='50'/>");
    assert_eq!(read(&square, Some(-1.0)), Err(OutlineError::Asked { what: "height", value: -1.0 }));
    assert!(matches!(read(&square, Some(f64::NAN)), Err(OutlineError::Asked { .. })));
}

fn full(body: &str, import: &Import) -> Result<Imported, OutlineError> {
    crate::outline::import(&svg("width='100mm' height='100mm' viewBox='0 0 100 100'", body), import)
}

#[test]
fn a_rectangle_as_large_as_the_page_is_paper() {
    let body = "<rect width='100' height='100' fill='white'/><circle cx='50' cy='50' r='30' fill='white'/>";
    let dropped = full(body, &Import::default()).unwrap();
    assert!((dropped.outline.area() / (std::f64::consts::PI * 900.0) - 1.0).abs() < 1e-3);
    assert!(dropped.changes.notes[0].to_string().contains("background"), "{:?}", dropped.changes);
    let kept = full(body, &Import { background: Background::Keep, ..Import::default() }).unwrap();
    assert!((kept.outline.area() - 1e4).abs() < 0.1 && kept.changes.notes.is_empty());
    // Something of that size on top of others is no paper.
    let top = "<circle cx='50' cy='50' r='30'/><path d='M0 0h100v100h-100z'/>";
    assert!((full(top, &Import::default()).unwrap().outline.area() - 1e4).abs() < 0.1);
}

#[test]
fn masks_let_through_what_is_not_black() {
    let body = "<mask id='m'><rect width='100' height='100' fill='white'/><rect x='20' y='20' width='20' height='60'/>\
                </mask><rect x='10' y='10' width='60' height='80' mask='url(#m)'/>";
    let imported = full(body, &Import::default()).unwrap();
    assert!((imported.outline.area() - (4800.0 - 1200.0)).abs() < 0.1, "{}", imported.outline.area());
    assert_eq!(imported.outline.holes.len(), 1);
    let alpha = body.replace("<mask id='m'", "<mask id='m' style='mask-type:alpha'");
    assert!((full(&alpha, &Import::default()).unwrap().outline.area() - 4800.0).abs() < 0.1);
}

#[test]
fn text_is_set_in_the_bundled_font_or_refused() {
    let text = |t: &str| {
        full(&format!("<text x='10' y='80' font-size='80' font-family='Nowhere'>{t}</text>"), &Import::default())
    };
    let imported = text("S").unwrap();
    assert!(
        imported.outline.area() > 100.0 && imported.changes.notes[0].to_string().contains("Ubuntu"),
        "{:?}",
        imported.changes
    );
    assert!(matches!(text("i"), Err(OutlineError::Pieces { pieces: 2, .. })));
    assert!(matches!(text("\u{6f22}"), Err(OutlineError::NoFont(_))), "{:?}", text("\u{6f22}"));
}

#[test]
fn what_is_left_out_is_noted() {
    let pixel = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==";
    let body = format!("<rect x='20' y='20' width='90' height='40'/><image href='{pixel}' width='10' height='10'/>");
    let notes = full(&body, &Import::default()).unwrap().changes.notes;
    assert!(
        notes.iter().any(|n| n.to_string().contains("picture"))
            && notes.iter().any(|n| n.to_string().contains("off the page")),
        "{notes:?}"
    );
    let shadow = "<filter id='f'><feGaussianBlur stdDeviation='2'/></filter><rect x='9' y='9' width='70' height='70' filter='url(#f)'/>";
    assert!(full(shadow, &Import::default()).unwrap().changes.notes[0].to_string().contains("filter"));
}

#[test]
fn a_drawing_of_a_picture_alone_is_read_as_what_that_shows_where_it_lies() {
    let mut disc = image::RgbImage::from_pixel(200, 100, image::Rgb([250, 248, 240]));
    for (x, y, pixel) in disc.enumerate_pixels_mut() {
        if (f64::from(x) - 69.5).hypot(f64::from(y) - 49.5) < 40.0 {
            *pixel = image::Rgb([60, 40, 30]);
        }
    }
    let mut png = std::io::Cursor::new(Vec::new());
    disc.write_to(&mut png, image::ImageFormat::Png).unwrap();
    let picture = format!(
        "<image x='20' y='30' width='100' height='50' href='data:image/png;base64,{}'/>",
        STANDARD.encode(png.get_ref())
    );
    for below in ["", "<rect width='200' height='120' fill='#fff'/>"] {
        let drawing = svg("width='200mm' height='120mm' viewBox='0 0 200 120'", &format!("{below}{picture}"));
        let read = import(&drawing, &Import::default()).unwrap();
        let (low, high) = read.outline.bounding_box();
        assert!((high[0] - low[0] - 40.0).abs() < 0.5 && (high[1] - low[1] - 40.0).abs() < 0.5, "{low:?} {high:?}");
        assert!((read.outline.area() / (std::f64::consts::PI * 400.0) - 1.0).abs() < 0.01);
        assert!(read.changes.notes.contains(&Note::PicturesAlone), "{:?}", read.changes.notes);
        // Its texture is the picture at the same place.
        let shown = texture(&drawing, &Import::default(), read.drawn_box).unwrap();
        let middle = shown.get_pixel(shown.width() / 2, shown.height() / 2).0;
        assert!(middle[0].abs_diff(60) < 4 && middle[2].abs_diff(30) < 4 && middle[3] == 255, "{middle:?}");
    }
    // Shapes beside a picture count, and the picture does not.
    let both = svg(
        "width='200mm' height='120mm' viewBox='0 0 200 120'",
        &format!("{picture}<circle cx='150' cy='60' r='30'/>"),
    );
    let read = import(&both, &Import::default()).unwrap();
    assert!((read.outline.area() / (std::f64::consts::PI * 900.0) - 1.0).abs() < 0.01);
    assert!(read.changes.notes.contains(&Note::EmbeddedPictures(1)));
}

#[test]
fn of_thousands_of_hairs_the_outline_stays_within_what_scissors_follow() {
    let hair = |k: usize| {
        let a = k as f64 * 2.399_963; // The golden angle spreads them evenly.
        let r = 38.0 * (k as f64 / 6000.0).sqrt();
        let (x, y) = (50.0 + r * a.cos(), 50.0 + r * a.sin());
        format!("<path d='M{x:.2} {y:.2}q.4 .6 1.2 .4'/>")
    };
    let hairs: String = (0..6000).map(hair).collect();
    let svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'><circle cx='50' cy='50' r='40'/>\
         <g fill='none' stroke='#000' stroke-width='.2' stroke-linecap='round'>{hairs}</g></svg>"
    );
    let outline = read(svg.as_bytes(), None).unwrap();
    let off = outline.outer.iter().map(|p| ((p[0] - 40.0).hypot(p[1] - 40.0) - 40.0).abs()).fold(0.0, f64::max);
    assert!(off < 0.04 && (outline.area() / (std::f64::consts::PI * 1600.0) - 1.0).abs() < 1e-3, "{off}");
}
