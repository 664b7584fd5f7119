//! The document: the file format, validation, edits and undo, put to random but seeded use.

use crate::support::{Random, rectangle, rigged};
use plushwright::design::file::{self, TextError};
use plushwright::design::{Design, Easing, EditError, FORMAT_VERSION, FiberSet, Gravity, History, Keyframe};
use plushwright::design::{MaterialPoint, Pin, Pose, edit};
use plushwright::outline::Drawing;
use plushwright::physics::terms::GRAVITY;
use plushwright::physics::{NeoHookean, StVenantKirchhoff};
use plushwright::sewing::Rules;
use std::fs;
use std::sync::Arc;

/// A text in which every bit of every number counts.
fn bits(design: &Design) -> String {
    file::to_text(design).expect("a design can be written")
}

/// One random edit; most are valid, some are refused.
fn random_edit(random: &mut Random, design: &mut Design) -> Result<(), EditError> {
    let index = random.below(4);
    let name = format!("name {}", random.below(6));
    match random.below(19) {
        0 => {
            let position = (random.below(2) == 0).then(|| [random.unit(), random.unit()]);
            let stiffness = random.between(-1.0, 30.0);
            edit::add_pin(design, Pin { position, ..Pin::at_rest(random.body_point(&design.mesh), stiffness) })
                .map(drop)
        }
        1 => edit::remove_pin(design, index).map(drop),
        2 => edit::add_pose(design, Pose { name, targets: vec![random.target(&design.mesh)] }).map(drop),
        3 => edit::rename_pose(design, index, &name),
        4 => edit::duplicate_pose(design, index).map(drop),
        5 => edit::remove_pose(design, index).map(drop),
        6 => edit::add_target(design, index, random.target(&design.mesh)).map(drop),
        7 => edit::move_target(design, index, random.below(3), [random.unit() * 9.0, random.unit()]),
        8 => edit::remove_target(design, index, random.below(3)).map(drop),
        9 => edit::accept_network(design, random.network(&design.mesh)).map(drop),
        10 => edit::remove_network(design, index).map(drop),
        11 => edit::rename_network(design, index, &name),
        12 | 13 => {
            let activations_mm = design.networks.iter().map(|_| random.between(0.0, 20.0)).collect();
            let pose = design.poses.get(index).map(|p| p.name.clone());
            let time_s = 0.25 * random.below(20) as f64;
            let easing = [Easing::Linear, Easing::Smooth, Easing::Hold][random.below(3)];
            edit::set_keyframe(design, Keyframe { time_s, activations_mm, pose, easing }).map(drop)
        }
        14 => edit::move_keyframe(design, index, 0.25 * random.below(20) as f64).map(drop),
        15 => edit::remove_keyframe(design, index).map(drop),
        16 => edit::set_material(design, NeoHookean { mu: random.between(-0.1, 1.0), kappa: random.unit() }.into()),
        17 => edit::set_sewing(
            design,
            Rules { hole_to_seam_mm: random.between(-1.0, 9.0), most_holes: random.below(9), ..design.sewing },
        ),
        _ => {
            let (up, surface_density) = (-random.unit(), random.between(-1e-7, 1e-6));
            edit::set_term(design, GRAVITY, Some(Gravity { acceleration: [0.0, up], surface_density }.into()))
        }
    }
}

#[test]
fn random_edits_keep_the_design_valid_and_refused_ones_leave_it_alone() {
    for seed in 0..20 {
        let mut random = Random(seed);
        let mut design = rectangle(100.0, 60.0, 3, 2);
        let mut refused = 0;
        for step in 0..200 {
            let before = design.clone();
            if random_edit(&mut random, &mut design).is_err() {
                refused += 1;
                assert_eq!(design, before, "seed {seed}, step {step}");
            }
            design.validate().unwrap_or_else(|e| panic!("seed {seed}, step {step}: {e}"));
        }
        assert!((10..190).contains(&refused), "{refused} of 200 edits were refused: the test shows little");
    }
}

