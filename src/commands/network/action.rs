//! The changes of networks, as they are asked for on the command line.

use crate::commands::document;
use crate::commands::error::CommandError;
use crate::commands::place::parse_point;
use crate::design::Design;
use crate::operations::network::{Edit, Part};
use crate::outline::Point;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// The design that is changed, and where it goes.
#[derive(Debug, Args)]
pub struct Files {
    /// Design file to read
    pub design: PathBuf,
    #[command(flatten)]
    pub target: document::Target,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Subcommand)]
pub enum Action {
    /// Move a hole, an end (the last hole), or a winch with all its tendons
    Move {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        /// Tendon of the winch; none: the winch itself
        #[arg(long, value_name = "N", requires = "hole")]
        tendon: Option<usize>,
        /// Hole, counted from the winch (number 0)
        #[arg(long, value_name = "N", requires = "tendon")]
        hole: Option<usize>,
        /// Where it goes (mm)
        #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
        to: Point,
    },
    /// Pass a piece of a tendon through a hole more
    AddHole {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        /// Tendon of the winch
        #[arg(long, value_name = "N")]
        tendon: usize,
        /// Piece of the tendon, counted from the winch
        #[arg(long, value_name = "N")]
        piece: usize,
        /// Where the hole is (mm)
        #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
        at: Point,
    },
    /// Take out a winch, one of its tendons, or a hole of that
    Remove {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        /// Tendon of the winch
        #[arg(long, value_name = "N")]
        tendon: Option<usize>,
        /// Hole, counted from the winch; of the last one the hole before becomes the end
        #[arg(long, value_name = "N", requires = "tendon")]
        hole: Option<usize>,
    },
    /// Give a winch one more tendon
    AddTendon {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        /// Places that it passes, from the winch to its end (mm; repeatable)
        #[arg(long, value_name = "X,Y", required = true, value_parser = parse_point, allow_hyphen_values = true)]
        through: Vec<Point>,
    },
    /// Give a tendon to another winch
    HandOver {
        #[command(flatten)]
        files: Files,
        /// Winch that has it, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        /// Tendon of the winch
        #[arg(long, value_name = "N")]
        tendon: usize,
        /// Winch that gets it, by name or number
        #[arg(long, value_name = "W")]
        to: String,
    },
    /// Give tendons a winch of their own, wound as the old one is
    Split {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        /// Tendon that gets the new winch (repeatable)
        #[arg(long = "tendon", value_name = "N", required = true)]
        tendons: Vec<usize>,
        /// Where the new winch sits (mm) [default: beside the old one]
        #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
        at: Option<Point>,
    },
    /// Make a winch with a tendon
    New {
        #[command(flatten)]
        files: Files,
        /// Places: the winch, then what its tendon passes, its end last (mm; repeatable)
        #[arg(long, value_name = "X,Y", required = true, value_parser = parse_point, allow_hyphen_values = true)]
        through: Vec<Point>,
    },
    /// Give a winch another name
    Rename {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        #[arg(long, value_name = "NAME")]
        name: String,
    },
    /// Give the cables of a winch a colour in pictures
    #[command(alias = "colour")]
    Color {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        /// Red, green and blue as six hexadecimal digits, or `none` for the colour of its number
        #[arg(long, value_name = "RRGGBB", alias = "colour")]
        color: String,
    },
    /// Switch a winch off: it pulls nothing and is not made, but keeps its activations in keyframes
    Mute {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
    },
    /// Switch a winch on again
    Unmute {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
    },
    /// Move a winch to another place in the list
    Reorder {
        #[command(flatten)]
        files: Files,
        /// Winch, by name or number
        #[arg(long, value_name = "W")]
        winch: String,
        /// Its new number
        #[arg(long, value_name = "N")]
        to: usize,
    },
}

impl Action {
    pub fn files(&self) -> &Files {
        match self {
            Self::Move { files, .. }
            | Self::AddHole { files, .. }
            | Self::Remove { files, .. }
            | Self::AddTendon { files, .. }
            | Self::HandOver { files, .. }
            | Self::Split { files, .. }
            | Self::New { files, .. }
            | Self::Rename { files, .. }
            | Self::Color { files, .. }
            | Self::Mute { files, .. }
            | Self::Unmute { files, .. }
            | Self::Reorder { files, .. } => files,
        }
    }

