//! Winches and their tendons.

use super::layer::{Layer, Shared, Stroke, Switch};
use super::marks::{self, cable, disc, place};
use super::subject::Subject;
use crate::design::{Network, Tendon};
use crate::engine::Shape;
use crate::picture::palette::{Palette, Theme, with_alpha};
use crate::picture::scene::Item;

/// How strong what is switched off is drawn, of 255.
const MUTED: u8 = 70;

/// The winch-tendon networks, each in a colour of its own; slack tendons are paler, networks that are switched off hardly there.
#[derive(Debug, PartialEq)]
pub struct Tendons {
    networks: Vec<Network>,
    shape: Shared<Shape>,
    theme: Theme,
}

const ICON: &[Stroke] = &[
    Stroke::Ring(0.26, 0.72, 0.18),
    Stroke::Line(&[(0.4, 0.6), (0.62, 0.5), (0.9, 0.12)]),
    Stroke::Line(&[(0.44, 0.72), (0.92, 0.76)]),
];

impl Layer for Tendons {
    const NAME: &'static str = "networks";
    const SWITCH: Option<Switch> = Some(Switch {
        label: "Show networks",
        tip: "Show winches and tendons",
        key: Some('N'),
        icon: ICON,
        at_first: true,
    });

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let networks = subject.design.networks.iter().chain(subject.proposed).cloned().collect();
        let drawn = subject.stage.is_none();
        drawn.then(|| Self { networks, shape: Shared::of(subject.shape), theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let (palette, shape) = (Palette::of(self.theme), &*self.shape);
        let acts = |(winch, _): &(usize, &Tendon)| !self.networks[*winch].muted;
        for (_, tendon) in self.tendons().filter(acts) {
            items.push(cable(&tendon.routing, shape, marks::CASING, palette.casing));
        }
        for (index, (winch, tendon)) in self.tendons().enumerate() {
            let slack = shape.tendon_tensions.get(index).is_some_and(|&t| t <= 0.0);
            let network = &self.networks[winch];
            let color = palette.network(winch, network);
            let color = if network.muted {
                with_alpha(color, MUTED)
            } else if slack {
                with_alpha(color, 170)
            } else {
                color
            };
            items.push(cable(&tendon.routing, shape, marks::TENDON, color));
            for via in tendon.routing.iter().skip(1).filter_map(|point| place(point, shape)) {
                items.push(disc(via, marks::VIA, color, None));
            }
        }
        for (winch, network) in self.networks.iter().enumerate() {
            if let Some(center) = network.winch().and_then(|point| place(point, shape)) {
                let fade = |color| if network.muted { with_alpha(color, MUTED) } else { color };
                let stroke = Some((2.0, fade(palette.winch_stroke)));
                items.push(disc(center, marks::WINCH, fade(palette.winch_fill), stroke));
                items.push(disc(center, 3.0, fade(palette.network(winch, network)), None));
            }
        }
    }
}

impl Tendons {
    /// All tendons with the number of their winch.
    fn tendons(&self) -> impl Iterator<Item = (usize, &Tendon)> {
        let numbered = self.networks.iter().enumerate();
        numbered.flat_map(|(winch, network)| network.tendons.iter().map(move |tendon| (winch, tendon)))
    }
}
