//! `check`: the figures of a design.

use super::error::CommandError;
use super::output::say_json;
use super::{document, table, words};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Format of what `check --json` prints.
const FORMAT: &str = "plushwright-check/1";

/// Print sizes, and how close both plushies come to each pose
///
/// Target errors are rms distances in body lengths (the longer side of the rest silhouette's box); times are in ms. Where a
/// plushie does not come to equilibrium the figures are those of the nearest state found, and the exit code is 3.
/// With friction, by option or by the design's `tendons.friction`, it also says how close the realizable plushie comes when its cables rub:
/// at the activations that are best when all cables have been pulled (`error_realizable_friction`), and at the same ones when they have been
/// let out (`error_realizable_letting_out`). In between, the plushie stays where it was.
/// With `--sewn` it says what a hand's inaccuracy costs (`error_realizable_sewn`, median and worst): the plushie is sewn a few times in
/// thought, every hole 2 mm and every winch 1 mm off in a seeded direction, and each is posed anew.
/// What no hand can sew by the design's rules is listed: places at rest, and pieces of cable that leave the body in a pose. The JSON has
/// them as `sewing`: rule, winch, tendon and piece counted from 1, hole counted from the winch (number 0), value, limit (mm, degrees or a
/// count) and severity (value to limit, 1 at the limit).
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright check pig.plush --json")]
pub struct Check {
    /// Design file to read
    pub design: PathBuf,
    /// Print JSON; errors as fractions of the body length
    #[arg(long)]
    pub json: bool,
    /// Coefficient of friction of the cables at their holes, 0 to 1 (the design's own, unless given)
    #[arg(long, value_name = "MU", allow_hyphen_values = true)]
    pub friction: Option<f64>,
    /// Work out what is left of each pose when a hand sews the plushie, no hole where it should be
    #[arg(long)]
    pub sewn: bool,
}

impl Check {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let figures = table::figures(&design, self.friction, self.sewn, cancel)?;
        if self.json {
            say_json(out, FORMAT, &figures)?;
        } else {
            table::print(&figures, out)?;
        }
        words::balanced(table::unbalanced(&figures))
    }
}
