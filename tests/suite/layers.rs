//! Chosen layers of drawings: what counts, what still holds for it, and what is refused.

use plushwright::outline::{Import, OutlineError, Pieces, import};
use std::process::Command;

const PI: f64 = std::f64::consts::PI;

fn svg(body: &str) -> Vec<u8> {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
         xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' \
         width='100mm' height='100mm' viewBox='0 0 100 100'>{body}</svg>"
    )
    .into_bytes()
}

fn dxf(blocks: &str, entities: &str) -> Vec<u8> {
    let header = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC";
    let all = format!("{header} 0 SECTION 2 BLOCKS {blocks} 0 ENDSEC 0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF");
    // An underscore stands for a space within a value.
    all.split_whitespace().map(|word| word.replace('_', " ")).collect::<Vec<_>>().join("\r\n").into_bytes()
}

fn options(layers: &[&str]) -> Import {
    let layers = layers.iter().map(|&name| name.to_owned()).collect();
    Import { layers, pieces: Pieces::Largest, ..Import::default() }
}

/// Width and height of the silhouette's box, and its area.
fn measures(file: &[u8], layers: &[&str]) -> [f64; 3] {
    let outline = import(file, &options(layers)).unwrap().outline;
    let (_, high) = outline.bounding_box();
    [high[0], high[1], outline.area()]
}

fn assert_near(file: &[u8], layers: &[&str], expected: [f64; 3]) {
    let found = measures(file, layers);
    for (a, b) in found.iter().zip(expected) {
        assert!((a / b - 1.0).abs() < 2e-3, "{layers:?}: {found:?}, not {expected:?}");
    }
}

fn refusal(file: &[u8], layers: &[&str]) -> String {
    import(file, &options(layers)).unwrap_err().to_string()
}

#[test]
fn groups_and_elements_are_chosen_by_id() {
    let file = svg("<g id='body'><rect x='20' y='20' width='60' height='40'/></g>\
                    <g id='ears'><rect x='20' y='10' width='10' height='15'/></g>\
                    <circle id='eye' cx='50' cy='80' r='10'/><path d='M0 0h100v5h-100z'/>");
    assert_near(&file, &["body"], [60.0, 40.0, 2400.0]);
    assert_near(&file, &["body", "ears"], [60.0, 50.0, 2500.0]);
    assert_near(&file, &["ears", "body", "ears"], [60.0, 50.0, 2500.0]);
    assert_near(&file, &["eye"], [20.0, 20.0, 100.0 * PI]);
    assert_eq!(import(&file, &options(&["body"])).unwrap().changes.steps, []);
}

#[test]
fn layers_are_chosen_by_their_inkscape_labels() {
    let file = svg("<g inkscape:groupmode='layer' id='g1' inkscape:label='The body'><rect width='50' height='50'/>\
                    <rect id='rect7' inkscape:label='belly' x='50' width='20' height='10'/></g>\
                    <g inkscape:groupmode='layer' id='g2' inkscape:label='Ears'><rect y='50' width='10' height='50'/></g>\
                    <g id='guides'><rect x='70' width='30' height='100'/></g>");
    assert_near(&file, &["The body"], [70.0, 50.0, 2700.0]);
    assert_near(&file, &["The body", "g2"], [70.0, 100.0, 3200.0]);
    assert_near(&file, &["belly"], [20.0, 10.0, 200.0]);
    assert_eq!(refusal(&file, &["body"]), "there is no layer \"body\"; the drawing has: The body, Ears");
}

