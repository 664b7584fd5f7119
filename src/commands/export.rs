//! `export`: the blueprint, a folder that appears whole or not at all.

use super::error::{CommandError, check_cancel};
use super::output::{say, say_json};
use super::{document, parts};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Write the blueprint: patterns, routings, winch tracks, controller program
///
/// Sheets are SVG in mm with a 100 mm reference line; tracks are in s, mm and encoder counts.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright export pig.plush -o pig-blueprint")]
pub struct Export {
    /// Design file to read; it needs winches (see `plushwright rig`)
    pub design: PathBuf,
    /// Folder to write; it must not exist yet
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Print the list of files with their sizes in bytes as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Serialize)]
struct Listing {
    folder: String,
    files: Vec<File>,
}

#[derive(Serialize)]
struct File {
    name: String,
    bytes: u64,
}

impl Export {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        if design.networks.is_empty() {
            return Err(CommandError::input(
                &self.design,
                "the design has no winches to export; run `plushwright rig` first",
            ));
        }
        check_cancel(cancel)?;
        parts::export(&design, &self.output)?;
        let listing = self.listing()?;
        if self.json {
            return say_json(out, &listing);
        }
        for file in &listing.files {
            say(out, &format!("{:8}  {}", file.bytes, self.output.join(&file.name).display()))?;
        }
        Ok(())
    }

    fn listing(&self) -> Result<Listing, CommandError> {
        let fail = |e| CommandError::write(&self.output, e);
        let mut files = Vec::new();
        for entry in std::fs::read_dir(&self.output).map_err(fail)? {
            let entry = entry.map_err(fail)?;
            let bytes = entry.metadata().map_err(fail)?.len();
            files.push(File { name: entry.file_name().to_string_lossy().into_owned(), bytes });
        }
        files.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(Listing { folder: self.output.display().to_string(), files })
    }
}
