//! `man`: pages for the manual, from the same description as `--help`.

use super::Cli;
use super::error::CommandError;
use super::output::write_folder;
use super::usage;
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Print a page for the manual, or write all of them
///
/// `plushwright man rig | man -l -` shows one; packages install them.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright man rig")]
pub struct ManCommand {
    /// Command that the page is of [default: the program]
    #[arg(conflicts_with = "out")]
    pub command: Option<String>,
    /// Folder to write all pages to; an earlier one is replaced, any other folder refused
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Format of the manifest in the folder.
const FORMAT: &str = "plushwright-man/1";

impl ManCommand {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        // Built, so that every command knows the options that all have.
        let mut root = Cli::command().disable_help_subcommand(true);
        root.build();
        if let Some(folder) = &self.out {
            let mut files = vec![("plushwright.1".to_owned(), page(root.clone())?)];
            add_pages(&root, "plushwright", &mut files)?;
            return write_folder(folder, FORMAT, &files, cancel);
        }
        let command = match &self.command {
            None => root,
            Some(name) => {
                let found = root.find_subcommand(name).cloned();
                found.map(|command| titled(command, "plushwright")).ok_or_else(|| usage::unknown_word(name))?
            }
        };
        out.write_all(&page(command)?).map_err(CommandError::Print)
    }
}

/// The pages of all commands below, with those below them.
fn add_pages(command: &Command, above: &str, files: &mut Vec<(String, Vec<u8>)>) -> Result<(), CommandError> {
    for below in command.get_subcommands().filter(|below| !below.is_hide_set() && below.get_name() != "help") {
        let below = titled(below.clone(), above);
        let name = below.get_name().to_owned();
        add_pages(&below, &name, files)?;
        files.push((format!("{name}.1"), page(below)?));
    }
    Ok(())
}

/// `plushwright-rig`: a page's name is that of its file.
fn titled(command: Command, above: &str) -> Command {
    let name = format!("{above}-{}", command.get_name());
    command.disable_help_subcommand(true).name(name)
}

fn page(command: Command) -> Result<Vec<u8>, CommandError> {
    let mut text = Vec::new();
    let rendered = Man::new(command).render(&mut text);
    rendered.map_err(|error| CommandError::Failed(format!("cannot form the page: {error}")))?;
    Ok(text)
}
