//! `render`: a picture of both plushies.

use super::error::CommandError;
use super::output::{Kind, Output, Replace, say, say_json};
use super::picture::PictureFormat;
use super::{document, progress, words};
use crate::design::{Design, file};
use crate::files::shown;
use crate::operations::film::{self, Options as Film};
use crate::operations::render::{self, Error, Note, Options, Rendered, What};
use crate::operations::{Context, Progress, Unbalanced};
use crate::picture::LOOKS;
use clap::Args;
use clap::builder::PossibleValuesParser;
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Draw both plushies, idealized left and realizable right, as a picture
///
/// A plushie that does not come to equilibrium is drawn in the nearest state found, and the exit code is 3.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright render pig.plush -o pig.png --pose wave --size 1280x720")]
pub struct Render {
    /// Design file to read
    pub design: PathBuf,
    /// Picture to write: PNG, JPEG where it is called *.jpg; the whole animation where it is called *.gif, or *.html for a page that plays it
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
    /// Write the whole animation as numbered PNG pictures into the folder OUT
    #[arg(long, conflicts_with_all = ["pose", "time"])]
    pub pictures: bool,
    /// Pictures of an animation in a second, 1 to 60
    #[arg(long, value_name = "N", default_value_t = 12.5, value_parser = parse_rate)]
    pub rate: f64,
    /// Width and height in pixels, each 16 to 8192 [default: 1280x720, of an animation 640x360]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// How the body is shown: plain, plush (stuffed, in soft light), wireframe, contraction (of fibres), force (of cables), strain, crumpling, gap (between the plushies)
    #[arg(long, value_name = "LOOK", default_value = "plain", value_parser = look_names())]
    pub look: String,
    /// Leave the design's texture out
    #[arg(long)]
    pub no_texture: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `render --json` prints.
const FORMAT: &str = "plushwright-render/1";

/// What `render --json` prints.
#[derive(Serialize)]
struct Summary {
    picture: String,
    width: u32,
    height: u32,
    /// Of a pose: rms distance of the targets in body lengths.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_idealized: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error_realizable: Option<f64>,
    /// What the colours stand for, and of what range.
    #[serde(skip_serializing_if = "Option::is_none")]
    colors: Option<Colors>,
}

#[derive(Serialize)]
struct Colors {
    title: &'static str,
    unit: &'static str,
    from: f64,
    to: f64,
}

impl Render {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let inputs = [Some(self.design.clone()), file::texture_path(&design, &self.design)];
        let inputs: Vec<PathBuf> = inputs.into_iter().flatten().collect();
        if self.pictures {
            return self.numbered(&design, &inputs, out, cancel);
        }
        let output = Output::new(&self.output, Kind::Picture, self.replace, inputs)?;
        let format = PictureFormat::of(&self.output)?;
        let kind = match format {
            PictureFormat::Gif => Some(film::Kind::Gif),
            PictureFormat::Page => Some(film::Kind::Page),
            PictureFormat::Png | PictureFormat::Jpeg => None,
        };
        let kind = kind.filter(|_| self.pose.is_none() && self.time.is_none());
        let size = self.size.unwrap_or(if kind.is_none() { Options::default().size } else { Film::default().size });
        let (bytes, rendered) = match kind {
            None => {
                let what = match (&self.pose, self.time) {
                    (Some(pose), _) => What::Pose(pose.clone()),
                    (None, Some(time)) => What::Time(time),
                    (None, None) => What::Rest,
                };
                let rendered = self.picture(&design, what, size, cancel)?;
                (format.encoded(rendered.png.clone())?, rendered)
            }
            Some(kind) => {
                let film::Filmed { film, last, .. } = self.animation(&design, kind, size, cancel)?;
                let film::Film::File(bytes) = film else { return Err(CommandError::Failed("no film".into())) };
                (bytes, last)
            }
        };
        for note in rendered.notes.iter().filter(|note| matches!(note, Note::NoTexture { .. }) && !self.json) {
            say(out, &format!("note: {note}"))?;
        }
        output.write(&bytes, cancel)?;
        self.tell(out, &rendered, size)?;
        words::balanced(unbalanced(&rendered))
    }

