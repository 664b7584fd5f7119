//! A breach as figures, for other programs.

use super::{Breach, Place};
use serde::{Serialize, Serializer};

/// A breach as a record: the rule, where it is broken, the figure and its limit (mm, degrees, or a count). Winches, tendons and pieces are
/// counted from 1 as in words; holes from the winch, which is number 0.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Facts {
    pub rule: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub winch: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tendon: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hole: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub piece: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other_winch: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other_tendon: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other_hole: Option<usize>,
    pub value: f64,
    pub limit: f64,
    /// By how many times the rule is broken, see [`Breach::severity`].
    pub severity: f64,
}

impl Facts {
    fn new(rule: &'static str, value: f64, limit: f64) -> Self {
        Self { rule, value, limit, ..Self::default() }
    }

    fn at(self, Place { winch, cable }: Place) -> Self {
        Self { winch: Some(winch + 1), tendon: Some(cable + 1), ..self }
    }

    fn winch(self, winch: usize) -> Self {
        Self { winch: Some(winch + 1), ..self }
    }

    fn with(self, Place { winch, cable }: Place) -> Self {
        Self { other_winch: Some(winch + 1), other_tendon: Some(cable + 1), ..self }
    }
}

impl Serialize for Breach {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Facts::from(*self).serialize(serializer)
    }
}

impl From<Breach> for Facts {
    fn from(breach: Breach) -> Self {
        let facts = match breach {
            Breach::NearSeam { at, hole, distance_mm, least_mm } => {
                Self { hole: Some(hole), ..Self::new("hole_to_seam", distance_mm, least_mm).at(at) }
            }
            Breach::Crowded { at, hole, other, other_hole, distance_mm, least_mm } => Self {
                hole: Some(hole),
                other_hole: Some(other_hole),
                ..Self::new("hole_to_hole", distance_mm, least_mm).at(at).with(other)
            },
            Breach::ManyHoles { at, holes, most } => Self::new("holes", holes as f64, most as f64).at(at),
            Breach::SharpTurn { at, hole, degrees, most } => {
                Self { hole: Some(hole), ..Self::new("turn", degrees, most).at(at) }
            }
            Breach::Turning { at, degrees, most } => Self::new("turning", degrees, most).at(at),
            Breach::Along { at, other, length_mm, most_mm } => {
                Self::new("along", length_mm, most_mm).at(at).with(other)
            }
            Breach::ThroughWinch { at, piece, winch, distance_mm, least_mm } => Self {
                piece: Some(piece + 1),
                other_winch: Some(winch + 1),
                ..Self::new("through_winch", distance_mm, least_mm).at(at)
            },
            Breach::Outside { at, piece, length_mm, most_mm } => {
                Self { piece: Some(piece + 1), ..Self::new("outside", length_mm, most_mm).at(at) }
            }
            Breach::ThinBody { room_mm, housing_mm } => Self::new("thin_body", room_mm, housing_mm),
            Breach::HousingOutside { winch, room_mm, housing_mm } => {
                Self::new("housing_to_seam", room_mm, housing_mm).winch(winch)
            }
            Breach::HousingAtGap { winch, gap_mm, housing_mm } => {
                Self::new("housing_to_gap", gap_mm, housing_mm).winch(winch)
            }
            Breach::HousingsClose { winch, other, distance_mm, least_mm } => Self {
                other_winch: Some(other + 1),
                ..Self::new("housing_to_housing", distance_mm, least_mm).winch(winch)
            },
        };
        Self { severity: breach.severity(), ..facts }
    }
}
