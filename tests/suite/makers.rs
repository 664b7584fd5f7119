//! Outlines as the programs of makers write them, re-created from what these programs are known to write: one figure in the dress of each
//! program, read without options, against the figure itself; and what cannot be read, with the sentence that leads on.

use image::{ImageFormat, Rgba, RgbaImage};
use plushwright::outline::{Import, Outline, Point, import};
use std::io::{Cursor, Write};

/// Both outlines are this high when they are compared, and this far apart are the places at which they are.
const HEIGHT: f64 = 250.0;
const STEP: f64 = 2.0;
/// Common to both over covered by either.
const ALIKE: f64 = 0.99;

/// A fox from the side, y down, in a page of 400 x 400.
const FOX: [[f64; 2]; 28] = [
    [60.0, 150.0],
    [48.0, 95.0],
    [75.0, 60.0],
    [100.0, 90.0],
    [130.0, 92.0],
    [160.0, 52.0],
    [180.0, 100.0],
    [188.0, 150.0],
    [230.0, 170.0],
    [285.0, 165.0],
    [320.0, 120.0],
    [355.0, 70.0],
    [372.0, 120.0],
    [350.0, 185.0],
    [318.0, 215.0],
    [322.0, 260.0],
    [325.0, 330.0],
    [300.0, 352.0],
    [282.0, 330.0],
    [270.0, 270.0],
    [220.0, 262.0],
    [175.0, 275.0],
    [172.0, 330.0],
    [150.0, 352.0],
    [128.0, 335.0],
    [120.0, 270.0],
    [100.0, 220.0],
    [70.0, 200.0],
];

/// Its outline as cubic curves.
fn curves() -> Vec<[Point; 4]> {
    let at = |i: usize| FOX[(i + FOX.len()) % FOX.len()];
    let aside = |p: Point, from: Point, to: Point| [0, 1].map(|k| p[k] + (to[k] - from[k]) / 6.0);
    let curve = |i: usize| {
        let [a, b, c, d] = [at(i + FOX.len() - 1), at(i), at(i + 1), at(i + 2)];
        [b, aside(b, a, c), aside(c, d, b), c]
    };
    (0..FOX.len()).map(curve).collect()
}

/// As a polygon.
fn fox() -> Vec<Point> {
    let at = |[a, b, c, d]: [Point; 4], t: f64| {
        let s = 1.0 - t;
        [0, 1].map(|k| s * s * s * a[k] + 3.0 * t * s * s * b[k] + 3.0 * t * t * s * c[k] + t * t * t * d[k])
    };
    curves().into_iter().flat_map(|curve| (0..12).map(move |i| at(curve, f64::from(i) / 12.0))).collect()
}

/// As the data of a path, scaled and then moved.
fn path(scale: [f64; 2], by: Point) -> String {
    let at = |p: Point| format!("{:.3} {:.3}", scale[0] * p[0] + by[0], scale[1] * p[1] + by[1]);
    let curves = curves();
    let data: String = curves.iter().map(|[_, b, c, d]| format!("C{} {} {}", at(*b), at(*c), at(*d))).collect();
    format!("M{}{data}Z", at(curves[0][0]))
}

fn plain() -> String {
    path([1.0, 1.0], [0.0, 0.0])
}

/// How alike an outline is to a polygon with y down, both brought to one height.
fn alike(outline: &Outline, polygon: &[Point]) -> f64 {
    let truth = Outline { outer: polygon.iter().rev().map(|p| [p[0], -p[1]]).collect(), holes: Vec::new() };
    let (low, high) = truth.bounding_box();
    let scale = (high[1] - low[1]) / HEIGHT;
    let (mut both, mut either) = (0, 0);
    let steps = |long: f64| (0..=(long / STEP) as usize).map(|i| (i as f64 + 0.5) * STEP);
    let wide = (high[0] - low[0]) / scale + 20.0;
    for p in steps(HEIGHT).flat_map(|y| steps(wide).map(move |x| [x - 10.0, y])) {
        let inside = [outline.contains(p), truth.contains([low[0] + scale * p[0], low[1] + scale * p[1]])];
        both += usize::from(inside == [true; 2]);
        either += usize::from(inside != [false; 2]);
    }
    both as f64 / either as f64
}

