use plushwright::design::*;
use plushwright::engine::*;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let name = &args[1];
    let fibers: usize = args[2].parse().unwrap();
    let svg = std::fs::read(format!("assets/{name}.svg")).unwrap();
    let outline = plushwright::outline::svg::read(&svg, None).unwrap();
    let t = std::time::Instant::now();
    let mesh = plushwright::mesh::generate(&outline, fibers).unwrap();
    println!("mesh {:?} edges {} nodes {} L {}", t.elapsed(), mesh.edges().len(), mesh.nodes.len(), mesh.body_length());
    let mut design = Design {
        version: 1,
        name: name.clone(),
        outline,
        mesh,
        material: Default::default(),
        fibers: Default::default(),
        tendons: Default::default(),
        pins: vec![],
        poses: vec![],
        networks: vec![],
        keyframes: vec![],
        fabrication: Default::default(),
        controller: Default::default(),
        texture: None,
        gravity: None,
        stiffness_map: None,
    };
    let mut targets = vec![];
    for a in &args[3..] {
        let v: Vec<f64> = a.trim_start_matches('p').split([',', '=']).map(|s| s.parse().unwrap()).collect();
        let at = design
            .mesh
            .locate([v[0], v[1]], &design.mesh.nodes)
            .or_else(|| design.mesh.node_point(design.mesh.nearest_node([v[0], v[1]], &design.mesh.nodes)))
            .unwrap();
        if a.starts_with('p') {
            design.pins.push(Pin { at, position: None, stiffness: plushwright::defaults::PIN_STIFFNESS });
        } else {
            targets.push(Target { at, to: [v[2], v[3]], weight: 1.0 });
        }
    }
    let rest = solver_error(&design, &targets);
    println!("rest error {rest:.4}");
    let cancel = AtomicBool::new(false);
    let request = Request {
        id: 0,
        design: Arc::new(design),
        question: Question::Targets(targets),
        show_idealized: true,
        show_realizable: false,
    };
    for effort in [Effort::Interactive, Effort::Thorough] {
        let mut s = Solver::default();
        for _ in 0..3 {
            let o = s.solve_with(&request, effort, &cancel).idealized.unwrap();
            println!(
                "{effort:?}: error {:.5} residual {:.1e} it {} ms {:.2} {:?}",
                o.target_error, o.residual, o.iterations, o.milliseconds, o.warning
            );
        }
    }
}
fn solver_error(d: &Design, t: &[Target]) -> f64 {
    plushwright::engine::solver::target_error(d, t, &d.mesh.nodes)
}
