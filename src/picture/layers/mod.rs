//! The layers of a picture, from the body upward: one file each, one line each in [`LAYERS`].
//!
//! A layer takes its own inputs from the [`Subject`] and draws from these alone. [`Layers`] are the inputs of a whole picture:
//! whoever keeps what was drawn compares them, and draws anew where they differ.

mod fibers;
mod ghosts;
mod layer;
mod look;
pub mod looks;
mod marks;
mod pins;
mod seam;
mod stages;
mod subject;
mod targets;
mod tendons;
mod texture;

pub use fibers::Fibers;
pub use ghosts::Ghosts;
pub use layer::{Entry, Layer, Shared, Stroke, Switch};
pub use look::LookEntry;
pub use looks::{LOOKS, look};
pub use pins::Pins;
pub use seam::Seam;
pub use stages::Discovery;
pub use subject::{Ghost, Shown, Stage, Subject};
pub use targets::Targets;
pub use tendons::Tendons;
pub use texture::Textured;

use super::ramp::Bar;
use super::scene::Scene;
use layer::Inputs;

/// All layers over the body in painting order; the body itself is drawn by a [look](LOOKS).
pub const LAYERS: &[Entry] = &[
    Entry::of::<Textured>(),
    Entry::of::<Seam>(),
    Entry::of::<Ghosts>(),
    Entry::of::<Fibers>(),
    Entry::of::<Discovery>(),
    Entry::of::<Tendons>(),
    Entry::of::<Pins>(),
    Entry::of::<Targets>(),
];

impl Shown {
    /// Whether a layer is shown; `false` for a name that no layer has.
    pub fn shows(&self, name: &str) -> bool {
        LAYERS.iter().any(|entry| entry.name == name && entry.is_shown(self))
    }
}

/// The inputs of all layers of a picture. Equal ones make the same picture.
#[derive(Debug, Default)]
pub struct Layers(Vec<Box<dyn Inputs>>, Option<Bar>);

impl Layers {
    /// Takes the inputs of every layer that is shown. A shape of another mesh has none.
    pub fn of(subject: &Subject<'_>) -> Self {
        if subject.shape.nodes.len() != subject.design.mesh.nodes.len() {
            return Self::default();
        }
        let look = look(subject.look).unwrap_or(&LOOKS[0]);
        let (body, bar) = (look.take)(subject).unzip();
        let shown = |entry: &&Entry| entry.is_shown(subject.shown) && !look.replaces.contains(&entry.name);
        let over = LAYERS.iter().filter(shown).filter_map(|entry| (entry.take)(subject));
        Self(body.into_iter().chain(over).collect(), bar.flatten())
    }

    /// What the colours of the look stand for.
    pub fn bar(&self) -> Option<&Bar> {
        self.1.as_ref()
    }

    /// Draws them.
    pub fn scene(&self) -> Scene {
        let mut scene = Scene::default();
        self.0.iter().for_each(|layer| layer.draw(&mut scene.items));
        scene
    }

    /// How many layers there are, from the body upward.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Draws one of them.
    pub fn scene_of(&self, layer: usize) -> Scene {
        let mut scene = Scene::default();
        self.0.iter().skip(layer).take(1).for_each(|layer| layer.draw(&mut scene.items));
        scene
    }

    /// The layer of another picture that has the same inputs as one of this, if there is one.
    pub fn same_in(&self, layer: usize, other: &Self) -> Option<usize> {
        let inputs = self.0.get(layer)?;
        other.0.iter().position(|other| inputs.same(&**other))
    }
}

impl PartialEq for Layers {
    fn eq(&self, other: &Self) -> bool {
        self.0.len() == other.0.len() && self.0.iter().zip(&other.0).all(|(a, b)| a.same(&**b))
    }
}

#[cfg(test)]
mod tests;