fn check(program: &str, bytes: &[u8], truth: &[Point]) {
    let asked = Import { height_mm: Some(HEIGHT), ..Import::default() };
    let read = import(bytes, &asked).unwrap_or_else(|error| panic!("{program}: {error}"));
    let alike = alike(&read.outline, truth);
    assert!(alike >= ALIKE, "{program}: {alike:.4}, {:?}", read.changes.notes);
}

fn svg(attributes: &str, body: &str) -> Vec<u8> {
    let spaces = "xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink'";
    format!("<svg {spaces} {attributes}>{body}</svg>").into_bytes()
}

const PAGE: &str = "width='400' height='400' viewBox='0 0 400 400'";

#[test]
fn drawings_of_designers_are_read() {
    let fox = plain();
    let figma = format!(
        "<g clip-path='url(#c)'><rect width='400' height='400' fill='white'/><g filter='url(#f)'><path d='{fox}' fill='#F2994A'/></g>\
         <mask id='m' style='mask-type:alpha' maskUnits='userSpaceOnUse' x='40' y='40' width='340' height='320'><path d='{fox}' \
         fill='#D9D9D9'/></mask><g mask='url(#m)'><rect x='-20' y='90' width='460' height='60' fill='url(#p)'/></g></g><defs>\
         <filter id='f' x='38' y='48' width='344' height='320' filterUnits='userSpaceOnUse'><feGaussianBlur stdDeviation='2'/></filter>\
         <linearGradient id='p'><stop stop-color='white'/><stop offset='1' stop-opacity='0'/></linearGradient>\
         <clipPath id='c'><rect width='400' height='400' fill='white'/></clipPath></defs>"
    );
    check("Figma", &svg(&format!("{PAGE} fill='none'"), &figma), &self::fox());
    let box_of_it = "M 40 45 L 380 45 L 380 360 L 40 360 Z";
    let canva = format!(
        "<defs><clipPath id='a'><path d='{box_of_it}'/></clipPath><clipPath id='b'><path d='{fox}' clip-rule='nonzero'/></clipPath>\
         </defs><rect x='-40' width='480' fill='#ffffff' y='-40' height='480' fill-opacity='1'/><rect x='-40' width='480' \
         fill='#fdf3e7' y='-40' height='480'/><g clip-path='url(#a)'><g clip-path='url(#b)'><path fill='#e07a5f' d='{box_of_it}'/></g></g>"
    );
    check(
        "Canva",
        &svg("width='500' height='500' viewBox='0 0 400 399.99999' zoomAndPan='magnify'", &canva),
        &self::fox(),
    );
    let illustrator = format!(
        "<?xml version='1.0' encoding='utf-8'?><!-- Generator: Adobe Illustrator 27.0.0, SVG Export Plug-In -->\
         <!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.1//EN' 'http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd' [\
         <!ENTITY ns_svg 'http://www.w3.org/2000/svg'><!ENTITY ns_ai 'http://ns.adobe.com/AdobeIllustrator/10.0/'>]>\
         <svg xmlns='&ns_svg;' xmlns:i='&ns_ai;' x='0px' y='0px' viewBox='0 0 400 400' xml:space='preserve'><style type='text/css'>\
         .st0{{display:none;}}.st1{{display:inline;fill:#FF00FF;}}.st2{{fill:#8B5A2B;}}.st3{{fill:none;}}</style><switch>\
         <foreignObject requiredExtensions='&ns_ai;' width='1' height='1'/><g i:extraneous='self'><g class='st0'><rect class='st1' \
         width='380' height='380'/></g><path class='st2' d='{fox}'/><rect class='st3' width='400' height='400'/></g></switch></svg>"
    );
    check("Illustrator", illustrator.as_bytes(), &self::fox());
    let affinity = format!(
        "<g transform='matrix(4.16667,0,0,4.16667,0,0)'><rect width='400' height='400' style='fill:none;'/><clipPath id='_clip1'>\
         <rect width='400' height='400'/></clipPath><g clip-path='url(#_clip1)'><rect x='-20' y='-20' width='440' height='440' \
         style='fill:white;'/><g transform='matrix(0.8,0,0,0.8,-12,33)'><path transform='matrix(1.25,0,0,1.25,15,-41.25)' d='{fox}' \
         style='fill:rgb(226,149,76);'/></g></g></g>"
    );
    check("Affinity", &svg("width='100%' height='100%' viewBox='0 0 1667 1667'", &affinity), &self::fox());
    let sketch = format!(
        "<defs><path d='{fox}' id='path-1'/></defs><g stroke='none' fill='none' fill-rule='evenodd'><rect fill='#FFFFFF' width='400' \
         height='400'/><g><mask id='mask-2' fill='white'><use xlink:href='#path-1'/></mask><use fill='#D8D8D8' xlink:href='#path-1'/>\
         <polygon fill='#979797' mask='url(#mask-2)' points='150 90 460 140 460 190 150 140'/></g></g>"
    );
    check("Sketch", &svg(PAGE, &sketch), &self::fox());
    let google = format!(
        "<clipPath id='p.0'><path d='m0 0l400.0 0l0 400.0l-400.0 0z'/></clipPath><g clip-path='url(#p.0)'><path fill='#000000' \
         fill-opacity='0.0' d='m0 0l400 0l0 400l-400 0z'/><path fill='#f6b26b' d='{fox}'/></g>"
    );
    check("Google Drawings", &svg("viewBox='0.0 0.0 400.0 400.0' fill='none' stroke='none'", &google), &self::fox());
    let symbol = format!(
        "<symbol id='s' viewBox='0 0 400 400'><path d='{fox}'/></symbol><svg x='50' y='50' width='500' height='500' \
         viewBox='0 0 100 100'><use href='#s' width='100' height='100'/></svg>"
    );
    check("symbols", &svg("width='600' height='600'", &symbol), &self::fox());
}

