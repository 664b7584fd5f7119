//! The headless commands: one file a command, each a `clap` argument struct with a `run` function.
//!
//! A command reads its input, works in memory, and writes its outputs last and atomically, so that a failure or an
//! interrupt leaves nothing behind. It prints figures on the writer it is given and returns a [`CommandError`], which
//! knows its exit code and is shown as exactly one line.

mod bench;
mod check;
mod demo;
mod discover;
pub mod document;
mod drawing;
pub mod error;
mod explore;
mod export;
mod key;
mod mesh;
mod network;
mod new;
mod output;
mod place;
mod pose;
mod reading;
mod remesh;
mod render;
mod reshape;
mod rig;
mod solve;
mod table;
mod words;

pub use error::{CommandError, ParseStop};

use clap::{Parser, Subcommand};
use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Design, animate and fabricate cable-driven plush robots.
///
/// Without a command the studio opens, with DESIGN if one is given. Lengths are in mm, y up, with the origin at the lower
/// left corner of the rest silhouette's box.
#[derive(Debug, Parser)]
#[command(
    name = "plushwright",
    version,
    args_conflicts_with_subcommands = true,
    disable_help_subcommand = true,
    after_help = "Exit codes: 0 done, 1 output or internal failure, 2 bad input or usage, 3 not converged (best state \
                  written), 4 display or graphics adapter missing, 130 cancelled.\n\n\
                  Example: plushwright new assets/pig.svg -o pig.plush"
)]
pub struct Cli {
    /// Design file (*.plush) to open in the studio
    pub design: Option<PathBuf>,
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// A headless command.
#[derive(Debug, Subcommand)]
pub enum Command {
    Demo(demo::Demo),
    New(new::New),
    Mesh(mesh::MeshCommand),
    Remesh(remesh::Remesh),
    Reshape(reshape::Reshape),
    Drawing(drawing::DrawingCommand),
    Pose(pose::Pose),
    Rig(rig::Rig),
    Network(network::NetworkCommand),
    Key(key::Key),
    Check(check::Check),
    Export(export::Export),
    Render(render::Render),
    Solve(solve::Solve),
    Discover(discover::Discover),
    Bench(bench::Bench),
}

/// Reads the command line; help and version come back as [`ParseStop::Information`].
///
/// # Errors
/// [`ParseStop`] with help, version, or what is wrong.
pub fn parse(args: impl IntoIterator<Item = OsString>) -> Result<Cli, ParseStop> {
    Cli::try_parse_from(args).map_err(ParseStop::from)
}

/// Runs one command. Figures go to `out`; a raised `cancel` ends it with [`CommandError::Cancelled`].
///
/// # Errors
/// What the command says; its exit code is [`CommandError::code`].
pub fn run(command: &Command, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
    match command {
        Command::Demo(command) => command.run(out, cancel),
        Command::New(command) => command.run(out, cancel),
        Command::Mesh(command) => command.run(out, cancel),
        Command::Remesh(command) => command.run(out, cancel),
        Command::Reshape(command) => command.run(out, cancel),
        Command::Drawing(command) => command.run(out, cancel),
        Command::Pose(command) => command.run(out, cancel),
        Command::Rig(command) => command.run(out, cancel),
        Command::Network(command) => command.run(out, cancel),
        Command::Key(command) => command.run(out, cancel),
        Command::Check(command) => command.run(out, cancel),
        Command::Export(command) => command.run(out, cancel),
        Command::Render(command) => command.run(out, cancel),
        Command::Solve(command) => command.run(out, cancel),
        Command::Discover(command) => command.run(out, cancel),
        Command::Bench(command) => command.run(out, cancel),
    }
}
