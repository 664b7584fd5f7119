//! `export`: the blueprint, a folder that appears whole or not at all.

use super::error::CommandError;
use super::output::{json, say, say_lines};
use super::{document, progress, words};
use crate::fabrication::piece::{Corners, Cutting};
use crate::fabrication::{Catalogue, Cutter, SheetSize, Topic, Topics, catalogue};
use crate::files;
use crate::motion::TooFast;
use crate::operations::{Context, Progress, export};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Write the blueprint: patterns, routings, winch tracks, controller programs
///
/// Sheets are SVG in mm with a 100 mm reference line; tracks are in s, mm and encoder counts.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright export pig.plush -o pig-blueprint")]
pub struct Export {
    /// Design file to read; it needs winches (see `plushwright rig`)
    pub design: PathBuf,
    /// Folder to write; an earlier export is replaced, any other folder refused
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Give the animation more time where its motors are too slow for it; otherwise such an animation is refused
    #[arg(long)]
    pub stretch: bool,
    /// Parts to write, of laser, print, routing, winches, motors and guide; all by default. README and manifest are always there
    #[arg(long, value_name = "PARTS", value_delimiter = ',')]
    pub only: Vec<Part>,
    /// The machine that cuts the felt: what its lines look like
    #[arg(long, default_value = "laser")]
    pub cutter: Machine,
    /// Sheets that the machine cuts, width x height in mm; pieces are laid on as few as they fit on
    #[arg(long, value_name = "WxH", default_value = "600x400", value_parser = sheet)]
    pub sheet: SheetSize,
    /// Width that the machine burns or cuts away, mm: lines move by half of it
    #[arg(long, value_name = "MM", default_value_t = 0.0, value_parser = kerf)]
    pub kerf: f64,
    /// The allowance at the corners of the seam
    #[arg(long, default_value = "round")]
    pub corners: Corner,
    /// Widen the pattern so that the stuffed body is as drawn, where that can be done
    #[arg(long)]
    pub compensate: bool,
    /// Motors that winches may have, a table as `assets/motors.csv` of the sources [default: that one]
    #[arg(long, value_name = "FILE")]
    pub motors: Option<PathBuf>,
    /// Families of controllers to write programs for, separated by commas; all that can play the motion by default
    #[arg(long, value_name = "FAMILIES", value_delimiter = ',')]
    pub controllers: Vec<String>,
    /// Print the manifest: files with sizes in bytes and SHA-256, and remarks
    #[arg(long)]
    pub json: bool,
}

/// A part of the blueprint, by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Part {
    /// Patterns for machines that cut: SVG and DXF
    Laser,
    /// Patterns on paper: PDF at its size and on A4 and Letter pages
    Print,
    /// The ways of the cables
    Routing,
    /// Spools and housings to print
    Winches,
    /// Tracks and programs for controllers
    Motors,
    /// Parts list and assembly guide
    Guide,
}

/// A machine that cuts felt, by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Machine {
    /// Red hairlines are cut, blue ones are stitches, green ones are marks
    Laser,
    /// The colours of LightBurn's first layers
    Lightburn,
    /// Black hairlines are cut by a blade
    Plotter,
}

/// The shape of an allowance at corners, by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Corner {
    Round,
    Mitred,
}

impl From<Part> for Topic {
    fn from(part: Part) -> Self {
        match part {
            Part::Laser => Self::Laser,
            Part::Print => Self::Print,
            Part::Routing => Self::Routing,
            Part::Winches => Self::Winches,
            Part::Motors => Self::Motors,
            Part::Guide => Self::Guide,
        }
    }
}

impl From<Machine> for Cutter {
    fn from(machine: Machine) -> Self {
        match machine {
            Machine::Laser => Self::Laser,
            Machine::Lightburn => Self::Lightburn,
            Machine::Plotter => Self::Plotter,
        }
    }
}

impl From<Corner> for Corners {
    fn from(corner: Corner) -> Self {
        match corner {
            Corner::Round => Self::Round,
            Corner::Mitred => Self::Mitred,
        }
    }
}

/// Smallest and largest side of a sheet, mm: the reference line fits on it; cutting tables reach some metres.
const SHEET_MM: [f64; 2] = [150.0, 10_000.0];
/// Largest kerf, mm: a hot wire's.
const MOST_KERF_MM: f64 = 5.0;

fn sheet(text: &str) -> Result<SheetSize, String> {
    let figures: Vec<f64> = text.split(['x', 'X', '*']).filter_map(|side| side.trim().parse().ok()).collect();
    match figures[..] {
        [w, h] if [w, h].iter().all(|v| (SHEET_MM[0]..=SHEET_MM[1]).contains(v)) => Ok(SheetSize { size_mm: [w, h] }),
        [_, _] => Err(format!("both sides are {} to {} mm", SHEET_MM[0], SHEET_MM[1])),
        _ => Err("width x height in mm, such as 600x400".into()),
    }
}

fn kerf(text: &str) -> Result<f64, String> {
    let figure = text.parse().map_err(|_| "a number in mm, such as 0.2")?;
    if (0.0..=MOST_KERF_MM).contains(&figure) { Ok(figure) } else { Err(format!("0 to {MOST_KERF_MM} mm")) }
}

impl Export {
    fn catalogue(&self) -> Result<Catalogue, CommandError> {
        let Some(path) = &self.motors else { return Ok(Catalogue::default()) };
        let bytes = files::read(path, catalogue::MOST_BYTES).map_err(|error| CommandError::input(path, error))?;
        let text = String::from_utf8_lossy(&bytes);
        Catalogue::read(&text).map_err(|error| CommandError::input(path, error))
    }

    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let too_fast = if self.stretch { TooFast::Stretch } else { TooFast::Refuse };
        let only = if self.only.is_empty() {
            Topics::default()
        } else {
            self.only.iter().map(|&p| p.into()).collect::<Vec<_>>().into()
        };
        let cutting = Cutting { corners: self.corners.into(), kerf_mm: self.kerf };
        let options = export::Options {
            too_fast,
            only,
            cutter: self.cutter.into(),
            sheet: self.sheet,
            cutting,
            compensate: self.compensate,
            motors: self.catalogue()?,
            controllers: self.controllers.clone(),
        };
        let mut told = |step: &Progress| {
            if let Progress::Part { done, of } = step {
                progress::at(*done, *of, "parts");
            }
        };
        let mut context = Context::telling(cancel, &mut told);
        let manifest = export::run(&design, &self.output, &options, &mut context).map_err(|error| match error {
            export::Error::Export(error) => words::unexported(&self.design, error),
            export::Error::Cancelled(_) => CommandError::Cancelled,
        })?;
        if self.json {
            return say_lines(out, &json(&manifest)?);
        }
        for file in &manifest.files {
            say(out, &format!("{:8} bytes  {}", file.bytes, self.output.join(&file.name).display()))?;
        }
        for remark in &manifest.remarks {
            say(out, &format!("note: {remark}"))?;
        }
        Ok(())
    }
}
