//! Draws the program's icons in all sizes, from the drawings in `assets/icon/`: `cargo run --example icons -- DIR` makes
//! `DIR/SIZE/plushwright.png` and `DIR/SIZE/application-x-plushwright.png`. `scripts/package` calls it.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

/// Width and height in pixels: those of desktops' icon themes.
const SIZES: [u32; 9] = [16, 22, 24, 32, 48, 64, 128, 256, 512];
const ICONS: [(&str, &str); 2] = [
    ("plushwright", include_str!("../assets/icon/plushwright.svg")),
    ("application-x-plushwright", include_str!("../assets/icon/design.svg")),
];

pub fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args_os().nth(1).ok_or("say where the icons go")?.into();
    run(&folder)
}

/// # Errors
/// A file cannot be written, a drawing cannot be read.
pub fn run(folder: &Path) -> Result<(), Box<dyn Error>> {
    for (name, drawing) in ICONS {
        let tree = Tree::from_str(drawing, &Options::default())?;
        for size in SIZES {
            let mut picture = Pixmap::new(size, size).ok_or("no memory")?;
            let scale = size as f32 / tree.size().width().max(tree.size().height());
            resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
            let place = folder.join(size.to_string());
            fs::create_dir_all(&place)?;
            fs::write(place.join(name).with_extension("png"), picture.encode_png()?)?;
        }
    }
    Ok(())
}
