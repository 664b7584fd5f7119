//! The energies, their derivatives and the equilibria they lead to, through the public interface.

use crate::support::Random;
use crate::support::bodies::{Mesh, bar, dot, largest, largest_difference, moved, neo_hookean, plus};
use nalgebra::Matrix2;
use plushwright::physics::pattern::{Pattern, Scatter};
use plushwright::physics::{
    Body, Cause, Contractile, Element, Energy, Gravity, Ground, HessianForm, Hyperelastic, Kind, Law, MaterialKind,
    MaterialPoint, Model, NeoHookean, PinSpring, Pins, StVenantKirchhoff, StaticsSettings, TermKind, statics,
};

/// A smooth, uninverted deformation of unit-sized bodies: turned, stretched and bent.
fn deformed(x: &[f64]) -> Vec<f64> {
    let bent = x.chunks_exact(2).flat_map(|p| {
        let (a, b) = (p[0], p[1]);
        [1.15 * a + 0.12 * b + 0.05 * (2.3 * a + 0.4).sin(), 0.85 * b - 0.08 * a + 0.06 * (1.9 * a + 2.1 * b).cos()]
    });
    moved(&bent.collect::<Vec<_>>(), 0.4, [0.3, -0.2])
}

/// Makes a material anew: bodies own theirs.
type MakeMaterial = Box<dyn Fn() -> Box<dyn Hyperelastic>>;
type NamedTerm = (String, Box<dyn Energy>);

/// Every material of the catalogue, and one without resistance to change of area.
fn materials() -> Vec<(&'static str, MakeMaterial)> {
    let made = |kind: &'static MaterialKind| -> (&'static str, MakeMaterial) {
        (kind.label, Box::new(|| (kind.build)(kind.tested[0])))
    };
    let without: MakeMaterial = Box::new(|| Box::new(NeoHookean { mu: 0.7, kappa: 0.0 }));
    MaterialKind::all().iter().map(|kind| made(kind)).chain([("neo-Hookean without kappa", without)]).collect()
}

/// A grid of unit height and 1.5 length with irregular inner nodes.
fn mesh() -> Mesh {
    bar(1.5, 1.0, 6, 4).jittered(0.2, &mut Random(3))
}

fn through(nodes: &[usize]) -> Vec<MaterialPoint> {
    MaterialPoint::through(nodes.iter().copied())
}

/// An element on `routing` whose deformation `Gamma` at `x` is the given part of `epsilon`.
fn stretched(routing: &[MaterialPoint], epsilon: f64, part: f64, x: &[f64]) -> Element {
    let mut e = Element { routing: routing.to_vec(), stiffness: 2.5, epsilon, alpha0: 1.0 };
    e.alpha0 = e.length(x) - part * epsilon;
    e
}

/// Every kind of energy term, at the deformed state.
fn terms() -> Vec<NamedTerm> {
    let mesh = mesh();
    let x = deformed(&mesh.flat());
    let mut terms: Vec<NamedTerm> = Vec::new();
    let map: Vec<f64> = (0..mesh.triangles.len()).map(|k| 0.3 + 0.1 * k as f64).collect();
    for (name, material) in materials() {
        terms.push((format!("body, {name}"), Box::new(mesh.body(material(), None))));
        terms.push((format!("body with a stiffness map, {name}"), Box::new(mesh.body(material(), Some(&map)))));
    }
    let inside = |t: usize, a: f64, b: f64| MaterialPoint::of_triangle(mesh.triangles[t], [a, b, 1.0 - a - b]);
    let routings = [
        ("fibre", through(&[3, 4])),
        ("fibre, nodes descending", through(&[18, 10])),
        ("tendon with via points", through(&[0, 9, 17, 25, 34])),
        ("there and back (a-b-a)", through(&[5, 20, 5])),
        ("a loop that crosses a node twice", through(&[2, 10, 18, 10, 4])),
        ("tendon through triangles", vec![inside(3, 0.2, 0.5), inside(17, 0.6, 0.3), 25.into(), inside(40, 0.1, 0.8)]),
        ("between points of one triangle", vec![inside(20, 0.8, 0.1), inside(20, 0.1, 0.7)]),
        ("along an edge, from a node", vec![mesh.triangles[9][0].into(), inside(9, 0.4, 0.6), inside(30, 0.3, 0.3)]),
    ];
    for (name, routing) in routings {
        for (zone, part) in [("slack", -1.6), ("between", 0.3), ("just slack side", -0.7), ("taut", 2.0)] {
            let element = stretched(&routing, 0.05, part, &x);
            terms.push((format!("{name}, {zone}"), Box::new(Contractile::new(vec![element]))));
        }
        let mut cable = Contractile::new(vec![stretched(&routing, 0.05, 0.0, &x)]);
        cable.laws = vec![Law::Tension(0.8)];
        terms.push((format!("{name}, given tension"), Box::new(cable)));
    }
    terms.push(("pins on nodes".into(), Box::new(mesh.left_pins(40.0))));
    let barycentric = PinSpring {
        nodes: vec![9, 16, 10],
        weights: vec![0.5, 0.2, 0.3],
        anchor: [0.1, 0.9],
        stiffness: 12.0,
        slide: None,
    };
    let sliding = PinSpring { slide: Some([0.6, 0.8]), ..barycentric.clone() };
    terms.push(("pin on a triangle".into(), Box::new(Pins { pins: vec![barycentric] })));
    terms.push(("pin that slides".into(), Box::new(Pins { pins: vec![sliding] })));
    let areas = mesh.body(neo_hookean(), None).nodal_areas(mesh.nodes.len());
    let (nodes, triangles) = (&mesh.nodes, &mesh.triangles);
    let ground = Ground { nodes, triangles, nodal_areas: &areas };
    for kind in TermKind::all() {
        for values in kind.tested {
            terms.push((kind.label.to_lowercase(), (kind.build)(&ground, values)));
        }
    }
    terms
}

