//! `remesh`: another resolution under a design that is already posed and rigged.

use super::document;
use super::error::CommandError;
use super::output::{say, say_json};
use crate::files::shown;
use crate::mesh::Size;
use crate::operations::Context;
use crate::operations::remesh::{self, Error, Options, Report};
use crate::outline::Point;
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Format of what `remesh --json` prints.
const FORMAT: &str = "plushwright-remesh/1";
/// How many of the parts that moved farthest are named.
const NAMED: usize = 5;

/// Change the resolution of a design; keep its pins, poses, networks and keyframes
///
/// Everything is carried over by where it lies at rest, and how far each part moved is reported. Winches keep their activations;
/// `rig` or `key` fits them to the new mesh.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright remesh pig.plush -o fine.plush --fibers 1000")]
#[command(group(clap::ArgGroup::new("wanted").required(true).args(["fibers", "edge"])))]
pub struct Remesh {
    /// Design file to read
    pub design: PathBuf,
    #[command(flatten)]
    pub target: document::Target,
    /// Muscle fibres (mesh edges) to aim for
    #[arg(long, value_name = "N", alias = "fibres")]
    pub fibers: Option<usize>,
    /// Typical length of a mesh edge in mm, instead of a number of fibres
    #[arg(long, value_name = "MM", value_parser = parse_length)]
    pub edge: Option<f64>,
    /// Simulate on a mesh this many times finer than the fibres' own
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=16))]
    pub finer: u16,
    /// A line along which mesh edges shall run, for thread to follow: corners in mm; may be repeated. It is added to the
    /// design's drawing, whose tracks every other mesh follows too
    #[arg(long, value_name = "X,Y X,Y...", value_parser = parse_track, allow_hyphen_values = true)]
    pub track: Vec<Track>,
    /// Drop the tracks that the design has
    #[arg(long)]
    pub no_tracks: bool,
    /// Do not make the mesh of a symmetric outline symmetric
    #[arg(long)]
    pub no_mirror: bool,
    /// Print the report as JSON
    #[arg(long)]
    pub json: bool,
}

/// Corners of a track, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Track(pub Vec<Point>);

impl Remesh {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let size = match (self.fibers, self.edge) {
            (Some(fibers), _) => Size::Fibers(fibers),
            (None, Some(length)) => Size::EdgeMm(length),
            (None, None) => return Err(CommandError::Usage("either --fibers or --edge is needed".into())),
        };
        let options = Options {
            size,
            finer: usize::from(self.finer),
            tracks: self.track.iter().map(|Track(track)| track.clone()).collect(),
            keep_tracks: !self.no_tracks,
            mirror: !self.no_mirror,
        };
        let report = remesh::run(&mut design, &options, &Context::new(cancel)).map_err(|error| match error {
            Error::Mesh(_) | Error::Edit(_) => CommandError::input(&self.design, error),
            Error::Cancelled(_) => CommandError::Cancelled,
        })?;
        edit.save(&design, cancel)?;
        if self.json { say_json(out, FORMAT, &report) } else { print(self.target.path(&self.design), &report, out) }
    }
}

/// A report of what was carried over, in lines.
pub fn print(output: &Path, report: &Report, out: &mut dyn Write) -> Result<(), CommandError> {
    let from_to = |[a, b]: [usize; 2]| format!("{a} -> {b}");
    say(
        out,
        &format!(
            "{}: fibers {}, nodes {}, triangles {}",
            shown(output),
            from_to(report.fibers),
            from_to(report.nodes),
            from_to(report.triangles)
        ),
    )?;
    let mut moved: Vec<_> = report.moved.iter().collect();
    moved.sort_by(|a, b| b.distance_mm.total_cmp(&a.distance_mm));
    say(out, &format!("{} parts carried over, the farthest by {:.2} mm", moved.len(), report.farthest_mm()))?;
    for part in moved.iter().take(NAMED) {
        say(out, &format!("  {:<36} {:.2} mm", part.what, part.distance_mm))?;
    }
    if report.merged + report.added > 0 {
        say(out, &format!("via points: {} fell together, {} put in", report.merged, report.added))?;
    }
    for [network, tendon] in &report.lost_tendons {
        say(out, &format!("networks[{network}].tendons[{tendon}] is too short for this mesh; it has one edge now"))?;
    }
    Ok(())
}

fn parse_length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length.is_finite() && length > 0.0 => Ok(length),
        _ => Err(format!("expected a length in mm above 0, found `{text}`")),
    }
}

fn parse_track(text: &str) -> Result<Track, String> {
    let explain = || format!("expected at least two corners `X,Y X,Y` in mm, found `{text}`");
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(explain);
    let corner = |word: &str| {
        let (x, y) = word.split_once(',').ok_or_else(explain)?;
        Ok([number(x)?, number(y)?])
    };
    let corners: Vec<Point> = text.split_whitespace().map(corner).collect::<Result<_, String>>()?;
    if corners.len() >= 2 { Ok(Track(corners)) } else { Err(explain()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tracks_read_back() {
        assert_eq!(parse_track("1,2 -3.5,4e1"), Ok(Track(vec![[1.0, 2.0], [-3.5, 40.0]])));
        for bad in ["", "1,2", "1 2", "1,2 3", "nan,1 2,3"] {
            assert!(parse_track(bad).unwrap_err().contains(&format!("`{bad}`")), "{bad}");
        }
    }
}
