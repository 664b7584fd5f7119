//! Programs for motor controllers, read back and run by others: a compiler, an interpreter, a parser, a drive written apart from the tool's own.

use crate::support::rigged;
use plushwright::design::{Design, Easing, Keyframe, Material, bundled};
use plushwright::engine::{Setpoint, solve_once};
use plushwright::fabrication::{Options, Remark, blueprint};
use plushwright::live::{Order, Remote, Status};
use plushwright::motion::families::{bus, sdo};
use plushwright::motion::{Framing, Plan, TooFast, counts_per_mm, hex};
use plushwright::operations::{Context, play};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// All files of a blueprint by name.
fn files(design: &Design) -> BTreeMap<String, Vec<u8>> {
    let options = Options { too_fast: TooFast::Stretch, ..Options::default() };
    let (files, _) = blueprint(design, &options).expect("a blueprint");
    files.into_iter().map(|file| (file.name, file.bytes)).collect()
}

fn text(files: &BTreeMap<String, Vec<u8>>, name: &str) -> String {
    String::from_utf8(files.get(name).unwrap_or_else(|| panic!("no {name}")).clone()).expect("text")
}

/// Times and lengths of `tracks.csv`.
fn rows(files: &BTreeMap<String, Vec<u8>>) -> Vec<(f64, Vec<f64>)> {
    let csv = text(files, "tracks.csv");
    let row = |line: &str| {
        let figures: Vec<f64> = line.split(',').map(|field| field.parse().expect("a figure")).collect();
        (figures[0], figures[1..].iter().step_by(2).copied().collect())
    };
    csv.lines().skip(4).map(row).collect()
}

/// The six designs, with spools that a servo's half turn winds.
fn for_servos() -> impl Iterator<Item = Design> {
    bundled::ALL.iter().map(|bundled| {
        let mut design = bundled.design().expect("a sound design");
        design.fabrication.spool_radius_mm = 20.0;
        design
    })
}

#[test]
fn a_motion_beyond_a_servo_is_refused_with_the_spool_that_would_do() {
    let mut design = rigged();
    design.keyframes[1].activations_mm[0] = 40.0;
    let options = Options { too_fast: TooFast::Stretch, ..Options::default() };
    let (files, manifest) = blueprint(&design, &options).expect("a blueprint");
    assert!(!files.iter().any(|file| file.name.starts_with("controller-servo")));
    // 40 mm on a spool of 10 mm are 229 degrees; half a turn winds them on 12.8 mm.
    let told = |remark: &Remark| remark.contains("229 degrees") && remark.contains("12.8 mm radius");
    assert_eq!(manifest.remarks.iter().filter(|remark| told(remark)).count(), 1, "{:?}", manifest.remarks);
    let asked = Options { controllers: vec!["servo-arduino".into()], ..options };
    let refused = blueprint(&design, &asked).map(drop).expect_err("beyond").to_string();
    assert!(refused.contains("12.8 mm radius"), "{refused}");
    design.fabrication.spool_radius_mm = 12.8;
    let (files, _) = blueprint(&design, &asked).expect("now it fits");
    let names: Vec<&str> =
        files.iter().map(|f| f.name.as_str()).filter(|name| name.starts_with("controller")).collect();
    assert_eq!(names, ["controller-servo-arduino.ino"]);
    let unknown = Options { controllers: vec!["abacus".into()], ..asked };
    let refused = blueprint(&design, &unknown).map(drop).expect_err("unknown").to_string();
    assert!(refused.contains("abacus") && refused.contains("grbl"), "{refused}");
}

