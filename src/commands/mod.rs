//! The headless commands: one file a command, each a `clap` argument struct with a `run` function.
//!
//! A command reads its input, works in memory, and writes its outputs last and atomically, so that a failure or an
//! interrupt leaves nothing behind. It prints figures on the writer it is given and returns a [`CommandError`], which
//! knows its exit code and is shown as exactly one line.

mod arrange;
mod bench;
mod check;
mod completions;
mod demo;
mod discover;
pub mod document;
mod drawing;
pub mod error;
mod explore;
mod export;
mod interrupt;
mod journal;
mod key;
mod man;
mod meant;
mod mesh;
mod network;
mod new;
mod output;
mod picture;
mod place;
mod play;
mod pose;
mod progress;
mod propose;
mod reading;
mod remesh;
mod render;
pub mod report;
mod reshape;
mod retime;
mod rig;
mod search;
mod simulate_controller;
mod solve;
mod starch;
mod table;
mod usage;
mod words;

pub use bench::{WindowOptions, WindowStudy};
pub use error::{CommandError, ParseStop};
pub use interrupt::is_keeping;

use clap::{CommandFactory, Parser, Subcommand};
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
    override_usage = "plushwright [DESIGN]\n       plushwright <COMMAND> ...",
    after_help = "Exit codes: 0 done, 1 output or internal failure, 2 bad input or usage, 3 not converged (best state \
                  written), 4 display or graphics adapter missing, 130 cancelled.\n\n\
                  Example: plushwright new assets/pig.svg -o pig.plush\n\n\
                  Begin with: plushwright demo"
)]
pub struct Cli {
    /// Design file (*.plush) to open in the studio
    pub design: Option<PathBuf>,
    /// Say on standard error what is being done; alone, print the version
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// File to write a log to, line by line
    #[arg(long, value_name = "FILE", global = true)]
    pub log: Option<PathBuf>,
    /// Tell the controls of the window on standard output, whenever they change, for a program that drives it
    #[arg(long, hide = true)]
    pub controls: bool,
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
    Arrange(arrange::Arrange),
    Starch(starch::Starch),
    Propose(propose::Propose),
    Rig(rig::Rig),
    Network(network::NetworkCommand),
    Key(key::Key),
    Retime(retime::Retime),
    Check(check::Check),
    Export(export::Export),
    Play(play::Play),
    SimulateController(simulate_controller::SimulateController),
    Render(render::Render),
    Solve(solve::Solve),
    Discover(discover::Discover),
    Bench(bench::Bench),
    Completions(completions::Completions),
    Man(man::ManCommand),
}

impl Command {
    /// What is shown on a terminal while it works; nothing for what shows its own or is done at once.
    fn work(&self) -> Option<&'static str> {
        Some(match self {
            Self::New(_) => "cleaning and meshing the outline",
            Self::Remesh(_) => "meshing anew",
            Self::Reshape(_) => "meshing the new outline",
            Self::Rig(_) => "looking for winches and tendons",
            Self::Propose(_) => "looking for networks",
            Self::Key(_) => "winding to the pose",
            Self::Check(_) => "posing both plushies",
            Self::Export(_) => "making the blueprint",
            Self::Render(_) => "drawing",
            Self::Solve(_) => "solving",
            Self::Discover(_) => "joining fibres",
            Self::Demo(_) => "making the pig",
            Self::Bench(_) => "measuring",
            Self::Play(_) => "driving the motors",
            Self::Mesh(_)
            | Self::Drawing(_)
            | Self::Pose(_)
            | Self::Arrange(_)
            | Self::Starch(_)
            | Self::Retime(_)
            | Self::Network(_)
            | Self::SimulateController(_)
            | Self::Completions(_)
            | Self::Man(_) => return None,
        })
    }
}

/// Reads the command line; help and version come back as [`ParseStop::Information`].
///
/// # Errors
/// [`ParseStop`] with help, version, or what is wrong.
pub fn parse(args: impl IntoIterator<Item = OsString>) -> Result<Cli, ParseStop> {
    let args: Vec<OsString> = args.into_iter().collect();
    let cli = Cli::try_parse_from(&args).map_err(|error| usage::stop(error, &args, &Cli::command()))?;
    if cli.verbose && cli.command.is_none() && cli.design.is_none() {
        return Cli::try_parse_from(["plushwright", "--version"])
            .map_err(|error| usage::stop(error, &args, &Cli::command()));
    }
    if let (Some(_), Some(design)) = (&cli.command, &cli.design) {
        return Err(ParseStop::Wrong(usage::command_late(design, &args, &Cli::command())));
    }
    Ok(cli)
}

/// For a first word that is no command and no file: what it may have been meant for.
pub fn unknown_word(word: &str) -> CommandError {
    usage::unknown_word(word, &Cli::command())
}

/// Begins the log that was asked for, and keeps what a report of a breakdown needs.
///
/// # Errors
/// The log file cannot be written to.
pub fn listen(cli: &Cli) -> Result<(), CommandError> {
    journal::begin(cli.log.as_deref(), cli.verbose, cli.command.is_none())
}

/// Runs one command. Figures go to `out`; a raised `cancel` ends it with [`CommandError::Cancelled`]. `window`: what the window
/// measures of itself, in a program that has one.
///
/// # Errors
/// What the command says; its exit code is [`CommandError::code`].
pub fn run(
    command: &Command,
    out: &mut dyn Write,
    cancel: &AtomicBool,
    window: Option<WindowStudy<'_>>,
) -> Result<(), CommandError> {
    let _bar = command.work().map(progress::Bar::of);
    match command {
        Command::Demo(command) => command.run(out, cancel),
        Command::New(command) => command.run(out, cancel),
        Command::Mesh(command) => command.run(out, cancel),
        Command::Remesh(command) => command.run(out, cancel),
        Command::Reshape(command) => command.run(out, cancel),
        Command::Drawing(command) => command.run(out, cancel),
        Command::Pose(command) => command.run(out, cancel),
        Command::Arrange(command) => command.run(out, cancel),
        Command::Starch(command) => command.run(out, cancel),
        Command::Propose(command) => command.run(out, cancel),
        Command::Rig(command) => command.run(out, cancel),
        Command::Network(command) => command.run(out, cancel),
        Command::Key(command) => command.run(out, cancel),
        Command::Retime(command) => command.run(out, cancel),
        Command::Check(command) => command.run(out, cancel),
        Command::Export(command) => command.run(out, cancel),
        Command::Play(command) => command.run(out, cancel),
        Command::SimulateController(command) => command.run(out, cancel),
        Command::Render(command) => command.run(out, cancel),
        Command::Solve(command) => command.run(out, cancel),
        Command::Discover(command) => command.run(out, cancel),
        Command::Bench(command) => command.run(out, cancel, window),
        Command::Man(command) => command.run(Cli::command(), out, cancel),
        Command::Completions(command) => command.run(Cli::command(), out),
    }
}
