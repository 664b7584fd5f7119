//! The blueprint of a design: what is cut, how cables run, and what the motors do.
//!
//! Sheets are drawn neutrally in mm ([`drawing`]) and written as SVG ([`svg`]); tables and programs are text.
//! [`blueprint`] makes the files in memory, [`export`] puts them on the disk, all or none.
//!
//! | file | holds |
//! | --- | --- |
//! | `pattern.svg` | front and mirrored back: `cut`, `stitch`, `note`, `reference` |
//! | `routing.svg`, `routing.csv` | holes and tendons; enough for cables pulled by hand |
//! | `tracks.csv` | cable wound by each winch over time; one row of zeros if the design has no keyframes |
//! | `controller-ascii.txt` | the same for controllers of the classic ASCII family |
//! | `README.txt` | how to use the files, and remarks on this design |
//! | `manifest.json` | name, size and SHA-256 of every other file |

pub mod controller;
pub mod drawing;
pub mod pattern;
pub mod routing;
pub mod seam;
pub mod svg;
pub mod tracks;

mod readme;

use crate::design::{Design, DesignError};
use crate::files::folder::{self, FolderError};
use crate::files::shown;
use serde::{Deserialize, Serialize};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

pub use crate::files::folder::{Listed as ManifestFile, MANIFEST};
pub use crate::files::sha256;

const MANIFEST_FORMAT: &str = "plushwright-blueprint/1";
/// What the format of an earlier export begins with, whatever its version.
const ANY_VERSION: &str = "plushwright-blueprint/";

/// What an export consists of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// `plushwright-blueprint/1`.
    pub format: String,
    pub design: String,
    /// Every file but the manifest itself.
    pub files: Vec<ManifestFile>,
    /// What the user should know about this blueprint (a motor too slow, a gap too small, ...).
    pub remarks: Vec<String>,
}

/// One file of a blueprint, in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    pub name: &'static str,
    pub bytes: Vec<u8>,
}

/// Why a design was not exported.
#[derive(Debug, Error)]
pub enum ExportError {
    #[error("the design has no winch-tendon networks yet")]
    NoNetworks,
    #[error(transparent)]
    Invalid(#[from] DesignError),
    #[error(
        "the animation has {steps:.3e} steps, more than {:.0}: shorten it or lower controller.track_rate_hz",
        tracks::MAX_STEPS
    )]
    TooLong { steps: f64 },
    #[error(
        "winch {winch:?} would have to go to {counts:.3e} counts, beyond the controller's {:.0}",
        tracks::MAX_COUNTS
    )]
    TooFar { winch: String, counts: f64 },
    #[error("{winches} winches are more than the {} nodes of the controllers' network", controller::MAX_NODES)]
    TooManyWinches { winches: usize },
    #[error(
        "controller.encoder_lines: 4 x {lines} is more than the {} the controllers take",
        controller::MAX_RESOLUTION
    )]
    EncoderTooFine { lines: u32 },
    #[error("{} exists and is not an earlier export ({found:?} is in it): choose another folder", shown(path))]
    NotOurs { path: PathBuf, found: String },
    #[error("{} exists and {name:?} in it was changed by hand: choose another folder", shown(path))]
    Changed { path: PathBuf, name: String },
    #[error("cannot write {}: {source}", shown(path))]
    Write { path: PathBuf, source: io::Error },
}

impl ExportError {
    /// Whether the design or the folder asked for is at fault, not the machine.
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Write { .. })
    }
}

/// Writes the blueprint of a design as a folder, which appears whole or not at all. An earlier export there is
/// replaced; a folder that holds anything else is refused.
pub fn export(design: &Design, dir: &Path) -> Result<Manifest, ExportError> {
    folder::check(dir, ANY_VERSION)?;
    let (files, manifest) = blueprint(design)?;
    let files: Vec<(&str, &[u8])> = files.iter().map(|file| (file.name, file.bytes.as_slice())).collect();
    folder::write(dir, ANY_VERSION, &files)?;
    Ok(manifest)
}

impl From<FolderError> for ExportError {
    fn from(error: FolderError) -> Self {
        match error {
            FolderError::NotOurs { path, found } => Self::NotOurs { path, found },
            FolderError::Changed { path, name } => Self::Changed { path, name },
            FolderError::Write { path, source } => Self::Write { path, source },
        }
    }
}

/// Makes all files of the blueprint, the manifest last. The same design gives the same bytes.
pub fn blueprint(design: &Design) -> Result<(Vec<File>, Manifest), ExportError> {
    tracks::check(design)?;
    design.validate()?;
    if design.networks.is_empty() {
        return Err(ExportError::NoNetworks);
    }
    let track = tracks::track(design)?;
    let program = controller::ascii_program(design, &track)?;
    let (pattern, mut remarks) = pattern::pattern_sheet(design);
    remarks.extend(readme::motor_remarks(design, &track));
    let mut files: Vec<File> = [
        ("pattern.svg", svg::to_svg(&pattern)),
        ("routing.svg", svg::to_svg(&routing::routing_sheet(design))),
        ("routing.csv", routing::routing_csv(design)),
        ("tracks.csv", track.to_csv(design)),
        ("controller-ascii.txt", program),
        ("README.txt", readme::text(design, &track, &remarks)),
    ]
    .map(|(name, text)| File { name, bytes: text.into_bytes() })
    .into();
    let manifest = Manifest {
        format: MANIFEST_FORMAT.into(),
        design: design.name.clone(),
        files: files.iter().map(|file| ManifestFile::of(file.name, &file.bytes)).collect(),
        remarks,
    };
    let json = serde_json::to_string_pretty(&manifest)
        .map_err(|e| ExportError::Write { path: MANIFEST.into(), source: e.into() })?;
    files.push(File { name: MANIFEST, bytes: (json + "\n").into_bytes() });
    Ok((files, manifest))
}
