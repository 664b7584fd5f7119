//! What the window keeps between its runs, in the platform's folder for the state of programs (`~/.local/state/plushwright` by the XDG
//! rules): work that was not saved, which files are open, recent files and settings.

use super::canvas::Plushie;
use super::session::Views;
use crate::engine::Quality;
use crate::files::{self, sha256};
use crate::picture::Shown;
use crate::picture::palette::Theme;
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

/// Recent files that are remembered.
const MOST_RECENT: usize = 10;
/// Largest file of settings that is read, bytes.
const MOST_BYTES: u64 = 1 << 20;

/// A folder of state, shared by all windows of a user.
#[derive(Clone, Debug)]
pub struct Store {
    root: PathBuf,
}

/// How the window was left.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    pub dark: Option<bool>,
    /// By its code; that of the system where there is none.
    pub language: Option<String>,
    pub quality: Option<String>,
    pub idealized: Option<bool>,
    pub realizable: Option<bool>,
    pub layers: Shown,
    /// A look by its name.
    pub look: Option<String>,
    pub overlaid: Option<bool>,
    /// Whether the views of wide bodies stand beside each other too.
    pub side_by_side: bool,
    pub cameras_apart: Option<bool>,
    pub rulers: Option<bool>,
    pub onion_skins: Option<bool>,
    /// Ways of working, each as it was left.
    pub still: bool,
    pub snaps: Option<bool>,
    pub drives: bool,
    pub looping: Option<bool>,
    /// Whether the next step is shown.
    pub guided: Option<bool>,
    /// Logical pixels.
    pub window: Option<[f32; 2]>,
    /// The newest first.
    pub recent: Vec<PathBuf>,
}

/// Writes settings down on a thread of its own, as a disk may take longer than a frame. Of several that wait the newest is written; when
/// it is dropped, all is.
pub struct Scribe {
    /// What was handed over last, or was there at first.
    last: Settings,
    /// Until it is dropped.
    send: Option<Sender<Settings>>,
    thread: Option<JoinHandle<()>>,
}

impl Scribe {
    /// `known`: what the store has.
    pub fn new(store: Store, known: Settings) -> Self {
        let (send, receive) = channel();
        let thread = std::thread::spawn(move || write_down(&store, &receive));
        Self { last: known, send: Some(send), thread: Some(thread) }
    }

    /// Has them written, where they are not what was handed over last.
    pub fn remember(&mut self, settings: Settings) {
        if settings == self.last {
            return;
        }
        self.last = settings.clone();
        if let Some(send) = &self.send {
            // Where the thread is gone there is nobody to write; they are a help and no work.
            let _ = send.send(settings);
        }
    }
}

