//! Turns a [`Scene`] into what the shaders draw: filled triangles with a fading fringe, textured ones, and capsules.
//!
//! A capsule is a segment with a radius: round lines are chains of them, discs are capsules of no length, rings have an
//! inner radius. Everything is anti-aliased by the shaders alone, so one sample a pixel is enough.

use crate::mesh::Mesh;
use crate::outline::Point;
use crate::picture::plush::Felt;
use crate::picture::{Color, Item, Scene, Silhouette, Strands, Texture};
use bytemuck::{Pod, Zeroable};
use std::ops::Range;
use std::sync::Arc;

/// A corner of a filled triangle.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Corner {
    /// mm.
    pub position: [f32; 2],
    /// Where the fringe is drawn out to, physical pixels (y up).
    pub outward: [f32; 2],
    pub coverage: f32,
    pub color: [u8; 4],
}

#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Capsule {
    /// mm.
    pub from: [f32; 2],
    /// mm.
    pub to: [f32; 2],
    /// Logical pixels.
    pub radius: f32,
    /// Logical pixels; below zero: filled.
    pub inner: f32,
    pub color: [u8; 4],
}

/// A corner of a triangle with a picture on it.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Textured {
    /// mm.
    pub position: [f32; 2],
    /// From the upper left corner of the texture, 0 to 1.
    pub place: [f32; 2],
}

/// A point of stuffed felt in a pose.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Woolly {
    /// mm.
    pub position: [f32; 2],
    /// Of half the square of the height, mm.
    pub slope: [f32; 2],
}

/// The same point in every pose.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Cut {
    /// At rest, mm: where the grain is.
    pub rest: [f32; 2],
    /// From the upper left corner of the texture, 0 to 1.
    pub place: [f32; 2],
    /// Half the square of the height, mm^2.
    pub height: f32,
    pub color: [u8; 4],
}

/// Stuffed felt as it is in every pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Cloth {
    of: Arc<Silhouette>,
    color: Color,
    frame: Option<[Point; 2]>,
    pub points: Vec<Cut>,
    /// Corners of triangles in painting order.
    pub corners: Vec<u32>,
}

/// A run of primitives of one kind, in painting order.
#[derive(Clone, Debug, PartialEq)]
pub enum Batch {
    /// Range of corners.
    Fill(Range<u32>),
    /// Range of textured corners.
    Picture(Range<u32>),
    /// All of the felt, and whether the texture is on it.
    Felt(bool),
    /// Range of capsules.
    Capsules(Range<u32>),
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    pub corners: Vec<Corner>,
    pub textured: Vec<Textured>,
    pub felt: Vec<Woolly>,
    pub cloth: Option<Arc<Cloth>>,
    /// On all of these: a scene has one texture at most.
    pub texture: Option<Arc<Texture>>,
    pub capsules: Vec<Capsule>,
    pub batches: Vec<Batch>,
}

/// Inner radius of a filled capsule.
const FILLED: f32 = -1.0;

impl Geometry {
    pub fn of(scene: &Scene) -> Self {
        Self::after(scene, &Self::default())
    }

    /// [`Self::of`]; what does not change from pose to pose is taken over from the geometry before.
    pub fn after(scene: &Scene, before: &Self) -> Self {
        let mut geometry = Self::default();
        for item in &scene.items {
            match item {
                Item::Mesh { points, triangles, color } => {
                    let mesh = Mesh { nodes: points.clone(), triangles: triangles.clone() };
                    geometry.fill(points, triangles, &mesh.boundary(), *color);
                }
                Item::Body { silhouette, points, color } => {
                    geometry.fill(points, &silhouette.triangles, &silhouette.rings, *color);
                }
                Item::Cells { points, triangles, colors } => geometry.cells(points, triangles, colors),
                Item::Plush(felt) => {
                    geometry.felt(felt, before.cloth.as_ref());
                    geometry.texture = felt.texture.as_ref().map(|(texture, _)| texture.clone());
                }
                Item::Picture { points, places, triangles, texture } => {
                    geometry.picture(points, places, triangles);
                    geometry.texture = Some(texture.clone());
                }
                Item::Line { points, width, color, closed } => geometry.line(points, *width, *color, *closed),
                Item::Strands(strands) => geometry.strands(strands),
                Item::Disc { center, radius, fill, stroke } => geometry.disc(*center, *radius, *fill, *stroke),
            }
        }
        geometry
    }

