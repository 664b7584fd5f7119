//! Files as the programs of makers write them, made anew with a figure of our own: each gives that figure, or a sentence that leads to it.

use plushwright::outline::{Ground, Import, Imported, Note, Outline, OutlineError, Sizing, import};

type Point = [f64; 2];

/// A fish in a box of 160 x 100, y down, as drawings have it.
fn fish() -> Vec<Point> {
    let bow = |from: Point, by: Point, to: Point| {
        (0..24).map(move |i| {
            let t = f64::from(i) / 24.0;
            [0, 1].map(|k| (1.0 - t) * (1.0 - t) * from[k] + 2.0 * t * (1.0 - t) * by[k] + t * t * to[k])
        })
    };
    let mut points: Vec<Point> = bow([0.0, 50.0], [40.0, -40.0], [110.0, 40.0]).collect();
    points.extend([[110.0, 40.0], [160.0, 10.0], [150.0, 50.0], [160.0, 90.0], [110.0, 60.0]]);
    points.extend(bow([110.0, 60.0], [40.0, 140.0], [0.0, 50.0]));
    points
}

/// The fish as path data, moved and scaled.
fn path(scale: f64, [x, y]: Point) -> String {
    let points: Vec<String> =
        fish().iter().map(|p| format!("{:.4},{:.4}", scale * p[0] + x, scale * p[1] + y)).collect();
    format!("M{}Z", points.join("L"))
}

fn svg(attributes: &str, body: &str) -> Vec<u8> {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' {attributes}>{body}</svg>"
    )
    .into_bytes()
}

fn inside(polygon: &[Point], [x, y]: Point) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    sides.filter(|(a, b)| (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])).count() % 2
        == 1
}

