//! Meshes of outlines that are hard to mesh: what every one must be, and how good all of them are together.

use crate::support::shapes::{nasty, ring};
use plushwright::design::reshape::{self, Body};
use plushwright::design::{Design, edit, remesh};
use plushwright::mesh::quality::{Fit, MeshQuality};
use plushwright::mesh::{self, MeshError, MeshSpec, Size};
use plushwright::outline::{self, Drawing, Import, Outline, Point, polygon, svg};

/// Kinds of outlines in `shapes`.
const KINDS: usize = 12;
/// Outlines of each kind; three and more were tried.
const SEEDS: u64 = 1;

/// What must hold for every mesh; its quality.
fn check(name: &str, outline: &Outline, fibers: usize, mesh: &mesh::Mesh) -> (MeshQuality, Fit) {
    let (quality, fit) = (MeshQuality::of(mesh), Fit::of(mesh, outline));
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
            let meshed = mesh::build(&outline, &MeshSpec::fibers(fibers)).unwrap();
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
    let meshed = mesh::build(&Outline { outer: drop, holes: vec![] }, &MeshSpec::fibers(300)).unwrap();
    assert!(meshed.axis.is_some_and(|axis| mesh::is_mirrored(&meshed.mesh, axis)));
}

#[test]
fn edges_run_along_the_tracks() {
    let outline = Outline { outer: ring([0.0; 2], 200, |_| 100.0), holes: vec![] };
    let tracks = vec![vec![[-60.0, 0.0], [0.0, 10.0], [60.0, 0.0]], vec![[38.0, -50.0], [24.0, 60.0]]];
    let spec = MeshSpec { size: Size::Fibers(500), tracks: tracks.clone(), mirror: true };
    let mesh = mesh::build(&outline, &spec).unwrap().mesh;
    check("disc with tracks", &outline, 500, &mesh);
    for track in &tracks {
        assert!(off_edges(&mesh, track).is_empty(), "no edge at {:?}", off_edges(&mesh, track));
    }
}

/// Places along a track at which there is no edge.
fn off_edges(mesh: &mesh::Mesh, track: &[Point]) -> Vec<Point> {
    let edges = mesh.edges();
    let places = track.windows(2).flat_map(|w| (0..=20).map(move |k| polygon::lerp(w[0], w[1], f64::from(k) / 20.0)));
    let is_off = |p: &Point| {
        let on = |e: &[usize; 2]| polygon::distance_to_segment(mesh.nodes[e[0]], mesh.nodes[e[1]], *p) < 1e-9;
        !edges.iter().any(on)
    };
    places.filter(is_off).collect()
}

/// A limb with a head, and a track from the middle of the head through the limb to far beyond its end.
const DRAWING: &str = "(parts: [
    (primitive: Capsule(ends: ((0, 0), (120, 0)), radii: (30, 30))),
    (primitive: Circle(center: (130, 20), radius: 50)),
], tracks: [[(130, 20), (60, 5), (-1e7, 5)]])";

#[test]
fn the_tracks_of_a_drawing_are_edges_of_every_mesh_of_it() {
    let imported = Drawing::read(DRAWING.as_bytes()).unwrap().import(&Import::default()).unwrap();
    let Body { outline, mesh, drawing, .. } = Body::new(imported.clone(), &MeshSpec::fibers(400), 1, [0.0; 2]).unwrap();
    let mut design = Design { drawing, ..Design::new("limb", outline, mesh) };
    // 30 mm to the right of the corner, and 30 mm above it.
    assert_eq!(design.tracks(), [[[160.0, 50.0], [90.0, 35.0], [-1e7 + 30.0, 35.0]]]);
    // Within an edge of the rim it ends.
    let inside = [design.tracks()[0][0], design.tracks()[0][1], [20.0, 35.0]];
    let check = |design: &Design, what: &str| {
        design.validate().unwrap();
        let off = off_edges(&design.mesh, &inside);
        assert!(off.is_empty(), "{what}: {off:?}");
        let low = MeshQuality::of(&design.mesh).below_20_deg;
        assert!(low * 1000 <= design.mesh.triangles.len(), "{what}: {low}");
    };
    check(&design, "new");
    let spec = MeshSpec { tracks: design.tracks().to_vec(), ..MeshSpec::fibers(800) };
    let (mesh, fibers) = remesh::body(&design.outline, &spec, 2).unwrap();
    remesh::carry(&mut design, mesh, fibers);
    check(&design, "another resolution");
    let body = Body::new(imported, &MeshSpec::fibers(500), 1, [0.0; 2]).unwrap();
    reshape::reshape(&mut design, body);
    check(&design, "another body");
    // A silhouette that was not drawn keeps them too.
    let plain = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/pig.svg")).unwrap();
    let mut plain = outline::import(&plain, &Import::default()).unwrap();
    edit::set_tracks(&mut design, vec![vec![[120.0, 110.0], [180.0, 110.0]]]).unwrap();
    reshape::keep_tracks(&design, &mut plain);
    reshape::reshape(&mut design, Body::new(plain, &MeshSpec::fibers(571), 1, [0.0; 2]).unwrap());
    assert!(off_edges(&design.mesh, &[[120.0, 110.0], [180.0, 110.0]]).is_empty());
}

#[test]
fn a_size_in_mm_is_met() {
    let outline = Outline { outer: ring([0.0; 2], 200, |_| 100.0), holes: vec![] };
    for length in [6.0, 12.0, 25.0] {
        let spec = MeshSpec { size: Size::EdgeMm(length), ..MeshSpec::fibers(0) };
        let mean = MeshQuality::of(&mesh::build(&outline, &spec).unwrap().mesh).mean_edge;
        assert!((mean / length - 1.0).abs() < 0.15, "{mean} {length}");
    }
}