/// What a check of derivatives needs, of a single term or of a whole model.
struct Function<'a> {
    energy: &'a dyn Fn(&[f64]) -> f64,
    gradient: &'a dyn Fn(&[f64]) -> Vec<f64>,
    /// Hessian times vector.
    hessian: &'a Product<'a>,
}

type Product<'a> = dyn Fn(&[f64], &[f64]) -> Vec<f64> + 'a;

/// Differences below this part of the quantities at hand are rounding.
const NOISE: f64 = 2e-10;

/// Central differences err by `O(h^2)`: the error falls by four when the step halves.
fn check_decay(name: &str, error: impl Fn(f64) -> f64, scale: f64) -> bool {
    let errors: Vec<f64> = [4e-3, 2e-3, 1e-3].into_iter().map(error).collect();
    let mut seen = false;
    for pair in errors.windows(2) {
        let rounding = pair[1] <= NOISE * scale;
        assert!(rounding || pair[0] / pair[1] > 3.3, "{name}: errors {errors:?} at scale {scale:e}");
        seen |= !rounding;
    }
    assert!(errors[2] <= 1e-3 * scale, "{name}: errors {errors:?} at scale {scale:e}");
    seen
}

/// Whether the second-order decay could be seen above rounding, in the gradient and in the Hessian.
fn check_derivatives(name: &str, f: &Function, x: &[f64]) -> [bool; 2] {
    let mut random = Random(17);
    let mut seen = [false; 2];
    for _ in 0..3 {
        let d: Vec<f64> = x.iter().map(|_| random.between(-1.0, 1.0)).collect();
        let (g, hd) = ((f.gradient)(x), (f.hessian)(x, &d));
        let slope = dot(&g, &d);
        let scale = (f.energy)(x).abs() + largest(&g) + largest(&hd);
        seen[0] |= check_decay(
            &format!("{name}, gradient"),
            |h| (((f.energy)(&plus(x, h, &d)) - (f.energy)(&plus(x, -h, &d))) / (2.0 * h) - slope).abs(),
            scale,
        );
        seen[1] |= check_decay(
            &format!("{name}, Hessian"),
            |h| {
                let (up, down) = ((f.gradient)(&plus(x, h, &d)), (f.gradient)(&plus(x, -h, &d)));
                let quotient: Vec<f64> = up.iter().zip(&down).map(|(a, b)| (a - b) / (2.0 * h)).collect();
                largest_difference(&quotient, &hd)
            },
            scale,
        );
    }
    seen
}

fn term_gradient(term: &dyn Energy, x: &[f64]) -> Vec<f64> {
    let mut g = vec![0.0; x.len()];
    term.add_gradient(x, &mut g);
    g
}

