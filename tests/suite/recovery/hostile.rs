//! Files that are no designs, or mean harm: refused, said in a line, and the document stays.

use super::{click, messages, pig, press, type_path, window};
use crate::support::window::{Window, session};
use eframe::egui::{Key, Modifiers};
use plushwright::design::{bundled, file};
use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;
use std::time::{Duration, Instant};

const HOSTILE: [&str; 8] = [
    "late.plush",
    "name.plush",
    "lines.plush",
    "long.plush",
    "deep.plush",
    "large.plush",
    "pipe.plush",
    "device.plush",
];

fn hostile_files() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let text = bundled::ALL[0].text;
    fs::write(at("late.plush"), text.replacen("time_s: 2.0", "time_s: 1e9", 1)).unwrap();
    fs::write(at("name.plush"), text.replacen("ear-and-leg", "a\\u{1b}[2J", 1)).unwrap();
    fs::write(at("lines.plush"), text.replacen("ear-and-leg", "a\\nplushwright: done", 1)).unwrap();
    fs::write(at("long.plush"), text.replacen("ear-and-leg", &"x".repeat(65_536), 1)).unwrap();
    fs::write(at("deep.plush"), format!("(version: 1, name: {}", "[".repeat(1_000_000))).unwrap();
    fs::File::create(at("large.plush")).unwrap().set_len(1 << 30).unwrap();
    Command::new("mkfifo").arg(at("pipe.plush")).status().unwrap();
    symlink("/dev/zero", at("device.plush")).unwrap();
    folder
}

#[test]
fn a_hostile_file_is_refused_and_the_document_stays() {
    let (state, folder) = (tempfile::tempdir().unwrap(), hostile_files());
    let mut window = window(pig(), None, state.path());
    for name in HOSTILE {
        press(&mut window, Modifiers::COMMAND, Key::O);
        type_path(&mut window, &folder.path().join(name));
        press(&mut window, Modifiers::NONE, Key::Enter);
        let said = messages(&window);
        assert!(said.contains(name) && said.len() < 4000 && !said.contains('\u{1b}'), "{name}: {said}");
        assert_eq!(**session(&window).design(), pig());
        click(&mut window, "Cancel");
    }
    // By its size, before a byte of it is read.
    assert!(messages(&window).contains("larger than"));
}

#[test]
fn a_hostile_file_on_the_command_line_is_refused_before_a_window_opens() {
    let folder = hostile_files();
    for name in HOSTILE {
        // Less memory, in KiB, than any of them would take that is read whole and worked on.
        let shell = ["ulimit -v 500000; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_plushwright"), name];
        let mut program = Command::new("sh");
        program.arg("-c").args(shell).current_dir(folder.path()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        let output = program.output().unwrap();
        let line = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{name}: {line}");
        assert!(line.lines().count() == 1 && line.contains(name) && line.len() < 300, "{line}");
        assert!(!line.contains('\u{1b}'), "{line}");
    }
}

/// A PNG of a few bytes that claims to be of that many pixels each way.
fn bomb(pixels: u32) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(1, 1).write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    let mut bytes = bytes.into_inner();
    bytes[16..20].copy_from_slice(&pixels.to_be_bytes());
    bytes[20..24].copy_from_slice(&pixels.to_be_bytes());
    let crc = !bytes[12..29].iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 })
    });
    bytes[29..33].copy_from_slice(&crc.to_be_bytes());
    bytes
}

#[test]
fn a_hostile_texture_is_left_out_and_said() {
    let (state, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let at = |name: &str| folder.path().join(name);
    Command::new("mkfifo").arg(at("pipe.png")).status().unwrap();
    symlink("/dev/zero", at("device.png")).unwrap();
    fs::write(at("bomb.png"), bomb(60_000)).unwrap();
    fs::File::create(at("large.png")).unwrap().set_len(1 << 30).unwrap();
    let mut window = window(bundled::ALL[1].design().unwrap(), None, state.path());
    let textures =
        ["pipe.png", "device.png", "bomb.png", "large.png", "/dev/zero", "../../../../../../etc/passwd", "none.png"];
    for (k, texture) in textures.into_iter().enumerate() {
        let mut design = pig();
        design.texture = Some(texture.into());
        let path = at(&format!("{k}.plush"));
        fs::write(&path, file::to_text(&design).unwrap()).unwrap();
        press(&mut window, Modifiers::COMMAND, Key::O);
        type_path(&mut window, &path);
        press(&mut window, Modifiers::NONE, Key::Enter);
        let started = Instant::now();
        let is_told = |window: &Window| {
            messages(window).lines().any(|line| line.contains(texture) && line.contains("cannot be shown"))
        };
        while !is_told(&window) {
            assert!(started.elapsed() < Duration::from_secs(30), "{texture}: {}", messages(&window));
            window.step();
            std::thread::sleep(Duration::from_millis(20));
        }
        assert!(session(&window).texture().is_none() && session(&window).design().name == "pig", "{texture}");
    }
}
