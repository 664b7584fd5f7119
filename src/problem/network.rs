//! `plushwright-network/1`: one network discovery question, answered exactly by Algorithm 2.
//!
//! SI units. The variance of the score is that of a population, mixed with the mean as printed in the paper.

use crate::discovery::{DiscoveryError, Parameters, Spread, Stages, discover};
use serde_json::{Map, Value, json};
use std::borrow::Cow;

const FORMAT: &str = "plushwright-network/1";
/// Marks a number that JSON cannot hold in the text that is read in its place. Not found in sensible files.
const OUT_OF_RANGE: &str = "\u{1}out of range: ";

/// Why a network file has no answer. The message is one line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NetworkError {
    #[error("malformed JSON at line {line}, column {column}: {reason}")]
    Json { line: usize, column: usize, reason: String },
    /// `key` holds the 0-based index of the offending entry where there is one, as in `edges[3]`.
    #[error("{key}: {reason}")]
    Key { key: String, reason: String },
    /// A sound question without an answer. `answer` holds what was found: `"converged": false` and the winch tree.
    #[error("parameters.TENDON_NUM: {reason}")]
    NoNetwork { reason: String, answer: Value },
}

/// A network discovery question.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkProblem {
    pub nodes: Vec<[f64; 2]>,
    pub edges: Vec<[usize; 2]>,
    /// Contraction of each edge, m.
    pub weights: Vec<f64>,
    pub parameters: Parameters,
}

/// Answers the text of a file with `{"format": "plushwright-answer/1", "winch", "tendons", "score"}`, the tendons from
/// the winch outward.
///
/// # Errors
/// An unreadable or contradictory file, or a winch tree without a node of TENDON_NUM branches.
pub fn answer(text: &str) -> Result<Value, NetworkError> {
    let question = NetworkProblem::read(text)?;
    let stages = discover(question.nodes.len(), &question.edges, &question.weights, &question.parameters);
    match stages {
        Ok(Stages { winch, tendons, score, .. }) => {
            Ok(json!({ "format": "plushwright-answer/1", "winch": winch, "tendons": tendons, "score": score }))
        }
        Err(error) => Err(error.into()),
    }
}

impl NetworkProblem {
    /// Unknown keys are ignored.
    ///
    /// # Errors
    /// [`NetworkError::Json`] or [`NetworkError::Key`] for anything unreadable, of the wrong shape or not finite.
    pub fn read(text: &str) -> Result<Self, NetworkError> {
        let value = parse(text)?;
        let file = value.as_object().ok_or_else(|| refuse("file", "must be a JSON object"))?;
        match required(file, "", "format")?.as_str() {
            Some(FORMAT) => {}
            Some(other) => return Err(refuse("format", format!("unknown format {other:?}, expected {FORMAT:?}"))),
            None => return Err(refuse("format", "must be a string")),
        }
        let nodes = list(file, "nodes")?.iter().enumerate();
        let nodes = nodes.map(|(i, node)| pair(node, &format!("nodes[{i}]"), number)).collect::<Result<Vec<_>, _>>()?;
        let edges = list(file, "edges")?.iter().enumerate();
        let edges = edges.map(|(i, edge)| pair(edge, &format!("edges[{i}]"), index)).collect::<Result<Vec<_>, _>>()?;
        let weights = list(file, "weights")?.iter().enumerate();
        let weights =
            weights.map(|(i, weight)| number(weight, &format!("weights[{i}]"))).collect::<Result<Vec<_>, _>>()?;
        let parameters = required(file, "", "parameters")?;
        let parameters = parameters.as_object().ok_or_else(|| refuse("parameters", "must be an object"))?;
        let count = |key: &str| index(required(parameters, "parameters.", key)?, &format!("parameters.{key}"));
        let parameters = Parameters {
            seed_num: count("SEED_NUM")?,
            join_depth: count("JOIN_DEPTH")?,
            join_len: count("JOIN_LEN")?,
            tendon_num: count("TENDON_NUM")?,
            phi: number(required(parameters, "parameters.", "PHI")?, "parameters.PHI")?,
            spread: Spread::Variance,
        };
        Ok(Self { nodes, edges, weights, parameters })
    }
}

