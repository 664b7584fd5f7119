//! STL files, as text or in bytes.

use super::{Faces, MAX_ELEMENTS, read};
use crate::outline::readers::{OutlineReader, ReadingOption};
use crate::outline::{Import, Imported, OutlineError};

/// Bytes before the triangles, their number among them, and of a triangle: normal, three corners, two bytes more.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;
/// Bytes in which a text names its first facet.
const HEAD: usize = 1000;

pub(in crate::outline) struct Stl;

impl OutlineReader for Stl {
    fn names(&self) -> [&'static str; 2] {
        ["an STL mesh", "STL meshes"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["stl"]
    }

    fn can_read(&self, bytes: &[u8]) -> bool {
        is_text(bytes) || triangles(bytes).is_some()
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Unit]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        let vertices = match triangles(bytes) {
            Some(triangles) => of_bytes(triangles),
            None => of_text(&String::from_utf8_lossy(bytes))?,
        };
        let faces = (0..vertices.len() / 3).map(|k| vec![3 * k, 3 * k + 1, 3 * k + 2]).collect();
        read(Faces { vertices, faces, unit_mm: None, y_up: false, file: "an STL" }, import)
    }
}

fn is_text(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]).into_owned();
    head.trim_start().starts_with("solid") && head.contains("facet")
}

/// The triangles of a binary file, which is as long as their number says.
fn triangles(bytes: &[u8]) -> Option<&[u8]> {
    let count = u32::from_le_bytes(bytes.get(HEADER - 4..HEADER)?.try_into().ok()?) as usize;
    let triangles = bytes.get(HEADER..)?;
    (count > 0 && triangles.len() / TRIANGLE == count && triangles.len() % TRIANGLE < 4).then_some(triangles)
}

fn of_bytes(triangles: &[u8]) -> Vec<[f64; 3]> {
    let number = |bytes: &[u8]| bytes.try_into().map_or(f32::NAN, f32::from_le_bytes).into();
    let corner = |bytes: &[u8]| std::array::from_fn(|i| number(&bytes[4 * i..4 * i + 4]));
    // One more than is read, so that too many are refused as elsewhere.
    let some = triangles.chunks_exact(TRIANGLE).take(MAX_ELEMENTS + 1);
    let corners = some.flat_map(|triangle| triangle[12..48].chunks_exact(12).map(corner));
    let vertices: Vec<[f64; 3]> = corners.collect();
    // A triangle with a corner that is no place is left out.
    let sound = vertices.chunks_exact(3).filter(|corners| corners.iter().flatten().all(|v: &f64| v.is_finite()));
    sound.flatten().copied().collect()
}

fn of_text(text: &str) -> Result<Vec<[f64; 3]>, OutlineError> {
    let mut vertices = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let Some(rest) = line.trim_start().strip_prefix("vertex") else { continue };
        let mut values = rest.split_whitespace().map(|word| word.parse::<f64>().ok().filter(|v| v.is_finite()));
        let mut next = || values.next().flatten();
        let (Some(x), Some(y), Some(z)) = (next(), next(), next()) else {
            let reason = format!("line {}: {}", number + 1, line.chars().take(40).collect::<String>());
            return Err(OutlineError::Unreadable { format: "STL", reason });
        };
        vertices.push([x, y, z]);
        if vertices.len() > 3 * MAX_ELEMENTS {
            return Err(OutlineError::TooComplex("has more than half a million faces"));
        }
    }
    Ok(vertices)
}

#[cfg(test)]
mod tests {
    use crate::outline::{Import, Note, import};

    /// A plate of 60 x 40 with a corner cut off, so thick, tilted about x.
    fn plate(thickness: f64, tilt: f64) -> Vec<[[f64; 3]; 3]> {
        let ring = [[0.0, 0.0], [60.0, 0.0], [60.0, 20.0], [40.0, 40.0], [0.0, 40.0]];
        let at = |p: [f64; 2], z: f64| [p[0], p[1] * tilt.cos() - z * tilt.sin(), p[1] * tilt.sin() + z * tilt.cos()];
        let mut triangles = Vec::new();
        for i in 1..4 {
            triangles.push([ring[0], ring[i], ring[i + 1]].map(|p| at(p, 0.0)));
            triangles.push([ring[0], ring[i + 1], ring[i]].map(|p| at(p, thickness)));
        }
        for i in 0..5 {
            let (a, b) = (ring[i], ring[(i + 1) % 5]);
            triangles.push([at(a, 0.0), at(b, 0.0), at(b, thickness)]);
            triangles.push([at(a, 0.0), at(b, thickness), at(a, thickness)]);
        }
        triangles
    }

    fn binary(triangles: &[[[f64; 3]; 3]]) -> Vec<u8> {
        let mut bytes = vec![b' '; 80];
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            triangle.iter().flatten().for_each(|v| bytes.extend((*v as f32).to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    fn text(triangles: &[[[f64; 3]; 3]]) -> Vec<u8> {
        let facet = |t: &[[f64; 3]; 3]| {
            let corners: String = t.iter().map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).collect();
            format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        };
        format!("solid plate\n{}endsolid\n", triangles.iter().map(facet).collect::<String>()).into_bytes()
    }

    #[test]
    fn a_plate_is_what_it_covers_however_it_lies() {
        for (thickness, tilt) in [(3.0, 0.0), (3.0, 0.6), (0.0, 0.0)] {
            let plate = plate(thickness, tilt);
            for bytes in [binary(&plate), text(&plate)] {
                let read = import(&bytes, &Import::default()).unwrap();
                assert!(
                    (read.outline.area() / 2200.0 - 1.0).abs() < 1e-3,
                    "{thickness} {tilt}: {}",
                    read.outline.area()
                );
                // The corner that is missing is the upper right one.
                assert!(read.outline.contains([2.0, 38.0]) && !read.outline.contains([58.0, 38.0]));
                let told = read.changes.notes.iter().any(|note| matches!(note, Note::Projected { .. }));
                assert_eq!(told, thickness > 0.0, "{:?}", read.changes.notes);
            }
        }
        let cube = import(&binary(&plate(30.0, 0.0)), &Import::default()).unwrap_err().to_string();
        assert!(cube.contains("flat"), "{cube}");
    }
}
