//! The parts of a DXF file that matter: unit, layers, blocks, entities.

use super::binary;
use super::entity::{self, Entity, Tags};
use super::place::Point3;
use crate::outline::readers::encoding;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Names of layers, in lower case, that hold help lines and are never plotted.
const CONSTRUCTION: [&str; 6] =
    ["defpoints", "construction", "sketch construction", "konstruktion", "hilfslinien", "guides"];

/// The parts of a drawing that matter.
pub(super) struct File<'a> {
    pub unit_mm: Option<f64>,
    /// Names of layers in lower case, with how far they are seen.
    pub layers: BTreeMap<String, Seen>,
    /// Name to base point and content.
    pub blocks: BTreeMap<&'a str, (Point3, Vec<Entity<'a>>)>,
    pub entities: Vec<Entity<'a>>,
}

/// How far a layer is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Seen {
    Plainly,
    /// Switched off, or not plotted.
    Off,
    /// Blocks that are inserted on it are not seen either.
    Frozen,
}

/// The text of a file, binary or not, in its own code page.
///
/// # Errors
/// What is wrong with a binary file.
pub(super) fn text(bytes: &[u8]) -> Result<Cow<'_, str>, &'static str> {
    if bytes.starts_with(binary::SENTINEL) {
        return binary::text(bytes).map(Cow::Owned);
    }
    Ok(encoding::of_code_page(bytes, code_page(bytes).as_deref()))
}

/// The value that follows `$DWGCODEPAGE`, two lines on.
fn code_page(bytes: &[u8]) -> Option<String> {
    const NAME: &[u8] = b"$DWGCODEPAGE";
    /// The header is shorter.
    const HEAD: usize = 20_000;
    let head = &bytes[..bytes.len().min(HEAD)];
    let at = head.windows(NAME.len()).position(|window| window == NAME)?;
    let rest = String::from_utf8_lossy(&head[at..]);
    rest.lines().nth(2).map(|line| line.trim().to_owned())
}

impl<'a> File<'a> {
    /// # Errors
    /// What is wrong with the pairs.
    pub fn read(text: &'a str) -> Result<Self, &'static str> {
        let mut tags = Tags::new(text);
        let mut file = Self { unit_mm: None, layers: BTreeMap::new(), blocks: BTreeMap::new(), entities: Vec::new() };
        let mut ended = false;
        while let Some((code, value)) = tags.next_tag()? {
            match (code, value) {
                (0, "EOF") => {
                    ended = true;
                    break;
                }
                (0, "LAYER") => file.read_layer(&mut tags)?,
                (2, "HEADER") => file.unit_mm = unit(&mut tags)?,
                (2, "BLOCKS") => file.read_blocks(&mut tags)?,
                (2, "ENTITIES") => file.entities = entity::read(&mut tags, "ENDSEC")?,
                _ => {}
            }
        }
        if !ended && file.entities.is_empty() {
            return Err("the file ends early or is no drawing");
        }
        file.unit_mm = file.unit_mm.or_else(|| file.stated_unit());
        Ok(file)
    }

    fn read_layer(&mut self, tags: &mut Tags<'a>) -> Result<(), &'static str> {
        let layer = entity::one(tags, "LAYER")?;
        let name = layer.text(2).unwrap_or_default().to_lowercase();
        let is = |code: i32, test: &dyn Fn(f64) -> bool| layer.number(code).is_some_and(test);
        let seen = if layer.has_flag(1) {
            Seen::Frozen
        } else if is(62, &|colour| colour < 0.0) || is(290, &|plotted| plotted == 0.0) {
            Seen::Off
        } else {
            Seen::Plainly
        };
        self.layers.insert(name, seen);
        Ok(())
    }

    /// How far a layer is seen.
    pub fn seen(&self, layer: &str) -> Seen {
        let name = layer.to_lowercase();
        if CONSTRUCTION.contains(&name.as_str()) {
            return Seen::Off;
        }
        self.layers.get(&name).copied().unwrap_or(Seen::Plainly)
    }

    fn read_blocks(&mut self, tags: &mut Tags<'a>) -> Result<(), &'static str> {
        while let Some((code, value)) = tags.next_tag()? {
            match (code, value) {
                (0, "ENDSEC") => return Ok(()),
                (0, "BLOCK") => {
                    let head = entity::one(tags, "BLOCK")?;
                    let content = entity::read(tags, "ENDBLK")?;
                    let name = head.text(2).unwrap_or_default();
                    self.blocks.insert(name, (head.point(10), content));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The unit that a text states, as files of sewing patterns (ASTM D6673, AAMA) have it.
    fn stated_unit(&self) -> Option<f64> {
        let all = self.entities.iter().chain(self.blocks.values().flat_map(|(_, content)| content));
        let texts = all.filter(|entity| entity.kind == "TEXT").filter_map(|entity| entity.text(1));
        let mut stated = texts
            .filter_map(|text| text.trim().to_uppercase().strip_prefix("UNITS:").map(|unit| unit.trim().to_owned()));
        match stated.next()?.as_str() {
            "METRIC" => Some(1.0),
            "ENGLISH" => Some(25.4),
            _ => None,
        }
    }
}

/// The unit that the header names, mm. 0 is "none", 1 inch, 2 foot, 4 mm, 5 cm, 6 m and so on (`$INSUNITS`).
fn unit(tags: &mut Tags) -> Result<Option<f64>, &'static str> {
    let mut unit = None;
    while let Some((code, value)) = tags.next_tag()? {
        match (code, value) {
            (0, "ENDSEC") => break,
            (9, "$INSUNITS") => {
                unit = match tags.next_tag()? {
                    Some((70, value)) => match value.parse::<i64>() {
                        Ok(1) => Some(25.4),
                        Ok(2) => Some(304.8),
                        Ok(4) => Some(1.0),
                        Ok(5) => Some(10.0),
                        Ok(6) => Some(1000.0),
                        Ok(8) => Some(2.54e-5),
                        Ok(9) => Some(0.0254),
                        Ok(10) => Some(914.4),
                        Ok(13) => Some(1e-3),
                        Ok(14) => Some(100.0),
                        _ => None,
                    },
                    _ => None,
                }
            }
            _ => {}
        }
    }
    Ok(unit)
}