fn term_hessian(term: &dyn Energy, x: &[f64], form: HessianForm, v: &[f64]) -> Vec<f64> {
    let stencils = || (0..term.stencils()).map(|k| term.stencil(k));
    let pattern = Pattern::new(x.len() / 2, stencils());
    let slots = pattern.slots(stencils());
    let mut values = vec![0.0; pattern.nonzeros()];
    term.add_hessian(x, form, &mut Scatter::new(&slots, &mut values));
    let mut y = vec![0.0; x.len()];
    pattern.multiply(&values, v, &mut y);
    y
}

#[test]
fn every_term_has_the_derivatives_it_claims() {
    let x = deformed(&mesh().flat());
    for (name, term) in terms() {
        let term = term.as_ref();
        let function = Function {
            energy: &|x| term.value(x),
            gradient: &|x| term_gradient(term, x),
            hessian: &|x, v| term_hessian(term, x, HessianForm::Exact, v),
        };
        let [in_gradient, in_hessian] = check_derivatives(&name, &function, &x);
        let curved = !name.contains("slack") && !name.contains("pin") && !name.contains("gravity");
        if curved {
            assert!(in_gradient && in_hessian, "{name}: no error was large enough to see it decay");
        }
    }
}

#[test]
fn a_projected_hessian_is_positive_and_equal_where_the_exact_one_is() {
    let rest = mesh().flat();
    let x = deformed(&rest);
    let mut random = Random(5);
    for (name, term) in terms() {
        for _ in 0..20 {
            let v: Vec<f64> = x.iter().map(|_| random.between(-1.0, 1.0)).collect();
            let projected = term_hessian(term.as_ref(), &x, HessianForm::Projected, &v);
            let exact = term_hessian(term.as_ref(), &x, HessianForm::Exact, &v);
            let size = largest(&exact);
            assert!(dot(&projected, &v) >= -1e-12 * size, "{name}");
            assert!(dot(&projected, &v) >= dot(&exact, &v) - 1e-9 * size, "{name}: projection only adds");
            if !name.contains("body") {
                assert_eq!(projected, exact, "{name}: is convex as it is");
            }
            let projected = term_hessian(term.as_ref(), &rest, HessianForm::Projected, &v);
            let exact = term_hessian(term.as_ref(), &rest, HessianForm::Exact, &v);
            assert!(largest_difference(&projected, &exact) <= 1e-10 * (1.0 + largest(&exact)), "{name}, at rest");
        }
    }
}

/// A plushie of everything at once.
fn whole(material: Box<dyn Hyperelastic>) -> Model {
    let mesh = mesh();
    let x = deformed(&mesh.flat());
    let parts = [-1.5, 0.2, 3.0];
    let mut elements: Vec<Element> =
        mesh.edges().iter().enumerate().map(|(k, e)| stretched(&through(e), 0.03, parts[k % 3], &x)).collect();
    elements.push(stretched(&through(&[0, 9, 17, 25, 34]), 0.04, 4.0, &x));
    elements.push(stretched(&through(&[5, 20, 5]), 0.04, 0.5, &x));
    let inside = MaterialPoint::of_triangle(mesh.triangles[21], [0.2, 0.5, 0.3]);
    elements.push(stretched(&[through(&[3, 12]), vec![inside]].concat(), 0.04, 2.0, &x));
    let mut pins = mesh.left_pins(30.0);
    pins.pins.push(PinSpring {
        nodes: vec![9, 16, 10],
        weights: vec![0.5, 0.2, 0.3],
        anchor: [0.1, 0.9],
        stiffness: 12.0,
        slide: None,
    });
    pins.pins.push(PinSpring { slide: Some([-0.6, 0.8]), ..PinSpring::node(5, [0.3, 0.2], 7.0) });
    let areas = mesh.body(neo_hookean(), None).nodal_areas(mesh.nodes.len());
    let gravity = Gravity::new(&areas, 0.6, [0.3, -9.8]);
    let mut model = mesh.model(material, elements, pins, vec![Box::new(gravity)]);
    model.contractile.laws[4] = Law::Tension(0.6);
    model
}

fn model_gradient(model: &Model, x: &[f64]) -> Vec<f64> {
    let mut g = vec![f64::NAN; x.len()];
    model.gradient(x, &mut g);
    g
}

fn model_hessian(model: &mut Model, x: &[f64], v: &[f64]) -> Vec<f64> {
    // Only the assembled values matter here: they are there whether the factorisation succeeds or not.
    let _ = model.factorize(x, HessianForm::Exact);
    let mut y = vec![0.0; x.len()];
    model.pattern().multiply(model.hessian_values(), v, &mut y);
    y
}

