use super::*;
use crate::design::testing;

fn changed(edit: Edit) -> (Design, Option<Part>) {
    let mut design = testing::sample();
    let part = apply(&mut design, &edit).unwrap();
    design.validate().unwrap();
    (design, part)
}

fn places(design: &Design, winch: usize, tendon: usize) -> Vec<Point> {
    let routing = &design.networks[winch].tendons[tendon].routing;
    routing.iter().map(|point| point.place(&design.mesh.nodes)).collect()
}

#[test]
fn holes_are_moved_added_and_taken_out() {
    let (design, part) = changed(Edit::Move { part: Part::Hole(1, 0, 1), to: [40.0004, 20.0] });
    assert_eq!(part, Some(Part::Hole(1, 0, 1)));
    let [x, y] = places(&design, 1, 0)[1];
    assert!((x - 40.0).abs() < 1e-9 && (y - 20.0).abs() < 1e-9, "to the micrometre: {x} {y}");
    // All tendons of a winch go with it.
    for part in [Part::Winch(0), Part::Hole(0, 1, 0)] {
        let (design, _) = changed(Edit::Move { part, to: [20.0, 35.0] });
        for tendon in 0..2 {
            let [x, y] = places(&design, 0, tendon)[0];
            assert!((x - 20.0).abs() < 1e-9 && (y - 35.0).abs() < 1e-9);
        }
    }
    let (design, part) = changed(Edit::AddHole { winch: 1, tendon: 0, piece: 1, at: [40.0, 45.0] });
    assert_eq!((part, places(&design, 1, 0).len()), (Some(Part::Hole(1, 0, 2)), 4));
    let (back, part) = changed(Edit::Remove(Part::Hole(1, 0, 1)));
    assert_eq!((part, places(&back, 1, 0)), (Some(Part::Tendon(1, 0)), vec![[60.0, 0.0], [60.0, 60.0]]));
    // The hole before is the end then.
    let (shorter, _) = changed(Edit::Remove(Part::Hole(1, 0, 2)));
    assert_eq!(places(&shorter, 1, 0), [[60.0, 0.0], [30.0, 30.0]]);
}

#[test]
fn what_is_left_without_a_second_point_goes() {
    let (design, part) = changed(Edit::Remove(Part::Hole(0, 0, 1)));
    assert_eq!((part, design.networks[0].tendons.len()), (Some(Part::Winch(0)), 1));
    let (design, part) = changed(Edit::Remove(Part::Tendon(1, 0)));
    assert_eq!((part, design.networks.len()), (None, 1));
    assert!(design.keyframes.iter().all(|key| key.activations_mm.len() == 1));
}

#[test]
fn tendons_are_added_and_given_to_other_winches() {
    let (design, part) = changed(Edit::AddTendon { winch: 1, through: vec![[45.0, 5.0], [15.0, 5.0]] });
    assert_eq!((part, design.networks[1].tendons.len()), (Some(Part::Tendon(1, 1)), 2));
    assert_eq!(places(&design, 1, 1)[0], [60.0, 0.0]);
    let (design, part) = changed(Edit::HandOver { winch: 0, tendon: 1, to: 1 });
    assert_eq!((part, design.networks[0].tendons.len()), (Some(Part::Tendon(1, 1)), 1));
    assert_eq!(places(&design, 1, 1), [[60.0, 0.0], [0.0, 60.0]]);
    // The last one takes its winch along; the first winch, and its keys, are the ones that are gone.
    let mut design = testing::sample();
    apply(&mut design, &Edit::Remove(Part::Tendon(0, 0))).unwrap();
    let right: Vec<f64> = design.keyframes.iter().map(|key| key.activations_mm[1]).collect();
    let part = apply(&mut design, &Edit::HandOver { winch: 0, tendon: 0, to: 1 }).unwrap();
    assert_eq!((part, design.networks.len(), &design.networks[0].name[..]), (Some(Part::Tendon(0, 1)), 1, "right"));
    assert!(design.keyframes.iter().zip(right).all(|(key, right)| key.activations_mm == [right]));
}

#[test]
fn a_winch_is_split_and_moves_as_before() {
    let (design, part) = changed(Edit::Split { winch: 0, tendons: vec![1], at: None });
    assert_eq!((part, design.networks.len()), (Some(Part::Winch(2)), 3));
    let [x, y] = places(&design, 2, 0)[0];
    // A housing and the space between two away, towards the corner.
    assert!(((x - 30.0).hypot(y - 30.0) - 29.0).abs() < 1e-3 && x < 30.0 && y > 30.0, "{x} {y}");
    assert!(design.keyframes.iter().all(|key| key.activations_mm[2] == key.activations_mm[0]));
    let at = [10.0, 50.0];
    let (design, _) = changed(Edit::Split { winch: 0, tendons: vec![0], at: Some(at) });
    assert!(places(&design, 2, 0)[0].iter().zip(at).all(|(p, q)| (p - q).abs() < 1e-9));
    for tendons in [vec![], vec![0, 1]] {
        let refused = apply(&mut testing::sample(), &Edit::Split { winch: 0, tendons, at: None });
        assert_eq!(refused, Err(EditError::NotSome));
    }
}

#[test]
fn winches_are_made_renamed_and_reordered() {
    let (design, part) = changed(Edit::New { through: vec![[10.0, 10.0], [20.0, 50.0]] });
    assert_eq!((part, &design.networks[2].name[..]), (Some(Part::Winch(2)), "winch 1"));
    assert!(design.keyframes.iter().all(|key| key.activations_mm[2] == 0.0));
    let (design, _) = changed(Edit::Rename { winch: 0, name: " arm ".into() });
    assert_eq!(design.networks[0].name, "arm");
    let (design, _) = changed(Edit::Reorder { winch: 0, to: 1 });
    assert_eq!((&design.networks[1].name[..], &design.keyframes[1].activations_mm[..]), ("left", &[3.0, 6.0][..]));
}

#[test]
fn what_is_refused_changes_nothing() {
    let before = testing::sample();
    let edits = [
        Edit::Move { part: Part::Hole(1, 0, 1), to: [90.0, 10.0] },
        Edit::Move { part: Part::Hole(1, 0, 3), to: [10.0, 10.0] },
        // On the hole before it.
        Edit::Move { part: Part::Hole(1, 0, 1), to: [60.0, 0.0] },
        Edit::AddHole { winch: 1, tendon: 0, piece: 2, at: [10.0, 10.0] },
        Edit::Remove(Part::Winch(2)),
        Edit::Remove(Part::Hole(0, 0, 2)),
        Edit::AddTendon { winch: 0, through: vec![] },
        Edit::HandOver { winch: 0, tendon: 0, to: 2 },
        Edit::Split { winch: 0, tendons: vec![2], at: None },
        Edit::New { through: vec![[10.0, 10.0]] },
        Edit::Rename { winch: 0, name: "right".into() },
        Edit::Reorder { winch: 0, to: 2 },
    ];
    for edit in edits {
        let mut design = before.clone();
        assert!(apply(&mut design, &edit).is_err(), "{edit:?}");
        assert_eq!(design, before, "{edit:?}");
    }
    let stop = std::sync::atomic::AtomicBool::new(true);
    let stopped = run(&mut before.clone(), &Edit::Remove(Part::Winch(0)), &Context::new(&stop));
    assert_eq!(stopped, Err(Error::Cancelled(Cancelled)));
}
