//! Live drives against simulated controllers: timing, faults at every command, and what is left when the tool is gone.

use crate::support::rigged;
use plushwright::design::{Design, Easing, Keyframe, Network};
use plushwright::live::{
    End, Fault, FaultKind, LIMIT_TOLERANCE_MM, Link, LiveError, Motion, Order, Player, Remote, SimulatedLink,
    Simulation, Status,
};
use plushwright::motion::{Family, Machine, Plan, Stream, TooFast, Trajectory, families};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

static GO_ON: AtomicBool = AtomicBool::new(false);

/// Three winches that pull and let go once in `period_s`, each in its own measure.
fn waving(periods: usize, period_s: f64) -> Design {
    let mut design = rigged();
    let third = Network { name: "third".into(), ..design.networks[1].clone() };
    design.networks.push(third);
    let key = |k: usize| {
        let pulled = if k % 2 == 1 { [8.0, 5.0, 3.0] } else { [0.0; 3] };
        let (time_s, activations_mm) = (0.5 * period_s * k as f64, pulled.to_vec());
        Keyframe { time_s, activations_mm, pose: None, easing: Easing::Smooth }
    };
    design.keyframes = (0..=2 * periods).map(key).collect();
    design
}

/// The words of a family for a design, and the plan.
fn spoken(design: &Design, family: &Family) -> (Box<dyn Stream>, Plan) {
    let trajectory = Trajectory::of(design, TooFast::Refuse).expect("slow enough");
    let stream = (family.stream.expect("told by a host"))(&Machine::new(design, &trajectory)).expect("it fits");
    (stream, Plan::of(design, TooFast::Refuse).expect("slow enough"))
}

/// Units of a family's simulated positions for a mm of cable.
fn units_per_mm(stream: &dyn Stream, family: &Family) -> f64 {
    let machine = stream.machine();
    match family.name {
        "grbl" => 1.0,
        "bus-servo" => 4096.0 / machine.turn_mm(),
        "servo" => 2000.0 / 180.0 * machine.degrees(1.0),
        _ => machine.counts_per_mm,
    }
}

#[test]
fn ten_minutes_on_three_winches_keep_the_time_with_every_family() {
    let design = waving(300, 2.0);
    for family in families::streams() {
        let (stream, plan) = spoken(&design, family);
        let mut link = SimulatedLink::new(Simulation::of(family, 3));
        let mut player = Player::connect(&*stream, &mut link, &GO_ON).expect("found");
        let played = player.play(&plan, 0.02, &mut |_| ()).expect("played");
        drop(player);
        assert!((played.lasted_s - 600.0).abs() < 4.0 * played.slot_s + 1e-9, "{}: {}", family.name, played.lasted_s);
        assert!(played.late_s(0.95) < 0.02, "{}: {}", family.name, played.late_s(0.95));
        let scale = units_per_mm(&*stream, family);
        let (axes, farthest) = (link.simulation().axes(), link.simulation().farthest());
        for ((axis, farthest), most) in axes.iter().zip(farthest).zip([8.0, 5.0, 3.0]) {
            assert!(!axis.on && axis.position.abs() < 0.3 * scale, "{}: {axis:?}", family.name);
            let farthest = farthest / scale;
            // The largest acceleration is 6 times the way over the square of a second; between two steps a chord cuts a s^2 / 8 off.
            let cut = 6.0 * most * (3.0 * played.slot_s).powi(2) / 8.0;
            assert!((farthest - most).abs() < 0.3 + cut, "{}: {farthest} of {most} mm", family.name);
        }
    }
}

/// Plays with a fault; what came of it, and the line 10 s later.
fn with_fault(
    stream: &dyn Stream,
    plan: &Plan,
    family: &Family,
    fault: Fault,
) -> (Result<(), LiveError>, SimulatedLink) {
    let mut link = SimulatedLink::new(Simulation::of(family, 3).with_faults(vec![fault]));
    let outcome = Player::found(stream, &mut link, &GO_ON).and_then(|mut player| {
        player.set_zero()?;
        player.play(plan, 0.02, &mut |_| ()).map(drop)
    });
    link.pass(10.0);
    (outcome, link)
}

