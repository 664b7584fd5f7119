//! `network`: winches and tendons changed by hand.

mod action;
mod list;

use super::error::CommandError;
use super::output::{say, say_json};
use super::words;
use crate::files::shown;
use crate::motion::winch_labels;
use crate::operations::Context;
use crate::operations::network::{self, Error};
use crate::sewing::Breach;
use action::{Action, Files};
use clap::{Args, Subcommand};
use serde::Serialize;
use std::io::Write;
use std::sync::atomic::AtomicBool;

/// Change winches and tendons: move and add holes, hand tendons over, make and split winches
///
/// Places are in mm, y up, origin at the lower left corner of the rest silhouette's box, and mean points of the body at rest. Winches go
/// by name or by number; winches, tendons and pieces of cable are counted from 1, holes from the winch (number 0), as `check` does. After a
/// change the rules of sewing that the design breaks are told.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright network move pig.plush --winch 1 --tendon 2 --hole 1 --to 160,80")]
pub struct NetworkCommand {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    List(list::List),
    #[command(flatten)]
    Change(Action),
}

/// Format of what a change prints with `--json`.
const FORMAT: &str = "plushwright-network-change/1";

/// What a change prints with `--json`.
#[derive(Serialize)]
struct Changed<'a> {
    design: String,
    winches: usize,
    tendons: usize,
    /// Rules of sewing that the design breaks at rest.
    sewing: &'a [Breach],
}

impl NetworkCommand {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let action = match &self.what {
            What::List(list) => return list.run(out),
            What::Change(action) => action,
        };
        let Files { design: from, target, json } = action.files();
        let (mut design, edit) = target.open(from, cancel)?;
        let change = action.edit(&design)?;
        let before = design.clone();
        network::run(&mut design, &change, &Context::new(cancel)).map_err(failed)?;
        edit.save(&design, cancel)?;
        let (winches, tendons) =
            (design.networks.len(), design.networks.iter().map(|n| n.tendons.len()).sum::<usize>());
        let breaches = design.breaches();
        if *json {
            let changed = Changed { design: shown(target.path(from)), winches, tendons, sewing: &breaches };
            return say_json(out, FORMAT, &changed);
        }
        let done = change.label().to_lowercase();
        say(out, &format!("{}: {done}; {}", shown(target.path(from)), words::built(winches, tendons)))?;
        if let Some(note) = words::outdated(&before, &design, target.path(from)) {
            say(out, &format!("note: {note}"))?;
        }
        let names = winch_labels(&design);
        breaches.iter().try_for_each(|breach| say(out, &format!("hard to sew: {}", breach.words(&names))))
    }
}

fn failed(error: Error) -> CommandError {
    match error {
        Error::Cancelled(_) => CommandError::Cancelled,
        error => CommandError::Usage(error.to_string()),
    }
}