impl From<DiscoveryError> for NetworkError {
    fn from(error: DiscoveryError) -> Self {
        use DiscoveryError as E;
        match error {
            E::NoEdges => refuse("edges", "must not be empty"),
            E::WeightCount { edges, weights } => refuse("weights", format!("has {weights} entries for {edges} edges")),
            E::NodeOutOfRange { edge, node, nodes } => {
                refuse(format!("edges[{edge}]"), format!("node {node} is out of range, there are {nodes} nodes"))
            }
            E::SelfLoop { edge, node } => refuse(format!("edges[{edge}]"), format!("joins node {node} to itself")),
            E::DuplicateEdge { edge, first } => {
                refuse(format!("edges[{edge}]"), format!("is the same as edges[{first}]"))
            }
            E::NonFinite { edge } => refuse(format!("weights[{edge}]"), "must be a finite number below 1e100"),
            E::Parameter { name, expected } => refuse(format!("parameters.{name}"), format!("must be {expected}")),
            E::Inactive => refuse("weights", "no edge is contracted"),
            E::TooFewBranches { tendon_num, most, stages } => {
                let reason = format!("no node of the winch tree has {tendon_num} branches, the most is {most}");
                let answer = json!({
                    "format": "plushwright-answer/1",
                    "converged": false,
                    "error": format!("parameters.TENDON_NUM: {reason}"),
                    "tree": stages.tree,
                });
                Self::NoNetwork { reason, answer }
            }
        }
    }
}

fn refuse(key: impl Into<String>, reason: impl Into<String>) -> NetworkError {
    NetworkError::Key { key: key.into(), reason: reason.into() }
}

fn required<'a>(object: &'a Map<String, Value>, prefix: &str, key: &str) -> Result<&'a Value, NetworkError> {
    object.get(key).ok_or_else(|| refuse(format!("{prefix}{key}"), "is missing"))
}

fn list<'a>(object: &'a Map<String, Value>, key: &str) -> Result<&'a Vec<Value>, NetworkError> {
    required(object, "", key)?.as_array().ok_or_else(|| refuse(key, "must be an array"))
}

fn pair<T>(
    value: &Value,
    key: &str,
    entry: impl Fn(&Value, &str) -> Result<T, NetworkError>,
) -> Result<[T; 2], NetworkError> {
    match value.as_array().map(Vec::as_slice) {
        Some([first, second]) => Ok([entry(first, &format!("{key}[0]"))?, entry(second, &format!("{key}[1]"))?]),
        Some(other) => Err(refuse(key, format!("must have 2 entries, has {}", other.len()))),
        None => Err(refuse(key, "must be an array of 2 entries")),
    }
}

fn number(value: &Value, key: &str) -> Result<f64, NetworkError> {
    let not_finite = value.as_str().and_then(|text| text.strip_prefix(OUT_OF_RANGE));
    match (value.as_f64(), not_finite) {
        (Some(number), _) if number.is_finite() => Ok(number),
        (_, Some(literal)) => Err(refuse(key, format!("{literal} is not a finite number"))),
        _ => Err(refuse(key, "must be a finite number")),
    }
}

/// A whole number from 0; `3.0` is one as well.
fn index(value: &Value, key: &str) -> Result<usize, NetworkError> {
    let number = number(value, key)?;
    // Up to 2^53 a double holds every whole number.
    if number.fract() != 0.0 || !(0.0..=9_007_199_254_740_992.0).contains(&number) {
        return Err(refuse(key, format!("must be a whole number from 0, is {value}")));
    }
    Ok(number as usize)
}

fn parse(text: &str) -> Result<Value, NetworkError> {
    let error = match serde_json::from_str(text) {
        Ok(value) => return Ok(value),
        Err(error) => error,
    };
    // The reader stops at a number beyond f64 and at NaN and the like, which some programs write, without knowing the
    // key. If such numbers are all that is wrong, they are refused by key and index.
    if let Cow::Owned(marked) = mark_out_of_range(text)
        && let Ok(value) = serde_json::from_str(&marked)
    {
        return Ok(value);
    }
    let (line, column) = (error.line(), error.column());
    let reason = error.to_string();
    let reason = reason.split(" at line ").next().unwrap_or_default().to_string();
    Err(NetworkError::Json { line, column, reason })
}

