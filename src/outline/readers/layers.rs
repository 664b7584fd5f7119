//! The names of layers: those asked for against those there are.

use crate::outline::OutlineError;

/// Layers that a refusal names at most, and letters of a name that it shows.
const LISTED: usize = 20;
const LETTERS: usize = 40;

/// Refuses the first name asked for that is none of a drawing's. `list` are the names to tell the user, in the drawing's
/// order: not every one that can be asked for need stand there.
pub(super) fn check<'a>(
    asked: &[String],
    is_there: impl Fn(&str) -> bool,
    list: impl Iterator<Item = &'a str>,
) -> Result<(), OutlineError> {
    let Some(name) = asked.iter().find(|name| !is_there(name)) else { return Ok(()) };
    let mut names: Vec<String> = Vec::new();
    let mut more = 0;
    for there in list {
        let there: String = there.chars().map(|c| if c.is_control() { ' ' } else { c }).take(LETTERS).collect();
        match names.contains(&there) {
            true => {}
            false if names.len() < LISTED => names.push(there),
            false => more += 1,
        }
    }
    let layers = match (names.is_empty(), more) {
        (true, _) => "no named layers".to_owned(),
        (_, 0) => names.join(", "),
        _ => format!("{} and {more} more", names.join(", ")),
    };
    Err(OutlineError::NoSuchLayer { name: name.clone(), layers })
}
