//! The words of the window, in the language of whoever reads them.
//!
//! English stands where it is used: `t("Add pose")`, and with values in it `tf!("{count} keyframes copied", count)`. Every other language
//! is a file in `assets/languages/` that maps these texts to its own, and a line in [`ALL`]. A text that it lacks is shown in English.
//!
//! - A text in a `static` or `const` is English there, in [`mark`], and goes through [`t`] where it is shown; so do the labels of commands,
//!   tools, panels and of the core's catalogues (layers, looks, materials).
//! - Where one English word has two meanings, the text has a subject before a bar, `t("motors|Line")`, which nobody sees.
//! - The language is that of the thread: [`speak`] is called once a frame, and a job speaks as the thread that started it.

use std::cell::Cell;
use std::collections::HashMap;
use std::fmt::{Display, Write};
use std::sync::LazyLock;

/// A language that the window speaks.
pub struct Language {
    /// By ISO 639: `de`.
    pub code: &'static str,
    /// As its speakers call it.
    pub name: &'static str,
    texts: LazyLock<HashMap<String, String>>,
}

/// The language that the texts are written in, then the others.
pub static ALL: [Language; 2] = [
    Language { code: mark("en"), name: "English", texts: LazyLock::new(HashMap::new) },
    Language {
        code: "de",
        name: "Deutsch",
        texts: LazyLock::new(|| table(include_str!("../../assets/languages/de.ron"))),
    },
];

thread_local! {
    static SPOKEN: Cell<&'static Language> = const { Cell::new(&ALL[0]) };
}

/// The language that was asked for, and that of the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// `None`: as the system.
    pub chosen: Option<&'static Language>,
    /// English where nobody has asked the system.
    pub system: &'static Language,
}

impl Choice {
    pub fn language(self) -> &'static Language {
        self.chosen.unwrap_or(self.system)
    }
}

impl Default for Choice {
    fn default() -> Self {
        Self { chosen: None, system: &ALL[0] }
    }
}

impl Language {
    /// That of a locale (`de`, `de_AT.UTF-8`, `de-CH`; `C` is English); `None` for one that the window does not speak.
    pub fn of(locale: &str) -> Option<&'static Self> {
        let code = locale.split(['_', '-', '.', '@']).next().unwrap_or_default();
        let code = if ["C", "POSIX"].contains(&code) { "en" } else { code };
        ALL.iter().find(|language| language.code.eq_ignore_ascii_case(code))
    }

    /// Its texts by the English ones, in no order.
    pub fn texts(&self) -> impl Iterator<Item = (&str, &str)> {
        self.texts.iter().map(|(english, own)| (english.as_str(), own.as_str()))
    }
}

impl PartialEq for Language {
    fn eq(&self, other: &Self) -> bool {
        self.code == other.code
    }
}

impl Eq for Language {}

impl std::fmt::Debug for Language {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.code)
    }
}

/// The first of the languages that the system prefers and the window speaks; English where it speaks none.
pub fn of_system() -> &'static Language {
    sys_locale::get_locales().find_map(|locale| Language::of(&locale)).unwrap_or(&ALL[0])
}

/// From now on this thread speaks that language.
pub fn speak(language: &'static Language) {
    SPOKEN.set(language);
}

/// What this thread speaks.
pub fn spoken() -> &'static Language {
    SPOKEN.get()
}

/// A text in the language that is spoken.
pub fn t(text: &str) -> &str {
    translated(text).unwrap_or_else(|| text.split_once('|').map_or(text, |(_, shown)| shown))
}

/// A text that goes through [`t`] where it is shown: so the tests know that it has to be in the tables.
pub const fn mark(text: &'static str) -> &'static str {
    text
}

/// What the table of the language has; `None` in English.
pub fn translated(text: &str) -> Option<&'static str> {
    spoken().texts.get(text).map(String::as_str)
}

/// A text with values in the places of their names: `{count}`, and `{mm:.1}` with so many decimals. A name that has no value stays.
pub fn fill(text: &str, values: &[(&str, &dyn Display)]) -> String {
    let mut filled = String::with_capacity(text.len() + 16);
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        filled.push_str(before);
        let Some((place, after)) = after.split_once('}') else {
            filled.push('{');
            rest = after;
            continue;
        };
        let (name, decimals) =
            place.split_once(":.").map_or((place, None), |(name, n)| (name, n.parse::<usize>().ok()));
        // Writing to a string does not fail.
        let _ = match (values.iter().find(|(known, _)| *known == name), decimals) {
            (Some((_, value)), Some(decimals)) => write!(filled, "{value:.decimals$}"),
            (Some((_, value)), None) => write!(filled, "{value}"),
            (None, _) => write!(filled, "{{{place}}}"),
        };
        rest = after;
    }
    filled + rest
}

/// A text with values in it, in the language that is spoken: `tf!("{done} of {all}", done, all = list.len())`. The English one is checked
/// as `format!` does; the tests check that the others have the same places.
macro_rules! tf {
    (@ $name:ident) => { $name };
    (@ $name:ident $value:expr) => { $value };
    ($text:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        match $crate::studio::language::translated($text) {
            None => format!($text, $($name = $crate::studio::language::tf!(@ $name $($value)?)),*),
            Some(text) => $crate::studio::language::fill(
                text,
                &[$((stringify!($name), &$crate::studio::language::tf!(@ $name $($value)?) as &dyn std::fmt::Display)),*],
            ),
        }
    };
}
/// [`tf`] of one or of several, by the number that stands first: `tn!(count = list.len(), "{count} hole", "{count} holes")`.
macro_rules! tn {
    ($count:ident = $number:expr, $one:literal, $many:literal $(, $($values:tt)*)?) => {{
        let $count = $number;
        if $count == 1 {
            $crate::studio::language::tf!($one, $count $(, $($values)*)?)
        } else {
            $crate::studio::language::tf!($many, $count $(, $($values)*)?)
        }
    }};
    ($count:ident, $($rest:tt)*) => { $crate::studio::language::tn!($count = $count, $($rest)*) };
}
pub(crate) use {tf, tn};

/// The texts of a language. A file that cannot be read is none, and the window speaks English: a test reads it.
fn table(source: &str) -> HashMap<String, String> {
    ron::from_str(source).unwrap_or_default()
}
