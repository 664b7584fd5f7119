//! A command: all that the window says of it and does with it, in one place.

use crate::studio::canvas::Hit;
use crate::studio::icons::Icon;
use crate::studio::language::t;
use crate::studio::session::Session;
use eframe::egui::{Key, Modifiers};
use std::fmt;

/// Something that a user can ask for by name. Toolbar, menus, keys, hints, the page of shortcuts and the palette read it from here.
pub struct Command {
    /// Never changes and stands for it alone: `file.save`.
    pub id: &'static str,
    pub label: &'static str,
    /// A sentence about it without its keys, which are added.
    pub tip: &'static str,
    pub icon: Option<Icon>,
    /// Any of these; the first is shown in menus.
    pub keys: &'static [Keys],
    /// Its keys count while text is typed too.
    pub while_typing: bool,
    pub scope: Scope,
    pub places: &'static [Place],
    /// Whether a part that is only being drawn is put into the drawing first.
    pub ends_drawing: bool,
    /// Whether it is on, of one that can be.
    pub on: Option<Ask<bool>>,
    /// Icon, label and tip while it is on, where they differ.
    pub face_on: Option<(Icon, &'static str, &'static str)>,
    /// More than the tip says, as things are.
    pub detail: Ask<Option<String>>,
    /// Why it cannot be done now, if so.
    pub why_not: &'static (dyn Fn(&Session, Hit) -> Option<&'static str> + Send + Sync),
    pub run: &'static (dyn Fn(&mut Session, Hit) + Send + Sync),
}

/// A question about the session.
pub type Ask<T> = &'static (dyn Fn(&Session) -> T + Send + Sync);

/// A key with modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keys {
    pub modifiers: Modifiers,
    pub key: Key,
}

/// Where a command is there at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    Anywhere,
    /// While the plushies are shown.
    Views,
    /// While the outline is drawn.
    Outline,
}

/// Where it is shown besides the palette and the page of shortcuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    FileMenu,
    /// The menu under the pointer in a view.
    ContextMenu,
    /// How the body is shown, over the views.
    LookMenu,
    /// How one looks at it, over the views.
    ViewMenu,
    Toolbar(Group),
}

/// A group of the toolbar, between two lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    File,
    History,
    Tools,
    Shown,
    Views,
    /// On the right.
    Right,
}

impl Command {
    /// One that is there always, has no key and does nothing; to be completed by its fields.
    pub const fn new(id: &'static str, label: &'static str, tip: &'static str) -> Self {
        Self {
            id,
            label,
            tip,
            icon: None,
            keys: &[],
            while_typing: false,
            scope: Scope::Anywhere,
            places: &[],
            ends_drawing: false,
            on: None,
            face_on: None,
            detail: &|_| None,
            why_not: &|_, _| None,
            run: &|_, _| {},
        }
    }

    pub fn is_on(&self, session: &Session) -> bool {
        self.on.is_some_and(|on| on(session))
    }

    /// Whether it is there, enabled or not.
    pub fn applies(&self, session: &Session) -> bool {
        match self.scope {
            Scope::Anywhere => true,
            Scope::Views => !session.sketching().open,
            Scope::Outline => session.sketching().open,
        }
    }

    /// Why it cannot be done with what lies `at` the pointer, if so.
    pub fn refused(&self, session: &Session, at: Hit) -> Option<&'static str> {
        match (self.applies(session), self.scope) {
            (true, _) => (self.why_not)(session, at),
            (false, Scope::Outline) => Some(t("The outline is not being drawn")),
            (false, _) => Some(t("The outline is being drawn")),
        }
    }

    pub fn label(&self, session: &Session) -> &'static str {
        t(self.face(session).map_or(self.label, |face| face.1))
    }

    pub fn icon(&self, session: &Session) -> Option<Icon> {
        self.face(session).map_or(self.icon, |face| Some(face.0))
    }

    /// The sentence about it, with its keys.
    pub fn tip(&self, session: &Session) -> String {
        let tip = self.face(session).map_or(self.tip, |face| face.2);
        self.hint(&(self.detail)(session).unwrap_or_else(|| t(tip).to_owned()))
    }

    /// Words with the keys of this command behind them.
    pub fn hint(&self, words: &str) -> String {
        if self.keys.is_empty() { words.to_owned() } else { format!("{words} ({})", self.keys_text()) }
    }

    /// `Ctrl+Shift+Z or Ctrl+Y`.
    pub fn keys_text(&self) -> String {
        self.keys.iter().map(|keys| keys.text()).collect::<Vec<_>>().join(t(" or "))
    }

    pub fn stands(&self, place: Place) -> bool {
        self.places.contains(&place)
    }

    fn face(&self, session: &Session) -> Option<(Icon, &'static str, &'static str)> {
        self.face_on.filter(|_| self.is_on(session))
    }
}

impl PartialEq for Command {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl fmt::Debug for Command {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id)
    }
}

impl Keys {
    pub const fn plain(key: Key) -> Self {
        Self { modifiers: Modifiers::NONE, key }
    }

    pub const fn shift(key: Key) -> Self {
        Self { modifiers: Modifiers::SHIFT, key }
    }

    /// With Ctrl, or Cmd on a Mac.
    pub const fn ctrl(key: Key) -> Self {
        Self { modifiers: Modifiers::COMMAND, key }
    }

    pub const fn ctrl_shift(key: Key) -> Self {
        Self { modifiers: Modifiers::COMMAND.plus(Modifiers::SHIFT), key }
    }

    pub fn text(self) -> String {
        let ctrl = if cfg!(target_os = "macos") { "Cmd+" } else { t("Ctrl+") };
        let held = [(self.modifiers.command, ctrl), (self.modifiers.shift, t("Shift+"))];
        let held: String = held.into_iter().filter(|(is, _)| *is).map(|(_, name)| name).collect();
        let name = match self.key {
            Key::Plus => t("Plus"),
            Key::Minus => t("Minus"),
            Key::Equals => "=",
            Key::Escape => t("Escape"),
            Key::Enter => t("Enter"),
            Key::Delete => t("Delete"),
            Key::Backspace => t("Backspace"),
            Key::Space => t("Space"),
            Key::PageUp => t("PageUp"),
            Key::PageDown => t("PageDown"),
            key => key.name(),
        };
        held + name
    }
}
