//! Network discovery against published cases and against a reference that enumerates everything.

use plushwright::discovery::{DiscoveryError, Parameters, Spread, Stages, candidates, discover, propose};
use plushwright::problem::network;
use serde_json::Value;
use std::collections::BTreeSet;

use crate::networks_reference::{Reference, reference};

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

        let found = network::answer(&question.to_string()).unwrap();
        assert_eq!((&found["format"], &found["winch"]), (&answer["format"], &answer["winch"]));
        assert_eq!(paths(&found["tendons"]), paths(&answer["tendons"]));
        assert_eq!(found["score"].as_f64().unwrap(), stages.score);
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

/// A triangulated strip of body, about as many fibres as asked, with contractions in smooth patches.
fn body(random: &mut Random, fibers: usize) -> Case {
    let width = ((fibers as f64 / 3.0).sqrt() * 0.7) as usize;
    let height = fibers / 3 / width;
    let mut edges = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let node = y * width + x;
            if x + 1 < width {
                edges.push([node, node + 1]);
            }
            if y + 1 < height {
                edges.push([node, node + width]);
                if x + 1 < width {
                    edges.push([node, node + width + 1]);
                }
            }
        }
    }
    let patches: Vec<[f64; 2]> =
        (0..4).map(|_| [random.unit() * width as f64, random.unit() * height as f64]).collect();
    let weight = |&[a, _]: &[usize; 2], noise: f64| {
        let at = [(a % width) as f64, (a / width) as f64];
        let near = patches.iter().map(|p| (-((at[0] - p[0]).powi(2) + (at[1] - p[1]).powi(2)) / 20.0).exp());
        near.sum::<f64>() * noise
    };
    let weights = edges.iter().map(|edge| weight(edge, random.unit())).collect();
    Case { nodes: width * height, edges, weights, parameters: Parameters::default() }
}

/// No blow-up: what enumeration would need ages for ends in milliseconds. The limits leave room for slow machines and
/// unoptimised builds; `--nocapture` shows the figures.
#[test]
fn large_questions_stay_fast() {
    let mut random = Random(5);
    let timed = |name: &str, limit_ms: f64, run: &mut dyn FnMut()| {
        let start = std::time::Instant::now();
        run();
        let elapsed = start.elapsed().as_secs_f64() * 1e3;
        println!("{name}: {elapsed:.2} ms");
        assert!(elapsed < limit_ms, "{name}: {elapsed} ms");
    };
    for fibers in [430, 1055, 5000] {
        let mut case = body(&mut random, fibers);
        let run = |case: &Case| discover(case.nodes, &case.edges, &case.weights, &case.parameters);
        timed(&format!("{fibers} fibres, defaults"), 500.0, &mut || drop(run(&case)));
        case.parameters =
            Parameters { seed_num: fibers / 3, join_depth: 5, join_len: 4, tendon_num: 3, ..case.parameters };
        for phi in [0.0, 0.05, 0.5, 1.0] {
            case.parameters.phi = phi;
            timed(&format!("{fibers} fibres, a third seeds, phi {phi}"), 4000.0, &mut || drop(run(&case)));
        }
        let mut found = 0;
        timed(&format!("{fibers} fibres, candidates"), 10_000.0, &mut || {
            let base = Parameters::default();
            found = candidates(case.nodes, &case.edges, &case.weights, &base, &[1, 2, 3]).unwrap().len();
        });
        println!("  {found} networks");
        assert!(found > 3);
    }
    for hubs in [1, 5, 25] {
        for ties in [false, true] {
            let edges: Vec<[usize; 2]> = (1..201).map(|node| [random.below(node.min(hubs)), node]).collect();
            let weights = edges.iter().map(|_| if ties { 1.0 } else { random.unit() }).collect();
            let mut case = Case { nodes: 201, edges, weights, parameters: Parameters::default() };
            for (phi, spread) in [
                (0.01, Spread::Variance),
                (0.5, Spread::StandardDeviation),
                (1.0, Spread::Variance),
                (0.0, Spread::Variance),
            ] {
                case.parameters = Parameters { seed_num: 200, join_depth: 0, join_len: 0, tendon_num: 8, phi, spread };
                timed(&format!("200 edges, {hubs} hubs, 8 tendons, phi {phi}, ties {ties}"), 4000.0, &mut || {
                    let _ = discover(case.nodes, &case.edges, &case.weights, &case.parameters);
                });
            }
        }
    }
}

#[test]
fn candidates_are_distinct_start_with_the_base_and_can_be_found_again() {
    let mut random = Random(11);
    let case = body(&mut random, 430);
    let base = Parameters::default();
    let found = candidates(case.nodes, &case.edges, &case.weights, &base, &[2, 1, 3]).unwrap();
    assert_eq!(found[0].0, base);
    let sets: BTreeSet<_> = found.iter().map(|(_, stages)| stages.tendons.clone()).collect();
    assert_eq!(sets.len(), found.len());
    for (parameters, stages) in &found {
        assert_eq!(&discover(case.nodes, &case.edges, &case.weights, parameters).unwrap(), stages);
    }
}

#[test]
fn the_proposal_takes_fewer_tendons_and_only_contracted_fibres() {
    let edges = [[0, 1], [1, 2], [2, 3], [1, 4]];
    let parameters = Parameters { seed_num: 4, tendon_num: 5, ..Parameters::default() };
    let stages = propose(5, &edges, &[1.0, 1.0, -1.0, 1.0], &parameters).unwrap();
    assert_eq!((stages.winch, stages.tendons), (1, vec![vec![1, 0], vec![1, 2], vec![1, 4]]));
    assert_eq!(propose(5, &edges, &[0.0; 4], &parameters), Err(DiscoveryError::Inactive));
}
