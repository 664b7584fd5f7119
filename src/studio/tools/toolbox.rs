//! The tools in hand: one for the views, one for the sheet.

use super::ALL;
use super::tool::{Drawn, Entry, Tool};
use crate::outline::Drawing;
use crate::studio::action::Sketch;
use crate::studio::action::{Action, Actions, FileAction};
use crate::studio::commands::command::Scope;
use crate::studio::session::Session;
use eframe::egui::{Context, Event, Modifiers, Popup};

/// The tool that is taken for a canvas.
pub fn taken(session: &Session, canvas: Scope) -> &'static Entry {
    let of = || ALL.into_iter().filter(|entry| entry.canvas == canvas);
    of().find(|entry| session.has_taken(entry.id)).or_else(|| of().next()).unwrap_or(ALL[0])
}

pub struct Toolbox {
    views: Held,
    outline: Held,
}

struct Held {
    entry: &'static Entry,
    tool: Box<dyn Tool>,
}

impl Held {
    fn new(entry: &'static Entry) -> Self {
        Self { entry, tool: (entry.make)() }
    }
}

impl Toolbox {
    pub fn new(session: &Session) -> Self {
        let held = |canvas| Held::new(taken(session, canvas));
        Self { views: held(Scope::Views), outline: held(Scope::Outline) }
    }

    /// The tool of the canvas that is shown, and its entry.
    pub fn tool(&mut self, session: &Session) -> (&mut dyn Tool, &'static Entry) {
        let held = if session.sketching().open { &mut self.outline } else { &mut self.views };
        (&mut *held.tool, held.entry)
    }

    /// Once a frame: takes another tool where the session has, and drops what was begun on a canvas that is gone.
    pub fn follow(&mut self, session: &Session) {
        let open = session.sketching().open;
        for (held, canvas, there) in [(&mut self.views, Scope::Views, !open), (&mut self.outline, Scope::Outline, open)]
        {
            let entry = taken(session, canvas);
            if entry.id != held.entry.id || !there && held.tool.waits() {
                *held = Held::new(entry);
            }
        }
    }

    /// Keys that the tool wants, before commands get them.
    pub fn keys(&mut self, ctx: &Context, session: &Session, actions: &mut Actions) {
        if ctx.text_edit_focused() || Popup::is_any_open(ctx) || session.is_covered() {
            return;
        }
        let (tool, _) = self.tool(session);
        ctx.input_mut(|input| {
            input.events.retain(|event| match event {
                Event::Key { key, pressed: true, modifiers: Modifiers::NONE, .. } => !tool.key(session, *key, actions),
                _ => true,
            });
        });
    }

    /// Puts what goes on with the next click into the drawing, before what ends drawing it is done: another tool, a body, a closed
    /// sheet, a saved file. Where there is too little of it, it is dropped.
    pub fn finish_before(&mut self, session: &Session, actions: &mut Actions) {
        if !session.sketching().open || !self.outline.tool.waits() {
            return;
        }
        let ends = |action: &Action| match action {
            Action::Run(command, _) => {
                let is_taken = command.scope == Scope::Outline && command.is_on(session);
                command.ends_drawing && !is_taken
            }
            Action::Sketch(Sketch::Open(false) | Sketch::MakeBody) => true,
            // What was drawn is part of what is saved, or asked about.
            Action::File(FileAction::EditDialog(_) | FileAction::CloseDialog | FileAction::Browse) => false,
            Action::File(_) => true,
            _ => false,
        };
        if let Some(first) = actions.iter().position(ends) {
            let drawn = self.outline.tool.pending(session, 1.0);
            actions.splice(first..first, drawn.into_iter().flat_map(Drawn::actions));
            self.outline = Held::new(self.outline.entry);
        }
    }

    /// Whether something is being drawn on the sheet that is not in the drawing yet.
    pub fn is_drawing(&self, session: &Session) -> bool {
        session.sketching().open && self.outline.tool.is_drawing()
    }

    /// The drawing with what is only being drawn, if anything is.
    pub fn unfinished(&self, session: &Session) -> Option<Drawing> {
        if !self.is_drawing(session) {
            return None;
        }
        self.outline.tool.pending(session, 1.0).map(|drawn| drawn.drawing)
    }
}