#[test]
fn a_whole_model_has_the_derivatives_it_claims() {
    for (name, material) in materials() {
        let model = whole(material());
        let other = std::cell::RefCell::new(whole(material()));
        let x = deformed(&model.rest);
        let function = Function {
            energy: &|x| model.energy(x),
            gradient: &|x| model_gradient(&model, x),
            hessian: &|x, v| model_hessian(&mut other.borrow_mut(), x, v),
        };
        assert_eq!(check_derivatives(name, &function, &x), [true, true], "{name}");
        // Assembling again at another state and back gives the same bits.
        let d: Vec<f64> = x.iter().map(|v| (9.0 * v).sin()).collect();
        let first = model_hessian(&mut other.borrow_mut(), &x, &d);
        let _ = model_hessian(&mut other.borrow_mut(), &model.rest, &d);
        assert_eq!(first, model_hessian(&mut other.borrow_mut(), &x, &d));
    }
}

#[test]
fn a_factor_solves_what_was_assembled() {
    let mut model = whole(neo_hookean());
    let rest = model.rest.clone();
    let settled = statics::solve(&mut model, &rest, &StaticsSettings::default(), &|| false).unwrap();
    model.factorize(&settled.x, HessianForm::Exact).unwrap();
    let b: Vec<f64> = (0..model.dimension()).map(|i| (0.37 * i as f64).sin()).collect();
    let mut z = b.clone();
    model.solve(&mut z);
    let mut y = vec![0.0; b.len()];
    model.pattern().multiply(model.hessian_values(), &z, &mut y);
    assert!(largest_difference(&y, &b) < 1e-10);
}

#[test]
fn rigid_motions_change_nothing() {
    for (name, material) in materials() {
        let held = whole(material());
        let mesh = mesh();
        let elements = held.contractile.elements.clone();
        let mut model = mesh.model(material(), elements, Pins::default(), Vec::new());
        model.contractile.laws = held.contractile.laws.clone();
        let x = deformed(&model.rest);
        let (energy, gradient) = (model.energy(&x), model_gradient(&model, &x));
        let v: Vec<f64> = x.iter().map(|a| (7.0 * a).cos()).collect();
        let hv = model_hessian(&mut model, &x, &v);
        for (angle, by) in [(0.0, [3.0, -7.0]), (1.1, [0.0, 0.0]), (-2.9, [0.4, 0.8]), (3.1, [-40.0, 11.0])] {
            let y = moved(&x, angle, by);
            assert!((model.energy(&y) - energy).abs() < 1e-11 * energy, "{name}");
            let turned = moved(&gradient, angle, [0.0; 2]);
            assert!(largest_difference(&model_gradient(&model, &y), &turned) < 1e-10 * largest(&gradient), "{name}");
            let turned = moved(&hv, angle, [0.0; 2]);
            let again = model_hessian(&mut model, &y, &moved(&v, angle, [0.0; 2]));
            assert!(largest_difference(&again, &turned) < 1e-9 * largest(&hv), "{name}");
        }
        // No net force, no net moment.
        let (mut force, mut moment) = ([0.0; 2], 0.0);
        for (g, p) in gradient.chunks_exact(2).zip(x.chunks_exact(2)) {
            force = [force[0] + g[0], force[1] + g[1]];
            moment += p[0] * g[1] - p[1] * g[0];
        }
        assert!(largest(&[force[0], force[1], moment]) < 1e-11 * largest(&gradient), "{name}");
    }
}

#[test]
fn gravity_moves_with_the_weight() {
    let mesh = mesh();
    let body = mesh.body(neo_hookean(), None);
    let gravity = Gravity::new(&body.nodal_areas(mesh.nodes.len()), 0.6, [0.0, -9.8]);
    let x = mesh.flat();
    let lifted = moved(&x, 0.0, [5.0, 2.0]);
    let raised = gravity.value(&lifted) - gravity.value(&x);
    assert!((raised - 0.6 * 1.5 * 9.8 * 2.0).abs() < 1e-11 && (raised - gravity.of_shift([5.0, 2.0])).abs() < 1e-11);
    let weight: f64 = term_gradient(&gravity, &x).iter().skip(1).step_by(2).sum();
    assert!((weight - 0.6 * 1.5 * 9.8).abs() < 1e-12);
}

