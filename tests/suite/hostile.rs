//! Every number of a design, replaced by numbers that nobody means: refused by name, or worked on in bounded time to finite results.
//!
//! The suite tries a part. `scripts/hostile` tries all, through the built program.

use plushwright::design::file::{self, TextError};
use plushwright::fabrication::{ExportError, Options, blueprint};
use plushwright::files::folder::FolderError;
use std::fs;
use std::io::Read;
use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Values of which no field of a design takes any.
const SENSELESS: [&str; 5] = ["1e300", "NaN", "inf", "1e9", "4294967295"];
/// Values that some fields take.
const UNUSUAL: [&str; 4] = ["0", "-1", "1e-320", "1e-9"];
/// Of the many numbers of outline and mesh every so manieth is replaced.
const SAMPLED: usize = 40;
/// Longest time of a command.
const PATIENCE: Duration = Duration::from_secs(20);
/// The blueprint of a design that somebody has spoilt may take so many times that of the design as it was.
const MOST_TIMES: u32 = 30;

fn example(name: &str) -> String {
    fs::read_to_string(format!("examples/{name}.plush")).unwrap()
}

/// Where the numbers of a design stand; those of outline and mesh sampled.
fn numbers(text: &str) -> Vec<Range<usize>> {
    let bytes = text.as_bytes();
    let body = text.find("\n    outline:").unwrap_or(text.len());
    let (mut found, mut at, mut quoted, mut skipped) = (Vec::new(), 0, false, 0);
    while at < bytes.len() {
        let (here, before) = (bytes[at], if at == 0 { b' ' } else { bytes[at - 1] });
        quoted ^= here == b'"';
        let starts = here.is_ascii_digit() || (here == b'-' && bytes.get(at + 1).is_some_and(u8::is_ascii_digit));
        if quoted || !starts || before.is_ascii_alphanumeric() {
            at += 1;
            continue;
        }
        let length = bytes[at..].iter().take_while(|b| b.is_ascii_alphanumeric() || b".-+".contains(b)).count();
        skipped += 1;
        if at < body || skipped % SAMPLED == 0 {
            found.push(at..at + length);
        }
        at += length;
    }
    found
}

fn replaced(text: &str, place: &Range<usize>, value: &str) -> String {
    format!("{}{value}{}", &text[..place.start], &text[place.end..])
}

/// What stands around a number, to be told in a failure.
fn around<'a>(text: &'a str, place: &Range<usize>) -> &'a str {
    let start = text[..place.start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[place.end..].find('\n').map_or(text.len(), |at| place.end + at);
    text[start..end].trim()
}

/// Whether a text holds a number that is none.
fn is_finite(text: &str) -> bool {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    !words.into_iter().any(|word| matches!(word, "NaN" | "inf" | "nan" | "null"))
}

/// The texts of a file: all of it, or what a PDF has packed. Bytes that are no text may spell anything.
fn written(bytes: &[u8]) -> Vec<String> {
    if !bytes.starts_with(b"%PDF") {
        return String::from_utf8(bytes.to_vec()).into_iter().collect();
    }
    let starts = bytes.windows(7).enumerate().filter(|(_, word)| *word == b"stream\n" || *word == b"stream\r");
    let unpacked = starts.filter_map(|(at, _)| {
        let packed = bytes[at + 7..].strip_prefix(b"\n").unwrap_or(&bytes[at + 7..]);
        let mut text = String::new();
        flate2::read::ZlibDecoder::new(packed).read_to_string(&mut text).ok().map(|_| text)
    });
    unpacked.collect()
}

#[test]
fn what_is_packed_in_a_pdf_is_read() {
    let design = file::parse(&example("e")).unwrap();
    let (files, _) = blueprint(&design, &Options::default()).unwrap();
    let pages = files.iter().find(|file| file.name == "pattern-letter.pdf").expect("there");
    let drawn = written(&pages.bytes).into_iter().filter(|text| text.lines().any(|line| line.ends_with(" l"))).count();
    assert!(drawn >= 3, "{drawn}");
}

#[test]
fn what_no_field_takes_is_refused_by_name_and_the_rest_makes_a_finite_blueprint() {
    for name in ["e", "pig"] {
        let text = example(name);
        let places = numbers(&text);
        assert!(places.len() > 100, "{name}: {}", places.len());
        // In times of what the design as it is takes, so that a slow machine changes nothing.
        let started = worked();
        blueprint(&file::parse(&text).unwrap(), &Options::default()).unwrap();
        let patience = PATIENCE.max(MOST_TIMES * (worked() - started));
        for (k, place) in places.iter().enumerate() {
            for value in SENSELESS {
                let refused = file::parse(&replaced(&text, place, value)).expect_err(around(&text, place));
                if let TextError::Invalid(error) = &refused {
                    assert!(!error.at.is_empty() && error.to_string().len() < 300, "{error}");
                }
            }
            // Nearly all that is accepted takes the same way.
            for value in UNUSUAL.into_iter().filter(|_| k % 4 == 0) {
                let Ok(design) = file::parse(&replaced(&text, place, value)) else { continue };
                let started = worked();
                match blueprint(&design, &Options::default()) {
                    Ok((files, _)) => files.iter().for_each(|file| {
                        assert!(
                            written(&file.bytes).iter().all(|text| is_finite(text)),
                            "{name}, {value} in {}: {}",
                            around(&text, place),
                            file.name
                        );
                    }),
                    Err(ExportError::Folder(FolderError::Write { source, .. })) => panic!("{source}"),
                    Err(refused) => assert!(is_finite(&refused.to_string()), "{refused}"),
                }
                let took = worked() - started;
                assert!(took < patience, "{name}, {value} in {}: {took:?} of {patience:?}", around(&text, place));
            }
        }
    }
}

