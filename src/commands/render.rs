//! `render`: a picture of both plushies.

use super::error::CommandError;
use super::output::{Kind, Output, Replace, say};
use super::{document, key};
use crate::design::animation::activations_at;
use crate::design::texture::find;
use crate::design::{Design, file};
use crate::engine::Question;
use crate::files::shown;
use crate::picture::{self, Texture};
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Draw both plushies, idealized left and realizable right, as PNG
///
/// A plushie that does not come to equilibrium is drawn in the nearest state found, and the exit code is 3.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright render pig.plush -o pig.png --pose wave --size 1280x720")]
pub struct Render {
    /// Design file to read
    pub design: PathBuf,
    /// Picture to write (PNG)
    #[arg(short, long, value_name = "OUT.png")]
    pub output: PathBuf,
    #[command(flatten)]
    pub replace: Replace,
    /// Solve both plushies for this pose [default: at rest]
    #[arg(long, value_name = "P", conflicts_with = "time")]
    pub pose: Option<String>,
    /// Show the animation at this time in s
    #[arg(long, value_name = "S", value_parser = parse_time, allow_hyphen_values = true)]
    pub time: Option<f64>,
    /// Width and height in pixels, each 16 to 8192
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    pub size: (u32, u32),
    /// Leave the design's texture out
    #[arg(long)]
    pub no_texture: bool,
}

impl Render {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let inputs = [Some(self.design.clone()), file::texture_path(&design, &self.design)];
        let output = Output::new(&self.output, Kind::Picture, self.replace, inputs.into_iter().flatten())?;
        let question = match (&self.pose, self.time) {
            (Some(pose), _) => Question::Targets(key::targets(&design, pose)?),
            (None, Some(time)) => {
                if design.keyframes.is_empty() {
                    return Err(CommandError::input(&self.design, "the design has no keyframes to show"));
                }
                Question::Activations(activations_at(&design, time))
            }
            (None, None) => Question::Targets(Vec::new()),
        };
        let place = match (&self.pose, self.time) {
            (Some(pose), _) => pose.clone(),
            (None, Some(time)) => format!("{time} s"),
            (None, None) => "rest".to_owned(),
        };
        let targets = match &question {
            Question::Targets(targets) => targets.clone(),
            Question::Activations(_) => Vec::new(),
        };
        let shapes = key::solve(&design, question, [true, true], cancel)?;
        let texture = if self.no_texture { None } else { texture(&design, &self.design, out)? };
        let bytes = picture::png(&design, &shapes, &targets, texture.as_ref(), self.size)
            .map_err(|e| CommandError::Failed(e.to_string()))?;
        output.write(&bytes, cancel)?;
        say(out, &format!("{}: {} x {} pixels", shown(&self.output), self.size.0, self.size.1))?;
        key::balanced(key::unbalanced(&place, &shapes))
    }
}

/// The texture of a design; one that cannot be read is not drawn, and that is said.
fn texture(design: &Design, from: &Path, out: &mut dyn Write) -> Result<Option<Arc<Texture>>, CommandError> {
    let Some(named) = file::texture_path(design, from) else { return Ok(None) };
    let why = match find(design, from) {
        Ok(None) => return Ok(None),
        Ok(Some(path)) => match Texture::read(&path) {
            Ok(texture) => return Ok(Some(Arc::new(texture))),
            Err(error) => error.to_string(),
        },
        Err(error) => error.to_string(),
    };
    say(out, &format!("note: drawn without its texture {}: {why}", named.display()))?;
    Ok(None)
}

/// Reads a time, s.
fn parse_time(text: &str) -> Result<f64, String> {
    let time = text.parse::<f64>().ok().filter(|time| time.is_finite());
    time.ok_or_else(|| format!("expected a time in s, found `{text}`"))
}

/// Reads `WxH`.
pub fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let explain = || format!("expected WxH in pixels, each from 16 to 8192, found `{text}`");
    let number = |part: &str| part.parse::<u32>().ok().filter(|n| (16..=8192).contains(n)).ok_or_else(explain);
    let (width, height) = text.split_once('x').ok_or_else(explain)?;
    Ok((number(width)?, number(height)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_read_back() {
        assert_eq!(parse_size("1280x720"), Ok((1280, 720)));
        for bad in ["", "1280", "0x10", "-3x40", "1e3x20", "99999x20"] {
            assert!(parse_size(bad).unwrap_err().contains(&format!("`{bad}`")), "{bad}");
        }
    }
}
