//! The window: two views of the plushie, poses, networks, timeline.
//!
//! - [`app`] holds the state and updates it once a frame;
//! - [`panels`] and [`viewport`] borrow the [`session`], read only, and return [`action`]s;
//! - [`acts`] do what they say; they change the document only by a [`change`], through the undo history;
//! - [`commands`] is the one table of what can be asked for by name; [`tools`] are what a press does on a [`canvas`], which is a view
//!   or the sheet of the outline;
//! - [`viewport::renderer`] draws a neutral scene and knows nothing of the rest.
//!
//! Whatever takes long runs on a thread: the solver on its worker, the rest as [`jobs`].

pub mod action;
pub mod acts;
mod adapter;
pub mod app;
mod blank;
pub mod canvas;
pub mod change;
pub mod commands;
mod controls;
mod focus;
pub mod icons;
pub mod jobs;
pub mod keeper;
pub mod keeping;
mod keys;
pub mod language;
pub mod measure;
pub mod messages;
pub mod offscreen;
mod pacing;
pub mod panels;
mod pictures;
pub mod session;
pub mod store;
pub mod style;
pub mod tools;
pub mod viewport;
mod words;

use crate::design::{Design, bundled};
use crate::operations::{Context, Progress, export, propose};
use crate::picture::palette::Theme;
use app::Studio;
use eframe::egui;
use session::Services;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use store::Store;
use thiserror::Error;

/// What a bare Debian machine needs to open a window and draw in it.
const PACKAGES: &str = "libegl1 libxkbcommon-x11-0 libxcursor1 libxi6 libx11-xcb1 mesa-vulkan-drivers";

/// Sizes of the window, logical pixels: the first one, the least, and the most that a broken memory may ask for.
const SIZE: [f32; 2] = [1280.0, 800.0];
const LEAST_SIZE: [f32; 2] = [860.0, 560.0];
const MOST_SIZE: f32 = 8192.0;
/// Exit code of a window that did not close in time when it was asked to.
const ENDED: i32 = 130;
/// How long a window may take to keep its work when the system ends the program. What it has kept so far stays in any case.
const PATIENCE: Duration = Duration::from_secs(4);

/// Why the window could not be opened.
#[derive(Debug, Error)]
pub enum StudioError {
    #[error(
        "no display: neither WAYLAND_DISPLAY nor DISPLAY leads to one. Start it from a desktop, or under a virtual \
         display (apt-get install xvfb; xvfb-run plushwright)"
    )]
    NoDisplay,
    #[error("the window system refused: {0}. On Debian or Ubuntu install: {PACKAGES}")]
    WindowSystem(String),
    #[error("no graphics adapter: {0}. Install a driver; without a GPU: apt-get install mesa-vulkan-drivers")]
    NoAdapter(String),
    #[error("the graphics adapter was lost; work that was not saved is kept and offered at the next start")]
    AdapterLost,
    #[error("the window failed: {0}")]
    Failed(String),
}

/// Opens the window and returns when it is closed. Without a design the first example is shown. `told`: controls and where they are go
/// to standard output, for a program that drives the window.
///
/// # Errors
/// [`StudioError`] where there is no display or no graphics adapter.
pub fn run(design: Option<Design>, path: Option<PathBuf>, told: bool) -> Result<(), StudioError> {
    if !has_display() {
        return Err(StudioError::NoDisplay);
    }
    let begins = design.is_none();
    let design = design.unwrap_or_else(first_design);
    let store = Store::of_platform();
    let size = store.as_ref().and_then(|store| store.settings().window).unwrap_or(SIZE);
    let size = [0, 1].map(|k| if size[k].is_finite() { size[k].clamp(LEAST_SIZE[k], MOST_SIZE) } else { SIZE[k] });
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title(format!("Plushwright - {}", design.name))
            .with_app_id("plushwright")
            .with_icon(icon())
            .with_inner_size(size)
            .with_min_inner_size(LEAST_SIZE),
        persist_window: false,
        dithering: false,
        ..Default::default()
    };
    let lost = adapter::Lost::default();
    let watched = lost.clone();
    let create: eframe::AppCreator<'_> = Box::new(move |context| {
        let theme = match context.egui_ctx.system_theme() {
            Some(egui::Theme::Dark) => Theme::Dark,
            _ => Theme::Light,
        };
        style::set_theme(&context.egui_ctx, theme);
        let studio = Studio::new(&context.egui_ctx, design, path, services()).watching(watched);
        let studio = studio.in_language_of_system(language::of_system());
        let mut studio = studio.with_window(context.wgpu_render_state.as_ref(), theme);
        if let Some(store) = store {
            studio = studio.with_store(&context.egui_ctx, store);
        }
        if begins {
            studio = studio.with_start_page();
        }
        if told {
            context.egui_ctx.add_plugin(controls::Controls::new(std::io::stdout()));
        }
        end_when_asked(context.egui_ctx.clone());
        Ok(Box::new(studio))
    });
    quiet_about_the_display();
    // winit panics where an X library is missing; what it says then is the user's only clue.
    match catch_unwind(AssertUnwindSafe(|| eframe::run_native("plushwright", options, create))) {
        Ok(_) if lost.is() => Err(StudioError::AdapterLost),
        Ok(outcome) => outcome.map_err(from_eframe),
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
            let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
            Err(StudioError::WindowSystem(text.unwrap_or_else(|| "it panicked".to_owned())))
        }
    }
}

