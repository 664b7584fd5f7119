//! How an outline is read and meshed, as the dialog has it.

use crate::operations::new_design::{self, Options};
use std::path::Path;

/// How an outline is read and meshed, as the dialog has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportChoice {
    pub options: Options,
    /// Names of layers between commas as they are typed; none for all.
    pub layers: String,
    /// Names of blocks of a DXF, likewise; none for the drawing itself.
    pub blocks: String,
}

impl ImportChoice {
    /// For the outline in a file, after which the design is called.
    pub(crate) fn options(&self, path: &Path) -> Options {
        let mut options = Options { name: new_design::name_of(path), ..self.options.clone() };
        let names =
            |text: &str| text.split(',').map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect();
        options.import.layers = names(&self.layers);
        options.import.blocks = names(&self.blocks);
        options
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dialog_begins_with_the_options_of_the_operation() {
        let choice = ImportChoice { layers: " body, ears,, ".into(), ..ImportChoice::default() };
        let options = choice.options(Path::new("toys/pig.svg"));
        assert_eq!(options.import.layers, ["body", "ears"]);
        let usual = Options { name: "pig".into(), ..Options::default() };
        assert_eq!(ImportChoice::default().options(Path::new("toys/pig.svg")), usual);
    }
}
