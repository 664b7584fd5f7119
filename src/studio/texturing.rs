//! The texture of the document, read on a thread: once for every file that it names.

use super::jobs::Outcome;
use super::session::Session;
use crate::design::{file, texture};
use crate::files::shown;
use crate::picture::Texture;
use crate::picture::layers::{Layer, Textured};
use std::path::PathBuf;
use std::sync::Arc;

#[derive(Default)]
pub struct Texturing {
    /// The file that was asked for last.
    path: Option<PathBuf>,
    found: Found,
}

#[derive(Default)]
enum Found {
    /// No file, or not yet.
    #[default]
    Nothing,
    Picture(Arc<Texture>),
    /// It is missing or broken, which was said.
    Trouble,
}

impl Session {
    /// The texture of the document, as soon as it is read.
    pub fn texture(&self) -> Option<&Arc<Texture>> {
        match &self.texturing.found {
            Found::Picture(texture) => Some(texture),
            _ => None,
        }
    }

    /// Why a layer of the pictures cannot be shown, if so.
    pub fn cannot_show(&self, layer: &str) -> Option<&'static str> {
        if layer != Textured::NAME {
            return None;
        }
        match self.texturing.found {
            Found::Picture(_) => None,
            Found::Trouble => Some("The texture of this plushie is missing or broken"),
            Found::Nothing if self.texturing.path.is_some() => Some("The texture is being read"),
            Found::Nothing => Some("This plushie has no texture; the import has “Keep the picture as texture”"),
        }
    }

    /// Reads the file that the document names, where that is another one than before.
    pub(super) fn follow_texture(&mut self) {
        // A document keeps to the folder that it was read from, wherever it is saved.
        let from = self.origin.clone().unwrap_or_default();
        let path = file::texture_path(self.design(), &from);
        if path == self.texturing.path {
            return;
        }
        self.texturing = Texturing { path: path.clone(), found: Found::Nothing };
        if let Some(path) = path {
            let design = self.design().clone();
            self.jobs.start("The texture", move |_| {
                let may = texture::find(&design, &from).map_err(|error| error.to_string());
                let texture = may.and_then(|_| Texture::read(&path).map(Arc::new).map_err(|error| error.to_string()));
                Outcome::Textured { path, texture }
            });
        }
    }

    pub(super) fn take_texture(&mut self, path: PathBuf, texture: Result<Arc<Texture>, String>) {
        if self.texturing.path.as_ref() != Some(&path) {
            return;
        }
        self.texturing.found = match texture {
            Ok(texture) => Found::Picture(texture),
            Err(why) => {
                self.messages.warning(format!("The texture {} cannot be shown: {why}", shown(&path)));
                Found::Trouble
            }
        };
    }
}
