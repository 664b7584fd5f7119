//! The texture of the document, read on a thread: once for every file that it names.

use crate::design::{file, texture};
use crate::files::shown;
use crate::picture::Texture;
use crate::studio::jobs::Outcome;
use crate::studio::language::{mark, tf};
use crate::studio::session::{Found, Session, Texturing};
use std::path::PathBuf;
use std::sync::Arc;

/// Reads the file that the document names, where that is another one than before.
pub fn follow_texture(session: &mut Session) {
    // A document keeps to the folder that it was read from, wherever it is saved.
    let from = session.document.origin.clone().unwrap_or_default();
    let path = file::texture_path(session.design(), &from);
    if path == session.texturing.path {
        return;
    }
    session.texturing = Texturing { path: path.clone(), found: Found::Nothing };
    if let Some(path) = path {
        let design = session.design().clone();
        session.jobs.start(mark("The texture"), move |_| {
            let may = texture::find(&design, &from).map_err(|error| error.to_string());
            let texture = may.and_then(|_| Texture::read(&path).map(Arc::new).map_err(|error| error.to_string()));
            Outcome::Textured { path, texture }
        });
    }
}

/// The file is read, or cannot be.
pub fn take_texture(session: &mut Session, path: PathBuf, texture: Result<Arc<Texture>, String>) {
    if session.texturing.path.as_ref() != Some(&path) {
        return;
    }
    session.texturing.found = match texture {
        Ok(texture) => Found::Picture(texture),
        Err(why) => {
            session.messages.warning(tf!("The texture {path} cannot be shown: {why}", path = shown(&path), why));
            Found::Trouble
        }
    };
}
