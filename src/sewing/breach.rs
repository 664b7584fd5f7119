//! A broken rule: which, where, and by how much.

/// A cable of a rig, both counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    pub winch: usize,
    pub cable: usize,
}

/// The part of a rig that a breach is about, counted as there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    Winch(usize),
    /// A cable as a whole.
    Cable(Place),
    Hole(Place, usize),
    Piece(Place, usize),
}

/// A rule that is broken, and where. Figures in mm and degrees; holes counted from the winch, which is number 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Breach {
    /// A hole too near to the seam; a negative distance is outside of the body.
    NearSeam { at: Place, hole: usize, distance_mm: f64, least_mm: f64 },
    /// Two holes too near to each other.
    Crowded { at: Place, hole: usize, other: Place, other_hole: usize, distance_mm: f64, least_mm: f64 },
    /// More holes between winch and end than a hand wants to sew.
    ManyHoles { at: Place, holes: usize, most: usize },
    /// A turn too sharp at one hole.
    SharpTurn { at: Place, hole: usize, degrees: f64, most: f64 },
    /// Too much turning in all.
    Turning { at: Place, degrees: f64, most: f64 },
    /// A stretch along another cable.
    Along { at: Place, other: Place, length_mm: f64, most_mm: f64 },
    /// A piece of cable, counted from the winch, that runs through the housing of another winch.
    ThroughWinch { at: Place, piece: usize, winch: usize, distance_mm: f64, least_mm: f64 },
    /// A piece of cable, counted from the winch, that lies outside of the body, at rest or in a pose.
    Outside { at: Place, piece: usize, length_mm: f64, most_mm: f64 },
    /// A body that has no place for the housing; winches are judged by the largest one that it has room for.
    ThinBody { room_mm: f64, housing_mm: f64 },
    /// A housing that does not fit inside the seam.
    HousingOutside { winch: usize, room_mm: f64, housing_mm: f64 },
    /// A housing that does not pass the turning gap.
    HousingAtGap { winch: usize, gap_mm: f64, housing_mm: f64 },
    /// Two housings without space between them; the distance is that of their centres.
    HousingsClose { winch: usize, other: usize, distance_mm: f64, least_mm: f64 },
}

impl Breach {
    /// The winches that have a part in it, counted from 0; none where it is the body's.
    pub fn winches(&self) -> impl Iterator<Item = usize> + use<> {
        let (one, other) = match *self {
            Self::NearSeam { at, .. }
            | Self::ManyHoles { at, .. }
            | Self::SharpTurn { at, .. }
            | Self::Turning { at, .. }
            | Self::Outside { at, .. } => (Some(at.winch), None),
            Self::Crowded { at, other, .. } | Self::Along { at, other, .. } => (Some(at.winch), Some(other.winch)),
            Self::ThroughWinch { at, winch, .. } => (Some(at.winch), Some(winch)),
            Self::HousingOutside { winch, .. } | Self::HousingAtGap { winch, .. } => (Some(winch), None),
            Self::HousingsClose { winch, other, .. } => (Some(winch), Some(other)),
            Self::ThinBody { .. } => (None, None),
        };
        one.into_iter().chain(other.filter(|other| Some(*other) != one))
    }

    /// The parts of the rig that it is about; none where it is the body's.
    pub fn spots(&self) -> [Option<Spot>; 2] {
        let hole = |at: Place, hole: usize| Some(Spot::Hole(at, hole));
        let piece = |at: Place, piece: usize| Some(Spot::Piece(at, piece));
        let (cable, housing) = (|at: Place| Some(Spot::Cable(at)), |winch: usize| Some(Spot::Winch(winch)));
        match *self {
            Self::NearSeam { at, hole: h, .. } | Self::SharpTurn { at, hole: h, .. } => [hole(at, h), None],
            Self::Crowded { at, hole: h, other, other_hole, .. } => [hole(at, h), hole(other, other_hole)],
            Self::ManyHoles { at, .. } | Self::Turning { at, .. } => [cable(at), None],
            Self::Along { at, other, .. } => [cable(at), cable(other)],
            Self::ThroughWinch { at, piece: p, winch, .. } => [piece(at, p), housing(winch)],
            Self::Outside { at, piece: p, .. } => [piece(at, p), None],
            Self::ThinBody { .. } => [None, None],
            Self::HousingOutside { winch, .. } | Self::HousingAtGap { winch, .. } => [housing(winch), None],
            Self::HousingsClose { winch, other, .. } => [housing(winch), housing(other)],
        }
    }

    /// The breach with winches by other numbers: `numbers` are those of the winches that it counts.
    pub fn renumbered(mut self, numbers: &[usize]) -> Self {
        let number = |winch: &mut usize| *winch = numbers.get(*winch).copied().unwrap_or(*winch);
        match &mut self {
            Self::NearSeam { at, .. }
            | Self::ManyHoles { at, .. }
            | Self::SharpTurn { at, .. }
            | Self::Turning { at, .. }
            | Self::Outside { at, .. } => number(&mut at.winch),
            Self::Crowded { at, other, .. } | Self::Along { at, other, .. } => {
                number(&mut at.winch);
                number(&mut other.winch);
            }
            Self::ThroughWinch { at, winch, .. } => {
                number(&mut at.winch);
                number(winch);
            }
            Self::HousingOutside { winch, .. } | Self::HousingAtGap { winch, .. } => number(winch),
            Self::HousingsClose { winch, other, .. } => {
                number(winch);
                number(other);
            }
            Self::ThinBody { .. } => {}
        }
        self
    }

    /// By how many times the rule is broken, at least 1: what a search brings down and a list is sorted by.
    pub fn severity(&self) -> f64 {
        // A rule may be set to 0.
        let below = |is: f64, least: f64| 1.0 + (least - is) / least.max(1.0);
        let above = |is: f64, most: f64| 1.0 + (is - most) / most.max(1.0);
        match *self {
            Self::NearSeam { distance_mm, least_mm, .. } => below(distance_mm, least_mm),
            Self::Crowded { distance_mm, least_mm, .. } => below(distance_mm, least_mm),
            Self::ManyHoles { holes, most, .. } => above(holes as f64, most as f64),
            Self::SharpTurn { degrees, most, .. } | Self::Turning { degrees, most, .. } => above(degrees, most),
            Self::Along { length_mm, most_mm, .. } => above(length_mm, most_mm),
            Self::ThroughWinch { distance_mm, least_mm, .. } => below(distance_mm, least_mm),
            Self::Outside { length_mm, most_mm, .. } => above(length_mm, most_mm),
            Self::ThinBody { room_mm, housing_mm } => below(room_mm, housing_mm),
            Self::HousingOutside { room_mm, housing_mm, .. } => below(room_mm, housing_mm),
            Self::HousingAtGap { gap_mm, housing_mm, .. } => below(gap_mm, housing_mm),
            Self::HousingsClose { distance_mm, least_mm, .. } => below(distance_mm, least_mm),
        }
    }
}

/// The breaches that are worth saying first, the most severe one first; of equal ones, the one found first.
pub fn most_severe(breaches: &[Breach], count: usize) -> Vec<Breach> {
    let mut sorted = breaches.to_vec();
    sorted.sort_by(|a, b| b.severity().total_cmp(&a.severity()));
    sorted.truncate(count);
    sorted
}
