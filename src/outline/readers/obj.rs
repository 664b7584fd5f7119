//! A flat triangulated mesh from an OBJ file, taken as it is.
//!
//! Of the format only vertices (`v`) and faces (`f`, polygons as fans) matter; all else is passed over. The axis along
//! which the mesh is thinnest is dropped. Vertices at one place are one node.

use super::finish::{finish, warned};
use super::{OutlineReader, Painting, ReadingOption};
use crate::outline::{Changes, Import, Imported, Note, Outline, OutlineError, Point, polygon};
use std::collections::BTreeMap;

/// Thickness over size up to which a mesh counts as flat.
const FLAT_FRACTION: f64 = 1e-3;
/// Vertices nearer than this fraction of the size are one node: the digits of the file.
const WELD_FRACTION: f64 = 1e-7;
/// Most vertices or triangles.
const MAX_ELEMENTS: usize = 500_000;

/// Nodes, and counter-clockwise triangles.
type Triangles = (Vec<Point>, Vec<[usize; 3]>);

pub(super) struct Obj;

impl OutlineReader for Obj {
    fn names(&self) -> [&'static str; 2] {
        ["an OBJ mesh", "OBJ meshes"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["obj"]
    }

    fn can_read(&self, head: &[u8]) -> bool {
        is_obj(head)
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Unit]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        read(bytes, import)
    }
}

/// Whether the bytes look like an OBJ file: the first word that is no comment is one of the format's.
fn is_obj(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4000)]).into_owned();
    let words = ["v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"];
    let first = head.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
    first.and_then(|line| line.split_whitespace().next()).is_some_and(|word| words.contains(&word))
}

/// The mesh, scaled, with its boundary as the outline. Where the boundary is not one ring with holes, the triangles count
/// as painted areas.
fn read(bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
    let (nodes, triangles) = parse(&String::from_utf8_lossy(bytes))?;
    let mut notes = Vec::new();
    let unit_mm = import.unit_mm.unwrap_or_else(|| {
        if import.height_mm.is_none() {
            notes.push(Note::NoUnit("an OBJ"));
        }
        1.0
    });
    let Some(rings) = boundary(&nodes, &triangles) else {
        let area = |t: &[usize; 3]| vec![t.map(|n| nodes[n]).to_vec()];
        let shapes = triangles.iter().map(area).collect();
        notes.push(Note::NotOnePiece);
        return finish(Painting { shapes, unit_mm, notes, ..Painting::default() }, import);
    };
    let (low, high) = polygon::bounding_box(&nodes);
    let scale = import.height_mm.map_or(unit_mm, |height| height / (high[1] - low[1]));
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
    Ok(warned(Imported { outline, changes, drawn_box: [low, high], asides: Vec::new(), mesh, drawing: None }, import))
}

fn parse(text: &str) -> Result<Triangles, OutlineError> {
    let unreadable = |reason: String| OutlineError::Unreadable { format: "OBJ", reason };
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut faces: Vec<[usize; 3]> = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let wrong = || unreadable(format!("line {}: {}", number + 1, line.chars().take(40).collect::<String>()));
        match words.next() {
            Some("v") => {
                let mut value = || words.next()?.parse::<f64>().ok().filter(|v| v.is_finite());
                let (Some(x), Some(y)) = (value(), value()) else { return Err(wrong()) };
                vertices.push([x, y, value().unwrap_or(0.0)]);
            }
            Some("f") => {
                // Counted from 1, or from the end with a minus; texture and normal follow a slash.
                let index = |word: &str| {
                    let k: i64 = word.split('/').next()?.parse().ok()?;
                    let k = if k < 0 { vertices.len() as i64 + k } else { k - 1 };
                    usize::try_from(k).ok().filter(|&k| k < vertices.len())
                };
                let corners: Option<Vec<usize>> = words.map(index).collect();
                let corners = corners.filter(|c| c.len() >= 3).ok_or_else(wrong)?;
                faces.extend((1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]));
            }
            _ => {}
        }
        if vertices.len().max(faces.len()) > MAX_ELEMENTS {
            return Err(OutlineError::TooComplex("has more than half a million triangles"));
        }
    }
    if faces.is_empty() {
        return Err(OutlineError::NothingPainted("the OBJ has no faces"));
    }
    flat(&vertices, &faces)
}