#[test]
fn every_fault_at_every_command_ends_with_motors_off_and_a_sentence() {
    let design = waving(1, 1.0);
    for family in families::streams() {
        let (stream, plan) = spoken(&design, family);
        let last = usize::MAX;
        let (outcome, link) = with_fault(&*stream, &plan, family, Fault { kind: FaultKind::NoReply, at: last });
        outcome.expect("no fault");
        let commands = link.simulation().commands();
        let scale = units_per_mm(&*stream, family);
        let kinds = [
            FaultKind::NoReply,
            FaultKind::Garbage,
            FaultKind::Error,
            FaultKind::Limit,
            FaultKind::Gone,
            FaultKind::Missing(2),
        ];
        for kind in kinds {
            for at in 1..=commands {
                let fault = Fault { kind, at };
                let (outcome, link) = with_fault(&*stream, &plan, family, fault);
                let what = format!("{} with {fault} of {commands}", family.name);
                if let Err(error) = &outcome {
                    told(&what, error);
                }
                let axes = link.simulation().axes();
                for (winch, (axis, most)) in axes.iter().zip([8.0, 5.0, 3.0]).enumerate() {
                    assert!(!axis.moving, "{what}: {axis:?}");
                    let farthest = link.simulation().farthest()[winch];
                    assert!(farthest <= (most + LIMIT_TOLERANCE_MM) * scale, "{what}: {farthest}");
                    // A line that is gone, and a controller that hears nothing, cannot be told: the sentence says so.
                    let heard = match (kind, stream.addressed(&stream.locate(0))) {
                        (FaultKind::Gone, _) | (FaultKind::Missing(_), None) => false,
                        (FaultKind::Missing(missing), Some(_)) => winch + 1 != missing,
                        _ => true,
                    };
                    let unsure = matches!(&outcome, Err(LiveError { end: End::Unconfirmed(_), .. }));
                    assert!(!axis.on || !heard || at == 1, "{what}: {axis:?} {outcome:?}");
                    assert!(!axis.on || unsure || outcome.is_err(), "{what}: {axis:?}");
                }
            }
        }
    }
}

/// An error is one sentence, and says of motors that may be on that they may.
fn told(what: &str, error: &LiveError) {
    let text = error.to_string();
    assert!(text.len() > 20 && !text.contains('\n') && !text.contains('\0'), "{what}: {text:?}");
    match &error.end {
        End::Off => {}
        End::SwitchedOff => assert!(text.contains("all motors are switched off"), "{what}: {text}"),
        End::Unconfirmed(who) => {
            assert!(text.contains(&who[0]) && text.contains("switch the power off"), "{what}: {text}")
        }
    }
}

#[test]
fn a_winch_beyond_its_travel_is_refused_before_anything_moves() {
    let design = waving(1, 2.0);
    for family in families::streams().filter(|family| family.name != "servo") {
        // A motion that winds farther was played, and broken off at its end.
        let mut farther = design.clone();
        farther.keyframes[1].activations_mm = vec![8.0, 5.0, 20.0];
        farther.keyframes.truncate(2);
        let (stream, _) = spoken(&farther, family);
        let mut link = SimulatedLink::new(Simulation::of(family, 3));
        let mut player = Player::connect(&*stream, &mut link, &GO_ON).expect("found");
        player.wind(&[0.0; 3], &[0.0, 0.0, 20.0]).expect("wound");
        player.hold(10.0).expect("there");
        assert_eq!(player.halt(), End::SwitchedOff, "{}", family.name);
        drop(player);
        let (stream, _) = spoken(&design, family);
        let refused = Player::connect(&*stream, &mut link, &GO_ON).map(drop).expect_err("beyond").to_string();
        assert!(refused.contains("\"third\"") && refused.contains("beyond its travel of 0 to 3.0 mm"), "{refused}");
        let before = link.simulation().axes();
        link.pass(5.0);
        assert_eq!(link.simulation().axes(), before);
        // Asked to wind beyond it by hand, it refuses too.
        let mut link = SimulatedLink::new(Simulation::of(family, 3));
        let mut player = Player::connect(&*stream, &mut link, &GO_ON).expect("found");
        let refused = player.wind(&[0.0; 3], &[0.0, 0.0, 3.5]).expect_err("beyond").to_string();
        assert!(refused.contains("asked to wind to 3.5 mm"), "{refused}");
    }
}

#[test]
fn after_zero_was_set_a_winch_is_wound_by_hand_with_every_family() {
    let design = waving(1, 2.0);
    for family in families::streams() {
        let (stream, _) = spoken(&design, family);
        let mut link = SimulatedLink::new(Simulation::of(family, 3));
        let mut player = Player::found(&*stream, &mut link, &GO_ON).expect("found");
        player.set_zero().expect("set");
        player.wind(&[0.0; 3], &[2.0, 1.0, 0.5]).expect(family.name);
        player.hold(10.0).expect("there");
        drop(player);
        let scale = units_per_mm(&*stream, family);
        for (farthest, most) in link.simulation().farthest().iter().zip([2.0, 1.0, 0.5]) {
            assert!((farthest / scale - most).abs() < 0.3, "{}: {farthest} of {most} mm", family.name);
        }
    }
}

