//! The blueprint of a design, a folder that appears whole or not at all.

use super::{Cancelled, Context, Progress};
use crate::design::Design;
pub use crate::fabrication::Options;
use crate::fabrication::{self, ExportError, Manifest};
use std::path::Path;

/// Why there is no blueprint.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Export(#[from] ExportError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Writes the blueprint of `design` in the place of `folder`: of nothing, or of an earlier blueprint. What its maker should know is among
/// the remarks of the manifest.
///
/// # Errors
/// [`Error::Export`], see there; [`Error::Cancelled`]: nothing is written.
pub fn run(design: &Design, folder: &Path, options: &Options, context: &mut Context) -> Result<Manifest, Error> {
    let mut watch = |done: usize, of: usize| {
        context.tell(&Progress::Part { done, of });
        context.check().is_ok()
    };
    fabrication::export_watched(design, folder, options, &mut watch).map_err(|error| match error {
        ExportError::Stopped => Error::Cancelled(Cancelled),
        error => Error::Export(error),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_folder_appears_whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("blueprint");
        let mut design = testing::sample();
        let stopped = run(&design, &path, &Options::default(), &mut Context::new(&AtomicBool::new(true)));
        assert!(matches!(stopped, Err(Error::Cancelled(_))) && !path.exists());
        let go = AtomicBool::new(false);
        let manifest = run(&design, &path, &Options::default(), &mut Context::new(&go)).unwrap();
        assert!(manifest.files.iter().all(|file| path.join(&file.name).is_file()));
        design.networks.clear();
        design.keyframes.clear();
        let nothing = run(&design, &path, &Options::default(), &mut Context::new(&go));
        assert!(matches!(nothing, Err(Error::Export(ExportError::NoNetworks))));
    }
}
