//! Timelines from the command line: keyframes moved, stretched, copied, eased and fitted; films of them.

use super::support::{bar, network};
use plushwright::design::{Design, Easing, Keyframe, file};
use plushwright::motion::{Plan, TooFast};
use std::path::Path;
use std::process::{Command, Output};

/// A bar with a winch, keyframes at these times.
fn animated(times_s: &[f64]) -> Design {
    let mut design = bar();
    design.networks.push(network());
    let key = |(k, &time_s): (usize, &f64)| Keyframe {
        time_s,
        activations_mm: vec![4.0 * (k % 2) as f64],
        pose: None,
        easing: Easing::Smooth,
    };
    design.keyframes = times_s.iter().enumerate().map(key).collect();
    design
}

fn plushwright(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plushwright")).args(args).current_dir(folder).output().unwrap()
}

#[track_caller]
fn run(folder: &Path, args: &[&str]) -> String {
    let output = plushwright(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn times(path: &Path) -> Vec<f64> {
    file::read(path).unwrap().keyframes.iter().map(|k| (k.time_s * 1e6).round() / 1e6).collect()
}

#[test]
fn keyframes_are_moved_stretched_copied_eased_and_fitted() {
    let folder = tempfile::tempdir().unwrap();
    let (f, path) = (folder.path(), folder.path().join("bar.plush"));
    file::write(&path, &animated(&[0.0, 1.0, 2.0])).unwrap();
    run(f, &["retime", "bar.plush", "--keys", "2,3", "--by", "0.5"]);
    assert_eq!(times(&path), [0.0, 1.5, 2.5]);
    run(f, &["retime", "bar.plush", "--keys", "2,3", "--stretch", "2"]);
    assert_eq!(times(&path), [0.0, 1.5, 3.5]);
    run(
        f,
        &["retime", "bar.plush", "--keys", "1,2", "--copy-to", "5", "--ease", "slow", "--out", "0.7", "--into", "0.2"],
    );
    assert_eq!(times(&path), [0.0, 1.5, 3.5, 5.0, 6.5]);
    let slow = Easing::Slow { out: 0.7, into: 0.2 };
    let easings: Vec<bool> = file::read(&path).unwrap().keyframes.iter().map(|k| k.easing == slow).collect();
    assert_eq!(easings, [true, true, false, true, true]);
    // Too quick for any motor, and told; then as quick as they are.
    let told = run(f, &["retime", "bar.plush", "--keys", "5", "--by=-1.49", "--json"]);
    assert!(told.contains("too fast"), "{told}");
    assert!(Plan::of(&file::read(&path).unwrap(), TooFast::Refuse).is_err());
    let told = run(f, &["retime", "bar.plush", "--fit"]);
    assert!(!told.contains("too fast"), "{told}");
    assert!(Plan::of(&file::read(&path).unwrap(), TooFast::Refuse).is_ok());
    let before = std::fs::read(&path).unwrap();
    for wrong in
        [&["--keys", "9", "--by", "1"][..], &["--keys", "0", "--by", "1"], &["--stretch", "0"], &["--by", "-9"], &[]]
    {
        let output = plushwright(f, &[&["retime", "bar.plush"], wrong].concat());
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{wrong:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), 1);
    }
    assert_eq!(std::fs::read(&path).unwrap(), before);
}

#[test]
fn an_animation_becomes_a_page_and_numbered_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let (f, path) = (folder.path(), folder.path().join("bar.plush"));
    file::write(&path, &animated(&[0.0, 1.0])).unwrap();
    let small = ["--rate", "4", "--size", "96x48"];
    for _ in 0..2 {
        // The second time in the place of the first.
        run(f, &[&["render", "bar.plush", "-o", "bar.html"], &small[..]].concat());
        run(f, &[&["render", "bar.plush", "--pictures", "-o", "frames"], &small[..]].concat());
    }
    let page = std::fs::read_to_string(f.join("bar.html")).unwrap();
    assert_eq!(page.matches("data:image/png").count(), 5);
    for k in 1..=5 {
        let picture = image::open(f.join(format!("frames/{k:04}.png"))).unwrap();
        assert_eq!((picture.width(), picture.height()), (96, 48));
    }
    // What is not ours stays.
    std::fs::write(f.join("frames/mine.txt"), "mine").unwrap();
    std::fs::write(f.join("mine.html"), "<p>mine").unwrap();
    for to in [&["-o", "mine.html"][..], &["--pictures", "-o", "frames"]] {
        let output = plushwright(f, &[&["render", "bar.plush"], to, &small[..]].concat());
        assert!(!output.status.success(), "{to:?}");
    }
    assert_eq!(std::fs::read_to_string(f.join("mine.html")).unwrap(), "<p>mine");
    assert_eq!(std::fs::read_to_string(f.join("frames/mine.txt")).unwrap(), "mine");
}
