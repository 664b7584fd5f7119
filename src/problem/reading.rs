//! Reading a problem file: straight from the text into its structs.
//!
//! A file of 10 000 fibres is 2 MB of numbers; a tree of JSON values in between would take longer than solving it. Only a file that cannot be
//! read so is taken apart as a tree, to say where it is wrong.

use super::error::{ProblemError, content};
use super::file::{
    DragData, ElementData, FORMAT, MaterialData, MeshData, ObjectiveData, PinData, Problem, SoftIkData, TargetData,
};
use crate::physics::{Setting, TermKind};
use serde::de::{Error, IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::Value;

/// Keys that a problem may have.
const KEYS: [&str; 13] = [
    "format",
    "mesh",
    "material",
    "elements",
    "pins",
    "contractions",
    "objective",
    "soft_ik",
    "start",
    "gravity",
    "surface_density",
    "terms",
    "drag",
];
/// Remarks that it may have besides; nobody is told that they are ignored.
const REMARKS: [&str; 5] = ["name", "note", "units", "tags", "n_edges"];

/// Reads and checks a problem. Also returns the unknown top-level keys that were ignored, in ascending order.
///
/// # Errors
/// [`ProblemError`]: the key or place of what is wrong.
pub fn read(text: &str) -> Result<(Problem, Vec<String>), ProblemError> {
    let (problem, mut unknown) = match serde_json::from_str::<Streamed>(text) {
        Ok(Streamed { problem, unknown }) => (problem, unknown),
        Err(_) => diagnose(text)?,
    };
    problem.check()?;
    unknown.sort_unstable();
    unknown.dedup();
    Ok((problem, unknown))
}

/// A problem as it comes from the text, key by key.
struct Streamed {
    problem: Problem,
    unknown: Vec<String>,
}

/// The value of a key that must be there, of one that may be absent or `null`.
fn required<T, E: Error>(value: Option<T>, key: &'static str) -> Result<T, E> {
    value.ok_or_else(|| E::missing_field(key))
}

impl<'de> Deserialize<'de> for Streamed {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Keys)
    }
}

struct Keys;

impl<'de> Visitor<'de> for Keys {
    type Value = Streamed;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a JSON object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Streamed, A::Error> {
        let mut problem = Problem::default();
        let (mut format, mut mesh, mut material): (Option<String>, Option<MeshData>, Option<MaterialData>) =
            (None, None, None);
        let mut unknown = Vec::new();
        let mut seen = Vec::new();
        while let Some(key) = map.next_key::<String>()? {
            if seen.contains(&key) {
                return Err(A::Error::custom("the same key twice"));
            }
            match key.as_str() {
                "format" => format = Some(map.next_value()?),
                "mesh" => mesh = map.next_value()?,
                "material" => material = map.next_value()?,
                "elements" => problem.elements = map.next_value::<Option<_>>()?.unwrap_or_default(),
                "pins" => problem.pins = map.next_value::<Option<_>>()?.unwrap_or_default(),
                "contractions" => problem.contractions = map.next_value()?,
                "objective" => problem.objective = map.next_value()?,
                "soft_ik" => problem.soft_ik = map.next_value()?,
                "start" => problem.start = map.next_value()?,
                "gravity" => problem.gravity = map.next_value()?,
                "surface_density" => problem.surface_density = map.next_value()?,
                "terms" => problem.terms = map.next_value::<Option<_>>()?.unwrap_or_default(),
                "drag" => problem.drag = map.next_value()?,
                remark => {
                    map.next_value::<IgnoredAny>()?;
                    if !REMARKS.contains(&remark) {
                        unknown.push(key.clone());
                    }
                }
            }
            seen.push(key);
        }
        if format.as_deref() != Some(FORMAT) {
            return Err(A::Error::custom("another format"));
        }
        problem.mesh = required(mesh, "mesh")?;
        problem.material = required(material, "material")?;
        Ok(Streamed { problem, unknown })
    }
}

