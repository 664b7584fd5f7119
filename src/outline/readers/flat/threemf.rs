//! 3MF models, as slicers, Tinkercad and Fusion write them: a zip of XML.
//!
//! Of the format (3MF Core Specification 1.3), units, meshes, components and their transforms matter, and parts that lie in files of their
//! own (production extension, as Bambu Studio and OrcaSlicer write them). The library `threemf` 0.8 unpacks without a bound and knows no
//! such parts; readers of zip and XML are here already.

use super::{Faces, MAX_ELEMENTS, read};
use crate::outline::readers::{OutlineReader, ReadingOption};
use crate::outline::{Import, Imported, MAX_FILE_BYTES, OutlineError};
use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use usvg::roxmltree::{Document, Node};
use zip::ZipArchive;

/// How a zip begins, and what the name of a model in it ends with.
const ZIP: &[u8] = b"PK\x03\x04";
const MODEL: &str = ".model";
/// Where a model lies if nothing tells.
const USUAL: &str = "3D/3dmodel.model";
/// Deepest nesting of components, and most of them.
const MAX_DEPTH: usize = 8;
const MAX_COMPONENTS: usize = 100_000;

pub(in crate::outline) struct Threemf;

impl OutlineReader for Threemf {
    fn names(&self) -> [&'static str; 2] {
        ["a 3MF mesh", "3MF meshes"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["3mf"]
    }

    fn can_read(&self, bytes: &[u8]) -> bool {
        bytes.starts_with(ZIP)
            && ZipArchive::new(Cursor::new(bytes))
                .is_ok_and(|package| names(&package).any(|name| name.ends_with(MODEL)))
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Unit]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        read(faces(bytes)?, import)
    }
}

fn unreadable(reason: impl Into<String>) -> OutlineError {
    OutlineError::Unreadable { format: "3MF", reason: reason.into() }
}

/// The files of a package.
fn names(package: &ZipArchive<Cursor<&[u8]>>) -> impl Iterator<Item = String> {
    package.file_names().flatten().map(|name| name.into_owned())
}

/// All that is to be built, in the unit of the package.
fn faces(bytes: &[u8]) -> Result<Faces, OutlineError> {
    let archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| unreadable(error.to_string()))?;
    let mut package = Package { archive, left: MAX_FILE_BYTES, models: BTreeMap::new(), components: 0 };
    let root = package.root()?;
    let (unit_mm, items) = package.model(&root).map(|model| (model.unit_mm, model.items.clone()))?;
    let mut faces =
        Faces { vertices: Vec::new(), faces: Vec::new(), unit_mm: Some(unit_mm), y_up: false, file: "a 3MF" };
    for item in &items {
        package.build(&root, item, &Map::IDENTITY, 0, &mut faces)?;
    }
    Ok(faces)
}

/// A package and the models of it that were read.
struct Package<'a> {
    archive: ZipArchive<Cursor<&'a [u8]>>,
    /// Bytes that may still be unpacked.
    left: usize,
    models: BTreeMap<String, Model>,
    components: usize,
}

/// A file of objects.
struct Model {
    unit_mm: f64,
    objects: BTreeMap<String, Object>,
    items: Vec<Reference>,
}

enum Object {
    Mesh { vertices: Vec<[f64; 3]>, triangles: Vec<[usize; 3]> },
    Parts(Vec<Reference>),
}

/// An object at a place.
#[derive(Clone)]
struct Reference {
    /// The file that it lies in, where that is another one.
    file: Option<String>,
    object: String,
    map: Map,
}

