//! The products: what a blueprint is made of. One file each, one line each in [`PRODUCTS`].

mod assembly;
mod controller;
mod lanes;
mod paper;
mod pattern;
mod readme;
mod routing;
mod skin;
mod stuffed;
mod threading;
mod tiles;
mod tracks;
mod winches;

use super::options::Topic;
use super::product::Make;

/// All parts in the order of their files, with what they are asked for by. Each sees what those before it have made; the page that explains
/// them is last, and always there.
pub const PRODUCTS: &[(Option<Topic>, Make)] = &[
    (Some(Topic::Laser), pattern::make),
    (Some(Topic::Laser), stuffed::make),
    (Some(Topic::Print), paper::make),
    (Some(Topic::Routing), routing::make),
    (Some(Topic::Winches), winches::make),
    (Some(Topic::Motors), tracks::make),
    (Some(Topic::Motors), controller::make),
    (Some(Topic::Guide), assembly::make),
    (None, readme::make),
];