#[test]
fn traced_pictures_are_read_with_their_paper_first_or_last() {
    let (fox, outline) = (plain(), fox());
    let paper = format!("<path fill='#fefefe' fill-rule='evenodd' d='M0 0H400V400H0Z{fox}'/>");
    // The figure in two colours that abut.
    let part = |k: usize, x: [f64; 2]| {
        format!(
            "<clipPath id='c{k}'><rect x='{}' width='{}' height='400'/></clipPath><g clip-path='url(#c{k})'><path fill='#b5651{k}' \
             d='{fox}'/></g>",
            x[0],
            x[1] - x[0]
        )
    };
    let parts = part(0, [0.0, 210.0]) + &part(1, [210.0, 400.0]);
    check("Illustrator, traced", &svg("viewBox='0 0 400 400'", &format!("{paper}{parts}")), &outline);
    check("a vectorizer", &svg(PAGE, &format!("{parts}{paper}")), &outline);
    let turned = path([10.0, -10.0], [0.0, 4000.0]);
    let potrace = format!(
        "<g transform='translate(0,400) scale(0.1,-0.1)' fill='#000000' stroke='none'><path d='{turned}'/></g>"
    );
    check("potrace", &svg("width='400.000000pt' height='400.000000pt' viewBox='0 0 400 400'", &potrace), &outline);
}

