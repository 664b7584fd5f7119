use crate::outline::{Import, Note, OutlineError, import};

fn outline_of(style: &str, body: &str) -> Result<crate::outline::Imported, OutlineError> {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>\
         <style>{style}</style>{body}</svg>"
    );
    import(text.as_bytes(), &Import::default())
}

fn box_of(style: &str, body: &str) -> [f64; 2] {
    let (_, high) = outline_of(style, body).unwrap().outline.bounding_box();
    high.map(|v| (v * 1e3).round() / 1e3)
}

/// Two squares of which styles show one: by its box it is told which.
#[test]
fn selectors_choose_what_browsers_choose() {
    let body = "<g class='t u'><rect class='a' width='30' height='20'/><rect id='b' width='50' height='40'/></g>";
    for (style, size) in [
        ("rect { fill: none } .t > rect:not(#b) { fill: red }", [30.0, 20.0]),
        ("rect { fill: none } g.u rect + rect { fill: red }", [50.0, 40.0]),
        ("rect { fill: none } @media screen { rect:nth-child(2n) { fill: red } }", [50.0, 40.0]),
        ("rect { fill: none } @media print { rect { fill: red } } :is(.a, .z) { fill: red }", [30.0, 20.0]),
        ("rect:last-of-type { display: none } @media all { #b { fill: red } }", [30.0, 20.0]),
        ("rect:not(.a) { fill: none !important } rect { fill: red } #b { fill: red }", [30.0, 20.0]),
        // It weighs nothing, but holds; and nothing is pointed at.
        (":where(#b) { fill: none } rect + rect:hover { fill: red }", [30.0, 20.0]),
        (":where(#b) { fill: none } rect { fill: red } rect ~ rect:hover { fill: none }", [50.0, 40.0]),
    ] {
        assert_eq!(box_of(style, body), size, "{style}");
    }
    let told = outline_of("rect:has(g) { fill: none } .a:not(.b) { fill: red }", body).unwrap().changes.notes;
    assert!(told.contains(&Note::Styles("rect:has(g)".to_owned())), "{told:?}");
}

#[test]
fn styles_move_and_shape_elements() {
    for (style, body, size) in [
        ("circle { cx: 50px; cy: 5cm; r: 20px }", "<circle/>", [40.0, 40.0]),
        ("", "<rect width='10' height='10' style='width: 60px; height: 20px'/>", [60.0, 20.0]),
        ("path { d: path('M0 0h30v40h-30z') }", "<path d='M0 0h9v9h-9z'/>", [30.0, 40.0]),
        ("", "<g style='transform: scale(2, 3)'><rect width='10' height='10'/></g>", [20.0, 30.0]),
        // The quarter turn about its own middle.
        (
            ".t { transform: rotate(90deg); transform-origin: center; transform-box: fill-box }",
            "<rect class='t' x='10' y='30' width='50' height='10'/><rect x='30' y='30' width='10' height='10'/>",
            [10.0, 50.0],
        ),
        (
            "",
            "<g style='transform-origin: 50px 50px; transform: rotate(180deg)'><rect width='30' height='20'/></g>\
             <rect x='65' y='80' width='35' height='20'/>",
            [35.0, 20.0],
        ),
    ] {
        let found = box_of(style, body);
        assert!((found[0] - size[0]).abs() < 0.01 && (found[1] - size[1]).abs() < 0.01, "{style} {body}: {found:?}");
    }
}
