//! The window: state, and one update a frame.

use super::action::{Action, FileAction};
use super::adapter::Lost;
use super::focus::Focus;
use super::pacing::Pacing;
use super::panels;
use super::session::{Dialog, Overlay, Services, Session, desktop_has_dialogs};
use super::store::Store;
use super::tools::Toolbox;
use super::{acts, canvas, keys, style, viewport};
use crate::design::Design;
use crate::outline::Point;
use crate::picture::palette::{Palette, Theme};
use crate::studio::language::{self, Language, t};
use eframe::egui::{self, CentralPanel, Frame, Margin, Panel, ViewportCommand};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// How often a window that drives motors shows that it is there.
const WATCH: Duration = Duration::from_millis(100);

/// How long folds and switches take, s.
const MOVES_S: f32 = 0.1;

/// How long a press may last and still be a click, s: frames come slowly where they are drawn in software, and a press seen in one and its release in the next
/// must not be lost.
const CLICK_S: f64 = 3.0;
/// How far a pointer may move between a quick press and its release in a click, logical pixels: egui's own bound.
const CLICK_PX: f32 = 6.0;
/// The same where the press has lasted for longer than `LONG_TOUCH_S`: who holds on is about to move something by a little.
const HELD_PX: f32 = 1.5;
/// How long a finger rests on the screen to ask for the menu, and a press is one that holds on, s: egui's own bound.
const LONG_TOUCH_S: f64 = 0.8;

pub struct Studio {
    session: Session,
    timeline: panels::timeline::State,
    palette: panels::palette::State,
    start: panels::start::State,
    dialogs: panels::dialogs::State,
    inspector: panels::inspector::State,
    views: viewport::State,
    sheet: canvas::State,
    tools: Toolbox,
    pacing: Pacing,
    focus: Focus,
    title: String,
    /// How many messages stood beside the work in the last frame.
    said: usize,
    /// In which this frame is drawn: another one that is chosen in it holds from the next one on.
    theme: Theme,
    lost: Lost,
}

impl Studio {
    /// `ctx` is woken up by the threads.
    pub fn new(ctx: &egui::Context, design: Design, path: Option<PathBuf>, services: Services) -> Self {
        style::install(ctx);
        // A pass that is thrown away and run again would act on its clicks and keys twice.
        ctx.options_mut(|options| options.max_passes = NonZeroUsize::MIN);
        let wake = ctx.clone();
        let session = Session::new(design, path, Arc::new(move || wake.request_repaint()), services);
        style::set_theme(ctx, session.look.theme);
        let tools = Toolbox::new(&session);
        Self {
            session,
            timeline: Default::default(),
            palette: Default::default(),
            start: Default::default(),
            dialogs: Default::default(),
            inspector: Default::default(),
            views: viewport::State::default(),
            sheet: canvas::State::default(),
            tools,
            pacing: Pacing::default(),
            focus: Focus::default(),
            title: String::new(),
            said: 0,
            theme: Theme::default(),
            lost: Lost::default(),
        }
    }

    /// Ends, with its work kept, when the adapter is lost.
    pub(super) fn watching(mut self, lost: Lost) -> Self {
        self.lost = lost;
        self
    }

    /// Lets the views draw with the window's renderer, and lets the desktop's dialogs appear.
    pub fn with_window(mut self, state: Option<&egui_wgpu::RenderState>, theme: Theme) -> Self {
        /// eframe's pass has one sample unless it is asked for more.
        const SAMPLES: u32 = 1;
        if let Some(state) = state {
            viewport::renderer::install(state, SAMPLES);
            let wake = self.session.jobs.wake();
            self.lost.watch(state, move || wake());
            self.session.gpu = true;
        }
        self.session.files.native_dialogs = desktop_has_dialogs();
        self.session.look.theme = theme;
        self
    }

    /// Keeps work, settings and recent files in a folder, and offers what was left there.
    pub fn with_store(mut self, ctx: &egui::Context, store: Store) -> Self {
        acts::keep::keep_in(&mut self.session, store);
        style::set_theme(ctx, self.session.look.theme);
        self
    }