/// Puts strings in the place of numbers that are not finite.
fn mark_out_of_range(text: &str) -> Cow<'_, str> {
    let mut marked = String::new();
    let mut rest = text;
    let mut in_string = false;
    let mut changed = false;
    while let Some(first) = rest.chars().next() {
        let mut length = first.len_utf8();
        if in_string {
            match first {
                '\\' => length += rest[length..].chars().next().map_or(0, char::len_utf8),
                '"' => in_string = false,
                _ => {}
            }
        } else if first == '"' {
            in_string = true;
        } else if first.is_ascii_alphanumeric() || first == '-' {
            let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && !"+-.".contains(c));
            length = end.unwrap_or(rest.len());
            // Rust reads NaN and Infinity, too.
            if rest[..length].parse::<f64>().is_ok_and(|number| !number.is_finite()) {
                marked.push_str(&format!("\"\\u0001{}{}\"", &OUT_OF_RANGE[1..], &rest[..length]));
                rest = &rest[length..];
                changed = true;
                continue;
            }
        }
        marked.push_str(&rest[..length]);
        rest = &rest[length..];
    }
    if changed { Cow::Owned(marked) } else { Cow::Borrowed(text) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"{"format": "plushwright-network/1", "extra": [1, {"a": "NaN"}],
        "nodes": [[0, 0], [1, 0], [2, 0], [3, 1]], "edges": [[1, 0], [1, 2], [3, 1]], "weights": [0.3, 0.2, 0.25],
        "parameters": {"SEED_NUM": 3, "JOIN_DEPTH": 0, "JOIN_LEN": 0, "TENDON_NUM": 2, "PHI": 0.5}}"#;

    fn message(from: &str, to: &str) -> String {
        assert!(GOOD.contains(from));
        let message = answer(&GOOD.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(!message.contains('\n'), "{message}");
        message
    }

    #[test]
    fn a_star_is_answered() {
        let answer = answer(GOOD).unwrap();
        assert_eq!((&answer["format"], &answer["winch"]), (&json!("plushwright-answer/1"), &json!(1)));
        assert_eq!(answer["tendons"], json!([[1, 0], [1, 3]]));
        assert!((answer["score"].as_f64().unwrap() - (0.1375 - 0.5 * 0.025f64.powi(2))).abs() < 1e-15);
    }

    #[test]
    fn errors_name_the_key_and_the_index() {
        for (from, to, expected) in [
            ("network/1", "network/2", "format: unknown format \"plushwright-network/2\", expected"),
            ("\"format\"", "\"for\"", "format: is missing"),
            ("[2, 0]", "[2, 1e999]", "nodes[2][1]: 1e999 is not a finite number"),
            ("[2, 0]", "[2]", "nodes[2]: must have 2 entries, has 1"),
            ("[2, 0]", "7", "nodes[2]: must be an array of 2 entries"),
            ("[1, 2]", "[1, 4]", "edges[1]: node 4 is out of range, there are 4 nodes"),
            ("[1, 2]", "[1, -2]", "edges[1][1]: must be a whole number from 0, is -2"),
            ("[1, 2]", "[1, 2.5]", "edges[1][1]: must be a whole number from 0, is 2.5"),
            ("[1, 2]", "[1, 1]", "edges[1]: joins node 1 to itself"),
            ("[1, 2]", "[0, 1]", "edges[1]: is the same as edges[0]"),
            (", 0.25", "", "weights: has 2 entries for 3 edges"),
            ("0.25", "NaN", "weights[2]: NaN is not a finite number"),
            ("0.25", "-Infinity", "weights[2]: -Infinity is not a finite number"),
            ("0.25", "-1E+999", "weights[2]: -1E+999 is not a finite number"),
            ("0.25", "1e200", "weights[2]: must be a finite number below 1e100"),
            ("0.25", "null", "weights[2]: must be a finite number"),
            ("[0.3, 0.2, 0.25]", "3", "weights: must be an array"),
            ("[[1, 0], [1, 2], [3, 1]]", "[]", "edges: must not be empty"),
            ("\"SEED_NUM\": 3", "\"SEED_NUM\": 0", "parameters.SEED_NUM: must be at least 1"),
            ("\"TENDON_NUM\": 2", "\"TENDON_NUM\": \"2\"", "parameters.TENDON_NUM: must be a finite number"),
            ("\"PHI\": 0.5", "\"PHI\": 1.5", "parameters.PHI: must be between 0 and 1"),
            ("\"PHI\"", "\"phi\"", "parameters.PHI: is missing"),
            ("\"weights\"", "\"weight\"", "weights: is missing"),
        ] {
            let message = message(from, to);
            assert!(message.starts_with(expected), "{message} / {expected}");
        }
    }

    #[test]
    fn malformed_json_names_line_and_column() {
        assert!(message("0.25]", "0.25").starts_with("malformed JSON at line 3, column "));
        // Two faults: the one that is not a number decides.
        assert!(message("0.25]", "1e999").starts_with("malformed JSON at line 2, column "));
        assert!(answer("").unwrap_err().to_string().starts_with("malformed JSON at line 1, column 0"));
        assert_eq!(answer("[1]").unwrap_err().to_string(), "file: must be a JSON object");
        assert!(message("[3, 1]]", "[3, 1e]]").contains("line 2"));
    }

    #[test]
    fn too_many_tendons_leave_the_tree() {
        let error = answer(&GOOD.replace("\"TENDON_NUM\": 2", "\"TENDON_NUM\": 4")).unwrap_err();
        assert_eq!(error.to_string(), "parameters.TENDON_NUM: no node of the winch tree has 4 branches, the most is 3");
        let NetworkError::NoNetwork { answer, .. } = error else { panic!("{error}") };
        assert_eq!((&answer["converged"], &answer["tree"]), (&json!(false), &json!([[0, 1], [1, 2], [1, 3]])));
    }
}
