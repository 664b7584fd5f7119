//! `discover`: network discovery on a given activation graph, as JSON.

use super::error::CommandError;
use super::output::{read_text, say, write_file};
use super::parts;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Answer a network file (JSON, SI units: contractions in m)
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright discover network.json -o answer.json")]
pub struct Discover {
    /// Network file (`plushwright-network/1`)
    pub network: PathBuf,
    /// Answer file to write [default: standard output]
    #[arg(short, long, value_name = "OUT.json")]
    pub output: Option<PathBuf>,
}

impl Discover {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let answer = parts::network_answer(&read_text(&self.network)?)?;
        match &self.output {
            Some(path) => write_file(path, answer.as_bytes(), cancel),
            None => say(out, &answer),
        }
    }
}
