//! A picture of both plushies.

use super::posing::{self, solve};
use super::{Cancelled, Context, NoSuchPose, Unbalanced};
use crate::design::animation::{SAME_TIME_S, activations_at, duration_s};
use crate::design::texture::find;
use crate::design::{Design, file};
use crate::engine::{Setpoint, Shape};
use crate::picture::ramp::Bar;
use crate::picture::{self, Texture};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Contents and size of the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    pub what: What,
    /// Width and height, pixels.
    pub size: (u32, u32),
    /// Whether the design's texture is drawn.
    pub texture: bool,
    /// A [look](picture::LOOKS) by its name.
    pub look: String,
}

/// The state of the plushies in the picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum What {
    #[default]
    Rest,
    /// A pose, by its name.
    Pose(String),
    /// The animation at a time, s.
    Time(f64),
}

impl Default for Options {
    fn default() -> Self {
        Self { what: What::Rest, size: (1280, 720), texture: true, look: picture::LOOKS[0].name.to_owned() }
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    NoSuchPose(#[from] NoSuchPose),
    #[error("there is no look `{0}`; there are: {names}", names = looks())]
    NoSuchLook(String),
    #[error("the design has no keyframes to show")]
    NoKeyframes,
    /// A time at which there is no animation, s.
    #[error("the animation goes from {from_s} to {to_s} s; there is nothing at {time_s} s")]
    OutsideTimeline { time_s: f64, from_s: f64, to_s: f64 },
    #[error("{0}")]
    Picture(String),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A note on the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// Drawn without the texture that the design names.
    NoTexture {
        path: PathBuf,
        why: String,
    },
    Unbalanced(Unbalanced),
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NoTexture { path, why } => write!(f, "drawn without its texture {}: {why}", path.display()),
            Self::Unbalanced(unbalanced) => unbalanced.fmt(f),
        }
    }
}

/// A picture (PNG), what is drawn in it, and what is to be known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    pub png: Vec<u8>,
    /// Idealized and realizable.
    pub shapes: [Shape; 2],
    /// What the colours of the look stand for.
    pub bar: Option<Bar>,
    pub notes: Vec<Note>,
}

/// Names of the looks, in a sentence.
fn looks() -> String {
    picture::LOOKS.iter().map(|look| look.name).collect::<Vec<_>>().join(", ")
}

/// Solves both plushies from rest and draws them, idealized left and realizable right. `from`: the file that the design was read
/// from, beside which its texture is.
///
/// # Errors
/// There is no such pose or look, no animation, or none at that time; the picture is too large for the memory; [`Error::Cancelled`].
pub fn run(design: &Design, from: &Path, options: &Options, context: &Context) -> Result<Rendered, Error> {
    if !picture::LOOKS.iter().any(|look| look.name == options.look) {
        return Err(Error::NoSuchLook(options.look.clone()));
    }
    let (setpoint, place) = match &options.what {
        What::Rest => (Setpoint::Targets(Vec::new()), "rest".to_owned()),
        What::Pose(pose) => (Setpoint::Targets(posing::targets(design, pose)?), pose.clone()),
        What::Time(_) if design.keyframes.is_empty() => return Err(Error::NoKeyframes),
        What::Time(time) if !(-SAME_TIME_S..=duration_s(design) + SAME_TIME_S).contains(time) => {
            return Err(Error::OutsideTimeline { time_s: *time, from_s: 0.0, to_s: duration_s(design) });
        }
        What::Time(time) => (Setpoint::Activations(activations_at(design, *time)), format!("{time} s")),
    };
    let mut notes = Vec::new();
    let targets = match &setpoint {
        Setpoint::Targets(targets) => targets.clone(),
        Setpoint::Activations(_) => Vec::new(),
    };
    let shapes = solve(design, setpoint, [true, true], context)?;
    let texture = if options.texture { texture(design, from, &mut notes) } else { None };
    let (png, bar) = picture::png(design, &shapes, &targets, texture.as_ref(), &options.look, options.size)
        .map_err(|error| Error::Picture(error.to_string()))?;
    notes.extend(Unbalanced::of(&place, &shapes).into_iter().map(Note::Unbalanced));
    Ok(Rendered { png, shapes, bar, notes })
}

/// The texture of a design; one that cannot be read is not drawn, and that is noted.
fn texture(design: &Design, from: &Path, notes: &mut Vec<Note>) -> Option<Arc<Texture>> {
    let path = file::texture_path(design, from)?;
    let why = match find(design, from) {
        Ok(None) => return None,
        Ok(Some(path)) => match Texture::read(&path) {
            Ok(texture) => return Some(Arc::new(texture)),
            Err(error) => error.to_string(),
        },
        Err(error) => error.to_string(),
    };
    notes.push(Note::NoTexture { path, why });
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_missing_texture_is_noted_and_what_is_not_there_refused() {
        let folder = tempfile::tempdir().unwrap();
        let from = folder.path().join("a.plush");
        let mut design = testing::sample();
        design.texture = Some("none.png".into());
        let go = AtomicBool::new(false);
        let small = Options { size: (64, 32), ..Options::default() };
        let rendered = run(&design, &from, &small, &Context::new(&go)).unwrap();
        assert!(rendered.png.starts_with(b"\x89PNG"));
        assert!(
            rendered
                .notes
                .iter()
                .any(|note| matches!(note, Note::NoTexture { path, .. } if path.ends_with("none.png")))
        );
        let plain = run(&design, &from, &Options { texture: false, ..small.clone() }, &Context::new(&go)).unwrap();
        assert!(!plain.notes.iter().any(|note| matches!(note, Note::NoTexture { .. })));
        design.keyframes.clear();
        let of = |what| run(&design, &from, &Options { what, ..small.clone() }, &Context::new(&go));
        assert_eq!(of(What::Time(1.0)), Err(Error::NoKeyframes));
        assert!(matches!(of(What::Pose("none".into())), Err(Error::NoSuchPose(_))));
        let stopped = run(&design, &from, &small, &Context::new(&AtomicBool::new(true)));
        assert_eq!(stopped, Err(Error::Cancelled(Cancelled)));
    }
}
