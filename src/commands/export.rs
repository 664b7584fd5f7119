//! `export`: the blueprint, a folder that appears whole or not at all.

use super::document;
use super::error::{CommandError, check_cancel};
use super::output::{say, say_json};
use crate::design::Design;
use crate::fabrication::{self, ExportError, Manifest};
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Write the blueprint: patterns, routings, winch tracks, controller program
///
/// Sheets are SVG in mm with a 100 mm reference line; tracks are in s, mm and encoder counts.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright export pig.plush -o pig-blueprint")]
pub struct Export {
    /// Design file to read; it needs winches (see `plushwright rig`)
    pub design: PathBuf,
    /// Folder to write; an earlier export is replaced, any other folder refused
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Print the manifest: files with sizes in bytes and SHA-256, and remarks
    #[arg(long)]
    pub json: bool,
}

impl Export {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let manifest = export(&design, &self.design, &self.output, cancel)?;
        if self.json {
            return say_json(out, &manifest);
        }
        for file in &manifest.files {
            say(out, &format!("{:8} bytes  {}", file.bytes, self.output.join(&file.name).display()))?;
        }
        for remark in &manifest.remarks {
            say(out, &format!("note: {remark}"))?;
        }
        Ok(())
    }
}

/// Writes the blueprint of `design`, which was read from `source`.
pub fn export(design: &Design, source: &Path, folder: &Path, cancel: &AtomicBool) -> Result<Manifest, CommandError> {
    check_cancel(cancel)?;
    fabrication::export(design, folder, &Default::default()).map_err(|error| match error {
        ExportError::Write { path, source } => CommandError::write(&path, source),
        ExportError::NotOurs { .. } | ExportError::Changed { .. } => CommandError::Usage(error.to_string()),
        error => CommandError::input(source, error),
    })
}
