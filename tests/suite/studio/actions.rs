//! A random session of all that can be asked for: undo to the start and redo to the end are the same documents, bit for bit.

use crate::support::bar;
use crate::support::window::{network, services};
use plushwright::design::{Design, Easing, Hold, Keyframe, Target, file};
use plushwright::mesh::Axis;
use plushwright::operations::arrange::{Handle, Motion};
use plushwright::operations::network::{Edit, Part};
use plushwright::outline::drawing::{Part as Drawn, Primitive};
use plushwright::outline::{Drawing, Point};
use plushwright::random::Random;
use plushwright::studio::action::{Action, Sketch};
use plushwright::studio::acts::apply::apply;
use plushwright::studio::acts::tick::tick;
use plushwright::studio::canvas::{Camera, Hit, Plushie};
use plushwright::studio::change::Change;
use plushwright::studio::commands;
use plushwright::studio::session::{Brush, Order, Selection, Session};
use std::sync::Arc;

/// Fewer than the steps that undo keeps.
const ACTIONS: usize = 450;
/// Of files and of the window, which replace the document or ask; work on threads ends when it likes, and is tested where it belongs.
const ELSEWHERE: [&str; 8] = ["file.", "window.", "outline.edit", "motors.", "work.", "mesh.", "discovery.", "rig."];

struct Hand {
    random: Random,
}

impl Hand {
    fn number(&mut self, below: usize) -> usize {
        self.random.index(below.max(1))
    }

    fn place(&mut self) -> Point {
        [self.random.between(-10.0, 130.0), self.random.between(-10.0, 50.0)]
    }

    fn part(&mut self) -> Part {
        let (w, t, k) = (self.number(3), self.number(3), self.number(5));
        [Part::Winch(w), Part::Tendon(w, t), Part::Hole(w, t, k), Part::Piece(w, t, k)][self.number(4)]
    }

    fn hit(&mut self, design: &Design) -> Hit {
        match self.number(5) {
            0 => Hit::Nothing,
            1 => Hit::Target(self.number(3)),
            2 => Hit::Pin(self.number(4)),
            3 => Hit::Part(self.part()),
            _ => design.mesh.node_point(self.number(design.mesh.nodes.len())).map_or(Hit::Nothing, Hit::Body),
        }
    }

    fn handles(&mut self) -> Vec<Handle> {
        let mut handles = Vec::new();
        for _ in 0..self.number(4) {
            let handle = if self.number(2) == 0 { Handle::Target(self.number(3)) } else { Handle::Pin(self.number(4)) };
            if !handles.contains(&handle) {
                handles.push(handle);
            }
        }
        handles
    }

    fn keys(&mut self) -> Vec<usize> {
        let first = self.number(4);
        (first..first + self.number(3)).collect()
    }

    fn edit(&mut self) -> Edit {
        let (winch, tendon, at) = (self.number(3), self.number(3), self.place());
        match self.number(10) {
            0 | 1 => Edit::Move { part: self.part(), to: at },
            2 => Edit::AddHole { winch, tendon, piece: self.number(4), at },
            3 => Edit::Remove(self.part()),
            4 => Edit::AddTendon { winch, through: vec![at, self.place()] },
            5 => Edit::HandOver { winch, tendon, to: self.number(3) },
            6 => Edit::Split { winch, tendons: vec![tendon], at: None },
            7 => Edit::New { through: vec![at, self.place(), self.place()] },
            8 => Edit::Rename { winch, name: format!("winch {}", self.number(9)) },
            _ => Edit::Color { winch, color: Some([self.number(255) as u8, 90, 200]) },
        }
    }

    fn change(&mut self, design: &Design) -> Change {
        let pose = self.number(design.poses.len() + 1);
        let (index, point) = (self.number(4), design.mesh.node_point(self.number(design.mesh.nodes.len())).unwrap());
        let axis = Axis { origin: [60.0, 0.0], along: [0.0, 1.0] };
        let easing = [Easing::Linear, Easing::Hold, Easing::Slow { out: 0.4, into: 0.7 }][self.number(3)];
        match self.number(32) {
            0 => Change::AddPose,
            1 => Change::DuplicatePose(pose),
            2 => Change::RenamePose(pose, format!("pose {index}")),
            3 => Change::RemovePose(pose),
            4..=6 => {
                let target = Target { at: point, to: self.place(), weight: 1.0 };
                Change::AddTarget { pose: (pose < design.poses.len()).then_some(pose), target }
            }
            7 => Change::MoveTarget { pose, index, to: self.place() },
            8 => Change::WeighTarget { pose, index, weight: self.random.between(0.1, 5.0) },
            9 => Change::RemoveTarget { pose, index },
            10 => Change::ClearTargets(pose),
            11 => Change::AddPin(point),
            12 => Change::RemovePin(index),
            13 => Change::MovePin { index, to: Some(self.place()) },
            14 => Change::SitePin { index, at: point },
            15 => Change::HoldPin { index, hold: [Hold::Point, Hold::Line { degrees: 30.0 }][self.number(2)] },
            16 => Change::PinMiddle,
            17 => Change::Arrange {
                pose: Some(pose),
                handles: self.handles(),
                motion: Motion { by: self.place(), ..Motion::default() },
            },
            18 => Change::WeighTargets { pose, handles: self.handles(), weight: 2.0 },
            19 => Change::Mirror { pose: Some(pose), handles: self.handles(), axis },
            20 => Change::MirrorPose { pose, axis },
            21 => Change::RemoveHandles { pose: Some(pose), handles: self.handles() },
            22 => Change::Starch { at: self.place(), brush: Brush { radius_mm: 15.0, factor: 3.0 } },
            23 => Change::AcceptNetwork(network()),
            24 | 25 => Change::Network(self.edit()),
            26 => {
                let activations_mm = (0..design.networks.len()).map(|_| self.random.between(0.0, 20.0)).collect();
                let time_s = (4.0 * self.random.between(0.0, 5.0)).round() / 4.0;
                Change::SetKeyframe(Keyframe { time_s, activations_mm, easing, pose: None })
            }
            27 => Change::MoveKeyframes { keys: self.keys(), by_s: self.random.between(-1.0, 1.0) },
            28 => Change::StretchKeyframes { keys: self.keys(), factor: self.random.between(0.5, 2.0) },
            29 => Change::EaseKeyframes { keys: self.keys(), easing },
            30 => Change::RemoveKeyframes(self.keys()),
            _ => Change::Rename(format!("bar {index}")),
        }
    }

