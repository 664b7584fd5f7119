//! `pose`: pins of the design and targets of a named pose.

use super::document;
use super::error::CommandError;
use super::output::say;
use super::place::{Move, body_point, parse_move, parse_point};
use crate::defaults;
use crate::design::edit::{self, EditError};
use crate::design::{Design, Pin, Pose as DesignPose, Target};
use crate::files::shown;
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::Point;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Add pins to a design and targets to one of its poses
///
/// Places are in mm, y up, origin at the lower left corner of the rest silhouette's box, and mean points of the body at rest.
/// A pose that does not exist is created. A target or pin on a point that has one replaces it.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: plushwright pose pig.plush --name wave --pin 60,5 --pin 180,5 --target 200,230=150,240 -o pig.plush"
)]
pub struct Pose {
    /// Design file to read
    pub design: PathBuf,
    /// Name of the pose
    #[arg(long, value_name = "P")]
    pub name: String,
    /// Hold this point of the body where it is at rest (mm; repeatable)
    #[arg(long = "pin", value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    pub pins: Vec<Point>,
    /// Pull the point X,Y of the body at rest to X2,Y2 (mm; repeatable)
    #[arg(long = "target", value_name = "X,Y=X2,Y2", value_parser = parse_move, allow_hyphen_values = true)]
    pub targets: Vec<Move>,
    #[command(flatten)]
    pub target: document::Target,
}

impl Pose {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        add(&mut design, &self.name, &self.pins, &self.targets)?;
        edit.save(&design, cancel)?;
        let targets = design.poses.iter().find(|p| p.name == self.name).map_or(0, |p| p.targets.len());
        say(
            out,
            &format!(
                "{}: pose {} has {targets} targets; {} pins, {} poses",
                shown(&self.target.output),
                self.name,
                design.pins.len(),
                design.poses.len()
            ),
        )
    }
}

/// Adds pins to `design` and targets to its pose `name`, which is created where it is missing.
pub fn add(design: &mut Design, name: &str, pins: &[Point], targets: &[Move]) -> Result<(), CommandError> {
    for &p in pins {
        let pin = Pin { at: body_point(&design.mesh, p)?, position: None, stiffness: defaults::PIN_STIFFNESS };
        let old = design.pins.iter().position(|old| same(&design.mesh, &old.at, &pin.at));
        match old {
            Some(index) => edit::set_pin(design, index, pin),
            None => edit::add_pin(design, pin).map(|_| ()),
        }
        .map_err(refused)?;
    }
    let name = name.trim();
    let index = match design.poses.iter().position(|p| p.name == name) {
        Some(index) => index,
        None => edit::add_pose(design, DesignPose { name: name.to_owned(), targets: Vec::new() }).map_err(refused)?,
    };
    for target in targets {
        let target = Target { at: body_point(&design.mesh, target.from)?, to: target.to, weight: 1.0 };
        let old = design.poses[index].targets.iter().position(|old| same(&design.mesh, &old.at, &target.at));
        match old {
            Some(old) => edit::set_target(design, index, old, target),
            None => edit::add_target(design, index, target).map(|_| ()),
        }
        .map_err(refused)?;
    }
    Ok(())
}

fn refused(error: EditError) -> CommandError {
    CommandError::Usage(error.to_string())
}

/// Whether two points of the body are the same place at rest.
fn same(mesh: &Mesh, a: &BodyPoint, b: &BodyPoint) -> bool {
    /// A micrometre: far below what anybody types, far above rounding.
    const SAME_MM: f64 = 1e-3;
    let (p, q) = (mesh.position(a, &mesh.nodes), mesh.position(b, &mesh.nodes));
    (p[0] - q[0]).hypot(p[1] - q[1]) < SAME_MM
}