impl Drop for Scribe {
    fn drop(&mut self) {
        self.send = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn write_down(store: &Store, receive: &Receiver<Settings>) {
    while let Ok(settings) = receive.recv() {
        let newest = receive.try_iter().last().unwrap_or(settings);
        // A disk that is full is told about where work is kept.
        let _ = store.remember(&newest);
    }
}

impl Store {
    /// That of the platform; none where there is no home.
    pub fn of_platform() -> Option<Self> {
        files::state_folder().map(Self::at)
    }

    pub fn at(root: impl Into<PathBuf>) -> Self {
        Self { root: root.into() }
    }

    /// Whether a file is in it.
    pub(super) fn holds(&self, file: &Path) -> bool {
        file.starts_with(&self.root)
    }

    /// A folder below, made where it is missing, for this user alone.
    pub(super) fn folder(&self, name: &str) -> io::Result<PathBuf> {
        let folder = self.root.join(name);
        files::make_private(&folder)?;
        Ok(folder)
    }

    /// Says that a file is open here: held until it is dropped. None where another window said so.
    ///
    /// # Errors
    /// What the system says of a folder that cannot be written to.
    pub fn claim(&self, path: &Path) -> io::Result<Option<File>> {
        let path = fs::canonicalize(path)?;
        let name = sha256(path.as_os_str().as_encoded_bytes());
        let file = File::options().create(true).truncate(false).write(true).open(self.folder("open")?.join(name))?;
        Ok(file.try_lock().is_ok().then_some(file))
    }

    /// The settings that were remembered; the defaults where there is nothing or nothing that can be read.
    pub fn settings(&self) -> Settings {
        let text = files::read(&self.root.join("settings.ron"), MOST_BYTES).ok();
        text.and_then(|text| ron::de::from_bytes(&text).ok()).unwrap_or_default()
    }

    /// # Errors
    /// What the system says.
    pub fn remember(&self, settings: &Settings) -> io::Result<()> {
        let text = ron::ser::to_string_pretty(settings, ron::ser::PrettyConfig::new()).map_err(io::Error::other)?;
        files::write(&self.folder("")?.join("settings.ron"), text.as_bytes())
    }
}

impl Settings {
    /// Puts a file at the head of the recent ones.
    pub fn opened(&mut self, path: &Path) {
        let Ok(path) = std::path::absolute(path) else { return };
        self.recent.retain(|other| *other != path);
        self.recent.insert(0, path);
        self.recent.truncate(MOST_RECENT);
    }

    pub fn theme(&self) -> Option<Theme> {
        self.dark.map(|dark| if dark { Theme::Dark } else { Theme::Light })
    }

    pub fn views(&self) -> Views {
        let shows = |shown: Option<bool>| shown.unwrap_or(true);
        match (shows(self.idealized), shows(self.realizable)) {
            (true, false) => Views::Only(Plushie::Idealized),
            (false, true) => Views::Only(Plushie::Realizable),
            _ if self.overlaid == Some(true) => Views::Overlay,
            _ => Views::Both,
        }
    }

    pub fn quality(&self) -> Option<Quality> {
        Quality::ALL.into_iter().find(|quality| self.quality.as_deref() == Some(&format!("{quality:?}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_come_back_and_a_broken_file_does_no_harm() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::at(folder.path().join("state/plushwright"));
        assert_eq!(store.settings(), Settings::default());
        let mut settings = Settings { dark: Some(true), quality: Some("Draft".into()), ..Settings::default() };
        settings.idealized = Some(false);
        for k in 0..2 * MOST_RECENT {
            settings.opened(Path::new(&format!("/a/{}.plush", k % 12)));
        }
        store.remember(&settings).unwrap();
        let read = store.settings();
        assert_eq!(read, settings);
        assert_eq!((read.theme(), read.quality()), (Some(Theme::Dark), Some(Quality::Draft)));
        assert_eq!(read.views(), Views::Only(Plushie::Realizable));
        assert_eq!((read.recent.len(), &read.recent[0]), (MOST_RECENT, &PathBuf::from("/a/7.plush")));
        fs::write(folder.path().join("state/plushwright/settings.ron"), "(dark: maybe").unwrap();
        assert_eq!(store.settings(), Settings::default());
    }

    #[test]
    fn the_newest_settings_are_on_the_disk_when_the_scribe_is_gone_and_nothing_is_written_twice() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::at(folder.path());
        let quality = |k: usize| Settings { quality: Some(k.to_string()), ..Settings::default() };
        let mut scribe = Scribe::new(store.clone(), quality(0));
        for k in 1..50 {
            scribe.remember(quality(k));
        }
        drop(scribe);
        assert_eq!(store.settings(), quality(49));
        // What another window has written since stays until something is set otherwise here.
        let mut scribe = Scribe::new(store.clone(), quality(49));
        store.remember(&quality(7)).unwrap();
        scribe.remember(quality(49));
        drop(scribe);
        assert_eq!(store.settings(), quality(7));
    }

    #[cfg(unix)]
    #[test]
    fn a_file_is_claimed_once_by_whatever_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.plush");
        fs::write(&path, "x").unwrap();
        std::os::unix::fs::symlink(&path, folder.path().join("b.plush")).unwrap();
        let store = Store::at(folder.path().join("state"));
        let first = store.claim(&path).unwrap();
        assert!(first.is_some());
        assert!(store.claim(&folder.path().join("b.plush")).unwrap().is_none());
        drop(first);
        assert!(store.claim(&path).unwrap().is_some());
    }
}
