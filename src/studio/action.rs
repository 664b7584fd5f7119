//! What panels, tools and keys ask for. They borrow the session, read only, and return these; [`acts`](super::acts) does them.

use super::canvas::{Camera, Hit, Plushie};
use super::change::Change;
use super::commands::command::Command;
pub use super::session::FileAction;
use super::session::{Brush, Order, Overlay, Renamed, Resolution, RigChoice, Selection, Task};
use crate::engine::{Quality, Shape};
use crate::operations::arrange::Handle;
use crate::operations::network::Part;
use crate::operations::play;
use crate::outline::Point;
use crate::outline::drawing::Item;
use crate::picture::Stage;
use crate::rigging::ProposeOptions;
use std::sync::Arc;

/// Wanted, in the order in which it was asked for.
pub type Actions = Vec<Action>;

#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// One undo step.
    Change(Change),
    /// Part of a gesture (a slider, a dragged keyframe): one undo step when the hand is off the controls.
    Live(Change),
    /// Part of a gesture that begins anew from where the document was, so that nothing adds up on the way.
    Again(Change),
    /// A command, and what it is about.
    Run(&'static Command, Hit),
    /// What stands over the window instead of what did.
    Overlay(Option<Overlay>),
    /// A name that is being typed.
    Typed(Option<(Renamed, String)>),
    /// Moves the target that is selected, mm; part of a gesture.
    DragTarget(Point),
    /// Moves a hole, an end or a winch to a place at rest, mm; part of a gesture.
    MovePart(Part, Point),
    /// Winds a winch by hand to so many mm of cable.
    Wind(usize, f64),
    /// Winds a motor that is driven live to so many mm of cable.
    WindMotor(usize, f64),
    /// The line to the motors that is wanted.
    SetMotors(Box<play::Options>),
    SelectPose(Option<usize>),
    Select(Selection),
    /// Picks targets and pins out together.
    Gather(Vec<Handle>),
    /// Picks keyframes out together.
    GatherKeys(Vec<usize>),
    /// Text from the clipboard.
    Paste(String),
    SetBrush(Brush),
    /// Moves the pin, mm; part of a gesture.
    DragPin(usize, Point),
    SetQuality(Quality),
    SetCamera(Plushie, Camera),
    Scrub(f64),
    SetProposeOptions(ProposeOptions),
    SetResolution(Resolution),
    SetRig(RigChoice),
    ShowProposal(Option<usize>),
    /// A proposal is under the pointer, and strikes this shape.
    HoverProposal(Option<(usize, Option<Arc<Shape>>)>),
    SortProposals(Order),
    /// Puts a rig of the curve in.
    TakeRig(usize),
    ShowStage(Stage),
    /// Of the outline.
    Sketch(Sketch),
    File(FileAction),
    /// A job of a panel.
    Start(Task),
    /// The job of a panel is not wanted any more.
    Stop(&'static str),
    /// Shows where places of the body at rest are, mm.
    ShowPlaces(Vec<Point>),
    DismissMessage(u64),
    /// What a press would do to what lies under the pointer, in English.
    Foretell(Option<&'static str>),
}

/// An action on the outline that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Sketch {
    Open(bool),
    /// Whether new parts are cut out.
    Cut(bool),
    /// A part or a track, and a point of it.
    Select(Option<Item>, Option<usize>),
    Camera(Option<Camera>),
    /// Makes the body of what is drawn; one undo step when it is there.
    MakeBody,
}