#[test]
fn drawings_of_lines_alone_are_read() {
    let (fox, outline) = (plain(), fox());
    let corel = format!(
        "<defs><style type='text/css'><![CDATA[ .str0 {{stroke:#2B2A29;stroke-width:20}} .fil0 {{fill:none}} ]]></style></defs>\
         <g id='Ebene_x0020_1'><path class='fil0 str0' d='{}'/><circle class='fil0 str0' cx='4950' cy='11000' r='400'/></g>",
        path([50.0, 50.0], [200.0, 4000.0])
    );
    check("CorelDRAW", &svg("width='210mm' height='297mm' viewBox='0 0 21000 29700'", &corel), &outline);
    let inkscape = format!(
        "<g style='display:none'><rect width='210' height='297'/></g><g transform='matrix(0.5,0,0,0.5,3,20)'><path \
         style='fill:none;stroke:#000000;stroke-width:0.26' d='{fox}'/></g>"
    );
    check("Inkscape", &svg("width='210mm' height='297mm' viewBox='0 0 210 297'", &inkscape), &outline);
    let freecad = format!(
        "<g transform='translate(-44,356) scale(1,-1)'><path d='{}' stroke='#000000' stroke-width='0.35 px' \
         style='stroke-width:0.35;fill:none'/><title>b'Sketch'</title></g>",
        path([1.0, -1.0], [0.0, 400.0])
    );
    check("FreeCAD", &svg("width='332.0mm' height='312.0mm' viewBox='0 0 332.0 312.0'", &freecad), &outline);
    let page = format!(
        "<g style='fill:none;stroke:#000;stroke-width:0.5'><rect x='10' y='10' width='400' height='400'/><path d='M300 380 h110 M300 380 \
         v30 M350 380 v30'/></g><g transform='translate(30,20) scale(0.9)'><path style='fill:none;stroke:#000;stroke-width:0.7' \
         d='{fox}'/></g><text x='305' y='400' font-size='8'>FOX</text>"
    );
    check("TechDraw", &svg("width='420mm' height='420mm' viewBox='0 0 420 420'", &page), &outline);
    let points: String = outline.iter().chain(&outline[..1]).map(|[x, y]| format!("{x:.4},{y:.4} ")).collect();
    let seamly = format!(
        "<title>Pattern</title><g fill='none' stroke='black' stroke-width='1' fill-rule='evenodd'><g stroke-width='0.4' \
         transform='matrix(1,0,0,1,5,5)'><polyline points='{points}'/></g><g fill='#000000' stroke='none'><text x='200' y='230' \
         font-size='12'>Body, cut 2</text></g><g><polyline points='250,190 250,240'/></g></g>"
    );
    check("Seamly2D", &svg("width='148.167mm' height='148.167mm' viewBox='0 0 420 420'", &seamly), &outline);
}

/// A picture of 600 x 600, its colour by how deep a place lies in the figure, in units of the page.
fn picture(colour: impl Fn(Point, f64) -> [u8; 4], format: ImageFormat) -> Vec<u8> {
    let outline = Outline { outer: fox(), holes: Vec::new() };
    let near = outline.near();
    let picture = RgbaImage::from_fn(600, 600, |x, y| {
        let p = [x, y].map(|v| (f64::from(v) + 0.5) / 1.5);
        let depth = near.distance(p);
        Rgba(colour(p, if outline.contains(p) { depth } else { -depth }))
    });
    let picture = image::DynamicImage::from(picture);
    let mut bytes = Cursor::new(Vec::new());
    match format {
        ImageFormat::Jpeg => picture.to_rgb8().write_to(&mut bytes, format).unwrap(),
        _ => picture.write_to(&mut bytes, format).unwrap(),
    }
    bytes.into_inner()
}

#[test]
fn pictures_of_painters_and_phones_are_read() {
    let outline = fox();
    // A brush that lets through, and a speck.
    let texture = |p: Point| 60.0 * ((0.7 * p[0]).sin() * (0.5 * p[1]).cos()).abs();
    let procreate = picture(
        |p, depth| {
            let speck = (p[0] - 15.0).hypot(p[1] - 20.0) < 2.0;
            let alpha = if depth > 0.0 { 190.0 + texture(p) } else { 240.0 * f64::from(speck) };
            [200, 120, 60, alpha as u8]
        },
        ImageFormat::Png,
    );
    check("Procreate", &procreate, &outline);
    // Colour that leaves a gap to the line around it.
    let lined = picture(
        |_, depth| match depth {
            d if d < 0.0 => [255; 4],
            d if d < 5.0 => [30, 30, 30, 255],
            d if d < 9.0 => [255; 4],
            _ => [240, 150, 70, 255],
        },
        ImageFormat::Png,
    );
    check("Procreate, line and colour", &lined, &outline);
    // A sheet on a wooden table in uneven light; the figure is nearer to the table's colour than to the paper's.
    let photo = picture(
        |p, depth| {
            let light = 1.0 - 0.3 * p[0] / 400.0;
            let grain = 12.0 * (0.9 * p[1]).sin();
            let colour = match p {
                _ if depth > 0.0 => [225.0, 120.0, 40.0],
                p if p.iter().all(|v| (18.0..385.0).contains(v)) => [250.0, 249.0, 244.0],
                _ => [125.0 + grain, 95.0 + grain, 75.0 + grain],
            };
            let [r, g, b] = colour.map(|v| (light * v) as u8);
            [r, g, b, 255]
        },
        ImageFormat::Jpeg,
    );
    check("a phone", &photo, &outline);
}

