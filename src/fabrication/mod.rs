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

mod folder;
mod readme;

use crate::design::{Design, DesignError};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Name of the list of files, by which a folder is known as an earlier export.
pub const MANIFEST: &str = "manifest.json";
const MANIFEST_FORMAT: &str = "plushwright-blueprint/1";

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

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestFile {
    pub name: String,
    pub bytes: u64,
    /// Lower-case hexadecimal.
    pub sha256: String,
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
    #[error("the design has no winch-tendon networks yet: accept one, or run `plushwright rig`")]
    NoNetworks,
    #[error(transparent)]
    Invalid(#[from] DesignError),
    #[error(
        "the animation has {steps:.0} steps, more than {:.0}: shorten it or lower controller.track_rate_hz",
        tracks::MAX_STEPS
    )]
    TooLong { steps: f64 },
    #[error(
        "winch {winch:?} would have to go to {counts:.0} counts, beyond the controller's {:.0}",
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
    #[error("{} exists and is not an earlier export ({found:?} is in it): choose another folder", path.display())]
    NotOurs { path: PathBuf, found: String },
    #[error("cannot write {}: {source}", path.display())]
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
    let (files, manifest) = blueprint(design)?;
    folder::write(dir, &files)?;
    Ok(manifest)
}

/// Makes all files of the blueprint, the manifest last. The same design gives the same bytes.
pub fn blueprint(design: &Design) -> Result<(Vec<File>, Manifest), ExportError> {
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
    let entry = |f: &File| ManifestFile { name: f.name.into(), bytes: f.bytes.len() as u64, sha256: sha256(&f.bytes) };
    let manifest = Manifest {
        format: MANIFEST_FORMAT.into(),
        design: design.name.clone(),
        files: files.iter().map(entry).collect(),
        remarks,
    };
    let json = serde_json::to_string_pretty(&manifest)
        .map_err(|e| ExportError::Write { path: MANIFEST.into(), source: e.into() })?;
    files.push(File { name: MANIFEST, bytes: (json + "\n").into_bytes() });
    Ok((files, manifest))
}

/// SHA-256 in lower-case hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
