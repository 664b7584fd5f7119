//! Where the commands touch a room that is being built.

use super::error::CommandError;
use crate::design::Design;
use std::path::Path;

pub fn export(_design: &Design, _folder: &Path) -> Result<(), CommandError> {
    Err(CommandError::Failed("export is not available".into()))
}