/// The pairs of a DXF with a header of a unit, blocks and entities.
fn dxf(unit: &str, blocks: &str, entities: &str) -> Vec<u8> {
    let all = format!(
        "0 SECTION 2 HEADER 9 $INSUNITS 70 {unit} 0 ENDSEC 0 SECTION 2 BLOCKS {blocks} 0 ENDSEC 0 SECTION 2 ENTITIES {entities} 0 ENDSEC \
         0 EOF"
    );
    all.split_whitespace().collect::<Vec<_>>().join("\n").into_bytes()
}

/// The figure as one polyline, y up, scaled and moved.
fn polyline(scale: f64, by: Point) -> String {
    let corner = |[x, y]: Point| format!(" 10 {:.5} 20 {:.5}", scale * x + by[0], scale * (400.0 - y) + by[1]);
    format!(" 0 LWPOLYLINE 8 0 70 1{}", fox().into_iter().map(corner).collect::<String>())
}

fn rectangle(low: Point, high: Point) -> String {
    let [[a, b], [c, d]] = [low, high];
    format!(" 0 LWPOLYLINE 8 0 70 1 10 {a} 20 {b} 10 {c} 20 {b} 10 {c} 20 {d} 10 {a} 20 {d}")
}

#[test]
fn drawings_of_cad_programs_are_read() {
    let outline = fox();
    let spline = |[a, b, c, d]: [Point; 4]| {
        let points: String = [a, b, c, d].iter().map(|p| format!(" 10 {:.5} 20 {:.5}", p[0], 400.0 - p[1])).collect();
        format!(
            " 0 SPLINE 8 0 70 8 71 3 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1{points} 0 POINT 10 {} 20 {}",
            a[0],
            400.0 - a[1]
        )
    };
    check("Fusion", &dxf("0", "", &curves().into_iter().map(spline).collect::<String>()), &outline);
    let lines: String = outline
        .iter()
        .zip(outline.iter().cycle().skip(1))
        .map(|(p, q)| format!(" 0 LINE 8 0 10 {:.4} 11 {:.4} 20 {:.4} 21 {:.4}", p[0], q[0], -p[1], -q[1]))
        .collect();
    check("OpenSCAD", &dxf("0", "", &lines), &outline);
    check("lines drawn twice", &dxf("4", "", &format!("{lines}{lines}")), &outline);
    let border = [
        rectangle([0.0, 0.0], [420.0, 420.0]),
        rectangle([10.0, 10.0], [410.0, 410.0]),
        rectangle([260.0, 10.0], [410.0, 40.0]),
    ];
    let border = format!("0 BLOCK 2 Border 10 0 20 0 {} 0 LINE 10 260 20 25 11 410 21 25 0 ENDBLK", border.concat());
    let drawing = format!("0 INSERT 2 Border 10 0 20 0{}", polyline(0.9, [30.0, 35.0]));
    check("Onshape, a drawing", &dxf("4", &border, &drawing), &outline);
    let nested = format!(
        "0 BLOCK 2 part 10 0 20 0 {} 0 ENDBLK 0 BLOCK 2 mid 10 1 20 1 0 INSERT 2 part 10 2 20 3 50 30 0 ENDBLK",
        polyline(0.01, [0.0, 0.0])
    );
    check("blocks in blocks", &dxf("4", &nested, "0 INSERT 2 mid 10 50 20 50 41 100 42 100 50 -30"), &outline);
    check("far from the origin", &dxf("4", "", &polyline(1.0, [4.5e6, 5.6e6])), &outline);
}

