//! `demo`: one plushie from bare outline to blueprint, headless, with a picture of every step.

use super::error::CommandError;
use super::output::{check_folder, json, say, write_folder};
use super::{pose, render, rig, table, words};
use crate::design::animation::duration_s;
use crate::design::{Design, file};
use crate::engine::Shape;
use crate::fabrication;
use crate::files::shown;
use crate::mesh::Mesh;
use crate::operations;
use crate::operations::check::Figures;
use crate::operations::new_design::{self, Made};
use crate::operations::pose::Move;
use crate::operations::render::{Rendered, What};
use crate::operations::rig::TendonChoice;
use crate::operations::{Context, FiberCount, Progress};
use crate::outline::Point;
use crate::picture::palette::{Palette, Theme};
use crate::picture::{Item, Scene, raster};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Make the pig from bare outline to blueprint, with pictures and figures of every step
///
/// Needs no display, no graphics adapter and no other file. Ends in less than a minute.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright demo --out demo")]
pub struct Demo {
    /// Folder to write; one made by an earlier `demo` is replaced, any other folder refused
    #[arg(long, value_name = "DIR", default_value = "demo")]
    pub out: PathBuf,
}

const OUTLINE: &[u8] = include_bytes!("../../assets/pig.svg");
const FIBERS: usize = 571;
/// A hand holds the trunk.
const PINS: [Point; 3] = [[162.0, 112.0], [120.0, 110.0], [220.0, 110.0]];
/// The ear tips forward and the leg below it kicks: places of the body at rest and where they go, mm.
const POSES: [(&str, [Move; 2]); 1] =
    [("ear-and-leg", [Move { from: [67.0, 214.0], to: [36.0, 180.0] }, Move { from: [83.0, 10.0], to: [50.0, 40.0] }])];
/// Pictures of the animation.
const FRAMES: usize = 5;
const SIZE: (u32, u32) = (1280, 720);
/// Format of the manifest by which a folder is known to be an earlier result that may be replaced.
const FORMAT: &str = "plushwright-demo/1";
/// Format of its figures.
const FIGURES: &str = "plushwright-demo-figures/1";

impl Demo {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        check_folder(&self.out, FORMAT)?;
        let tour = Tour { files: Vec::new(), out, cancel, clock: Instant::now(), pictures: Vec::new() };
        write_folder(&self.out, FORMAT, &tour.make()?, cancel)?;
        say(out, &format!("Pictures, design, blueprint and figures are in {}", shown(&self.out)))
    }
}

/// Everything `figures.json` holds.
#[derive(Serialize)]
struct Report<'a> {
    format: &'static str,
    #[serde(flatten)]
    figures: &'a Figures,
    seconds: f64,
    pictures: &'a [String],
}

struct Tour<'a> {
    /// Path below the folder, content.
    files: Vec<(String, Vec<u8>)>,
    out: &'a mut dyn Write,
    cancel: &'a AtomicBool,
    clock: Instant,
    pictures: Vec<String>,
}

