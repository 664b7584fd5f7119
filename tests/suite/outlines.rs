//! Outlines of real files: the six bundled ones with meshes fit for posing, one that few counts can mesh, and mutations of all formats.

use plushwright::mesh::{self, MeshError, quality::MeshQuality};
use plushwright::outline::{Import, Pieces, import, svg};

#[test]
fn the_bundled_outlines_mesh_well() {
    // The robot's mesh is its own mirror image, which costs it two degrees around its antenna and its neck.
    for (name, fibers, least_deg) in [
        ("robot", 414, 28.0),
        ("pig", 571, 30.0),
        ("e", 442, 30.0),
        ("s", 276, 30.0),
        ("puppy", 307, 30.0),
        ("squid", 429, 30.0),
    ] {
        let file = format!("{}/assets/{name}.svg", env!("CARGO_MANIFEST_DIR"));
        let drawing = std::fs::read(file).unwrap();
        let outline = svg::read(&drawing, None).unwrap();
        let (low, high) = outline.bounding_box();
        assert_eq!(low, [0.0, 0.0]);
        let longer = high[0].max(high[1]);
        assert!((250.0..=300.0).contains(&longer) && outline.holes.is_empty(), "{name}: {high:?}");

        let mesh = mesh::generate(&outline, fibers).unwrap();
        let quality = MeshQuality::of(&mesh);
        assert_eq!(mesh.validate(), Ok(()));
        assert_eq!(quality.edges, fibers, "{name}");
        assert!(quality.min_angle_deg > least_deg && quality.bridges == 0, "{name}: {quality:?}");
        assert!((mesh.area() / outline.area() - 1.0).abs() < 0.01);

        let tall = svg::read(&drawing, Some(100.0)).unwrap();
        assert!((tall.bounding_box().1[1] - 100.0).abs() < 1e-9);
    }
}

/// Where no mesh with the asked number of fibres or more is found, the refusal names one that is.
#[test]
fn a_refusal_names_a_count_below_the_asked_one() {
    // A lizard of hairlines from the Open Clip Art Library 0.18 (public domain), with slits between its stripes.
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/outlines/lizard.plush");
    let outline = plushwright::design::file::read(std::path::Path::new(file)).unwrap().outline;
    let Err(MeshError::Unreachable { asked: 20_000, nearest }) = mesh::generate(&outline, 20_000) else { panic!() };
    assert!(nearest < 20_000);
    let mesh = mesh::generate(&outline, nearest).unwrap();
    assert_eq!((mesh.edges().len(), mesh.validate()), (nearest, Ok(())));
}

/// Small files of every format, with something of each construct.
fn seeds() -> Vec<Vec<u8>> {
    let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='90mm' height='90mm' viewBox='0 0 90 90'><defs>\
               <clipPath id='c'><rect width='80' height='80'/></clipPath><mask id='m'><rect width='70' height='70' \
               fill='white'/><circle cx='20' cy='20' r='5'/></mask></defs><g clip-path='url(#c)' transform='rotate(3)'>\
               <path mask='url(#m)' d='M9 9h60v50c-9 9-50 9-60 0z' stroke='red' stroke-width='2' stroke-dasharray='3 1'/>\
               <text x='20' y='60' font-size='30'>S</text><ellipse cx='50' cy='50' rx='9' ry='20'/></g></svg>";
    let dxf = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 BLOCKS 0 BLOCK 2 B 10 0 20 0 0 CIRCLE 10 5 20 5 40 9 \
               0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES 0 LWPOLYLINE 70 1 10 0 20 0 42 1 10 60 20 0 42 1 0 INSERT 2 B 10 \
               20 20 5 41 2 42 2 0 ARC 10 9 20 9 40 9 50 0 51 90 0 SPLINE 70 1 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 \
               0 10 50 20 9 10 9 20 60 0 ENDSEC 0 EOF";
    let obj = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 4 14 0\nf 1 2 3 4\nf 4/1 3/1 5/1\nf -5 -4 -3\n";
    let mut files = vec![svg.into(), dxf.replace(' ', "\n").into_bytes(), obj.into()];
    // Dark on what is clear in the PNG and white in the JPEG, which has no opacity.
    let picture = image::RgbaImage::from_fn(24, 24, |x, y| {
        image::Rgba(if x > 4 && y > x / 2 { [9, 9, 9, 255] } else { [255, 255, 255, 0] })
    });
    let picture = image::DynamicImage::from(picture);
    for (format, picture) in
        [(image::ImageFormat::Png, picture.clone()), (image::ImageFormat::Jpeg, picture.to_rgb8().into())]
    {
        let mut bytes = std::io::Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).unwrap();
        files.push(bytes.into_inner());
    }
    files
}

#[test]
fn mutations_of_good_files_are_read_or_refused() {
    let mut state = 11_u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    const NUMBERS: [&str; 10] =
        ["0", "-1", "1e39", "-1e300", "nan", "inf", "1e-40", "99999999999999999999", "0.5", "65536"];
    let options = Import { pieces: Pieces::Largest, ..Import::default() };
    let mut read = 0;
    for seed in seeds() {
        assert!(import(&seed, &options).is_ok());
        for _ in 0..250 {
            let mut file = seed.clone();
            for _ in 0..1 + random(4) {
                let at = random(file.len());
                match random(4) {
                    0 => file[at] = random(256) as u8,
                    1 => drop(file.drain(at..(at + 1 + random(8)).min(file.len()))),
                    2 => {
                        let piece = file[at..(at + 1 + random(40)).min(file.len())].to_vec();
                        file.splice(at..at, piece);
                    }
                    _ => {
                        let end = at + file[at..].iter().take_while(|b| b.is_ascii_digit()).count();
                        file.splice(at..end, NUMBERS[random(NUMBERS.len())].bytes());
                    }
                }
                if file.is_empty() {
                    break;
                }
            }
            read += usize::from(import(&file, &options).is_ok());
        }
    }
    // Mutations that break everything would test little.
    assert!(read > 200, "{read}");
}
