//! OBJ files. Of the format only vertices (`v`) and faces (`f`) matter; all else is passed over.

use super::{Faces, MAX_ELEMENTS, read};
use crate::outline::readers::{OutlineReader, ReadingOption};
use crate::outline::{Import, Imported, OutlineError};

pub(in crate::outline) struct Obj;

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
        read(parse(&String::from_utf8_lossy(bytes))?, import)
    }
}

/// Whether the bytes look like an OBJ file: the first word that is no comment is one of the format's.
fn is_obj(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4000)]).into_owned();
    let words = ["v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"];
    let first = head.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
    first.and_then(|line| line.split_whitespace().next()).is_some_and(|word| words.contains(&word))
}

fn parse(text: &str) -> Result<Faces, OutlineError> {
    let unreadable = |reason: String| OutlineError::Unreadable { format: "OBJ", reason };
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut faces: Vec<Vec<usize>> = Vec::new();
    let mut edges = false;
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
                faces.push(corners.filter(|c| c.len() >= 3).ok_or_else(wrong)?);
            }
            Some("l") => edges = true,
            _ => {}
        }
        if vertices.len().max(faces.len()) > MAX_ELEMENTS {
            return Err(OutlineError::TooComplex("has more than half a million faces"));
        }
    }
    if faces.is_empty() && edges {
        let advice =
            "the OBJ has edges and no faces; fill them before you export it (in Blender: Edit Mode, select all, F)";
        return Err(OutlineError::NothingPainted(advice));
    }
    Ok(Faces { vertices, faces, unit_mm: None, y_up: true, file: "an OBJ" })
}

#[cfg(test)]
mod tests {
    use crate::outline::{Import, Imported, Note, OutlineError, polygon};

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

    #[test]
    fn faces_of_many_corners_are_what_they_are_and_not_fans() {
        // A star of five tips as one face, in the plane of x and z with its upper end at -z, clockwise from above.
        let corner = |i: usize| {
            let (r, a) = (if i.is_multiple_of(2) { 10.0 } else { 4.0 }, std::f64::consts::TAU * i as f64 / 10.0);
            [r * a.sin(), r * a.cos()]
        };
        let vertices: String = (0..10).map(|i| format!("v {} 7 {}\n", corner(i)[0], -corner(i)[1])).collect();
        let star = read(&format!("{vertices}f 1 2 3 4 5 6 7 8 9 10\n"), &Import::default()).unwrap();
        let expected = 5.0 * 10.0 * 4.0 * (std::f64::consts::TAU / 10.0).sin();
        assert!((star.outline.area() / expected - 1.0).abs() < 1e-3, "{}", star.outline.area());
        let (_, high) = star.outline.bounding_box();
        // One tip points up.
        assert!(star.outline.contains([0.5 * high[0], high[1] - 1.0]) && !star.outline.contains([0.5 * high[0], 1.0]));
        assert!(star.changes.notes.contains(&Note::Polygons) && star.mesh.is_none());
        // A quadrilateral with a dent is parted at it.
        let dent = "v 0 0 0\nv 10 0 0\nv 3 3 0\nv 0 10 0\nf 1 2 3 4\n";
        let dented = read(dent, &Import::default()).unwrap();
        assert!((dented.outline.area() - 30.0).abs() < 1e-9 && dented.mesh.unwrap().1.len() == 2);
    }
}
