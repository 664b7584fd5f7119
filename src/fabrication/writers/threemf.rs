//! Solids as 3MF: a package (a zip of XML) with one mesh, mm.

use crate::fabrication::product::Content;
use crate::fabrication::solid::Solid;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

const TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
"#;
const RELATIONS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="/3D/3dmodel.model"/></Relationships>
"#;

/// The bytes of a 3MF file.
pub(super) fn write(content: &Content) -> Option<Vec<u8>> {
    let Content::Solid(solid) = content else { return None };
    let mut package = ZipWriter::new(Cursor::new(Vec::new()));
    // Stored as it is and without a date: the same solid is the same bytes.
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    let model = model(solid);
    let parts = [("[Content_Types].xml", TYPES), ("_rels/.rels", RELATIONS), ("3D/3dmodel.model", &model)];
    for (name, text) in parts {
        package.start_file(name, options).ok()?;
        package.write_all(text.as_bytes()).ok()?;
    }
    Some(package.finish().ok()?.into_inner())
}

fn model(solid: &Solid) -> String {
    let vertices: String =
        solid.nodes.iter().map(|[x, y, z]| format!("<vertex x=\"{x:.6}\" y=\"{y:.6}\" z=\"{z:.6}\"/>\n")).collect();
    let known = |t: &&[usize; 3]| t.iter().all(|&n| n < solid.nodes.len());
    let triangles: String = solid
        .triangles
        .iter()
        .filter(known)
        .map(|[a, b, c]| format!("<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>\n"))
        .collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<model unit=\"millimeter\" xml:lang=\"en-US\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">
<resources><object id=\"1\" type=\"model\"><mesh><vertices>
{vertices}</vertices><triangles>
{triangles}</triangles></mesh></object></resources>
<build><item objectid=\"1\"/></build>
</model>
"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn a_package_holds_its_mesh_and_has_the_same_bytes_each_time() {
        let nodes = vec![[0.0, 0.0, 0.0], [30.0, 0.0, 0.0], [0.0, 20.0, 0.0], [0.0, 0.0, 10.0]];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [1, 2, 9]];
        let content = Content::Solid(Solid { nodes, triangles });
        let bytes = write(&content).unwrap();
        assert_eq!(write(&content).unwrap(), bytes);
        let mut package = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        let mut text = String::new();
        package.by_name("3D/3dmodel.model").unwrap().read_to_string(&mut text).unwrap();
        let document = roxmltree::Document::parse(&text).unwrap();
        let count = |tag: &str| document.descendants().filter(|n| n.tag_name().name() == tag).count();
        assert_eq!((count("vertex"), count("triangle")), (4, 4));
        assert_eq!(document.root_element().attribute("unit"), Some("millimeter"));
    }
}
