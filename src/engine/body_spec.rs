//! What a compiled model depends on.

use crate::design::{CopyOnWrite, Design, FiberSettings, Material, Network, Pin, TendonSettings, Term};
use crate::mesh::Mesh;

/// The parts of a design that a model is compiled from, and nothing else: two designs with equal specs have the same model.
#[derive(Clone, Debug)]
pub struct BodySpec<'a> {
    pub mesh: &'a CopyOnWrite<Mesh>,
    pub material: Material,
    pub stiffness_map: Option<&'a [f64]>,
    pub fibers: &'a FiberSettings,
    pub tendons: &'a TendonSettings,
    pub pins: &'a [Pin],
    pub networks: &'a [Network],
    pub terms: Vec<Term>,
}

impl<'a> BodySpec<'a> {
    pub fn of(design: &'a Design) -> Self {
        // Taken apart in full: a field added to the document has to be sorted here.
        let Design {
            mesh,
            material,
            stiffness_map,
            fibers,
            tendons,
            pins,
            networks,
            gravity: _,
            terms: _,
            version: _,
            name: _,
            outline: _,
            poses: _,
            keyframes: _,
            fabrication: _,
            controller: _,
            sewing: _,
            drawing: _,
            texture: _,
            texture_box: _,
        } = design;
        Self {
            mesh,
            material: *material,
            stiffness_map: stiffness_map.as_deref(),
            fibers,
            tendons,
            pins,
            networks,
            terms: design.all_terms(),
        }
    }
}

impl PartialEq for BodySpec<'_> {
    fn eq(&self, other: &Self) -> bool {
        // Taken apart in full, as above.
        let Self { mesh, material, stiffness_map, fibers, tendons, pins, networks, terms } = self;
        *mesh == other.mesh
            && *material == other.material
            && *stiffness_map == other.stiffness_map
            && *fibers == other.fibers
            && *tendons == other.tendons
            && *pins == other.pins
            && pull_alike(networks, other.networks)
            && *terms == other.terms
    }
}

/// Whether networks are equal in all but their names and colours.
fn pull_alike(a: &[Network], b: &[Network]) -> bool {
    let alike = |(a, b): (&Network, &Network)| {
        let Network { name: _, color: _, tendons, muted } = a;
        *tendons == b.tendons && *muted == b.muted
    };
    a.len() == b.len() && a.iter().zip(b).all(alike)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Gravity, testing};

    #[test]
    fn what_the_physics_reads_makes_another_body_and_nothing_else_does() {
        let design = testing::sample();
        let same: [fn(&mut Design); 7] = [
            |d| d.name.push('x'),
            |d| d.networks[0].name.push('x'),
            |d| d.networks[0].color = Some([1, 2, 3]),
            |d| d.poses.clear(),
            |d| d.keyframes.clear(),
            |d| d.fabrication.seam_allowance_mm += 1.0,
            |d| d.sewing.hole_to_seam_mm += 1.0,
        ];
        let other: [fn(&mut Design); 10] = [
            |d| d.mesh.nodes[0][0] += 1e-9,
            |d| d.material.set("mu", 0.5),
            |d| d.stiffness_map = Some(vec![1.0; d.mesh.triangles.len()]),
            |d| d.fibers.stiffness *= 2.0,
            |d| d.tendons.stiffness *= 2.0,
            |d| d.pins.clear(),
            |d| d.networks.clear(),
            |d| d.networks[0].muted = true,
            |d| d.networks[0].tendons[0].ratio = 2.0,
            |d| d.gravity = Some(Gravity { acceleration: [0.0, -9.81], surface_density: 1e-6 }),
        ];
        let changed = |change: fn(&mut Design)| {
            let mut design = design.clone();
            change(&mut design);
            design
        };
        for change in same {
            assert_eq!(BodySpec::of(&changed(change)), BodySpec::of(&design));
        }
        for change in other {
            assert_ne!(BodySpec::of(&changed(change)), BodySpec::of(&design));
        }
    }
}