    fn picture(
        &self,
        design: &Design,
        what: What,
        size: (u32, u32),
        cancel: &AtomicBool,
    ) -> Result<Rendered, CommandError> {
        let options = Options { what, size, texture: !self.no_texture, look: self.look.clone() };
        render::run(design, &self.design, &options, &Context::new(cancel)).map_err(|error| failed(&self.design, error))
    }

    /// The whole animation as numbered pictures.
    fn numbered(
        &self,
        design: &Design,
        inputs: &[PathBuf],
        out: &mut dyn Write,
        cancel: &AtomicBool,
    ) -> Result<(), CommandError> {
        if inputs.iter().any(|input| input.starts_with(&self.output)) {
            let path = shown(&self.output);
            return Err(CommandError::Usage(format!("{path} holds what is read; choose another folder")));
        }
        let size = self.size.unwrap_or(Film::default().size);
        let filmed = self.animation(design, film::Kind::Pictures, size, cancel)?;
        filmed.film.write(&self.output).map_err(CommandError::Failed)?;
        self.tell(out, &filmed.last, size)?;
        words::balanced(unbalanced(&filmed.last))
    }

    /// All of the animation.
    fn animation(
        &self,
        design: &Design,
        kind: film::Kind,
        size: (u32, u32),
        cancel: &AtomicBool,
    ) -> Result<film::Filmed, CommandError> {
        let mut told = |step: &Progress| {
            if let Progress::Picture { done, of } = step {
                progress::at(*done, *of, "pictures");
            }
        };
        let options = Film { kind, size, step_s: 1.0 / self.rate, texture: !self.no_texture, look: self.look.clone() };
        film::run(design, &self.design, &options, &mut Context::telling(cancel, &mut told))
            .map_err(|error| failed(&self.design, error))
    }

    fn tell(&self, out: &mut dyn Write, rendered: &Rendered, (width, height): (u32, u32)) -> Result<(), CommandError> {
        let picture = shown(&self.output);
        if !self.json {
            let bar = rendered.bar.as_ref().map(|bar| format!(", {}", bar.range())).unwrap_or_default();
            return say(out, &format!("{picture}: {width} x {height} pixels{bar}"));
        }
        let error = |view: usize| self.pose.as_ref().map(|_| rendered.shapes[view].target_error);
        let (error_idealized, error_realizable) = (error(0), error(1));
        let bar = rendered.bar.as_ref();
        let colors = bar.map(|bar| Colors { title: bar.title, unit: bar.unit, from: bar.low, to: bar.high });
        say_json(out, FORMAT, &Summary { picture, width, height, error_idealized, error_realizable, colors })
    }
}

/// The plushies that did not come to equilibrium.
fn unbalanced(rendered: &Rendered) -> impl Iterator<Item = &Unbalanced> {
    rendered.notes.iter().filter_map(|note| match note {
        Note::Unbalanced(unbalanced) => Some(unbalanced),
        Note::NoTexture { .. } => None,
    })
}

/// Why there is no picture of a design that was read from `path`.
pub fn failed(path: &Path, error: Error) -> CommandError {
    match error {
        Error::NoSuchPose(error) => words::no_such_pose(&error),
        Error::NoKeyframes => CommandError::input(
            path,
            format!("{error}; `plushwright rig` lays poses on the timeline, `plushwright key` adds one"),
        ),
        Error::OutsideTimeline { .. } => CommandError::input(path, error),
        Error::NoSuchLook(_) => CommandError::Usage(error.to_string()),
        Error::Picture(_) => CommandError::Failed(error.to_string()),
        Error::Cancelled(_) => CommandError::Cancelled,
    }
}

/// The names of the looks, for help and completions.
pub fn look_names() -> PossibleValuesParser {
    LOOKS.iter().map(|look| look.name).collect::<Vec<_>>().into()
}

/// Reads a time, s.
fn parse_time(text: &str) -> Result<f64, String> {
    let time = text.parse::<f64>().ok().filter(|time| time.is_finite());
    time.ok_or_else(|| format!("expected a time in s, found `{text}`"))
}

/// Reads pictures in a second.
fn parse_rate(text: &str) -> Result<f64, String> {
    let rate = text.parse::<f64>().ok().filter(|rate| (1.0..=60.0).contains(rate));
    rate.ok_or_else(|| format!("expected pictures in a second from 1 to 60, found `{text}`"))
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
