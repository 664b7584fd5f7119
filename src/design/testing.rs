//! A small sound design for tests: a square of 60 mm, four triangles, two networks, two poses, two keyframes.

use super::*;

pub(crate) fn sample() -> Design {
    let corners = vec![[0.0, 0.0], [60.0, 0.0], [60.0, 60.0], [0.0, 60.0]];
    let mut nodes = corners.clone();
    nodes.push([30.0, 30.0]);
    let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    let mut design = Design::new("sample", Outline { outer: corners, holes: vec![] }, Mesh { nodes, triangles });
    let tendon = |routing: &[usize]| Tendon {
        routing: MaterialPoint::through(routing.iter().copied()),
        ratio: 1.0,
        slack_mm: 0.0,
    };
    let corner = BodyPoint { triangle: 0, weights: [1.0, 0.0, 0.0] };
    design.pins = vec![Pin::at_rest(corner, defaults::PIN_STIFFNESS)];
    let target = Target { at: BodyPoint { triangle: 2, weights: [0.25, 0.25, 0.5] }, to: [20.0, 70.0], weight: 1.0 };
    design.poses =
        vec![Pose { name: "lean".into(), targets: vec![target] }, Pose { name: "rest".into(), targets: vec![] }];
    design.networks = vec![
        Network::new("left", vec![tendon(&[4, 0]), tendon(&[4, 3])]),
        Network::new("right", vec![tendon(&[1, 4, 2])]),
    ];
    let keyframe = |time_s, a, pose: &str| Keyframe {
        time_s,
        activations_mm: vec![a, 0.5 * a],
        pose: Some(pose.into()),
        easing: Easing::Smooth,
    };
    design.keyframes = vec![keyframe(0.0, 0.0, "rest"), keyframe(1.0, 6.0, "lean")];
    design
}
