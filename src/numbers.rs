//! Numbers as they are told.

/// A number with so many decimals, never less than nothing by less than it shows: not `-0.00`.
pub fn plain(value: f64, decimals: usize) -> String {
    unsigned_zero(format!("{value:.decimals$}"))
}

/// A number that is written already, without its sign (or a minus, U+2212) where only zeros are left of it.
pub fn unsigned_zero(text: String) -> String {
    let is_zero = text.chars().all(|c| matches!(c, '-' | '\u{2212}' | '0' | '.'));
    if is_zero { text.trim_start_matches(['-', '\u{2212}']).to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    #[test]
    fn nothing_is_less_than_nothing() {
        for (value, decimals, text) in [(-0.04, 1, "0.0"), (-0.06, 1, "-0.1"), (0.04, 1, "0.0"), (-0.4, 0, "0")] {
            assert_eq!(super::plain(value, decimals), text);
        }
        assert_eq!(super::unsigned_zero("\u{2212}0.0".into()), "0.0");
    }
}
