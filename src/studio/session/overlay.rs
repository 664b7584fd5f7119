//! What stands over the window for the keyboard's sake, and names that are typed.

/// A sheet over the window for the keyboard's sake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// Every command by name.
    Palette,
    /// What every key does.
    Shortcuts,
    /// Designs to begin with.
    Start,
    /// What the window has said.
    Log,
}

/// The thing that gets another name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Renamed {
    Pose(usize),
    Network(usize),
    Plushie,
}
