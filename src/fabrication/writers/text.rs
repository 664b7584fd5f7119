//! Programs and pages as they are: what is sent to motors, and what is read.

use crate::fabrication::product::Content;

/// The bytes of a text file.
pub(super) fn write(content: &Content) -> Option<Vec<u8>> {
    match content {
        Content::Program { program, .. } => Some(program.bytes()),
        Content::Text { text, .. } => Some(text.clone().into_bytes()),
        Content::Page(text) => Some(text.clone().into_bytes()),
        _ => None,
    }
}
