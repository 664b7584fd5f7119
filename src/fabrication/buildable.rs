//! What cannot be built as it is drawn: winches that are in each other's way, that no housing fits around or gets to, parts that cannot be turned.

use super::error::ExportError;
use super::piece::{Seam, Ways};
use super::remark::Remark;
use super::winch::{self, Housing};
use crate::design::Design;
use crate::motion::winch_labels;
use crate::outline::polygon::{bounding_box, distance_to_segment, length, sides};
use crate::outline::{Outline, Point};
use crate::sewing::Breach;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};

/// Narrowest part of felt that can be turned after sewing, flat, mm: what a stick of 4 mm and two layers of felt leave room for. Larger: more
/// parts are told.
const TURNED_MM: f64 = 8.0;
/// How far a part reaches out of where it is wide enough, in halves of that width, before it is told: a corner of 39 degrees reaches 2.
const REACH: f64 = 2.0;
/// Parts that are looked at: what bounds the work on ragged outlines.
const MOST_PARTS: usize = 500;
/// Places told one by one.
const TOLD: usize = 6;

/// Whether every winch has a place of its own.
///
/// # Errors
/// Two winches whose spools would overlap.
pub(super) fn refuse(design: &Design) -> Result<(), ExportError> {
    let places: Vec<Point> =
        design.networks.iter().filter_map(|n| Some(n.winch()?.place(&design.mesh.nodes))).collect();
    // A figure of 0 lifts the rule: cables pulled by hand need no spools.
    let least_mm = (2.0 * winch::housing(design).inner_radius_mm).min(design.sewing.housing_mm);
    let names = winch_labels(design);
    for (i, &place) in places.iter().enumerate() {
        for (j, &before) in places[..i].iter().enumerate() {
            let distance_mm = length(place, before);
            if distance_mm < least_mm {
                let (one, other) = (names[j].clone(), names[i].clone());
                return Err(ExportError::WinchesCollide { one, other, distance_mm, least_mm });
            }
        }
    }
    Ok(())
}

/// A remark for each thing that no hand can do, all places in it. `breaches` are those of the rules of sewing.
pub(super) fn remarks(design: &Design, breaches: &[Breach], seam: &Seam) -> Vec<Remark> {
    let names = winch_labels(design);
    let mut remarks = of_winches(design, &names, breaches);
    let housing = winch::housing(design);
    remarks.extend(of_the_way(design, &names, &housing, seam));
    remarks.extend(thin(&design.outline));
    remarks
}

/// Where winches are, mm.
pub(super) fn places_of(design: &Design, winches: impl IntoIterator<Item = usize>) -> Vec<Point> {
    let place = |winch: usize| Some(design.networks.get(winch)?.winch()?.place(&design.mesh.nodes));
    winches.into_iter().filter_map(place).collect()
}

fn of_winches(design: &Design, names: &[String], breaches: &[Breach]) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let (winches, cramped): (Vec<usize>, Vec<String>) = breaches
        .iter()
        .filter_map(|breach| match breach {
            Breach::HousingOutside { winch, room_mm, housing_mm } => {
                Some((*winch, format!("{} (room for {:.0} mm of {housing_mm:.0})", names[*winch], room_mm.max(0.0))))
            }
            _ => None,
        })
        .unzip();
    if !cramped.is_empty() {
        let words =
            format!("No housing fits at: {}. Move these winches inward, or take a smaller spool.", cramped.join(", "));
        remarks.push(Remark::at(places_of(design, winches), words));
    }
    let (winches, through): (Vec<usize>, Vec<String>) = breaches
        .iter()
        .filter_map(|breach| match breach {
            Breach::ThroughWinch { at, winch, .. } => {
                Some((*winch, format!("{} tendon {} through {}", names[at.winch], at.cable + 1, names[*winch])))
            }
            _ => None,
        })
        .unzip();
    if !through.is_empty() {
        let words = format!(
            "{} through the housings of other winches: {}. Lead them around, or move the winches.",
            if through.len() == 1 { "One cable runs".into() } else { format!("{} cables run", through.len()) },
            through.join(", ")
        );
        remarks.push(Remark::at(places_of(design, winches), words));
    }
    remarks
}

/// Whether housings get through the gap and to their places.
fn of_the_way(design: &Design, names: &[String], housing: &Housing, seam: &Seam) -> Vec<Remark> {
    let flat = housing.flat_mm();
    let mut remarks = Vec::new();
    if design.sewing.housing_mm <= 0.0 {
        return remarks;
    }
    if seam.gap_mm < flat {
        let words = format!(
            "The turning gap of {:.0} mm lets no housing through: around its ears that takes {flat:.0} mm. Set fabrication.turning_gap_mm to that.",
            seam.gap_mm
        );
        remarks.push(Remark::at(seam.middle(), words));
    }
    if seam.gap.is_empty() {
        return remarks;
    }
    let widths = Ways::of(design).widths(&seam.gap);
    let (winches, narrow): (Vec<usize>, Vec<String>) = widths
        .into_iter()
        .zip(names)
        .enumerate()
        .filter(|(_, (width, _))| *width < flat)
        .map(|(winch, (width, name))| (winch, format!("{name} ({width:.0} mm)")))
        .unzip();
    if !narrow.is_empty() {
        let words = format!(
            "The way from the turning gap is too narrow for a housing of {flat:.0} mm, measured flat, to: {}. Put these winches in before the seam beside \
             them is closed.",
            narrow.join(", ")
        );
        remarks.push(Remark::at(places_of(design, winches), words));
    }
    remarks
}

/// Parts that cannot be turned after sewing: what the opening of the outline by a disc leaves, without its corners.
fn thin(outline: &Outline) -> Option<Remark> {
    let r = 0.5 * TURNED_MM;
    let rings: Vec<Vec<Point>> = outline.polygons().map(Vec::from).collect();
    let by = |d: f64| OutlineStyle::new(d).line_join(LineJoin::Round(0.2));
    let open = rings.outline(&by(-r)).outline(&by(1.02 * r));
    let rest: Vec<Vec<Vec<Point>>> = rings.overlay_as::<i64>(&open, OverlayRule::Difference, FillRule::NonZero);
    let from = outline.bounding_box().0;
    let kept: Vec<(Point, Point)> = open.iter().flatten().flat_map(|ring| sides(ring)).collect();
    let reach = |p: Point| kept.iter().map(|&(a, b)| distance_to_segment(a, b, p)).fold(f64::INFINITY, f64::min);
    let mut found: Vec<(f64, Point)> = rest
        .iter()
        .take(MOST_PARTS)
        .filter_map(|part| {
            let ring = part.first()?;
            let (low, high) = bounding_box(ring);
            if length(low, high) <= r {
                return None;
            }
            let far = ring.iter().map(|&p| (reach(p), p)).max_by(|a, b| a.0.total_cmp(&b.0))?;
            (far.0 > REACH * r).then_some(far)
        })
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    if found.is_empty() {
        return None;
    }
    let told: Vec<String> =
        found.iter().take(TOLD).map(|(_, p)| format!("({:.0}, {:.0})", p[0] - from[0], p[1] - from[1])).collect();
    let more = match found.len() - told.len() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let words = format!(
        "{} narrower than {TURNED_MM:.0} mm, which cannot be sewn and turned: their ends are at {}{more} (mm from the lower left of the front). Widen \
         them when the outline is read, or cut them of one layer of felt and sew them on.",
        if found.len() == 1 { "One part is".into() } else { format!("{} parts are", found.len()) },
        told.join(", ")
    );
    Some(Remark::at(found.into_iter().map(|(_, place)| place), words))
}
