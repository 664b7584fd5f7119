//! A breach in words.

use super::{Breach, Place};
use std::fmt;

/// A hole no farther than this outside of the seam is told as on it, mm: what a tenth is rounded by.
const ON_SEAM_MM: f64 = 0.05;

/// A breach to be told, with the winches called by their names.
#[derive(Clone, Copy, Debug)]
pub struct Words<'a> {
    breach: Breach,
    names: &'a [String],
}

impl Breach {
    /// The breach in words; `names` are those of the winches. One that has none is called by its number.
    pub fn words<'a>(&self, names: &'a [String]) -> Words<'a> {
        Words { breach: *self, names }
    }
}

impl fmt::Display for Breach {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.words(&[]).fmt(f)
    }
}

impl fmt::Display for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.breach {
            Breach::NearSeam { at, .. }
            | Breach::Crowded { at, .. }
            | Breach::ManyHoles { at, .. }
            | Breach::SharpTurn { at, .. }
            | Breach::Turning { at, .. }
            | Breach::Along { at, .. }
            | Breach::ThroughWinch { at, .. }
            | Breach::Outside { at, .. } => write!(f, "{}: {}", self.cable(at), self.of_a_cable()),
            Breach::ThinBody { .. }
            | Breach::HousingOutside { .. }
            | Breach::HousingAtGap { .. }
            | Breach::HousingsClose { .. } => f.write_str(&self.of_a_housing()),
        }
    }
}

impl Words<'_> {
    fn winch(&self, winch: usize) -> String {
        self.names.get(winch).cloned().unwrap_or_else(|| format!("winch {}", winch + 1))
    }

    fn cable(&self, Place { winch, cable }: Place) -> String {
        format!("{}, tendon {}", self.winch(winch), cable + 1)
    }

    /// Rules of cables and their holes, without the cable.
    fn of_a_cable(&self) -> String {
        match self.breach {
            Breach::NearSeam { hole, distance_mm, least_mm, .. } if distance_mm < -ON_SEAM_MM => {
                format!(
                    "{} is {:.1} mm outside of the body, not {least_mm:.1} inside the seam",
                    place(hole),
                    -distance_mm
                )
            }
            Breach::NearSeam { hole, distance_mm, least_mm, .. } => {
                format!("{} is {:.1} mm from the seam, less than {least_mm:.1}", place(hole), distance_mm.max(0.0))
            }
            Breach::Crowded { hole, other, other_hole, distance_mm, least_mm, .. } => {
                let (here, there, of) = (place(hole), place(other_hole), self.cable(other));
                format!("{here} is {distance_mm:.1} mm from {there} of {of}, less than {least_mm:.1}")
            }
            Breach::ManyHoles { holes, most, .. } => format!("{holes} holes between winch and end, more than {most}"),
            Breach::SharpTurn { hole, degrees, most, .. } => {
                format!("turns by {degrees:.1} degrees at {}, more than {most:.1}", place(hole))
            }
            Breach::Turning { degrees, most, .. } => {
                format!("turns by {degrees:.1} degrees in all, more than {most:.1}")
            }
            Breach::Along { other, length_mm, most_mm, .. } => {
                format!("runs along {} for {length_mm:.1} mm, more than {most_mm:.1}", self.cable(other))
            }
            Breach::ThroughWinch { piece, winch, distance_mm, least_mm, .. } => format!(
                "{} passes the middle of {} at {distance_mm:.1} mm, through its housing ({least_mm:.1})",
                stretch(piece),
                self.winch(winch)
            ),
            Breach::Outside { piece, length_mm, .. } => {
                format!("{} is outside of the body for {length_mm:.1} mm", stretch(piece))
            }
            _ => String::new(),
        }
    }

    /// Rules of housings.
    fn of_a_housing(&self) -> String {
        match self.breach {
            Breach::ThinBody { room_mm, housing_mm } => format!(
                "the body is too thin for housings of {housing_mm:.1} mm; there is room for {room_mm:.1} mm at most, and winches are judged by that"
            ),
            Breach::HousingOutside { winch, room_mm, housing_mm } => format!(
                "{}: there is room for {:.1} mm inside the seam, the housing is {housing_mm:.1} mm wide",
                self.winch(winch),
                room_mm.max(0.0)
            ),
            Breach::HousingAtGap { winch, gap_mm, housing_mm } => format!(
                "{}: a housing of {housing_mm:.1} mm does not pass the turning gap of {gap_mm:.1} mm",
                self.winch(winch)
            ),
            Breach::HousingsClose { winch, other, distance_mm, least_mm } => format!(
                "{} and {}: their middles are {distance_mm:.1} mm apart, less than {least_mm:.1}",
                self.winch(winch),
                self.winch(other)
            ),
            _ => String::new(),
        }
    }
}

/// A hole by its number on the way of its cable: sheets number the holes of all cables.
fn place(hole: usize) -> String {
    if hole == 0 { "the winch's hole".to_owned() } else { format!("hole {hole} from the winch") }
}

/// A piece of cable by its number.
fn stretch(piece: usize) -> String {
    format!("piece {} from the winch", piece + 1)
}
