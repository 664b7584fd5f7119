//! The targets of a pose: points of the body, and where they shall go.

use super::layer::Layer;
use super::marks::{self, disc};
use super::subject::Subject;
use crate::outline::Point;
use crate::picture::palette::{Palette, Theme, with_alpha};
use crate::picture::scene::Item;

/// A line from every target point to its goal.
#[derive(Debug, PartialEq)]
pub struct Targets {
    marks: Vec<Mark>,
    theme: Theme,
}

#[derive(Debug, PartialEq)]
struct Mark {
    /// Place of the point of the body now, mm.
    at: Point,
    /// mm.
    goal: Point,
    selected: bool,
}

impl Layer for Targets {
    const NAME: &'static str = "targets";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let mesh = &subject.design.mesh;
        let numbered = subject.targets.iter().enumerate();
        let known = numbered.filter(|(_, target)| target.at.triangle < mesh.triangles.len());
        let marks = known.map(|(index, target)| Mark {
            at: mesh.position(&target.at, &subject.shape.nodes),
            goal: target.to,
            selected: subject.selected_target == Some(index),
        });
        Some(Self { marks: marks.collect(), theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let palette = Palette::of(self.theme);
        for &Mark { at, goal, selected } in &self.marks {
            let color = if selected { palette.target_selected } else { palette.target };
            items.push(Item::Line { points: vec![at, goal], width: 2.0, color: with_alpha(color, 200), closed: false });
            items.push(disc(goal, marks::GOAL, with_alpha(color, 45), Some((2.0, color))));
            items.push(disc(goal, 1.8, color, None));
            items.push(disc(at, marks::TARGET, palette.target_fill, Some((2.0, color))));
        }
    }
}
