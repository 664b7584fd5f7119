//! How an outline is read, as options.

use crate::outline::{Background, Holes, Import, Pieces};
use clap::{Args, ValueEnum};

/// How an outline is read and cleaned.
#[derive(Debug, Default, Args)]
pub struct Reading {
    /// Height of the silhouette in mm [default: its physical size in the file; plain numbers are 1/96 inch]
    #[arg(long, value_name = "MM", value_parser = parse_size, allow_hyphen_values = true)]
    pub height: Option<f64>,
    /// Width of the silhouette in mm, in place of its height
    #[arg(long, value_name = "MM", value_parser = parse_size, allow_hyphen_values = true, conflicts_with = "height")]
    pub width: Option<f64>,
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
            width_mm: self.width,
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

fn parse_size(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(size) if size.is_finite() && size > 0.0 => Ok(size),
        _ => Err(format!("expected a length in mm above 0, found `{text}`")),
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
