//! `discover`: network discovery on a given activation graph, as JSON.

use super::error::CommandError;
use super::output::{Kind, Output, Replace, json, read_text, say_lines};
use super::solve::unanswered;
use crate::problem::network::{self, NetworkError};
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
    #[command(flatten)]
    pub replace: Replace,
}

impl Discover {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let inputs = || [self.network.clone()];
        let output =
            self.output.as_deref().map(|path| Output::new(path, Kind::Answer, self.replace, inputs())).transpose()?;
        let text = read_text(&self.network)?;
        let (answer, failure) = match network::answer(&text) {
            Ok(answer) => (answer, None),
            Err(error) => {
                let line = error.to_string();
                match error {
                    NetworkError::NoNetwork { answer, .. } => (answer, Some(CommandError::NotConverged(line))),
                    NetworkError::Json { .. } | NetworkError::Key { .. } => {
                        return Err(unanswered(&self.network, line));
                    }
                }
            }
        };
        let mut text = json(&answer)?;
        match output {
            Some(output) => {
                text.push('\n');
                output.write(text.as_bytes(), cancel)?;
            }
            None => say_lines(out, &text)?,
        }
        failure.map_or(Ok(()), Err)
    }
}
