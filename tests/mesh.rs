//! Meshes of outlines that are hard to mesh: what every one must be, and how good all of them are together.

#[path = "support/shapes.rs"]
mod shapes;

use plushwright::mesh::quality::{Fit, Quality};
use plushwright::mesh::{self, MeshError, Request, Size};
use plushwright::outline::{Outline, Point, polygon, svg};
use shapes::{nasty, ring};

/// Kinds of outlines in `shapes`.
const KINDS: usize = 12;
/// Outlines of each kind; three and more were tried.
const SEEDS: u64 = 1;

/// What must hold for every mesh; its quality.
fn check(name: &str, outline: &Outline, fibers: usize, mesh: &mesh::Mesh) -> (Quality, Fit) {
    let (quality, fit) = (Quality::of(mesh), Fit::of(mesh, outline));
    assert_eq!(mesh.validate(), Ok(()), "{name}");
    assert_eq!(mesh.boundary().len(), 1 + outline.holes.len(), "{name}");
    assert!(quality.edges.abs_diff(fibers) * 100 <= 3 * fibers, "{name}: {} of {fibers}", quality.edges);
    assert_eq!(quality.below_5_deg, 0, "{name}: {quality:?}");
    if fibers >= 2000 {
        assert!(fit.area_error.abs() < 0.01 && fit.boundary_fraction < 0.005, "{name}: {fit:?}");
    }
    (quality, fit)
}

#[test]
fn nasty_outlines_give_good_meshes_or_name_the_count_they_need() {
    let (mut triangles, mut poor, mut refused) = (0, 0, 0);
    for seed in 1..=SEEDS {
        for k in 0..KINDS {
            let (name, outline) = nasty(k, seed);
            for fibers in [414, 2000] {
                let (count, mesh) = match mesh::generate(&outline, fibers) {
                    Ok(mesh) => (fibers, mesh),
                    Err(MeshError::Unreachable { asked, nearest }) => {
                        assert!(asked == fibers && nearest > fibers, "{name}");
                        assert!(fibers == 414, "{name} needs {nearest} fibres");
                        refused += 1;
                        let mesh =
                            mesh::generate(&outline, nearest).unwrap_or_else(|e| panic!("{name}, {nearest}: {e}"));
                        (nearest, mesh)
                    }
                    Err(other) => panic!("{name}: {other}"),
                };
                let (quality, _) = check(&name, &outline, count, &mesh);
                triangles += quality.triangles;
                poor += quality.below_20_deg;
            }
        }
    }
    assert!(poor * 1000 <= triangles, "{poor} of {triangles} triangles have an angle below 20 degrees");
    assert!(refused <= 1, "{refused} were refused");
}

#[test]
fn a_symmetric_outline_gives_a_mesh_that_is_its_own_mirror_image() {
    for name in ["robot", "squid", "e"] {
        let drawing = std::fs::read(format!("{}/assets/{name}.svg", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let outline = svg::read(&drawing, None).unwrap();
        for fibers in [414, 2000] {
            let meshed = mesh::build(&outline, &Request::fibers(fibers)).unwrap();
            let axis = meshed.axis.unwrap_or_else(|| panic!("{name} at {fibers} is not symmetric"));
            assert!(mesh::is_mirrored(&meshed.mesh, axis), "{name}");
            // To the bit, about an upright axis.
            for p in &meshed.mesh.nodes {
                assert!(meshed.mesh.nodes.contains(&axis.mirror(*p)), "{name}: {p:?}");
            }
            check(name, &outline, fibers, &meshed.mesh);
        }
    }
    let (s, c) = 0.4_f64.sin_cos();
    let drop: Vec<Point> = ring([0.0; 2], 300, |a| 60.0 + 40.0 * a.cos())
        .into_iter()
        .map(|p| [c * p[0] - s * p[1], s * p[0] + c * p[1]])
        .collect();
    let meshed = mesh::build(&Outline { outer: drop, holes: vec![] }, &Request::fibers(300)).unwrap();
    assert!(meshed.axis.is_some_and(|axis| mesh::is_mirrored(&meshed.mesh, axis)));
}

#[test]
fn edges_run_along_the_tracks() {
    let outline = Outline { outer: ring([0.0; 2], 200, |_| 100.0), holes: vec![] };
    let tracks = vec![vec![[-60.0, 0.0], [0.0, 10.0], [60.0, 0.0]], vec![[38.0, -50.0], [24.0, 60.0]]];
    let request = Request { size: Size::Fibers(500), tracks: tracks.clone(), mirror: true };
    let mesh = mesh::build(&outline, &request).unwrap().mesh;
    check("disc with tracks", &outline, 500, &mesh);
    let edges = mesh.edges();
    for track in &tracks {
        for piece in track.windows(2) {
            for k in 0..=20 {
                let p = polygon::lerp(piece[0], piece[1], f64::from(k) / 20.0);
                let on = edges.iter().any(|e| {
                    let [a, b] = e.map(|n| mesh.nodes[n]);
                    polygon::distance_to_segment(a, b, p) < 1e-9
                });
                assert!(on, "no edge at {p:?}");
            }
        }
    }
}

#[test]
fn a_size_in_mm_is_met() {
    let outline = Outline { outer: ring([0.0; 2], 200, |_| 100.0), holes: vec![] };
    for length in [6.0, 12.0, 25.0] {
        let request = Request { size: Size::EdgeMm(length), ..Request::fibers(0) };
        let mean = Quality::of(&mesh::build(&outline, &request).unwrap().mesh).mean_edge;
        assert!((mean / length - 1.0).abs() < 0.15, "{mean} {length}");
    }
}