/// Area of what two figures share over that of both, each in its own box.
fn overlap(outline: &Outline) -> f64 {
    let (low, high) = outline.bounding_box();
    let known = fish();
    let range = |axis: usize| {
        let values = known.iter().map(|p| p[axis]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let (wide, tall) = (range(0), range(1));
    let (mut both, mut any) = (0, 0);
    const N: usize = 240;
    for i in 0..N {
        for j in 0..N {
            let (u, v) = ((i as f64 + 0.5) / N as f64, (j as f64 + 0.5) / N as f64);
            let ours = outline.contains([low[0] + u * (high[0] - low[0]), low[1] + v * (high[1] - low[1])]);
            let theirs = inside(&known, [wide.0 + u * (wide.1 - wide.0), tall.1 - v * (tall.1 - tall.0)]);
            both += usize::from(ours && theirs);
            any += usize::from(ours || theirs);
        }
    }
    both as f64 / any as f64
}

/// The fish is read, and what is told holds what is expected.
fn reads(name: &str, bytes: &[u8], options: &Import, expected: &[Note]) -> Imported {
    let read = import(bytes, options).unwrap_or_else(|error| panic!("{name}: {error}"));
    let overlap = overlap(&read.outline);
    assert!(overlap > 0.985, "{name}: {overlap} {:?}", read.changes.notes);
    for note in expected {
        assert!(read.changes.notes.contains(note), "{name}: no {note:?} in {:?}", read.changes.notes);
    }
    read
}

fn tall() -> Import {
    Import { height_mm: Some(200.0), ..Import::default() }
}

#[test]
fn vector_programs() {
    let d = path(1.0, [0.0, 0.0]);
    let page = "width='160' height='100' viewBox='0 0 160 100' fill='none'";
    // Figma: a frame that clips, filled, and a mask with a gradient larger than the page.
    let figma = format!(
        "<g clip-path='url(#c)'><rect width='160' height='100' fill='#eee'/><mask id='m' style='mask-type:luminance' \
         maskUnits='userSpaceOnUse' x='0' y='0' width='160' height='100'><path d='{d}' fill='white'/></mask><g mask='url(#m)'>\
         <rect x='-9' y='-9' width='200' height='200' fill='url(#p)'/></g></g><defs><clipPath id='c'><rect width='160' \
         height='100' fill='white'/></clipPath><linearGradient id='p'><stop/><stop offset='1' stop-color='red'/></linearGradient></defs>"
    );
    reads("Figma", &svg(page, &figma), &Import::default(), &[Note::Background(Ground::Page), Note::Size(Sizing::Css)]);
    // Canva: a page of rectangles that are clipped to shapes.
    let canva = format!(
        "<defs><clipPath id='a'><path d='{d}'/></clipPath></defs><rect x='-16' width='192' y='-10' height='120' fill='#fff'/>\
         <g clip-path='url(#a)'><rect x='-16' width='192' y='-10' height='120' fill='#f80'/></g>"
    );
    reads(
        "Canva",
        &svg("width='160' height='100' viewBox='0 0 160 100'", &canva),
        &tall(),
        &[Note::Background(Ground::Page)],
    );
    // Illustrator: entities, a switch, classes, guides that are not displayed; 72 to the inch.
    let illustrator = format!(
        "<?xml version='1.0'?><!-- Generator: Adobe Illustrator 27.0 --><!DOCTYPE svg [<!ENTITY s \
         'http://www.w3.org/2000/svg'>]><svg xmlns='&s;' viewBox='0 0 453.6 283.5'><style>.a{{fill:#123}}.b{{display:none}}</style>\
         <switch><foreignObject requiredExtensions='x' width='1' height='1'/><g><path class='b' d='M0 0h400v9H0z'/>\
         <path class='a' d='{}'/></g></switch></svg>",
        path(2.834_646, [0.0, 0.0])
    );
    let read = reads("Illustrator", illustrator.as_bytes(), &Import::default(), &[Note::Size(Sizing::Illustrator)]);
    assert!((read.outline.bounding_box().1[0] - 160.0).abs() < 0.05);
    // Affinity: 100 % wide, scaled from points to 300 dots.
    let affinity = format!(
        "<g transform='matrix(4.16667,0,0,4.16667,0,0)'><path d='{}' style='fill:rgb(9,9,9)'/></g>",
        path(2.834_646, [0.0; 2])
    );
    let read = reads(
        "Affinity",
        &svg("width='100%' height='100%' viewBox='0 0 1890 1181'", &affinity),
        &Import::default(),
        &[Note::Size(Sizing::Dots(300.0))],
    );
    assert!((read.outline.bounding_box().1[0] - 160.0).abs() < 0.05);
    // Inkscape: mm, a layer below the figure with a white sheet off the page, a clone of one half.
    let inkscape = format!(
        "<g transform='translate(20,30)'><rect width='180' height='120' fill='#fff' stroke='#999'/><path d='{}' style='fill:#a50'/></g>",
        path(1.0, [10.0, 10.0])
    );
    let page = "width='300mm' height='300mm' viewBox='0 0 300 300'";
    reads("Inkscape", &svg(page, &inkscape), &Import::default(), &[Note::Background(Ground::Sheet)]);
    // CorelDRAW: Latin-1, a DOCTYPE, units in a viewBox of hundredths of a mm.
    let corel = format!(
        "<?xml version='1.0' encoding='ISO-8859-1'?><svg xmlns='http://www.w3.org/2000/svg' width='160mm' height='100mm' \
         viewBox='0 0 16000 10000'><g id='Ebene_\u{e4}'><path d='{}' fill='black'/></g></svg>",
        path(100.0, [0.0; 2])
    );
    let corel: Vec<u8> = corel.chars().map(|c| c as u8).collect();
    reads("CorelDRAW", &corel, &Import::default(), &[]);
    // Silhouette Studio: one open line without a fill, whose end misses its beginning.
    let open = path(1.0, [0.0; 2]).trim_end_matches('Z').to_owned();
    let open = open.replacen("M0.0000,50.0000", "M0.3000,47.0000", 1);
    let line = format!("<path d='{open}' fill='none' stroke='#f00' stroke-width='0.2'/>");
    let told =
        reads("Silhouette", &svg("width='160mm' height='100mm' viewBox='0 0 160 100'", &line), &Import::default(), &[]);
    let notes = &told.changes.notes;
    assert!(notes.iter().any(|n| matches!(n, Note::Closed { .. } | Note::LinesFilled)), "{notes:?}");
}

#[test]
fn soft_and_split_backgrounds_and_abutting_parts() {
    let d = path(1.0, [20.0, 20.0]);
    let page = "width='200mm' height='140mm' viewBox='0 0 200 140'";
    let shadow = format!(
        "<radialGradient id='g'><stop stop-opacity='.4'/><stop offset='1' stop-opacity='0'/></radialGradient>\
         <ellipse cx='100' cy='125' rx='90' ry='12' fill='url(#g)' opacity='.9'/><path d='{d}' fill='#a50'/>"
    );
    let read = reads("shadow", &svg(page, &shadow), &tall(), &[]);
    assert!(read.changes.notes.iter().any(|n| matches!(n, Note::Faint { count: 1, .. })), "{:?}", read.changes.notes);
    let split = format!(
        "<rect width='200' height='90' fill='#9cf'/><path d='M0 90H200V140H0z' fill='#6b4'/><path d='{d}' fill='#a50'/>"
    );
    reads("sky and grass", &svg(page, &split), &tall(), &[Note::Background(Ground::Shapes(2))]);
    let card = format!("<rect width='200' height='140' rx='20' fill='#fd8'/><path d='{d}' fill='#a50'/>");
    let told = import(&svg(page, &card), &tall()).unwrap().changes.notes;
    assert_eq!(told, [Note::GroundCounts(Ground::Card)]);
    let drop = Import { background: plushwright::outline::Background::Drop, ..tall() };
    reads("card", &svg(page, &card), &drop, &[Note::Background(Ground::Card)]);
    // Head and tail in two colours that do not quite touch.
    let parts = |gap: f64| {
        format!(
            "<clipPath id='l'><rect width='90' height='140'/></clipPath><clipPath id='r'><rect x='{}' width='110' \
             height='140'/></clipPath><path clip-path='url(#l)' d='{d}'/><path clip-path='url(#r)' d='{d}' fill='red'/>",
            90.0 + gap
        )
    };
    for gap in [0.0, 1e-5, 0.01, 0.1] {
        reads("two colours", &svg(page, &parts(gap)), &tall(), &[]);
    }
    assert!(matches!(import(&svg(page, &parts(1.0)), &tall()), Err(OutlineError::Pieces { pieces: 2, .. })));
    reads("asked", &svg(page, &parts(1.0)), &Import { gap_mm: Some(3.0), ..tall() }, &[]);
}

/// Pairs of a DXF with y up.
fn dxf(tables: &str, blocks: &str, entities: &str) -> Vec<u8> {
    let all = format!(
        "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 TABLES {tables} 0 ENDSEC 0 SECTION 2 BLOCKS {blocks} 0 ENDSEC \
         0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF"
    );
    all.split_whitespace().collect::<Vec<_>>().join("\r\n").into_bytes()
}

fn polyline(layer: &str, points: &[Point]) -> String {
    let vertices: String = points.iter().map(|p| format!(" 10 {} 20 {}", p[0], 100.0 - p[1])).collect();
    format!("0 LWPOLYLINE 8 {layer} 70 1{vertices}")
}

#[test]
fn cad_programs() {
    let points = fish();
    // Fusion: a sketch of short lines whose ends miss each other, with a help line on a layer of its own.
    let lines: String = points
        .iter()
        .zip(points.iter().cycle().skip(1))
        .enumerate()
        .map(|(k, (a, b))| {
            let off = if k % 7 == 0 { 0.08 } else { 0.0 };
            format!(" 0 LINE 8 0 10 {} 20 {} 11 {} 21 {}", a[0] + off, 100.0 - a[1], b[0], 100.0 - b[1] + off)
        })
        .collect();
    let help = " 0 CIRCLE 8 Construction 10 300 20 0 40 30";
    let read = reads("Fusion", &dxf("", "", &(lines.clone() + help)), &Import::default(), &[]);
    let notes = &read.changes.notes;
    assert!(
        notes.iter().any(|n| matches!(n, Note::Joined { .. }))
            && notes.iter().any(|n| matches!(n, Note::Hidden { .. }))
    );
    assert!(matches!(
        import(&dxf("", "", &lines), &Import { join_mm: Some(0.01), ..Import::default() }),
        Err(OutlineError::NotClosed { .. })
    ));
    // FreeCAD: the same lines twice, and a frame with a frozen layer.
    let frame = polyline("0", &[[-40.0, -40.0], [200.0, -40.0], [200.0, 140.0], [-40.0, 140.0]]);
    let frozen = "0 LAYER 2 off 70 1 62 7";
    let hidden = polyline("off", &[[300.0, 0.0], [400.0, 0.0], [400.0, 90.0]]);
    let read = reads(
        "FreeCAD",
        &dxf(frozen, "", &format!("{lines} {lines} {frame} {hidden}")),
        &Import::default(),
        &[Note::Background(Ground::Frame), Note::Hidden { layers: vec!["off".to_owned()], count: 1 }],
    );
    assert!(read.changes.notes.iter().any(|n| matches!(n, Note::Copies(_))));
    // Seamly2D and other pattern programs: pieces as blocks that nothing inserts, notches and grain lines on other layers.
    let piece = |name: &str| {
        format!(
            "0 BLOCK 8 1 2 {name} 70 64 10 0 20 0 {} 0 LINE 8 7 10 10 20 50 11 90 21 50 0 POINT 8 4 10 0 20 50 0 ENDBLK",
            polyline("1", &points)
        )
    };
    reads("Seamly2D", &dxf("", &piece("FRONT"), ""), &Import::default(), &[Note::Blocks(vec!["FRONT".to_owned()])]);
    let two = dxf("", &(piece("FRONT") + " " + &piece("BACK")), "");
    let Err(OutlineError::BlocksAlone(names)) = import(&two, &Import::default()) else { panic!() };
    assert_eq!(names, "BACK, FRONT");
    reads("a piece by name", &two, &Import { blocks: vec!["back".to_owned()], ..Import::default() }, &[]);
    // A laser cutter's file: a hatch alone.
    let path: String = points.iter().map(|p| format!(" 10 {} 20 {}", p[0], 100.0 - p[1])).collect();
    let hatch = format!("0 HATCH 8 0 10 0 20 0 2 SOLID 70 1 71 0 91 1 92 3 72 0 73 1 93 {}{path} 97 0", points.len());
    reads("hatch", &dxf("", "", &hatch), &Import::default(), &[Note::Hatches(1)]);
    // Seen from below: the spline's points are the world's, the block is mirrored.
    // It swings about the corners of the tail where its points lie far apart, so they lie at most 2 apart.
    let sides = points.iter().zip(points.iter().cycle().skip(1));
    let dense = sides.flat_map(|(a, b)| {
        let n = ((b[0] - a[0]).hypot(b[1] - a[1]) / 2.0).ceil() as usize;
        (0..n).map(move |i| [0, 1].map(|k| a[k] + (b[k] - a[k]) * i as f64 / n as f64))
    });
    let fit: String = dense.map(|p| format!(" 11 {} 21 {} 31 0", p[0], 100.0 - p[1])).collect();
    reads("spline", &dxf("", "", &format!("0 SPLINE 210 0 220 0 230 -1 70 9 71 3{fit}")), &Import::default(), &[]);
    let mirrored: Vec<Point> = points.iter().map(|p| [-p[0], p[1]]).collect();
    let block = format!("0 BLOCK 2 F 10 0 20 0 {} 0 ENDBLK", polyline("0", &mirrored));
    reads("block", &dxf("", &block, "0 INSERT 2 F 10 0 20 0 230 -1"), &Import::default(), &[]);
}

#[test]
fn meshes_of_one_face_with_many_corners() {
    // Blender: y up, the figure lies in the plane of x and z.
    let vertices: String = fish().iter().map(|p| format!("v {} 0.5 {}\n", p[0], p[1])).collect();
    let face: String = (1..=fish().len()).map(|k| format!(" {k}")).collect();
    let obj = format!("# Blender 4.1\no Fish\n{vertices}f{face}\n");
    reads("Blender", obj.as_bytes(), &Import::default(), &[Note::Polygons, Note::NoUnit("an OBJ")]);
}
