//! The font that sheets are set in, and how wide words are in it.

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use std::sync::LazyLock;

/// The bytes of the font (Ubuntu Light): Latin, Greek and Cyrillic letters.
pub const BYTES: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;
/// Mean width of a letter over its height in the wider ones of the fonts that other programs choose for a drawing: DejaVu Sans has 0.6.
const OTHER_FONTS: f64 = 0.6;
/// Width of a character that the font lacks, over its height.
const UNKNOWN_WIDTH: f64 = 0.6;
/// The character that stands for one that the font lacks.
const UNKNOWN: char = '?';

static FONT: LazyLock<Option<FontRef<'static>>> = LazyLock::new(|| FontRef::new(BYTES).ok());
/// The characters of most texts, looked up once: labels try many places for the same words.
static USUAL: LazyLock<Vec<Set>> =
    LazyLock::new(|| (0..=MOST_USUAL).filter_map(char::from_u32).map(looked_up).collect());
/// The last of them: those of European languages.
const MOST_USUAL: u32 = 0x24F;

/// A character as it is set: its number in the font and its width over its height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Set {
    pub glyph: u32,
    pub width: f64,
}

/// The glyph of a character; a question mark for one that the font lacks.
pub fn set(c: char) -> Set {
    USUAL.get(c as usize).copied().unwrap_or_else(|| looked_up(c))
}

fn looked_up(c: char) -> Set {
    let Some(font) = FONT.as_ref() else { return Set { glyph: 0, width: UNKNOWN_WIDTH } };
    let glyph = font.charmap().map(c).or_else(|| font.charmap().map(UNKNOWN)).unwrap_or(GlyphId::NOTDEF);
    let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
    Set { glyph: glyph.to_u32(), width: metrics.advance_width(glyph).map_or(UNKNOWN_WIDTH, f64::from) }
}

/// Width of a text of this height in the font, mm.
pub fn width_mm(text: &str, size_mm: f64) -> f64 {
    text.chars().map(|c| set(c).width).sum::<f64>() * size_mm
}

/// Width that a text may take in whatever font a program sets it in, mm: what labels keep free.
pub fn room_mm(text: &str, size_mm: f64) -> f64 {
    width_mm(text, size_mm).max(OTHER_FONTS * size_mm * text.chars().count() as f64)
}

/// A text in lines no wider than `width_mm`, broken between words; a word that is wider stands alone.
pub fn lines(text: &str, size_mm: f64, width_mm: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let Some(line) = lines.last_mut() else { break };
        let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if line.is_empty() || self::width_mm(&longer, size_mm) <= width_mm {
            *line = longer;
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_broken_between_lines_and_none_is_lost() {
        let text = "Measure the square before you cut.";
        let broken = lines(text, 4.0, 30.0);
        assert!(broken.len() > 1 && broken.join(" ") == text, "{broken:?}");
        assert!(broken.iter().all(|line| width_mm(line, 4.0) <= 30.0));
        assert!((width_mm("mm", 4.0) - 2.0 * width_mm("m", 4.0)).abs() < 1e-9);
        assert_eq!(set('\u{3042}'), set('?'));
    }
}