#[test]
fn flat_meshes_of_modelling_programs_are_read() {
    // Every third point is enough for a mesh.
    let outline: Vec<Point> = fox().into_iter().step_by(3).collect();
    let n = outline.len();
    let obj: String = outline.iter().map(|[x, y]| format!("v {:.6} 0.0 {:.6}\n", x / 1000.0, y / 1000.0)).collect();
    let face: String = (1..=n).map(|k| format!(" {k}/{k}/1")).collect();
    check("Blender", format!("# Blender 4.1.0\no Fox\n{obj}vn 0 1 0\nf{face}\n").as_bytes(), &outline);
    // A fan is no fox: the triangles of ears that are cut off one by one.
    let triangles = ears(&outline);
    let plate = |p: Point, high: f64| [p[0], high, 400.0 - p[1]];
    let upright: Vec<[[f64; 3]; 3]> = [0.0, 3.0]
        .into_iter()
        .flat_map(|high| triangles.iter().map(move |t| t.map(|k| (k, high))))
        .map(|t| t.map(|(k, high)| plate(outline[k], high)))
        .collect();
    let mut stl = vec![b' '; 80];
    stl.extend((upright.len() as u32).to_le_bytes());
    for triangle in &upright {
        stl.extend([0; 12]);
        triangle.iter().flatten().for_each(|v| stl.extend((*v as f32).to_le_bytes()));
        stl.extend([0; 2]);
    }
    check("a plate that stands", &stl, &outline);
    let vertices: String =
        outline.iter().map(|[x, y]| format!("<vertex x='{x:.4}' y='{:.4}' z='0'/>", 400.0 - y)).collect();
    let faces: String = triangles.iter().map(|[a, b, c]| format!("<triangle v1='{a}' v2='{b}' v3='{c}'/>")).collect();
    let model = format!(
        "<model unit='inch'><resources><object id='1'><mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh></object>\
         </resources><build><item objectid='1' transform='0.01 0 0 0 0.01 0 0 0 0.01 0 0 0'/></build></model>"
    );
    let mut package = zip::ZipWriter::new(Cursor::new(Vec::new()));
    package.start_file("3D/3dmodel.model", zip::write::SimpleFileOptions::default()).unwrap();
    package.write_all(model.as_bytes()).unwrap();
    check("Tinkercad", &package.finish().unwrap().into_inner(), &outline);
}

/// Triangles of a polygon, by cutting off corners that no other point lies in.
fn ears(polygon: &[Point]) -> Vec<[usize; 3]> {
    let turn = |a: Point, b: Point, c: Point| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let sense = turn(polygon[0], polygon[1], polygon[2]).signum();
    let whole: f64 = (1..polygon.len() - 1).map(|k| turn(polygon[0], polygon[k], polygon[k + 1])).sum();
    let sense = if whole == 0.0 { sense } else { whole.signum() };
    let mut left: Vec<usize> = (0..polygon.len()).collect();
    let mut triangles = Vec::new();
    while left.len() > 3 {
        let m = left.len();
        let ear = |i: &usize| {
            let t = [left[(i + m - 1) % m], left[*i], left[(i + 1) % m]];
            let [a, b, c] = t.map(|k| polygon[k]);
            let holds = |p: Point| [turn(a, b, p), turn(b, c, p), turn(c, a, p)].iter().all(|v| v * sense >= 0.0);
            sense * turn(a, b, c) > 0.0 && left.iter().all(|k| t.contains(k) || !holds(polygon[*k]))
        };
        let i = (0..m).find(ear).expect("a polygon has an ear");
        triangles.push([left[(i + m - 1) % m], left[i], left[(i + 1) % m]]);
        left.remove(i);
    }
    triangles.push([left[0], left[1], left[2]]);
    triangles
}

#[test]
fn what_is_not_read_is_refused_with_what_to_do() {
    for (bytes, says) in [
        (&b"glTF\x02\0\0\0"[..], "export its flat face as OBJ, STL or 3MF"),
        (b"BLENDER-v401", "from Blender"),
        (b"PK\x03\x04 Document.archive", "share it as PNG from Procreate"),
        (b"PK\x03\x04 Manifest.dat", "Save as DXF"),
        (b"gimp xcf v011", "export it as PNG"),
        (b"<?xml version='1.0'?><pattern><version>0.6.1</version></pattern>", "export its layout as SVG or DXF"),
        (b"<!DOCTYPE html><html><body>Log in<br></body></html>", "save the picture that it shows"),
        (b"o Curve\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n", "Edit Mode, select all, F"),
        (&dxf("4", "", "0 3DSOLID 8 0 70 1"), "1 3dsolid; explode"),
    ] {
        let error = import(bytes, &Import::default()).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}
