//! `solve`: one numerical question, as JSON.

use super::error::CommandError;
use super::output::{read_text, say, write_file};
use super::parts;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Answer a problem file (JSON, SI units: m, N, J)
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright solve problem.json -o answer.json")]
pub struct Solve {
    /// Problem file (`plushwright-problem/1`)
    pub problem: PathBuf,
    /// Answer file to write [default: standard output]
    #[arg(short, long, value_name = "OUT.json")]
    pub output: Option<PathBuf>,
}

impl Solve {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let answer = parts::answer(&read_text(&self.problem)?)?;
        match &self.output {
            Some(path) => write_file(path, answer.as_bytes(), cancel),
            None => say(out, &answer),
        }
    }
}