#[test]
fn undo_all_and_redo_all_give_back_every_document() {
    for seed in 100..115 {
        let mut random = Random(seed);
        let mut history = History::new(rectangle(100.0, 60.0, 3, 2));
        let mut states = vec![bits(history.current())];
        for step in 0..120 {
            let label = format!("step {step}");
            if random.below(3) == 0 {
                history.begin(label);
                for _ in 0..random.below(4) {
                    let _ = history.preview(|d| random_edit(&mut random, d));
                }
                if random.below(4) == 0 {
                    history.cancel();
                } else {
                    history.commit();
                }
            } else {
                let _ = history.edit(label, |d| random_edit(&mut random, d));
            }
            // Now and then a few steps back and some of them forth again.
            for _ in 0..random.below(12).saturating_sub(9) {
                if history.undo().is_some() {
                    states.pop();
                }
            }
            let state = bits(history.current());
            if states.last() != Some(&state) {
                states.push(state);
            }
        }
        let end = history.current().clone();
        for back in states.iter().rev().skip(1) {
            assert!(history.undo().is_some());
            assert_eq!(bits(history.current()), *back, "seed {seed}");
        }
        assert_eq!((history.undo(), history.undo_label(), history.is_modified()), (None, None, false));
        for forth in states.iter().skip(1) {
            assert!(history.redo().is_some());
            assert_eq!(bits(history.current()), *forth, "seed {seed}");
        }
        assert!(Arc::ptr_eq(history.current(), &end));
    }
}

