//! Another body: drawn on the sheet, or with another resolution.

use crate::support::window::{Window, bar, click, drag, press, session, settle, window, with_network};
use eframe::egui::{self, Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::mesh::Mesh;
use plushwright::outline::drawing::{Part, Primitive};
use plushwright::outline::polygon;
use plushwright::studio::commands::command::Scope;
use plushwright::studio::tools::taken;
use plushwright::studio::viewport::camera::Camera;

/// Where a place of the drawing is on the screen, while the sheet shows the box from `low` to `high`.
fn on_sheet(window: &Window, (low, high): ([f64; 2], [f64; 2]), p: [f64; 2]) -> Pos2 {
    let rect = window.get_by_label("Drawing sheet").rect();
    Camera::fit(low, high, rect.size()).to_screen(rect, p)
}

const BAR: ([f64; 2], [f64; 2]) = ([0.0, 0.0], [120.0, 40.0]);

fn parts(window: &Window) -> &[Part] {
    &session(window).drawing().parts
}

/// One click of the mouse on the sheet, and time enough for the next one not to be a double click.
fn click_at(window: &mut Window, p: Pos2) {
    window.hover_at(p);
    window.step();
    window.drag_at(p);
    window.step();
    window.drop_at(p);
    settle(window);
    window.run_steps(30);
}

/// Whether edges of the mesh run along a track, within 0.01 mm, between two of its places.
fn has_edges_along(mesh: &Mesh, [a, b]: [[f64; 2]; 2]) -> bool {
    let edges = mesh.edges();
    (0..=40).all(|k| {
        let p = polygon::lerp(a, b, f64::from(k) / 40.0);
        edges.iter().any(|e| polygon::distance_to_segment(mesh.nodes[e[0]], mesh.nodes[e[1]], p) < 0.01)
    })
}

#[test]
fn another_resolution_can_be_had_and_undone() {
    let mut window = with_network();
    let before = session(&window).design().clone();
    click(&mut window, "Mesh");
    for name in ["Muscle fibres", "Finer body"] {
        window.get_by_role_and_label(egui::accesskit::Role::SpinButton, name);
    }
    window.get_by_label_contains("Histogram of smallest angles");
    let value = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Muscle fibres").rect().center();
    drag(&mut window, value, value + vec2(120.0, 0.0));
    let asked = session(&window).resolution().fibers;
    assert!(asked > before.mesh.edges().len() + 20, "{asked}");
    assert_eq!(*session(&window).design(), before, "nothing has changed yet");
    click(&mut window, "Remesh");
    let after = session(&window).design().clone();
    let fibers = after.mesh.edges().len();
    assert!(fibers.abs_diff(asked) * 100 <= 3 * asked, "{fibers} for {asked}");
    assert_eq!((after.pins.len(), after.networks.len(), after.poses.len()), (3, 1, 1));
    let shape = session(&window).shapes().idealized.clone().expect("solved on the new mesh");
    assert_eq!(shape.nodes.len(), after.mesh.nodes.len());
    assert_eq!(session(&window).history().undo_label(), Some("Remesh"));
    // Undo brings back the old mesh, and shapes that belong to it.
    click(&mut window, "Undo");
    assert_eq!(*session(&window).design(), before);
    let shape = session(&window).shapes().idealized.clone().expect("solved on the old mesh");
    assert_eq!(shape.nodes.len(), before.mesh.nodes.len());
    click(&mut window, "Redo");
    assert_eq!(session(&window).design().mesh, after.mesh);
    // A mesh that nobody waits for any more changes nothing.
    window.get_by_label("Remesh").click();
    window.step();
    window.step();
    if session(&window).meshing().running.is_some() {
        window.get_by_label("Cancel meshing").click();
    }
    settle(&mut window);
}

#[test]
fn the_outline_is_drawn_with_the_mouse_and_becomes_a_body() {
    let mut window = with_network();
    let before = session(&window).design().clone();
    press(&mut window, Modifiers::NONE, Key::O);
    // The outline as it is, traced: nothing is in the document yet.
    assert!(
        matches!(parts(&window), [Part { primitive: Primitive::Path { points }, cut: false }] if points.len() == 4)
    );
    assert_eq!(*session(&window).design(), before);
    // A head on the free end.
    click(&mut window, "Circle");
    let [from, to] = [[100.0, 20.0], [100.0, 50.0]].map(|p| on_sheet(&window, BAR, p));
    drag(&mut window, from, to);
    let Primitive::Circle { center, radius } = parts(&window)[1].primitive else { panic!("{:?}", parts(&window)) };
    assert!((center[0] - 100.0).abs() < 0.5 && (center[1] - 20.0).abs() < 0.5 && (radius - 30.0).abs() < 0.5);
    assert_eq!(session(&window).history().undo_label(), Some("Draw a circle"));
    assert_eq!(session(&window).design().mesh, before.mesh, "the body is the old one until a new one is made");
    // Its rim, pulled in by hand, is one step of undo.
    press(&mut window, Modifiers::NONE, Key::V);
    let [rim, pulled] = [center[0] + radius, center[0] + 25.0].map(|x| on_sheet(&window, BAR, [x, center[1]]));
    drag(&mut window, rim, pulled);
    let Primitive::Circle { radius, .. } = parts(&window)[1].primitive else { panic!() };
    assert!((radius - 25.0).abs() < 0.5, "{radius}");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(matches!(parts(&window)[1].primitive, Primitive::Circle { radius, .. } if (radius - 30.0).abs() < 0.5));
    click(&mut window, "Make the body");
    let after = session(&window).design().clone();
    assert!(!session(&window).sketching().open, "the plushie is shown again");
    let (_, high) = after.outline.bounding_box();
    assert!((high[0] - 130.0).abs() < 1.0 && (high[1] - 60.0).abs() < 1.0, "{high:?}");
    assert_eq!((after.pins.len(), after.networks.len(), after.poses.len()), (3, 1, 1));
    after.validate().unwrap();
    settle(&mut window);
    let shape = session(&window).shapes().realizable.clone().expect("solved on the new body");
    assert_eq!(shape.nodes.len(), after.mesh.nodes.len());
    // Undo takes it all back.
    assert_eq!(session(&window).history().undo_label(), Some("New body"));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(*session(&window).design(), before);
}

#[test]
fn a_tendon_track_is_drawn_changed_and_becomes_edges_of_the_body() {
    let mut window = with_network();
    let before = session(&window).design().clone();
    press(&mut window, Modifiers::NONE, Key::O);
    click(&mut window, "Tendon track");
    let tracks = |window: &Window| session(window).drawing().tracks.clone();
    let at = |window: &Window, p: [f64; 2]| on_sheet(window, BAR, p);
    // One that Escape drops, and one that a double click ends.
    for p in [[20.0, 10.0], [60.0, 30.0]] {
        let p = at(&window, p);
        click_at(&mut window, p);
    }
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(session(&window).sketching().open && *session(&window).design() == before, "nothing was drawn");
    for p in [[15.0, 25.0], [60.0, 25.0], [105.0, 25.0], [105.0, 25.0]] {
        let p = at(&window, p);
        click_at(&mut window, p);
    }
    assert!(matches!(tracks(&window).as_slice(), [track] if track.len() == 3), "{:?}", tracks(&window));
    assert_eq!(session(&window).history().undo_label(), Some("Draw a track"));
    // A second one, ended with Enter, is deleted again by its button; then a part of undo brings it back and takes it.
    press(&mut window, Modifiers::NONE, Key::R);
    for p in [[15.0, 8.0], [40.0, -8.0]] {
        let p = at(&window, p);
        click_at(&mut window, p);
    }
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(tracks(&window).len(), 2);
    // It leaves the body, the first one does not.
    window.get_by_label_contains("cut off where they leave the body: 2.");
    click(&mut window, "Delete track 2");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(tracks(&window).len(), 2);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(tracks(&window).len(), 1);
    // Its middle point is pulled down, a point is put in, and taken out again.
    press(&mut window, Modifiers::NONE, Key::V);
    let on_it = at(&window, [30.0, 25.0]);
    click_at(&mut window, on_it);
    let [from, to] = [[60.0, 25.0], [60.0, 18.0]].map(|p| at(&window, p));
    drag(&mut window, from, to);
    let pulled = tracks(&window)[0].clone();
    assert!((pulled[1][1] - 18.0).abs() < 0.5 && pulled.len() == 3, "{pulled:?}");
    let [from, to] = [[82.5, 21.5], [82.5, 15.0]].map(|p| at(&window, p));
    drag(&mut window, from, to);
    assert_eq!((tracks(&window)[0].len(), session(&window).history().undo_label()), (4, Some("Add point")));
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(tracks(&window)[0], pulled);
    click(&mut window, "Make the body");
    let after = session(&window).design().clone();
    after.validate().unwrap();
    assert_eq!(after.networks.len(), 1);
    let track = after.tracks()[0].clone();
    for piece in track.windows(2) {
        assert!(has_edges_along(&after.mesh, [piece[0], piece[1]]), "{piece:?}");
    }
    // Another resolution keeps to it.
    click(&mut window, "Mesh");
    click(&mut window, "Remesh");
    assert!(has_edges_along(&session(&window).design().mesh, [track[1], track[2]]));
    while session(&window).history().undo_label() != Some("Add target") {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(*session(&window).design(), before);
}

#[test]
fn a_polygon_that_is_not_closed_is_kept() {
    let mut window = with_network();
    let before = session(&window).design().clone();
    let clicked = |window: &mut Window, points: &[[f64; 2]]| {
        for &p in points {
            let p = on_sheet(window, BAR, p);
            click_at(window, p);
        }
    };
    press(&mut window, Modifiers::NONE, Key::O);
    // Another pencil finishes three corners, as one step of undo, and drops two.
    click(&mut window, "Polygon");
    clicked(&mut window, &[[20.0, 20.0], [50.0, 20.0], [35.0, 55.0]]);
    click(&mut window, "Circle");
    let corners = |part: &Part| match &part.primitive {
        Primitive::Path { points } => points.iter().filter(|p| p.corner).count(),
        _ => 0,
    };
    assert_eq!((parts(&window).len(), corners(&parts(&window)[1])), (2, 3));
    assert_eq!(taken(session(&window), Scope::Outline).id, "tool.circle");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(*session(&window).design(), before);
    click(&mut window, "Polygon");
    clicked(&mut window, &[[20.0, 20.0], [50.0, 20.0]]);
    press(&mut window, Modifiers::NONE, Key::V);
    assert_eq!(*session(&window).design(), before);
    // So does closing the sheet; a track of two points is kept as well.
    click(&mut window, "Tendon track");
    clicked(&mut window, &[[20.0, 20.0], [100.0, 20.0]]);
    click(&mut window, "Polygon");
    assert_eq!(session(&window).drawing().tracks.len(), 1);
    clicked(&mut window, &[[20.0, 20.0], [50.0, 20.0], [35.0, 55.0], [25.0, 50.0]]);
    press(&mut window, Modifiers::NONE, Key::O);
    assert!(!session(&window).sketching().open);
    let drawing = session(&window).design().drawing.clone().expect("it was drawn");
    assert_eq!((drawing.parts.len(), corners(&drawing.parts[1])), (2, 4));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(*session(&window).design(), before);
}

#[test]
fn a_new_plushie_is_drawn_on_an_empty_sheet() {
    let mut window = window(bar());
    click(&mut window, "File");
    window.get_by_label_contains("New drawing").click();
    settle(&mut window);
    assert!(parts(&window).is_empty() && session(&window).sketching().open);
    let sheet = ([0.0, 0.0], [300.0, 240.0]);
    let at = |window: &Window, p: [f64; 2]| on_sheet(window, sheet, p);
    // A freehand line around, its ends not quite together.
    let round: Vec<Pos2> = (0..=40)
        .map(|i| {
            let (sin, cos) = (0.15 * f64::from(i)).sin_cos();
            at(&window, [150.0 + 90.0 * cos, 120.0 + 70.0 * sin])
        })
        .collect();
    window.hover_at(round[0]);
    window.step();
    window.drag_at(round[0]);
    for &p in &round {
        window.hover_at(p);
        window.step();
    }
    window.drop_at(round[40]);
    settle(&mut window);
    assert!(matches!(&parts(&window)[0].primitive, Primitive::Path { points } if (4..40).contains(&points.len())));
    let area: f64 = plushwright::outline::polygon::signed_area(&parts(&window)[0].primitive.polygon());
    assert!((area / (std::f64::consts::PI * 90.0 * 70.0) - 1.0).abs() < 0.03, "{area}");
    // A triangle is cut out of it, corner by corner, closed on the first one.
    press(&mut window, Modifiers::NONE, Key::P);
    press(&mut window, Modifiers::NONE, Key::X);
    let corners = [[140.0, 100.0], [180.0, 100.0], [160.0, 140.0], [140.0, 100.0]];
    for p in corners {
        let p = at(&window, p);
        click_at(&mut window, p);
    }
    assert_eq!(parts(&window).len(), 2, "{:?}", parts(&window));
    assert!(parts(&window)[1].cut && parts(&window)[1].primitive.handles().len() == 3);
    // A part by its name, a point by hand, and both deleted.
    press(&mut window, Modifiers::NONE, Key::V);
    click(&mut window, "2 Polygon, cut out");
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(parts(&window).len(), 1);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(parts(&window).len(), 2);
    click(&mut window, "Make the body");
    let design = session(&window).design().clone();
    assert_eq!(design.outline.holes.len(), 1);
    assert!((design.outline.area() - (area - 800.0)).abs() < 0.02 * area, "{}", design.outline.area());
    design.validate().unwrap();
}
