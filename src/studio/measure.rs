//! `bench window`: the real interface and renderer off screen, with a hand that drags the body round and round.
//!
//! For each number of fibres and size of the window: the interface thread's own work a frame (input, layout, tessellation, what is handed
//! to the adapter) in processor time, the same by the clock, what the adapter takes, and frames a second where each is waited for; once with the
//! real solver and once with one that takes its time, which must not be felt. Where an adapter in software and the solver share the processor, the
//! clock tells of them, too.

use super::app::Studio;
use super::offscreen::Screen;
use super::viewport::Plushie;
use crate::bench::statistics::quantile;
use crate::bench::{BenchError, Cell, Report, Session, Table};
use crate::commands::WindowOptions;
use crate::design::{Design, Pin, bundled};
use crate::mesh::{self, Mesh};
use crate::outline::Point;
use crate::picture::layers::look;
use crate::picture::palette::{Palette, Theme};
use eframe::egui::{self, Event, Modifiers, PointerButton, Pos2, RawInput};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

/// What is measured.
#[derive(Clone, Debug)]
pub struct WindowBench {
    /// Numbers of muscle fibres.
    pub fibers: Vec<usize>,
    /// Frames of each drag.
    pub frames: usize,
    /// How long the slow solver takes.
    pub late: Duration,
    /// A look of the views by its name.
    pub look: &'static str,
}

/// Windows: width, height and pixels of a logical one.
const SIZES: [([u32; 2], f32); 2] = [([1280, 800], 1.0), ([2560, 1600], 2.0)];
/// Frames before anything is measured: fonts are laid out and buffers made.
const WARM: usize = 20;
/// Longest wait for the first answer of the solver.
const PATIENCE: Duration = Duration::from_secs(60);
/// The hand goes round in so many frames, and so far from where it took hold, in body lengths.
const ROUND: f64 = 90.0;
const FAR: f64 = 0.06;

/// Times of the frames of a drag, ms.
#[derive(Default)]
struct Times {
    /// The interface thread's own work: processor time, and by the clock.
    own: Vec<f64>,
    passed: Vec<f64>,
    whole: Vec<f64>,
    adapter: Vec<f64>,
    /// Shapes of the solver that came while it went on.
    shapes: usize,
}

/// Measures all that the command line asks for.
///
/// # Errors
/// As [`WindowBench::run`], and a look that there is not.
pub fn run(options: &WindowOptions, session: &Session) -> Result<Report, BenchError> {
    let WindowOptions { fibers, frames, late_ms, look: name } = options;
    let look = look(name).ok_or_else(|| BenchError::Nothing(format!("there is no look `{name}`")))?;
    let late = Duration::from_millis(*late_ms);
    WindowBench { fibers: fibers.clone(), frames: *frames, late, look: look.name }.run(session)
}

impl WindowBench {
    /// Measures all of it.
    ///
    /// # Errors
    /// No graphics adapter, a mesh that cannot be made, [`BenchError::Cancelled`].
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let mut table = Table::new(
            "window",
            "frames of a drag: the interface thread's own work, on the adapter, and whole",
            &[
                "fibres",
                "window",
                "solver",
                "own p50 ms",
                "own p95 ms",
                "by the clock p95 ms",
                "adapter p50 ms",
                "adapter p95 ms",
                "frames/s",
                "shapes/s",
            ],
        );
        let mut adapter = String::new();
        for &fibers in &self.fibers {
            let design = subject(fibers)?;
            for (size, pixels_per_point) in SIZES {
                for late in [None, Some(self.late)] {
                    let words = late.map_or("real".to_owned(), |late| format!("{} ms", late.as_millis()));
                    let window = format!("{} x {}", size[0], size[1]);
                    session.next(&format!("{fibers} fibres, {window}, solver {words}"))?;
                    let screen = Screen::new(size, pixels_per_point).map_err(BenchError::Nothing)?;
                    adapter = screen.adapter();
                    let mut hand = Hand::new(screen, &design, self.look, late);
                    let times = hand.drag(self.frames, session)?;
                    let count = design.fiber_routings().len();
                    table.push(times.row(vec![count.into(), window.into(), words.into()]));
                }
            }
        }
        let remarks = vec![
            format!("Adapter: {adapter}. Look: {}.", self.look),
            "Own: input, layout, tessellation and what is handed to the adapter, in processor time; by the clock it includes what else is busy. \
             Frames/s: each frame is waited for."
                .into(),
        ];
        let title = format!("bench window, {} frames a drag", self.frames);
        Ok(Report { title, tables: vec![table], remarks, plots: Vec::new() })
    }
}

/// The first example with so many fibres, pinned at its left end and free at the right.
fn subject(fibers: usize) -> Result<Design, BenchError> {
    let Some(example) = bundled::ALL.first() else { return Err(BenchError::Nothing("there is no example".into())) };
    let design = example.design().map_err(|error| BenchError::Nothing(error.to_string()))?;
    let mesh = mesh::generate(&design.outline, fibers)
        .map_err(|source| BenchError::Mesh { shape: example.name.to_owned(), source })?;
    let mut design = Design::new(example.name, design.outline, mesh);
    let middle = middle(&design.mesh);
    for away in [[-0.1, 0.0], [0.1, 0.0]] {
        let place = [0, 1].map(|k| middle[k] + away[k] * design.body_length_mm());
        let node = design.mesh.nearest_node(place, &design.mesh.nodes);
        design.pins.extend(design.mesh.node_point(node).map(|at| Pin::at_rest(at, crate::defaults::PIN_STIFFNESS)));
    }
    Ok(design)
}

