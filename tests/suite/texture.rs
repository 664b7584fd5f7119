//! The picture of a plushie: which part of a file it becomes, where it is drawn, and what stays behind where something fails.

use image::{DynamicImage, Rgba, RgbaImage};
use plushwright::design::{Design, file};
use plushwright::engine::Shape;
use plushwright::outline::Point;
use plushwright::picture::palette::{Palette, Theme};
use plushwright::picture::{Layers, Subject, Texture, raster};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;

/// Upper left, upper right, lower left, lower right.
const QUADRANTS: [[u8; 3]; 4] = [[200, 30, 30], [20, 140, 40], [30, 40, 190], [60, 60, 60]];

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_plushwright"));
        command.current_dir(self.0.path()).args(arguments).output().unwrap()
    }

    /// The texture of a file.
    fn texture(&self, file: &str, options: &[&str]) -> RgbaImage {
        let output = self.run(&[&["new", file, "-o", "a.plush", "--texture"], options].concat());
        assert!(output.status.success(), "{file}: {output:?}");
        assert_eq!(stated(&self.path("a.plush")).as_deref(), Some("a.texture.png"));
        image::open(self.path("a.texture.png")).unwrap().into_rgba8()
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

/// The texture that a design names.
fn stated(design: &Path) -> Option<String> {
    plushwright::design::file::read(design).unwrap().texture
}

/// Four quadrants from `low` up to `high`, on `paper`.
fn quadrants(size: [u32; 2], low: [u32; 2], high: [u32; 2], paper: [u8; 4]) -> RgbaImage {
    RgbaImage::from_fn(size[0], size[1], |x, y| {
        if x < low[0] || y < low[1] || x >= high[0] || y >= high[1] {
            return Rgba(paper);
        }
        let [r, g, b] = QUADRANTS[usize::from(2 * x >= low[0] + high[0]) + 2 * usize::from(2 * y >= low[1] + high[1])];
        Rgba([r, g, b, 255])
    })
}

/// The quadrants fill the texture: `rim` pixels within its corners, and next to its middle.
fn assert_quadrants(texture: &RgbaImage, rim: u32) {
    let (width, height) = texture.dimensions();
    let near = |side: u32| [[rim, side / 2 - 2], [side / 2 + 1, side - 1 - rim]];
    for (k, expected) in QUADRANTS.iter().enumerate() {
        for x in near(width)[k % 2] {
            for y in near(height)[k / 2] {
                let Rgba([r, g, b, a]) = *texture.get_pixel(x, y);
                let far = [r, g, b].iter().zip(expected).any(|(a, b)| a.abs_diff(*b) > 2);
                assert!(!far && a >= 250, "{:?} at {x}, {y} of {width} x {height}", [r, g, b, a]);
            }
        }
    }
}

#[test]
fn the_corners_of_a_picture_are_those_of_the_box() {
    let folder = Folder::new();
    quadrants([300, 220], [30, 40], [230, 180], [0; 4]).save(folder.path("clear.png")).unwrap();
    let texture = folder.texture("clear.png", &[]);
    assert!(texture.width().abs_diff(200) <= 1 && texture.height().abs_diff(140) <= 1, "{:?}", texture.dimensions());
    assert_quadrants(&texture, 1);
    // Neither the height nor the unit of the plushie changes what is in its box.
    let tall = folder.texture("clear.png", &["--height", "250", "--unit", "cm"]);
    assert_eq!(tall.dimensions(), texture.dimensions());
    assert_quadrants(&tall, 1);
    let paper = quadrants([300, 220], [30, 40], [230, 180], [245, 245, 245, 255]);
    DynamicImage::from(paper).into_rgb8().save(folder.path("paper.png")).unwrap();
    let texture = folder.texture("paper.png", &[]);
    assert!(texture.width().abs_diff(200) <= 2 && texture.height().abs_diff(140) <= 2, "{:?}", texture.dimensions());
    assert_quadrants(&texture, 2);
}

#[test]
fn a_large_picture_is_averaged_down() {
    let folder = Folder::new();
    quadrants([3300, 2500], [150, 250], [3150, 2250], [0; 4]).save(folder.path("large.png")).unwrap();
    let texture = folder.texture("large.png", &[]);
    assert!(texture.width() == 2048 && texture.height().abs_diff(1365) <= 1, "{:?}", texture.dimensions());
    assert_quadrants(&texture, 3);
}

#[test]
fn a_drawing_is_painted_with_the_chosen_layers_alone() {
    let folder = Folder::new();
    let colour = |k: usize| format!("rgb({},{},{})", QUADRANTS[k][0], QUADRANTS[k][1], QUADRANTS[k][2]);
    let rects: String = (0..4)
        .map(|k| {
            let (x, y) = (20 + 30 * (k % 2), 10 + 20 * (k / 2));
            format!("<rect x='{x}' y='{y}' width='30' height='20' fill='{}'/>", colour(k))
        })
        .collect();
    let drawing = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='120mm' height='80mm' viewBox='-5 -3 120 80'>\
         <g id='body' transform='translate(2 1)'>{rects}</g>\
         <g id='eyes'><circle cx='26' cy='15' r='8' fill='yellow'/></g></svg>"
    );
    std::fs::write(folder.path("a.svg"), drawing).unwrap();
    let body = folder.texture("a.svg", &["--layer", "body"]);
    assert!(body.width() == 2048 && body.height().abs_diff(1365) <= 1, "{:?}", body.dimensions());
    assert_quadrants(&body, 1);
    let whole = folder.texture("a.svg", &["--smooth", "0.2", "--height", "90"]);
    let scale = 2048.0 / 60.0;
    assert_eq!(whole.get_pixel((4.0 * scale) as u32, (4.0 * scale) as u32).0, [255, 255, 0, 255]);
}

