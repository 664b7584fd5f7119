//! Figures as tables and plots print them.

/// Digits shown in the text table; JSON and CSV have them all.
const SHOWN_DIGITS: i32 = 3;

/// A number with `SHOWN_DIGITS` digits: plain between 0.001 and a million, else with an exponent.
pub fn significant(value: f64) -> String {
    if !value.is_finite() {
        return "-".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let magnitude = value.abs().log10().floor() as i32;
    if (-3..6).contains(&magnitude) {
        let decimals = (SHOWN_DIGITS - 1 - magnitude).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.*e}", SHOWN_DIGITS as usize - 1)
    }
}
