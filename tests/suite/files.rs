//! What every command does to the place that it writes to: the old or the new file, whole; one line; nothing left behind.

use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// A bar that is wide enough for a few dozen fibres.
const OUTLINE: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="40mm" viewBox="0 0 120 40">
<rect width="120" height="40" fill="red"/></svg>"#;
pub const PROBLEM: &str = r#"{"format": "plushwright-problem/1",
  "mesh": {"nodes": [[0,0],[1,0],[0,1]], "triangles": [[0,1,2]]}, "material": {"mu": 1.0, "kappa": 1.0}, "contractions": []}"#;
pub const NETWORK: &str = r#"{"format": "plushwright-network/1", "nodes": [[0,0],[1,0],[0,1],[-1,0]],
  "edges": [[0,1],[0,2],[0,3]], "weights": [0.3,0.2,0.1],
  "parameters": {"SEED_NUM": 3, "JOIN_DEPTH": 0, "JOIN_LEN": 1, "TENDON_NUM": 2, "PHI": 1.0}}"#;

/// Every command that writes a file: what it is called with, and where.
const COMMANDS: [(&[&str], &str); 11] = [
    (&["new", "bar.svg", "--fibers", "60", "-o"], "out.plush"),
    (&["new", "bar.svg", "--fibers", "60", "--texture", "-o"], "out.plush"),
    (&["pose", "bar.plush", "--name", "p", "--pin", "5,5", "-o"], "out.plush"),
    (&["key", "bar.plush", "--pose", "bend", "--time", "9", "-o"], "out.plush"),
    (&["remesh", "bar.plush", "--fibers", "80", "-o"], "out.plush"),
    (&["reshape", "bar.plush", "bar.svg", "-o"], "out.plush"),
    (&["drawing", "bar.plush", "-o"], "out.ron"),
    (&["mesh", "bar.plush", "--size", "64x32", "-o"], "out.png"),
    (&["render", "bar.plush", "--size", "64x32", "-o"], "out.png"),
    (&["solve", "problem.json", "-o"], "out.json"),
    (&["discover", "network.json", "-o"], "out.json"),
];

pub fn program(folder: &Path) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_plushwright"));
    program.current_dir(folder).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    program
}

pub fn run(folder: &Path, args: &[&str]) -> Output {
    program(folder).args(args).output().unwrap()
}

#[track_caller]
pub fn succeed(folder: &Path, args: &[&str]) {
    let output = run(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
}

/// The one line on standard error of a command that is refused; it names the place that was asked for.
#[track_caller]
pub fn refused(output: &Output, place: &str) -> String {
    let line = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(matches!(output.status.code(), Some(1 | 2)), "{:?}: {line}", output.status);
    assert!(line.lines().count() == 1 && line.contains(place) && !line.contains(".plushwright-"), "{line}");
    line
}

pub fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A folder with an outline, a design with a winch, a problem and a network.
pub fn place() -> tempfile::TempDir {
    static RIGGED: OnceLock<String> = OnceLock::new();
    let folder = tempfile::tempdir().unwrap();
    let f = folder.path();
    for (name, text) in [("bar.svg", OUTLINE), ("problem.json", PROBLEM), ("network.json", NETWORK)] {
        fs::write(f.join(name), text).unwrap();
    }
    let rigged = RIGGED.get_or_init(|| {
        succeed(f, &["new", "bar.svg", "-o", "bar.plush", "--fibers", "60"]);
        let target = ["--pin", "0,5", "--pin", "0,35", "--target", "115,20=100,36"];
        succeed(f, &[&["pose", "bar.plush", "--name", "bend", "-o", "bar.plush"][..], &target].concat());
        succeed(f, &["rig", "bar.plush", "-o", "bar.plush", "--max-winches", "1", "--tendons", "1"]);
        fs::read_to_string(f.join("bar.plush")).unwrap()
    });
    fs::write(f.join("bar.plush"), rigged).unwrap();
    folder
}

/// For every command: a folder, its arguments, where it writes, and what it writes where nothing is.
fn each(check: impl Fn(&Path, &[&str], &str, &[u8])) {
    for (args, out) in COMMANDS {
        let folder = place();
        let f = folder.path();
        let args = [args, &[out][..]].concat();
        succeed(f, &args);
        let new = fs::read(f.join(out)).unwrap();
        // Other bytes of the same kind: a design stays one.
        fs::write(f.join(out), [&new[..], b"\n"].concat()).unwrap();
        let before = names(f);
        check(f, &args, out, &new);
        assert_eq!(names(f), before, "{args:?}");
    }
}

#[test]
fn a_link_is_followed_and_the_mode_stays() {
    each(|f, args, out, new| {
        fs::create_dir(f.join("far")).unwrap();
        let real = f.join("far").join(out);
        fs::rename(f.join(out), &real).unwrap();
        fs::set_permissions(&real, fs::Permissions::from_mode(0o600)).unwrap();
        symlink(format!("far/{out}"), f.join(out)).unwrap();
        succeed(f, args);
        assert!(f.join(out).is_symlink(), "{args:?}");
        assert_eq!(fs::metadata(&real).unwrap().mode() & 0o7777, 0o600, "{args:?}");
        same(args, &fs::read(&real).unwrap(), new);
        assert_eq!(names(&f.join("far")), [out]);
        // A link to nothing makes what it leads to.
        fs::remove_file(&real).unwrap();
        succeed(f, args);
        assert!(f.join(out).is_symlink() && real.is_file(), "{args:?}");
        fs::remove_dir_all(f.join("far")).unwrap();
    });
}

/// The same file, but for times.
#[track_caller]
fn same(args: &[&str], a: &[u8], b: &[u8]) {
    assert!(a.len().abs_diff(b.len()) < 30, "{args:?}: {} and {} bytes", a.len(), b.len());
}

#[test]
fn another_name_keeps_the_old_content() {
    each(|f, args, out, new| {
        let old = fs::read(f.join(out)).unwrap();
        let parent = f.parent().unwrap().join(format!("{}.other", f.file_name().unwrap().to_string_lossy()));
        fs::hard_link(f.join(out), &parent).unwrap();
        succeed(f, args);
        assert_eq!(fs::read(&parent).unwrap(), old, "{args:?}");
        same(args, &fs::read(f.join(out)).unwrap(), new);
        fs::remove_file(parent).unwrap();
    });
}

#[test]
fn a_read_only_file_a_folder_and_a_full_disk_leave_what_is_there() {
    each(|f, args, out, _| {
        let path = f.join(out);
        let old = fs::read(&path).unwrap();
        // A limit on the size of files does for a disk that is full.
        let shell = ["ulimit -f 0; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_plushwright")];
        let full = Command::new("sh").arg("-c").args(shell).args(args).current_dir(f).output().unwrap();
        refused(&full, out.split_once('.').unwrap().0);
        assert_eq!(fs::read(&path).unwrap(), old, "{args:?}");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
        assert!(refused(&run(f, args), out).contains("read-only"));
        assert_eq!((fs::read(&path).unwrap(), fs::metadata(&path).unwrap().mode() & 0o777), (old, 0o444), "{args:?}");
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        refused(&run(f, args), out);
    });
}

