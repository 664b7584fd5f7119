//! Flat meshes: an OBJ, STL or 3MF whose faces lie in a plane, or a plate that is thin against its size.
//!
//! Triangles and quadrilaterals of a plane are a mesh of their own, taken as it is. Faces of more corners, and the sides of a plate, are areas
//! that are meshed anew. The plane is that across which the mesh is thinnest, whatever way it lies in space; it is looked at from above
//! (+z). One that faces y lies on the ground in the world of an OBJ (Blender and games: +y is up, its upper end is at -z), and stands upright
//! in that of an STL or 3MF (printers: +z is up), where it is looked at from the front.

mod obj;
mod stl;
mod threemf;

pub(super) use obj::Obj;
pub(super) use stl::Stl;
pub(super) use threemf::Threemf;

use super::Painting;
use super::finish::{finish, warned};
use crate::outline::{Changes, Import, Imported, Note, Outline, OutlineError, Point, polygon};
use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use std::collections::BTreeMap;

/// Thickness over size up to which a mesh counts as flat.
const FLAT_FRACTION: f64 = 1e-3;
/// Thickness over size up to which a body counts as a plate.
const PLATE_FRACTION: f64 = 0.25;
/// Vertices nearer than this fraction of the size are one node: the digits of the file.
const WELD_FRACTION: f64 = 1e-7;
/// Most vertices or faces.
const MAX_ELEMENTS: usize = 500_000;
/// A face that is narrower than this part of the size is seen edge on.
const EDGE_ON: f64 = 1e-9;

/// Nodes, and counter-clockwise triangles.
type Triangles = (Vec<Point>, Vec<[usize; 3]>);

/// A mesh in space.
struct Faces {
    vertices: Vec<[f64; 3]>,
    /// Corners of each face by their vertices.
    faces: Vec<Vec<usize>>,
    /// Millimetres in a unit, where the file states one.
    unit_mm: Option<f64>,
    /// Whether +y is up in the world that it was made in, and not +z.
    y_up: bool,
    /// What its file is called: `an OBJ`.
    file: &'static str,
}

/// The mesh, scaled, with its boundary as the outline. Where it is no sound mesh of a plane, its faces count as painted areas.
fn read(mesh: Faces, import: &Import) -> Result<Imported, OutlineError> {
    let Faces { vertices, faces, unit_mm, y_up, file } = mesh;
    if vertices.len().max(faces.len()) > MAX_ELEMENTS {
        return Err(OutlineError::TooComplex("has more than half a million faces"));
    }
    if faces.is_empty() {
        return Err(OutlineError::NothingPainted("the mesh has no faces"));
    }
    let View { points, thickness, size, along } = view(&vertices, &faces, y_up)?;
    let mut notes = Vec::new();
    let unit_mm = import.unit_mm.or(unit_mm).unwrap_or_else(|| {
        if !import.asks_size() {
            notes.push(Note::NoUnit(file));
        }
        1.0
    });
    if thickness > FLAT_FRACTION * size {
        notes.push(Note::Projected { along, thickness: thickness * unit_mm });
        return areas(&points, &faces, size, unit_mm, notes, import);
    }
    if faces.iter().any(|face| face.len() > 4) {
        notes.push(Note::Polygons);
        return areas(&points, &faces, size, unit_mm, notes, import);
    }
    let (nodes, triangles) = welded(&points, &faces, size)?;
    let Some(rings) = boundary(&nodes, &triangles) else {
        notes.push(Note::NotOnePiece);
        return areas(&points, &faces, size, unit_mm, notes, import);
    };
    let (low, high) = polygon::bounding_box(&nodes);
    let scale = import.scale((low, high)).unwrap_or(unit_mm);
    let place = |p: &Point| [0, 1].map(|axis| (p[axis] - low[axis]) * scale);
    let mut rings: Vec<Vec<Point>> = rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
    let holes = rings.split_off(1);
    let outline = Outline { outer: rings.pop().unwrap_or_default(), holes };
    let area = outline.area();
    if !(area.is_finite() && area > 0.0) {
        return Err(OutlineError::Degenerate);
    }
    let changes = Changes { painted_mm2: area, outline_mm2: area, notes, ..Changes::default() };
    let mesh = Some((nodes.iter().map(place).collect(), triangles));
    let drawn_box = [low, high];
    Ok(warned(Imported { outline, changes, drawn_box, asides: Vec::new(), mesh, drawing: None }, import))
}

