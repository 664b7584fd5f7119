//! The six bundled outlines: one piece, the stated size, and meshes fit for posing at their number of fibres.

use plushwright::mesh::{self, quality::Quality};
use plushwright::outline::svg;

#[test]
fn the_bundled_outlines_mesh_well() {
    for (name, fibers) in [("robot", 414), ("pig", 571), ("e", 442), ("s", 276), ("puppy", 307), ("squid", 429)] {
        let file = format!("{}/assets/{name}.svg", env!("CARGO_MANIFEST_DIR"));
        let drawing = std::fs::read(file).unwrap();
        let outline = svg::read(&drawing, None).unwrap();
        let (low, high) = outline.bounding_box();
        assert_eq!(low, [0.0, 0.0]);
        let longer = high[0].max(high[1]);
        assert!((250.0..=300.0).contains(&longer) && outline.holes.is_empty(), "{name}: {high:?}");

        let mesh = mesh::generate(&outline, fibers).unwrap();
        let quality = Quality::of(&mesh);
        assert_eq!(mesh.validate(), Ok(()));
        assert_eq!(quality.edges, fibers, "{name}");
        assert!(quality.min_angle_deg > 30.0 && quality.bridges == 0, "{name}: {quality:?}");
        assert!((mesh.area() / outline.area() - 1.0).abs() < 0.01);

        let tall = svg::read(&drawing, Some(100.0)).unwrap();
        assert!((tall.bounding_box().1[1] - 100.0).abs() < 1e-9);
    }
}
