//! Another resolution under a design that may be posed and rigged already.

use super::{Cancelled, Context};
use crate::defaults;
use crate::design::edit::{EditError, set_tracks};
use crate::design::remesh::{body, carry};
use crate::design::{Design, FiberSet};
use crate::mesh::{Mesh, MeshError, MeshSpec, Size};
use crate::outline::drawing::Track;
use serde::{Deserialize, Serialize};

pub use crate::design::remesh::Report;

/// Size, tracks and symmetry of the mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    pub size: Size,
    /// The simulation mesh is this many times finer than that of the fibres.
    pub finer: usize,
    /// Lines along which edges shall run, mm, besides those that the design has.
    pub tracks: Vec<Track>,
    /// Whether the design's own tracks stay.
    pub keep_tracks: bool,
    /// Whether the mesh of a symmetric outline is symmetric.
    pub mirror: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { size: Size::Fibers(defaults::FIBERS), finer: 1, tracks: Vec::new(), keep_tracks: true, mirror: true }
    }
}

/// Why there is no such mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Mesh(#[from] MeshError),
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A mesh, ready to be put under the design.
#[derive(Clone, Debug, PartialEq)]
pub struct Remeshed {
    mesh: Mesh,
    fibers: FiberSet,
    /// Where other ones are wanted.
    tracks: Option<Vec<Track>>,
}

/// Makes the mesh.
///
/// # Errors
/// The outline has no such mesh; a track is unsound; [`Error::Cancelled`].
pub fn prepare(design: &Design, options: &Options, context: &Context) -> Result<Remeshed, Error> {
    context.check()?;
    let mut tracks = if options.keep_tracks { design.tracks().to_vec() } else { Vec::new() };
    for track in &options.tracks {
        // The same again changes nothing.
        if !tracks.contains(track) {
            tracks.push(track.clone());
        }
    }
    // An unsound track is told before the work.
    let mut with_tracks = design.clone();
    set_tracks(&mut with_tracks, tracks.clone())?;
    let changed = (with_tracks.tracks() != design.tracks()).then(|| tracks.clone());
    let spec = MeshSpec { size: options.size, tracks, mirror: options.mirror };
    let (mesh, fibers) = body(&design.outline, &spec, options.finer)?;
    context.check()?;
    Ok(Remeshed { mesh, fibers, tracks: changed })
}

impl Remeshed {
    /// Puts the mesh under the design. Pins, poses, networks and keyframes stay; what became of them comes back.
    ///
    /// # Errors
    /// A track is unsound.
    pub fn apply(self, design: &mut Design) -> Result<Report, EditError> {
        if let Some(tracks) = self.tracks {
            set_tracks(design, tracks)?;
        }
        Ok(carry(design, self.mesh, self.fibers))
    }
}

/// [`prepare`] and [`Remeshed::apply`] in one.
///
/// # Errors
/// As both; the design is as it was then.
pub fn run(design: &mut Design, options: &Options, context: &Context) -> Result<Report, Error> {
    let remeshed = prepare(design, options, context)?;
    super::changed(design, |design| remeshed.apply(design)).map_err(Error::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::bundled;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn both_halves_are_the_whole_and_tracks_are_added_once() {
        let design = bundled::ALL[0].design().unwrap();
        let go = AtomicBool::new(false);
        let context = Context::new(&go);
        let [x, y] = design.mesh.position(&design.pins[0].at, &design.mesh.nodes);
        let track = vec![[x, y], [x + 20.0, y + 30.0]];
        let options = Options { size: Size::Fibers(300), tracks: vec![track], ..Options::default() };
        let mut whole = design.clone();
        let report = run(&mut whole, &options, &context).unwrap();
        let mut halves = design.clone();
        assert_eq!(prepare(&design, &options, &context).unwrap().apply(&mut halves).unwrap(), report);
        assert_eq!(whole, halves);
        assert_eq!(whole.tracks().len(), 1);
        run(&mut whole, &options, &context).unwrap();
        assert_eq!(whole.tracks().len(), 1);
        run(&mut whole, &Options { keep_tracks: false, ..Options::default() }, &context).unwrap();
        assert!(whole.tracks().is_empty());
    }

    #[test]
    fn what_cannot_be_meshed_leaves_the_design() {
        let mut design = bundled::ALL[0].design().unwrap();
        let before = design.clone();
        let go = AtomicBool::new(false);
        let wild = Options { size: Size::Fibers(usize::MAX), ..Options::default() };
        assert!(matches!(run(&mut design, &wild, &Context::new(&go)), Err(Error::Mesh(_))));
        let unsound = Options { tracks: vec![vec![[f64::NAN, 0.0], [1.0, 1.0]]], ..Options::default() };
        assert!(matches!(run(&mut design, &unsound, &Context::new(&go)), Err(Error::Edit(_))));
        let stopped = run(&mut design, &Options::default(), &Context::new(&AtomicBool::new(true)));
        assert_eq!(stopped, Err(Error::Cancelled(Cancelled)));
        assert_eq!(design, before);
    }
}