#[test]
fn what_was_played_is_played_again_and_wound_by_hand_and_the_next_line_finds_it_with_every_family() {
    let design = waving(1, 2.0);
    for family in families::streams() {
        let (stream, plan) = spoken(&design, family);
        let mut link = SimulatedLink::new(Simulation::of(family, 3));
        let mut player = Player::found(&*stream, &mut link, &GO_ON).expect("found");
        player.set_zero().expect("set");
        for _ in 0..2 {
            player.play(&plan, 0.02, &mut |_| ()).expect(family.name);
        }
        player.wind(&[0.0; 3], &[2.0, 1.0, 0.5]).expect(family.name);
        player.finish().expect(family.name);
        player.set_zero().expect(family.name);
        player.finish().expect(family.name);
        drop(player);
        let mut player = Player::connect(&*stream, &mut link, &GO_ON).expect(family.name);
        player.play(&plan, 0.02, &mut |_| ()).expect(family.name);
        drop(player);
        let scale = units_per_mm(&*stream, family);
        for (axis, farthest) in link.simulation().axes().iter().zip(link.simulation().farthest()) {
            assert!(!axis.on && axis.position.abs() < 0.3 * scale && *farthest > scale, "{}: {axis:?}", family.name);
        }
    }
}

#[test]
fn a_line_so_slow_that_a_winch_is_never_told_is_refused() {
    let (design, ascii) = (waving(2, 2.0), families::by_name("ascii").expect("there is one"));
    let (stream, plan) = spoken(&design, ascii);
    let mut link = SimulatedLink::new(Simulation::of(ascii, 3).on_line(0.4, 115_200.0));
    let mut player = Player::connect(&*stream, &mut link, &GO_ON).expect("found");
    let refused = player.play(&plan, 0.02, &mut |_| ()).expect_err("too slow").to_string();
    assert!(refused.contains("would never get one") && refused.contains("switched off"), "{refused}");
}

#[test]
fn winding_on_waits_for_the_winches_so_that_they_stay_slow() {
    let design = waving(1, 2.0);
    for family in families::streams() {
        let (stream, _) = spoken(&design, family);
        let (mut link, slow) = (SimulatedLink::new(Simulation::of(family, 3)), stream.machine().gently().speed);
        let mut player = Player::found(&*stream, &mut link, &GO_ON).expect("found");
        player.set_zero().expect("set");
        player.wind(&[0.0; 3], &[8.0, 0.0, 0.0]).expect(family.name);
        assert!(!player.is_still());
        // Almost there already, as it was told: the winch itself is not.
        player.wind(&[8.0, 0.0, 0.0], &[7.9, 0.0, 0.0]).expect(family.name);
        player.finish().expect(family.name);
        drop(player);
        // There and back at no more than the slow speed.
        assert!(link.simulation().now_s() > 15.9 / slow, "{}: {}", family.name, link.simulation().now_s());
        assert!(link.simulation().axes().iter().all(|axis| !axis.on && !axis.moving), "{}", family.name);
    }
}

/// A line to a simulation behind a lock, in real time.
fn remote(design: &Design, family: &'static Family) -> Remote {
    let (stream, plan) = spoken(design, family);
    let open = move || Ok(Box::new(SimulatedLink::new(Simulation::of(family, 3))) as Box<dyn Link>);
    let motion = Motion { plan, least_slot_s: 0.02, allowed: Box::new(|_| Ok(())) };
    Remote::start(Box::new(open), stream, motion, || ())
}

