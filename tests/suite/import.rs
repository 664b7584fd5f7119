//! Outlines through the built program: what a user sees of good files and of broken ones.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// Longest that a broken file may occupy anybody, on a slow machine and without optimisation.
const PATIENCE: Duration = Duration::from_secs(60);
/// Memory for it, KiB of address space.
#[cfg(unix)]
const MEMORY_KIB: usize = 4 << 20;

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn put(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    fn design(&self) -> PathBuf {
        self.0.path().join("out.plush")
    }

    /// `new` with a bound on memory.
    fn new_design(&self, file: &Path, options: &[&str]) -> Output {
        let program = env!("CARGO_BIN_EXE_plushwright");
        #[cfg(unix)]
        let mut command = {
            let mut shell = Command::new("sh");
            shell.arg("-c").arg(format!("ulimit -v {MEMORY_KIB}; exec \"$0\" \"$@\"")).arg(program);
            shell
        };
        #[cfg(not(unix))]
        let mut command = Command::new(program);
        command.arg("new").arg(file).arg("-o").arg(self.design()).args(options);
        command.output().unwrap()
    }

    /// Refused with code 2 and one clear line, in time, without leaving a file.
    fn refused(&self, file: &Path, says: &str) {
        let start = Instant::now();
        let output = self.new_design(file, &[]);
        let line = String::from_utf8_lossy(&output.stderr);
        let what = format!("{}: {line}", file.display());
        assert_eq!(output.status.code(), Some(2), "{what}");
        assert_eq!(line.trim_end().lines().count(), 1, "{what}");
        assert!(line.contains(says), "{what}");
        assert!(output.stdout.is_empty() && !self.design().exists(), "{what}");
        assert!(start.elapsed() < PATIENCE, "{what} after {:?}", start.elapsed());
    }

    fn accepted(&self, file: &Path, options: &[&str]) -> serde_json::Value {
        let output = self.new_design(file, &[options, &["--json"]].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{}: {error}", file.display());
        // Gone again, so that a refusal later on is seen to leave none.
        std::fs::remove_file(self.design()).unwrap();
        serde_json::from_slice(&output.stdout).unwrap()
    }
}

fn svg(body: &str) -> Vec<u8> {
    format!("<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>{body}</svg>")
        .into_bytes()
}

/// Evenly distributed numbers between 0 and 1.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

#[test]
fn clean_up_is_reported_in_words_and_in_json() {
    let folder = Folder::new();
    let drawing = "<rect width='100' height='100' fill='white'/><rect x='10' y='10' width='40' height='40'/>\
                   <rect x='50' y='50' width='40' height='40'/><circle cx='80' cy='20' r='5'/>";
    let file = folder.put("a.svg", &svg(drawing));
    folder.refused(&file, "2 separate pieces");
    let report = folder.accepted(&file, &["--pieces", "largest", "--height", "250"]);
    let steps = report["clean_up"]["steps"].as_array().unwrap();
    let whats: Vec<&str> = steps.iter().map(|s| s["what"].as_str().unwrap()).collect();
    assert_eq!(whats, ["pinches", "pieces"], "{report:#}");
    assert!(report["clean_up"]["unasked"].as_f64().unwrap() < 0.02);
    assert!((report["height_mm"].as_f64().unwrap() - 250.0).abs() < 1e-9);
    let words = folder.new_design(&file, &["--pieces", "largest"]).stdout;
    let words = String::from_utf8_lossy(&words);
    for part in ["background rectangle", "1 smaller piece left out", "1 pinched point joined"] {
        assert!(words.contains(part), "{part}: {words}");
    }
}

#[test]
fn stripes_that_share_a_boundary_are_one_piece_and_what_was_closed_is_told() {
    // The lower stripe draws what they share from right to left, in one curve; the upper one from left to right, in two.
    let folder = Folder::new();
    let lower = "<path fill='red' d='M5 50V90H95V50C65 20 35 80 5 50'/>";
    let upper = "<path fill='blue' d='M95 50V10H5V50C20 65 35 57.5 50 50S80 35 95 50'/>";
    let file = folder.put("flag.svg", &svg(&[lower, upper].concat()));
    let whats = |args: &[&str]| -> Vec<String> {
        let report = folder.accepted(&file, &[&["--height", "200"], args].concat());
        let steps = report["clean_up"]["steps"].as_array().unwrap();
        assert!(report["clean_up"]["unasked"].as_f64().unwrap() < 1e-3, "{report:#}");
        steps.iter().map(|s| s["what"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(whats(&[])[0], "slits");
    let words = folder.new_design(&file, &["--height", "200"]).stdout;
    assert!(String::from_utf8_lossy(&words).contains("of the area); --gap sets how wide they may be, 0 for none"));
}

#[test]
fn small_drawings_are_warned_of_and_too_few_fibers_refused() {
    let folder = Folder::new();
    let small = folder.put(
        "s.svg",
        b"<svg xmlns='http://www.w3.org/2000/svg' width='24' height='24'><circle cx='12' cy='12' r='10'/></svg>",
    );
    let report = folder.accepted(&small, &[]);
    assert!((report["height_mm"].as_f64().unwrap() - 20.0 * 25.4 / 96.0).abs() < 0.01);
    assert!(report["clean_up"]["notes"][0].as_str().unwrap().contains("--height"), "{report:#}");
    assert!(folder.accepted(&small, &["--height", "200"])["clean_up"]["notes"].as_array().unwrap().is_empty());
    let tooth = |i: i32| format!("L{x} 90 L{x} 10 L{y} 10 L{y} 90", x = 8 * i, y = 8 * i + 4);
    let teeth: String = (0..12).map(tooth).collect();
    let comb = folder.put("comb.svg", &svg(&format!("<path d='M0 90{teeth}L99 100L0 100z'/>")));
    let output = folder.new_design(&comb, &["--fibers", "30"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("nearest possible"), "{output:?}");
}

#[test]
fn a_width_is_asked_for_in_place_of_a_height() {
    let folder = Folder::new();
    let narrow = folder.put("narrow.svg", &svg("<ellipse cx='50' cy='50' rx='20' ry='40'/>"));
    let report = folder.accepted(&narrow, &["--width", "75"]);
    assert!((report["height_mm"].as_f64().unwrap() - 150.0).abs() < 1e-3, "{report:#}");
    let numbers = folder.put(
        "numbers.dxf",
        b"0\nSECTION\n2\nENTITIES\n0\nELLIPSE\n10\n5\n20\n5\n11\n0\n21\n40\n40\n0.5\n41\n0\n42\n6.283185307179586\n0\nENDSEC\n0\nEOF\n",
    );
    // The ellipse is a polygon by then, with tops of its own.
    let report = folder.accepted(&numbers, &["--width", "75"]);
    assert!((report["height_mm"].as_f64().unwrap() - 150.0).abs() < 0.05, "{report:#}");
    for wrong in [&["--width", "75", "--height", "150"][..], &["--width", "0"], &["--width", "1e9"]] {
        assert_eq!(folder.new_design(&narrow, wrong).status.code(), Some(2), "{wrong:?}");
    }
}

#[test]
fn pictures_are_read_by_opacity_or_background() {
    let folder = Folder::new();
    let disc = |x: u32, y: u32| ((f64::from(x) - 150.0).hypot(f64::from(y) - 150.0) < 100.0, x, y);
    let clear = image::RgbaImage::from_fn(300, 300, |x, y| {
        image::Rgba(if disc(x, y).0 { [255; 4] } else { [255, 255, 255, 0] })
    });
    let ink = image::RgbImage::from_fn(300, 300, |x, y| {
        let paper = 235 - (x / 4) as u8;
        image::Rgb(if disc(x, y).0 { [40, 35, 60] } else { [paper, paper, paper - 15] })
    });
    for (name, picture) in
        [("a.png", image::DynamicImage::from(clear)), ("b.png", ink.clone().into()), ("c.jpg", ink.into())]
    {
        let path = folder.0.path().join(name);
        picture.save(&path).unwrap();
        let report = folder.accepted(&path, &["--unit", "mm"]);
        let area = report["clean_up"]["outline_mm2"].as_f64().unwrap();
        assert!((area / (std::f64::consts::PI * 1e4) - 1.0).abs() < 0.01, "{name}: {area}");
        assert!((report["height_mm"].as_f64().unwrap() - 200.0).abs() < 1.5, "{name}");
    }
    let flat = folder.put("flat.png", b"");
    image::RgbImage::from_pixel(50, 50, image::Rgb([200; 3])).save(&flat).unwrap();
    folder.refused(&flat, "one colour");
}

#[test]
fn a_flat_mesh_stays_as_it_is() {
    let folder = Folder::new();
    let mut obj = String::new();
    for i in 0..=10 {
        for j in 0..=10 {
            obj += &format!("v {} {} 0\n", 10 * i, 10 * j);
        }
    }
    for i in 0..10 {
        for j in 1..=10 {
            let k = 11 * i + j;
            obj += &format!("f {} {} {} {}\n", k, k + 11, k + 12, k + 1);
        }
    }
    let file = folder.put("m.obj", obj.as_bytes());
    let report = folder.accepted(&file, &[]);
    assert_eq!((report["nodes"].as_u64(), report["triangles"].as_u64()), (Some(121), Some(200)));
    assert_eq!(folder.accepted(&file, &["--fibers", "300"])["fibers"].as_u64(), Some(300));
}

#[test]
fn broken_files_are_refused_in_one_line() {
    let folder = Folder::new();
    let put = |name: &str, bytes: &[u8]| folder.put(name, bytes);
    let pig = std::fs::read(format!("{}/assets/pig.svg", env!("CARGO_MANIFEST_DIR"))).unwrap();
    folder.refused(&put("cut.svg", &pig[..pig.len() / 2]), "not a readable SVG");
    let mut state = 7;
    let noise: Vec<u8> = (0..100_000).map(|_| (256.0 * random(&mut state)) as u8).collect();
    folder.refused(&put("noise.svg", &noise), "neither an SVG");
    folder.refused(&put("noise.png", &[b"\x89PNG\r\n\x1a\n".as_slice(), &noise].concat()), "not a readable picture");
    folder.refused(&put("noise.jpg", &[b"\xff\xd8\xff\xe0".as_slice(), &noise].concat()), "not a readable picture");
    folder.refused(&put("empty.svg", b""), "neither an SVG");
    folder.refused(&put("cut.dxf", b"0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10"), "not a readable DXF");
    folder.refused(&put("cut.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2"), "not a readable OBJ");
    folder.refused(&folder.0.path().join("none.svg"), "none.svg");
    folder.refused(folder.0.path(), "");
    let large = put("large.svg", b"<svg xmlns='http://www.w3.org/2000/svg'>");
    std::fs::OpenOptions::new().write(true).open(&large).unwrap().set_len(100 << 20).unwrap();
    folder.refused(&large, "larger than 48 MB");
}

#[test]
fn files_that_grow_without_bound_are_refused() {
    let folder = Folder::new();
    let mut laughs = "<!DOCTYPE svg [<!ENTITY a0 'M0 0h9v9z '>".to_owned();
    let mut uses = "<rect id='u0' width='9' height='9'/>".to_owned();
    for i in 1..=9 {
        let of = |what: String| what.repeat(10);
        laughs += &format!("<!ENTITY a{i} '{}'>", of(format!("&a{};", i - 1)));
        uses += &format!("<g id='u{i}'>{}</g>", of(format!("<use href='#u{}'/>", i - 1)));
    }
    let laughs = format!("{laughs}]><svg xmlns='http://www.w3.org/2000/svg'><path d='&a9;'/></svg>");
    folder.refused(&folder.put("laughs.svg", laughs.as_bytes()), "not a readable SVG");
    folder.refused(&folder.put("uses.svg", &svg(&uses)), "");
    let clips: String = (1..=40)
        .map(|i| {
            let inner = format!("<rect width='90' height='90' clip-path='url(#c{})'/>", i - 1);
            format!("<clipPath id='c{i}'>{inner}{inner}</clipPath>")
        })
        .collect();
    let clips = format!(
        "<clipPath id='c0'><rect width='80' height='80'/></clipPath>{clips}<rect width='90' height='90' clip-path='url(#c40)'/>"
    );
    folder.refused(&folder.put("clips.svg", &svg(&clips)), "");
    let deep = "<g>".repeat(50_000) + &"</g>".repeat(50_000);
    folder.refused(&folder.put("deep.svg", &svg(&deep)), "");
}

#[test]
fn a_million_points_are_read_and_a_scribble_of_as_many_is_refused() {
    let folder = Folder::new();
    let start = Instant::now();
    let circle: String = (0..1_000_000)
        .map(|i| {
            let a = std::f64::consts::TAU * f64::from(i) / 1e6;
            format!("L{:.6} {:.6}", 50.0 + 40.0 * a.cos(), 50.0 + 40.0 * a.sin())
        })
        .collect();
    let fine = folder.put("fine.svg", &svg(&format!("<path d='M90 50{circle}z'/>")));
    let report = folder.accepted(&fine, &[]);
    assert!((report["clean_up"]["outline_mm2"].as_f64().unwrap() / (1600.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3);
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
    let mut state = 3;
    let scribble: String = (0..1_000_000)
        .map(|_| format!("L{:.3} {:.3}", 100.0 * random(&mut state), 100.0 * random(&mut state)))
        .collect();
    folder.refused(&folder.put("scribble.svg", &svg(&format!("<path d='M0 0{scribble}z'/>"))), "crosses itself");
}

#[test]
fn numbers_that_are_none_do_no_harm() {
    let folder = Folder::new();
    for (k, body) in [
        "<path d='M NaN 0 L 50 0 L 50 50 z'/>",
        "<rect x='nan' width='inf' height='1e400'/>",
        "<g transform='scale(1e38)'><g transform='scale(1e38)'><rect width='9' height='9'/></g></g>",
        "<path d='M0 0L1e38 0L1e38 1e38L-1e38 3e38z'/>",
        "<g transform='scale(1e-30)'><rect width='9' height='9'/></g>",
        "<path d='M10 10L20 20' stroke='red' stroke-width='1e38'/>",
        "<circle cx='50' cy='50' r='40' stroke='red' stroke-dasharray='1e-9'/>",
        "<path d='M0 0C1e20 0 -1e20 50 9 9' stroke='red'/>",
    ]
    .iter()
    .enumerate()
    {
        let start = Instant::now();
        let output = folder.new_design(&folder.put(&format!("{k}.svg"), &svg(body)), &[]);
        let line = String::from_utf8_lossy(&output.stderr);
        assert!(matches!(output.status.code(), Some(0 | 2)) && line.lines().count() <= 1, "{body}: {line} {output:?}");
        assert!(start.elapsed() < PATIENCE, "{body}: {:?}", start.elapsed());
    }
}

#[test]
fn a_picture_of_30000_by_30000_is_refused_by_its_header() {
    let folder = Folder::new();
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |name: &[u8], data: &[u8]| {
        png.extend((data.len() as u32).to_be_bytes());
        let body = [name, data].concat();
        png.extend(&body);
        png.extend(crc(&body).to_be_bytes());
    };
    let side = 30_000_u32.to_be_bytes();
    chunk(b"IHDR", &[&side[..], &side, &[8, 6, 0, 0, 0]].concat());
    chunk(b"IDAT", &[0x78, 0x9c, 3, 0, 0, 0, 0, 1]);
    chunk(b"IEND", &[]);
    folder.refused(&folder.put("huge.png", &png), "40 million pixels");
}

/// The checksum of PNG chunks.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 })
    })
}

#[test]
fn a_preview_is_written_with_a_design_or_without() {
    let folder = Folder::new();
    let body = "<rect width='100' height='100' fill='white'/><path d='M20 20h50v60h-50z'/>";
    let file = folder.put("a.svg", &svg(body));
    let preview = folder.0.path().join("a.png");
    let to = ["--preview", preview.to_str().unwrap()];
    folder.accepted(&file, &to);
    assert!(image::open(&preview).unwrap().width() > 200);
    std::fs::remove_file(&preview).unwrap();
    let output =
        std::process::Command::new(env!("CARGO_BIN_EXE_plushwright")).arg("new").arg(&file).args(to).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && preview.exists(), "{output:?}");
    for part in ["50.0 x 60.0 mm", "blue: taken for the background", "--background keep"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    // Pieces are shown, and refused all the same.
    let pieces = folder.put("b.svg", &svg("<rect width='40' height='60'/><rect x='60' width='30' height='60'/>"));
    let preview = folder.0.path().join("b.png");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_plushwright"))
        .args(["new".as_ref(), pieces.as_os_str(), "--preview".as_ref(), preview.as_os_str()])
        .output()
        .unwrap();
    assert!(output.status.code() == Some(2) && preview.exists(), "{output:?}");
}
