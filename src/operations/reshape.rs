//! Another silhouette for a design that may be posed and rigged already.

use super::{Cancelled, Context, FiberCount, MoreFibers};
use crate::design::Design;
use crate::design::edit::EditError;
use crate::design::reshape::{Body, keep_tracks, reshape};
use crate::mesh::{MeshError, MeshSpec};
use crate::outline::{self, Changes, Drawing, Import, Imported, OutlineError};
use serde::{Deserialize, Serialize};

pub use crate::design::remesh::Report;

/// How the outline is read and meshed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Without a height, a drawing is in the design's own coordinates; any other outline is laid with its lower left corner on that of
    /// the old one.
    pub import: Import,
    pub fibers: FiberCount,
    /// The simulation mesh is this many times finer than that of the fibres.
    pub finer: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { import: Import::default(), fibers: FiberCount::default(), finer: 1 }
    }
}

/// Where the outline comes from.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// The bytes of a file.
    File(&'a [u8]),
    /// In the design's own coordinates.
    Drawing(&'a Drawing),
}

/// Why the design has no such body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Outline(#[from] OutlineError),
    #[error(transparent)]
    Mesh(#[from] MeshError),
    #[error(transparent)]
    Edit(#[from] EditError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A note for the design's maker besides what was [changed](Changes) in the outline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Note {
    #[error(transparent)]
    MoreFibers(#[from] MoreFibers),
}

/// A body, ready to be put in the place of the design's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Reshaped {
    body: Body,
    pub changes: Changes,
    pub notes: Vec<Note>,
}

/// Reads and meshes the outline.
///
/// # Errors
/// There is no outline, or none that can be meshed like that; [`Error::Cancelled`].
pub fn prepare(design: &Design, source: Source, options: &Options, context: &Context) -> Result<Reshaped, Error> {
    context.check()?;
    let mut imported = match source {
        Source::File(bytes) => outline::import(bytes, &options.import)?,
        Source::Drawing(drawing) => drawing.import(&options.import)?,
    };
    // Where a size is asked for the drawing's own coordinates do not count.
    let own_place = imported.drawing.is_some() && !options.import.asks_size();
    let corner = if own_place { imported.drawn_box[0] } else { [0.0; 2] };
    keep_tracks(design, &mut imported);
    let changes = imported.changes.clone();
    let (asked, more) = options.fibers.wanted(Some(design.fiber_routings().len()));
    let of = |imported: Imported, fibers| Body::new(imported, &MeshSpec::fibers(fibers), options.finer, corner);
    let mut notes = Vec::new();
    let body = match of(imported.clone(), asked) {
        Err(MeshError::Unreachable { nearest, .. }) if more && nearest > asked && options.finer <= 1 => {
            notes.push(MoreFibers { asked, count: nearest }.into());
            of(imported, nearest)?
        }
        body => body?,
    };
    context.check()?;
    Ok(Reshaped { body, changes, notes })
}

impl Reshaped {
    /// Gives the design the body. Pins, poses, networks and keyframes stay; what became of them comes back.
    ///
    /// # Errors
    /// None so far; what comes of it is for the caller to validate.
    pub fn apply(self, design: &mut Design) -> Result<Report, EditError> {
        Ok(reshape(design, self.body))
    }
}

/// [`prepare`] and [`Reshaped::apply`] in one; what was read comes back with the report.
///
/// # Errors
/// As both; the design is as it was then.
pub fn run(
    design: &mut Design,
    source: Source,
    options: &Options,
    context: &Context,
) -> Result<(Reshaped, Report), Error> {
    let reshaped = prepare(design, source, options, context)?;
    let report = super::changed(design, |design| reshaped.clone().apply(design))?;
    Ok((reshaped, report))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::bundled;
    use crate::outline::drawing::{Part, Primitive};
    use std::sync::atomic::AtomicBool;

    fn drawing(design: &Design) -> Drawing {
        let mut drawing = Drawing::of(&design.outline);
        let [x, y] = design.mesh.position(&design.pins[0].at, &design.mesh.nodes);
        drawing.parts.push(Part::joined(Primitive::Circle { center: [x, y], radius: 30.0 }));
        drawing
    }

    #[test]
    fn a_drawing_and_its_text_make_the_same_body() {
        let design = bundled::ALL[0].design().unwrap();
        let go = AtomicBool::new(false);
        let drawing = drawing(&design);
        let text = drawing.to_text().unwrap();
        let of = |source: Source| {
            let mut design = design.clone();
            let (reshaped, report) = run(&mut design, source, &Options::default(), &Context::new(&go)).unwrap();
            (design, reshaped, report)
        };
        let (drawn, reshaped, report) = of(Source::Drawing(&drawing));
        assert_eq!((drawn.clone(), reshaped, report.clone()), of(Source::File(text.as_bytes())));
        assert_eq!(drawn.poses.len(), design.poses.len());
        assert_eq!(report.fibers[1], drawn.fiber_routings().len());
    }

    #[test]
    fn a_number_of_fibres_is_a_wish_or_a_demand() {
        let design = bundled::ALL[0].design().unwrap();
        let go = AtomicBool::new(false);
        let drawing = drawing(&design);
        let of = |fibers| {
            let options = Options { fibers, ..Options::default() };
            prepare(&design, Source::Drawing(&drawing), &options, &Context::new(&go))
        };
        assert!(matches!(of(FiberCount::Exactly(3)), Err(Error::Mesh(MeshError::Unreachable { asked: 3, .. }))));
        assert!(matches!(
            of(FiberCount::AtLeast(3)).unwrap().notes[..],
            [Note::MoreFibers(MoreFibers { asked: 3, .. })]
        ));
    }

    #[test]
    fn what_is_no_outline_leaves_the_design() {
        let mut design = bundled::ALL[0].design().unwrap();
        let before = design.clone();
        let go = AtomicBool::new(false);
        let empty = Source::Drawing(&Drawing { parts: Vec::new(), tracks: Vec::new() });
        let refused = run(&mut design, empty, &Options::default(), &Context::new(&go));
        assert!(matches!(refused, Err(Error::Outline(OutlineError::NothingPainted(_)))));
        let stop = AtomicBool::new(true);
        let stopped = run(&mut design, empty, &Options::default(), &Context::new(&stop));
        assert_eq!(stopped, Err(Error::Cancelled(Cancelled)));
        assert_eq!(design, before);
    }
}