/// Processor time of this thread: what else the machine does does not count.
fn worked() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// One command on a design, stopped after [`PATIENCE`] of processor time; what is wrong with what came of it.
fn command(program: &Path, folder: &Path, args: &[&str]) -> Result<i32, String> {
    let (out, err) = (folder.join("out.txt"), folder.join("err.txt"));
    // The system stops it: what else the machine does costs nothing, and what waits without working is stopped below.
    let limited = format!("ulimit -t {}; exec \"$0\" \"$@\"", PATIENCE.as_secs());
    let mut shell = Command::new("sh");
    shell.arg("-c").arg(limited).arg(program).args(args).current_dir(folder).stdin(Stdio::null());
    shell.stdout(fs::File::create(&out).unwrap()).stderr(fs::File::create(&err).unwrap());
    let mut child = shell.spawn().unwrap();
    let started = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if started.elapsed() > 10 * PATIENCE {
            child.kill().unwrap();
            child.wait().unwrap();
            return Err(format!("{args:?} takes more than {} s", 10 * PATIENCE.as_secs()));
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let said = fs::read_to_string(out).unwrap() + &fs::read_to_string(&err).unwrap();
    let lines = fs::read_to_string(err).unwrap().lines().count();
    match status.code() {
        Some(code @ (0 | 2 | 3))
            if lines <= 1 && is_finite(&said.replace("NaN is not", "").replace("inf is not", "")) =>
        {
            Ok(code)
        }
        // Stopped by a signal: its time was over.
        None => Err(format!("{args:?} takes more than {} s of processor time", PATIENCE.as_secs())),
        code => Err(format!("{args:?} ends with {code:?}: {said}")),
    }
}

/// All commands on a design with one number replaced; whether they took it.
fn commands(program: &Path, folder: &Path, text: &str, value: &str) -> Result<bool, String> {
    fs::write(folder.join("x.plush"), text).unwrap();
    let commands: [&[&str]; 3] = [
        &["check", "x.plush", "--json"],
        &["export", "x.plush", "-o", "dir"],
        &["render", "x.plush", "-o", "x.png", "--size", "160x90"],
    ];
    let mut taken = true;
    for args in commands {
        let code = command(program, folder, args)?;
        taken &= code != 2;
        if SENSELESS.contains(&value) && code != 2 {
            return Err(format!("{args:?} accepts it"));
        }
    }
    let files = fs::read_dir(folder.join("dir")).into_iter().flatten().flatten().map(|entry| entry.path());
    for path in files {
        if !written(&fs::read(&path).unwrap()).iter().all(|text| is_finite(text)) {
            return Err(format!("{} is not finite", path.display()));
        }
    }
    let _ = fs::remove_dir_all(folder.join("dir"));
    Ok(taken)
}

/// A design with one number replaced: its name, its text, where the number stands, the value.
type Case<'a> = (&'a str, &'a str, Range<usize>, &'a str);

/// What came of many cases.
#[derive(Default)]
struct Tally {
    tried: usize,
    /// Cases that every command took: these values have a meaning there.
    taken: usize,
    wrong: Vec<String>,
}

/// Every `stride`th of the cases, as many at once as there are processors.
fn try_all(cases: &[Case], stride: usize) -> Tally {
    let folder = tempfile::tempdir().unwrap();
    // The program as it is now: it may be built anew while this runs.
    let program = folder.path().join("plushwright");
    let built = env!("CARGO_BIN_EXE_plushwright");
    // What is being written cannot be run, nor as long as a child of another test has inherited the file.
    fs::hard_link(built, &program).or_else(|_| fs::copy(built, &program).map(drop)).unwrap();
    let (next, tally) = (AtomicUsize::new(0), Mutex::new(Tally::default()));
    let worker = |number: usize| {
        let folder = folder.path().join(number.to_string());
        fs::create_dir(&folder).unwrap();
        while let Some((name, text, place, value)) = cases.get(stride * next.fetch_add(1, Ordering::Relaxed)) {
            let came = commands(&program, &folder, &replaced(text, place, value), value);
            let mut tally = tally.lock().unwrap();
            tally.tried += 1;
            match came {
                Ok(taken) => tally.taken += usize::from(taken),
                Err(why) => {
                    let why = format!("{name}, {value} in `{}`: {why}", around(text, place));
                    eprintln!("{why}");
                    tally.wrong.push(why);
                }
            }
            if tally.tried % 500 == 0 {
                eprintln!("{} of {} designs, {} wrong", tally.tried, cases.len() / stride, tally.wrong.len());
            }
        }
    };
    std::thread::scope(|scope| {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        (0..processors).for_each(|number| {
            drop(scope.spawn({
                let worker = &worker;
                move || worker(number)
            }))
        });
    });
    tally.into_inner().unwrap()
}

#[test]
fn commands_end_soon_with_one_line_whatever_a_number_is() {
    let asked = std::env::var("PLUSHWRIGHT_HOSTILE").ok();
    // A few dozen, spread over fields and values.
    let stride: usize = asked.as_ref().and_then(|every| every.parse().ok()).unwrap_or(61);
    let names: &[&str] = if asked.is_some() { &["e", "pig", "squid"] } else { &["e"] };
    let texts: Vec<(&str, String)> = names.iter().map(|name| (*name, example(name))).collect();
    let mut cases: Vec<Case> = Vec::new();
    for (name, text) in &texts {
        for place in numbers(text) {
            let values = SENSELESS.into_iter().chain(UNUSUAL);
            cases.extend(values.map(|value| (*name, text.as_str(), place.clone(), value)));
        }
    }
    let Tally { tried, taken, wrong } = try_all(&cases, stride);
    eprintln!("{tried} designs tried, {taken} taken by every command, {} wrong", wrong.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