#[test]
fn what_a_layer_inherits_still_holds() {
    let nested = svg("<style>.hollow rect { fill: none }</style>\
                      <g transform='scale(2)' class='hollow' stroke='red' stroke-width='1'>\
                      <rect width='3' height='3'/><g transform='translate(5 5)'>\
                      <g id='deep' stroke-width='2' transform='rotate(90)'><rect width='20' height='10' y='-10'/></g>\
                      <rect width='40' height='40'/></g></g>");
    // A frame: 20 by 10 with a line of 2, twice as large and turned.
    assert_near(&nested, &["deep"], [24.0, 44.0, 4.0 * (22.0 * 12.0 - 18.0 * 8.0)]);
    let faded = svg("<g opacity='0'><rect id='gone' width='9' height='9'/></g><rect id='r' width='5' height='5'/>");
    assert!(refusal(&faded, &["gone"]).contains("nothing is painted"));
    let clipped = svg("<clipPath id='c'><rect width='100' height='10'/></clipPath>\
                       <g clip-path='url(#c)'><rect width='9' height='9'/><rect id='r' width='40' height='40'/></g>");
    assert_near(&clipped, &["r"], [40.0, 10.0, 400.0]);
}

#[test]
fn references_into_other_layers_are_found() {
    let file = svg("<g id='other' transform='scale(3)'><clipPath id='c'><circle cx='50' cy='50' r='20'/></clipPath>\
                    <linearGradient id='g'><stop stop-color='red'/></linearGradient>\
                    <g transform='translate(50 0)'><rect id='part' width='10' height='30'/></g>\
                    <style>#wanted rect { fill: url(#g) }</style></g>\
                    <g id='wanted'><rect width='90' height='90' clip-path='url(#c)' fill='none'/></g>\
                    <g id='copy'><use xlink:href='#part' x='7'/></g>");
    assert_near(&file, &["wanted"], [40.0, 40.0, 400.0 * PI]);
    assert_near(&file, &["copy"], [10.0, 30.0, 300.0]);
}

#[test]
fn a_switch_shows_the_same_child_as_before() {
    let file = svg(
        "<switch><foreignObject requiredExtensions='http://a'/><g><g id='body'><rect width='9' height='9'/></g>\
                    <g id='rest'><rect width='50' height='50'/></g></g><g id='late'><rect width='5' height='5'/></g></switch>",
    );
    assert_near(&file, &["body"], [9.0, 9.0, 81.0]);
    // What the switch does not show stays hidden, and does not show up for want of the others.
    assert!(refusal(&file, &["late"]).contains("nothing is painted"));
}

#[test]
fn other_ways_to_write_an_svg() {
    let prefixed = b"<s:svg xmlns:s='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>\
                     <s:g id='a'><s:rect width='30' height='20'/></s:g><s:g id='b'><s:rect width='90' height='90'/></s:g></s:svg>";
    assert_near(prefixed, &["a"], [30.0, 20.0, 600.0]);
    let rooted = b"<svg xmlns='http://www.w3.org/2000/svg' id='Layer_1' width='9mm' height='9mm' viewBox='0 0 9 9'>\
                   <rect width='3' height='9'/></svg>";
    assert_near(rooted, &["Layer_1"], [3.0, 9.0, 27.0]);
    let entities = b"<!DOCTYPE svg [<!ENTITY e '<g id=\"a\"><rect width=\"9\" height=\"9\"/></g>'>]>\
                     <svg xmlns='http://www.w3.org/2000/svg'>&e;<g id='b'><rect width='5' height='5'/></g>&e;</svg>";
    assert!(refusal(entities, &["b"]).contains("entities"));
    let deep = format!("{}<rect id='r' width='9' height='9'/>{}", "<g id='a'>".repeat(50_000), "</g>".repeat(50_000));
    assert!(import(&svg(&deep), &options(&["r"])).is_err());
}

#[test]
fn unknown_names_are_refused_with_those_there_are() {
    let file = svg("<g id='body'><rect width='9' height='9'/></g><g id='ears'/><g id='eyes'/>\
                    <defs><g id='spare'><rect width='9' height='9'/></g></defs>");
    assert_eq!(refusal(&file, &["body", "eras"]), "there is no layer \"eras\"; the drawing has: body, ears, eyes");
    assert!(refusal(&file, &["spare"]).starts_with("there is no layer"));
    let many: String = (0..30).map(|k| format!("<rect id='r{k}' width='9' height='9'/>")).collect();
    assert!(refusal(&svg(&many), &["r"]).ends_with("r18, r19 and 10 more"));
    assert!(refusal(&svg("<rect width='9' height='9'/>"), &["r"]).ends_with("the drawing has: no named layers"));
}