fn middle(mesh: &Mesh) -> Point {
    let count = mesh.nodes.len().max(1) as f64;
    [0, 1].map(|k| mesh.nodes.iter().map(|p| p[k]).sum::<f64>() / count)
}

/// A window off screen with a hand in it.
struct Hand {
    ctx: egui::Context,
    studio: Studio,
    screen: Screen,
    started: Instant,
}

impl Hand {
    fn new(screen: Screen, design: &Design, look: &'static str, late: Option<Duration>) -> Self {
        let ctx = egui::Context::default();
        let studio = Studio::new(&ctx, design.clone(), None, super::services());
        let studio = studio.with_window(Some(&screen.state), Theme::Light).measured(look, late);
        Self { ctx, studio, screen, started: Instant::now() }
    }

    /// One frame; what of it is the interface thread's own work, ms of the processor and by the clock.
    fn frame(&mut self, events: Vec<Event>) -> [f64; 2] {
        let (begun, worked) = (Instant::now(), super::worked());
        let mut input = RawInput {
            screen_rect: Some(self.screen.rect()),
            time: Some(self.started.elapsed().as_secs_f64()),
            events,
            focused: true,
            ..Default::default()
        };
        if let Some(viewport) = input.viewports.get_mut(&input.viewport_id) {
            viewport.native_pixels_per_point = Some(self.screen.pixels_per_point());
        }
        let studio = &mut self.studio;
        let output = self.ctx.run_ui(input, |ui| studio.update(ui));
        let background = super::style::color32(Palette::of(Theme::Light).background).to_normalized_gamma_f32();
        self.screen.draw(&self.ctx, output, background);
        let passed = begun.elapsed();
        let own = super::worked().zip(worked).map_or(passed, |(now, then)| now.saturating_sub(then));
        [own, passed].map(|time| time.as_secs_f64() * 1e3)
    }

    /// Takes the rightmost point of the body in the idealized view and goes round with it.
    fn drag(&mut self, frames: usize, session: &Session) -> Result<Times, BenchError> {
        let lost = BenchError::Nothing;
        let begun = Instant::now();
        for k in 0.. {
            self.frame(Vec::new());
            self.screen.wait().map_err(lost)?;
            if k >= WARM && self.studio.session().is_settled() || begun.elapsed() > PATIENCE {
                break;
            }
        }
        let design = self.studio.session().design().clone();
        let first = design.mesh.nodes.first().copied().unwrap_or_default();
        let end = design.mesh.nodes.iter().copied().fold(first, |a, b| if b[0] > a[0] { b } else { a });
        // From a place within the body, so that what is taken is the body.
        let inner = middle(&design.mesh);
        let taken = [0, 1].map(|k| end[k] + 0.04 * (inner[k] - end[k]));
        let at = |studio: &Studio, p: Point| studio.on_screen(Plushie::Idealized, p).unwrap_or(Pos2::ZERO);
        let press = at(&self.studio, taken);
        self.frame(vec![Event::PointerMoved(press)]);
        self.frame(vec![button(press, true)]);
        let mut times = Times::default();
        let mut shape = self.studio.session().shapes().idealized.clone();
        for k in 0..frames {
            session.check()?;
            let angle = TAU * k as f64 / ROUND;
            let away = FAR * design.body_length_mm();
            let p = at(&self.studio, [taken[0] + away * (angle.cos() - 1.0), taken[1] + away * angle.sin()]);
            let frame = Instant::now();
            let [own, passed] = self.frame(vec![Event::PointerMoved(p)]);
            times.own.push(own);
            times.passed.push(passed);
            self.screen.wait().map_err(lost)?;
            times.whole.push(frame.elapsed().as_secs_f64() * 1e3);
            times.adapter.extend(self.screen.drawn_ms());
            let newest = &self.studio.session().shapes().idealized;
            if newest.as_ref().map(std::sync::Arc::as_ptr) != shape.as_ref().map(std::sync::Arc::as_ptr) {
                shape = newest.clone();
                times.shapes += 1;
            }
        }
        if self.studio.session().targets().is_empty() {
            return Err(BenchError::Nothing("the hand has taken hold of nothing".into()));
        }
        Ok(times)
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

impl Times {
    fn row(self, mut row: Vec<Cell>) -> Vec<Cell> {
        let sorted = |mut times: Vec<f64>| {
            times.sort_by(f64::total_cmp);
            times
        };
        let total_s = self.whole.iter().sum::<f64>() / 1e3;
        let (count, shapes) = (self.whole.len() as f64, self.shapes as f64);
        let (own, passed, adapter) = (sorted(self.own), sorted(self.passed), sorted(self.adapter));
        row.extend([quantile(&own, 0.5), quantile(&own, 0.95), quantile(&passed, 0.95)].map(Cell::from));
        let told = |q: f64| Cell::from((!adapter.is_empty()).then(|| quantile(&adapter, q)));
        row.extend([told(0.5), told(0.95), Cell::from(count / total_s), Cell::from(shapes / total_s)]);
        row
    }
}
