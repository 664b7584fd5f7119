//! Drawing the outline: from parts, by hand, and a new body made of it.
//!
//! The drawing is part of the document, so that every stroke can be undone; the body stays as it is until a new one is made.

use super::canvas::Camera;
use super::change::Change;
use super::jobs::Outcome;
use super::session::{Mode, Session};
use super::words;
use crate::design::Design;
use crate::operations::reshape::{self, Error, Note, Options, Reshaped, Source};
use crate::operations::{Context, FiberCount};
use crate::outline::drawing::{Item, Primitive};
use crate::outline::{Drawing, Outline};

/// The tool that an empty sheet begins with.
pub const FREEHAND: &str = "tool.freehand";

/// What is asked for while the outline is drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Sketch {
    Open(bool),
    /// Whether new parts are cut out.
    Cut(bool),
    /// A part or a track, and a point of it.
    Select(Option<Item>, Option<usize>),
    Camera(Option<Camera>),
    /// Makes the body of what is drawn; one undo step when it is there.
    MakeBody,
}

#[derive(Default)]
pub struct Sketching {
    pub open: bool,
    pub cut: bool,
    /// What is picked out, and which point of a path or track.
    pub item: Option<Item>,
    pub point: Option<usize>,
    /// There is no body yet worth looking at.
    pub fresh: bool,
    /// `None`: fits the drawing.
    pub camera: Option<Camera>,
    /// A drawing of the outline that has none of its own.
    traced: Option<(Outline, Drawing)>,
}

impl Session {
    pub fn sketching(&self) -> &Sketching {
        &self.sketching
    }

    /// The drawing of the outline: the document's, or one traced from its outline.
    pub fn drawing(&self) -> &Drawing {
        static NOTHING: Drawing = Drawing { parts: Vec::new(), tracks: Vec::new() };
        let traced = self.sketching.traced.as_ref().map(|(_, drawing)| drawing);
        self.design().drawing.as_ref().or(traced).unwrap_or(&NOTHING)
    }

    pub(super) fn sketch(&mut self, sketch: Sketch) {
        match sketch {
            Sketch::Open(open) => {
                self.sketching.open = open;
                self.sketching.camera = None;
                self.playback.playing = false;
                self.mode = Mode::Pose;
                self.clamp();
            }
            Sketch::Cut(cut) => self.sketching.cut = cut,
            Sketch::Select(item, point) => {
                self.sketching.item = item;
                self.sketching.point = point;
                self.clamp_sketch();
            }
            Sketch::Camera(camera) => {
                self.sketching.camera = camera;
                self.look.zoom = None;
            }
            Sketch::MakeBody => self.start_body(),
        }
    }

    /// Nothing may point beyond the drawing, and there is one while it is open.
    pub(super) fn clamp_sketch(&mut self) {
        if !self.sketching.open {
            return;
        }
        let design = self.history.current().clone();
        let stale = self.sketching.traced.as_ref().is_none_or(|(outline, _)| *outline != design.outline);
        if design.drawing.is_none() && stale {
            self.sketching.traced = Some((design.outline.clone(), Drawing::of(&design.outline)));
        }
        self.sketching.item = self.sketching.item.filter(|&item| self.drawing().has(item));
        let points = match self.sketching.item {
            Some(Item::Part(part)) => match &self.drawing().parts[part].primitive {
                Primitive::Path { points } => points.len(),
                _ => 0,
            },
            Some(Item::Track(track)) => self.drawing().tracks[track].len(),
            None => 0,
        };
        self.sketching.point = self.sketching.point.filter(|&point| point < points);
    }

    /// Removes the point, or else the part or track, that is picked out.
    pub(super) fn delete_drawn(&mut self) {
        let Some(item) = self.sketching.item.filter(|&item| self.drawing().has(item)) else { return };
        let thinner = self.sketching.point.and_then(|point| self.drawing().without_point(item, point));
        let (what, drawing) = match (thinner, item) {
            (Some(drawing), _) => ("Delete point", drawing),
            (None, Item::Part(_)) => ("Delete part", self.drawing().without(item)),
            (None, Item::Track(_)) => ("Delete track", self.drawing().without(item)),
        };
        if what != "Delete point" {
            self.sketching.item = None;
        }
        self.sketching.point = None;
        self.change(Change::Draw { what, drawing });
    }

    fn start_body(&mut self) {
        if self.meshing.running.is_some() {
            return;
        }
        let fibers = match self.meshing.wanted {
            None => FiberCount::Usual,
            // What an empty sheet begins with was nobody's wish.
            Some(resolution) if self.sketching.fresh => FiberCount::AtLeast(resolution.fibers),
            Some(resolution) => FiberCount::Exactly(resolution.fibers),
        };
        let options = Options { fibers, finer: self.resolution().finer, ..Options::default() };
        let (design, drawing) = (self.design().clone(), self.drawing().clone());
        self.meshing.running = Some(self.jobs.start("Meshing", move |cancel| {
            let made = reshape::prepare(&design, Source::Drawing(&drawing), &options, &Context::new(cancel));
            Outcome::Reshaped(made.map(Box::new))
        }));
    }

    /// Gives the design as it is by now the body that was drawn.
    pub(super) fn take_body(&mut self, serial: u64, made: Result<Box<Reshaped>, Error>) {
        if !self.is_meshed(serial) {
            return;
        }
        let told = made.as_ref().map(|made| (words::changes(&made.changes).collect::<Vec<_>>(), made.notes.clone()));
        let (lines, notes) = told.unwrap_or_default();
        let made = made.and_then(|made| Ok(self.history.edit("New body", |design| made.apply(design))?));
        let report = match made {
            Ok(report) => report,
            Err(error) => return self.messages.error(format!("New body: {}", words::unshaped(&error))),
        };
        self.meshing.wanted = None;
        self.look.camera = None;
        self.sketching.fresh = false;
        self.sketch(Sketch::Open(false));
        self.tell_carried(&report);
        for line in lines {
            self.messages.info(line);
        }
        for Note::MoreFibers { asked, count } in notes {
            self.messages.info(words::more_fibers(asked, count));
        }
    }
}

/// A plushie that is still to be drawn: an empty sheet over a cushion.
pub fn sheet() -> Design {
    Design { name: "Plushie".to_owned(), drawing: Some(Drawing::default()), ..super::blank::design() }
}
