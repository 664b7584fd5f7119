//! `plushwright`: opens the studio, or runs one headless command and exits.

use plushwright::commands::{self, Cli, CommandError};
use plushwright::files;
use std::io::Write;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Raised by the first interrupt; every solver checks it.
static CANCEL: AtomicBool = AtomicBool::new(false);

fn main() -> ExitCode {
    let outcome = match commands::parse(std::env::args_os()) {
        Ok(cli) => run(&cli),
        Err(stop) => stop.print(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing is left to tell anybody when standard error itself is gone.
            let _ = writeln!(std::io::stderr(), "plushwright: {}", error.line());
            ExitCode::from(error.code())
        }
    }
}

fn run(cli: &Cli) -> Result<(), CommandError> {
    match &cli.command {
        Some(command) => {
            catch_interrupts()?;
            files::survive_size_limits();
            commands::run(command, &mut std::io::stdout(), &CANCEL)
        }
        None => {
            if let Some(path) = cli.design.as_deref().filter(|path| !path.exists()) {
                // What looks like a design may be a mistyped command.
                return Err(CommandError::input(path, "no such file, and no such command (--help lists them)"));
            }
            open_studio(cli)
        }
    }
}

/// How long an interrupted command may take to stop by itself: a pipe that nobody serves stops never.
const PATIENCE: Duration = Duration::from_secs(3);

/// The first interrupt, or request to end, asks the solvers to stop, so that nothing is left half written; the second one does not wait.
fn catch_interrupts() -> Result<(), CommandError> {
    let end = || {
        files::before_exit();
        let _ = writeln!(std::io::stderr(), "plushwright: {}", CommandError::Cancelled.line());
        std::process::exit(i32::from(CommandError::Cancelled.code()));
    };
    ctrlc::set_handler(move || {
        if CANCEL.swap(true, Ordering::SeqCst) {
            end();
        }
        std::thread::spawn(move || {
            std::thread::sleep(PATIENCE);
            end();
        });
    })
    .map_err(|e| CommandError::Failed(format!("cannot listen for interrupts: {e}")))
}

#[cfg(feature = "studio")]
fn open_studio(cli: &Cli) -> Result<(), CommandError> {
    use plushwright::studio::{self, StudioError};
    let design = cli.design.as_deref().map(commands::document::load).transpose()?;
    files::survive_size_limits();
    studio::run(design, cli.design.clone()).map_err(|error| match error {
        StudioError::Failed(_) => CommandError::Failed(error.to_string()),
        _ => CommandError::Environment(error.to_string()),
    })
}

#[cfg(not(feature = "studio"))]
fn open_studio(_cli: &Cli) -> Result<(), CommandError> {
    Err(CommandError::Environment(
        "this build has no window (feature `studio`); see `plushwright --help` for the headless commands".into(),
    ))
}