/// [`read`] by way of a tree of values: names what is wrong with the file and where, or reads it where a key stands twice (the last
/// one counts).
fn diagnose(text: &str) -> Result<(Problem, Vec<String>), ProblemError> {
    let value: Value = serde_json::from_str(text).map_err(|e| ProblemError::Json(e.to_string()))?;
    let Value::Object(map) = &value else {
        return Err(content("problem", "must be a JSON object"));
    };
    match map.get("format").and_then(Value::as_str) {
        Some(FORMAT) => {}
        Some(other) => return Err(content("format", format!("\"{other}\" is unknown, expected \"{FORMAT}\""))),
        None => return Err(content("format", format!("missing, expected \"{FORMAT}\""))),
    }
    let is_known = |key: &str| KEYS.contains(&key) || REMARKS.contains(&key);
    let unknown = map.keys().filter(|key| !is_known(key)).cloned().collect();
    Ok((typed(&value)?, unknown))
}

/// Types the JSON value piece by piece, so that an error can name where it is.
fn typed(value: &Value) -> Result<Problem, ProblemError> {
    for key in ["mesh", "material"] {
        if value.get(key).is_none_or(Value::is_null) {
            return Err(content(key, "missing"));
        }
    }
    let mut value = value.clone();
    if let Value::Object(map) = &mut value {
        for key in ["elements", "pins", "terms"] {
            if map.get(key).is_some_and(Value::is_null) {
                map.remove(key);
            }
        }
    }
    check_shape::<[f64; 2]>(&value, "/mesh/nodes", "mesh.nodes", "a point [x, y]")?;
    check_shape::<[usize; 3]>(&value, "/mesh/triangles", "mesh.triangles", "three node ids")?;
    check_shape::<ElementData>(&value, "/elements", "elements", "an element")?;
    check_shape::<PinData>(&value, "/pins", "pins", "a pin")?;
    check_shape::<f64>(&value, "/contractions", "contractions", "a number")?;
    check_shape::<TargetData>(&value, "/objective/targets", "objective.targets", "a target")?;
    check_shape::<Option<f64>>(&value, "/soft_ik/beta_upper", "soft_ik.beta_upper", "a number or null")?;
    check_shape::<Option<f64>>(&value, "/soft_ik/beta_lower", "soft_ik.beta_lower", "a number or null")?;
    check_shape::<f64>(&value, "/soft_ik/beta_start", "soft_ik.beta_start", "a number")?;
    check_shape::<i64>(&value, "/soft_ik/winch_ids", "soft_ik.winch_ids", "a winch id")?;
    check_shape::<Setting<TermKind>>(&value, "/terms", "terms", "an energy term")?;
    check_shape::<[f64; 2]>(&value, "/start", "start", "a point [x, y]")?;
    check_shape::<Vec<[f64; 2]>>(&value, "/drag/frames", "drag.frames", "a list of points [x, y]")?;
    check_shape::<usize>(&value, "/drag/report", "drag.report", "a frame index")?;
    for key in ["mesh", "material", "objective", "soft_ik", "gravity", "surface_density", "drag"] {
        let Some(part) = value.get(key) else { continue };
        let result = match key {
            "mesh" => serde_json::from_value::<MeshData>(part.clone()).map(drop),
            "material" => serde_json::from_value::<MaterialData>(part.clone()).map(drop),
            "objective" => serde_json::from_value::<Option<ObjectiveData>>(part.clone()).map(drop),
            "soft_ik" => serde_json::from_value::<Option<SoftIkData>>(part.clone()).map(drop),
            "gravity" => serde_json::from_value::<Option<[f64; 2]>>(part.clone()).map(drop),
            "surface_density" => serde_json::from_value::<Option<f64>>(part.clone()).map(drop),
            _ => serde_json::from_value::<Option<DragData>>(part.clone()).map(drop),
        };
        result.map_err(|e| content(key, e.to_string()))?;
    }
    serde_json::from_value(value).map_err(|e| content("problem", e.to_string()))
}

