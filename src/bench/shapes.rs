//! The bundled designs at any number of fibres, ready to be solved.

use super::BenchError;
use super::silhouettes;
use crate::defaults;
use crate::design::{Design, Target, bundled};
use crate::engine::compile::{Plushie, View, compile};
use crate::mesh::{self, BodyPoint, Mesh, MeshError};
use crate::outline::Point;
use crate::physics::{StaticsSettings, statics};
use crate::random::Random;

/// A mesh may have this part more or fewer fibres than asked for, where the outline does not permit the exact count.
const COUNT_TOLERANCE: f64 = 0.03;
/// Contraction fields are sums of this many smooth bumps.
const BUMPS: usize = 6;
/// Radii of the bumps as parts of the body length.
const BUMP_RADII: [f64; 2] = [0.2, 0.5];

/// A bundled shape with its own number of fibres.
pub struct Subject {
    /// Name of the bundled design, in lower case.
    pub name: String,
    pub design: Design,
    /// The idealized plushie: fibres alone, unless the design was asked for with its networks.
    pub plushie: Plushie,
}

/// The names by which the shapes are asked for.
pub fn names() -> Vec<String> {
    bundled::ALL.iter().map(|b| b.name.to_lowercase()).collect()
}

/// The bundled design as it is, networks and poses included; or the one that is made from the number in a name such as `hand-3`.
///
/// # Errors
/// A name that is no shape.
pub fn original(name: &str) -> Result<Design, BenchError> {
    if let Some((family, number)) = seeded(name) {
        return silhouettes::design(family, defaults::FIBERS, &mut Random::of(number, family, 0));
    }
    let found = bundled::ALL.iter().find(|b| b.name.to_lowercase() == name.to_lowercase());
    let found = found.ok_or_else(|| no_such(name))?;
    // A test reads every bundled design; what it cannot read is not there.
    found.design().map_err(|_| no_such(name))
}

/// The refusal of a name, with all that there are.
fn no_such(name: &str) -> BenchError {
    let made = silhouettes::FAMILIES.map(str::to_owned).to_vec();
    BenchError::NoSuchShape { name: name.to_owned(), known: names(), made }
}

/// Family and number of a shape that is made from the seed.
fn seeded(name: &str) -> Option<(&'static str, u64)> {
    let (family, number) = name.rsplit_once('-')?;
    let family = silhouettes::FAMILIES.into_iter().find(|f| *f == family.to_lowercase())?;
    Some((family, number.parse().ok()?))
}

/// The bundled design with about `fibers` fibres, its pins and the targets of its poses carried over by their rest positions.
/// Networks stay behind: their routings mean other nodes.
///
/// # Errors
/// A name that is no shape, or no mesh with so many fibres.
pub fn design(name: &str, fibers: usize) -> Result<Design, BenchError> {
    let old = original(name)?;
    let mesh = meshed(name, &old, fibers)?;
    let carried = |at: &BodyPoint| carry(&old.mesh, at, &mesh);
    let pins = old.pins.iter().filter_map(|pin| Some(crate::design::Pin { at: carried(&pin.at)?, ..*pin })).collect();
    let mut poses = old.poses.clone();
    for pose in &mut poses {
        pose.targets = pose.targets.iter().filter_map(|t| Some(Target { at: carried(&t.at)?, ..*t })).collect();
    }
    Ok(Design {
        mesh: mesh.into(),
        pins,
        poses,
        networks: Vec::new(),
        keyframes: Vec::new(),
        stiffness_map: None,
        ..old
    })
}

/// A mesh with the asked number of fibres, or with one within [`COUNT_TOLERANCE`] of it.
fn meshed(name: &str, old: &Design, fibers: usize) -> Result<Mesh, BenchError> {
    let fail = |source| BenchError::Mesh { shape: name.to_owned(), source };
    if old.mesh.edges().len() == fibers {
        return Ok(Mesh::clone(&old.mesh));
    }
    match mesh::generate(&old.outline, fibers) {
        Err(MeshError::Unreachable { nearest, .. })
            if nearest.abs_diff(fibers) as f64 <= COUNT_TOLERANCE * fibers as f64 =>
        {
            mesh::generate(&old.outline, nearest).map_err(fail)
        }
        other => other.map_err(fail),
    }
}

/// The point of `new` nearest to where `at` is in the rest state of `old`.
pub fn carry(old: &Mesh, at: &BodyPoint, new: &Mesh) -> Option<BodyPoint> {
    let place = old.position(at, &old.nodes);
    new.locate_nearest(place, &new.nodes).map(|(at, _)| at)
}

impl Subject {
    /// Compiles a design, as the idealized plushie.
    ///
    /// # Errors
    /// A design that does not compile.
    pub fn of(name: &str, design: Design) -> Result<Self, BenchError> {
        let fail = |source| BenchError::Model { shape: name.to_owned(), source };
        let plushie = compile(&design, View::Idealized).map_err(fail)?;
        Ok(Self { name: name.to_lowercase(), design, plushie })
    }

    /// A bundled shape at a number of fibres.
    ///
    /// # Errors
    /// A name that is no shape, no mesh with so many fibres, or a design that does not compile.
    pub fn new(name: &str, fibers: usize) -> Result<Self, BenchError> {
        Self::of(name, design(name, fibers)?)
    }

