//! Network discovery against published cases and against a reference that enumerates everything.

use plushwright::discovery::{DiscoveryError, Parameters, Spread, Stages, discover};
use serde_json::Value;
use std::collections::BTreeSet;

mod networks_reference;
use networks_reference::{Reference, reference};

fn json(name: &str) -> Value {
    let path = format!("{}/tests/data/networks/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn paths(value: &Value) -> BTreeSet<Vec<usize>> {
    serde_json::from_value(value.clone()).unwrap()
}

#[test]
fn published_cases_are_exact() {
    for name in ["network_random_1", "network_random_2"] {
        let (question, answer) = (json(name), json(&format!("{name}.answer")));
        let edges: Vec<[usize; 2]> = serde_json::from_value(question["edges"].clone()).unwrap();
        let weights: Vec<f64> = serde_json::from_value(question["weights"].clone()).unwrap();
        let count = |key: &str| question["parameters"][key].as_u64().unwrap() as usize;
        let parameters = Parameters {
            seed_num: count("SEED_NUM"),
            join_depth: count("JOIN_DEPTH"),
            join_len: count("JOIN_LEN"),
            tendon_num: count("TENDON_NUM"),
            phi: question["parameters"]["PHI"].as_f64().unwrap(),
            spread: Spread::Variance,
        };
        let stages = discover(question["nodes"].as_array().unwrap().len(), &edges, &weights, &parameters).unwrap();
        assert_eq!(stages.winch as u64, answer["winch"].as_u64().unwrap());
        assert_eq!(BTreeSet::from_iter(stages.tendons), paths(&answer["tendons"]));
        assert!((stages.score - answer["score"].as_f64().unwrap()).abs() < 1e-15);
        let pairs = |pairs: &[[usize; 2]]| pairs.iter().map(|pair| pair.to_vec()).collect::<BTreeSet<_>>();
        assert_eq!(pairs(&stages.seeds), paths(&answer["seed_edges"]));
        assert_eq!(pairs(&stages.tree), paths(&answer["tree"]));
        let joins: Vec<Value> = answer["joins"].as_array().unwrap().iter().map(|join| join["path"].clone()).collect();
        assert_eq!(BTreeSet::from_iter(stages.joins), paths(&Value::Array(joins)));
    }
}

/// xorshift64*: small, seeded, the same everywhere.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    fn below(&mut self, limit: usize) -> usize {
        ((self.next() >> 33) % limit as u64) as usize
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

struct Case {
    nodes: usize,
    edges: Vec<[usize; 2]>,
    weights: Vec<f64>,
    parameters: Parameters,
}

/// A connected or scattered graph with weights that are all different, full of ties, or partly negative.
fn random_case(random: &mut Random) -> Case {
    let nodes = 3 + random.below(8);
    let density = 0.15 + 0.5 * random.unit();
    let mut edges = Vec::new();
    for a in 0..nodes {
        for b in a + 1..nodes {
            if random.unit() < density {
                edges.push(if random.below(2) == 0 { [a, b] } else { [b, a] });
            }
        }
    }
    if edges.is_empty() {
        edges.push([1, 0]);
    }
    for i in (1..edges.len()).rev() {
        edges.swap(i, random.below(i + 1));
    }
    let kind = random.below(5);
    let mut weight = || match kind {
        0 => random.unit(),
        1 => 0.1 * (1 + random.below(3)) as f64,
        2 => random.below(3) as f64 - 0.5,
        3 => 1e-9 * random.below(100_000_000) as f64,
        _ => random.below(4) as f64,
    };
    let weights = edges.iter().map(|_| weight()).collect();
    let parameters = Parameters {
        seed_num: 1 + random.below(edges.len() + 2),
        join_depth: random.below(4),
        join_len: random.below(5),
        tendon_num: 1 + random.below(4),
        phi: [0.0, 0.1, 0.5, 0.83, 1.0][random.below(5)],
        spread: if random.below(2) == 0 { Spread::Variance } else { Spread::StandardDeviation },
    };
    Case { nodes, edges, weights, parameters }
}

fn check(index: usize, case: &Case) -> bool {
    let Case { nodes, edges, weights, parameters } = case;
    let expected = reference(*nodes, edges, weights, parameters);
    let found = discover(*nodes, edges, weights, parameters);
    let trees = |stages: &Stages, reference: &Reference| {
        assert_eq!(stages.seeds, reference.seeds, "seeds of case {index}");
        assert_eq!(stages.start, reference.start, "start of case {index}");
        assert_eq!(stages.tree, reference.tree, "tree of case {index}");
        let sorted = |joins: &[Vec<usize>]| joins.iter().cloned().collect::<BTreeSet<_>>();
        assert_eq!(sorted(&stages.joins), sorted(&reference.joins), "joins of case {index}");
    };
    match found {
        Ok(stages) => {
            trees(&stages, &expected);
            let (winch, tendons, score) = expected.network.unwrap_or_else(|| panic!("no network in case {index}"));
            assert_eq!(stages.winch, winch, "winch of case {index}: {edges:?} {weights:?} {parameters:?}");
            assert_eq!(BTreeSet::from_iter(stages.tendons), tendons, "tendons of case {index}");
            assert!((stages.score - score).abs() <= 1e-12 * (1.0 + score.abs()), "score of case {index}");
            true
        }
        Err(DiscoveryError::TooFewBranches { stages, most, .. }) => {
            trees(&stages, &expected);
            assert!(expected.network.is_none() && most < parameters.tendon_num);
            false
        }
        Err(error) => panic!("case {index}: {error}"),
    }
}

#[test]
fn random_graphs_agree_with_the_reference() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let solved = (0..6000).filter(|&index| check(index, &random_case(&mut random))).count();
    assert!(solved > 3000, "only {solved} cases had a network");
}

/// One tree with many leaves on each of several branches: the sets are where enumeration explodes.
#[test]
fn bushy_trees_agree_with_the_reference() {
    let mut random = Random(77);
    for index in 0..600 {
        let mut edges = Vec::new();
        let nodes = 10 + random.below(9);
        // Few hubs, so that some roots have many branches.
        let hubs = 1 + random.below(4);
        for node in 1..nodes {
            edges.push([random.below(node.min(hubs)), node]);
        }
        let step = [1e-9, 0.1, 1.0][random.below(3)];
        let range = [3, 20, 1_000_000][random.below(3)];
        let weights = edges.iter().map(|_| step * (random.below(range) as f64 - 1.0)).collect();
        let parameters = Parameters {
            seed_num: 100,
            join_depth: 0,
            join_len: 0,
            tendon_num: 1 + random.below(5),
            phi: [0.0, 0.02, 0.3, 0.6, 0.95, 1.0][random.below(6)],
            spread: if random.below(2) == 0 { Spread::Variance } else { Spread::StandardDeviation },
        };
        check(index, &Case { nodes, edges, weights, parameters });
    }
}
