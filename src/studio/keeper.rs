//! Work that is not saved, written to the state folder every few seconds of change, so that the next window can offer it after a crash, a
//! kill or the end of a session.
//!
//! Every window has a folder of its own there and holds a lock in it, which the system takes back when its process ends, however it
//! ends: a folder that nobody holds is abandoned work.

use super::store::Store;
use crate::design::file;
use crate::design::{Design, texture};
use crate::files::{self, Stamp};
use crate::outline::Drawing;
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime};

/// After this long a change is on the disk. A person loses a gesture or two.
const EVERY: Duration = Duration::from_secs(2);
const DESIGN: &str = "work.plush";
const FACTS: &str = "facts.ron";
const LOCK: &str = "lock";

/// Keeps the work of one window.
pub struct Keeper {
    folder: PathBuf,
    /// Held as long as the window lives.
    _lock: File,
    kept: Option<Arc<Work>>,
    changed: Option<Instant>,
    writing: Option<JoinHandle<Result<(), String>>>,
}

/// Work that is to be kept: a document that is not saved as it is.
#[derive(Clone, Debug)]
pub struct Work {
    pub design: Arc<Design>,
    /// With what is only being drawn yet.
    pub drawing: Option<Drawing>,
    pub facts: Facts,
}

/// The parts that [`Work`] is put together from.
pub struct Sources<'a> {
    pub design: &'a Arc<Design>,
    pub drawing: Option<&'a Drawing>,
    /// [`Facts::path`] and [`Facts::origin`] as they were given.
    pub path: Option<&'a Path>,
    pub origin: Option<&'a Path>,
    pub seen: Option<Stamp>,
    pub is_modified: bool,
}

/// The work of some sources, so that nothing is done in a frame in which they are what they were.
pub struct Revision {
    design: Arc<Design>,
    drawing: Option<Drawing>,
    path: Option<PathBuf>,
    origin: Option<PathBuf>,
    seen: Option<Stamp>,
    is_modified: bool,
    work: Option<Arc<Work>>,
}

/// Where a document belongs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Facts {
    /// The file that it is saved to.
    pub path: Option<PathBuf>,
    /// The file that it was read from: what it names is found from there.
    pub origin: Option<PathBuf>,
    /// The texture that it names.
    pub texture: Option<String>,
    /// The content of that file when it was read.
    pub seen: Option<Stamp>,
}

/// Work that a window left behind.
pub struct Abandoned {
    pub design: Design,
    pub facts: Facts,
    /// When it was kept last.
    pub at: SystemTime,
    folder: PathBuf,
    lock: File,
}

/// The result of [`Keeper::follow`].
pub enum Kept {
    /// All is kept, or there is nothing to keep.
    All,
    /// The next look is due after this long.
    Due(Duration),
    /// It could not be written.
    Failed(String),
}

