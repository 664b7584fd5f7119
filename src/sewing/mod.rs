//! What a hand with a needle can sew: rules for holes, cables and winches, and where a routing breaks them.
//!
//! All rules are judged in rest coordinates, mm: that is where the felt is marked and the cables are threaded. A *hole* is a place where
//! a cable passes the felt or ends in it, the winch's included; a *piece* is the straight stretch of cable between two holes; a *turn* is
//! the angle between two pieces at a hole. One exception: pieces stay inside the body in the poses too ([`outside`]).
//!
//! A new rule is one file with its function, and a line in [`judge`].

mod along;
mod cable;
mod holes;
mod housing;
mod layout;
mod rules;

pub use along::shared_mm;
pub use cable::{outside, turn, turning};
pub use housing::largest_housing;
pub use layout::{Body, Rig};
pub use rules::{Breach, Place, Rules};

/// Every breach of the rules, winch by winch, cable by cable. Empty where all are kept. `gap_mm` is the turning gap's width, 0 for none.
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
    housing::judge(rules, body, rigs, gap_mm, &mut found);
    found
}

#[cfg(test)]
mod tests;
