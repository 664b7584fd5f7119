//! `rig --explore`: the error against the number of winches and of tendons.

use super::error::CommandError;
use super::output::{CURVE_HEADING, CURVE_MARK, Kind, Output, Replace};
use super::words;
use crate::bench::plot::{Plot, Series};
use crate::bench::{Cell, Table};
use crate::files::{self, shown};
use crate::operations::explore::Point;
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Whether and where the curve is told.
#[derive(Debug, Args)]
pub struct Explore {
    /// Find a rig with every number of winches and tendons up to the most, print the errors, and keep the best rig
    #[arg(long)]
    pub explore: bool,
    /// CSV file to write the table to
    #[arg(long, value_name = "FILE", requires = "explore")]
    pub csv: Option<PathBuf>,
    /// SVG file to write the curves to
    #[arg(long, value_name = "FILE", requires = "explore")]
    pub plot: Option<PathBuf>,
}

/// Files of a curve, asked for before the work begins.
pub struct Files<'a> {
    csv: Option<Output<'a>>,
    plot: Option<Output<'a>>,
}

impl Explore {
    /// # Errors
    /// A file that may not be written.
    pub fn files(&self, design: &Path, force: bool) -> Result<Files<'_>, CommandError> {
        fn output<'a>(
            path: Option<&'a PathBuf>,
            kind: Kind,
            design: &Path,
            force: bool,
        ) -> Result<Option<Output<'a>>, CommandError> {
            path.map(|path| Output::new(path, kind, Replace { force }, [design.to_path_buf()])).transpose()
        }
        if let (Some(csv), Some(plot)) = (&self.csv, &self.plot)
            && (csv == plot || files::same(csv, plot))
        {
            return Err(CommandError::Usage(format!("--csv and --plot are both {}", shown(csv))));
        }
        Ok(Files {
            csv: output(self.csv.as_ref(), Kind::Table, design, force)?,
            plot: output(self.plot.as_ref(), Kind::Plot, design, force)?,
        })
    }
}

impl Files<'_> {
    /// Writes what was asked for.
    ///
    /// # Errors
    /// A file cannot be written, a plot cannot be drawn.
    pub fn write(&self, points: &[Arc<Point>], cancel: &AtomicBool) -> Result<(), CommandError> {
        if let Some(csv) = &self.csv {
            csv.write(table(points).csv().as_bytes(), cancel)?;
        }
        if let Some(file) = &self.plot {
            let svg = plot(points).svg().map_err(|error| CommandError::Failed(error.to_string()))?;
            file.write(format!("{CURVE_MARK}\n{svg}").as_bytes(), cancel)?;
        }
        Ok(())
    }
}

pub(super) fn table(points: &[Arc<Point>]) -> Table {
    let fixed = [
        CURVE_HEADING,
        "tendons each",
        "takes winches",
        "takes tendons",
        "holes",
        "cable (mm)",
        "worst pose (% of rest)",
    ];
    let caption = "The worst pose as a part of its error at rest, where it is to be sewn as a maker may expect it (the mean of as drawn, sewn as a rule and at worst); each pose as check says it, in % of body length";
    let mut table = Table::new("winches", caption, &fixed);
    let poses = points.first().map_or(&[][..], |point| &point.poses);
    table.headings.extend(poses.iter().map(|pose| pose.name.clone()));
    for point in points {
        let [winches, tendons] = point.takes;
        let mut row: Vec<Cell> = vec![point.winches.into(), point.tendons.into(), winches.into(), tendons.into()];
        row.extend([point.holes.into(), point.thread_mm.round().into(), (100.0 * point.worst).into()]);
        row.extend(point.poses.iter().map(|pose| Cell::Number(100.0 * pose.error)));
        table.push(row);
    }
    table
}

/// A curve for each number of winches.
fn plot(points: &[Arc<Point>]) -> Plot {
    let most = points.iter().map(|point| point.winches).max().unwrap_or(0);
    let curve = |winches: usize| {
        let own = points.iter().filter(|point| point.winches == winches);
        let label = words::count(winches, "winch", "winches");
        Series::line(label, own.map(|point| (point.tendons as f64, 100.0 * point.worst)).collect())
    };
    Plot {
        name: "winches".into(),
        title: "What more winches and tendons bring".into(),
        x_label: "tendons of each winch".into(),
        y_label: "worst pose, % of its error at rest".into(),
        series: (1..=most).map(curve).collect(),
        ..Plot::default()
    }
}
