//! An outline becomes a meshed design.

use super::{Cancelled, Context, FiberCount, MoreFibers};
use crate::design::{Design, MAX_NAME_CHARS, TendonSettings};
use crate::files::is_hidden;
use crate::mesh::{self, Mesh, MeshError, MeshSpec};
use crate::outline::{self, Changes, Import, Imported, Outline, OutlineError};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// How an outline is read and meshed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Name of the design; none: that of a thing without one.
    pub name: String,
    /// How the outline is read and cleaned. Without a height the file's own size counts.
    pub import: Import,
    /// A file's own mesh stays as it is, unless another number is asked for.
    pub fibers: FiberCount,
    /// Whether what the file shows becomes the texture of the plushie.
    pub texture: bool,
}

/// Why a file makes no design.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Outline(#[from] OutlineError),
    #[error(transparent)]
    Mesh(#[from] MeshError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A note for the design's maker besides what was [changed](Changes) in the outline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Note {
    #[error(transparent)]
    MoreFibers(#[from] MoreFibers),
}

/// A design, and what lies between it and the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    pub design: Design,
    pub changes: Changes,
    /// A picture (PNG) to be put beside the design and named in it, where one was asked for.
    pub texture: Option<Vec<u8>>,
    pub notes: Vec<Note>,
}

/// A design with default settings around the outline that the bytes of a file show.
///
/// # Errors
/// The bytes show no outline, or none that can be meshed with so many fibres; [`Error::Cancelled`].
pub fn run(bytes: &[u8], options: &Options, context: &Context) -> Result<Made, Error> {
    context.check()?;
    let imported = outline::import(bytes, &options.import)?;
    let texture = match options.texture {
        true => Some(outline::texture(bytes, &options.import, &imported)?),
        false => None,
    };
    context.check()?;
    let (design, changes, notes) = meshed(imported, options)?;
    context.check()?;
    Ok(Made { design, changes, texture, notes })
}

fn meshed(imported: Imported, options: &Options) -> Result<(Design, Changes, Vec<Note>), Error> {
    let name = named(&options.name);
    let (asked, more) = options.fibers.wanted(None);
    let spec = MeshSpec { tracks: imported.tracks().to_vec(), ..MeshSpec::fibers(asked) };
    let Imported { outline, mesh, changes, drawing, .. } = imported;
    if let (Some((nodes, triangles)), FiberCount::Usual) = (mesh, options.fibers) {
        let mesh = Mesh { nodes, triangles };
        mesh.validate()?;
        return Ok((begun(name, outline, mesh), changes, Vec::new()));
    }
    let (meshed, count) = mesh::build_or_finer(&outline, &spec)?;
    if count != asked && !more {
        return Err(MeshError::Unreachable { asked, nearest: count }.into());
    }
    let notes = if count == asked { Vec::new() } else { vec![MoreFibers { asked, count }.into()] };
    Ok((Design { drawing, ..begun(name, outline, meshed.mesh) }, changes, notes))
}

/// A bare design whose cables rub as much as is guessed.
fn begun(name: String, outline: Outline, mesh: Mesh) -> Design {
    Design { tendons: TendonSettings::begun(), ..Design::new(name, outline, mesh) }
}

/// A name for a design in a file of that name, or made of one: as far as a name can say it.
pub fn name_of(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// A name that a design can have.
fn named(name: &str) -> String {
    let name: String = name.chars().map(|c| if is_hidden(c) { ' ' } else { c }).take(MAX_NAME_CHARS).collect();
    if name.trim().is_empty() { "plushie".to_owned() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::defaults;
    use std::sync::atomic::AtomicBool;

    const OBJ: &[u8] = b"v 0 0 0\nv 100 0 0\nv 100 80 0\nv 0 80 0\nv 50 40 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    const SVG: &[u8] = br#"<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="80mm" viewBox="0 0 120 80">
        <rect width="120" height="80"/></svg>"#;

    fn made(bytes: &[u8], options: &Options) -> Result<Made, Error> {
        run(bytes, options, &Context::new(&AtomicBool::new(false)))
    }

    #[test]
    fn a_file_keeps_its_size_and_its_own_mesh() {
        let height = |made: &Made| made.design.outline.bounding_box().1[1];
        let usual = made(OBJ, &Options::default()).unwrap();
        assert_eq!((usual.design.fiber_routings().len(), height(&usual)), (8, 80.0));
        let more = made(OBJ, &Options { fibers: FiberCount::Exactly(200), ..Options::default() }).unwrap();
        assert!(more.design.fiber_routings().len().abs_diff(200) <= 6);
        let svg = made(SVG, &Options::default()).unwrap();
        assert!((height(&svg) - 80.0).abs() < 1e-3);
        assert!(svg.design.fiber_routings().len().abs_diff(defaults::FIBERS) <= 12 && svg.notes.is_empty());
    }

    #[test]
    fn a_number_of_fibres_is_a_wish_or_a_demand() {
        let few = |fibers| made(SVG, &Options { fibers, ..Options::default() });
        let Err(Error::Mesh(MeshError::Unreachable { asked: 3, nearest })) = few(FiberCount::Exactly(3)) else {
            panic!("{:?}", few(FiberCount::Exactly(3)))
        };
        let wish = few(FiberCount::AtLeast(3)).unwrap();
        assert_eq!(wish.notes, [Note::MoreFibers(MoreFibers { asked: 3, count: nearest })]);
    }

    #[test]
    fn errors_keep_their_kind_and_names_can_be_shown() {
        assert_eq!(made(b"none", &Options::default()), Err(Error::Outline(OutlineError::UnknownFormat)));
        let textured = made(OBJ, &Options { texture: true, ..Options::default() });
        assert!(matches!(textured, Err(Error::Outline(OutlineError::NoTexture(_)))));
        let stopped = run(SVG, &Options::default(), &Context::new(&AtomicBool::new(true)));
        assert_eq!(stopped, Err(Error::Cancelled(Cancelled)));
        assert_eq!(named("pig\u{1b}[2J"), "pig [2J");
        assert_eq!(named(" \n"), "plushie");
        assert_eq!(name_of(Path::new("a/pig.svg")), "pig");
    }
}
