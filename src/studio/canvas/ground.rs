//! A piece of the plane on the screen, in this frame.

use super::camera::Camera;
use super::hit::{self, Hit};
use super::plushie::Plushie;
use super::surface::Surface;
use crate::engine::Shape;
use crate::mesh::BodyPoint;
use crate::outline::Point;
use crate::outline::drawing::Item;
use crate::studio::action::Action;
use crate::studio::action::Sketch;
use crate::studio::session::Session;
use eframe::egui::{Pos2, Rect};

/// The canvas as a tool is given it: what there is, where it is shown, and how.
#[derive(Clone, Copy)]
pub struct Canvas<'a> {
    pub session: &'a Session,
    pub rect: Rect,
    pub camera: Camera,
    pub ground: Ground<'a>,
}

/// The thing that a tool works on.
#[derive(Clone, Copy)]
pub enum Ground<'a> {
    /// The body of a plushie, as it is shown; nothing where it is not solved yet.
    Plushie(Plushie, Option<&'a Shape>),
    /// The drawing of the outline, and what its parts cover.
    Outline(&'a Surface),
}

impl Canvas<'_> {
    pub fn mm_per_pixel(&self) -> f64 {
        f64::from(1.0 / self.camera.scale)
    }

    pub fn to_screen(&self, p: Point) -> Pos2 {
        self.camera.to_screen(self.rect, p)
    }

    /// mm.
    pub fn to_body(&self, p: Pos2) -> Point {
        self.camera.to_body(self.rect, p)
    }

    /// The part of the plushie under a point; of the outline nothing.
    pub fn hit(&self, p: Point) -> Hit {
        match self.ground {
            Ground::Plushie(_, Some(shape)) => {
                hit::test(self.session.design(), self.session.targets(), &shape.nodes, p, self.mm_per_pixel())
            }
            _ => Hit::Nothing,
        }
    }

    /// The point of the body under a point of the view, whatever lies over it.
    pub fn body(&self, p: Point) -> Option<BodyPoint> {
        match self.ground {
            Ground::Plushie(_, Some(shape)) => {
                hit::body_point(&self.session.design().mesh, &shape.nodes, p, self.mm_per_pixel())
            }
            _ => None,
        }
    }

    /// The part or track that is picked out.
    pub fn picked(&self) -> Option<Item> {
        self.session.sketching().item.filter(|&item| self.session.drawing().has(item))
    }

    /// Shows it with another camera.
    pub fn look(&self, camera: Camera) -> Action {
        match self.ground {
            Ground::Plushie(plushie, _) => Action::SetCamera(plushie, camera),
            Ground::Outline(_) => Action::Sketch(Sketch::Camera(Some(camera))),
        }
    }

    /// Moves what is shown so that what was at `from` is at `to`.
    pub fn pan(&self, from: Point, to: Point) -> Action {
        let center = [0, 1].map(|axis| self.camera.center[axis] + from[axis] - to[axis]);
        self.look(Camera { center, ..self.camera })
    }
}
