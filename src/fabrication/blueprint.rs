//! The files of a blueprint: every product by every writer, in memory and on the disk.

use super::buildable;
use super::error::ExportError;
use super::options::Options;
use super::product::{Section, Shared, Source};
use super::products::PRODUCTS;
use super::remark::Remark;
use super::stuffing::compensated;
use super::writers;
use crate::design::Design;
use crate::files::folder::{self, FolderError, Listed, MANIFEST};
use crate::motion::{self, Trajectory};
use serde::{Deserialize, Serialize};
use std::path::Path;

const MANIFEST_FORMAT: &str = "plushwright-blueprint/1";
/// The beginning of the format of an earlier export, whatever its version.
const ANY_VERSION: &str = "plushwright-blueprint/";

/// The contents of an export.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// `plushwright-blueprint/1`.
    pub format: String,
    pub design: String,
    /// Every file but the manifest itself.
    pub files: Vec<Listed>,
    /// Remarks for the user on this blueprint (a motor too slow, a gap too small, ...).
    pub remarks: Vec<Remark>,
}

/// One file of a blueprint, in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    pub name: String,
    pub bytes: Vec<u8>,
}

/// Hears how many parts of how many are made, and says whether the next one is wanted.
pub type Watch<'w> = &'w mut dyn FnMut(usize, usize) -> bool;

/// Writes the blueprint of a design as a folder, which appears whole or not at all. An earlier export there is
/// replaced; a folder that holds anything else is refused.
///
/// # Errors
/// A folder that is not ours or was changed by hand, what [`blueprint`] refuses, and what the system says of the disk.
pub fn export(design: &Design, dir: &Path, options: &Options) -> Result<Manifest, ExportError> {
    export_watched(design, dir, options, &mut |_, _| true)
}

/// [`export`] for somebody who waits for it.
///
/// # Errors
/// As there, and [`ExportError::Stopped`] before anything is written.
pub fn export_watched(
    design: &Design,
    dir: &Path,
    options: &Options,
    watch: Watch<'_>,
) -> Result<Manifest, ExportError> {
    folder::check(dir, ANY_VERSION)?;
    let (files, manifest) = blueprint_watched(design, options, watch)?;
    let files: Vec<(&str, &[u8])> = files.iter().map(|file| (file.name.as_str(), file.bytes.as_slice())).collect();
    folder::write(dir, ANY_VERSION, &files)?;
    Ok(manifest)
}

/// Makes all files of the blueprint, the manifest last. Networks that are switched off are left out, which a remark says. The same design
/// gives the same bytes.
///
/// # Errors
/// A design that is not sound or has no networks, and an animation that the motors cannot be told.
pub fn blueprint(design: &Design, options: &Options) -> Result<(Vec<File>, Manifest), ExportError> {
    blueprint_watched(design, options, &mut |_, _| true)
}

/// [`blueprint`] for somebody who waits for it.
///
/// # Errors
/// As there, and [`ExportError::Stopped`].
pub fn blueprint_watched(
    design: &Design,
    options: &Options,
    watch: Watch<'_>,
) -> Result<(Vec<File>, Manifest), ExportError> {
    let (acting, all) = (design.acting(), design);
    let design = &*acting;
    motion::check(design)?;
    all.validate()?;
    if design.networks.is_empty() {
        return Err(if all.networks.is_empty() { ExportError::NoNetworks } else { ExportError::AllOff });
    }
    buildable::refuse(design)?;
    let trajectory = Trajectory::of(design, options.too_fast)?;
    let shared = Shared::default();
    let cut = options.compensate.then(|| compensated(design));
    let skin = cut.as_ref().and_then(|cut| cut.as_ref().ok()).unwrap_or(design);
    let uncompensated = cut.as_ref().and_then(|cut| cut.as_ref().err());
    let (mut files, mut sections, mut remarks) = (Vec::new(), Vec::new(), Vec::<Remark>::new());
    let off: Vec<&str> = all.muted_names().collect();
    if !off.is_empty() {
        remarks.push(format!("Switched off and left out: {}.", off.join(", ")).into());
    }
    for (done, (topic, make)) in PRODUCTS.iter().enumerate() {
        if !watch(done, PRODUCTS.len()) {
            return Err(ExportError::Stopped);
        }
        if topic.is_some_and(|topic| !options.only.has(topic)) {
            continue;
        }
        let source = Source {
            design,
            skin,
            uncompensated,
            trajectory: &trajectory,
            options,
            sections: &sections,
            remarks: &remarks,
            shared: &shared,
        };
        let part = make(&source)?;
        let written: Vec<File> = part.products.iter().flat_map(writers::written).map(File::from).collect();
        sections.push(Section { files: written.iter().map(|file| file.name.clone()).collect(), guide: part.guide });
        remarks.extend(part.remarks);
        remarks.sort_by_key(|remark| !remark.grave);
        files.extend(written);
    }
    let manifest = Manifest {
        format: MANIFEST_FORMAT.into(),
        design: design.name.clone(),
        files: files.iter().map(|file: &File| Listed::of(&file.name, &file.bytes)).collect(),
        remarks,
    };
    let json = serde_json::to_string_pretty(&manifest)
        .map_err(|e| FolderError::Write { path: MANIFEST.into(), source: e.into() })?;
    files.push(File { name: MANIFEST.into(), bytes: (json + "\n").into_bytes() });
    Ok((files, manifest))
}

impl From<(String, Vec<u8>)> for File {
    fn from((name, bytes): (String, Vec<u8>)) -> Self {
        Self { name, bytes }
    }
}
