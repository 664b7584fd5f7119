//! Solids as binary STL: 80 bytes of header, the number of triangles, and for each its normal, its corners (mm, f32, little
//! endian) and two bytes of nothing.

use crate::fabrication::product::Content;
use crate::fabrication::solid::Solid;

/// Not `solid`: some readers would take the file for a text.
const HEADER: &[u8] = b"plushwright, mm";
const HEADER_BYTES: usize = 80;

/// The bytes of an STL file. Triangles that name nodes which are not there are left out.
pub(super) fn write(content: &Content) -> Option<Vec<u8>> {
    match content {
        Content::Solid(solid) => Some(stl(solid)),
        _ => None,
    }
}

fn stl(solid: &Solid) -> Vec<u8> {
    let corners = |t: &[usize; 3]| match t.map(|n| solid.nodes.get(n)) {
        [Some(a), Some(b), Some(c)] => Some([*a, *b, *c]),
        _ => None,
    };
    let triangles: Vec<[[f64; 3]; 3]> = solid.triangles.iter().filter_map(corners).collect();
    let mut bytes = HEADER.to_vec();
    bytes.resize(HEADER_BYTES, 0);
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        let numbers = std::iter::once(normal(&triangle)).chain(triangle).flatten();
        bytes.extend(numbers.flat_map(|v| (v as f32).to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

/// Of unit length, outward; zero for a triangle without area.
fn normal([a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = cross.iter().map(|v| v * v).sum::<f64>().sqrt();
    if length > 0.0 { cross.map(|v| v / length) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_reads_back_with_its_volume_and_outward_normals() {
        let nodes = vec![[0.0, 0.0, 0.0], [30.0, 0.0, 0.0], [0.0, 20.0, 0.0], [0.0, 0.0, 10.0]];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [1, 2, 9]];
        let bytes = write(&Content::Solid(Solid { nodes, triangles })).unwrap();
        assert!(!bytes.starts_with(b"solid"));
        assert_eq!((bytes.len(), &bytes[80..84]), (84 + 4 * 50, &4u32.to_le_bytes()[..]));
        let mut volume = 0.0;
        for facet in bytes[84..].chunks(50) {
            let numbers: Vec<f64> =
                facet[..48].chunks(4).map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))).collect();
            let [n, a, b, c] = [0, 3, 6, 9].map(|k| &numbers[k..k + 3]);
            let dot = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(p, q)| p * q).sum::<f64>();
            let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            volume += dot(a, &cross) / 6.0;
            // The middle of the solid lies behind every face.
            let inward: Vec<f64> = [3.0, 2.0, 1.0].iter().zip(a).map(|(m, a)| m - a).collect();
            assert!(dot(n, &inward) < 0.0 && (dot(n, n) - 1.0).abs() < 1e-6);
        }
        assert!((volume - 30.0 * 20.0 * 10.0 / 6.0).abs() < 1e-3, "{volume}");
    }
}