fn check_shape<T: serde::de::DeserializeOwned>(
    value: &Value,
    pointer: &str,
    key: &str,
    expected: &str,
) -> Result<(), ProblemError> {
    match value.pointer(pointer) {
        None | Some(Value::Null) => Ok(()),
        Some(Value::Array(items)) => {
            for (i, item) in items.iter().enumerate() {
                if let Err(e) = serde_json::from_value::<T>(item.clone()) {
                    return Err(content(format_args!("{key}[{i}]"), format!("expected {expected}: {e}")));
                }
            }
            Ok(())
        }
        Some(_) => Err(content(key, "must be a list")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: &str = r#"{"name": "small", "colour": [1, {"a": null}], "format": "plushwright-problem/1",
        "mesh": {"nodes": [[0, 0], [1, 0.0], [0, 1e0]], "triangles": [[0, 1, 2]], "shade": 3},
        "material": {"mu": 1, "kappa": 2.5},
        "elements": [{"routing": [1, 2], "K": 1, "epsilon": 0.001, "alpha0": 1.41421356237, "winch": -3}],
        "pins": null, "contractions": [0.1], "gravity": null, "zeal": true,
        "objective": {"targets": [{"node": 2, "xy": [0.5, 0.5]}], "regulariser": 1e-3},
        "soft_ik": {"beta_upper": [null], "beta_lower": [-0.25], "fixed_winches": {}}}"#;

    #[test]
    fn the_way_by_a_tree_reads_the_same() {
        let (problem, unknown) = read(SMALL).unwrap();
        let (other, same) = diagnose(SMALL).unwrap();
        assert_eq!(unknown, ["colour", "zeal"]);
        assert_eq!((format!("{problem:?}"), unknown), (format!("{other:?}"), same));
        assert!(serde_json::from_str::<Streamed>(SMALL).is_ok());
    }

    #[test]
    fn of_a_key_that_stands_twice_the_last_one_counts() {
        for (old, new) in [(r#""mu": 1"#, r#""mu": 1, "mu": 7"#), (r#""name""#, r#""material": {"mu": 7}, "name""#)] {
            let text = SMALL.replace(old, new);
            assert!(serde_json::from_str::<Streamed>(&text).is_err());
            let mu = read(&text).unwrap().0.material.value("mu");
            assert_eq!(mu, if new.contains("name") { 1.0 } else { 7.0 });
        }
    }

    /// Whatever is wrong with a text, both ways agree on whether it can be read, and on what it says.
    #[test]
    fn a_broken_text_is_refused_by_both_ways() {
        let pieces = ["null", "[]", "{}", "-1", "1.5", "\"a\"", ",", "]", "}", "true", "1e400", "18446744073709551616"];
        let (mut read_so, mut refused) = (0, 0);
        // Knuth's linear congruence: the same texts everywhere.
        let mut state = 3_u64;
        let mut below = |count: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % count
        };
        for _ in 0..4000 {
            let (from, length, piece) = (below(SMALL.len()), below(8), pieces[below(pieces.len())]);
            let text = [&SMALL[..from], piece, &SMALL[(from + length).min(SMALL.len())..]].concat();
            match (serde_json::from_str::<Streamed>(&text), diagnose(&text)) {
                (Ok(one), Ok((other, unknown))) => {
                    assert_eq!(format!("{:?}", one.problem), format!("{other:?}"), "{text}");
                    let mut known = one.unknown;
                    known.sort_unstable();
                    assert_eq!(known, unknown, "{text}");
                    read_so += 1;
                }
                // What is ignored need not be a number that can be held.
                (Ok(_), Err(error)) => assert!(error.to_string().contains("out of range"), "{error}: {text}"),
                (Err(_), _) => refused += 1,
            }
        }
        assert!(read_so > 100 && refused > 1000, "{read_so} {refused}");
    }
}
