//! A plain drawing of a plushie.

use crate::design::{Design, Target};
use crate::engine::Shape;
use crate::picture::{Color, Item, Scene};

pub fn scene(design: &Design, shape: &Shape, targets: &[Target]) -> Scene {
    let mut items = vec![Item::Mesh {
        points: shape.nodes.clone(),
        triangles: design.mesh.triangles.clone(),
        color: Color(222, 200, 178, 255),
    }];
    for [i, j] in design.mesh.edges() {
        let points = vec![shape.nodes[i], shape.nodes[j]];
        items.push(Item::Line { points, width: 1.0, color: Color(150, 130, 110, 160), closed: false });
    }
    for network in &design.networks {
        for tendon in &network.tendons {
            let points = tendon.routing.iter().map(|&n| shape.nodes[n]).collect();
            items.push(Item::Line { points, width: 3.0, color: Color(40, 80, 160, 255), closed: false });
        }
        if let Some(node) = network.winch_node() {
            let fill = Color(250, 205, 40, 255);
            let stroke = Some((1.5, Color(90, 70, 0, 255)));
            items.push(Item::Disc { center: shape.nodes[node], radius: 8.0, fill, stroke });
        }
    }
    for pin in &design.pins {
        let center = design.mesh.position(&pin.at, &shape.nodes);
        items.push(Item::Disc { center, radius: 5.0, fill: Color(60, 60, 60, 255), stroke: None });
    }
    for target in targets {
        let from = design.mesh.position(&target.at, &shape.nodes);
        let color = Color(200, 40, 40, 255);
        items.push(Item::Line { points: vec![from, target.to], width: 1.5, color, closed: false });
        items.push(Item::Disc { center: target.to, radius: 5.0, fill: Color(0, 0, 0, 0), stroke: Some((2.0, color)) });
        items.push(Item::Disc { center: from, radius: 3.0, fill: color, stroke: None });
    }
    Scene { items }
}
