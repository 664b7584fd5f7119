//! What the clean-up of a silhouette changed.

use super::notes::{Note, Remedy};
use serde::Serialize;

/// A step of the clean-up that changed something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum What {
    /// Tiny islands left out.
    Specks,
    /// Tiny holes filled.
    Pinholes,
    /// Slits between parts that share a boundary closed.
    Slits,
    /// Holes filled as asked.
    Holes,
    /// Other pieces left out as asked.
    Pieces,
    /// Thin parts widened.
    ThinParts,
    /// Hair, finer than scissors follow, shaved off.
    Hairs,
    /// Points in which the boundary touched itself joined.
    Pinches,
    /// Boundary smoothed as asked.
    Smoothing,
}

/// One step of the clean-up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Change {
    pub what: What,
    /// How many islands, holes, parts or points.
    pub count: usize,
    /// Area added or removed, as a part of the silhouette's area.
    pub area: f64,
    /// Whether an option asked for it.
    pub asked: bool,
}

/// Steps and notes that lie between the painted areas and the outline.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Changes {
    /// Area of all that is painted, mm^2.
    pub painted_mm2: f64,
    /// Area of the outline, mm^2.
    pub outline_mm2: f64,
    /// Area that the clean-up added or removed without being asked, as a part of the silhouette's area: at most 2 %, hair aside.
    pub unasked: f64,
    pub steps: Vec<Change>,
    /// Notes of the reader and the clean-up. Whoever writes this down words them.
    #[serde(skip)]
    pub notes: Vec<Note>,
}

impl Change {
    /// The setting that would have it otherwise.
    pub fn remedy(&self) -> Option<Remedy> {
        (self.what == What::Slits).then_some(Remedy::Gap)
    }

    /// The step in words, for one line.
    pub fn line(&self) -> String {
        let count = |one: &str, many: &str| match self.count {
            1 => format!("1 {one}"),
            n => format!("{n} {many}"),
        };
        let what = match self.what {
            What::Specks => count("tiny island", "tiny islands") + " left out",
            What::Pinholes => count("pinhole", "pinholes") + " closed",
            What::Slits => count("slit", "slits") + " finer than scissors cut closed",
            What::Holes => count("hole", "holes") + " filled",
            What::Pieces => count("smaller piece", "smaller pieces") + " left out",
            What::ThinParts => count("thin part", "thin parts") + " widened",
            What::Hairs => count("hair", "hairs") + " finer than scissors follow shaved off",
            What::Pinches => count("pinched point", "pinched points") + " joined",
            What::Smoothing => "boundary smoothed".to_owned(),
        };
        format!("{what} ({:.2} % of the area)", 100.0 * self.area)
    }
}

impl Changes {
    pub(super) fn add(&mut self, what: What, count: usize, area: f64, asked: bool) {
        if count > 0 {
            self.steps.push(Change { what, count, area, asked });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_told_in_words() {
        let mut changes = Changes::default();
        changes.add(What::Specks, 0, 0.0, false);
        changes.add(What::Pinches, 1, 0.0001, false);
        changes.add(What::Holes, 3, 0.25, true);
        assert_eq!(
            changes.steps.iter().map(Change::line).collect::<Vec<_>>(),
            ["1 pinched point joined (0.01 % of the area)", "3 holes filled (25.00 % of the area)"]
        );
    }
}
