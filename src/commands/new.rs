//! `new`: an outline becomes a meshed design.

use super::error::{CommandError, check_cancel};
use super::output::{Kind, Output, Replace, refuse_input, say, say_json};
use super::reading::Reading;
use super::words::CleanUp;
use super::{document, meant, words};
use crate::design::{Design, file};
use crate::files::{self, shown};
use crate::operations::new_design::{self, Made, Options};
use crate::operations::{Context, FiberCount, preview};
use crate::outline;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Make a meshed design from an outline (SVG, PDF, DXF, pictures, flat meshes, or a drawing of parts)
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright new assets/pig.svg -o pig.plush --height 250 --fibers 571")]
pub struct New {
    /// Outline to read: an SVG (SVGZ), PDF (AI) or DXF drawing, a picture (PNG, JPEG, WebP, GIF, BMP, TIFF), a flat mesh (OBJ, STL, 3MF), or a
    /// drawing of parts (RON, see `drawing`); all that it paints is joined to one silhouette
    pub outline: PathBuf,
    /// Design file to write (*.plush)
    #[arg(short, long, value_name = "DESIGN", required_unless_present = "preview")]
    pub output: Option<PathBuf>,
    /// Write a picture of what was read, in colours what was left out, filled or joined; without -o no design is made
    #[arg(long, value_name = "OUT.png")]
    pub preview: Option<PathBuf>,
    /// Replace a design that holds more than an outline, or a file that is no design
    #[arg(long)]
    pub force: bool,
    /// Muscle fibres (mesh edges) [default: 414, or the fewest that the outline allows if that is more]
    #[arg(long, value_name = "N", alias = "fibres")]
    pub fibers: Option<usize>,
    #[command(flatten)]
    pub reading: Reading,
    /// Keep the picture as the plushie's texture: what an SVG, PNG or JPEG shows in the silhouette's box (of chosen layers alone) is
    /// written beside the design, DESIGN.texture.png, at most 2048 pixels long
    #[arg(long)]
    pub texture: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `new --json` prints.
const FORMAT: &str = "plushwright-new/1";
/// Format of what `new --preview --json` prints without a design.
const PREVIEW_FORMAT: &str = "plushwright-preview/1";

/// What `new --json` prints.
#[derive(Serialize)]
struct Summary<'a> {
    design: String,
    fibers: usize,
    nodes: usize,
    triangles: usize,
    body_length_mm: f64,
    height_mm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    texture: Option<&'a str>,
    clean_up: CleanUp<'a>,
}

/// What `new --preview --json` prints without a design.
#[derive(Serialize)]
struct Sketched<'a> {
    width_mm: f64,
    height_mm: f64,
    legend: Vec<String>,
    clean_up: CleanUp<'a>,
}