#[test]
fn a_motor_that_is_too_weak_is_told_or_refused_by_the_name_of_its_winch() {
    let mut design = rigged();
    design.controller.torque_nmm = 0.01;
    let refused = blueprint(&design, &Options::default()).map(drop).expect_err("too weak").to_string();
    assert!(refused.contains("winch \"") && refused.contains("controller.torque_nmm"), "{refused}");
    // Nor is it played live, by the command line or from the window; winding by hand is free.
    let go = AtomicBool::new(false);
    let live = play::Options::default();
    let unplayed = |design: &Design| play::run(design, &live, &Context::new(&go), &mut |_| ()).map(drop);
    assert_eq!(unplayed(&design).expect_err("too weak").to_string(), refused);
    let remote = play::remote(&design, &live, || ()).expect("a line");
    remote.order(Order::SetZero);
    wait_for(&remote, |status| matches!(status, Status::Ready(_)));
    remote.order(Order::Play);
    let ended = wait_for(&remote, |status| matches!(status, Status::Ended { .. }));
    assert_eq!(ended, Status::Ended { why: format!("{refused}; all motors are switched off"), wanted: false });
    design.controller.torque_nmm = 1e6;
    unplayed(&design).expect("strong enough");
    let (_, manifest) = blueprint(&design, &Options::default()).expect("strong enough");
    assert!(!manifest.remarks.iter().any(|remark| remark.contains("controller.torque_nmm")));
    // The limit that is only assumed does not refuse what a stronger motor may do.
    let mut stiff = rigged();
    let values: Vec<f64> = stiff.material.values().iter().map(|value| 100.0 * value).collect();
    stiff.material = Material::new(stiff.material.kind(), &values);
    stiff.tendons.stiffness *= 100.0;
    let told = |design: &Design| {
        let (_, manifest) = blueprint(design, &Options::default()).expect("a blueprint");
        manifest.remarks.iter().filter(|remark| remark.starts_with("Assumed of the motors: winch")).count()
    };
    assert_eq!(told(&stiff), 1);
}