impl Package<'_> {
    /// The file with what is to be built.
    fn root(&mut self) -> Result<String, OutlineError> {
        let relations = self.text("_rels/.rels").unwrap_or_default();
        let told = Document::parse(&relations).ok().and_then(|document| {
            let mut all = document.descendants();
            let model = all.find(|node| node.attribute("Type").is_some_and(|kind| kind.ends_with("/3dmodel")))?;
            Some(model.attribute("Target")?.trim_start_matches('/').to_owned())
        });
        let is_there = |name: &str| names(&self.archive).any(|n| n == name);
        let usual = || Some(USUAL.to_owned()).filter(|name| is_there(name));
        let any = || names(&self.archive).find(|name| name.ends_with(MODEL));
        told.filter(|name| is_there(name)).or_else(usual).or_else(any).ok_or_else(|| unreadable("it holds no model"))
    }

    fn text(&mut self, name: &str) -> Result<String, OutlineError> {
        let part = self.archive.by_name(name).map_err(|error| unreadable(format!("{name}: {error}")))?;
        let mut text = String::new();
        let read = part.take(self.left as u64 + 1).read_to_string(&mut text);
        let count = read.map_err(|error| unreadable(format!("{name}: {error}")))?;
        self.left = self.left.checked_sub(count).ok_or(OutlineError::TooLarge)?;
        Ok(text)
    }

    fn model(&mut self, name: &str) -> Result<&Model, OutlineError> {
        if !self.models.contains_key(name) {
            let text = self.text(name)?;
            let document = Document::parse(&text).map_err(|error| unreadable(format!("{name}: {error}")))?;
            self.models.insert(name.to_owned(), Model::of(&document)?);
        }
        Ok(&self.models[name])
    }

    /// Adds what a reference stands for; `around` is the place of what it is part of.
    fn build(
        &mut self,
        file: &str,
        reference: &Reference,
        around: &Map,
        depth: usize,
        faces: &mut Faces,
    ) -> Result<(), OutlineError> {
        self.components += 1;
        if depth > MAX_DEPTH || self.components > MAX_COMPONENTS {
            return Err(OutlineError::TooComplex("has components nested too deep or too often"));
        }
        let file = reference.file.as_deref().unwrap_or(file).to_owned();
        let map = reference.map.then(around);
        let parts = match self.model(&file)?.objects.get(&reference.object) {
            None => return Err(unreadable(format!("there is no object {} in {file}", reference.object))),
            Some(Object::Parts(parts)) => parts.clone(),
            Some(Object::Mesh { vertices, triangles }) => {
                let first = faces.vertices.len();
                if first.max(faces.faces.len()) + vertices.len().max(triangles.len()) > MAX_ELEMENTS {
                    return Err(OutlineError::TooComplex("has more than half a million faces"));
                }
                faces.vertices.extend(vertices.iter().map(|p| map.at(*p)));
                faces.faces.extend(triangles.iter().map(|t| t.map(|k| first + k).to_vec()));
                return Ok(());
            }
        };
        parts.iter().try_for_each(|part| self.build(&file, part, &map, depth + 1, faces))
    }
}

impl Model {
    fn of(document: &Document) -> Result<Self, OutlineError> {
        let root = document.root_element();
        let unit_mm = match root.attribute("unit").unwrap_or("millimeter") {
            "micron" => 1e-3,
            "centimeter" => 10.0,
            "inch" => 25.4,
            "foot" => 304.8,
            "meter" => 1000.0,
            _ => 1.0,
        };
        let mut model = Self { unit_mm, objects: BTreeMap::new(), items: Vec::new() };
        for node in root.descendants() {
            match node.tag_name().name() {
                "object" => {
                    let id = node.attribute("id").unwrap_or_default().to_owned();
                    model.objects.insert(id, Object::of(node)?);
                }
                // What a slicer keeps and does not print.
                "item" if node.attribute("printable") != Some("0") => model.items.push(Reference::of(node)?),
                _ => {}
            }
        }
        Ok(model)
    }
}

impl Object {
    fn of(node: Node) -> Result<Self, OutlineError> {
        let named = |name: &'static str| node.descendants().filter(move |n| n.tag_name().name() == name);
        if named("mesh").next().is_none() {
            return named("component").map(Reference::of).collect::<Result<_, _>>().map(Self::Parts);
        }
        let number = |n: Node, name: &str| n.attribute(name)?.trim().parse::<f64>().ok().filter(|v| v.is_finite());
        let vertex = |n: Node| Some([number(n, "x")?, number(n, "y")?, number(n, "z")?]);
        let vertices: Option<Vec<[f64; 3]>> = named("vertex").map(vertex).collect();
        let vertices = vertices.ok_or_else(|| unreadable("a vertex has no place"))?;
        let corner = |n: Node, name: &str| n.attribute(name)?.trim().parse().ok().filter(|&k| k < vertices.len());
        let triangle = |n: Node| Some([corner(n, "v1")?, corner(n, "v2")?, corner(n, "v3")?]);
        let triangles: Option<Vec<[usize; 3]>> = named("triangle").map(triangle).collect();
        let triangles = triangles.ok_or_else(|| unreadable("a triangle has a corner that is no vertex"))?;
        Ok(Self::Mesh { vertices, triangles })
    }
}

impl Reference {
    fn of(node: Node) -> Result<Self, OutlineError> {
        let file = node.attributes().find(|a| a.name() == "path").map(|a| a.value().trim_start_matches('/').to_owned());
        let object = node.attribute("objectid").unwrap_or_default().to_owned();
        let map = node.attribute("transform").map_or(Some(Map::IDENTITY), Map::of);
        Ok(Self { file, object, map: map.ok_or_else(|| unreadable("a transform is not twelve numbers"))? })
    }
}

/// An affine map of row vectors: three rows of a matrix, and what is added.
#[derive(Clone, Copy)]
struct Map([f64; 12]);