    pub fn fibers(&self) -> usize {
        self.plushie.fibers.len()
    }

    /// mm.
    pub fn length(&self) -> f64 {
        self.design.body_length_mm()
    }

    /// A smooth random contraction of every element, mm: `strength` of what is allowed where the field is largest.
    pub fn contractions(&self, field: &Field, strength: f64) -> Vec<f64> {
        let mut out = vec![0.0; self.plushie.fiber_elements.end];
        for fiber in &self.plushie.fibers {
            for &(element, ratio) in &fiber.members {
                let routing = &self.plushie.model.contractile.elements[element].routing;
                let rest = &self.plushie.model.rest;
                let (a, b) = (routing[0].at(rest), routing[routing.len() - 1].at(rest));
                let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
                out[element] = ratio * fiber.upper * strength * field.at(middle);
            }
        }
        out
    }

    /// The equilibrium at these contractions, statics started from `from`; it leaves the model's laws so.
    ///
    /// # Errors
    /// No equilibrium.
    pub fn settle(
        &mut self,
        contractions: &[f64],
        from: &[f64],
        stop: &dyn Fn() -> bool,
    ) -> Result<Vec<f64>, BenchError> {
        let model = &mut self.plushie.model;
        model.contractile.set_contractions(contractions);
        match statics::solve(model, from, &StaticsSettings::default(), stop) {
            Ok(state) => Ok(state.x),
            Err(error) if error.cause == crate::physics::Cause::Cancelled => Err(BenchError::Cancelled),
            Err(error) => {
                Err(BenchError::Statics { shape: self.name.clone(), fibers: self.fibers(), source: error.cause })
            }
        }
    }
}

/// A smooth random scalar over the rest shape, between 0 and 1: bumps `(1 - r^2/R^2)^2`, clipped. It depends on the place in the
/// rest shape alone, so that meshes of any resolution see the same field.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    bumps: Vec<(Point, f64, f64)>,
}

impl Field {
    /// Bumps spread over the body of `design`.
    pub fn random(random: &mut Random, outline_nodes: &[Point], length: f64) -> Self {
        let bump = |random: &mut Random| {
            let centre = outline_nodes[random.index(outline_nodes.len())];
            (centre, length * random.between(BUMP_RADII[0], BUMP_RADII[1]), random.between(0.4, 1.0))
        };
        Self { bumps: (0..BUMPS).map(|_| bump(random)).collect() }
    }

    pub fn at(&self, p: Point) -> f64 {
        let sum: f64 = self
            .bumps
            .iter()
            .map(|(centre, radius, height)| {
                let (dx, dy) = ((p[0] - centre[0]) / radius, (p[1] - centre[1]) / radius);
                height * (1.0 - dx * dx - dy * dy).max(0.0).powi(2)
            })
            .sum();
        sum.min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_kept_and_pins_stay_where_they_are() {
        for name in names() {
            let old = original(&name).unwrap();
            for fibers in [414, 1055] {
                let subject = Subject::new(&name, fibers).unwrap();
                let off = subject.fibers().abs_diff(fibers) as f64;
                assert!(off <= COUNT_TOLERANCE * fibers as f64, "{name}: {} for {fibers}", subject.fibers());
                assert_eq!(subject.design.pins.len(), old.pins.len());
                for (a, b) in old.pins.iter().zip(&subject.design.pins) {
                    let (p, q) = (
                        old.mesh.position(&a.at, &old.mesh.nodes),
                        subject.design.mesh.position(&b.at, &subject.design.mesh.nodes),
                    );
                    let apart = (p[0] - q[0]).hypot(p[1] - q[1]);
                    assert!(apart < 0.02 * old.body_length_mm(), "{name}: a pin moved by {apart} mm");
                }
                assert!(subject.design.validate().is_ok(), "{name}");
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_field_and_contractions_are_allowed() {
        let subject = Subject::new("pig", 414).unwrap();
        let field =
            |seed| Field::random(&mut Random::of(seed, "test", 0), &subject.design.mesh.nodes, subject.length());
        assert_eq!(field(1), field(1));
        assert_ne!(field(1), field(2));
        let contractions = subject.contractions(&field(1), 1.0);
        let most = contractions.iter().fold(0.0_f64, |m, c| m.max(*c));
        assert!(most > 0.0);
        for (fiber, c) in subject.plushie.fibers.iter().zip(&contractions[subject.plushie.fiber_elements.clone()]) {
            assert!(*c >= 0.0 && *c <= fiber.upper);
        }
    }

    #[test]
    fn shapes_are_made_from_numbers() {
        let [a, b, c] = ["hand-1", "Hand-1", "hand-2"].map(|name| original(name).unwrap().outline);
        assert!(a == b && a != c);
        assert!(original("hand-x").is_err() && original("cow-1").is_err());
        let subject = Subject::new("limb-1", 1055).unwrap();
        assert!(subject.fibers().abs_diff(1055) <= 60 && subject.design.pins.len() == 3);
    }

    #[test]
    fn an_unknown_shape_names_the_known_ones() {
        let line = original("cow").unwrap_err().to_string();
        assert!(line.contains("cow") && line.contains("pig") && line.contains("squid"), "{line}");
    }
}
