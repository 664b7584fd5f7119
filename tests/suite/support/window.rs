//! The window in tests, driven by accessible names: a harness on it, hands that click, drag and type, and a small design.

pub use super::{bar, network};
use eframe::egui::{Key, Modifiers, Pos2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, MaterialPoint, Network, Tendon};
use plushwright::engine::Shape;
use plushwright::rigging::{PoseServed, Proposal, Sewn};
use plushwright::studio::app::Studio;
use plushwright::studio::session::{Services, Session};
use plushwright::studio::store::Store;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A rig of all poses may take its time on a busy machine.
const PATIENCE: Duration = Duration::from_secs(300);

pub type Window = Harness<'static, Option<Studio>>;

pub fn proposal(design: &Design, error_after: f64) -> Proposal {
    Proposal {
        network: network(),
        poses: vec![PoseServed { name: Some("Pose 1".into()), before: 0.2, after: error_after, with_friction: None }],
        current: 0,
        sewn: Some(Sewn { median: error_after, worst: 2.0 * error_after }),
        thread_mm: 100.0,
        holes: 4,
        turn_degrees: 0.0,
        turning_degrees: 0.0,
        force_n: 5.0,
        spool_n: 5.0,
        breaches: Vec::new(),
        preview: Arc::new(Shape { nodes: design.mesh.nodes.clone(), ..Shape::default() }),
        paper: Some(Default::default()),
    }
}

/// One of another network, whose way nobody knows.
pub fn other(design: &Design, error_after: f64) -> Proposal {
    let tendon = Tendon { routing: MaterialPoint::through(0..6), ratio: 1.0, slack_mm: 0.0 };
    let network = Network::new("winch 1", vec![tendon]);
    Proposal { network, paper: None, ..proposal(design, error_after) }
}

/// Proposes two networks at once.
pub fn services() -> Services {
    Services {
        propose: Arc::new(|design, _, _, _, _| vec![Arc::new(proposal(design, 0.05)), Arc::new(other(design, 0.1))]),
        export: Arc::new(|_, folder, _, _| {
            std::fs::create_dir(folder).map_err(|e| e.to_string())?;
            std::fs::write(folder.join("pattern.svg"), "<svg/>").map_err(|e| e.to_string())?;
            Ok(Vec::new())
        }),
    }
}

pub fn window(design: Design) -> Window {
    window_with(design, services())
}

/// On these services.
pub fn window_with(design: Design, services: Services) -> Window {
    let mut window = open(design, None, services, None);
    settle(&mut window);
    window
}

/// A window on a design, and on a file where it has one. With a store it keeps its state there.
pub fn open(design: Design, path: Option<PathBuf>, services: Services, store: Option<Store>) -> Window {
    let mut given = Some((design, path, services, store));
    Harness::builder().with_max_steps(32).with_size(vec2(1280.0, 800.0)).build_ui_state(
        move |ui, studio: &mut Option<Studio>| {
            let studio = studio.get_or_insert_with(|| {
                let (design, path, services, store) = given.take().expect("made once");
                let studio = Studio::new(ui.ctx(), design, path, services);
                let studio = match store {
                    Some(store) => studio.with_store(ui.ctx(), store),
                    None => studio,
                };
                // The bar is wide, and tests count on where its places are.
                studio.side_by_side()
            });
            studio.update(ui);
        },
        None,
    )
}

pub fn session(window: &Window) -> &Session {
    window.state().as_ref().expect("made in the first frame").session()
}

/// Runs frames until the solver has answered and no thread is busy.
pub fn settle(window: &mut Window) {
    wait(window, |s| {
        s.is_settled() && s.discovery().running.is_none() && !s.is_working() && s.meshing().running.is_none()
    });
    window.run();
}

pub fn wait(window: &mut Window, done: impl Fn(&Session) -> bool) {
    let started = Instant::now();
    loop {
        window.step();
        if done(session(window)) {
            return;
        }
        assert!(started.elapsed() < PATIENCE, "nothing happened");
        std::thread::sleep(Duration::from_millis(2));
    }
}

pub fn click(window: &mut Window, name: &str) {
    window.get_by_label(name).click();
    settle(window);
}

pub fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    settle(window);
}

/// Where a point of the body is on the screen; both views fit the bar in the same way.
pub fn on_screen(window: &Window, view: &str, p: [f64; 2]) -> Pos2 {
    let rect = window.get_by_label(view).rect();
    let scale = (rect.width() / (120.0 * 1.12)).min(rect.height() / (40.0 * 1.12));
    let center = rect.center();
    pos2(center.x + (p[0] as f32 - 60.0) * scale, center.y - (p[1] as f32 - 20.0) * scale)
}

pub fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for i in 1..=4 {
        window.hover_at(from.lerp(to, i as f32 / 4.0));
        window.step();
    }
    window.drop_at(to);
    settle(window);
}

/// Drags the free end of the bar up.
pub fn pose(window: &mut Window, view: &str) {
    let (from, to) = (on_screen(window, view, [120.0, 20.0]), on_screen(window, view, [115.0, 45.0]));
    drag(window, from, to);
}

pub fn with_network() -> Window {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    pose(&mut window, "Realizable view");
    window
}

/// Types a path into the dialog.
pub fn type_path(window: &mut Window, path: &Path) {
    enter_path(window, path);
    settle(window);
}

/// [`type_path`] without waiting for the solver.
pub fn enter_path(window: &mut Window, path: &Path) {
    window.get_by_label("Path").focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_by_label("Path").type_text(&path.to_string_lossy());
}