#[test]
fn text_gives_back_every_bit() {
    let mut random = Random(7);
    for seed in 0..50 {
        let mut design = rectangle(random.between(1.0, 1e3), random.between(1e-3, 1e3), 3, 2);
        design.name = "quotes \" and \\, ümlauts, 縫いぐるみ".into();
        design.stiffness_map = (seed % 2 == 0).then(|| vec![random.between(1e-4, 1e4); 12]);
        design.texture = (seed % 3 == 0).then(|| "pictures/pig.png".into());
        design.texture_box = (seed % 6 == 0).then(|| [[-1.0 / 3.0, random.between(-9.0, 0.0)], [1e-3, 0.1 + 0.2]]);
        let tracks = vec![vec![[random.between(-1e3, 1e3), 0.1], [2.0 / 3.0, 1e-9], [5.0, 6.0]]];
        design.drawing = (seed % 4 == 0).then(|| Drawing { tracks, ..Drawing::default() });
        design.material = StVenantKirchhoff { mu: 0.1 + 0.2, lambda: f64::MIN_POSITIVE }.into();
        design.fibers.set = FiberSet::Routings(vec![vec![0, 1, 0], vec![3, 4]]);
        for _ in 0..60 {
            let _ = random_edit(&mut random, &mut design);
        }
        let text = bits(&design);
        let back = file::parse(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!(back, design);
        assert_eq!(bits(&back), text);
        for (a, b) in back.mesh.nodes.iter().flatten().zip(design.mesh.nodes.iter().flatten()) {
            assert_eq!(a.to_bits(), b.to_bits());
        }
    }
}

#[test]
fn the_text_is_made_for_people() {
    let text = bits(&rigged());
    let lines: Vec<&str> = text.lines().collect();
    for line in [
        "    version: 2,",
        "    name: \"rectangle\",",
        "            (20.0, 0.0),",
        "            (0, 1, 8),",
        "        (at: (triangle: 0, weights: (1.0, 0.0, 0.0)), stiffness: 20.0),",
        "                (at: (triangle: 5, weights: (0.2, 0.3, 0.5)), to: (130.0, 90.0), weight: 1.0),",
        "                (routing: [10, 9, 8]),",
        "        (time_s: 1.0, activations_mm: [10.0, 4.0], easing: Smooth),",
    ] {
        assert!(lines.contains(&line), "no line {line:?} in\n{text}");
    }
    assert!(lines.iter().all(|line| line.chars().count() < 110), "{text}");
}

#[test]
fn rules_of_sewing_are_written_where_they_are_not_the_usual_ones() {
    let mut design = rigged();
    assert!(!bits(&design).contains("sewing"));
    design.sewing.housing_mm = 1.0 / 3.0;
    let text = bits(&design);
    assert!(text.contains("    sewing: (\n        hole_to_seam_mm: 5.0,\n"), "{text}");
    assert_eq!(file::parse(&text), Ok(design));
    let some = bits(&rigged()).replacen("    pins:", "    sewing: (most_holes: 3),\n    pins:", 1);
    assert_eq!(file::parse(&some).expect("a design").sewing, Rules { most_holes: 3, ..Rules::default() });
    let unknown = some.replacen("most_holes", "most_hoels", 1);
    assert!(file::parse(&unknown).unwrap_err().to_string().contains("most_hoels"));
}

#[test]
fn a_short_file_by_hand_is_enough() {
    let text = r#"
        // Everything else has a default.
        Design(
            version: 1,
            name: "triangle",
            outline: (outer: [(0, 0), (60, 0), (0, 60)]),
            mesh: (nodes: [(0, 0), (60, 0), (0, 60)], triangles: [(0, 1, 2)]),
        )"#;
    let design = file::parse(text).expect("a design");
    assert_eq!(design.body_length_mm(), 60.0);
    assert_eq!(file::parse(&format!("\u{feff}{text}")), Ok(design));
}

#[test]
fn tendons_pass_points_of_the_body_and_files_of_version_1_read() {
    let mut design = rigged();
    let inside = MaterialPoint::of_triangle(design.mesh.triangles[3], [0.1, 0.2, 0.7]);
    design.networks[0].tendons[0].routing.insert(1, inside.clone());
    design.validate().unwrap();
    let text = bits(&design);
    let [a, b, c] = design.mesh.triangles[3];
    assert!(text.contains(&format!("(nodes: ({a}, {b}, {c}), weights: (0.1, 0.2, 0.7))")), "{text}");
    assert_eq!(file::parse(&text), Ok(design.clone()));
    let old = bits(&rigged()).replacen("version: 2", "version: 1", 1);
    assert_eq!(file::parse(&old), Ok(rigged()));
    for (from, to, why) in [
        (format!("({a}, {b}, {c})"), format!("({b}, {a}, {c})"), "routing[1].nodes: nodes"),
        ("(0.1, 0.2, 0.7)".into(), "(0.1, 0.2, 0.8)".into(), "routing[1].weights: "),
        ("(0.1, 0.2, 0.7)".into(), "(-0.1, 0.4, 0.7)".into(), "routing[1].weights[0]: "),
        (format!("nodes: ({a}, "), "nodes: (999, ".into(), "routing[1].nodes[0]: 999"),
        (", weights: (0.1".into(), ", wieghts: (0.1".into(), "wieghts"),
    ] {
        // Triangles of the mesh may look the same.
        let networks = text.find("networks:").unwrap();
        let at = networks + text[networks..].find(&from).unwrap();
        let broken = format!("{}{to}{}", &text[..at], &text[at + from.len()..]);
        let error = file::parse(&broken).unwrap_err().to_string();
        assert!(error.contains(why), "{why}: {error}");
    }
}

#[test]
fn future_versions_are_refused_as_such() {
    let text = "(version: 7, name: \"x\", soul: Immortal(since: 3), mesh: Implicit)";
    assert_eq!(file::parse(text), Err(TextError::FutureVersion { found: 7 }));
    assert!(file::parse(text).unwrap_err().to_string().contains("version 7 is newer"));
    let far = bits(&rigged()).replacen("version: 2", "version: 5000000000", 1);
    assert_eq!(file::parse(&far), Err(TextError::FutureVersion { found: 5_000_000_000 }));
    let none = bits(&rigged()).replacen("version: 2", "version: 0", 1);
    assert!(file::parse(&none).unwrap_err().to_string().starts_with("version: 0 is not a version"));
    assert_eq!(FORMAT_VERSION, 2);
}

#[test]
fn errors_name_line_and_column() {
    let text = bits(&rigged());
    for (from, to, message) in [
        ("    tendons: (\n", "    tendrils: (\n", "tendrils"),
        ("stiffness: 20.0", "stiffness: 20.0.0", ""),
        ("        (0.0, 0.0),\n", "        (0.0, zero),\n", ""),
    ] {
        let broken = text.replacen(from, to, 1);
        assert_ne!(broken, text, "{from:?} is not in the text");
        let line = 1 + broken.lines().zip(text.lines()).position(|(a, b)| a != b).expect("a changed line");
        match file::parse(&broken) {
            Err(TextError::Syntax { line: at, message: found, .. }) => {
                assert_eq!(at, line, "{found}");
                assert!(found.contains(message), "{found}");
            }
            other => panic!("{other:?}"),
        }
    }
    for (text, line) in [("", 1), ("(", 1), ("hello", 1), ("(version: 1,\n name: 3)", 2)] {
        match file::parse(text) {
            Err(TextError::Syntax { line: at, .. }) => assert_eq!(at, line, "{text:?}"),
            other => panic!("{text:?}: {other:?}"),
        }
    }
}

#[test]
fn truncated_and_garbled_texts_are_errors_or_designs_never_panics() {
    let text = bits(&rigged());
    for end in (0..text.len() - 2).step_by(11) {
        assert!(file::parse(&text[..end]).is_err(), "the first {end} bytes passed");
    }
    let mut random = Random(3);
    for _ in 0..400 {
        let mut bytes = text.clone().into_bytes();
        for _ in 0..1 + random.below(3) {
            let at = random.below(bytes.len());
            bytes[at] = b"0123456789-.,()[]:aeN \n"[random.below(23)];
        }
        if let Ok(design) = file::parse(&String::from_utf8(bytes).expect("ASCII stays ASCII")) {
            design.validate().expect("what was read is valid");
        }
    }
}

type Spoil = fn(&mut Design);

/// Spoils a sound design and sees what is said of it.
fn refused(cases: &[(Spoil, &str)]) {
    rigged().validate().expect("the starting point is sound");
    for (spoil, message) in cases {
        let mut design = rigged();
        spoil(&mut design);
        let error = design.validate().expect_err(message).to_string();
        assert!(error.starts_with(message), "{error:?} instead of {message:?}");
    }
}

#[test]
fn rules_of_sewing_have_their_ranges() {
    refused(&[
        (|d| d.sewing.hole_to_seam_mm = -1.0, "sewing.hole_to_seam_mm: -1 is negative"),
        (|d| d.sewing.hole_to_hole_mm = f64::NAN, "sewing.hole_to_hole_mm: NaN is not a finite number"),
        (|d| d.sewing.most_holes = usize::MAX, "sewing.most_holes: 1.8446744073709552e19 is out of range: 0 to 10000"),
        (|d| d.sewing.turn_degrees = 181.0, "sewing.turn_degrees: 181 is out of range: 0 to 180 degrees"),
        (|d| d.sewing.turning_degrees = f64::INFINITY, "sewing.turning_degrees: inf is not a finite number"),
        (|d| d.sewing.beside_mm = 1e4, "sewing.beside_mm: 10000 is out of range: 0 to 1000 mm"),
        (|d| d.sewing.along_mm = 1e5, "sewing.along_mm: 100000 is out of range: 0 to 10000 mm"),
        (|d| d.sewing.lead_mm = -0.5, "sewing.lead_mm: -0.5 is negative"),
        (|d| d.sewing.housing_mm = 1e300, "sewing.housing_mm: 1e300 is out of range: 0 to 1000 mm"),
        (|d| d.sewing.between_housings_mm = -3.0, "sewing.between_housings_mm: -3 is negative"),
    ]);
}

#[test]
fn validation_says_what_and_where() {
    refused(SPOILT);
    let mut edge = rigged();
    edge.networks[0].tendons[0].routing = MaterialPoint::through([10, 9, 10]);
    edge.pins[0].at.weights = [1.0 + 5e-10, -5e-10, 5e-7];
    edge.validate().expect("there and back is legal, rounding too");
}

/// What is no design any more, and what is said of it.
const SPOILT: &[(Spoil, &str)] = &[
    (|d| d.pins[0].at.triangle = 99, "pins[0].at.triangle: 99 is out of range, the mesh has 48 triangles"),
    (|d| d.pins[0].at.weights = [0.5, 0.6, 0.0], "pins[0].at.weights: the weights sum to 1.1, not to 1"),
    (|d| d.pins[0].at.weights = [-0.1, 0.6, 0.5], "pins[0].at.weights[0]: -0.1 is negative"),
    (|d| d.pins[0].stiffness = 0.0, "pins[0].stiffness: 0 is not greater than zero"),
    (|d| d.pins[0].position = Some([f64::NAN, 0.0]), "pins[0].position: NaN is not a finite number"),
    (|d| d.mesh.nodes[4][1] = f64::INFINITY, "mesh.nodes[4]: inf is not a finite number"),
    (|d| d.mesh.triangles[2][1] = 77, "mesh.triangles[2]: 77 is out of range, the mesh has 35 nodes"),
    (|d| d.mesh.triangles[2].swap(0, 1), "mesh.triangles[2]: area -200 mm^2"),
    (|d| d.mesh.triangles[2] = [0, 0, 1], "mesh.triangles[2]: area 0 mm^2"),
    (|d| d.mesh.nodes.push([1.0, 1.0]), "mesh: node 35 belongs to no triangle"),
    (|d| drop(d.mesh.triangles.drain(12..24)), "mesh: the mesh falls into 2 pieces"),
    (|d| d.mesh.triangles.clear(), "mesh.triangles: has 0 triangles, needs at least 1"),
    (|d| d.outline.outer.reverse(), "outline.outer: area -9600 mm^2"),
    (|d| d.outline.outer.truncate(2), "outline.outer: has 2 points, needs at least 3"),
    (|d| d.outline.holes = vec![vec![[1., 1.], [2., 1.], [2., 2.]]], "outline.holes[0]: area 0.5 mm^2"),
    (|d| d.material = NeoHookean { mu: 0.0, kappa: 1.0 }.into(), "material.mu: 0 is not greater than zero"),
    (|d| d.material = NeoHookean { mu: 1.0, kappa: -1.0 }.into(), "material.kappa: -1 is negative"),
    (|d| d.fibers.max_contraction = 1.5, "fibers.max_contraction: 1.5 is greater than 1"),
    (|d| d.fibers.set = FiberSet::Routings(vec![vec![1]]), "fibers.set[0]: has 1 nodes, needs at least 2"),
    (|d| d.tendons.epsilon_mm = f64::NAN, "tendons.epsilon_mm: NaN is not a finite number"),
    (
        |d| d.networks[0].tendons[1].routing = MaterialPoint::through([10, 9, 9]),
        "networks[0].tendons[1].routing[2]: node 9 stands twice",
    ),
    (
        |d| d.networks[0].tendons[1].routing = MaterialPoint::through([10, 35]),
        "networks[0].tendons[1].routing[1]: 35 is out of range",
    ),
    (
        |d| d.networks[0].tendons[1].routing = MaterialPoint::through([9, 8]),
        "networks[0].tendons[1].routing: starts at node 9, the",
    ),
    (|d| d.networks[1].tendons.clear(), "networks[1].tendons: has 0 tendons, needs at least 1"),
    (|d| d.networks[1].tendons[0].ratio = 0.0, "networks[1].tendons[0].ratio: 0 is not greater than zero"),
    (|d| d.networks.truncate(1), "keyframes[0].activations_mm: has 2 entries for 1 networks"),
    (|d| d.keyframes[1].time_s = 9.0, "keyframes[2].time_s: 1.51 s does not come after 9 s"),
    (|d| d.keyframes[1].time_s = -1.0, "keyframes[1].time_s: -1 is negative"),
    (|d| d.keyframes[1].activations_mm[1] = f64::NAN, "keyframes[1].activations_mm[1]: NaN is not a finite"),
    (|d| d.keyframes[1].pose = Some("jump".into()), "keyframes[1].pose: there is no pose named \"jump\""),
    (|d| d.poses.push(d.poses[0].clone()), "poses[1].name: there is another pose named \"lean\""),
    (|d| d.poses[0].name = " ".into(), "poses[0].name: is empty"),
    (|d| d.name = "line\nbreak".into(), "name: has a character that cannot be shown (U+000A)"),
    (|d| d.networks[0].name = "\u{1b}[2J".into(), "networks[0].name: has a character that cannot be shown (U+001B)"),
    (|d| d.poses[0].name = "x".repeat(65_536), "poses[0].name: has 65536 characters, at most 255 are read"),
    (|d| d.keyframes[2].time_s = 1e9, "keyframes[2].time_s: 1e9 is out of range: 0 to 36000 s"),
    (|d| d.keyframes[1].activations_mm[0] = -1e5, "keyframes[1].activations_mm[0]: -100000 is out of range: -1000 to"),
    (|d| d.poses[0].targets[0].to = [1e300, 0.0], "poses[0].targets[0].to: 1e300 is out of range: -1000000 to"),
    (|d| d.outline.outer[0][0] = -1e12, "outline.outer[0]: -1e12 is out of range: -1000000 to 1000000 mm"),
    (|d| d.controller.speed_rpm = u32::MAX, "controller.speed_rpm: 4.294967295e9 is out of range: 1 to 30000 rpm"),
    (|d| d.fabrication.seam_allowance_mm = 1e300, "fabrication.seam_allowance_mm: 1e300 is out of range: 0 to 1000 mm"),
    (|d| d.material = NeoHookean { mu: 0.4, kappa: 1e5 }.into(), "material.kappa: 250000 times mu is more than 10000"),
    (|d| d.poses[0].targets[0].weight = -1.0, "poses[0].targets[0].weight: -1 is negative"),
    (|d| d.stiffness_map = Some(vec![1.0]), "stiffness_map: has 1 entries for 48 triangles"),
    (|d| d.texture_box = Some([[0.0, 5.0], [9.0, 5.0]]), "texture_box: 0 is not greater than zero"),
    (|d| d.texture_box = Some([[0.0, f64::NAN], [9.0, 5.0]]), "texture_box[0]: NaN is not a finite number"),
    (
        |d| d.drawing = Some(Drawing { tracks: vec![vec![[0.0; 2]]], ..Drawing::default() }),
        "drawing.tracks[0]: a track needs at least two points",
    ),
    (|d| d.fabrication.spool_radius_mm = 0.0, "fabrication.spool_radius_mm: 0 is not greater than zero"),
    (|d| d.controller.encoder_lines = 0, "controller.encoder_lines: 0 is not greater than zero"),
];

#[test]
fn files_are_replaced_whole_or_not_at_all() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.plush");
    let design = rigged();
    file::write(&path, &design).expect("written");
    assert_eq!(file::read(&path).expect("read"), design);

    let mut bad = design.clone();
    bad.pins[0].stiffness = f64::NAN;
    assert!(file::write(&path, &bad).unwrap_err().to_string().contains("pins[0].stiffness"));
    assert_eq!(file::read(&path).expect("the old content"), design);
    assert!(file::write(&folder.path().join("no/such/folder.plush"), &design).is_err());
    assert!(file::write(folder.path(), &design).is_err(), "a folder is not a file");
    let names: Vec<_> = fs::read_dir(folder.path()).expect("a folder").flatten().map(|e| e.file_name()).collect();
    assert_eq!(names, ["a.plush"], "nothing else is left behind");

    fs::write(&path, b"(version: 1,\n name: \"\xff\")").expect("written");
    let error = file::read(&path).unwrap_err().to_string();
    assert!(error.ends_with("a.plush: line 2, column 9: not UTF-8 text"), "{error}");
    assert!(file::read(&folder.path().join("none.plush")).unwrap_err().to_string().starts_with("cannot read"));
}

