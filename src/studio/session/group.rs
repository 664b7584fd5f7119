//! Targets and pins that are picked out together.

use crate::design::Design;
use crate::operations::arrange::Handle;

/// Several targets of the current pose, and pins.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    handles: Vec<Handle>,
}

impl Group {
    /// In order, each once.
    pub fn handles(&self) -> &[Handle] {
        &self.handles
    }

    pub fn has(&self, handle: Handle) -> bool {
        self.handles.contains(&handle)
    }

    /// Numbers of the targets among them.
    pub fn targets(&self) -> impl Iterator<Item = usize> {
        self.handles.iter().filter_map(|handle| match handle {
            Handle::Target(index) => Some(*index),
            Handle::Pin(_) => None,
        })
    }

    pub(crate) fn set(&mut self, mut handles: Vec<Handle>) {
        handles.sort_unstable();
        handles.dedup();
        self.handles = handles;
    }

    /// After any change of the document: nothing may point beyond it.
    pub(crate) fn clamp(&mut self, design: &Design, pose: Option<usize>) {
        let targets = pose.and_then(|pose| design.poses.get(pose)).map_or(0, |pose| pose.targets.len());
        self.handles.retain(|handle| match *handle {
            Handle::Target(index) => index < targets,
            Handle::Pin(index) => index < design.pins.len(),
        });
    }
}
