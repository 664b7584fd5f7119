//! Networks of Algorithm 2 as layouts, with the stages that found them.

use super::proposal::{Paper, ProposeOptions};
use crate::design::Design;
use crate::discovery;
use crate::outline::{Point, polygon};
use crate::rigging::activation::ActivationGraph;
use crate::rigging::layout::{Layout, Placed};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Networks that are looked at: that of the parameters as given, and others of the grid.
const NETWORKS: usize = 4;
/// A path is straight where it leaves a line by no more than this part of the body: edges of the mesh go to and fro.
const STRAIGHT: f64 = 0.03;

/// The networks of Algorithm 2 for the one pose of a design, paths thinned to as many holes as may be; those of the parameters as given first.
/// Empty where no fibre is contracted. `bare`: the mesh is not that of the document, so that the stages could not be shown.
pub(super) fn layouts(
    design: &Design,
    bare: bool,
    options: &ProposeOptions,
    most_holes: usize,
    cancel: &AtomicBool,
) -> Vec<(Layout, Paper)> {
    let targets = design.poses.first().map_or(&[][..], |pose| &pose.targets);
    let Some(graph) = ActivationGraph::of_pose(design, targets, cancel) else { return Vec::new() };
    let parameters = &options.parameters;
    let fewer = (1..parameters.tendon_num).rev().filter(|_| options.fewer);
    let numbers: Vec<usize> = std::iter::once(parameters.tendon_num).chain(fewer).collect();
    let found = discovery::candidates(design.mesh.nodes.len(), &graph.edges, &graph.weights, parameters, &numbers);
    let layout = |(parameters, stages): (discovery::Parameters, discovery::Stages)| {
        let place = |node: usize| design.mesh.nodes[node];
        let path = |nodes: &Vec<usize>| -> Vec<Point> { nodes.iter().map(|n| place(*n)).collect() };
        let straight = STRAIGHT * design.body_length_mm();
        let cables =
            stages.tendons.iter().map(|nodes| thinned(&path(nodes), most_holes, straight)[1..].to_vec().into());
        let layout = Layout { winches: vec![Placed { at: place(stages.winch), cables: cables.collect() }] };
        (layout, (!bare).then(|| (parameters, Arc::new(stages))))
    };
    found.unwrap_or_default().into_iter().take(NETWORKS).map(layout).collect()
}

/// A path with at most so many points between its ends: those stay that lie farthest from the way without them, and farther than `straight`
/// (Douglas and Peucker 1973).
fn thinned(path: &[Point], most: usize, straight: f64) -> Vec<Point> {
    let mut kept = vec![0, path.len() - 1];
    while kept.len() < most + 2 {
        let off = |s: &[usize]| {
            let between = (s[0] + 1..s[1]).map(|k| (polygon::distance_to_segment(path[s[0]], path[s[1]], path[k]), k));
            between.max_by(|a, b| a.0.total_cmp(&b.0))
        };
        let farthest = kept.windows(2).filter_map(off).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, k)) = farthest.filter(|(off, _)| *off > straight) else { break };
        kept.push(k);
        kept.sort_unstable();
    }
    kept.into_iter().map(|k| path[k]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thinned_path_keeps_its_ends_and_its_corners() {
        let path = [[0.0, 0.0], [1.0, 0.1], [2.0, 2.0], [3.0, 0.0], [4.0, 0.0], [5.0, 0.0]];
        assert_eq!(thinned(&path, 0, 0.0), [path[0], path[5]]);
        assert_eq!(thinned(&path, 1, 0.0), [path[0], path[2], path[5]]);
        assert_eq!(thinned(&path, 9, 0.0).len(), 5);
        assert_eq!(thinned(&path, 9, 1.2), [path[0], path[2], path[5]]);
        assert_eq!(thinned(&path[..2], 4, 0.0), path[..2]);
    }
}
