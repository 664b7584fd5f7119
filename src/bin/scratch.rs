use plushwright::engine::*;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let design = plushwright::design::file::read(std::path::Path::new(&args[1])).unwrap();
    let targets = design.poses.iter().find(|p| p.name == args[2]).unwrap().targets.clone();
    let cancel = AtomicBool::new(false);
    let request = Request {
        id: 0,
        design: Arc::new(design),
        question: Question::Targets(targets),
        show_idealized: true,
        show_realizable: true,
    };
    let mut s = Solver::default();
    for _ in 0..2 {
        let o = s.solve_with(&request, Effort::Thorough, &cancel);
        let (i, r) = (o.idealized.unwrap(), o.realizable.unwrap());
        println!(
            "real {:.4} {:?} {:.1} | ideal {:.5} it {} residual {:.1e} ms {:.1} {:?}",
            r.target_error,
            r.activations_mm,
            r.milliseconds,
            i.target_error,
            i.iterations,
            i.residual,
            i.milliseconds,
            i.warning
        );
    }
}