fn wait_for(remote: &Remote, is: impl Fn(&Status) -> bool) -> Status {
    loop {
        remote.seen();
        let status = remote.status();
        if is(&status) {
            return status;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// When the pulse of a channel ends, of 4096 parts of 20 ms, at given times, ms, of a sketch that is sent `setup` and `motion` at 100 and 1000.
fn pulses(run: &mut Command, times_ms: &[u64]) -> Vec<(u64, Vec<f64>)> {
    let mut child = run.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("it runs");
    let mut script = String::from("100 setup\n1000 motion\n");
    times_ms.iter().for_each(|ms| script += &format!("{}\n", 1000 + ms));
    child.stdin.take().expect("piped").write_all(script.as_bytes()).expect("written");
    let output = child.wait_with_output().expect("it ends");
    let told = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success() && told.contains("ok"), "{told}");
    let line = |line: &str| {
        let mut figures = line.strip_prefix('@')?.split(' ').map(|v| v.parse::<f64>().expect("a figure"));
        Some(((figures.next()? - 1000.0).max(0.0) as u64, figures.map(|off| off * 20_000.0 / 4096.0).collect()))
    };
    told.lines().filter_map(line).skip(2).collect()
}

/// Whether pulses are those of the track, to the step of the board, the millisecond of the clock and the look of the sketch.
fn follow_the_track(design: &Design, files: &BTreeMap<String, Vec<u8>>, told: &[(u64, Vec<f64>)]) {
    let (rows, us_per_mm) = (rows(files), 2000.0 / 180.0 * (1.0 / design.fabrication.spool_radius_mm).to_degrees());
    assert!(told.len() > 5);
    for (ms, pulses) in told {
        let time_s = rows[0].0 + *ms as f64 / 1e3;
        let next = rows.partition_point(|row| row.0 <= time_s).clamp(1, rows.len() - 1);
        let (before, after) = (&rows[next - 1], &rows[next]);
        let part = ((time_s - before.0) / (after.0 - before.0)).clamp(0.0, 1.0);
        for (winch, pulse) in pulses.iter().enumerate() {
            let (a, b) = (before.1[winch], after.1[winch]);
            let wanted = 500.0 + us_per_mm * (a + (b - a) * part);
            // 7 ms: the sketch looks every 5.
            let slack = 4.0 + us_per_mm * 0.007 * (b - a).abs() / (after.0 - before.0) * 1.5;
            assert!((pulse - wanted).abs() <= slack, "{} at {ms} ms: {pulse} instead of {wanted} us", design.name);
        }
    }
}

#[test]
fn the_sketches_compile_and_play_the_track() {
    let sketch = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/support/sketch");
    let has = |program: &str| Command::new(program).arg("--version").output().is_ok_and(|o| o.status.success());
    let (compiles, interprets) = (has("g++"), has("python3"));
    for design in for_servos() {
        let files = files(&design);
        let end_ms = (1e3 * rows(&files).last().expect("rows").0) as u64;
        let times: Vec<u64> = (1..20).map(|k| k * end_ms / 19).collect();
        let folder = tempfile::tempdir().expect("a folder");
        if compiles {
            std::fs::write(folder.path().join("sketch.ino"), &files["controller-servo-arduino.ino"]).expect("written");
            let built = Command::new("g++")
                .args(["-std=c++17", "-Wall", "-Wextra", "-Werror", "-x", "c++", "-O0", "-o"])
                .arg(folder.path().join("run"))
                .args([sketch.join("run.cpp").as_path(), Path::new("-I")])
                .arg(&sketch)
                .arg("-I")
                .arg(folder.path())
                .output()
                .expect("g++ runs");
            assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
            let told = pulses(&mut Command::new(folder.path().join("run")), &times);
            follow_the_track(&design, &files, &told);
        }
        if interprets {
            let path = folder.path().join("main.py");
            std::fs::write(&path, &files["controller-servo-micropython.py"]).expect("written");
            let told = pulses(Command::new("python3").arg(sketch.join("run.py")).arg(&path), &times);
            follow_the_track(&design, &files, &told);
        }
        if !(compiles && interprets) {
            println!("g++: {compiles}, python3: {interprets}; what is missing was not tried");
        }
    }
}

#[test]
fn another_parser_reads_the_g_code_and_its_moves_are_the_track() {
    for bundled in bundled::ALL {
        let design = bundled.design().expect("a sound design");
        let files = files(&design);
        let Some(motion) = files.get("controller-grbl-motion.gcode") else {
            assert!(design.networks.len() > 6, "{}", bundled.name);
            continue;
        };
        let motion = String::from_utf8(motion.clone()).expect("text");
        let rows = rows(&files);
        let codes: Vec<gcode::GCode> = gcode::parse(&motion).collect();
        let moves: Vec<&gcode::GCode> = codes.iter().filter(|code| code.major_number() == 1).collect();
        assert_eq!(moves.len(), rows.len() - 1);
        for (code, pair) in moves.iter().zip(rows.windows(2)) {
            for (axis, length) in ['X', 'Y', 'Z', 'A', 'B', 'C'].into_iter().zip(&pair[1].1) {
                assert!((f64::from(code.value_for(axis).expect("an axis")) - length).abs() < 1e-3);
            }
            let seconds = 60.0 / f64::from(code.value_for('F').expect("a feed"));
            assert!((seconds / (pair[1].0 - pair[0].0) - 1.0).abs() < 1e-4);
        }
        for part in ["setup", "motion", "stop"] {
            let program = text(&files, &format!("controller-grbl-{part}.gcode"));
            assert!(program.lines().all(|line| line.len() <= 80 || line.starts_with('(')), "GRBL takes 80 letters");
            assert_eq!(program.contains("G10"), part == "setup", "zero is set once");
        }
    }
}

/// Counts of every drive of the classic family over time while the motion is played: a trapezoid of speed with SP, AC and DEC, planned anew at every
/// M. Written apart from the tool's own, in steps of a tenth of a millisecond; a sample every 50 ms.
fn driven(motion: &str, times_s: &[f64], nodes: usize, resolution: f64) -> Vec<(f64, Vec<f64>)> {
    const DT: f64 = 1e-4;
    #[derive(Clone, Default)]
    struct Own {
        loaded: [f64; 4],
        plan: [f64; 4],
        x: f64,
        v: f64,
    }
    let mut drives = vec![Own::default(); nodes];
    let (mut samples, mut step, mut time_s) = (Vec::new(), 0, times_s[0]);
    let commands = stored(motion);
    let mut rest = commands.as_slice();
    let last = times_s[times_s.len() - 1] + 1.0;
    while time_s < last {
        // A step ends with the start of its last node.
        while !rest.is_empty() && step < times_s.len() && times_s[step] <= time_s + 1e-9 {
            let ((node, name, value), tail) = (&rest[0], &rest[1..]);
            let own = &mut drives[node - 1];
            let figure = value.unwrap_or(0.0);
            match name.as_str() {
                "SP" => own.loaded[0] = figure / 60.0 * resolution,
                "AC" => own.loaded[1] = figure * resolution,
                "DEC" => own.loaded[2] = figure * resolution,
                "LA" => own.loaded[3] = figure,
                "M" => own.plan = own.loaded,
                _ => {}
            }
            step += usize::from(name == "M" && *node == nodes);
            rest = tail;
        }
        for Own { plan: [speed, up, down, target], x, v, .. } in &mut drives {
            let way = *target - *x;
            let want = way.signum() * speed.min((2.0 * *down * way.abs()).sqrt()).min(way.abs() / DT);
            let most = DT * if want * *v >= 0.0 && want.abs() > v.abs() { *up } else { *down };
            *v += (want - *v).clamp(-most, most);
            *x += *v * DT;
        }
        time_s += DT;
        if (time_s / 0.05).floor() > ((time_s - DT) / 0.05).floor() {
            samples.push((time_s, drives.iter().map(|own| own.x).collect()));
        }
    }
    samples
}

#[test]
fn the_plushie_is_where_the_animation_has_it_when_drives_play_the_file() {
    for name in ["Pig", "Robot"] {
        let design = bundled::ALL.iter().find(|b| b.name == name).expect(name).design().expect("a sound design");
        let files = files(&design);
        let rows = rows(&files);
        let times: Vec<f64> = rows.iter().map(|row| row.0).collect();
        let motion = text(&files, "controller-ascii-motion.txt");
        let samples = driven(&motion, &times, design.networks.len(), 2048.0);
        let plan = Plan::of(&design, TooFast::Stretch).expect("a plan");
        let scale = counts_per_mm(&design);
        let shape = |activations: Vec<f64>| {
            let outcome =
                solve_once(&design, Setpoint::Activations(activations), [false, true], &AtomicBool::new(false));
            outcome.realizable.expect("solved").nodes
        };
        let every = samples.len() / 6;
        for (time_s, counts) in samples.iter().skip(every / 2).step_by(every) {
            let there = shape(counts.iter().map(|counts| counts / scale).collect());
            let wanted = shape(plan.at(*time_s));
            let squares = there.iter().zip(&wanted).map(|(a, b)| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2));
            let rms = (squares.sum::<f64>() / there.len() as f64).sqrt() / design.body_length_mm();
            assert!(rms < 0.005, "{name} at {time_s:.2} s: {:.2} % of the body", 100.0 * rms);
        }
    }
}

/// The frames of a binary program.
fn frames(framing: Framing, bytes: &[u8]) -> Vec<String> {
    let mut rest = bytes.to_vec();
    let frames: Vec<String> = std::iter::from_fn(|| framing.take_command(&mut rest)).collect();
    assert!(rest.is_empty(), "{} bytes are left", rest.len());
    frames
}

#[test]
fn binary_programs_are_whole_frames_that_end_where_the_track_does() {
    let files = files(&rigged());
    let last: Vec<i64> = rows(&files).last().expect("rows").1.iter().map(|mm| (mm * 1e6).round() as i64).collect();
    let csv = text(&files, "tracks.csv");
    let counts: Vec<i64> =
        csv.lines().last().expect("rows").split(',').skip(2).step_by(2).map(|v| v.parse().expect("counts")).collect();
    for part in ["setup", "motion", "stop"] {
        let frames = frames(Framing::Sdo, &files[&format!("controller-sdo-{part}.bin")]);
        let parsed: Vec<sdo::Frame> = frames.iter().map(|f| sdo::Frame::parse(f).expect("a frame")).collect();
        assert_eq!(parsed.iter().any(|f| f.object == sdo::HOMING), part == "setup", "zero is set once");
        if part == "motion" {
            for (winch, counts) in counts.iter().enumerate() {
                let own = |f: &&sdo::Frame| f.object == sdo::TARGET && usize::from(f.node) == winch + 1;
                assert_eq!(parsed.iter().rfind(own).expect("targets").value(), *counts);
            }
        }
        let packets = self::frames(Framing::Bus, &files[&format!("controller-bus-servo-{part}.bin")]);
        let parsed: Vec<bus::Packet> = packets.iter().map(|p| bus::Packet::parse(p).expect("a packet")).collect();
        let here = |p: &bus::Packet| p.data == [bus::TORQUE, bus::HERE];
        assert_eq!(parsed.iter().any(here), part == "setup", "zero is set once");
        if part == "motion" {
            for (winch, micrometres) in last.iter().enumerate() {
                let own = |p: &&bus::Packet| p.data[0] == bus::MOVE && usize::from(p.id) == winch + 1;
                let data = &parsed.iter().rfind(own).expect("moves").data;
                let mm = (bus::value(data[2], data[3]) - bus::REST) as f64 / 4096.0 * 20.0 * std::f64::consts::PI;
                assert!((mm - *micrometres as f64 / 1e6).abs() < 0.01, "{}", hex(data));
            }
        }
    }
}

/// A stored program as (node, command, argument).
fn stored(program: &str) -> Vec<(usize, String, Option<f64>)> {
    let command = |line: &str| {
        let node = line.find(|c: char| !c.is_ascii_digit()).expect("a command");
        let name = line[node..].trim_end_matches(|c: char| c.is_ascii_digit() || c == '-');
        (line[..node].parse().expect("a node"), name.to_owned(), line[node + name.len()..].parse().ok())
    };
    program.trim_end_matches('\r').split('\r').map(command).collect()
}

#[test]
fn stored_programs_last_as_long_as_the_track_and_end_where_it_does() {
    let mut design = rigged();
    design.controller.track_rate_hz = 30.0;
    let files = files(&design);
    let rows = rows(&files);
    let lasts = rows.last().expect("rows").0 - rows[0].0;
    let motion = stored(&text(&files, "controller-ascii-stored-motion.txt"));
    let script = |winch| text(&files, &format!("controller-v3-script-{winch}-motion.bas"));
    for winch in 0..2 {
        let own: Vec<_> = motion.iter().filter(|c| c.0 == winch + 1).collect();
        let names: Vec<&str> = own.iter().map(|c| c.1.as_str()).collect();
        assert_eq!(
            (names[..2].to_vec(), names[names.len() - 2..].to_vec()),
            (vec!["DIPROG", "PROGSEQ"], vec!["END", "ENPROG"])
        );
        let delays: f64 = own.iter().filter(|c| c.1 == "DELAY").filter_map(|c| c.2).sum();
        // The motion lasts 1.51 s, of a hundredth each.
        assert!((delays / 100.0 - lasts).abs() <= 0.005 + 1e-9, "{delays}");
        let calls: Vec<Vec<i64>> = script(winch + 1)
            .lines()
            .filter_map(|line| line.strip_prefix("Wind(")?.strip_suffix(')'))
            .map(|figures| figures.split(", ").map(|v| v.parse().expect("a figure")).collect())
            .collect();
        assert_eq!(calls.iter().map(|call| call[2]).sum::<i64>(), (1e3 * lasts).round() as i64);
        let ends = own.iter().rfind(|c| c.1 == "LA").and_then(|c| c.2);
        assert_eq!(ends, calls.last().map(|call| call[0] as f64));
    }
    assert!(!motion.iter().any(|c| c.1 == "HO") && !script(1).contains("6098"), "zero is set once");
}

/// Where a stored program has a winch at a time: its moves run evenly, one after the other; counts.
fn at_time(moves: &[(f64, f64)], time_s: f64) -> f64 {
    let (mut begin, mut from) = (0.0, 0.0);
    for &(to, lasts) in moves {
        if time_s <= begin + lasts {
            return from + (to - from) * (time_s - begin) / lasts;
        }
        (begin, from) = (begin + lasts, to);
    }
    from
}

#[test]
fn a_long_animation_is_stored_with_every_keyframe_or_left_out_by_name() {
    let waves = |times: usize| {
        let mut design = rigged();
        let [rest, pulled] = [&design.keyframes[0], &design.keyframes[1]].map(|key| key.activations_mm.clone());
        let key = |k: usize| Keyframe {
            time_s: 2.0 * k as f64,
            activations_mm: if k.is_multiple_of(2) { rest.clone() } else { pulled.clone() },
            pose: None,
            easing: Easing::Smooth,
        };
        design.keyframes = (0..=2 * times).map(key).collect();
        // A long rest in the middle takes no room.
        let middle = design.keyframes[2 * (times / 2)].time_s;
        design.keyframes.iter_mut().filter(|key| key.time_s > middle).for_each(|key| key.time_s += 100.0);
        design
    };
    let design = waves(8);
    let files = files(&design);
    let rows = rows(&files);
    let stored = stored(&text(&files, "controller-ascii-stored-motion.txt"));
    let script = |winch: usize| text(&files, &format!("controller-v3-script-{}-motion.bas", winch + 1));
    let scale = 4.0 * f64::from(design.controller.encoder_lines) * design.controller.gear_ratio
        / (2.0 * std::f64::consts::PI * design.fabrication.spool_radius_mm);
    for winch in 0..2 {
        let own = stored.iter().filter(|c| c.0 == winch + 1);
        let mut moves: Vec<(f64, f64)> = Vec::new();
        for (_, name, figure) in own {
            match (name.as_str(), figure) {
                ("LA", Some(to)) => moves.push((*to, 0.0)),
                ("DELAY", Some(units)) => moves.last_mut().expect("a move before").1 += units / 100.0,
                _ => {}
            }
        }
        let calls: Vec<(f64, f64)> = script(winch)
            .lines()
            .filter_map(|line| line.strip_prefix("Wind(")?.strip_suffix(')'))
            .map(|figures| figures.split(", ").map(|v| v.parse().expect("a figure")).collect::<Vec<f64>>())
            .map(|call| (call[0], call[2] / 1e3))
            .collect();
        for moves in [moves, calls] {
            assert!(moves.len() <= 200, "{}", moves.len());
            for (time_s, row) in &rows {
                let off = (at_time(&moves, *time_s) / scale - row[winch]).abs();
                assert!(off < 0.6, "{winch} at {time_s} s: {off} mm");
            }
        }
    }
    // Of so many waves each would be a stroke or two: that is another motion.
    let options = Options { too_fast: TooFast::Stretch, ..Options::default() };
    let (files, manifest) = blueprint(&waves(120), &options).expect("a blueprint");
    assert!(!files.iter().any(|file| file.name.contains("stored") || file.name.contains("v3-script")));
    let told = |name: &str| manifest.remarks.iter().any(|r| r.contains(name) && r.contains("no room for this motion"));
    assert!(told("ascii-stored") && told("v3-script"), "{:?}", manifest.remarks);
    let asked = Options { controllers: vec!["ascii-stored".into(), "ascii-stored".into()], ..options };
    let refused = blueprint(&waves(120), &asked).map(drop).expect_err("no room").to_string();
    assert!(refused.contains("make the animation shorter"), "{refused}");
    assert!(blueprint(&design, &asked).is_ok(), "named twice, written once");
}

#[test]
fn a_keyframe_beyond_the_cable_is_refused_and_one_beyond_the_reach_told() {
    let mut design = rigged();
    let options = Options { too_fast: TooFast::Stretch, ..Options::default() };
    // The shorter tendon of the left winch is 40 mm long.
    design.keyframes[1].activations_mm[0] = 40.5;
    let refused = blueprint(&design, &options).map(drop).expect_err("no cable").to_string();
    assert!(refused.contains("winds 40.5 mm on winch \"left\", which has 40.0 mm"), "{refused}");
    design.keyframes[1].activations_mm[0] = 39.5;
    design.keyframes[1].activations_mm[1] = 0.0;
    let (_, manifest) = blueprint(&design, &options).expect("a blueprint");
    let told = |what: &str| manifest.remarks.iter().any(|remark| remark.contains(what));
    assert!(told("\"left\" winds up to 39.5 mm") && told("\"right\" never winds"), "{:?}", manifest.remarks);
}
