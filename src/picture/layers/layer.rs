//! Layers: inputs taken from the subject of a picture, and how they are drawn.

use super::subject::{Shown, Subject};
use crate::picture::scene::Item;
use std::any::Any;
use std::fmt::Debug;
use std::ops::Deref;
use std::sync::Arc;

/// The inputs of one layer of a picture. Equal inputs draw the same items, so that what was drawn is kept until they differ:
/// they are compared whole, by the derived `PartialEq`. What is large is [`Shared`].
pub trait Layer: Debug + PartialEq + Sized + 'static {
    /// By which settings and code know the layer; unique.
    const NAME: &'static str;
    /// How the user shows and hides it; `None` if it is always shown.
    const SWITCH: Option<Switch> = None;

    /// Takes the inputs from the subject. `None` if there is nothing to draw.
    fn of(subject: &Subject<'_>) -> Option<Self>;

    /// Adds the items of the layer in painting order.
    fn draw(&self, items: &mut Vec<Item>);
}

/// How the user shows and hides a layer: a button, a key, and whether it is shown at first.
#[derive(Clone, Copy, Debug)]
pub struct Switch {
    /// Of the button, in the imperative: `Show fibres`.
    pub label: &'static str,
    /// A sentence for the pointer, without the key.
    pub tip: &'static str,
    /// A capital letter that no other command has.
    pub key: Option<char>,
    /// Strokes of the button.
    pub icon: &'static [Stroke],
    /// Whether the layer is shown before the user has said anything.
    pub at_first: bool,
}

/// A stroke of an icon, in a unit square with its origin in the upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stroke {
    Line(&'static [(f32, f32)]),
    /// Filled: middle and radius.
    Dot(f32, f32, f32),
    /// A circle: middle and radius.
    Ring(f32, f32, f32),
}

/// A large input behind an address. Two are equal if they have the same address, which both keep alive.
#[derive(Clone, Debug)]
pub struct Shared<T>(Arc<T>);

impl<T> Shared<T> {
    pub fn of(value: &Arc<T>) -> Self {
        Self(value.clone())
    }
}

impl<T> PartialEq for Shared<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<T> Deref for Shared<T> {
    type Target = Arc<T>;

    fn deref(&self) -> &Arc<T> {
        &self.0
    }
}

/// A line of the table of layers.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub name: &'static str,
    pub switch: Option<Switch>,
    pub(super) take: fn(&Subject<'_>) -> Option<Box<dyn Inputs>>,
}

impl Entry {
    pub(super) const fn of<L: Layer>() -> Self {
        Self { name: L::NAME, switch: L::SWITCH, take: |subject| Some(Box::new(L::of(subject)?)) }
    }

    /// Whether the layer is shown.
    pub fn is_shown(&self, shown: &Shown) -> bool {
        shown.asked(self.name).unwrap_or(self.switch.is_none_or(|switch| switch.at_first))
    }
}

/// A [`Layer`] of any kind.
pub(super) trait Inputs: Debug {
    fn draw(&self, items: &mut Vec<Item>);
    fn same(&self, other: &dyn Inputs) -> bool;
    fn any(&self) -> &dyn Any;
}

impl<L: Layer> Inputs for L {
    fn draw(&self, items: &mut Vec<Item>) {
        Layer::draw(self, items);
    }

    fn same(&self, other: &dyn Inputs) -> bool {
        other.any().downcast_ref::<L>() == Some(self)
    }

    fn any(&self) -> &dyn Any {
        self
    }
}