#[test]
fn outside_its_domain_a_body_has_infinite_energy_and_no_term_gives_nan() {
    let mesh = mesh();
    let mut x = mesh.flat();
    x.swap(2 * mesh.at(2, 2), 2 * mesh.at(4, 2));
    for (name, material) in materials() {
        assert_eq!(mesh.body(material(), None).value(&x), f64::INFINITY, "{name}");
        let point = vec![0.0; x.len()];
        assert_eq!(mesh.body(material(), None).value(&point), f64::INFINITY, "{name}");
    }
    for (name, term) in terms() {
        let nan = vec![f64::NAN; x.len()];
        // Gravity alone has no domain to leave.
        assert!(!term.value(&nan).is_nan() || name == "gravity", "{name}");
    }
}

#[test]
fn a_step_limit_keeps_every_triangle_upright() {
    let mesh = mesh();
    let body = mesh.body(neo_hookean(), None);
    let x = deformed(&mesh.flat());
    let mut random = Random(23);
    for size in [0.01, 0.3, 5.0, 1e4] {
        for _ in 0..20 {
            let d: Vec<f64> = x.iter().map(|_| size * random.between(-1.0, 1.0)).collect();
            let t = body.step_limit(&x, &d);
            assert!(t > 0.0 && t <= 1.0);
            assert!(body.smallest_determinant(&plus(&x, t, &d)) > 0.0);
            if t < 1.0 {
                assert!(body.smallest_determinant(&plus(&x, (t / 0.9) * 1.0001, &d)) <= 1e-9);
            }
        }
    }
}

#[track_caller]
fn settle(model: &mut Model, start: &[f64]) -> statics::Equilibrium {
    match statics::solve(model, start, &StaticsSettings::default(), &|| false) {
        Ok(state) => state,
        Err(e) => panic!(
            "{e}: residual {:e} of {:e}, {} iterations, {} projections, least det F {:e}",
            e.best.residual,
            model.force_scale(&e.best.x),
            e.best.iterations,
            e.best.projections,
            model.body.smallest_determinant(&e.best.x)
        ),
    }
}

/// The boundary nodes of a grid.
fn boundary(mesh: &Mesh) -> Vec<usize> {
    let inner = |k: &usize| {
        let (i, j) = (k % (mesh.columns + 1), k / (mesh.columns + 1));
        i > 0 && j > 0 && i < mesh.columns && j < mesh.rows
    };
    (0..mesh.nodes.len()).filter(|k| !inner(k)).collect()
}

#[test]
fn patch_tests_are_exact_on_irregular_meshes() {
    let deformations = [
        Matrix2::new(1.4, 0.0, 0.0, 0.9),
        Matrix2::new(1.0, 0.35, 0.0, 1.0),
        Matrix2::new(0.75, -0.1, 0.2, 0.8),
        Matrix2::new(0.3, -1.1, 1.2, 0.2),
    ];
    for (name, material) in materials() {
        // St. Venant-Kirchhoff has no barrier: squeezed or turned far from rest, triangles may collapse on the way.
        let reachable = if name.starts_with("St") { 2 } else { 4 };
        for f in &deformations[..reachable] {
            let mesh = mesh();
            let expected: Vec<f64> =
                mesh.nodes.iter().flat_map(|p| [f * nalgebra::Vector2::from(*p)]).flat_map(|p| [p.x, p.y]).collect();
            let pull = term_gradient(&mesh.body(material(), None), &expected);
            // A pin gives way by force over stiffness: its anchor stands that much further out.
            let k = 50.0;
            let pins = boundary(&mesh).into_iter().map(|n| {
                let at = [0, 1].map(|a| expected[2 * n + a] + pull[2 * n + a] / k);
                PinSpring::node(n, at, k)
            });
            let mut model = mesh.model(material(), Vec::new(), Pins { pins: pins.collect() }, Vec::new());
            let rest = model.rest.clone();
            println!("{name}: {f}");
            let state = settle(&mut model, &rest);
            assert!(largest_difference(&state.x, &expected) < 1e-9, "{name}: {f}");
            for pin in &model.pins.pins {
                let force = pin.force(&state.x);
                for a in 0..2 {
                    assert!((force[a] - pull[2 * pin.nodes[0] + a]).abs() < 1e-8, "{name}");
                }
            }
            let psi = material().density(f) * 1.5;
            let stored = model.body.value(&state.x);
            assert!((stored - psi).abs() < 1e-9 * psi, "{name}: {stored} is not {psi}");
        }
    }
}

