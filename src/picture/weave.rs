//! The muscle fibres of a body: by which nodes they run, and how long they are at rest.

use crate::design::Design;
use crate::outline::polygon;

/// What follows from mesh and routings alone: to be kept while [these stay](Self::is_of).
#[derive(Clone, Debug, PartialEq)]
pub struct Weave {
    /// Nodes of the fibres in the order of [`Design::fiber_routings`], one after the other: they are read in any order in every frame.
    nodes: Vec<usize>,
    /// Where those of each fibre end.
    ends: Vec<usize>,
    /// Length of each fibre at rest, mm.
    pub lengths_mm: Vec<f64>,
}

impl Weave {
    /// The fibres of a design. Cost: a millisecond or two for ten thousand.
    pub fn of(design: &Design) -> Self {
        let routings = design.fiber_routings();
        let nodes = &design.mesh.nodes;
        let length = |routing: &Vec<usize>| {
            let pieces = routing.windows(2).filter_map(|w| Some((*nodes.get(w[0])?, *nodes.get(w[1])?)));
            pieces.map(|(a, b)| polygon::length(a, b)).sum()
        };
        let lengths_mm = routings.iter().map(length).collect();
        let ends = routings.iter().scan(0, |end, routing| {
            *end += routing.len();
            Some(*end)
        });
        Self { ends: ends.collect(), nodes: routings.concat(), lengths_mm }
    }

    /// How many fibres there are.
    pub fn count(&self) -> usize {
        self.ends.len()
    }

    /// The nodes of a fibre.
    pub fn routing(&self, fiber: usize) -> &[usize] {
        let start = if fiber == 0 { 0 } else { self.ends[fiber - 1] };
        &self.nodes[start..self.ends[fiber]]
    }

    /// Whether it would be the same for another design.
    pub fn is_of(before: &Design, design: &Design) -> bool {
        before.fibers.set == design.fibers.set && before.mesh == design.mesh
    }

    /// Contraction of each fibre as a part of its rest length; zeros for a shape without fibres.
    pub fn contracted(&self, contractions_mm: &[f64]) -> Vec<f64> {
        if contractions_mm.len() != self.count() {
            return vec![0.0; self.count()];
        }
        let part = |(rest, contraction): (&f64, &f64)| if *rest > 0.0 { (contraction / rest).max(0.0) } else { 0.0 };
        self.lengths_mm.iter().zip(contractions_mm).map(part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::FiberSet;
    use crate::design::testing::sample;

    #[test]
    fn fibres_are_those_of_mesh_and_routings() {
        let design = sample();
        let weave = Weave::of(&design);
        let routings: Vec<&[usize]> = (0..weave.count()).map(|fiber| weave.routing(fiber)).collect();
        assert_eq!(routings, design.fiber_routings());
        let moved = Design { poses: Vec::new(), ..design.clone() };
        assert!(Weave::is_of(&design, &moved));
        let mut other = design.clone();
        other.fibers.set = FiberSet::Routings(vec![weave.routing(0).to_vec()]);
        assert!(!Weave::is_of(&design, &other));
        // Half of its length, and a shape without fibres.
        let half: Vec<f64> = weave.lengths_mm.iter().map(|length| 0.5 * length).collect();
        assert!(weave.contracted(&half).iter().all(|part| (part - 0.5).abs() < 1e-12));
        assert_eq!(weave.contracted(&[]), vec![0.0; weave.count()]);
    }
}