#[test]
fn layers_of_a_dxf_and_of_its_blocks() {
    let square = |layer: &str, x: f64, side: f64| {
        let end = x + side;
        format!("0 LWPOLYLINE {layer} 70 1 10 {x} 20 0 10 {end} 20 0 10 {end} 20 {side} 10 {x} 20 {side} ")
    };
    let blocks = format!(
        "0 BLOCK 2 INNER 10 0 20 0 {} 0 ENDBLK 0 BLOCK 2 B 10 0 20 0 {} {} 0 INSERT 8 0 2 INNER 10 0 20 0 0 ENDBLK",
        square("", 0.0, 12.0),
        square("8 0", 0.0, 10.0),
        square("8 Details", 0.0, 30.0)
    );
    let entities = square("8 The_body", 0.0, 60.0)
        + &square("8 guides", 0.0, 90.0)
        + "0 TEXT 8 notes 1 pig 0 INSERT 8 Ears 2 B 10 100 20 0 "
        + &square("", 0.0, 5.0);
    let file = dxf(&blocks, &entities);
    assert_near(&file, &["The body"], [60.0, 60.0, 3600.0]);
    assert_near(&file, &["the BODY"], [60.0, 60.0, 3600.0]);
    // The square of 10 in that of 12 is a hole, as everywhere in a DXF.
    assert_near(&file, &["Ears"], [12.0, 12.0, 144.0 - 100.0]);
    assert_near(&file, &["Details"], [30.0, 30.0, 900.0]);
    assert_near(&file, &["0"], [5.0, 5.0, 25.0]);
    assert_eq!(
        refusal(&file, &["body"]),
        "there is no layer \"body\"; the drawing has: 0, Details, Ears, The body, guides, notes"
    );
    assert!(refusal(&file, &["notes"]).contains("nothing is painted"));
    let whole = import(&file, &Import { pieces: Pieces::Largest, ..Import::default() }).unwrap();
    assert!(whole.changes.notes.iter().any(|note| note.to_string().contains("text")));
    let part = import(&file, &options(&["Ears"])).unwrap();
    assert!(!part.changes.notes.iter().any(|note| note.to_string().contains("text")), "{:?}", part.changes.notes);
}

#[test]
fn pictures_and_meshes_have_none() {
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbaImage::new(9, 9).write_to(&mut png, image::ImageFormat::Png).unwrap();
    let refused = import(png.get_ref(), &options(&["body"]));
    assert_eq!(refused, Err(OutlineError::NoLayers("pictures")));
    let mesh = import(b"v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n", &options(&["body"]));
    assert_eq!(mesh, Err(OutlineError::NoLayers("OBJ meshes")));
}

#[test]
fn the_option_may_be_repeated_and_a_refusal_is_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let drawing = folder.path().join("a.svg");
    let design = folder.path().join("a.plush");
    std::fs::write(
        &drawing,
        svg("<g id='body'><rect width='90' height='60'/></g><g id='ears'><rect y='60' width='30' height='30'/></g>\
             <rect x='95' width='5' height='5'/>"),
    )
    .unwrap();
    let new = |names: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_plushwright"));
        command.arg("new").arg(&drawing).arg("-o").arg(&design).arg("--json");
        names.iter().for_each(|name| {
            command.args(["--layer", name]);
        });
        command.output().unwrap()
    };
    let refused = new(&["body", "eras"]);
    let line = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2));
    assert!(line.trim_end().ends_with("a.svg: there is no layer \"eras\"; the drawing has: body, ears"), "{line}");
    assert!(!design.exists());
    let made = new(&["body", "ears"]);
    let report: serde_json::Value = serde_json::from_slice(&made.stdout).unwrap();
    assert!((report["height_mm"].as_f64().unwrap() - 90.0).abs() < 1e-4, "{report:#}");
    assert!((report["clean_up"]["outline_mm2"].as_f64().unwrap() - 6300.0).abs() < 1.0, "{report:#}");
}
