//! `plushwright`: opens the studio, or runs one headless command and exits.

// On Windows a program either has a console or opens none: the one that a double click starts is built with this.
#![cfg_attr(all(windows, feature = "no-console"), windows_subsystem = "windows")]

use plushwright::commands::{self, Cli, CommandError};
use plushwright::files;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Raised by the first interrupt; every solver checks it.
static CANCEL: AtomicBool = AtomicBool::new(false);

fn main() -> ExitCode {
    keep_freed_memory();
    commands::report::on_breakdown();
    let outcome = match commands::parse(std::env::args_os()) {
        Ok(cli) => commands::listen(&cli).and_then(|()| run(&cli)),
        Err(stop) => stop.print(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        // Who reads no further has what was wanted of it.
        Err(CommandError::Print(error)) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            log::debug!("exit code {}: {}", error.code(), error.line());
            // Nothing is left to tell anybody when standard error itself is gone.
            let _ = writeln!(io::stderr(), "plushwright: {}", error.line());
            ExitCode::from(error.code())
        }
    }
}

/// Has the allocator keep up to 256 MB of freed memory. By default glibc gives blocks of more than 128 KiB back to the system at once, and
/// gets them again, page by page, in the next frame of a drag: with a software rasteriser that is a third of the frame (1.2 million page faults
/// in 240 frames of 10 000 fibres; 0.09 million with this). What is kept counts as resident memory of the program.
fn keep_freed_memory() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        const KEPT_BYTES: libc::c_int = 256 << 20;
        // The largest that glibc takes.
        const OF_ITS_OWN_BYTES: libc::c_int = 32 << 20;
        // SAFETY: sets figures of the allocator before there is another thread; a figure that it does not take changes nothing.
        unsafe {
            libc::mallopt(libc::M_TRIM_THRESHOLD, KEPT_BYTES);
            libc::mallopt(libc::M_MMAP_THRESHOLD, OF_ITS_OWN_BYTES);
        }
    }
}

fn run(cli: &Cli) -> Result<(), CommandError> {
    match &cli.command {
        Some(command) => {
            catch_interrupts()?;
            files::survive_size_limits();
            commands::run(command, &mut Heard(io::stdout()), &CANCEL, WINDOW_STUDY)
        }
        None => {
            if let Some(path) = cli.design.as_deref().filter(|path| !path.exists()) {
                // What looks like a design may be a mistyped command.
                return Err(commands::unknown_word(&path.to_string_lossy()));
            }
            open_studio(cli)
        }
    }
}

/// Standard output as far as it is read: where nobody reads on (`| head`), the rest of the work is done all the same.
struct Heard(io::Stdout);

impl Write for Heard {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.0.write(bytes) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(bytes.len()),
            written => written,
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self.0.flush() {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            flushed => flushed,
        }
    }
}

/// How long an interrupted command may take to stop by itself: a pipe that nobody serves stops never.
const PATIENCE: Duration = Duration::from_secs(3);

/// The first interrupt, or request to end, asks the solvers to stop, so that nothing is left half written; what has something to write is
/// waited for. The second one does not wait.
fn catch_interrupts() -> Result<(), CommandError> {
    let end = || {
        files::before_exit();
        let _ = writeln!(io::stderr(), "plushwright: {}", CommandError::Cancelled.line());
        std::process::exit(i32::from(CommandError::Cancelled.code()));
    };
    let interrupted = move || {
        if CANCEL.swap(true, Ordering::SeqCst) {
            end();
        }
        std::thread::spawn(move || {
            std::thread::sleep(PATIENCE);
            while commands::is_keeping() {
                std::thread::sleep(PATIENCE);
            }
            end();
        });
    };
    files::on_interrupt(interrupted).map_err(|e| CommandError::Failed(format!("cannot listen for interrupts: {e}")))
}

#[cfg(feature = "studio")]
const WINDOW_STUDY: Option<commands::WindowStudy<'_>> = Some(&plushwright::studio::measure::run);
#[cfg(not(feature = "studio"))]
const WINDOW_STUDY: Option<commands::WindowStudy<'_>> = None;

#[cfg(feature = "studio")]
fn open_studio(cli: &Cli) -> Result<(), CommandError> {
    use plushwright::studio::{self, StudioError};
    let design = cli.design.as_deref().map(commands::document::load).transpose()?;
    files::survive_size_limits();
    studio::run(design, cli.design.clone(), cli.controls).map_err(|error| match error {
        StudioError::Failed(_) | StudioError::AdapterLost => CommandError::Failed(error.to_string()),
        _ => CommandError::Environment(error.to_string()),
    })
}

#[cfg(not(feature = "studio"))]
fn open_studio(_cli: &Cli) -> Result<(), CommandError> {
    Err(CommandError::Environment(
        "this build has no window (feature `studio`); see `plushwright --help` for the headless commands".into(),
    ))
}