#[cfg(unix)]
#[test]
fn links_and_permissions_survive_saving() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().expect("a folder");
    let (real, link) = (folder.path().join("real.plush"), folder.path().join("link.plush"));
    file::write(&real, &rigged()).expect("written");
    assert_ne!(fs::metadata(&real).expect("a file").permissions().mode() & 0o044, 0, "others may read a new file");
    fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).expect("set");
    symlink(&real, &link).expect("a link");
    let mut design = rigged();
    design.name = "through the link".into();
    file::write(&link, &design).expect("written");
    assert!(fs::symlink_metadata(&link).expect("a link").is_symlink());
    assert_eq!(file::read(&real).expect("read").name, "through the link");
    assert_eq!(fs::metadata(&real).expect("a file").permissions().mode() & 0o777, 0o640);
}

#[test]
fn edits_carry_along_what_refers_to_them() {
    let mut design = rigged();
    let network = design.networks[0].clone();
    assert_eq!(edit::accept_network(&mut design, network), Ok(2));
    assert_eq!(design.networks[2].name, "left 2");
    assert_eq!(design.keyframes[1].activations_mm, [10.0, 4.0, 0.0]);
    edit::remove_network(&mut design, 0).expect("removed");
    assert_eq!(design.keyframes[1].activations_mm, [4.0, 0.0]);

    let frame =
        Keyframe { time_s: 0.5, activations_mm: vec![1.0, 2.0], pose: Some("lean".into()), easing: Easing::Hold };
    assert_eq!(edit::set_keyframe(&mut design, frame.clone()), Ok(1));
    assert_eq!(edit::set_keyframe(&mut design, frame), Ok(1), "the same time is replaced");
    assert_eq!(design.keyframes.len(), 4);
    assert_eq!(edit::move_keyframe(&mut design, 1, 1.0), Err(EditError::TimeTaken(1.0)));
    assert_eq!(edit::move_keyframe(&mut design, 1, 1.25), Ok(2), "past its neighbour");

    assert_eq!(edit::duplicate_pose(&mut design, 0), Ok(1));
    assert_eq!(design.poses[1].name, "lean 2");
    let taken = EditError::NameTaken { what: "pose", name: "lean 2".into() };
    assert_eq!(edit::rename_pose(&mut design, 0, " lean 2 "), Err(taken));
    edit::rename_pose(&mut design, 0, "bow").expect("renamed");
    assert_eq!(design.keyframes[2].pose.as_deref(), Some("bow"));
    edit::remove_pose(&mut design, 0).expect("removed");
    assert_eq!(design.keyframes[2].pose, None);
    let missing = EditError::Missing { what: "pose", index: 4, len: 1 };
    assert_eq!(edit::remove_pose(&mut design, 4), Err(missing));
    design.validate().expect("sound");
}
