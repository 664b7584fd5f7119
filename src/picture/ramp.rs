//! Colours that stand for figures, and the bar that says which for which.
//!
//! Along a ramp lightness goes one way only (or, where two kinds are told apart, away from the middle on both sides, blue to one and
//! orange to the other): whoever sees fewer colours still sees the order.

use super::color::Color;
use super::palette::{Palette, Theme, mix};

/// How figures are spread over a ramp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// From nothing upward; faint to strong.
    Rising,
    /// Ratios around one, equal steps for equal factors; blue below, orange above.
    Ratio,
}

/// What colours stand for in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// `Cable force`.
    pub title: &'static str,
    /// `N`; empty for a figure without a unit.
    pub unit: &'static str,
    pub kind: Kind,
    /// Of the lower end; of ratios the inverse of `high`.
    pub low: f64,
    pub high: f64,
    pub theme: Theme,
}

const RISING_LIGHT: [Color; 4] =
    [Color(232, 224, 202, 255), Color(238, 168, 74, 255), Color(196, 66, 48, 255), Color(72, 12, 70, 255)];
const RISING_DARK: [Color; 4] =
    [Color(74, 64, 60, 255), Color(156, 62, 92, 255), Color(240, 130, 58, 255), Color(255, 240, 150, 255)];
const BELOW_LIGHT: [Color; 3] = [Color(243, 239, 230, 255), Color(98, 160, 214, 255), Color(10, 50, 116, 255)];
const ABOVE_LIGHT: [Color; 3] = [Color(243, 239, 230, 255), Color(240, 160, 76, 255), Color(130, 50, 4, 255)];
const BELOW_DARK: [Color; 3] = [Color(62, 56, 52, 255), Color(56, 120, 200, 255), Color(172, 220, 255, 255)];
const ABOVE_DARK: [Color; 3] = [Color(62, 56, 52, 255), Color(206, 104, 30, 255), Color(255, 218, 150, 255)];

impl Bar {
    /// From nothing to the largest of figures, which is `least` at least.
    pub fn rising(title: &'static str, unit: &'static str, figures: &[f64], least: f64, theme: Theme) -> Self {
        let high = figures.iter().copied().filter(|v| v.is_finite()).fold(least, f64::max);
        Self { title, unit, kind: Kind::Rising, low: 0.0, high, theme }
    }

    /// Around one, as far as the ratios go, between `least` and `most`.
    pub fn ratio(title: &'static str, ratios: &[f64], [least, most]: [f64; 2], theme: Theme) -> Self {
        let far = |r: f64| if r > 0.0 { r.max(1.0 / r) } else { f64::INFINITY };
        let high = ratios.iter().map(|&r| far(r)).fold(least, f64::max).min(most);
        Self { title, unit: "", kind: Kind::Ratio, low: 1.0 / high, high, theme }
    }

    /// Where a figure is on the bar, 0 to 1.
    pub fn place(&self, figure: f64) -> f64 {
        let part = match self.kind {
            Kind::Rising => (figure - self.low) / (self.high - self.low).max(f64::MIN_POSITIVE),
            Kind::Ratio if figure > 0.0 => 0.5 + 0.5 * figure.ln() / self.high.ln().max(f64::MIN_POSITIVE),
            Kind::Ratio => 0.0,
        };
        if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) }
    }

    /// The colour of a figure.
    pub fn color(&self, figure: f64) -> Color {
        self.color_at(self.place(figure))
    }

    /// The colour at a place on the bar.
    pub fn color_at(&self, place: f64) -> Color {
        let dark = self.theme == Theme::Dark;
        match self.kind {
            Kind::Rising => along(if dark { &RISING_DARK } else { &RISING_LIGHT }, place),
            Kind::Ratio if place < 0.5 => along(if dark { &BELOW_DARK } else { &BELOW_LIGHT }, 1.0 - 2.0 * place),
            Kind::Ratio => along(if dark { &ABOVE_DARK } else { &ABOVE_LIGHT }, 2.0 * place - 1.0),
        }
    }

    /// Places of the figures that are written beside it, and their words.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let middle = match self.kind {
            Kind::Rising => 0.5 * (self.low + self.high),
            Kind::Ratio => 1.0,
        };
        let words = |v: f64| match v {
            0.0 => "0".to_owned(),
            _ if v < 0.1 => format!("{v:.3}"),
            _ if v < 10.0 => format!("{v:.2}"),
            _ if v < 100.0 => format!("{v:.1}"),
            _ => format!("{v:.0}"),
        };
        [self.low, middle, self.high].map(|v| (self.place(v), words(v))).into()
    }

    /// The title with its unit.
    pub fn words(&self) -> String {
        if self.unit.is_empty() { self.title.to_owned() } else { format!("{} ({})", self.title, self.unit) }
    }

    /// Its range in a sentence.
    pub fn range(&self) -> String {
        let ticks = self.ticks();
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        format!("{} from {} to {}{unit}", self.title, ticks[0].1, ticks[2].1)
    }
}