    /// In a look, and where that is asked for with a solver that takes its time.
    pub(super) fn measured(mut self, look: &'static str, late: Option<Duration>) -> Self {
        self.session.look.body = look;
        if let Some(late) = late {
            self.session.solver.delay(late);
        }
        self
    }

    /// Speaks the language of the system, until another one is chosen.
    pub fn in_language_of_system(mut self, system: &'static Language) -> Self {
        self.session.look.language.system = system;
        self
    }

    /// Shows the start page over what is open; what was left behind is offered there.
    pub fn with_start_page(mut self) -> Self {
        self.session.files.dialog.take_if(|dialog| *dialog == Dialog::Recover);
        self.session.overlay = Some(Overlay::Start);
        self
    }

    /// With views beside each other, however wide the body is.
    pub fn side_by_side(mut self) -> Self {
        self.session.look.stacks = false;
        self
    }

    /// Where a place in mm was on the screen in the last frame; `None` in a view that is not shown.
    pub fn on_screen(&self, plushie: viewport::Plushie, p: Point) -> Option<egui::Pos2> {
        self.views.on_screen(plushie, p)
    }

    pub fn session(&self) -> &Session {
        &self.session
    }

    /// One frame.
    pub fn update(&mut self, ui: &mut egui::Ui) {
        let ctx = ui.ctx().clone();
        let (now_s, passed_s, hands_off) = ctx
            .input(|i| (i.time, f64::from(i.stable_dt), !i.pointer.any_down() && i.pointer.press_origin().is_none()));
        let typing = ctx.text_edit_focused();
        let touched = ctx.input(egui::InputState::any_touches);
        // In the next frame, for which this is asked.
        let then_s = |i: &egui::InputState| i.time + f64::from(i.stable_dt);
        let holds = ctx.input(|i| i.pointer.press_start_time().is_some_and(|begun| then_s(i) - begun > LONG_TOUCH_S));
        ctx.options_mut(|options| {
            options.input_options.max_click_duration = if touched { LONG_TOUCH_S } else { CLICK_S };
            options.input_options.max_click_dist = if holds && !touched { HELD_PX } else { CLICK_PX };
        });
        // Whatever else Escape means, motors that are driven live stop.
        if ctx.input(|i| i.key_pressed(egui::Key::Escape)) {
            acts::motors::stop(&mut self.session);
        }
        language::speak(self.session.look.language.language());
        let was_drawing = self.tools.is_drawing(&self.session);
        self.session.sketching.waits = was_drawing;
        acts::tick::tick(&mut self.session, now_s, passed_s, hands_off && !typing);

        let mut actions = Vec::new();
        self.tools.follow(&self.session);
        self.tools.keys(&ctx, &self.session, &mut actions);
        keys::collect(&ctx, &self.session, &mut actions);
        self.layout(ui, &mut actions);
        if ctx.input(|i| i.viewport().close_requested()) && !self.session.files.quit {
            actions.push(Action::File(FileAction::Quit));
        }
        self.tools.finish_before(&self.session, &mut actions);
        self.session.sketching.waits = self.tools.is_drawing(&self.session);
        let changed = !actions.is_empty() || self.session.sketching.waits != was_drawing;
        let theme = self.session.look.theme;
        self.theme = theme;
        for action in actions {
            acts::apply::apply(&mut self.session, action);
        }
        // What egui itself moves: folds, scroll bars, switches.
        let moves_s = if self.session.look.still { 0.0 } else { MOVES_S };
        if ctx.global_style().animation_time != moves_s {
            ctx.all_styles_mut(|style| style.animation_time = moves_s);
        }
        if self.session.look.theme != theme {
            style::set_theme(&ctx, self.session.look.theme);
        }
        if let Some(text) = self.session.clipboard.take() {
            ctx.copy_text(text);
        }
        if changed && hands_off {
            acts::keep::remember(&mut self.session);
        }
        // Panels take their places one frame after what is in them has grown or shrunk.
        let said = self.session.messages.list().len();
        if std::mem::replace(&mut self.said, said) != said {
            ctx.request_repaint();
        }
        if changed {
            // So that the solver is asked, and the outcome of the actions seen, without waiting for the pointer.
            ctx.request_repaint();
        }
        self.keep(&ctx);
        self.keep_awake(&ctx);
        self.set_title(&ctx);
        self.guard_closing(&ctx);
        self.focus.paint(&ctx, style::accent(self.session.look.theme));
    }