/// What breaks down in the libraries of the display is told by [`run`] in a line, and is no fault of ours to report.
fn quiet_about_the_display() {
    /// Parts of the paths of their sources.
    const DISPLAY: [&str; 2] = ["winit-", "x11-dl-"];
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if !info.location().is_some_and(|place| DISPLAY.iter().any(|library| place.file().contains(library))) {
            report(info);
        }
    }));
}

/// What the desktop shows for the window; an empty one is the desktop's own.
fn icon() -> egui::IconData {
    const PNG: &[u8] = include_bytes!("../../assets/icon/128/plushwright.png");
    let picture = image::load_from_memory(PNG).map(|picture| picture.to_rgba8()).unwrap_or_default();
    egui::IconData { width: picture.width(), height: picture.height(), rgba: picture.into_raw() }
}

/// The real engine and exporter.
pub fn services() -> Services {
    Services {
        propose: Arc::new(|design, targets, options, found, cancel| {
            let mut progress = |step: &Progress| {
                if let Progress::Proposals(list) = step {
                    found(list);
                }
            };
            let mut context = Context::telling(cancel, &mut progress);
            // That nothing was found is told where the proposals would be.
            propose::for_targets(design, targets, options, &mut context).unwrap_or_default()
        }),
        export: Arc::new(|design, folder, options, context| {
            export::run(design, folder, options, context)
                .map(|manifest| manifest.remarks.into_iter().map(|remark| remark.text).collect())
                .map_err(|error| match error {
                    export::Error::Export(error) => words::unexported(&error),
                    export::Error::Cancelled(_) => error.to_string(),
                })
        }),
    }
}

/// An interrupt, a request to end or the end of the terminal lets the window keep its work and close.
fn end_when_asked(ctx: egui::Context) {
    let asked = move || {
        acts::keep::ENDING.store(true, Ordering::SeqCst);
        ctx.request_repaint();
        std::thread::sleep(PATIENCE);
        crate::files::before_exit();
        std::process::exit(ENDED);
    };
    // Without it such an end is like a kill: what was kept is offered at the next start.
    let _ = crate::files::on_interrupt(asked);
}

/// On other systems there always is one.
fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || set("WAYLAND_DISPLAY") || set("WAYLAND_SOCKET") || set("DISPLAY")
}

/// Processor time that this thread has taken; `None` where the system does not tell.
fn worked() -> Option<std::time::Duration> {
    #[cfg(unix)]
    {
        let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        Some(std::time::Duration::new(u64::try_from(now.tv_sec).ok()?, u32::try_from(now.tv_nsec).ok()?))
    }
    #[cfg(not(unix))]
    None
}

fn first_design() -> Design {
    bundled::ALL.first().and_then(|example| example.design().ok()).unwrap_or_else(crate::studio::blank::design)
}

fn from_eframe(error: eframe::Error) -> StudioError {
    match error {
        eframe::Error::Wgpu(error) => StudioError::NoAdapter(error.to_string()),
        eframe::Error::Winit(error) => from_winit(&error.to_string()),
        eframe::Error::WinitEventLoop(error) => from_winit(&error.to_string()),
        other => StudioError::Failed(other.to_string()),
    }
}

/// A display that is named but does not answer is told apart from a library that is missing.
fn from_winit(text: &str) -> StudioError {
    if text.contains("connection to X server") {
        StudioError::NoDisplay
    } else {
        StudioError::WindowSystem(text.to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn sleep_is_no_work() {
        let before = worked();
        std::thread::sleep(Duration::from_millis(20));
        if let Some((now, before)) = worked().zip(before) {
            assert!(now - before < Duration::from_millis(10));
        }
    }
}