#[test]
fn what_has_no_colours_is_refused() {
    let folder = Folder::new();
    let circle = "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\n0\n20\n0\n40\n50\n0\nENDSEC\n0\nEOF\n";
    std::fs::write(folder.path("a.dxf"), circle).unwrap();
    std::fs::write(folder.path("a.obj"), "v 0 0 0\nv 90 0 0\nv 0 90 0\nf 1 2 3\n").unwrap();
    for (file, what) in [("a.dxf", "a DXF drawing has no colours"), ("a.obj", "an OBJ mesh has no colours")] {
        let output = folder.run(&["new", file, "-o", "a.plush", "--texture"]);
        let line = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(line.contains(what) && line.lines().count() == 1, "{line}");
    }
    assert_eq!(folder.names(), ["a.dxf", "a.obj"]);
}

#[test]
fn nothing_is_left_where_something_fails() {
    let folder = Folder::new();
    quadrants([120, 120], [10, 10], [110, 110], [0; 4]).save(folder.path("a.png")).unwrap();
    let new =
        |output: &str, options: &[&str]| folder.run(&[&["new", "a.png", "-o", output, "--texture"], options].concat());
    // No such mesh; a design that cannot be written; a folder where the texture should be.
    assert_eq!(new("b.plush", &["--fibers", "1"]).status.code(), Some(2));
    assert_eq!(folder.names(), ["a.png"]);
    std::fs::create_dir(folder.path("c.plush")).unwrap();
    assert_eq!(new("c.plush", &[]).status.code(), Some(1));
    assert_eq!(folder.names(), ["a.png", "c.plush"]);
    std::fs::write(folder.path("c.texture.png"), "as before").unwrap();
    assert_eq!(new("c.plush", &[]).status.code(), Some(1));
    assert_eq!(std::fs::read(folder.path("c.texture.png")).unwrap(), b"as before");
    std::fs::create_dir(folder.path("d.texture.png")).unwrap();
    assert_eq!(new("d.plush", &[]).status.code(), Some(1));
    assert_eq!(folder.names(), ["a.png", "c.plush", "c.texture.png", "d.texture.png"]);
    assert_eq!(new("missing/e.plush", &[]).status.code(), Some(1));
}

