//! What the maker of a blueprint should know.

use crate::outline::Point;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Deref;

/// Words on a blueprint, and where on the body they are about. In files it is its words alone, and two are the same where those are.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub struct Remark {
    pub text: String,
    /// At rest, mm; none where it is about the whole.
    pub places: Vec<Point>,
    /// What is built may not work, or cannot be built: told before all others.
    pub grave: bool,
}

impl Remark {
    /// One about some places.
    pub fn at(places: impl IntoIterator<Item = Point>, text: impl Into<String>) -> Self {
        Self { text: text.into(), places: places.into_iter().collect(), grave: false }
    }

    /// One to be told before others.
    pub fn grave(self) -> Self {
        Self { grave: true, ..self }
    }
}

impl From<String> for Remark {
    fn from(text: String) -> Self {
        Self { text, places: Vec::new(), grave: false }
    }
}

impl From<&str> for Remark {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

impl From<Remark> for String {
    fn from(remark: Remark) -> Self {
        remark.text
    }
}

impl Deref for Remark {
    type Target = str;

    fn deref(&self) -> &str {
        &self.text
    }
}

impl PartialEq for Remark {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl PartialEq<&str> for Remark {
    fn eq(&self, text: &&str) -> bool {
        self.text == *text
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