    fn layout(&mut self, ui: &mut egui::Ui, actions: &mut Vec<Action>) {
        self.overlays(ui.ctx(), actions);
        let session = &self.session;
        let bar = Frame::new().inner_margin(Margin::symmetric(6, 4));
        Panel::top("toolbar").frame(bar).exact_size(42.0).resizable(false).show(ui, |ui| {
            panels::toolbar::show(ui, session, actions);
        });
        Panel::bottom("status").frame(Frame::new()).exact_size(panels::status::HEIGHT).resizable(false).show(
            ui,
            |ui| {
                panels::status::show(ui, session, actions);
            },
        );
        if session.sketching().open {
            let outline = Panel::right("outline").frame(panels::frame()).default_size(288.0).size_range(288.0..=420.0);
            outline.show(ui, |ui| {
                panels::messages::below(ui, session, actions, |ui, actions| {
                    panels::outline::show(ui, session, &mut self.sheet, actions);
                });
            });
            let (tool, entry) = self.tools.tool(session);
            CentralPanel::no_frame()
                .show(ui, |ui| canvas::show(ui, session, &mut self.sheet, tool, t(entry.hint), actions));
            panels::dialogs::show(ui.ctx(), session, &mut self.dialogs, actions);
            return;
        }
        let timeline =
            Panel::bottom("timeline").frame(bar).default_size(132.0).size_range(96.0..=320.0).resizable(true);
        timeline.show(ui, |ui| {
            panels::timeline::show(ui, session, &mut self.timeline, actions);
        });
        let poses = Panel::left("poses").frame(panels::frame()).default_size(220.0).size_range(160.0..=360.0);
        poses.show(ui, |ui| {
            panels::messages::below(ui, session, actions, |ui, actions| panels::poses::show(ui, session, actions));
        });
        let inspector = Panel::right("inspector").frame(panels::frame()).default_size(288.0).size_range(288.0..=420.0);
        inspector.show(ui, |ui| panels::inspector::show(ui, session, &mut self.inspector, actions));
        CentralPanel::no_frame().show(ui, |ui| {
            let (tool, _) = self.tools.tool(session);
            viewport::show(ui, session, &mut self.views, tool, actions);
        });
        panels::dialogs::show(ui.ctx(), session, &mut self.dialogs, actions);
    }

    fn overlays(&mut self, ctx: &egui::Context, actions: &mut Vec<Action>) {
        panels::palette::show(ctx, &self.session, &mut self.palette, actions);
        panels::shortcuts::show(ctx, &self.session, actions);
        panels::log::show(ctx, &self.session, actions);
        panels::start::show(ctx, &self.session, &mut self.start, actions);
    }

    /// Asks for the next frame where something moves by itself; otherwise nothing is drawn until something happens.
    fn keep_awake(&self, ctx: &egui::Context) {
        if self.session.playback.playing {
            ctx.request_repaint();
        }
        // A window that shows nothing is lost, and its motors stop.
        if self.session.motors.remote.is_some() {
            ctx.request_repaint_after(WATCH);
        }
        if let Some(after) = self.session.safety.due {
            ctx.request_repaint_after(after);
        }
        if let Some(seconds) = self.session.messages.next_change_s() {
            ctx.request_repaint_after(Duration::from_secs_f64(seconds.max(0.0)));
        }
    }

    fn set_title(&mut self, ctx: &egui::Context) {
        let mark = if self.session.document.is_modified() { "*" } else { "" };
        let title = format!("Plushwright - {}{mark}", self.session.design().name);
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    /// Keeps what is not saved; where the system ends the program, at once.
    fn keep(&mut self, ctx: &egui::Context) {
        if let Some(size) = ctx.input(|i| i.viewport().inner_rect) {
            acts::keep::sized(&mut self.session, [size.width(), size.height()]);
        }
        let drawing = self.tools.unfinished(&self.session);
        if (acts::keep::is_ending() || self.lost.is()) && !self.session.files.quit {
            acts::keep::end(&mut self.session, drawing);
        } else if !self.session.files.quit {
            acts::keep::keep(&mut self.session, drawing);
        }
    }

    /// Closing with unsaved changes asks first: [`FileAction::Quit`] was among the actions.
    fn guard_closing(&mut self, ctx: &egui::Context) {
        if self.session.files.quit {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        } else if ctx.input(|i| i.viewport().close_requested()) {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            ctx.request_repaint();
        }
    }
}

impl eframe::App for Studio {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.update(ui);
    }