#[test]
fn a_place_that_cannot_be_is_named_as_it_was_asked_for() {
    let folder = place();
    let f = folder.path();
    Command::new("mkfifo").arg(f.join("pipe")).status().unwrap();
    symlink("nowhere", f.join("link")).unwrap();
    for (args, _) in COMMANDS {
        for out in ["none/out", "pipe"] {
            if args.contains(&"--texture") {
                continue;
            }
            let output = run(f, &[args, &[out][..]].concat());
            assert!(refused(&output, out).contains("cannot write"), "{args:?}");
        }
    }
    succeed(f, &["export", "bar.plush", "-o", "link"]);
    assert!(f.join("link").is_symlink() && f.join("nowhere/manifest.json").is_file());
}

#[test]
fn an_interrupt_ends_a_command_that_waits_for_a_pipe() {
    let folder = place();
    let f = folder.path();
    Command::new("mkfifo").arg(f.join("pipe")).status().unwrap();
    let mut child = program(f).args(["solve", "pipe"]).stderr(Stdio::null()).spawn().unwrap();
    // Opened once the other end is: by then interrupts are caught.
    let _pipe = fs::OpenOptions::new().write(true).open(f.join("pipe")).unwrap();
    send("-TERM", &child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
}

#[test]
fn commands_that_change_one_design_at_once_lose_nothing() {
    let folder = place();
    let f = folder.path();
    let start = |time: usize| -> Child {
        let time = (10 + time).to_string();
        let args = ["key", "bar.plush", "--pose", "bend", "--time", &time, "-o", "bar.plush"];
        program(f).args(args).stdout(Stdio::null()).spawn().unwrap()
    };
    let running: Vec<Child> = (0..4).map(start).collect();
    for mut command in running {
        assert!(command.wait().unwrap().success());
    }
    let text = fs::read_to_string(f.join("bar.plush")).unwrap();
    for time in 10..14 {
        assert!(text.contains(&format!("time_s: {time}.0")), "{time} s is lost");
    }
    assert_eq!(names(f), ["bar.plush", "bar.svg", "network.json", "problem.json"]);
}

/// Waits until a process has ended, and kills it with a signal when the time is over.
fn killed(mut child: Child, after: Duration, signal: &str) {
    let since = Instant::now();
    while since.elapsed() < after && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    if child.try_wait().unwrap().is_none() {
        send(signal, &child);
    }
    child.wait().unwrap();
}

/// Sends a signal; the shell does, as a bare machine has no program for it.
fn send(signal: &str, child: &Child) {
    Command::new("sh").args(["-c", &format!("kill {signal} {}", child.id())]).status().unwrap();
}

#[test]
fn killed_in_the_middle_the_old_or_the_new_is_there_whole() {
    let folder = place();
    let f = folder.path();
    fs::copy(f.join("bar.plush"), f.join("other.plush")).unwrap();
    succeed(f, &["key", "other.plush", "--pose", "bend", "--time", "3", "-o", "other.plush"]);
    for (args, out) in
        [(["export", "other.plush", "-o", "dir"], "dir"), (["drawing", "bar.plush", "-o", "file"], "file")]
    {
        let since = Instant::now();
        succeed(f, &args);
        let whole = since.elapsed();
        // An old result that differs from the new one.
        if out == "dir" {
            succeed(f, &["export", "bar.plush", "-o", "dir"]);
        }
        for k in 0..20_u32 {
            let child = program(f).args(args).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            // Most of the kills where the writing is: in the last part.
            let signal = ["-KILL", "-TERM", "-HUP", "-INT"][k as usize % 4];
            killed(child, whole.mul_f64(0.5 + 0.03 * f64::from(k)), signal);
            if out == "dir" {
                let manifest = fs::read(f.join("dir/manifest.json")).expect("never missing");
                let manifest: serde_json::Value = serde_json::from_slice(&manifest).unwrap();
                for file in manifest["files"].as_array().unwrap() {
                    let bytes = fs::metadata(f.join("dir").join(file["name"].as_str().unwrap())).unwrap().len();
                    assert_eq!(file["bytes"].as_u64(), Some(bytes));
                }
            }
            assert!(f.join(out).exists());
        }
        succeed(f, &args);
    }
    let hidden = |name: &String| name.starts_with('.');
    assert!(!names(f).iter().any(hidden), "{:?}", names(f));
}

#[test]
fn a_texture_goes_with_its_design_and_is_nowhere_else() {
    let folder = place();
    let f = folder.path();
    succeed(f, &["new", "bar.svg", "-o", "skin.plush", "--fibers", "60", "--texture"]);
    fs::create_dir(f.join("sub")).unwrap();
    succeed(f, &["pose", "skin.plush", "--name", "p", "--pin", "5,5", "-o", "sub/skin.plush"]);
    assert_eq!(names(&f.join("sub")), ["skin.plush", "skin.texture.png"]);
    // The texture of a design is read too.
    refused(&run(f, &["render", "skin.plush", "-o", "skin.texture.png"]), "skin.texture.png");
    let text = fs::read_to_string(f.join("skin.plush")).unwrap();
    Command::new("mkfifo").arg(f.join("pipe.png")).status().unwrap();
    symlink(f.join("skin.texture.png"), f.join("sub/link.png")).unwrap();
    for texture in ["pipe.png", "/dev/zero", "/etc/passwd", "../skin.texture.png", "link.png", ".", "none.png"] {
        let changed = text.replace("\"skin.texture.png\"", &format!("\"{texture}\""));
        fs::write(f.join("sub/x.plush"), changed).unwrap();
        if texture == "pipe.png" {
            fs::rename(f.join("pipe.png"), f.join("sub/pipe.png")).unwrap();
        }
        let since = Instant::now();
        let output = run(&f.join("sub"), &["render", "x.plush", "-o", "x.png", "--size", "64x32"]);
        assert!(output.status.success() && since.elapsed() < Duration::from_secs(20), "{texture}");
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(said.contains("note: drawn without its texture"), "{texture}: {said}");
    }
}

#[test]
fn what_is_printed_moves_no_cursor_and_makes_no_lines() {
    let folder = place();
    let f = folder.path();
    let text = fs::read_to_string(f.join("bar.plush")).unwrap();
    for bad in ["a\\u{1b}[2Jb", "a\\nplushwright: done", "\\u{9b}31m", "\\u{202e}gip", &"x".repeat(65_536)] {
        fs::write(f.join("x.plush"), text.replace("name: \"bend\"", &format!("name: \"{bad}\""))).unwrap();
        let line = refused(&run(f, &["check", "x.plush"]), "x.plush");
        assert!(line.contains("poses[0].name") && !line.contains('\u{1b}') && line.len() < 200, "{line}");
    }
    // Names of files are anybody's too.
    let name = "x\u{1b}[2J\ny.plush";
    fs::write(f.join(name), &text).unwrap();
    let output = run(f, &["pose", name, "--name", "p", "--pin", "5,5", "-o", name]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && said.lines().count() == 1 && !said.contains('\u{1b}'), "{said}");
    fs::write(f.join("x.plush"), "(version: 1, \"\u{1b}]0;x\u{7}\": 3)").unwrap();
    assert!(!refused(&run(f, &["check", "x.plush"]), "x.plush").contains('\u{1b}'));
}

#[test]
fn a_file_that_is_no_design_is_refused_before_it_costs_anything() {
    let folder = place();
    let f = folder.path();
    fs::File::create(f.join("large.plush")).unwrap().set_len(1 << 30).unwrap();
    fs::write(f.join("deep.plush"), format!("(version: 1, name: {}", "[".repeat(1_000_000))).unwrap();
    Command::new("mkfifo").arg(f.join("pipe.plush")).status().unwrap();
    for name in ["large.plush", "deep.plush", "pipe.plush", "."] {
        refused(&run(f, &["check", name]), name);
    }
    refused(&run(f, &["check", "/dev/zero"]), "/dev/zero");
}