impl Tour<'_> {
    fn make(mut self) -> Result<Vec<(String, Vec<u8>)>, CommandError> {
        let options = new_design::Options {
            name: "pig".into(),
            fibers: FiberCount::Exactly(FIBERS),
            ..new_design::Options::default()
        };
        let made = new_design::run(OUTLINE, &options, &Context::new(self.cancel));
        let Made { mut design, .. } = made.map_err(|error| words::unmade(Path::new("assets/pig.svg"), error))?;
        self.outline(&design)?;
        self.mesh(&design)?;
        for (name, targets) in POSES {
            let (name, pins, targets) = (name.to_owned(), PINS.to_vec(), targets.to_vec());
            let options = operations::pose::Options { name, pins, targets, ..Default::default() };
            operations::pose::run(&mut design, &options, &Context::new(self.cancel)).map_err(pose::failed)?;
            self.pose(&design, &options.name, "before rigging")?;
        }
        self.rig(&mut design)?;
        for (name, _) in POSES {
            self.pose(&design, name, "rigged")?;
        }
        self.animation(&design)?;
        let text = file::to_text(&design).map_err(|e| CommandError::Failed(e.to_string()))?;
        self.files.push(("pig.plush".into(), text.into_bytes()));
        let figures = table::figures(&design, None, false, self.cancel)?;
        let (files, _) =
            fabrication::blueprint(&design, &Default::default()).map_err(|e| CommandError::Failed(e.to_string()))?;
        let count = files.len();
        self.files.extend(files.into_iter().map(|file| (format!("blueprint/{}", file.name), file.bytes)));
        say(self.out, &format!("{:5.1} s  blueprint  {count} files", self.clock.elapsed().as_secs_f64()))?;
        self.report(&figures)?;
        Ok(self.files)
    }

    fn outline(&mut self, design: &Design) -> Result<(), CommandError> {
        let palette = Palette::of(Theme::Light);
        let loops = std::iter::once(&design.outline.outer).chain(&design.outline.holes);
        let items =
            loops.map(|points| Item::Line { points: points.clone(), width: 3.0, color: palette.seam, closed: true });
        let scene = Scene { items: items.collect() };
        let bytes =
            raster::png(&scene, &scene, SIZE, palette.background).map_err(|e| CommandError::Failed(e.to_string()))?;
        self.save("outline", &bytes, &format!("{} points", design.outline.outer.len()))
    }

    fn mesh(&mut self, design: &Design) -> Result<(), CommandError> {
        let Mesh { nodes, triangles } = &*design.mesh;
        let text =
            format!("{} fibers, {} nodes, {} triangles", design.mesh.edges().len(), nodes.len(), triangles.len());
        self.plushies("mesh", &text, design, What::Rest)
    }

    fn pose(&mut self, design: &Design, name: &str, when: &str) -> Result<(), CommandError> {
        self.plushies(&format!("{name}, {when}"), "", design, What::Pose(name.to_owned()))
    }

    fn rig(&mut self, design: &mut Design) -> Result<(), CommandError> {
        let tendons = TendonChoice::PerWinch(vec![2]);
        let options = operations::rig::Options { max_winches: 1, tendons, ..Default::default() };
        let mut printed = Ok(());
        let out = &mut *self.out;
        let mut progress = |step: &Progress| {
            if printed.is_ok() {
                let told = words::progress(step);
                printed = told.lines().try_for_each(|line| say(out, &format!("     {line}")));
            }
        };
        let mut context = Context::telling(self.cancel, &mut progress);
        operations::rig::run(design, &options, &mut context).map_err(|e| rig::failed(Path::new("pig.plush"), e))?;
        printed
    }

    fn animation(&mut self, design: &Design) -> Result<(), CommandError> {
        for frame in 0..FRAMES {
            let time = duration_s(design) * frame as f64 / (FRAMES - 1) as f64;
            self.plushies(&format!("animation {time:.2} s"), "", design, What::Time(time))?;
        }
        Ok(())
    }

    fn report(&mut self, figures: &Figures) -> Result<(), CommandError> {
        let mut text = Vec::new();
        table::print(figures, &mut text)?;
        self.out.write_all(&text).map_err(CommandError::Print)?;
        self.files.push(("figures.txt".into(), text));
        let report =
            Report { format: FIGURES, figures, seconds: self.clock.elapsed().as_secs_f64(), pictures: &self.pictures };
        self.files.push(("figures.json".into(), (json(&report)? + "\n").into_bytes()));
        Ok(())
    }

    /// A picture of both plushies. Of a pose, it is told how close they come.
    fn plushies(&mut self, title: &str, text: &str, design: &Design, what: What) -> Result<(), CommandError> {
        let posed = matches!(what, What::Pose(_));
        let options = operations::render::Options { what, size: SIZE, texture: false, ..Default::default() };
        let from = Path::new("pig.plush");
        let rendered = operations::render::run(design, from, &options, &Context::new(self.cancel));
        let Rendered { png, shapes, .. } = rendered.map_err(|error| render::failed(from, error))?;
        self.save(title, &png, &if posed { errors(&shapes) } else { text.to_owned() })
    }

    fn save(&mut self, title: &str, bytes: &[u8], text: &str) -> Result<(), CommandError> {
        let words: Vec<String> = title.split([' ', ',']).filter(|w| !w.is_empty()).map(str::to_lowercase).collect();
        let name = format!("{:02}-{}.png", self.pictures.len() + 1, words.join("-"));
        self.files.push((name.clone(), bytes.to_vec()));
        say(self.out, &format!("{:5.1} s  {name}  {text}", self.clock.elapsed().as_secs_f64()))?;
        self.pictures.push(name);
        Ok(())
    }
}

fn errors([idealized, realizable]: &[Shape; 2]) -> String {
    format!(
        "target error: idealized {:.2} %, realizable {:.2} % of the body length",
        100.0 * idealized.target_error,
        100.0 * realizable.target_error
    )
}
