//! The colours of pictures, in a light and a dark theme.

use super::color::Color;
use crate::design::Network;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    #[default]
    Light,
    Dark,
}

/// Colours by what they stand for.
#[derive(Clone, Copy, Debug)]
pub struct Palette {
    /// Behind everything.
    pub background: Color,
    /// Felt.
    pub body: Color,
    /// Felt that light falls on: brighter, since its shadows darken it.
    pub plush: Color,
    /// The edge of the felt.
    pub seam: Color,
    pub fiber_passive: Color,
    pub fiber_active: Color,
    /// Light rim that lifts a tendon off the fibres below it.
    pub casing: Color,
    pub winch_fill: Color,
    pub winch_stroke: Color,
    pub pin: Color,
    pub pin_stroke: Color,
    pub target: Color,
    pub target_selected: Color,
    pub target_fill: Color,
    /// Starting component of discovery.
    pub start: Color,
    /// Joining path of discovery.
    pub join: Color,
    /// Tendon of a proposal.
    pub proposed: Color,
    /// Lines along which tendons shall be able to run.
    pub track: Color,
    theme: Theme,
}

/// One colour a winch, told apart also by most colour-blind eyes, clear of the red of fibres and the yellow of winches.
const WINCHES_LIGHT: [Color; 9] = [
    Color(31, 104, 180, 255),
    Color(30, 140, 82, 255),
    Color(128, 70, 178, 255),
    Color(0, 142, 150, 255),
    Color(196, 96, 16, 255),
    Color(190, 60, 130, 255),
    Color(70, 84, 160, 255),
    Color(104, 124, 16, 255),
    Color(96, 80, 72, 255),
];
const WINCHES_DARK: [Color; 9] = [
    Color(98, 168, 240, 255),
    Color(86, 200, 140, 255),
    Color(190, 142, 236, 255),
    Color(72, 204, 210, 255),
    Color(240, 152, 80, 255),
    Color(240, 130, 190, 255),
    Color(142, 158, 240, 255),
    Color(176, 200, 84, 255),
    Color(200, 184, 172, 255),
];

impl Palette {
    pub fn of(theme: Theme) -> Self {
        match theme {
            Theme::Light => Self {
                background: Color(250, 247, 242, 255),
                body: Color(238, 212, 174, 255),
                plush: Color(240, 211, 170, 255),
                seam: Color(176, 130, 84, 255),
                fiber_passive: Color(150, 104, 62, 62),
                fiber_active: Color(208, 28, 34, 255),
                casing: Color(255, 250, 240, 210),
                winch_fill: Color(255, 208, 46, 255),
                winch_stroke: Color(104, 76, 10, 255),
                pin: Color(58, 64, 76, 255),
                pin_stroke: Color(255, 255, 255, 255),
                target: Color(14, 116, 122, 255),
                target_selected: Color(226, 92, 20, 255),
                target_fill: Color(255, 255, 255, 255),
                start: Color(138, 16, 64, 255),
                join: Color(36, 96, 220, 255),
                proposed: Color(22, 138, 70, 255),
                track: Color(142, 36, 170, 255),
                theme,
            },
            Theme::Dark => Self {
                background: Color(29, 27, 26, 255),
                body: Color(124, 92, 64, 255),
                plush: Color(150, 112, 80, 255),
                seam: Color(188, 146, 104, 255),
                fiber_passive: Color(236, 200, 160, 52),
                fiber_active: Color(255, 84, 76, 255),
                casing: Color(38, 28, 20, 215),
                winch_fill: Color(255, 214, 66, 255),
                winch_stroke: Color(52, 38, 6, 255),
                pin: Color(226, 230, 238, 255),
                pin_stroke: Color(40, 44, 54, 255),
                target: Color(92, 220, 220, 255),
                target_selected: Color(255, 158, 84, 255),
                target_fill: Color(34, 32, 30, 255),
                start: Color(255, 130, 190, 255),
                join: Color(112, 164, 255, 255),
                proposed: Color(96, 220, 140, 255),
                track: Color(226, 150, 255, 255),
                theme,
            },
        }
    }

    /// The colour of the tendons of a network: its own, or that of its number.
    pub fn network(&self, index: usize, network: &Network) -> Color {
        network.color.map_or_else(|| self.winch(index), |[red, green, blue]| Color(red, green, blue, 255))
    }

    /// The colours that winches have by their numbers.
    pub fn winches(&self) -> &'static [Color] {
        match self.theme {
            Theme::Light => &WINCHES_LIGHT,
            Theme::Dark => &WINCHES_DARK,
        }
    }

    /// The colour of the tendons of winch number `index`.
    pub fn winch(&self, index: usize) -> Color {
        let colors = self.winches();
        colors[index % colors.len()]
    }
}

/// `a` at 0, `b` at 1.
pub fn mix(a: Color, b: Color, t: f32) -> Color {
    let t = t.clamp(0.0, 1.0);
    let channel = |a: u8, b: u8| (f32::from(a) + t * (f32::from(b) - f32::from(a))).round() as u8;
    Color(channel(a.0, b.0), channel(a.1, b.1), channel(a.2, b.2), channel(a.3, b.3))
}

pub fn with_alpha(color: Color, alpha: u8) -> Color {
    Color(color.0, color.1, color.2, alpha)
}