    /// The change of a design that is asked for.
    ///
    /// # Errors
    /// A winch of no such name or number; a number 0 of what is counted from 1.
    pub fn edit(&self, design: &Design) -> Result<Edit, CommandError> {
        let winch_of = |name: &str| winch(design, name);
        Ok(match self {
            &Self::Move { ref winch, tendon, hole, to, .. } => {
                Edit::Move { part: part(winch_of(winch)?, tendon, hole)?, to }
            }
            &Self::AddHole { ref winch, tendon, piece, at, .. } => {
                Edit::AddHole { winch: winch_of(winch)?, tendon: number(tendon)?, piece: number(piece)?, at }
            }
            &Self::Remove { hole: Some(0), .. } => {
                let words = "hole 0 is the winch itself; leave --tendon and --hole out to remove the winch with all its tendons";
                return Err(CommandError::Usage(words.into()));
            }
            &Self::Remove { ref winch, tendon, hole, .. } => Edit::Remove(part(winch_of(winch)?, tendon, hole)?),
            Self::AddTendon { winch, through, .. } => {
                Edit::AddTendon { winch: winch_of(winch)?, through: through.clone() }
            }
            Self::HandOver { winch, tendon, to, .. } => {
                Edit::HandOver { winch: winch_of(winch)?, tendon: number(*tendon)?, to: winch_of(to)? }
            }
            Self::Split { winch, tendons, at, .. } => {
                let tendons = tendons.iter().map(|&tendon| number(tendon)).collect::<Result<_, _>>()?;
                Edit::Split { winch: winch_of(winch)?, tendons, at: *at }
            }
            Self::New { through, .. } => Edit::New { through: through.clone() },
            Self::Rename { winch, name, .. } => Edit::Rename { winch: winch_of(winch)?, name: name.clone() },
            Self::Color { winch, color, .. } => Edit::Color { winch: winch_of(winch)?, color: parse_color(color)? },
            Self::Mute { winch, .. } => Edit::Mute { winch: winch_of(winch)?, muted: true },
            Self::Unmute { winch, .. } => Edit::Mute { winch: winch_of(winch)?, muted: false },
            Self::Reorder { winch, to, .. } => Edit::Reorder { winch: winch_of(winch)?, to: number(*to)? },
        })
    }
}

fn part(winch: usize, tendon: Option<usize>, hole: Option<usize>) -> Result<Part, CommandError> {
    Ok(match (tendon, hole) {
        (Some(tendon), Some(hole)) => Part::Hole(winch, number(tendon)?, hole),
        (Some(tendon), None) => Part::Tendon(winch, number(tendon)?),
        _ => Part::Winch(winch),
    })
}

fn parse_color(text: &str) -> Result<Option<[u8; 3]>, CommandError> {
    if text == "none" {
        return Ok(None);
    }
    let digits = text.strip_prefix('#').unwrap_or(text);
    let value = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6 && !digits.starts_with('+'));
    let [_, red, green, blue] = value
        .ok_or_else(|| CommandError::Usage(format!("expected six hexadecimal digits or `none`, found `{text}`")))?
        .to_be_bytes();
    Ok(Some([red, green, blue]))
}

/// A number that is counted from 1.
fn number(number: usize) -> Result<usize, CommandError> {
    number.checked_sub(1).ok_or_else(|| CommandError::Usage("winches, tendons and pieces are counted from 1".into()))
}

/// The winch of a name; else of a number.
fn winch(design: &Design, name: &str) -> Result<usize, CommandError> {
    let named = design.networks.iter().position(|network| network.name == name);
    let numbered = || name.parse::<usize>().ok()?.checked_sub(1).filter(|&winch| winch < design.networks.len());
    named.or_else(numbered).ok_or_else(|| {
        let names: Vec<&str> = design.networks.iter().map(|network| network.name.as_str()).collect();
        let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        CommandError::Usage(format!("no winch `{name}`; the design has: {known}"))
    })
}