#[test]
fn an_inverted_start_ends_upright_and_at_the_same_place() {
    let mesh = bar(1.0, 0.3, 10, 3);
    let mut elements = mesh.fibers(2.0);
    for (k, e) in elements.iter_mut().enumerate() {
        e.alpha0 *= if k % 3 == 0 { 0.85 } else { 1.0 };
    }
    let mut model = mesh.model(neo_hookean(), elements, mesh.left_pins(200.0), Vec::new());
    let rest = model.rest.clone();
    let from_rest = settle(&mut model, &rest);
    let mirrored: Vec<f64> = rest.chunks_exact(2).flat_map(|p| [p[0], -p[1]]).collect();
    let mut random = Random(9);
    let scrambled: Vec<f64> = rest.iter().map(|_| random.between(-1.0, 1.0)).collect();
    let mut one_flipped = rest.clone();
    one_flipped[2 * mesh.at(5, 1) + 1] = 2.0;
    let broken = vec![f64::NAN; rest.len()];
    let endless = vec![f64::INFINITY; rest.len()];
    for start in [mirrored, scrambled, one_flipped, vec![0.0; rest.len()], broken, endless] {
        let state = settle(&mut model, &start);
        assert!(model.body.smallest_determinant(&state.x) > 0.0);
        assert!(largest_difference(&state.x, &from_rest.x) < 1e-9);
    }
}

#[test]
fn energies_never_rise_from_a_valid_start() {
    for (name, material) in materials() {
        let mut model = whole(material());
        let mut random = Random(31);
        let mut start = deformed(&model.rest);
        for v in &mut start {
            *v += 0.02 * random.between(-1.0, 1.0);
        }
        let mut last = model.energy(&start);
        assert!(last.is_finite());
        for max_iterations in 0..60 {
            let settings = StaticsSettings { max_iterations, ..StaticsSettings::default() };
            let state = match statics::solve(&mut model, &start, &settings, &|| false) {
                Ok(state) => state,
                Err(error) => {
                    // St. Venant-Kirchhoff may end at a collapsed triangle: it has no barrier.
                    assert!(error.cause == Cause::Iterations || name.starts_with("St"), "{name}: {error}");
                    error.best
                }
            };
            assert!(state.energy <= last + 1e-13 * last.abs().max(1.0), "{name}: {last} rose to {}", state.energy);
            assert!(model.body.smallest_determinant(&state.x) > 0.0, "{name}");
            last = state.energy;
        }
    }
}

/// A rectangle of cells of four triangles each, so that no direction is preferred.
fn crossed(length: f64, height: f64, columns: usize, rows: usize) -> Mesh {
    let mut mesh = bar(length, height, columns, rows);
    mesh.triangles.clear();
    for j in 0..rows {
        for i in 0..columns {
            let [a, b, c, d] = [mesh.at(i, j), mesh.at(i + 1, j), mesh.at(i + 1, j + 1), mesh.at(i, j + 1)];
            let m = mesh.nodes.len();
            mesh.nodes.push([0, 1].map(|k| 0.5 * (mesh.nodes[a][k] + mesh.nodes[c][k])));
            mesh.triangles.extend([[a, b, m], [b, c, m], [c, d, m], [d, a, m]]);
        }
    }
    mesh
}

/// A bar of length `L` hung by one end: its own weight stretches it by `rho g L^2 / (2 E)`, with the plane-stress-free 2-D
/// modulus `E = 4 mu (mu + kappa) / (2 mu + kappa)`.
#[test]
fn a_bar_hangs_under_its_own_weight_as_in_the_textbook() {
    let (mu, density, g): (f64, f64, f64) = (1000.0, 0.1, 9.81);
    for (kappa, tolerance) in [(0.0, 2e-3), (500.0, 1e-2), (2000.0, 2e-2)] {
        let modulus = 4.0 * mu * (mu + kappa) / (2.0 * mu + kappa);
        let materials: [Box<dyn Hyperelastic>; 2] =
            [Box::new(NeoHookean { mu, kappa }), Box::new(StVenantKirchhoff { mu, lambda: kappa })];
        for material in materials {
            let mesh = crossed(2.0, 0.1, 40, 2);
            let areas = mesh.body(neo_hookean(), None).nodal_areas(mesh.nodes.len());
            let gravity = Gravity::new(&areas, density, [g, 0.0]);
            let mut model = mesh.model(material, Vec::new(), mesh.left_pins(1e9), vec![Box::new(gravity)]);
            let rest = model.rest.clone();
            let state = settle(&mut model, &rest);
            for i in [20, 40] {
                let (s, k) = (2.0 * i as f64 / 40.0, 2 * mesh.at(i, 1));
                let expected = density * g / modulus * (2.0 * s - 0.5 * s * s);
                let found = state.x[k] - rest[k];
                assert!((found - expected).abs() < tolerance * expected, "kappa {kappa}: {found} is not {expected}");
            }
            let held: f64 = model.pins.pins.iter().map(|p| p.force(&state.x)[0]).sum();
            assert!((held + density * g * 0.2).abs() < 1e-9, "the pins carry the weight");
        }
    }
}

