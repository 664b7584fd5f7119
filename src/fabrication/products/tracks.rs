//! The tracks: cable wound by each winch over time.

use crate::design::Design;
use crate::fabrication::error::ExportError;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::table::{Column, Table, Values};
use crate::motion::Trajectory;

/// The table `tracks`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let (motor, radius) = (&source.design.controller, source.design.fabrication.spool_radius_mm);
    let guide = format!(
        "  Cable wound by each winch in mm (0: at rest, just slack) and as encoder counts,
  4 * encoder_lines * gear_ratio * length / (2 pi * spool_radius_mm), with {} lines, gear {}, radius {radius} mm.
  The motor must pull when counts grow.
",
        motor.encoder_lines, motor.gear_ratio
    );
    let table = table(source.design, source.trajectory);
    Ok(Part { products: vec![Product::new("tracks", Content::Table(table))], guide, remarks: Vec::new() })
}

/// `time_s` and, winch by winch, `<winch>_mm` and `<winch>_counts`.
fn table(design: &Design, trajectory: &Trajectory) -> Table {
    let settings = vec![
        ("encoder_lines", design.controller.encoder_lines.to_string()),
        ("gear_ratio", design.controller.gear_ratio.to_string()),
        ("spool_radius_mm", design.fabrication.spool_radius_mm.to_string()),
    ];
    let mut columns = vec![Column::new("time_s", Values::Figures(trajectory.times_s.clone()))];
    for (k, winch) in trajectory.winches.iter().enumerate() {
        let lengths = trajectory.lengths_mm.iter().map(|row| row[k]).collect();
        let counts = trajectory.counts.iter().map(|row| row[k]).collect();
        columns.push(Column::new(format!("{winch}_mm"), Values::Figures(lengths)));
        columns.push(Column::new(format!("{winch}_counts"), Values::Counts(counts)));
    }
    Table { settings, columns }
}