impl Keeper {
    /// A folder for a new window.
    ///
    /// # Errors
    /// What the system says of a folder that cannot be written to.
    pub fn new(store: &Store) -> io::Result<Self> {
        let folder = tempfile::Builder::new().prefix("window-").tempdir_in(store.folder("work")?)?.keep();
        let lock = File::create(folder.join(LOCK))?;
        lock.try_lock().map_err(io::Error::other)?;
        Ok(Self { folder, _lock: lock, kept: None, changed: None, writing: None })
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Once a frame: writes what has changed when it is time, and clears away what is saved (`None`). `wake` is called when a write has
    /// ended.
    pub fn follow(&mut self, work: Option<Arc<Work>>, wake: impl FnOnce() + Send + 'static) -> Kept {
        if self.writing.as_ref().is_some_and(|writing| !writing.is_finished()) {
            return Kept::Due(EVERY);
        }
        if let Some(Err(why)) = self.join() {
            self.kept = None;
            self.changed = Some(Instant::now());
            return Kept::Failed(why);
        }
        let Some(work) = work else {
            self.changed = None;
            if self.kept.take().is_some() {
                self.clear();
            }
            return Kept::All;
        };
        if self.kept.as_ref().is_some_and(|kept| Arc::ptr_eq(kept, &work) || kept.is(&work)) {
            self.changed = None;
            return Kept::All;
        }
        let waited = self.changed.get_or_insert_with(Instant::now).elapsed();
        if waited < EVERY {
            return Kept::Due(EVERY - waited);
        }
        self.changed = None;
        self.kept = Some(work.clone());
        let folder = self.folder.clone();
        self.writing = Some(std::thread::spawn(move || {
            let done = write(&folder, &work).map_err(|error| error.to_string());
            wake();
            done
        }));
        Kept::All
    }

    /// Writes what there is, now.
    ///
    /// # Errors
    /// Why it could not be written.
    pub fn keep_now(&mut self, work: &Work) -> Result<(), String> {
        self.join();
        write(&self.folder, work).map_err(|error| error.to_string())
    }

    /// The window is closed, and all is saved or not wanted.
    pub fn end(mut self) {
        self.join();
        let _ = fs::remove_dir_all(&self.folder);
    }

    /// Goes on in a folder that another window left behind, so that its work is safe until it is saved.
    pub fn adopt(abandoned: Abandoned) -> (Self, Design, Facts) {
        let Abandoned { design, facts, folder, lock, .. } = abandoned;
        // It is there, and goes once it is saved.
        let kept = Work { design: Arc::new(design.clone()), drawing: None, facts: facts.clone() };
        (Self { folder, _lock: lock, kept: Some(Arc::new(kept)), changed: None, writing: None }, design, facts)
    }

    fn join(&mut self) -> Option<Result<(), String>> {
        let writing = self.writing.take()?;
        Some(writing.join().unwrap_or_else(|_| Err("it broke down".into())))
    }

    /// Nothing is to be recovered. Pictures stay: a document that was recovered is saved with the one that is here, every time.
    fn clear(&self) {
        for name in [DESIGN, FACTS] {
            let _ = fs::remove_file(self.folder.join(name));
        }
    }
}

impl Drop for Keeper {
    /// What is being written is whole before the next window looks.
    fn drop(&mut self) {
        self.join();
    }
}

impl Revision {
    pub fn of(sources: &Sources<'_>) -> Self {
        let &Sources { design, drawing, path, origin, seen, is_modified } = sources;
        let absolute = |path: Option<&Path>| path.and_then(|path| std::path::absolute(path).ok());
        let facts = || Facts { path: absolute(path), origin: absolute(origin), texture: design.texture.clone(), seen };
        let work = || Arc::new(Work { design: design.clone(), drawing: drawing.cloned(), facts: facts() });
        Self {
            design: design.clone(),
            drawing: drawing.cloned(),
            path: path.map(Path::to_path_buf),
            origin: origin.map(Path::to_path_buf),
            seen,
            is_modified,
            work: (is_modified || drawing.is_some()).then(work),
        }
    }

    pub fn is_of(&self, sources: &Sources<'_>) -> bool {
        Arc::ptr_eq(&self.design, sources.design)
            && self.drawing.as_ref() == sources.drawing
            && (self.path.as_deref(), self.origin.as_deref()) == (sources.path, sources.origin)
            && (self.seen, self.is_modified) == (sources.seen, sources.is_modified)
    }

    /// None of a document that is saved as it is.
    pub fn work(&self) -> Option<Arc<Work>> {
        self.work.clone()
    }
}

impl Work {
    fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.design, &other.design) && self.drawing == other.drawing && self.facts == other.facts
    }
}

impl Abandoned {
    /// Work that other windows left behind, the newest last. Folders with nothing in them are cleared away; one that cannot be read
    /// stays, and its path is told.
    pub fn find(store: &Store) -> (Vec<Self>, Vec<PathBuf>) {
        let (mut found, mut unreadable) = (Vec::new(), Vec::new());
        let entries = store.folder("work").and_then(fs::read_dir).into_iter().flatten().flatten();
        for folder in entries.map(|entry| entry.path()).filter(|path| path.is_dir()) {
            let Ok(lock) = File::options().create(true).truncate(false).write(true).open(folder.join(LOCK)) else {
                continue;
            };
            if lock.try_lock().is_err() {
                continue;
            }
            let path = folder.join(DESIGN);
            let Ok(at) = fs::metadata(&path).and_then(|found| found.modified()) else {
                let _ = fs::remove_dir_all(&folder);
                continue;
            };
            let facts = fs::read(folder.join(FACTS)).ok().and_then(|text| ron::de::from_bytes(&text).ok());
            match file::read(&path) {
                Ok(design) => found.push(Self { design, facts: facts.unwrap_or_default(), at, folder, lock }),
                Err(_) => unreadable.push(path),
            }
        }
        found.sort_by_key(|work| work.at);
        (found, unreadable)
    }

