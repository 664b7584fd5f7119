//! `new`: an outline becomes a meshed design.

use super::error::{CommandError, check_cancel};
use super::output::{refuse_input, say, say_json};
use super::words::CleanUp;
use super::{document, meant, words};
use crate::design::{Design, file};
use crate::files::{self, shown};
use crate::operations::new_design::{self, Made, Options};
use crate::operations::{Context, FiberCount};
use crate::outline::{self, Background, Holes, Import, Pieces};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Make a meshed design from an outline (SVG, PNG, JPEG, DXF, OBJ, or a drawing of parts)
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright new assets/pig.svg -o pig.plush --height 250 --fibers 571")]
pub struct New {
    /// Outline to read: an SVG, PNG, JPEG or DXF file, a flat OBJ mesh, or a drawing of parts (RON, see `drawing`); all that
    /// it paints is joined to one silhouette
    pub outline: PathBuf,
    /// Design file to write (*.plush)
    #[arg(short, long, value_name = "DESIGN")]
    pub output: PathBuf,
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

/// How an outline is read and cleaned.
#[derive(Debug, Default, Args)]
pub struct Reading {
    /// Height of the silhouette in mm [default: its physical size in the file; plain numbers are 1/96 inch]
    #[arg(long, value_name = "MM", value_parser = parse_height, allow_hyphen_values = true)]
    pub height: Option<f64>,
    /// Several pieces: refuse them, or keep the largest
    #[arg(long, value_enum, default_value_t)]
    pub pieces: PiecesChoice,
    /// Holes: fill those of a drawing in thin lines alone (across small openings too), keep or fill them all
    #[arg(long, value_enum, default_value_t)]
    pub holes: HolesChoice,
    /// Paper, cards and frames that everything else lies on: leave out what is surely one, drop or keep it
    #[arg(long, value_enum, default_value_t)]
    pub background: BackgroundChoice,
    /// Smooth the boundary, moving it by at most so many mm; corners stay. 0: leave it as it is, however fine [default: where it is
    /// rougher than scissors can follow, by 0.1 % of the size]
    #[arg(long, value_name = "MM", value_parser = parse_length, allow_hyphen_values = true)]
    pub smooth: Option<f64>,
    /// Widen parts thinner than so many mm, 0 for none [default: 1 % of the size, adding at most 1 % of the area]
    #[arg(long, value_name = "MM", value_parser = parse_length, allow_hyphen_values = true)]
    pub min_width: Option<f64>,
    /// Join parts that are less than so many mm apart [default: 0.1 % of the size, of separate parts alone]
    #[arg(long, value_name = "MM", value_parser = parse_length, allow_hyphen_values = true)]
    pub gap: Option<f64>,
    /// Join ends of lines that are less than so many mm apart [default: 2 % of the size in DXF drawings; 12 % of what is drawn in thin
    /// lines alone]
    #[arg(long, value_name = "MM", value_parser = parse_length, allow_hyphen_values = true)]
    pub join: Option<f64>,
    /// Length of a plain number or a pixel: mm, cm, m, in, pt, px, a resolution such as 300dpi, or a number of mm [default: what the
    /// file says; else mm in DXF and mesh files, and 1/96 inch in SVG files and pictures]
    #[arg(long, value_parser = parse_unit)]
    pub unit: Option<f64>,
    /// Pictures: difference from the background from which a pixel is ink, 0 to 255 [default: found by Otsu's method]. With
    /// transparency, and in an SVG: opacity from which something counts [default: half; 40 % in an SVG]
    #[arg(long, value_name = "LEVEL")]
    pub threshold: Option<u8>,
    /// Read only this layer of an SVG (id or Inkscape label of a group or element) or DXF; may be repeated. A name that is none
    /// is refused with a list of those there are [default: everything]
    #[arg(long = "layer", value_name = "NAME")]
    pub layers: Vec<String>,
    /// Read this block of a DXF in place of its drawing; may be repeated
    #[arg(long = "block", value_name = "NAME")]
    pub blocks: Vec<String>,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum PiecesChoice {
    #[default]
    Refuse,
    Largest,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum HolesChoice {
    #[default]
    Auto,
    Keep,
    Fill,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum BackgroundChoice {
    #[default]
    Auto,
    Drop,
    Keep,
}

impl Reading {
    /// These options as the reader takes them.
    pub fn import(&self) -> Import {
        Import {
            height_mm: self.height,
            pieces: match self.pieces {
                PiecesChoice::Refuse => Pieces::Refuse,
                PiecesChoice::Largest => Pieces::Largest,
            },
            holes: match self.holes {
                HolesChoice::Auto => Holes::Found,
                HolesChoice::Keep => Holes::Keep,
                HolesChoice::Fill => Holes::Fill,
            },
            background: match self.background {
                BackgroundChoice::Auto => Background::Found,
                BackgroundChoice::Drop => Background::Drop,
                BackgroundChoice::Keep => Background::Keep,
            },
            smooth_mm: self.smooth,
            gap_mm: self.gap,
            join_mm: self.join,
            min_width_mm: self.min_width,
            unit_mm: self.unit,
            threshold: self.threshold,
            layers: self.layers.clone(),
            blocks: self.blocks.clone(),
        }
    }
}

/// Format of what `new --json` prints.
const FORMAT: &str = "plushwright-new/1";

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

impl New {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        refuse_input(&self.output, &self.outline)?;
        files::check(&self.output).map_err(|e| CommandError::write(&self.output, e))?;
        document::refuse_foreign(&self.output, self.force)?;
        let options = Options {
            name: new_design::name_of(&self.output),
            import: self.reading.import(),
            fibers: FiberCount::asked(self.fibers),
            texture: self.texture,
        };
        if let Some(advice) = meant::instead_of_outline(&self.outline) {
            return Err(CommandError::input(&self.outline, advice));
        }
        let failed = |error| words::unmade(&self.outline, error);
        let file = outline::read_file(&self.outline).map_err(|error| failed(error.into()))?;
        let name = if self.texture { Some(self.texture_name()?) } else { None };
        let made = new_design::run(&file, &options, &Context::new(cancel)).map_err(failed)?;
        let Made { mut design, changes, texture, notes } = made;
        let beside = name.zip(texture).map(|(name, png)| {
            let path = self.output.with_file_name(&name);
            design.texture = Some(name);
            (path, png)
        });
        check_cancel(cancel)?;
        document::alone_in(&self.output, cancel, || {
            document::refuse_lost(&self.output, &[&design], self.force)?;
            file::write_with(&self.output, &design, beside).map_err(document::unwritten)
        })?;
        self.report(out, &design, CleanUp::new(&changes, &notes))
    }

    /// What the texture beside the design is called.
    fn texture_name(&self) -> Result<String, CommandError> {
        let path = self.output.with_extension("texture.png");
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

    fn report(&self, out: &mut dyn Write, design: &Design, clean_up: CleanUp) -> Result<(), CommandError> {
        let (low, high) = design.outline.bounding_box();
        let summary = Summary {
            design: shown(&self.output),
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

fn parse_height(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(height) if height.is_finite() && height > 0.0 => Ok(height),
        _ => Err(format!("expected a height in mm above 0, found `{text}`")),
    }
}

fn parse_length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length.is_finite() && length >= 0.0 => Ok(length),
        _ => Err(format!("expected a length in mm, found `{text}`")),
    }
}

/// A unit by its name, as a resolution or as a number of mm.
fn parse_unit(text: &str) -> Result<f64, String> {
    const MM_PER_INCH: f64 = 25.4;
    let lower = text.trim().to_ascii_lowercase();
    let mm = match lower.as_str() {
        "mm" => Some(1.0),
        "cm" => Some(10.0),
        "m" => Some(1000.0),
        "in" => Some(MM_PER_INCH),
        "pt" => Some(MM_PER_INCH / 72.0),
        "px" => Some(MM_PER_INCH / 96.0),
        _ => match lower.strip_suffix("dpi") {
            Some(dots) => dots.trim().parse().ok().map(|dots: f64| MM_PER_INCH / dots),
            None => lower.parse().ok(),
        },
    };
    mm.filter(|mm| mm.is_finite() && *mm > 0.0).ok_or_else(|| {
        format!("expected mm, cm, m, in, pt, px, a resolution as 300dpi or a number of mm, found `{text}`")
    })
}