#[test]
fn a_texture_does_not_replace_the_picture_that_it_is_made_of() {
    let folder = Folder::new();
    quadrants([120, 120], [10, 10], [110, 110], [0; 4]).save(folder.path("a.texture.png")).unwrap();
    let before = std::fs::read(folder.path("a.texture.png")).unwrap();
    let output = folder.run(&["new", "a.texture.png", "-o", "a.plush", "--texture"]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert_eq!(folder.names(), ["a.texture.png"]);
    assert_eq!(std::fs::read(folder.path("a.texture.png")).unwrap(), before);
}

#[test]
fn another_resolution_keeps_the_texture_also_in_another_folder() {
    let folder = Folder::new();
    quadrants([120, 120], [10, 10], [110, 110], [0; 4]).save(folder.path("a.png")).unwrap();
    folder.texture("a.png", &["--fibers", "100"]);
    std::fs::create_dir(folder.path("sub")).unwrap();
    for (output, texture) in [("b.plush", "a.texture.png"), ("sub/b.plush", "b.texture.png")] {
        let done = folder.run(&["remesh", "a.plush", "-o", output, "--fibers", "200"]);
        assert!(done.status.success(), "{done:?}");
        assert_eq!(stated(&folder.path(output)).as_deref(), Some(texture));
    }
    // A texture is beside its design: in another folder there is a copy.
    let bytes = |name: &str| std::fs::read(folder.path(name)).unwrap();
    assert_eq!(bytes("sub/b.texture.png"), bytes("a.texture.png"));
}

const RED: [u8; 3] = [210, 20, 30];
const BLUE: [u8; 3] = [20, 40, 220];

/// A plushie 200 x 100 mm, its left half red, its right half blue.
fn two_colours() -> (Folder, Design) {
    let folder = Folder::new();
    let halves = RgbaImage::from_fn(220, 120, |x, y| match (x, y) {
        (10..110, 10..110) => Rgba([RED[0], RED[1], RED[2], 255]),
        (110..210, 10..110) => Rgba([BLUE[0], BLUE[1], BLUE[2], 255]),
        _ => Rgba([0; 4]),
    });
    halves.save(folder.path("a.png")).unwrap();
    folder.texture("a.png", &["--height", "100", "--fibers", "200"]);
    let design = file::read(&folder.path("a.plush")).unwrap();
    (folder, design)
}

const SIZE: (u32, u32) = (1200, 600);

/// Where the place of a body that fills the box is in the right view of a picture of [`SIZE`].
fn in_picture(p: Point, nodes: &[Point]) -> [u32; 2] {
    let (low, high) = plushwright::outline::polygon::bounding_box(nodes);
    let scale = ((600.0 - 72.0) / (high[0] - low[0])).min((600.0 - 72.0) / (high[1] - low[1]));
    let at = |axis: usize| scale * (p[axis] - 0.5 * (low[axis] + high[axis]));
    [(900.0 + at(0)).round() as u32, (300.0 - at(1)).round() as u32]
}

fn is_near(picture: &RgbaImage, [x, y]: [u32; 2], expected: [u8; 3]) -> bool {
    let Rgba(found) = *picture.get_pixel(x, y);
    (0..3).all(|k| found[k].abs_diff(expected[k]) <= 3)
}

#[test]
fn the_halves_of_a_texture_are_where_they_are_at_rest_and_in_a_pose() {
    let (folder, design) = two_colours();
    let texture = Arc::new(Texture::read(&file::texture_path(&design, &folder.path("a.plush")).unwrap()).unwrap());
    let rest = design.mesh.nodes.clone();
    // Bent to an arc and leant over, by hand: no solver is asked.
    let bent = |p: &Point| {
        let (sin, cos) = (0.006 * (p[0] - 100.0)).sin_cos();
        let r = 160.0 - p[1];
        [r * sin + 0.2 * p[1], -r * cos]
    };
    for nodes in [rest.clone(), rest.iter().map(bent).collect()] {
        let shape = Arc::new(Shape { nodes: nodes.clone(), ..Shape::default() });
        let (texture, design) = (Some(&texture), Arc::new(design.clone()));
        let scene = Layers::of(&Subject { texture, fibers: false, ..Subject::new(&design, &shape) }).scene();
        let png = raster::png(&scene, &scene, SIZE, Palette::of(Theme::Light).background).unwrap();
        let picture = image::load_from_memory(&png).unwrap().into_rgba8();
        let (mut red, mut blue) = (0, 0);
        for t in &design.mesh.triangles {
            let middle = |nodes: &[Point]| [0, 1].map(|k| t.iter().map(|&n| nodes[n][k]).sum::<f64>() / 3.0);
            // Beside the line on which they meet.
            let expected = match middle(&rest)[0] {
                ..95.0 => RED,
                105.0.. => BLUE,
                _ => continue,
            };
            let at = in_picture(middle(&nodes), &nodes);
            assert!(
                is_near(&picture, at, expected),
                "{:?} at {at:?}, not {expected:?}",
                picture.get_pixel(at[0], at[1])
            );
            *(if expected == RED { &mut red } else { &mut blue }) += 1;
        }
        assert!(red > 30 && blue > 30, "{red} {blue}");
    }
}

#[test]
fn the_texture_is_rendered_left_out_and_missed_without_failing() {
    let (folder, design) = two_colours();
    let nodes = &design.mesh.nodes;
    let [left, right] = [[37.0, 47.0], [163.0, 47.0]].map(|p| in_picture(p, nodes));
    let felt = Palette::of(Theme::Light).body;
    let felt = [felt.0, felt.1, felt.2];
    let render = |options: &[&str]| {
        let output = folder.run(&[&["render", "a.plush", "-o", "a-out.png", "--size", "1200x600"], options].concat());
        assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
        (image::open(folder.path("a-out.png")).unwrap().into_rgba8(), String::from_utf8(output.stdout).unwrap())
    };
    let (picture, said) = render(&[]);
    assert!(is_near(&picture, left, RED) && is_near(&picture, right, BLUE) && !said.contains("note"), "{said}");
    let (picture, _) = render(&["--no-texture"]);
    assert!(is_near(&picture, left, felt) && is_near(&picture, right, felt));
    for broken in [None, Some("no picture")] {
        std::fs::remove_file(folder.path("a.texture.png")).unwrap();
        if let Some(text) = broken {
            std::fs::write(folder.path("a.texture.png"), text).unwrap();
        }
        let (picture, said) = render(&[]);
        assert!(is_near(&picture, left, felt), "{said}");
        assert!(said.contains("note: drawn without its texture a.texture.png: "), "{said}");
        std::fs::write(folder.path("a.texture.png"), "").unwrap();
    }
}

#[test]
fn another_silhouette_leaves_the_texture_where_it_is() {
    let (folder, _) = two_colours();
    // A head on the left end moves the corner of the box by 40 mm and 10 mm.
    let head = "(parts: [
        (primitive: Path(points: [(at: (0, 0), corner: true), (at: (200, 0), corner: true), (at: (200, 100), corner: true),
            (at: (0, 100), corner: true)])),
        (primitive: Circle(center: (20, 50), radius: 60)),
    ])";
    std::fs::write(folder.path("head.ron"), head).unwrap();
    let output = folder.run(&["reshape", "a.plush", "head.ron", "-o", "b.plush", "--fibers", "300"]);
    assert!(output.status.success(), "{output:?}");
    let design = file::read(&folder.path("b.plush")).unwrap();
    let [low, high] = design.texture_rect();
    for (found, expected) in [low, high].into_iter().flatten().zip([40.0, 10.0, 240.0, 110.0]) {
        assert!((found - expected).abs() < 0.2, "{low:?} {high:?}");
    }
    let output = folder.run(&["render", "b.plush", "-o", "b.png", "--size", "1200x600"]);
    assert!(output.status.success(), "{output:?}");
    let picture = image::open(folder.path("b.png")).unwrap().into_rgba8();
    let at = |p: Point| in_picture(p, &design.mesh.nodes);
    let felt = Palette::of(Theme::Light).body;
    // Left and right of the line on which the halves meet; the head has no picture.
    assert!(is_near(&picture, at([133.0, 61.0]), RED) && is_near(&picture, at([147.0, 61.0]), BLUE));
    assert!(is_near(&picture, at([25.0, 61.0]), [felt.0, felt.1, felt.2]));
}
