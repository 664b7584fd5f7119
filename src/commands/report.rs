//! What a breakdown of the program leaves: a report that a person can read and send. Nothing is sent by itself.

use crate::files::{self, printable, shown, state_folder};
use std::backtrace::Backtrace;
use std::fs;
use std::io::{self, Write};
use std::panic::PanicHookInfo;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Where reports may be sent.
const ADDRESS: &str = concat!(env!("CARGO_PKG_REPOSITORY"), "/issues");
/// The folder of reports in that of the platform.
const FOLDER: &str = "reports";
/// Most reports that are kept: more say nothing new.
const MOST: usize = 20;

/// Libraries whose breakdowns are told by the window.
const DISPLAY: [&str; 3] = ["/winit-", "\\winit-", "/x11-dl-"];

/// Has every breakdown leave a report, and say in a line where it is.
pub fn on_breakdown() {
    std::panic::set_hook(Box::new(|info| {
        // Where a library of the display is missing winit breaks down, which the window takes for what it is.
        if info.location().is_some_and(|place| DISPLAY.iter().any(|library| place.file().contains(library))) {
            return;
        }
        let text = text(info, &Backtrace::force_capture());
        let place =
            info.location().map_or("an unknown place".into(), |place| format!("{}:{}", place.file(), place.line()));
        log::error!("broke down at {place}: {}", message(info));
        let line = match write(&text) {
            Ok(path) => format!(
                "broke down at {place}, which is our fault; what happened is in {}: please read it and send it to {ADDRESS} (nothing is sent by itself)",
                shown(&path)
            ),
            Err(_) => format!("broke down at {place}: {}", message(info)),
        };
        // Nothing is left to tell anybody when standard error itself is gone.
        let _ = writeln!(io::stderr(), "plushwright: {}", printable(&line));
    }));
}

/// Name, version and platform in a line.
pub fn program() -> String {
    let (os, cpu) = (std::env::consts::OS, std::env::consts::ARCH);
    let window = if cfg!(feature = "studio") { "" } else { ", without the window" };
    format!("plushwright {} on {os} {cpu}{window}", env!("CARGO_PKG_VERSION"))
}

/// A time as `2026-11-28 18:46:03 UTC`.
pub fn utc(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO).as_secs();
    let [year, month, day] = date(seconds / 86_400);
    let (hour, minute, second) = (seconds / 3600 % 24, seconds / 60 % 60, seconds % 60);
    format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02} UTC")
}

/// Year, month and day of a number of days since 1970-01-01, in the Gregorian calendar. Years begin in March, so that the day that some
/// lack is the last; 400 of them have 146 097 days.
fn date(days: u64) -> [u64; 3] {
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let (day, month) = (day - (153 * month + 2) / 5 + 1, if month < 10 { month + 3 } else { month - 9 });
    [year + era * 400 + u64::from(month <= 2), month, day]
}

fn message(info: &PanicHookInfo) -> String {
    printable(info.payload_as_str().unwrap_or("no message"))
}

fn text(info: &PanicHookInfo, trace: &Backtrace) -> String {
    let place = info.location().map_or("unknown".into(), ToString::to_string);
    let args: Vec<String> = std::env::args_os().map(|arg| printable(&arg.to_string_lossy())).collect();
    format!(
        "Report of a breakdown of Plushwright\n\n\
         Plushwright met something that it was not made for. This file says what it knows of it; it was not sent anywhere.\n\
         To have it mended, read it, take out what you do not want to show (it names your files), and attach it to a report at\n\
         {ADDRESS}, with the design or the drawing if you may share it.\n\n\
         program  {}\ntime     {}\ncommand  {}\nplace    {place}\nmessage  {}\n\n{trace}\n",
        program(),
        utc(SystemTime::now()),
        args.join(" "),
        message(info)
    )
}

fn write(text: &str) -> io::Result<PathBuf> {
    let nowhere = || io::Error::new(io::ErrorKind::NotFound, "no folder");
    write_in(&state_folder().ok_or_else(nowhere)?.join(FOLDER), text)
}

fn write_in(folder: &Path, text: &str) -> io::Result<PathBuf> {
    files::make_private(folder)?;
    if fs::read_dir(folder)?.count() >= MOST {
        return Err(io::Error::other("there are enough"));
    }
    let stamp = utc(SystemTime::now()).replace([':', ' '], "-");
    let path = folder.join(format!("{stamp}-{}.txt", std::process::id()));
    files::write(&path, text.as_bytes())?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_the_calendar() {
        for (seconds, text) in [
            (0, "1970-01-01 00:00:00 UTC"),
            (951_782_399, "2000-02-28 23:59:59 UTC"),
            (951_782_400, "2000-02-29 00:00:00 UTC"),
            (1_795_891_563, "2026-11-28 18:46:03 UTC"),
            (4_107_542_400, "2100-03-01 00:00:00 UTC"),
        ] {
            assert_eq!(utc(UNIX_EPOCH + Duration::from_secs(seconds)), text);
        }
    }

    #[test]
    fn reports_are_kept_up_to_a_number() {
        let folder = tempfile::tempdir().unwrap();
        let path = write_in(folder.path(), "x").unwrap();
        assert_eq!(fs::read_to_string(path).unwrap(), "x");
        (0..MOST).for_each(|k| fs::write(folder.path().join(k.to_string()), "").unwrap());
        assert!(write_in(folder.path(), "x").is_err());
    }
}