fn wait(remote: &Remote, what: &str, is: impl Fn(&Status) -> bool) -> Status {
    let began = Instant::now();
    loop {
        remote.seen();
        let status = remote.status();
        if is(&status) {
            return status;
        }
        assert!(began.elapsed() < Duration::from_secs(20), "{what}: {status:?}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn a_remote_obeys_orders_and_stops_when_told_or_when_its_window_is_lost() {
    let ascii = families::by_name("ascii").expect("there is one");
    let own = remote(&waving(1, 1.0), ascii);
    wait(&own, "ready", |status| matches!(status, Status::Ready(_)));
    own.order(Order::SetZero);
    own.order(Order::Wind(vec![2.0, 1.0, 0.5]));
    wait(&own, "wound", |status| *status == Status::Ready(vec![2.0, 1.0, 0.5]));
    own.order(Order::Play);
    wait(&own, "played", |status| *status == Status::Ready(vec![0.0; 3]));
    own.stop();
    let Status::Ended { why, wanted } = wait(&own, "ended", |s| matches!(s, Status::Ended { .. })) else {
        unreachable!()
    };
    assert!(wanted && why.contains("switched off"), "{why}");

    let lost = remote(&waving(1, 1.0), ascii);
    let began = Instant::now();
    while !matches!(lost.status(), Status::Ended { .. }) {
        assert!(began.elapsed() < Duration::from_secs(20), "nobody watches");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(unix)]
mod ports {
    use super::*;
    use plushwright::live::{PseudoTerminal, SerialLink};
    use std::io::{BufRead, BufReader, Read};
    use std::process::{Child, Command, Stdio};
    use std::sync::atomic::Ordering;

    #[test]
    fn a_port_in_real_time_keeps_the_time_with_slow_replies() {
        let design = waving(2, 2.0);
        let ascii = families::by_name("ascii").expect("there is one");
        let (stream, plan) = spoken(&design, ascii);
        let terminal = PseudoTerminal::open().expect("a pseudo-terminal");
        let path = terminal.path().to_owned();
        static STOP: AtomicBool = AtomicBool::new(false);
        let controllers = std::thread::spawn(move || {
            let mut simulation = Simulation::of(ascii, 3);
            terminal.serve(&mut simulation, &STOP, Some(60.0)).expect("served");
            (simulation.axes(), simulation.farthest().to_vec())
        });
        let mut link = SerialLink::open(&path, 115_200).expect("opened");
        let mut player = Player::connect(&*stream, &mut link, &GO_ON).expect("found");
        let played = player.play(&plan, 0.02, &mut |_| ()).expect("played");
        drop(player);
        STOP.store(true, Ordering::SeqCst);
        let (axes, farthest) = controllers.join().expect("it ends");
        assert!(axes.iter().all(|axis| !axis.on && !axis.moving), "{axes:?}");
        // How late is seen by hand, as a loaded machine may be; and one that takes replies for slow has few slots.
        if played.slot_s < 0.1 {
            assert!(farthest.iter().all(|farthest| *farthest > 1000.0), "{farthest:?}");
            assert!(played.late.len() > 20, "{}", played.late.len());
        }
    }

    /// A child that is ended with the test.
    struct Ended(Child);

    impl Drop for Ended {
        fn drop(&mut self) {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }

    #[test]
    fn killed_in_the_middle_the_controllers_own_limits_hold() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("waving.plush");
        plushwright::design::file::write(&path, &waving(20, 2.0)).expect("written");
        let program = env!("CARGO_BIN_EXE_plushwright");
        let simulate = ["simulate-controller", "--winches", "3", "--seconds", "16"];
        let mut controllers =
            Ended(Command::new(program).args(simulate).stdout(Stdio::piped()).spawn().expect("it runs"));
        let mut told = BufReader::new(controllers.0.stdout.take().expect("piped"));
        let mut line = String::new();
        told.read_line(&mut line).expect("a port");
        let port = line.trim().strip_prefix("port: ").expect("a port").to_owned();
        let play = Command::new(program)
            .arg("play")
            .arg(&path)
            .args(["--port", &port, "--set-zero", "--baud", "115200"])
            .spawn();
        let mut play = Ended(play.expect("it runs"));
        std::thread::sleep(Duration::from_secs(10));
        assert!(play.0.try_wait().expect("asked").is_none(), "it still plays");
        play.0.kill().expect("killed");
        let mut text = String::new();
        told.read_to_string(&mut text).expect("text");
        let scale = waving_scale();
        for (line, most) in text.lines().zip([8.0, 5.0, 3.0]) {
            let farthest: f64 = line
                .split("farthest ")
                .nth(1)
                .and_then(|rest| rest.split(',').next())
                .expect(line)
                .parse()
                .expect(line);
            assert!(farthest > 0.0 && farthest <= most * scale + 1.5, "{line}");
        }
        // A drive that was told a slow last step may still be on its way.
        assert_eq!(text.lines().count(), 3, "{text}");
    }

    fn waving_scale() -> f64 {
        let ascii = families::by_name("ascii").expect("there is one");
        spoken(&waving(1, 2.0), ascii).0.machine().counts_per_mm
    }
}
