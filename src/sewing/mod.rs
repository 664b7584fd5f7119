//! What a hand with a needle can sew: rules for holes, cables and winches, and where a routing breaks them.
//!
//! All rules are judged in rest coordinates, mm: that is where the felt is marked and the cables are threaded. A *hole* is a place where
//! a cable passes the felt or ends in it, the winch's included; a *piece* is the straight stretch of cable between two holes; a *turn* is
//! the angle between two pieces at a hole. One exception: pieces stay inside the body in the poses too ([`judge_pieces`]).
//!
//! The figures of the rules are settings of a design. `Design::breaches` asks whether its networks keep them; the check, the
//! blueprint's remarks and the studio's list of networks tell. A new rule is one file with its function, a line in [`judge`], a kind of
//! [`Breach`] with its [`Words`], and its [`Facts`] for other programs.

mod along;
mod breach;
mod cable;
mod facts;
mod holes;
mod housing;
mod inside;
mod layout;
mod rules;
mod words;

pub use along::shared_mm;
pub use breach::{Breach, Place, Spot, most_severe};
pub use cable::{turn, turning};
pub use facts::Facts;
pub use housing::largest_housing;
pub use inside::{OUTSIDE_MM, judge_pieces, outside};
pub use layout::{Body, Rig};
pub use rules::Rules;
pub use words::Words;

/// Every breach of the rules at rest, rule by rule, winch by winch, cable by cable. Empty where all are kept. `gap_mm` is the turning gap's width, 0 for none.
///
/// ```
/// use plushwright::outline::Outline;
/// use plushwright::sewing::{self, Body, Rig, Rules};
///
/// let square = Outline { outer: vec![[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]], holes: vec![] };
/// let rig = Rig { winch: [50.0, 50.0], cables: vec![vec![[50.0, 50.0], [97.0, 50.0]]] };
/// let breaches = sewing::judge(&Rules::default(), &Body::new(&square), &[rig], 60.0);
/// assert_eq!(breaches.len(), 1, "the end is 3 mm from the seam: {breaches:?}");
/// ```
pub fn judge(rules: &Rules, body: &Body, rigs: &[Rig], gap_mm: f64) -> Vec<Breach> {
    let mut found = Vec::new();
    holes::near_seam(rules, body, rigs, &mut found);
    holes::crowded(rules, rigs, &mut found);
    cable::judge(rules, rigs, &mut found);
    along::judge(rules, rigs, &mut found);
    found.extend(judge_pieces(body.polygons(), rigs));
    housing::judge(rules, body, rigs, gap_mm, &mut found);
    found
}

#[cfg(test)]
mod tests;
