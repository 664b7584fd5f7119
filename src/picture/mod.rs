//! A neutral drawing of a plushie: what the window and the headless pictures both show.
//!
//! A [`Scene`] is a list of primitives in painting order, coordinates in mm (y up). Line widths and disc radii are in
//! logical pixels, so that they stay crisp at every zoom.

pub mod palette;
pub mod quality;
pub mod raster;
pub mod scene;
mod texture;
mod textured;

pub use texture::{Level, Texture};

use crate::outline::Point;
use std::sync::Arc;

/// Straight (not premultiplied) sRGB colour with alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8, pub u8);

#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// Triangles over `points`, one colour.
    Mesh {
        points: Vec<Point>,
        triangles: Vec<[usize; 3]>,
        color: Color,
    },
    /// Triangles over `points` with a picture on them; `places` says where each point lies in it, 0 to 1 from the upper left
    /// corner. What lies outside of it is clear.
    Picture {
        points: Vec<Point>,
        places: Vec<Point>,
        triangles: Vec<[usize; 3]>,
        texture: Arc<Texture>,
    },
    /// A polyline, round caps and joins.
    Line {
        points: Vec<Point>,
        width: f32,
        color: Color,
        closed: bool,
    },
    Disc {
        center: Point,
        radius: f32,
        fill: Color,
        stroke: Option<(f32, Color)>,
    },
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    pub items: Vec<Item>,
}
