//! `completions`: what a shell needs to complete commands and options.

use super::Cli;
use super::error::CommandError;
use clap::{Args, CommandFactory};
use clap_complete::Shell;
use std::io::Write;

/// Print completions of commands and options for a shell
///
/// For bash: `plushwright completions bash > ~/.local/share/bash-completion/completions/plushwright`; packages bring them along.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright completions bash")]
pub struct Completions {
    #[arg(value_enum)]
    pub shell: Shell,
}

impl Completions {
    pub fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "plushwright", &mut text);
        out.write_all(&text).map_err(CommandError::Print)
    }
}