/// Between colours that are equally far apart.
fn along(colors: &[Color], place: f64) -> Color {
    let at = place.clamp(0.0, 1.0) * (colors.len() - 1) as f64;
    let first = (at as usize).min(colors.len() - 2);
    mix(colors[first], colors[first + 1], (at - first as f64) as f32)
}

/// The felt below what is coloured: paper rather than plush, so that colours read.
pub fn ground(theme: Theme) -> Color {
    let palette = Palette::of(theme);
    mix(palette.background, palette.body, 0.32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear light of each channel.
    fn linear(Color(r, g, b, _): Color) -> [f64; 3] {
        [r, g, b].map(|c| (f64::from(c) / 255.0).powf(2.2))
    }

    /// What is left of a colour without one kind of cones (Machado et al. 2009, severity 1).
    fn seen(color: Color, without: usize) -> [f64; 3] {
        const MATRICES: [[[f64; 3]; 3]; 3] = [
            [[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]],
            [[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]],
            [[1.256, -0.077, -0.179], [-0.078, 0.931, 0.148], [0.005, 0.691, 0.304]],
        ];
        let c = linear(color);
        MATRICES[without].map(|row| row.iter().zip(c).map(|(m, c)| m * c).sum::<f64>().clamp(0.0, 1.0))
    }

    fn lightness(c: [f64; 3]) -> f64 {
        let y: f64 = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
        116.0 * y.max(1e-6).cbrt() - 16.0
    }

    #[test]
    fn the_order_of_colours_is_seen_by_every_eye_in_both_themes() {
        for theme in [Theme::Light, Theme::Dark] {
            let rising = Bar::rising("Force", "N", &[7.0], 0.1, theme);
            let ratio = Bar::ratio("Strain", &[0.5, 1.2], [1.1, 4.0], theme);
            let way = if theme == Theme::Light { -1.0 } else { 1.0 };
            for eye in 0..4 {
                let light = |c: Color| lightness(if eye == 3 { linear(c) } else { seen(c, eye) });
                let climbs = |figures: &[f64], bar: &Bar| {
                    let all: Vec<f64> = figures.iter().map(|&v| way * light(bar.color(v))).collect();
                    assert!(all.windows(2).all(|w| w[1] > w[0]), "{bar:?} {eye}: {all:?}");
                    assert!(all[all.len() - 1] - all[0] > 35.0, "{bar:?} {eye}: {all:?}");
                };
                climbs(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], &rising);
                climbs(&[1.0, 0.9, 0.8, 0.7, 0.6, 0.5], &ratio);
                climbs(&[1.0, 1.15, 1.3, 1.5, 1.75, 2.0], &ratio);
                // Above and below are told apart.
                let (low, high) = (ratio.color(0.7), ratio.color(1.4));
                let pair = [low, high].map(|c| if eye == 3 { linear(c) } else { seen(c, eye) });
                let apart: f64 = (0..3).map(|k| (pair[0][k].cbrt() - pair[1][k].cbrt()).abs()).sum();
                assert!(apart > 0.15, "{theme:?} {eye}: {apart}");
            }
        }
    }

    #[test]
    fn figures_have_places_and_words() {
        let bar = Bar::rising("Cable force", "N", &[2.0, 12.5, f64::NAN], 0.1, Theme::Light);
        assert_eq!((bar.place(0.0), bar.place(12.5), bar.place(99.0)), (0.0, 1.0, 1.0));
        assert_eq!(bar.range(), "Cable force from 0 to 12.5 N");
        let ratio = Bar::ratio("Strain", &[0.25], [1.1, 3.0], Theme::Light);
        assert_eq!((ratio.high, ratio.place(1.0)), (3.0, 0.5));
        assert!((ratio.place(0.5) + ratio.place(2.0) - 1.0).abs() < 1e-12);
        assert_eq!(ratio.place(-1.0), 0.0);
    }
}
