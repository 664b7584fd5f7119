//! What the integration tests of the document and of the blueprint share: a seeded generator and a grid-shaped plushie.

pub mod bodies;
pub mod scenes;
pub mod shapes;
#[cfg(feature = "studio")]
pub mod sources;
#[cfg(feature = "studio")]
pub mod window;

use plushwright::design::{Design, Easing, Keyframe, MaterialPoint, Network, Pin, Pose, Target, Tendon};
use plushwright::mesh::{BodyPoint, Mesh};
use plushwright::outline::Outline;

/// SplitMix64: small, seeded, the same on every machine.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// Between 0 and 1, all 53 bits in play, so that text formats are put to the test.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn body_point(&mut self, mesh: &Mesh) -> BodyPoint {
        let (a, b) = (self.unit(), self.unit());
        let (a, b) = if a + b > 1.0 { (1.0 - a, 1.0 - b) } else { (a, b) };
        BodyPoint { triangle: self.below(mesh.triangles.len()), weights: [a, b, 1.0 - a - b] }
    }

    pub fn target(&mut self, mesh: &Mesh) -> Target {
        let to = [self.between(-300.0, 300.0), self.between(-300.0, 300.0)];
        Target { at: self.body_point(mesh), to, weight: self.between(0.0, 3.0) }
    }

    pub fn network(&mut self, mesh: &Mesh) -> Network {
        let n = mesh.nodes.len();
        let winch = self.below(n);
        let tendons = (0..1 + self.below(3))
            .map(|_| {
                let mut routing = vec![winch];
                for _ in 0..1 + self.below(4) {
                    let last = routing[routing.len() - 1];
                    routing.push((last + 1 + self.below(n - 1)) % n);
                }
                Tendon {
                    routing: MaterialPoint::through(routing),
                    ratio: self.between(0.5, 2.0),
                    slack_mm: self.between(0.0, 5.0),
                }
            })
            .collect();
        Network::new("winch 1", tendons)
    }
}

/// A bar of 6 x 2 squares, 120 x 40 mm, its left end pinned.
pub fn bar() -> Design {
    let (across, up) = (7, 3);
    let nodes = (0..up).flat_map(|j| (0..across).map(move |i| [20.0 * i as f64, 20.0 * j as f64])).collect();
    let mut triangles = Vec::new();
    for j in 0..up - 1 {
        for i in 0..across - 1 {
            let [a, b, c, d] = [j * across + i, j * across + i + 1, (j + 1) * across + i + 1, (j + 1) * across + i];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let outer = vec![[0.0, 0.0], [120.0, 0.0], [120.0, 40.0], [0.0, 40.0]];
    let mut design = Design::new("Bar", Outline { outer, holes: Vec::new() }, Mesh { nodes, triangles });
    for node in [0, 7, 14] {
        let at = design.mesh.node_point(node).unwrap();
        design.pins.push(Pin::at_rest(at, 20.0));
    }
    design
}

/// A winch at the left end with a tendon along the top, as discovery might propose.
pub fn network() -> Network {
    let tendon = Tendon { routing: MaterialPoint::through(14..20), ratio: 1.0, slack_mm: 0.0 };
    Network::new("winch 1", vec![tendon])
}

/// A `width` x `height` mm rectangle in `columns` x `rows` cells of two triangles.
pub fn rectangle(width: f64, height: f64, columns: usize, rows: usize) -> Design {
    let node = |i: usize, j: usize| j * (columns + 1) + i;
    let mut mesh = Mesh::default();
    for j in 0..=rows {
        for i in 0..=columns {
            mesh.nodes.push([width * i as f64 / columns as f64, height * j as f64 / rows as f64]);
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            mesh.triangles.push([node(i, j), node(i + 1, j), node(i + 1, j + 1)]);
            mesh.triangles.push([node(i, j), node(i + 1, j + 1), node(i, j + 1)]);
        }
    }
    let outer = vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    Design::new("rectangle", Outline { outer, holes: Vec::new() }, mesh)
}

/// A rectangle of 120 x 80 mm with a pin, two networks, a pose and three keyframes; figures with closed forms.
pub fn rigged() -> Design {
    let mut design = rectangle(120.0, 80.0, 6, 4);
    let tendon = |routing: &[usize]| Tendon {
        routing: MaterialPoint::through(routing.iter().copied()),
        ratio: 1.0,
        slack_mm: 0.0,
    };
    let at = design.mesh.node_point(0).expect("node 0 is used");
    design.pins = vec![Pin::at_rest(at, 20.0)];
    let target = Target { at: BodyPoint { triangle: 5, weights: [0.2, 0.3, 0.5] }, to: [130.0, 90.0], weight: 1.0 };
    design.poses = vec![Pose { name: "lean".into(), targets: vec![target] }];
    // Nodes 8..12 lie on the line y = 20, 20 mm apart; 24 is (60, 60).
    design.networks = vec![
        Network::new("left", vec![tendon(&[10, 9, 8]), tendon(&[10, 24])]),
        Network::new("right", vec![tendon(&[12, 11, 18])]),
    ];
    let key = |time_s, left, right, easing| Keyframe { time_s, activations_mm: vec![left, right], pose: None, easing };
    design.keyframes = vec![
        key(0.0, 0.0, 0.0, Easing::Linear),
        key(1.0, 10.0, 4.0, Easing::Smooth),
        key(1.51, 0.0, 0.0, Easing::Smooth),
    ];
    design
}