/// In the plane, vertices at one place welded, unused ones gone, triangles without area dropped.
fn flat(vertices: &[[f64; 3]], faces: &[[usize; 3]]) -> Result<Triangles, OutlineError> {
    let range = |axis: usize| {
        let used = faces.iter().flatten().map(|&k| vertices[k][axis]);
        used.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)))
    };
    let size = [0, 1, 2].map(|axis| range(axis).1 - range(axis).0);
    let longest = size.iter().copied().fold(0.0, f64::max);
    let thin = (0..3).rev().min_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(2);
    let has_size = longest > 0.0;
    if !has_size || size[thin] > FLAT_FRACTION * longest {
        let reason = "the mesh is not flat; a plushie's mesh lies in a plane".to_owned();
        return Err(OutlineError::Unreadable { format: "OBJ", reason });
    }
    let axes = [[1, 2], [0, 2], [0, 1]][thin];
    let low = axes.map(|axis| range(axis).0);
    let mut known: BTreeMap<[i64; 2], usize> = BTreeMap::new();
    let mut nodes: Vec<Point> = Vec::new();
    let mut node = |k: usize| {
        let p = axes.map(|axis| vertices[k][axis]);
        let key = [0, 1].map(|i| ((p[i] - low[i]) / (WELD_FRACTION * longest)).round() as i64);
        *known.entry(key).or_insert_with(|| {
            nodes.push(p);
            nodes.len() - 1
        })
    };
    let welded: Vec<[usize; 3]> = faces.iter().map(|face| face.map(&mut node)).collect();
    let mut triangles = Vec::with_capacity(welded.len());
    for [a, b, c] in welded {
        let area = polygon::signed_area(&[nodes[a], nodes[b], nodes[c]]);
        if area > 0.0 {
            triangles.push([a, b, c]);
        } else if area < 0.0 {
            triangles.push([a, c, b]);
        }
    }
    used_only(nodes, triangles)
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

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "# a square\no s\nv 0 0 5\nv 10 0 5\nv 10 10 5\nv 0 10 5\nv 9 9 9\n";

    fn read(text: &str, import: &Import) -> Result<Imported, OutlineError> {
        crate::outline::import(text.as_bytes(), import)
    }

    #[test]
    fn triangles_come_as_they_are() {
        let text = format!("{SQUARE}f 1/1/1 2/2/2 3/3/3\nf -5 -2 -3\n");
        let imported = read(&text, &Import::default()).unwrap();
        let (nodes, triangles) = imported.mesh.unwrap();
        assert_eq!((nodes.len(), triangles.len(), imported.outline.area()), (4, 2, 100.0));
        for t in triangles {
            assert!(polygon::signed_area(&t.map(|n| nodes[n])) > 0.0);
        }
        let tall = read(&text, &Import { height_mm: Some(250.0), ..Import::default() }).unwrap();
        assert_eq!(tall.outline.bounding_box(), ([0.0; 2], [250.0; 2]));
        // Standing in the plane of x and z, as a quad.
        let wall = "v 0 1 0\nv 4 1 0\nv 4 1 3\nv 0 1 3\nf 1 2 3 4\n";
        let imported = read(wall, &Import::default()).unwrap();
        assert_eq!(imported.outline.bounding_box().1, [4.0, 3.0]);
    }

    #[test]
    fn what_is_no_sound_mesh_is_painted_or_refused() {
        // Two squares that overlap in a corner are an area, but no mesh.
        let overlap = "v 0 0\nv 10 0\nv 10 10\nv 0 10\nv 5 5\nv 15 5\nv 15 15\nv 5 15\nf 1 2 3 4\nf 5 6 7 8\n";
        let imported = read(overlap, &Import::default()).unwrap();
        assert!(imported.mesh.is_none() && (imported.outline.area() - 175.0).abs() < 1e-6);
        let refused = |text: &str| read(text, &Import::default()).unwrap_err().to_string();
        assert!(refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n").contains("not flat"));
        assert!(refused("v 0 0 0\nf 1 2 3\n").contains("line 2"));
        assert!(refused("v 0 nan 0\n").contains("line 1"));
        assert!(refused("v 0 0 0\n").contains("no faces"));
        assert!(refused("v 0 0\nv 1 0\nv 2 0\nf 1 2 3\n").contains("degenerate"));
    }
}