    /// Triangles, and a fringe along their rims, which have them on their left.
    fn fill(&mut self, points: &[Point], triangles: &[[usize; 3]], rims: &[Vec<usize>], color: Color) {
        let start = self.corners.len() as u32;
        let color = bytes(color);
        let corner = |node: usize| Corner { position: f32s(points[node]), outward: [0.0; 2], coverage: 1.0, color };
        let whole = triangles.iter().filter(|t| t.iter().all(|&n| n < points.len()));
        self.corners.extend(whole.flat_map(|t| t.map(corner)));
        for edge in rims {
            let outward = miters(edge, points);
            let rim: Vec<[Corner; 2]> = edge
                .iter()
                .zip(&outward)
                .map(|(&node, &outward)| [corner(node), Corner { outward, coverage: 0.0, ..corner(node) }])
                .collect();
            for (i, a) in rim.iter().enumerate() {
                let b = &rim[(i + 1) % rim.len()];
                self.corners.extend([a[0], a[1], b[1], a[0], b[1], b[0]]);
            }
        }
        self.note(Batch::Fill(start..self.corners.len() as u32));
    }

    fn cells(&mut self, points: &[Point], triangles: &[[usize; 3]], colors: &[Color]) {
        let start = self.corners.len() as u32;
        let whole = triangles.iter().zip(colors).filter(|(t, _)| t.iter().all(|&n| n < points.len()));
        self.corners.extend(whole.flat_map(|(t, &color)| {
            let color = bytes(color);
            t.map(|node| Corner { position: f32s(points[node]), outward: [0.0; 2], coverage: 1.0, color })
        }));
        self.note(Batch::Fill(start..self.corners.len() as u32));
    }

    fn felt(&mut self, felt: &Felt, before: Option<&Arc<Cloth>>) {
        let points = felt.points.iter().zip(&felt.slopes);
        self.felt.extend(points.map(|(&p, &slope)| Woolly { position: f32s(p), slope }));
        let same = before.filter(|cloth| cloth.is_of(felt));
        self.cloth = Some(same.cloned().unwrap_or_else(|| Arc::new(Cloth::of(felt))));
        self.note(Batch::Felt(felt.texture.is_some()));
    }

    fn picture(&mut self, points: &[Point], places: &[Point], triangles: &[[usize; 3]]) {
        let start = self.textured.len() as u32;
        let corner = |n: usize| Textured { position: f32s(points[n]), place: f32s(places[n]) };
        let whole = triangles.iter().filter(|t| t.iter().all(|&n| n < points.len().min(places.len())));
        self.textured.extend(whole.flat_map(|t| t.map(corner)));
        self.note(Batch::Picture(start..self.textured.len() as u32));
    }

    fn line(&mut self, points: &[Point], width: f32, color: Color, closed: bool) {
        let last = if closed { points.first() } else { None };
        let mut ends = points.iter().chain(last).copied().map(f32s);
        let Some(mut from) = ends.next() else { return };
        for to in ends {
            self.capsule(Capsule { from, to, radius: width / 2.0, inner: FILLED, color: bytes(color) });
            from = to;
        }
    }

    fn strands(&mut self, strands: &Strands) {
        let start = self.capsules.len() as u32;
        self.capsules.reserve(strands.points().len());
        for (points, width, color) in strands.iter() {
            let (radius, color) = (width / 2.0, bytes(color));
            let piece =
                |ends: &[Point]| Capsule { from: f32s(ends[0]), to: f32s(ends[1]), radius, inner: FILLED, color };
            self.capsules.extend(points.windows(2).map(piece));
        }
        let end = self.capsules.len() as u32;
        if end > start {
            self.note(Batch::Capsules(start..end));
        }
    }

    fn disc(&mut self, center: Point, radius: f32, fill: Color, stroke: Option<(f32, Color)>) {
        let at = f32s(center);
        let mut round = |radius: f32, inner: f32, color: Color| {
            self.capsule(Capsule { from: at, to: at, radius, inner, color: bytes(color) });
        };
        match stroke {
            None => round(radius, FILLED, fill),
            Some((width, color)) => {
                // The fill reaches under the middle of the stroke, so that no gap shows between them.
                round(radius - width / 2.0, FILLED, fill);
                round(radius, radius - width, color);
            }
        }
    }

    fn capsule(&mut self, capsule: Capsule) {
        let start = self.capsules.len() as u32;
        self.capsules.push(capsule);
        self.note(Batch::Capsules(start..start + 1));
    }