fn bent(mesh: &Mesh) -> Vec<Element> {
    // Short fibres along the upper side bend the bar.
    let mut elements = mesh.fibers(3.0);
    for e in &mut elements {
        if e.routing.iter().all(|n| n.last_node() >= mesh.at(0, mesh.rows)) {
            e.alpha0 *= 0.7;
        }
    }
    elements
}

#[test]
fn free_bodies_come_to_rest_up_to_their_rigid_motion() {
    let mesh = bar(1.0, 0.3, 10, 3);
    let rest = mesh.flat();
    let mut held = mesh.model(neo_hookean(), bent(&mesh), mesh.left_pins(100.0), Vec::new());
    assert_eq!(held.free_pieces(), 0);
    settle(&mut held, &rest);
    let lengths =
        |model: &Model, x: &[f64]| -> Vec<f64> { model.contractile.elements.iter().map(|e| e.length(x)).collect() };
    let mut free = mesh.model(neo_hookean(), bent(&mesh), Pins::default(), Vec::new());
    assert_eq!(free.free_pieces(), 1);
    let state = settle(&mut free, &rest);
    let reference = lengths(&free, &state.x);
    // Far away and turned: the same shape.
    let again = settle(&mut free, &moved(&rest, 2.0, [100.0, -30.0]));
    assert!(largest_difference(&lengths(&free, &again.x), &reference) < 1e-7);
    // One pin holds a point; the shape is the same, whatever the stiffness.
    for stiffness in [1e-3, 1.0, 1e10] {
        let pin = PinSpring::node(mesh.at(3, 1), [0.5, 0.5], stiffness);
        let mut one = mesh.model(neo_hookean(), bent(&mesh), Pins { pins: vec![pin] }, Vec::new());
        assert_eq!(one.free_pieces(), 1);
        let state = settle(&mut one, &rest);
        assert!(largest_difference(&lengths(&one, &state.x), &reference) < 1e-7);
        let k = 2 * mesh.at(3, 1);
        assert!((state.x[k] - 0.5).hypot(state.x[k + 1] - 0.5) < 1e-6);
    }
    // Two pins at the same rest point still leave a rotation free.
    let twice = PinSpring::node(mesh.at(3, 1), [0.5, 0.5], 10.0);
    let model = mesh.model(neo_hookean(), bent(&mesh), Pins { pins: vec![twice.clone(), twice] }, Vec::new());
    assert_eq!(model.free_pieces(), 1);
}

#[test]
fn one_pin_under_gravity_hangs_straight_down_and_none_is_an_error() {
    let mesh = bar(1.0, 0.3, 10, 3);
    let areas = mesh.body(neo_hookean(), None).nodal_areas(mesh.nodes.len());
    let gravity = || -> Vec<Box<dyn Energy>> { vec![Box::new(Gravity::new(&areas, 0.05, [0.0, -1.0]))] };
    let corner = mesh.at(0, 3);
    let pin = PinSpring::node(corner, mesh.nodes[corner], 50.0);
    let mut model = mesh.model(neo_hookean(), Vec::new(), Pins { pins: vec![pin] }, gravity());
    let rest = model.rest.clone();
    let state = settle(&mut model, &rest);
    let total: f64 = areas.iter().sum();
    let centre: f64 = areas.iter().enumerate().map(|(n, a)| a * state.x[2 * n]).sum::<f64>() / total;
    let hook = state.x[2 * corner];
    assert!((centre - hook).abs() < 1e-6, "centre at {centre}, hook at {hook}");
    let height: f64 = areas.iter().enumerate().map(|(n, a)| a * state.x[2 * n + 1]).sum::<f64>() / total;
    assert!(height < state.x[2 * corner + 1]);

    let mut model = mesh.model(neo_hookean(), Vec::new(), Pins::default(), gravity());
    let error = statics::solve(&mut model, &rest, &StaticsSettings::default(), &|| false).unwrap_err();
    assert_eq!(error.cause, Cause::FreeToMove);
    assert!(error.best.x.iter().all(|v| v.is_finite()));
    assert!(model.body.smallest_determinant(&error.best.x) > 0.0);
}