    /// The design with the name that its own texture had, where that is still there, and the file from which what it names is found.
    pub fn homed(design: Design, facts: &Facts, folder: &Path) -> (Design, PathBuf) {
        let own = Design { texture: facts.texture.clone(), ..design.clone() };
        if let Some(origin) = &facts.origin
            && matches!(texture::find(&own, origin), Ok(Some(_)))
        {
            return (own, origin.clone());
        }
        (design, folder.join(DESIGN))
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// It is not wanted.
    pub fn discard(self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// The facts first: work without them is still work.
fn write(folder: &Path, work: &Work) -> Result<(), Box<dyn std::error::Error>> {
    let facts = ron::ser::to_string(&work.facts)?;
    files::write(&folder.join(FACTS), facts.as_bytes())?;
    let drawn = work.drawing.clone().map(|drawing| Design { drawing: Some(drawing), ..Design::clone(&work.design) });
    let design = drawn.as_ref().unwrap_or(&work.design);
    file::save(design, work.facts.origin.as_deref().map(Into::into), &folder.join(DESIGN), None)?;
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use crate::studio::blank;

    fn work(name: &str) -> Arc<Work> {
        Arc::new(Work {
            design: Arc::new(Design { name: name.into(), ..blank::design() }),
            drawing: None,
            facts: Facts { path: Some("/x/pig.plush".into()), ..Facts::default() },
        })
    }

    #[test]
    fn work_is_found_when_its_window_is_gone_and_not_before() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::at(folder.path());
        let mut keeper = Keeper::new(&store).unwrap();
        keeper.keep_now(&work("one")).unwrap();
        assert!(Abandoned::find(&store).0.is_empty(), "its window is open");
        drop(keeper);
        let mut found = Abandoned::find(&store).0;
        assert_eq!((found.len(), found[0].design.name.as_str()), (1, "one"));
        assert_eq!(found[0].facts, work("one").facts);
        let (mut keeper, design, _) = Keeper::adopt(found.remove(0));
        assert_eq!(design.name, "one");
        assert!(Abandoned::find(&store).0.is_empty());
        assert!(keeper.folder.join(DESIGN).exists());
        keeper.follow(None, || {});
        assert!(!keeper.folder.join(DESIGN).exists(), "it was saved, and would be offered again");
        keeper.end();
        assert_eq!(fs::read_dir(folder.path().join("work")).unwrap().count(), 0);
    }

    #[test]
    fn a_change_is_written_after_a_while_and_goes_when_it_is_saved() {
        let folder = tempfile::tempdir().unwrap();
        let mut keeper = Keeper::new(&Store::at(folder.path())).unwrap();
        let file = keeper.folder.join(DESIGN);
        let work = work("two");
        assert!(matches!(keeper.follow(Some(work.clone()), || {}), Kept::Due(_)));
        keeper.changed = Instant::now().checked_sub(EVERY);
        assert!(matches!(keeper.follow(Some(work.clone()), || {}), Kept::All));
        assert_eq!(keeper.join(), Some(Ok(())));
        assert_eq!(crate::design::file::read(&file).unwrap().name, "two");
        assert!(matches!(keeper.follow(Some(work), || {}), Kept::All) && keeper.changed.is_none());
        let picture = keeper.folder.join("work.texture.png");
        fs::write(&picture, "skin").unwrap();
        assert!(matches!(keeper.follow(None, || {}), Kept::All));
        assert!(!file.exists() && picture.exists(), "what was recovered names it");
        let folder = keeper.folder.clone();
        keeper.end();
        assert!(!folder.exists());
    }

    #[test]
    fn while_it_is_written_the_next_look_is_due() {
        let folder = tempfile::tempdir().unwrap();
        let mut keeper = Keeper::new(&Store::at(folder.path())).unwrap();
        let (done, wait) = std::sync::mpsc::channel::<()>();
        keeper.writing = Some(std::thread::spawn(move || wait.recv().map_err(|error| error.to_string())));
        assert!(matches!(keeper.follow(Some(work("three")), || {}), Kept::Due(_)), "a failure would not be told");
        done.send(()).unwrap();
        keeper.join();
    }

    #[test]
    fn work_is_put_together_anew_where_its_sources_have_changed() {
        let design = Arc::new(blank::design());
        let drawing = Drawing::default();
        let path = Path::new("/x/pig.plush");
        let saved =
            Sources { design: &design, drawing: None, path: None, origin: None, seen: None, is_modified: false };
        let known = Revision::of(&saved);
        assert!(known.is_of(&saved) && known.work().is_none());
        assert!(!known.is_of(&Sources { design: &Arc::new(blank::design()), ..saved }));
        for other in [
            Sources { is_modified: true, ..saved },
            Sources { drawing: Some(&drawing), ..saved },
            Sources { path: Some(path), is_modified: true, ..saved },
            Sources { seen: Some(Stamp::of(b"x")), is_modified: true, ..saved },
        ] {
            assert!(!known.is_of(&other));
            let work = Revision::of(&other).work().unwrap();
            assert_eq!((work.facts.path.as_deref(), work.facts.seen), (other.path, other.seen));
        }
    }
}
