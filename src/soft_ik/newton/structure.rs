//! The structure of the saddle-point matrix: where everything lands.

use super::form::Form;
use super::rows::Stencils;
use super::saddle::Saddle;
use crate::physics::Energy;
use crate::physics::indefinite::Indefinite;
use crate::physics::pattern::{Pattern, Slots};
use crate::soft_ik::Question;

/// Up to this many winches the dense border costs less than a factorisation of the saddle-point matrix.
const FEW: usize = 16;

impl Saddle {
    /// `None` only where the factor would not fit into memory.
    pub fn new(question: &Question) -> Option<Self> {
        let stencils = Stencils::new(question);
        let model = &*question.model;
        let nodes = model.dimension() / 2;
        let twice = |list: &[usize]| list.iter().flat_map(|n| [2 * n, 2 * n + 1]).collect::<Vec<usize>>();
        let winches = &question.actuation.winches;
        let few = winches.len() <= FEW;
        let eliminated: Vec<bool> = winches.iter().map(|w| !few && w.members.len() == 1).collect();
        let element_slots = {
            let contractile = &model.contractile;
            model.pattern().slots((0..contractile.stencils()).map(|k| contractile.stencil(k)))
        };
        let coordinates = model.dimension();
        let z = vec![0.0; 2 * coordinates];
        let mut this = Self {
            coordinates,
            pattern: Pattern::new(0, std::iter::empty()),
            factor: None,
            eliminated,
            stencils,
            places: Vec::new(),
            slots: Slots::default(),
            element_slots,
            weights: Vec::new(),
            base: Vec::new(),
            values: Vec::new(),
            form: Form::GaussNewton,
            weights_now: Vec::new(),
            border: Vec::new(),
            columns: Vec::new(),
            fresh: false,
            schur: None,
            rest: z.clone(),
            product: z.clone(),
            z,
        };
        if few {
            return Some(this);
        }
        let (eliminated, stencils) = (&this.eliminated, &this.stencils);
        let single: Vec<Vec<usize>> =
            (0..stencils.count()).map(|j| if eliminated[j] { twice(stencils.nodes(j)) } else { Vec::new() }).collect();
        let coupled = coupled(model.pattern());
        let pairs: Vec<Vec<usize>> = coupled.iter().map(|pair| twice(pair)).collect();
        let held: Vec<Vec<usize>> = question.objective.targets.iter().map(|t| twice(&t.nodes)).collect();
        let all = pairs.iter().chain(&single).chain(&held).map(|s| s.as_slice());
        let pattern = Pattern::new(2 * nodes, all);
        let slots = pattern.slots(single.iter().map(|s| s.as_slice()));
        let mut places = Vec::with_capacity(model.pattern().nonzeros());
        let spread: Vec<usize> = model.pattern().unknowns().map(|d| 4 * (d / 2) + d % 2).collect();
        for column in 0..model.dimension() {
            let range = model.pattern().column_starts()[column]..model.pattern().column_starts()[column + 1];
            for &row in &model.pattern().row_indices()[range] {
                let (r, c) = (spread[row], spread[column]);
                places.push([(r, c), (r + 2, c), (c + 2, r)].map(|(r, c)| pattern.entry(r, c) as u32));
            }
        }
        let mut weights = Vec::new();
        for (k, target) in question.objective.targets.iter().enumerate() {
            for (a, (&n, v)) in target.nodes.iter().zip(&target.weights).enumerate() {
                for (&m, w) in target.nodes[..=a].iter().zip(&target.weights) {
                    for axis in 0..2 {
                        weights.push((k, pattern.entry(4 * n + axis, 4 * m + axis) as u32, v * w));
                    }
                }
            }
        }
        let values = vec![0.0; pattern.nonzeros()];
        this.factor = Some(Indefinite::new(&pattern)?);
        (this.pattern, this.places, this.slots, this.weights) = (pattern, places, slots, weights);
        (this.base, this.values) = (values.clone(), values);
        Some(this)
    }
}

/// The pairs of nodes that a pattern couples, every node with itself among them: a node of no element has no other.
fn coupled(pattern: &Pattern) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    let nodes: Vec<usize> = pattern.unknowns().map(|d| d / 2).collect();
    for column in (0..pattern.dimension()).step_by(2) {
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        for &row in pattern.row_indices()[range].iter().filter(|row| *row % 2 == 0) {
            pairs.push([nodes[column], nodes[row]]);
        }
    }
    pairs
}