/// All faces as areas that may overlap.
fn areas(
    points: &[Point],
    faces: &[Vec<usize>],
    size: f64,
    unit_mm: f64,
    notes: Vec<Note>,
    import: &Import,
) -> Result<Imported, OutlineError> {
    let area = |face: &Vec<usize>| {
        let mut ring: Vec<Point> = face.iter().map(|&k| points[k]).collect();
        if polygon::signed_area(&ring) < 0.0 {
            ring.reverse();
        }
        ring
    };
    let seen = |ring: &Vec<Point>| polygon::signed_area(ring) > EDGE_ON * size * size;
    let shapes = faces.iter().map(area).filter(seen).map(|ring| vec![ring]).collect();
    finish(Painting { shapes, unit_mm, notes, ..Painting::default() }, import)
}

/// A mesh as it is looked at.
struct View {
    /// Each vertex, y up.
    points: Vec<Point>,
    thickness: f64,
    /// The longest side of its box.
    size: f64,
    /// The direction of the look, in words.
    along: &'static str,
}

/// Looks at a mesh across its thinnest direction: an axis where that is thin enough, and else the direction of least variance.
fn view(vertices: &[[f64; 3]], faces: &[Vec<usize>], y_up: bool) -> Result<View, OutlineError> {
    let used = || faces.iter().flatten().map(|&k| Vector3::from(vertices[k]));
    let spread = |direction: &Vector3<f64>| {
        let (low, high) =
            used().map(|p| p.dot(direction)).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let sizes = axes.map(|axis| spread(&axis));
    let size = sizes.iter().copied().fold(0.0, f64::max);
    if !(size.is_finite() && size > 0.0) {
        return Err(OutlineError::Degenerate);
    }
    let thin = (0..3).rev().min_by(|&a, &b| sizes[a].total_cmp(&sizes[b])).unwrap_or(2);
    // Right, up, and what of the world that is.
    let (mut right, mut up, mut along) = match thin {
        0 => (Vector3::y(), Vector3::z(), "x"),
        1 if y_up => (Vector3::x(), -Vector3::z(), "y"),
        1 => (Vector3::x(), Vector3::z(), "y"),
        _ => (Vector3::x(), Vector3::y(), "z"),
    };
    let mut thickness = sizes[thin];
    if thickness > FLAT_FRACTION * size {
        let n = used().count() as f64;
        let mean = used().sum::<Vector3<f64>>() / n;
        let covariance: Matrix3<f64> = used().map(|p| (p - mean) * (p - mean).transpose()).sum();
        let eigen = SymmetricEigen::new(covariance);
        let normal: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
        let across = spread(&normal);
        if across.is_finite() && across < 0.99 * thickness {
            thickness = across;
            along = "its thinnest direction";
            (right, up) = upright(normal, y_up);
        }
    }
    if thickness > PLATE_FRACTION * size {
        let reason =
            "the mesh is not flat; a plushie's lies in a plane, or is a thin plate: export a flat face or a sketch"
                .to_owned();
        return Err(OutlineError::Unreadable { format: "mesh", reason });
    }
    let points = vertices.iter().map(|v| Vector3::from(*v)).map(|v| [v.dot(&right), v.dot(&up)]).collect();
    Ok(View { points, thickness, size, along })
}

/// Right and up as a plane with a normal is looked at: towards -z; where it faces y, towards -y in a world whose y is up, and else from the front.
fn upright(normal: Vector3<f64>, y_up: bool) -> (Vector3<f64>, Vector3<f64>) {
    let main = normal.iamax();
    let behind = main == 1 && !y_up;
    let normal = if (normal[main] < 0.0) != behind { -normal } else { normal };
    let above = match main {
        0 => Vector3::z(),
        1 if y_up => -Vector3::z(),
        1 => Vector3::z(),
        _ => Vector3::y(),
    };
    let up = (above - normal * normal.dot(&above)).normalize();
    (up.cross(&normal), up)
}

/// The triangles of faces of three or four corners: vertices at one place are one node, unused ones go, triangles without area too.
fn welded(points: &[Point], faces: &[Vec<usize>], size: f64) -> Result<Triangles, OutlineError> {
    let (low, _) = polygon::bounding_box(points);
    let mut known: BTreeMap<[i64; 2], usize> = BTreeMap::new();
    let mut nodes: Vec<Point> = Vec::new();
    let mut node = |k: usize| {
        let p = points[k];
        let key = [0, 1].map(|i| ((p[i] - low[i]) / (WELD_FRACTION * size)).round() as i64);
        *known.entry(key).or_insert_with(|| {
            nodes.push(p);
            nodes.len() - 1
        })
    };
    let corners: Vec<Vec<usize>> = faces.iter().map(|face| face.iter().map(|&k| node(k)).collect()).collect();
    let mut triangles = Vec::with_capacity(corners.len());
    for face in corners {
        for [a, b, c] in halves(&face, &nodes) {
            let area = polygon::signed_area(&[nodes[a], nodes[b], nodes[c]]);
            if area > 0.0 {
                triangles.push([a, b, c]);
            } else if area < 0.0 {
                triangles.push([a, c, b]);
            }
        }
    }
    used_only(nodes, triangles)
}

/// A triangle, or the two of a quadrilateral: a dent lies at an end of the diagonal that parts it.
fn halves(face: &[usize], nodes: &[Point]) -> Vec<[usize; 3]> {
    let &[a, b, c, d] = face else { return face.first_chunk().copied().into_iter().collect() };
    let area = |t: [usize; 3]| polygon::signed_area(&t.map(|n| nodes[n]));
    if area([a, b, c]) * area([a, c, d]) >= 0.0 { vec![[a, b, c], [a, c, d]] } else { vec![[b, c, d], [b, d, a]] }
}

fn used_only(nodes: Vec<Point>, mut triangles: Vec<[usize; 3]>) -> Result<Triangles, OutlineError> {
    let mut new = vec![usize::MAX; nodes.len()];
    let mut kept = Vec::new();
    for n in triangles.iter_mut().flatten() {
        if new[*n] == usize::MAX {
            new[*n] = kept.len();
            kept.push(nodes[*n]);
        }
        *n = new[*n];
    }
    if triangles.is_empty() { Err(OutlineError::Degenerate) } else { Ok((kept, triangles)) }
}

/// The rings of sides that belong to one triangle, the outer one first; `None` where they do not bound one sound piece.
fn boundary(nodes: &[Point], triangles: &[[usize; 3]]) -> Option<Vec<Vec<Point>>> {
    let mut sides: Vec<[usize; 2]> = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    sides.sort_unstable();
    if sides.windows(2).any(|pair| pair[0] == pair[1]) {
        return None;
    }
    let mut next: BTreeMap<usize, usize> = BTreeMap::new();
    for &[a, b] in sides.iter().filter(|&&[a, b]| sides.binary_search(&[b, a]).is_err()) {
        // A node that the boundary passes twice is pinched.
        if next.insert(a, b).is_some() {
            return None;
        }
    }
    let mut rings: Vec<Vec<Point>> = Vec::new();
    while let Some((&start, _)) = next.first_key_value() {
        let mut ring = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            ring.push(nodes[at]);
            at = to;
        }
        if at != start || ring.len() < 3 {
            return None;
        }
        rings.push(ring);
    }
    // One ring goes around the body, all others around holes.
    let outer = rings.iter().position(|ring| polygon::signed_area(ring) > 0.0)?;
    rings.swap(0, outer);
    rings[1..].iter().all(|ring| polygon::signed_area(ring) < 0.0).then_some(rings)
}
