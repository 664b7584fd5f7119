//! Cable force: what each tendon pulls with.

use crate::design::Network;
use crate::engine::Shape;
use crate::picture::layers::fibers::Fibers;
use crate::picture::layers::layer::{Layer, Shared};
use crate::picture::layers::look::Look;
use crate::picture::layers::marks::{self, body, cable, disc, place};
use crate::picture::layers::subject::Subject;
use crate::picture::layers::tendons::Tendons;
use crate::picture::layers::texture::Textured;
use crate::picture::palette::Palette;
use crate::picture::ramp::{Bar, ground};
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;

/// Tendons in the colours of their tension, the hardest on top.
#[derive(Debug, PartialEq)]
pub struct Force {
    networks: Vec<Network>,
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    bar: Bar,
}

/// End of the bar where nothing pulls, N.
const LEAST: f64 = 0.1;
/// Width of a cable, and of the rim that lifts it off the body, logical pixels.
const CABLE: f32 = 5.0;
const CASING: f32 = 7.5;

impl Layer for Force {
    const NAME: &'static str = "force";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let both = [Some(subject.shape), subject.beside];
        let all: Vec<f64> =
            both.into_iter().flatten().flat_map(|shape| shape.tendon_tensions.iter().copied()).collect();
        Some(Self {
            networks: subject.design.networks.iter().chain(subject.proposed).cloned().collect(),
            silhouette: Shared::of(&subject.silhouette),
            shape: Shared::of(subject.shape),
            bar: Bar::rising("Cable force", "N", &all, LEAST, subject.theme),
        })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let (palette, shape) = (Palette::of(self.bar.theme), &*self.shape);
        items.extend(body(&self.silhouette, shape, ground(self.bar.theme)));
        let tendons = self.networks.iter().flat_map(|network| network.tendons.iter().map(move |t| (network, t)));
        let tension = |index: usize| shape.tendon_tensions.get(index).copied().unwrap_or(0.0);
        let mut acting: Vec<_> = tendons.enumerate().filter(|(_, (network, _))| !network.muted).collect();
        acting.sort_by(|a, b| tension(a.0).total_cmp(&tension(b.0)));
        for &(index, (_, tendon)) in &acting {
            items.push(cable(&tendon.routing, shape, CASING, palette.pin));
            items.push(cable(&tendon.routing, shape, CABLE, self.bar.color(tension(index))));
        }
        for network in self.networks.iter().filter(|network| !network.muted) {
            if let Some(center) = network.winch().and_then(|point| place(point, shape)) {
                items.push(disc(center, marks::WINCH, palette.winch_fill, Some((2.0, palette.winch_stroke))));
            }
        }
    }
}

impl Look for Force {
    const LABEL: &'static str = "Cable force";
    const TIP: &'static str = "What each tendon pulls with";
    const REPLACES: &'static [&'static str] = &[Textured::NAME, Fibers::NAME, Tendons::NAME];

    fn bar(&self) -> Option<Bar> {
        Some(self.bar.clone())
    }
}
