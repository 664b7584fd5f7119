//! From a silhouette to a folder for the workshop: `cargo run --release --example outline_to_blueprint [FOLDER]`.
//!
//! A bar is held at its left end, its tip goes up, a winch is found that lifts it, and the blueprint is written.

use plushwright::operations::{Context, FiberCount, check, export, new_design, pose, rig};
use plushwright::rigging::TendonChoice;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

const BAR: &[u8] =
    br#"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="50mm" viewBox="0 0 200 50"><rect width="200" height="50" rx="20"/></svg>"#;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map_or_else(|| std::env::temp_dir().join("bar-blueprint"), PathBuf::from);
    run(&folder)
}

/// Makes the design and writes its blueprint into `folder`.
///
/// # Errors
/// What an operation refuses.
pub fn run(folder: &Path) -> Result<(), Box<dyn Error>> {
    let cancel = AtomicBool::new(false);
    let mut context = Context::new(&cancel);

    let options = new_design::Options { name: "bar".into(), fibers: FiberCount::AtLeast(200), ..Default::default() };
    let mut design = new_design::run(BAR, &options, &context)?.design;

    // Places in mm, y up, from the lower left corner of the silhouette.
    let up = pose::Options {
        name: "up".into(),
        pins: vec![[5.0, 25.0], [25.0, 10.0], [25.0, 40.0]],
        targets: vec![pose::Move { from: [190.0, 25.0], to: [165.0, 95.0] }],
        ..Default::default()
    };
    pose::run(&mut design, &up, &context)?;

    let options = rig::Options { max_winches: 1, tendons: TendonChoice::PerWinch(vec![1]), ..Default::default() };
    rig::run(&mut design, &options, &mut context)?;

    let figures = check::run(&design, &check::Options::default(), &context)?;
    for pose in &figures.poses {
        println!(
            "{}: {:.3} of the body length at rest, {:.3} wound",
            pose.name, pose.error_rest, pose.error_realizable
        );
    }
    let manifest = export::run(&design, folder, &export::Options::default(), &mut context)?;
    println!("{} files in {}", manifest.files.len(), folder.display());
    Ok(())
}
