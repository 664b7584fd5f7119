//! Networks that are switched off: as if they were not there, but in their place.

use crate::support::rigged;
use plushwright::design::{Design, file};
use plushwright::engine::{Setpoint, solve_once};
use plushwright::fabrication::{Options, blueprint};
use plushwright::operations::{Context, check, key, rig};
use std::sync::atomic::AtomicBool;

static GO: AtomicBool = AtomicBool::new(false);

/// With the first of two networks switched off, and the same design without it.
fn muted() -> [Design; 2] {
    let mut design = rigged();
    design.tendons.friction = 0.1;
    let mut without = design.clone();
    design.networks[0].muted = true;
    without.networks.remove(0);
    for keyframe in &mut without.keyframes {
        keyframe.activations_mm.remove(0);
    }
    [design, without]
}

#[test]
fn poses_and_figures_are_those_without_it_bit_for_bit() {
    let [design, without] = muted();
    for setpoint in [
        |_: &Design| Setpoint::Activations(vec![10.0, 4.0]),
        |design: &Design| Setpoint::Targets(design.poses[0].targets.clone()),
    ] {
        let shapes = |design: &Design, setpoint: Setpoint| {
            let outcome = solve_once(design, setpoint, [true, true], &GO);
            [outcome.idealized.unwrap(), outcome.realizable.unwrap()]
        };
        let of_without = match setpoint(&without) {
            Setpoint::Activations(_) => Setpoint::Activations(vec![4.0]),
            targets => targets,
        };
        let (with, alone) = (shapes(&design, setpoint(&design)), shapes(&without, of_without));
        for (with, alone) in with.iter().zip(&alone) {
            assert_eq!(with.nodes, alone.nodes);
            assert_eq!((with.activations_mm[0], with.activations_mm[1]), (0.0, alone.activations_mm[0]));
            assert_eq!(with.tendon_tensions, [&[0.0, 0.0], &alone.tendon_tensions[..]].concat());
        }
    }
    let [figures, alone] =
        [&design, &without].map(|design| check::run(design, &check::Options::default(), &Context::new(&GO)).unwrap());
    assert_eq!((figures.winches, figures.tendons), (1, 1));
    assert_eq!((&figures.switched_off[..], alone.switched_off.len()), (&["left".to_owned()][..], 0));
    let errors = |figures: &check::Figures| {
        let pose = &figures.poses[0];
        (pose.error_realizable, pose.error_realizable_friction, pose.error_realizable_1mm_off)
    };
    assert_eq!(errors(&figures), errors(&alone));
    // Winches keep their numbers in what is told of them.
    let told = |figures: &check::Figures| figures.sewing.iter().map(|broken| broken.to_string()).collect::<Vec<_>>();
    assert_eq!(told(&figures), told(&alone));
    let numbers = serde_json::to_value(&figures.sewing).unwrap();
    assert!(numbers.as_array().unwrap().iter().all(|broken| broken["winch"] == 2), "{numbers}");
}

#[test]
fn the_blueprint_leaves_it_out_and_says_so() {
    let [design, without] = muted();
    let [(files, manifest), (plain, _)] =
        [&design, &without].map(|design| blueprint(design, &Options::default()).unwrap());
    assert!(
        manifest.remarks.iter().any(|remark| *remark == "Switched off and left out: left."),
        "{:?}",
        manifest.remarks
    );
    for (file, plain) in files.iter().zip(&plain) {
        let told = ["manifest.json", "README.txt", "assembly.html", "assembly.pdf"].contains(&file.name.as_str());
        assert!(file.name == plain.name && (told || file.bytes == plain.bytes), "{}", file.name);
    }
    let mut none = design.clone();
    none.networks[1].muted = true;
    assert!(blueprint(&none, &Options::default()).is_err());
}

#[test]
fn files_without_it_are_as_before_and_those_with_it_come_back() {
    let plain = rigged();
    let text = file::to_text(&plain).unwrap();
    assert!(!text.contains("muted") && !text.contains("color") && !text.contains("torque"));
    let mut design = plain.clone();
    design.networks[0].muted = true;
    design.networks[1].color = Some([200, 10, 40]);
    design.controller.torque_nmm = 80.0;
    let text = file::to_text(&design).unwrap();
    assert!(text.contains("muted: true") && text.contains("color: Some((200, 10, 40))"), "{text}");
    assert_eq!(file::parse(&text).unwrap(), design);
    assert!(text.contains("version: 2"));
}

#[test]
fn its_keys_stay_and_a_rig_goes_round_it() {
    let [mut design, _] = muted();
    let before = design.keyframes[1].activations_mm[0];
    assert!(before > 0.0);
    let options = key::Options { pose: Some("lean".into()), time_s: 1.0, ..key::Options::default() };
    key::run(&mut design, &options, &Context::new(&GO)).unwrap();
    assert_eq!(design.keyframes[1].activations_mm[0], before);
    design.keyframes.clear();
    let options = rig::Options {
        max_winches: 3,
        method: rig::Method::Algorithm2,
        tendons: "1".parse().unwrap(),
        rules: false,
        ..rig::Options::default()
    };
    rig::run(&mut design, &options, &mut Context::new(&GO)).unwrap();
    design.validate().unwrap();
    let count = design.networks.len();
    assert!(design.networks[0].muted && design.networks[0].name == "left", "{count}");
    assert!(design.keyframes.len() == 3 && design.keyframes[1].activations_mm[1..].iter().any(|mm| *mm > 0.0));
    assert!(design.keyframes.iter().all(|key| key.activations_mm.len() == count && key.activations_mm[0] == 0.0));
}

#[test]
fn what_is_refused_says_which_winch_and_that_all_are_off() {
    let mut design = rigged();
    design.networks[1].tendons[0].slack_mm = 3.5;
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    file::write(&f.join("a.plush"), &design).unwrap();
    let before = std::fs::read(f.join("a.plush")).unwrap();
    let network = |args: &[&str]| crate::files::run(f, &[&["network"][..], args].concat());
    for (args, told) in [
        (&["remove", "a.plush", "--winch", "1", "--tendon", "1", "--hole", "0"][..], "hole 0 is the winch itself"),
        (&["reorder", "a.plush", "--winch", "1", "--to", "9"], "there is no network 9, there are 2"),
        (&["add-hole", "a.plush", "--winch", "1", "--tendon", "1", "--piece", "9", "--at", "10,10"], "no piece 9"),
    ] {
        let output = network(args);
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && words.contains(told), "{args:?}: {words}");
        assert_eq!(std::fs::read(f.join("a.plush")).unwrap(), before);
    }
    let listed = network(&["list", "a.plush"]).stdout;
    assert!(String::from_utf8_lossy(&listed).contains(", slack 3.5 mm"));
    for winch in ["left", "right"] {
        crate::files::succeed(f, &["network", "mute", "a.plush", "--winch", winch]);
    }
    for args in [&["export", "a.plush", "-o", "out"][..], &["play", "a.plush", "--port", "simulated"]] {
        let output = crate::files::run(f, args);
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && words.contains("switched off") && words.contains("unmute"), "{words}");
    }
}