impl Map {
    const IDENTITY: Self = Self([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);

    fn of(text: &str) -> Option<Self> {
        let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        numbers.try_into().ok().filter(|m: &[f64; 12]| m.iter().all(|v| v.is_finite())).map(Self)
    }

    fn turned(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let m = &self.0;
        [0, 1, 2].map(|i| x * m[i] + y * m[3 + i] + z * m[6 + i])
    }

    fn at(&self, p: [f64; 3]) -> [f64; 3] {
        let turned = self.turned(p);
        [0, 1, 2].map(|i| turned[i] + self.0[9 + i])
    }

    /// First this one, then another.
    fn then(&self, other: &Self) -> Self {
        let row = |k: usize| [self.0[3 * k], self.0[3 * k + 1], self.0[3 * k + 2]];
        let rows = [other.turned(row(0)), other.turned(row(1)), other.turned(row(2)), other.at(row(3))];
        Self(std::array::from_fn(|k| rows[k / 3][k % 3]))
    }
}

#[cfg(test)]
mod tests {
    use crate::outline::{Import, Note, OutlineError, import};
    use std::io::{Cursor, Write};
    use zip::write::SimpleFileOptions;

    /// A package of files; their names and texts.
    fn package(files: &[(&str, &str)]) -> Vec<u8> {
        let mut package = zip::ZipWriter::new(Cursor::new(Vec::new()));
        for (name, text) in files {
            package.start_file(*name, SimpleFileOptions::default()).unwrap();
            package.write_all(text.as_bytes()).unwrap();
        }
        package.finish().unwrap().into_inner()
    }

    fn model(unit: &str, objects: &str, items: &str) -> String {
        format!("<model unit='{unit}' xmlns:p='p'><resources>{objects}</resources><build>{items}</build></model>")
    }

    /// A wedge of 60 x 40 with its right angle at the lower left, 3 high.
    fn wedge(id: usize) -> String {
        let corners = [[0, 0], [60, 0], [0, 40]];
        let at = |z: usize| corners.iter().map(move |[x, y]| format!("<vertex x='{x}' y='{y}' z='{z}'/>"));
        let vertices: String = at(0).chain(at(3)).collect();
        let sides = [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
        let triangle = |[a, b, c]: &[usize; 3]| format!("<triangle v1='{a}' v2='{b}' v3='{c}'/>");
        let triangles: String = sides.iter().map(triangle).collect();
        format!(
            "<object id='{id}'><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object>"
        )
    }

    #[test]
    fn a_plate_is_read_in_its_unit() {
        for (unit, mm) in [("millimeter", 1.0), ("inch", 25.4), ("centimeter", 10.0)] {
            let text = model(unit, &wedge(1), "<item objectid='1'/>");
            let read = import(&package(&[("3D/3dmodel.model", &text)]), &Import::default()).unwrap();
            assert!((read.outline.area() / (1200.0 * mm * mm) - 1.0).abs() < 1e-3, "{}", read.outline.area());
            assert!(read.changes.notes.iter().all(|note| !matches!(note, Note::NoUnit(_))));
            assert!(read.outline.contains([5.0 * mm; 2]));
        }
    }

    #[test]
    fn components_are_placed_and_may_lie_in_files_of_their_own() {
        // Turned by a right angle and moved in the component, doubled where it is built: the right angle is at the lower right then.
        let turned = "<component p:path='/3D/Objects/a.model' objectid='7' transform='0 1 0 -1 0 0 0 0 1 5 5 0'/>";
        let objects = format!("<object id='2'><components>{turned}</components></object>");
        let items = "<item objectid='2' transform='2 0 0 0 2 0 0 0 2 0 0 9'/><item objectid='9' printable='0'/>";
        let relations = "<R><Relationship Type='http://x/3dmodel' Target='/3D/other.model'/></R>";
        let root = model("millimeter", &objects, items);
        let part = model("millimeter", &wedge(7), "");
        let files = [("_rels/.rels", relations), ("3D/Objects/a.model", &part), ("3D/other.model", &root)];
        let read = import(&package(&files), &Import::default()).unwrap();
        assert_eq!(read.outline.bounding_box().1.map(f64::round), [80.0, 120.0]);
        assert!(read.outline.contains([75.0, 5.0]) && !read.outline.contains([5.0, 115.0]));
    }

    #[test]
    fn circles_and_broken_references_are_refused() {
        let circle =
            "<object id='1'><components><component objectid='1'/><component objectid='1'/></components></object>";
        for (objects, item, says) in [
            (circle, "<item objectid='1'/>", "components"),
            ("", "<item objectid='4'/>", "no object 4"),
            ("", "<item objectid='4' transform='1 2'/>", "twelve"),
            ("", "", "no faces"),
        ] {
            let text = model("millimeter", objects, item);
            let error = import(&package(&[("3D/3dmodel.model", &text)]), &Import::default()).unwrap_err();
            assert!(error.to_string().contains(says), "{error}");
        }
        assert!(matches!(
            import(b"PK\x03\x04 3D/3dmodel.model", &Import::default()),
            Err(OutlineError::Foreign { .. })
        ));
    }
}
