//! Winches and tendons as a list.

use crate::commands::document;
use crate::commands::error::CommandError;
use crate::commands::output::{say, say_json};
use crate::design::{Design, Tendon};
use crate::outline::Point;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;

/// List winches and tendons with their places (mm, at rest)
#[derive(Debug, Args)]
pub struct List {
    /// Design file to read
    pub design: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `network list --json` prints.
const FORMAT: &str = "plushwright-networks/1";

#[derive(Serialize)]
struct Networks<'a> {
    winches: Vec<Listed<'a>>,
}

/// A winch, as it is listed.
#[derive(Serialize)]
struct Listed<'a> {
    name: &'a str,
    muted: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    color: Option<[u8; 3]>,
    tendons: Vec<ListedTendon>,
}

#[derive(Serialize)]
struct ListedTendon {
    /// The winch, the holes and the end, mm.
    places: Vec<Point>,
    ratio: f64,
    slack_mm: f64,
}

impl List {
    pub fn run(&self, out: &mut dyn Write) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let tendon = |tendon: &Tendon| ListedTendon {
            places: tendon.routing.iter().map(|point| point.place(&design.mesh.nodes)).collect(),
            ratio: tendon.ratio,
            slack_mm: tendon.slack_mm,
        };
        let networks = design.networks.iter();
        let winches: Vec<Listed> = networks
            .map(|network| Listed {
                name: &network.name,
                muted: network.muted,
                color: network.color,
                tendons: network.tendons.iter().map(tendon).collect(),
            })
            .collect();
        if self.json { say_json(out, FORMAT, &Networks { winches }) } else { print(&design, &winches, out) }
    }
}

fn print(design: &Design, listed: &[Listed], out: &mut dyn Write) -> Result<(), CommandError> {
    say(out, &format!("{}: {} winches", design.name, listed.len()))?;
    for (winch, network) in listed.iter().enumerate() {
        let off = if network.muted { " (switched off)" } else { "" };
        say(out, &format!("{} {}{off}", winch + 1, network.name))?;
        for (tendon, listed) in network.tendons.iter().enumerate() {
            let places: Vec<String> = listed.places.iter().map(|p| format!("{:.3},{:.3}", p[0], p[1])).collect();
            let ratio = if listed.ratio == 1.0 { String::new() } else { format!(", spool x {:.3}", listed.ratio) };
            let slack =
                if listed.slack_mm == 0.0 { String::new() } else { format!(", slack {:.1} mm", listed.slack_mm) };
            say(out, &format!("  tendon {}: {}{ratio}{slack}", tendon + 1, places.join(" ")))?;
        }
    }
    Ok(())
}
