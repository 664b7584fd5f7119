//! Reading and checking a `plushwright-problem/1` file.

use super::limits;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

pub const FORMAT: &str = "plushwright-problem/1";

/// What is wrong with a problem file: one line that names the key and the offending index.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProblemError {
    #[error("malformed JSON: {0}")]
    Json(String),
    #[error("{key}: {what}")]
    Content { key: String, what: String },
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Problem {
    pub mesh: MeshData,
    pub material: MaterialData,
    #[serde(default)]
    pub elements: Vec<ElementData>,
    #[serde(default)]
    pub pins: Vec<PinData>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contractions: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub objective: Option<ObjectiveData>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub soft_ik: Option<SoftIkData>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<Vec<[f64; 2]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface_density: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drag: Option<DragData>,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct MeshData {
    pub nodes: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub struct MaterialData {
    pub mu: f64,
    pub kappa: f64,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ElementData {
    pub routing: Vec<usize>,
    #[serde(rename = "K")]
    pub stiffness: f64,
    pub epsilon: f64,
    pub alpha0: f64,
    pub winch: i64,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct PinData {
    pub node: usize,
    pub target: [f64; 2],
    #[serde(rename = "K")]
    pub stiffness: f64,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct ObjectiveData {
    #[serde(default)]
    pub targets: Vec<TargetData>,
    #[serde(default)]
    pub default_weight: f64,
    #[serde(default)]
    pub regulariser: f64,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct TargetData {
    pub node: usize,
    pub xy: [f64; 2],
    #[serde(default = "one")]
    pub weight: f64,
}

fn one() -> f64 {
    1.0
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct SoftIkData {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub winch_ids: Option<Vec<i64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beta_upper: Option<Vec<Option<f64>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beta_lower: Option<Vec<Option<f64>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beta_start: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed_winches: Option<BTreeMap<String, f64>>,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct DragData {
    pub frames: Vec<Vec<[f64; 2]>>,
    #[serde(default)]
    pub report: Vec<usize>,
    #[serde(default)]
    pub tension_regulariser: f64,
}

/// Keys a problem may have; others are ignored, and named under `--verbose`.
const KNOWN_KEYS: [&str; 17] = [
    "format",
    "name",
    "note",
    "units",
    "tags",
    "n_edges",
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
    "drag",
];

/// Reads and checks a problem. Also returns the unknown top-level keys that were ignored.
pub fn read(text: &str) -> Result<(Problem, Vec<String>), ProblemError> {
    let value: Value = serde_json::from_str(text).map_err(|e| ProblemError::Json(e.to_string()))?;
    let Value::Object(map) = &value else {
        return Err(content("problem", "must be a JSON object"));
    };
    match map.get("format").and_then(Value::as_str) {
        Some(FORMAT) => {}
        Some(other) => return Err(content("format", format!("\"{other}\" is unknown, expected \"{FORMAT}\""))),
        None => return Err(content("format", format!("missing, expected \"{FORMAT}\""))),
    }
    let unknown = map.keys().filter(|k| !KNOWN_KEYS.contains(&k.as_str())).cloned().collect();
    let problem: Problem = typed(&value)?;
    problem.check()?;
    Ok((problem, unknown))
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
        for key in ["elements", "pins"] {
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
                    return Err(content(&format!("{key}[{i}]"), format!("expected {expected}: {e}")));
                }
            }
            Ok(())
        }
        Some(_) => Err(content(key, "must be a list")),
    }
}

fn content(key: &str, what: impl Into<String>) -> ProblemError {
    ProblemError::Content { key: key.to_string(), what: what.into() }
}

impl Problem {
    /// The problem as a file. Numbers keep every bit.
    pub fn to_text(&self) -> Result<String, ProblemError> {
        let mut value = serde_json::to_value(self).map_err(|e| ProblemError::Json(e.to_string()))?;
        if let Value::Object(map) = &mut value {
            map.insert("format".into(), FORMAT.into());
        }
        serde_json::to_string(&value).map_err(|e| ProblemError::Json(e.to_string()))
    }
}

impl MeshData {
    /// Signed area of a triangle, m^2.
    pub(crate) fn area(&self, t: &[usize; 3]) -> f64 {
        let [p, q, r] = t.map(|k| self.nodes[k]);
        0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]))
    }
}

impl Problem {
    /// The ids of all winches, ascending.
    pub fn all_winches(&self) -> Vec<i64> {
        let mut ids: Vec<i64> = self.elements.iter().map(|e| e.winch).collect();
        ids.sort_unstable();
        ids.dedup();
        ids
    }

    /// The winches that `fixed_winches` holds, with their activations.
    pub fn fixed_winches(&self) -> Result<BTreeMap<i64, f64>, ProblemError> {
        let known = self.all_winches();
        let mut out = BTreeMap::new();
        for (key, value) in self.soft_ik.iter().flat_map(|s| s.fixed_winches.iter().flatten()) {
            let name = format!("soft_ik.fixed_winches.{key}");
            let id: i64 = key.parse().map_err(|_| content(&name, "is not a winch id"))?;
            if known.binary_search(&id).is_err() {
                return Err(content(&name, "no element has this winch"));
            }
            finite(&name, *value)?;
            out.insert(id, *value);
        }
        Ok(out)
    }

    /// The free winches in the order of all arrays of `soft_ik`.
    pub fn free_winches(&self) -> Result<Vec<i64>, ProblemError> {
        let fixed = self.fixed_winches()?;
        let known = self.all_winches();
        match self.soft_ik.as_ref().and_then(|s| s.winch_ids.clone()) {
            None => Ok(known.into_iter().filter(|id| !fixed.contains_key(id)).collect()),
            Some(ids) => {
                let mut seen = BTreeSet::new();
                for (i, id) in ids.iter().enumerate() {
                    let key = format!("soft_ik.winch_ids[{i}]");
                    if known.binary_search(id).is_err() {
                        return Err(content(&key, format!("no element has winch {id}")));
                    }
                    if !seen.insert(*id) {
                        return Err(content(&key, format!("winch {id} is listed twice")));
                    }
                    if fixed.contains_key(id) {
                        return Err(content(&key, format!("winch {id} is also in fixed_winches")));
                    }
                }
                Ok(ids)
            }
        }
    }

    fn check(&self) -> Result<(), ProblemError> {
        let n = self.mesh.nodes.len();
        for (i, p) in self.mesh.nodes.iter().enumerate() {
            finite_point(&format!("mesh.nodes[{i}]"), p)?;
        }
        if self.mesh.triangles.is_empty() {
            return Err(content("mesh.triangles", "is empty"));
        }
        for (i, t) in self.mesh.triangles.iter().enumerate() {
            let key = format!("mesh.triangles[{i}]");
            for node in t {
                in_range(&key, *node, n)?;
            }
        }
        finite("material.mu", self.material.mu)?;
        finite("material.kappa", self.material.kappa)?;
        limits::size(self)?;
        for (i, t) in self.mesh.triangles.iter().enumerate() {
            let key = format!("mesh.triangles[{i}]");
            let area = self.mesh.area(t);
            if area < 0.0 {
                return Err(content(&key, "is clockwise"));
            }
            if area.is_nan() || area <= 0.0 || !area.is_finite() {
                return Err(content(&key, "has no area"));
            }
        }
        let m = &self.material;
        if m.mu <= 0.0 {
            return Err(content("material.mu", format!("must be positive, is {}", m.mu)));
        }
        if m.kappa < 0.0 {
            return Err(content("material.kappa", format!("must not be negative, is {}", m.kappa)));
        }
        self.check_elements(n)?;
        for (i, pin) in self.pins.iter().enumerate() {
            let key = format!("pins[{i}]");
            in_range(&format!("{key}.node"), pin.node, n)?;
            finite_point(&format!("{key}.target"), &pin.target)?;
            not_negative(&format!("{key}.K"), pin.stiffness)?;
        }
        length("contractions", self.contractions.as_ref().map(Vec::len), self.elements.len(), "elements")?;
        for (i, c) in self.contractions.iter().flatten().enumerate() {
            finite(&format!("contractions[{i}]"), *c)?;
        }
        if let Some(objective) = &self.objective {
            not_negative("objective.default_weight", objective.default_weight)?;
            not_negative("objective.regulariser", objective.regulariser)?;
            for (i, t) in objective.targets.iter().enumerate() {
                let key = format!("objective.targets[{i}]");
                in_range(&format!("{key}.node"), t.node, n)?;
                finite_point(&format!("{key}.xy"), &t.xy)?;
                not_negative(&format!("{key}.weight"), t.weight)?;
            }
        }
        self.check_soft_ik()?;
        length("start", self.start.as_ref().map(Vec::len), n, "nodes")?;
        for (i, p) in self.start.iter().flatten().enumerate() {
            finite_point(&format!("start[{i}]"), p)?;
        }
        if let Some(g) = &self.gravity {
            finite_point("gravity", g)?;
            if self.surface_density.is_none() {
                return Err(content("surface_density", "missing, gravity needs it"));
            }
        }
        if let Some(density) = self.surface_density {
            not_negative("surface_density", density)?;
        }
        self.check_drag()?;
        limits::check(self)
    }

    fn check_elements(&self, nodes: usize) -> Result<(), ProblemError> {
        for (i, e) in self.elements.iter().enumerate() {
            let key = format!("elements[{i}]");
            if e.routing.len() < 2 {
                return Err(content(&format!("{key}.routing"), "needs at least two nodes"));
            }
            for (k, node) in e.routing.iter().enumerate() {
                in_range(&format!("{key}.routing[{k}]"), *node, nodes)?;
                if k > 0 && e.routing[k - 1] == *node {
                    return Err(content(&format!("{key}.routing[{k}]"), format!("node {node} twice in a row")));
                }
            }
            not_negative(&format!("{key}.K"), e.stiffness)?;
            for (name, value) in [("epsilon", e.epsilon), ("alpha0", e.alpha0)] {
                finite(&format!("{key}.{name}"), value)?;
                if value <= 0.0 {
                    return Err(content(&format!("{key}.{name}"), format!("must be positive, is {value}")));
                }
            }
        }
        Ok(())
    }

    fn check_soft_ik(&self) -> Result<(), ProblemError> {
        let free = self.free_winches()?;
        let Some(ik) = &self.soft_ik else { return Ok(()) };
        let count = free.len();
        length("soft_ik.beta_upper", ik.beta_upper.as_ref().map(Vec::len), count, "winches")?;
        length("soft_ik.beta_lower", ik.beta_lower.as_ref().map(Vec::len), count, "winches")?;
        length("soft_ik.beta_start", ik.beta_start.as_ref().map(Vec::len), count, "winches")?;
        for j in 0..count {
            let upper = ik.beta_upper.as_ref().and_then(|u| u[j]);
            let lower = ik.beta_lower.as_ref().and_then(|l| l[j]);
            for (name, value) in [("beta_upper", upper), ("beta_lower", lower)] {
                finite(&format!("soft_ik.{name}[{j}]"), value.unwrap_or(0.0))?;
            }
            if let (Some(lower), Some(upper)) = (lower, upper)
                && lower > upper
            {
                return Err(content(
                    &format!("soft_ik.beta_lower[{j}]"),
                    format!("{lower} is above the upper {upper}"),
                ));
            }
            finite(&format!("soft_ik.beta_start[{j}]"), ik.beta_start.as_ref().map_or(0.0, |b| b[j]))?;
        }
        Ok(())
    }

    fn check_drag(&self) -> Result<(), ProblemError> {
        let Some(drag) = &self.drag else { return Ok(()) };
        let Some(objective) = &self.objective else {
            return Err(content("objective", "missing, drag needs its targets"));
        };
        not_negative("drag.tension_regulariser", drag.tension_regulariser)?;
        for (k, frame) in drag.frames.iter().enumerate() {
            length(&format!("drag.frames[{k}]"), Some(frame.len()), objective.targets.len(), "targets")?;
            for (t, p) in frame.iter().enumerate() {
                finite_point(&format!("drag.frames[{k}][{t}]"), p)?;
            }
        }
        for (i, k) in drag.report.iter().enumerate() {
            if *k >= drag.frames.len() {
                let what = format!("frame {k} is out of range, there are {}", drag.frames.len());
                return Err(content(&format!("drag.report[{i}]"), what));
            }
        }
        Ok(())
    }
}

fn in_range(key: &str, node: usize, nodes: usize) -> Result<(), ProblemError> {
    if node < nodes { Ok(()) } else { Err(content(key, format!("node {node} is out of range, the mesh has {nodes}"))) }
}

fn finite(key: &str, value: f64) -> Result<(), ProblemError> {
    if value.is_finite() { Ok(()) } else { Err(content(key, "is not a finite number")) }
}

fn finite_point(key: &str, p: &[f64; 2]) -> Result<(), ProblemError> {
    finite(key, p[0]).and_then(|()| finite(key, p[1]))
}

fn not_negative(key: &str, value: f64) -> Result<(), ProblemError> {
    finite(key, value)?;
    if value < 0.0 { Err(content(key, format!("must not be negative, is {value}"))) } else { Ok(()) }
}

fn length(key: &str, actual: Option<usize>, expected: usize, of: &str) -> Result<(), ProblemError> {
    match actual {
        Some(n) if n != expected => Err(content(key, format!("has {n} entries, there are {expected} {of}"))),
        _ => Ok(()),
    }
}