    /// Adds a batch, to the one before if that is of the same kind.
    fn note(&mut self, batch: Batch) {
        match (self.batches.last_mut(), &batch) {
            (Some(Batch::Fill(run)), Batch::Fill(new))
            | (Some(Batch::Picture(run)), Batch::Picture(new))
            | (Some(Batch::Capsules(run)), Batch::Capsules(new)) => run.end = new.end,
            _ => self.batches.push(batch),
        }
    }
}

impl Cloth {
    fn of(felt: &Felt) -> Self {
        let (silhouette, places) = (&felt.silhouette, felt.places());
        let color = bytes(felt.color);
        let point = |n: usize| Cut {
            rest: f32s(silhouette.rest[n]),
            place: places.as_ref().map_or([0.0; 2], |places| f32s(places[n])),
            height: silhouette.heights[n] as f32,
            color,
        };
        Self {
            of: silhouette.clone(),
            color: felt.color,
            frame: felt.texture.as_ref().map(|(_, frame)| *frame),
            points: (0..silhouette.rest.len()).map(point).collect(),
            corners: silhouette.triangles.iter().flatten().map(|&n| n as u32).collect(),
        }
    }

    fn is_of(&self, felt: &Felt) -> bool {
        let frame = felt.texture.as_ref().map(|(_, frame)| *frame);
        Arc::ptr_eq(&self.of, &felt.silhouette) && (self.color, self.frame) == (felt.color, frame)
    }
}

/// For each node of a loop (body to its left) the outward vector that moves both its edges out by one pixel.
fn miters(edge: &[usize], points: &[Point]) -> Vec<[f32; 2]> {
    /// Sharp corners would throw the fringe far out.
    const LONGEST: f64 = 2.0;
    let normal = |a: Point, b: Point| {
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = x.hypot(y).max(f64::MIN_POSITIVE);
        [y / length, -x / length]
    };
    let count = edge.len();
    (0..count)
        .map(|i| {
            let [before, here, after] = [i + count - 1, i, i + 1].map(|k| points[edge[k % count]]);
            let (m, n) = (normal(before, here), normal(here, after));
            let sum = [m[0] + n[0], m[1] + n[1]];
            let dot = (sum[0] * n[0] + sum[1] * n[1]).max(1.0 / LONGEST);
            [(sum[0] / dot) as f32, (sum[1] / dot) as f32]
        })
        .collect()
}

fn bytes(c: Color) -> [u8; 4] {
    [c.0, c.1, c.2, c.3]
}

fn f32s(p: Point) -> [f32; 2] {
    [p[0] as f32, p[1] as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Color = Color(255, 0, 0, 255);

    fn square() -> Item {
        Item::Mesh {
            points: vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            color: RED,
        }
    }

    #[test]
    fn a_filled_square_has_a_fringe_one_pixel_wide() {
        let geometry = Geometry::of(&Scene { items: vec![square()] });
        assert_eq!(geometry.corners.len(), 2 * 3 + 4 * 6);
        let fringe: Vec<_> = geometry.corners.iter().filter(|c| c.coverage == 0.0).collect();
        for corner in fringe {
            let away = corner.position.map(|x| if x > 5.0 { 1.0 } else { -1.0 });
            assert_eq!(corner.outward, away);
        }
    }

    #[test]
    fn a_texture_lies_between_what_is_below_and_above_it() {
        let texture = Arc::new(Texture::of(image::RgbaImage::new(2, 2)));
        let Item::Mesh { points, triangles, .. } = square() else { panic!() };
        let places = vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        let picture = Item::Picture { points, places, triangles, texture: texture.clone() };
        let geometry = Geometry::of(&Scene { items: vec![square(), picture, square()] });
        assert_eq!(geometry.batches, [Batch::Fill(0..30), Batch::Picture(0..6), Batch::Fill(30..60)]);
        assert_eq!(geometry.textured[4], Textured { position: [10.0, 10.0], place: [1.0, 0.0] });
        assert!(geometry.texture.is_some_and(|t| Arc::ptr_eq(&t, &texture)));
    }

    #[test]
    fn painting_order_is_kept_and_runs_are_merged() {
        let line =
            |closed| Item::Line { points: vec![[0.0; 2], [1.0, 0.0], [1.0, 1.0]], width: 2.0, color: RED, closed };
        let disc = Item::Disc { center: [0.0; 2], radius: 5.0, fill: RED, stroke: Some((2.0, RED)) };
        let geometry = Geometry::of(&Scene { items: vec![square(), line(false), line(true), disc, square()] });
        assert_eq!(geometry.capsules.len(), 2 + 3 + 2);
        assert_eq!(geometry.batches, vec![Batch::Fill(0..30), Batch::Capsules(0..7), Batch::Fill(30..60)]);
    }
}
