//! How things are shown.

use crate::picture::layers::Shown;
use crate::picture::palette::Theme;
use crate::studio::canvas::{Camera, Plushie};

pub struct Look {
    pub theme: Theme,
    /// Nothing moves by itself but what is asked to play.
    pub still: bool,
    /// Which layers of the pictures.
    pub shown: Shown,
    pub views: Views,
    /// `None`: fits the body.
    pub camera: Option<Camera>,
    /// Times which the scale shall change about the middle, as soon as a view knows what it shows.
    pub zoom: Option<f32>,
}

/// Which views are shown: one at least. What is hidden is not solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    Both,
    Only(Plushie),
}

impl Views {
    pub fn shows(self, plushie: Plushie) -> bool {
        match self {
            Self::Both => true,
            Self::Only(shown) => shown == plushie,
        }
    }

    pub fn toggled(self, plushie: Plushie) -> Self {
        self.with(plushie, !self.shows(plushie))
    }

    /// With one of them shown or hidden. Where that leaves none, the other one comes back.
    pub fn with(self, plushie: Plushie, shown: bool) -> Self {
        let other = plushie.other();
        match (shown, self.shows(other)) {
            (true, true) => Self::Both,
            (true, false) => Self::Only(plushie),
            (false, _) => Self::Only(other),
        }
    }
}

impl Look {
    /// Changes the scale about the middle.
    pub(crate) fn zoom(&mut self, factor: f32) {
        self.zoom = Some(self.zoom.unwrap_or(1.0) * factor);
    }
}

impl Default for Look {
    fn default() -> Self {
        Self {
            theme: Theme::Light,
            still: false,
            shown: Shown::default(),
            views: Views::Both,
            camera: None,
            zoom: None,
        }
    }
}
