//! The table of methods.

use super::contraction::GaussNewton;
use super::default_method::Default;
use super::gradient::Gradient;
use super::method::Method;
use super::newton::Newton;
use super::tension::AllAtOnce;

/// The method of this name, or `None`.
pub fn method(name: &str) -> Option<Box<dyn Method>> {
    match name {
        "gradient" => Some(Box::new(Gradient::default())),
        "contraction" => Some(Box::new(GaussNewton::default())),
        "newton" => Some(Box::new(Newton::default())),
        "tension" => Some(Box::new(AllAtOnce::default())),
        "default" => Some(Box::new(Default)),
        _ => None,
    }
}

/// The names that [`method`] knows.
pub const METHODS: [&str; 5] = ["default", "gradient", "contraction", "newton", "tension"];