impl New {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        if let Some(output) = &self.output {
            refuse_input(output, &self.outline)?;
            files::check(output).map_err(|e| CommandError::write(output, e))?;
            document::refuse_foreign(output, self.force)?;
        }
        let replace = Replace { force: self.force };
        let inputs = || [self.outline.clone()];
        let preview =
            self.preview.as_deref().map(|path| Output::new(path, Kind::Picture, replace, inputs())).transpose()?;
        if let Some(advice) = meant::instead_of_outline(&self.outline) {
            return Err(CommandError::input(&self.outline, advice));
        }
        let file = outline::read_file(&self.outline).map_err(|error| words::unmade(&self.outline, error.into()))?;
        if let Some(preview) = preview {
            self.show(&file, &preview, out, cancel)?;
        }
        match &self.output {
            Some(output) => self.make(&file, output, out, cancel),
            None => Ok(()),
        }
    }

    /// Writes the preview; without a design to come, tells what was read too.
    fn show(&self, file: &[u8], output: &Output, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let shown = preview::run(file, &self.reading.import(), preview::SIZE, &Context::new(cancel))
            .map_err(|error| words::unshown(&self.outline, error))?;
        let png = shown.picture.png().map_err(|error| CommandError::Failed(error.to_string()))?;
        output.write(&png, cancel)?;
        if self.output.is_none() {
            let [width, height] = shown.size_mm;
            let clean_up = CleanUp::new::<String>(&shown.changes, &[]);
            if self.json {
                let legend = shown.legend;
                say_json(out, PREVIEW_FORMAT, &Sketched { width_mm: width, height_mm: height, legend, clean_up })?;
            } else {
                say(out, &format!("{}: {width:.1} x {height:.1} mm", files::shown(&self.outline)))?;
                shown.legend.iter().try_for_each(|line| say(out, line))?;
                clean_up.lines().try_for_each(|line| say(out, &format!("note: {line}")))?;
            }
        }
        match shown.refused {
            Some(error) if self.output.is_none() => Err(words::unmade(&self.outline, error.into())),
            _ => Ok(()),
        }
    }

    fn make(&self, file: &[u8], output: &Path, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let options = Options {
            name: new_design::name_of(output),
            import: self.reading.import(),
            fibers: FiberCount::asked(self.fibers),
            texture: self.texture,
        };
        let name = if self.texture { Some(self.texture_name(output)?) } else { None };
        let made = new_design::run(file, &options, &Context::new(cancel))
            .map_err(|error| words::unmade(&self.outline, error))?;
        let Made { mut design, changes, texture, notes } = made;
        let beside = name.zip(texture).map(|(name, png)| {
            let path = output.with_file_name(&name);
            design.texture = Some(name);
            (path, png)
        });
        check_cancel(cancel)?;
        document::alone_in(output, cancel, || {
            document::refuse_lost(output, &[&design], self.force)?;
            file::write_with(output, &design, beside).map_err(document::unwritten)
        })?;
        self.report(out, output, &design, CleanUp::new(&changes, &notes))
    }

    /// What the texture beside the design is called.
    fn texture_name(&self, output: &Path) -> Result<String, CommandError> {
        let path = output.with_extension("texture.png");
        if files::same(&path, &self.outline) {
            return Err(CommandError::Usage(format!("the texture would replace {}", shown(&self.outline))));
        }
        if !self.force && !is_ours_or_none(&path) {
            let path = shown(&path);
            return Err(CommandError::Usage(format!("{path} exists and is no texture of ours; --force replaces it")));
        }
        let name = path.file_name().and_then(|name| name.to_str());
        name.map(str::to_owned)
            .ok_or_else(|| CommandError::Usage(format!("{} is no file name that a design can state", shown(&path))))
    }

    fn report(
        &self,
        out: &mut dyn Write,
        output: &Path,
        design: &Design,
        clean_up: CleanUp,
    ) -> Result<(), CommandError> {
        let (low, high) = design.outline.bounding_box();
        let summary = Summary {
            design: shown(output),
            fibers: design.fiber_routings().len(),
            nodes: design.mesh.nodes.len(),
            triangles: design.mesh.triangles.len(),
            body_length_mm: design.body_length_mm(),
            height_mm: high[1] - low[1],
            texture: design.texture.as_deref(),
            clean_up,
        };
        if self.json {
            return say_json(out, FORMAT, &summary);
        }
        let Summary { design, fibers, nodes, triangles, body_length_mm, texture, clean_up, .. } = summary;
        say(
            out,
            &format!("{design}: {fibers} fibers, {nodes} nodes, {triangles} triangles, {body_length_mm:.1} mm long"),
        )?;
        if let Some(name) = texture {
            say(out, &format!("texture: {name}"))?;
        }
        for line in clean_up.lines() {
            say(out, &format!("note: {line}"))?;
        }
        Ok(())
    }
}

/// Whether a file may be replaced by a texture without asking: there is none, or it was written here, or is empty.
fn is_ours_or_none(path: &Path) -> bool {
    /// Enough to know a picture, bytes.
    const HEAD: u64 = 512;
    use std::io::Read;
    let mut head = Vec::new();
    match std::fs::metadata(path) {
        Ok(found) if found.is_file() => {
            let read = std::fs::File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
            read.is_ok() && (head.is_empty() || files::is_marked_png(&head))
        }
        // What else stands there is told when it is written.
        _ => true,
    }
}
