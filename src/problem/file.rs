//! What a `plushwright-problem/1` file holds.

use super::error::{ProblemError, content, finite};
pub use super::material::MaterialData;
use crate::physics::{Setting, TermKind};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

pub const FORMAT: &str = "plushwright-problem/1";

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
    /// Energy terms beside gravity.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub terms: Vec<Setting<TermKind>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drag: Option<DragData>,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct MeshData {
    pub nodes: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
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

impl Problem {
    /// The problem as a file. Numbers keep every bit.
    ///
    /// # Errors
    /// What JSON cannot write, which no problem has.
    pub fn to_text(&self) -> Result<String, ProblemError> {
        let whole = Written { format: FORMAT, problem: self };
        serde_json::to_string(&whole).map_err(|e| ProblemError::Json(e.to_string()))
    }
}

/// A problem with the key that says what it is.
#[derive(Serialize)]
struct Written<'a> {
    format: &'static str,
    #[serde(flatten)]
    problem: &'a Problem,
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
    ///
    /// # Errors
    /// [`ProblemError`]: a key that is no winch, a figure that is not finite.
    pub fn fixed_winches(&self) -> Result<BTreeMap<i64, f64>, ProblemError> {
        let known = self.all_winches();
        let mut out = BTreeMap::new();
        for (key, value) in self.soft_ik.iter().flat_map(|s| s.fixed_winches.iter().flatten()) {
            let name = format!("soft_ik.fixed_winches.{key}");
            let id: i64 = key.parse().map_err(|_| content(&name, "is not a winch id"))?;
            if known.binary_search(&id).is_err() {
                return Err(content(&name, "no element has this winch"));
            }
            finite(format_args!("{name}"), *value)?;
            out.insert(id, *value);
        }
        Ok(out)
    }

    /// The free winches in the order of all arrays of `soft_ik`.
    ///
    /// # Errors
    /// [`ProblemError`]: a winch that is unknown, listed twice, or fixed as well.
    pub fn free_winches(&self) -> Result<Vec<i64>, ProblemError> {
        let fixed = self.fixed_winches()?;
        let known = self.all_winches();
        match self.soft_ik.as_ref().and_then(|s| s.winch_ids.clone()) {
            None => Ok(known.into_iter().filter(|id| !fixed.contains_key(id)).collect()),
            Some(ids) => {
                let mut seen = BTreeSet::new();
                for (i, id) in ids.iter().enumerate() {
                    let key = format_args!("soft_ik.winch_ids[{i}]");
                    if known.binary_search(id).is_err() {
                        return Err(content(key, format!("no element has winch {id}")));
                    }
                    if !seen.insert(*id) {
                        return Err(content(key, format!("winch {id} is listed twice")));
                    }
                    if fixed.contains_key(id) {
                        return Err(content(key, format!("winch {id} is also in fixed_winches")));
                    }
                }
                Ok(ids)
            }
        }
    }
}
