//! The products: what a blueprint is made of. One file each, one line each in [`PRODUCTS`].

mod controller;
mod pattern;
mod readme;
mod routing;
pub(super) mod seam;
mod tracks;

use super::product::Make;

/// All parts in the order of their files. Each sees what those before it have made; the page that explains them is last.
pub const PRODUCTS: &[Make] = &[pattern::make, routing::make, tracks::make, controller::make, readme::make];