    fn action(&mut self, session: &Session) -> Action {
        let design = session.design().clone();
        match self.number(24) {
            0..=9 => Action::Change(self.change(&design)),
            10..=12 => Action::Live(self.change(&design)),
            13 => Action::Again(self.change(&design)),
            14..=16 => {
                let all: Vec<_> =
                    commands::all().filter(|c| !ELSEWHERE.iter().any(|id| c.id.starts_with(id))).collect();
                Action::Run(all[self.number(all.len())], self.hit(&design))
            }
            17 => Action::SelectPose((self.number(3) > 0).then(|| self.number(design.poses.len() + 1))),
            18 => {
                let (k, part) = (self.number(5), self.part());
                Action::Select(
                    [
                        Selection::Nothing,
                        Selection::Target(k),
                        Selection::Pin(k),
                        Selection::Keyframe(k),
                        Selection::Part(part),
                    ][self.number(5)],
                )
            }
            19 => {
                if self.number(2) == 0 {
                    Action::Gather(self.handles())
                } else {
                    Action::GatherKeys(self.keys())
                }
            }
            20 => {
                if self.number(2) == 0 {
                    Action::DragTarget(self.place())
                } else {
                    Action::DragPin(self.number(4), self.place())
                }
            }
            21 => [
                Action::MovePart(self.part(), self.place()),
                Action::Wind(self.number(3), self.random.between(0.0, 20.0)),
            ][self.number(2)]
            .clone(),
            22 => match self.number(4) {
                0 => Action::Scrub(self.random.between(0.0, 4.0)),
                1 => Action::SetCamera(Plushie::Realizable, Camera { center: self.place(), scale: 2.0 }),
                2 => Action::SortProposals(Order::Force),
                _ => Action::ShowPlaces(vec![self.place()]),
            },
            _ => {
                let radius = self.random.between(20.0, 60.0);
                let parts = vec![Drawn::joined(Primitive::Circle { center: self.place(), radius })];
                if self.number(3) == 0 {
                    Action::Live(Change::Draw { what: "Draw", drawing: Drawing { parts, ..Drawing::default() } })
                } else {
                    Action::Sketch(Sketch::Cut(true))
                }
            }
        }
    }
}

fn bits(design: &Design) -> String {
    file::to_text(design).unwrap()
}

#[test]
fn undo_to_the_start_and_redo_to_the_end_after_a_random_session_of_all_actions() {
    let command = |id: &str| commands::all().find(|command| command.id == id).unwrap();
    let (undo, redo) = (command("edit.undo"), command("edit.redo"));
    for seed in 0..3 {
        let mut session = Session::new(bar(), None, Arc::new(|| ()), services());
        let start = session.design().clone();
        let mut hand = Hand { random: Random::new(seed) };
        let (mut steps, mut done) = (0, 0);
        for k in 0..ACTIONS {
            let before = session.design().clone();
            let action = hand.action(&session);
            let text = format!("{action:?}");
            apply(&mut session, action);
            // The hand lets go now and then.
            tick(&mut session, 0.1 * k as f64, 0.01, hand.number(3) > 0);
            assert!(session.design().validate().is_ok(), "seed {seed}, action {k}: {text}");
            done += usize::from(!Arc::ptr_eq(&before, session.design()));
        }
        tick(&mut session, 1e3, 0.01, true);
        let end = session.design().clone();
        while session.history().undo_label().is_some() {
            apply(&mut session, Action::Run(undo, Hit::Nothing));
            steps += 1;
        }
        assert_eq!((&**session.design(), bits(session.design())), (&*start, bits(&start)), "seed {seed}");
        while session.history().redo_label().is_some() {
            apply(&mut session, Action::Run(redo, Hit::Nothing));
            steps -= 1;
        }
        assert_eq!((bits(session.design()), steps), (bits(&end), 0), "seed {seed}");
        assert!(done > ACTIONS / 6, "seed {seed}: {done} actions changed anything");
    }
}