#[test]
fn pins_on_every_node_and_very_stiff_pins_hold() {
    let mesh = bar(1.0, 0.3, 10, 3);
    let rest = mesh.flat();
    for stiffness in [1.0, 1e4, 1e10] {
        let pins = (0..mesh.nodes.len()).map(|n| PinSpring::node(n, mesh.nodes[n], stiffness)).collect();
        let mut model = mesh.model(neo_hookean(), bent(&mesh), Pins { pins }, Vec::new());
        let state = settle(&mut model, &rest);
        let moved = largest_difference(&state.x, &rest);
        assert!(moved <= 2.0 / stiffness, "{moved} at {stiffness}");
    }
}

#[test]
fn loose_pieces_each_come_to_rest() {
    let mesh = bar(1.0, 0.3, 4, 2);
    let (mut nodes, mut triangles) = (mesh.nodes.clone(), mesh.triangles.clone());
    let n = nodes.len();
    nodes.extend(mesh.nodes.iter().map(|p| [p[0] + 3.0, p[1]]));
    triangles.extend(mesh.triangles.iter().map(|t| t.map(|k| k + n)));
    let body = Body::new(&nodes, &triangles, neo_hookean(), None).unwrap();
    let elements = vec![mesh.element(&[0, 4], 3.0, 0.01), {
        let mut e = mesh.element(&[0, 4], 3.0, 0.01);
        e.routing = MaterialPoint::through([n, n + 4]);
        e.alpha0 *= 0.8;
        e
    }];
    let mut model = Model::new(&nodes, body, Contractile::new(elements), mesh.left_pins(10.0), Vec::new()).unwrap();
    assert_eq!(model.free_pieces(), 1);
    let rest = model.rest.clone();
    let state = settle(&mut model, &rest);
    let e = &model.contractile.elements[1];
    assert!(e.length(&state.x) < 0.95 * e.length(&rest));
}

#[test]
fn statics_can_be_cancelled_and_keeps_its_state() {
    let mut model = whole(neo_hookean());
    let start = deformed(&model.rest);
    let asked = std::cell::Cell::new(0);
    let cancel = || {
        asked.set(asked.get() + 1);
        asked.get() > 2
    };
    let error = statics::solve(&mut model, &start, &StaticsSettings::default(), &cancel).unwrap_err();
    assert_eq!(error.cause, Cause::Cancelled);
    assert_eq!(error.best.iterations, 2);
    assert!(error.best.energy < model.energy(&start));
}

#[test]
fn the_same_question_gives_the_same_bits() {
    let solve = || {
        let mut model = whole(neo_hookean());
        let start = deformed(&model.rest);
        settle(&mut model, &start).x
    };
    assert_eq!(solve(), solve());
}

#[test]
fn extremes_converge() {
    let mesh = bar(1.0, 0.3, 10, 3);
    let rest = mesh.flat();
    for (k, epsilon) in [(1e-6, 1e-2), (1.0, 1e-8), (1e4, 1e-2), (1e8, 1e-4), (1e8, 1e-8)] {
        let mut elements = bent(&mesh);
        for e in &mut elements {
            e.stiffness = k;
            e.epsilon = epsilon * e.alpha0;
        }
        let mut model = mesh.model(neo_hookean(), elements, mesh.left_pins(1e3), Vec::new());
        println!("K {k}, epsilon {epsilon}");
        let state = settle(&mut model, &rest);
        assert!(model.body.smallest_determinant(&state.x) > 0.0, "K {k}, epsilon {epsilon}");
    }
    for kappa in [1e2, 1e4] {
        println!("kappa {kappa}");
        let material = Box::new(NeoHookean { mu: 1.0, kappa });
        let mut model = mesh.model(material, bent(&mesh), mesh.left_pins(1e3), Vec::new());
        settle(&mut model, &rest);
    }
    // All fibres at once to nothing.
    let mut elements = mesh.fibers(3.0);
    for e in &mut elements {
        e.alpha0 *= 1e-3;
    }
    let mut model = mesh.model(neo_hookean(), elements, mesh.left_pins(1e3), Vec::new());
    let state = settle(&mut model, &rest);
    assert!(model.body.smallest_determinant(&state.x) > 0.0);
}