    fn raw_input_hook(&mut self, ctx: &egui::Context, raw_input: &mut egui::RawInput) {
        if self.pacing.pace(&mut raw_input.events) {
            ctx.request_repaint();
        }
    }

    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        style::color32(Palette::of(self.theme).background).to_normalized_gamma_f32()
    }

    fn persist_egui_memory(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::Changes;
    use crate::studio::jobs::{New, Outcome};
    use crate::studio::{blank, services};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable;

    #[test]
    fn a_lost_adapter_does_not_take_the_work_with_it() {
        use crate::studio::keeper::Abandoned;
        use crate::studio::offscreen::Screen;
        let Ok(mut screen) = Screen::new([640, 480], 1.0) else {
            eprintln!("no graphics adapter: nothing could be lost");
            return;
        };
        let folder = tempfile::tempdir().unwrap();
        let store = Store::at(folder.path());
        let ctx = egui::Context::default();
        let design = crate::design::bundled::ALL[0].design().unwrap();
        let studio = Studio::new(&ctx, design, None, services()).with_window(Some(&screen.state), Theme::Light);
        let mut studio = studio.with_store(&ctx, store.clone());
        let mut frame = |studio: &mut Studio| {
            let input = egui::RawInput { screen_rect: Some(screen.rect()), ..Default::default() };
            let output = ctx.run_ui(input, |ui| studio.update(ui));
            screen.draw(&ctx, output, [0.0; 4]);
        };
        frame(&mut studio);
        studio
            .session
            .document
            .history
            .edit("Rename", |design| {
                design.name = "kept".into();
                Ok::<(), crate::design::EditError>(())
            })
            .unwrap();
        frame(&mut studio);
        studio.lost.raise();
        frame(&mut studio);
        assert!(studio.session.files.quit);
        drop(studio);
        let (kept, _) = Abandoned::find(&store);
        assert_eq!(kept.len(), 1);
    }

    #[test]
    fn an_import_that_is_ready_asks_about_what_is_only_being_drawn() {
        let show = |ui: &mut egui::Ui, studio: &mut Option<Studio>| {
            studio.get_or_insert_with(|| Studio::new(ui.ctx(), blank::design(), None, services())).update(ui);
        };
        let mut window = Harness::builder().with_size(egui::vec2(1280.0, 800.0)).build_ui_state(show, None);
        for key in [egui::Key::O, egui::Key::P] {
            window.key_press(key);
            window.step();
        }
        // Two corners: too few to be a part of the drawing.
        let middle = window.get_by_label("Drawing sheet").rect().center();
        for by in [-50.0, 50.0] {
            let corner = middle + egui::vec2(by, 0.0);
            window.hover_at(corner);
            window.step();
            window.drag_at(corner);
            window.step();
            window.drop_at(corner);
            window.step();
        }
        let studio = window.state_mut().as_mut().unwrap();
        assert!(studio.tools.is_drawing(&studio.session) && !studio.session.document.is_modified());
        let design = Design { name: "import".into(), ..blank::design() };
        let new = New { design, changes: Changes::default(), notes: Vec::new(), texture: None };
        studio.session.jobs.start("Import", |_| Outcome::Imported(Ok(Box::new(new))));
        let session = |window: &Harness<'_, Option<Studio>>| {
            let studio = window.state().as_ref().unwrap();
            (studio.session.design().name.clone(), studio.session.files.dialog.clone())
        };
        while session(&window).1.is_none() && session(&window).0 != "import" {
            window.step();
        }
        assert!(matches!(session(&window).1, Some(Dialog::Unsaved(_))));
        // A dialog is measured before it is seen.
        window.step();
        window.get_by_label("Discard changes").click();
        window.step();
        window.step();
        assert_eq!(session(&window).0, "import");
    }
}
