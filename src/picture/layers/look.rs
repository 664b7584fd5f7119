//! Looks: ways to show the body, and figures on it.

use super::layer::{Inputs, Layer};
use super::subject::Subject;
use crate::picture::ramp::Bar;

/// A way to show the body, in the place of some of the other layers. It is drawn first of all.
pub trait Look: Layer {
    /// Of its entry in lists: `Cable force`.
    const LABEL: &'static str;
    /// A sentence about it, without a full stop.
    const TIP: &'static str;
    /// Names of the layers that it takes the place of.
    const REPLACES: &'static [&'static str];

    /// What its colours stand for.
    fn bar(&self) -> Option<Bar> {
        None
    }
}

/// A line of the table of looks.
#[derive(Clone, Copy, Debug)]
pub struct LookEntry {
    pub name: &'static str,
    pub label: &'static str,
    pub tip: &'static str,
    pub replaces: &'static [&'static str],
    pub(super) take: fn(&Subject<'_>) -> Option<Taken>,
}

/// The inputs of a look, and what its colours stand for.
pub(super) type Taken = (Box<dyn Inputs>, Option<Bar>);

impl LookEntry {
    pub(super) const fn of<L: Look>() -> Self {
        let take = |subject: &Subject<'_>| {
            let look = L::of(subject)?;
            let bar = look.bar();
            Some((Box::new(look) as Box<dyn Inputs>, bar))
        };
        Self { name: L::NAME, label: L::LABEL, tip: L::TIP, replaces: L::REPLACES, take }
    }
}
