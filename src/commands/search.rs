//! What `rig` and `propose` let somebody choose of a search for networks.

use clap::Args;

/// Which rules networks keep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Rules {
    #[default]
    Sewing,
    None,
}

/// Parameters of Algorithm 2; those that are not given are the command's to choose.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct Algorithm2 {
    /// Fibers that seed a network (SEED_NUM of Algorithm 2) [default: `rig` tries several, `propose` takes the studio's]
    #[arg(long, value_name = "N")]
    pub seed_num: Option<usize>,
    /// Rounds of joining (JOIN_DEPTH) [default: likewise]
    #[arg(long, value_name = "N")]
    pub join_depth: Option<usize>,
    /// Largest number of edges of a joining path (JOIN_LEN) [default: likewise]
    #[arg(long, value_name = "N")]
    pub join_len: Option<usize>,
    /// 0 (equal tendons) to 1 (long tendons) [default: likewise]
    #[arg(long, value_name = "PHI", value_parser = parse_phi, allow_hyphen_values = true)]
    pub phi: Option<f64>,
}

impl Algorithm2 {
    /// The option of the first one that is given.
    pub fn given(&self) -> Option<&'static str> {
        let Self { seed_num, join_depth, join_len, phi } = self;
        let given = [("seed-num", seed_num.is_some()), ("join-depth", join_depth.is_some())];
        let given = given.into_iter().chain([("join-len", join_len.is_some()), ("phi", phi.is_some())]);
        given.into_iter().find(|(_, given)| *given).map(|(name, _)| name)
    }
}

fn parse_phi(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(phi) if (0.0..=1.0).contains(&phi) => Ok(phi),
        _ => Err(format!("expected a number from 0 to 1, found `{text}`")),
    }
}
