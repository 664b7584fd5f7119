//! The two faces of the skin as groups of a sheet, and remarks for whoever sews them.

use crate::design::Design;
use crate::fabrication::piece::{Cutting, LEAST_FELT_MM, Labels, Passage, Piece};
use crate::fabrication::preset::Preset;
use crate::fabrication::remark::Remark;
use crate::fabrication::sheet::{Anchor, Entity, Group, Layer};
use crate::outline::Point;
use crate::outline::polygon::{bounding_box, contains, distance};

/// Heights of words, mm: of the piece, from what is wished for down to what can be read, and of marks.
const TITLE_MM: [f64; 4] = [6.0, 4.5, 3.5, 2.5];
const MARK_MM: [f64; 2] = [3.0, 2.2];
/// Half the width of the crosses that mark pins and holes that are not cut, mm.
const CROSS_MM: f64 = 2.0;
/// Half the length of the ticks at the ends of the turning gap, mm.
const GAP_TICK_MM: f64 = 2.5;
/// Length of the arrow along the cloth, mm.
const GRAIN_MM: f64 = 30.0;
/// Places along each side of a piece at which its title is tried.
const TITLE_PLACES: usize = 24;
/// Closed notches told one by one among the remarks; the others are counted.
const TOLD: usize = 8;
/// Most marks of a kind that have words: what bounds the work of finding places for them.
const MOST_LABELS: usize = 300;

/// One of the two pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    pub name: &'static str,
    pub title: &'static str,
    pub mirrored: bool,
}

pub const FACES: [Face; 2] = [
    Face { name: "front", title: "FRONT", mirrored: false },
    Face { name: "back", title: "BACK (mirrored)", mirrored: true },
];

/// The letter of a closed notch on every sheet.
pub fn letter(index: usize) -> String {
    let (round, letter) = (index / 26, (b'A' + (index % 26) as u8) as char);
    if round == 0 { letter.to_string() } else { format!("{letter}{}", round + 1) }
}

/// The groups of one piece; `place` puts it on its sheet. What is cut comes first, small holes before all else: what is cut free may shift.
pub fn drawn(
    design: &Design,
    piece: &Piece,
    face: &Face,
    preset: &Preset,
    place: impl Fn(Point) -> Point,
) -> Vec<Group> {
    let all = |points: &[Point]| -> Vec<Point> { points.iter().map(|&p| place(p)).collect() };
    let group = |name: &str, layer: Layer, style| Group::of_piece(face.name, name, layer, style);
    let mut holes = group("holes", Layer::Hole, preset.hole);
    let mut cut_outs = group("cut-outs", Layer::CutOut, preset.cut);
    let mut cut = group("cut", Layer::Cut, preset.cut);
    let mut stitch = group("stitch", Layer::Stitch, preset.stitch);
    let mut notches = group("notches", Layer::Notch, preset.notch);
    let mut snips = group("snips", Layer::Internal, preset.snip);
    let mut grain = group("grain", Layer::Grain, preset.note);
    let mut note = group("note", Layer::Note, preset.note);

    for passage in piece.passages.iter().filter(|p| p.is_cut) {
        holes.entities.push(Entity::Circle { center: place(passage.at), radius: passage.radius_mm });
    }
    cut_outs.entities.extend(piece.cut_outs.iter().map(|ring| Entity::Polygon(all(ring))));
    cut.entities.push(Entity::Polygon(all(&piece.rim)));
    stitch.entities.push(Entity::Polyline(all(&piece.seam.stitches)));
    stitch.entities.extend(piece.inner_seams.iter().map(|ring| Entity::Polygon(all(ring))));
    notches.entities.extend(piece.notches.iter().map(|mark| Entity::Polyline(all(mark))));
    snips.entities.extend(piece.closed.iter().flat_map(|c| &c.snips).map(|snip| Entity::Polyline(all(snip))));
    marks(&mut note, piece, &place);
    grain.entities.extend(arrow(piece, &place));

    let mut labels = Labels::within(all(&piece.rim));
    for entity in [&cut_outs, &stitch, &notches, &snips, &grain, &note].into_iter().flat_map(|g| &g.entities) {
        match entity {
            Entity::Polygon(points) => labels.polygon(points),
            Entity::Polyline(points) => labels.polyline(points),
            _ => {}
        }
    }
    for passage in &piece.passages {
        labels.disc(place(passage.at), passage.radius_mm + 0.3);
    }
    label(&mut note, &mut labels, design, piece, face, &place);
    let groups = vec![holes, cut_outs, cut, stitch, notches, snips, grain, note];
    groups.into_iter().filter(|group| !group.entities.is_empty()).collect()
}

/// Crosses at pins and at holes that are not cut, and ticks across the seam at the ends of the gap.
fn marks(note: &mut Group, piece: &Piece, place: &impl Fn(Point) -> Point) {
    let r = CROSS_MM;
    for &p in piece.pins.iter().chain(piece.passages.iter().filter(|p| !p.is_cut).map(|p| &p.at)) {
        let [x, y] = place(p);
        note.entities.push(Entity::Polyline(vec![[x - r, y - r], [x + r, y + r]]));
        note.entities.push(Entity::Polyline(vec![[x - r, y + r], [x + r, y - r]]));
    }
    let gap = &piece.seam.gap;
    let (Some(&first), Some(&last)) = (gap.first(), gap.last()) else { return };
    let (a, b) = (place(first), place(last));
    let chord = (b[0] - a[0]).hypot(b[1] - a[1]).max(f64::MIN_POSITIVE);
    let across = [-(b[1] - a[1]) / chord * GAP_TICK_MM, (b[0] - a[0]) / chord * GAP_TICK_MM];
    for p in [a, b] {
        let ends = [[p[0] - across[0], p[1] - across[1]], [p[0] + across[0], p[1] + across[1]]];
        note.entities.push(Entity::Polyline(ends.to_vec()));
    }
}

/// An arrow up the piece where it is deepest inside and clear of holes; none where there is no room.
fn arrow(piece: &Piece, place: &impl Fn(Point) -> Point) -> Vec<Entity> {
    let ring = &piece.seam.stitches;
    let clear =
        |p: Point| piece.passages.iter().all(|hole| crate::outline::polygon::length(hole.at, p) > hole.radius_mm + 4.0);
    let steps = |p: Point| (0..=6).map(move |i| [p[0], p[1] + GRAIN_MM * (f64::from(i) / 6.0 - 0.5)]);
    let fits = |p: &Point| steps(*p).all(|q| contains(ring, q) && distance(ring, q) > 5.0 && clear(q));
    let Some(middle) = deepest(piece).into_iter().find(fits) else { return Vec::new() };
    let [x, y] = middle;
    let (low, high) = (y - 0.5 * GRAIN_MM, y + 0.5 * GRAIN_MM);
    let line = |points: &[Point]| Entity::Polyline(points.iter().map(|&p| place(p)).collect());
    vec![line(&[[x, low], [x, high]]), line(&[[x - 2.0, high - 4.0], [x, high], [x + 2.0, high - 4.0]])]
}

/// Places inside the seam, the deepest first.
fn deepest(piece: &Piece) -> Vec<Point> {
    let ring = &piece.seam.stitches;
    let (low, high) = bounding_box(ring);
    let n = TITLE_PLACES;
    let at = |i: usize, k: usize| low[k] + (high[k] - low[k]) * (i as f64 + 0.5) / n as f64;
    let places = (0..n * n).map(|i| [at(i % n, 0), at(i / n, 1)]).filter(|&p| contains(ring, p));
    let mut deep: Vec<(f64, Point)> = places.map(|p| (distance(ring, p), p)).collect();
    deep.sort_by(|a, b| b.0.total_cmp(&a.0));
    deep.into_iter().map(|d| d.1).collect()
}

fn label(
    note: &mut Group,
    labels: &mut Labels,
    design: &Design,
    piece: &Piece,
    face: &Face,
    place: &impl Fn(Point) -> Point,
) {
    let mut put = |text: &str, to: Point| {
        let free = MARK_MM.into_iter().find_map(|size| Some((size, labels.place(text, size, to)?)));
        if let Some((size, at)) = free {
            note.text(at, size, Anchor::Start, text);
        }
    };
    for passage in piece.passages.iter().take(MOST_LABELS) {
        put(&passage.number.to_string(), place(passage.at));
    }
    for (i, &pin) in piece.pins.iter().enumerate().take(MOST_LABELS) {
        put(&format!("pin {}", i + 1), place(pin));
    }
    for (i, closed) in piece.closed.iter().enumerate().take(MOST_LABELS) {
        let middle = closed.snips.first().map_or(closed.bottom, |snip| snip[snip.len() / 2]);
        put(&letter(i), place(middle));
    }
    if let Some(middle) = piece.seam.middle() {
        put(&format!("leave {:.0} mm open to turn", piece.seam.gap_mm), place(middle));
    }
    for passage in &piece.passages {
        for winch in &passage.winches {
            put(winch, place(passage.at));
        }
    }
    let title = format!("{}: {}", face.title, design.name);
    let places: Vec<Point> = deepest(piece).into_iter().map(place).collect();
    // A long name gives way to the face.
    for (text, size) in TITLE_MM.iter().map(|&s| (title.as_str(), s)).chain(TITLE_MM.iter().map(|&s| (face.title, s))) {
        if let Some(at) = labels.place_at(text, size, places.iter().copied()) {
            return note.text(at, size, Anchor::Start, text);
        }
    }
}

/// What whoever cuts and sews should know of this skin.
pub fn remarks(design: &Design, piece: &Piece, cutting: &Cutting) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let (gap_mm, wanted) = (piece.seam.gap_mm, design.fabrication.turning_gap_mm);
    if gap_mm < wanted {
        let words = format!("The turning gap is {gap_mm:.0} mm instead of {wanted:.0} mm: the body is small.");
        remarks.push(Remark::at(piece.seam.middle(), words));
    }
    let from = design.outline.bounding_box().0;
    let told = piece.closed.iter().enumerate().take(TOLD).map(|(i, c)| {
        let words = if c.snips.is_empty() { ", too narrow for scissors: widen it in the outline" } else { "" };
        let [x, y] = [c.bottom[0] - from[0], c.bottom[1] - from[1]];
        format!("{} at x {x:.0}, y {y:.0}: {:.1} mm{words}", letter(i), c.distance_mm)
    });
    let told: Vec<String> = told.collect();
    if !told.is_empty() {
        let more = match piece.closed.len() - told.len() {
            0 => String::new(),
            more => format!("; and {more} more, marked on the pattern"),
        };
        let words = format!(
            "Seam allowances meet in a narrow notch or inner corner: there the cut is farther from the stitches than the allowance of {} mm \
             ({}{more}; x and y in mm from the lower left of the front). Snip along the dotted lines after sewing.",
            design.fabrication.seam_allowance_mm,
            told.join("; "),
        );
        remarks.push(Remark::at(piece.closed.iter().map(|closed| closed.bottom), words));
    }
    let uncut: Vec<&Passage> = piece.passages.iter().filter(|p| !p.is_cut).collect();
    if !uncut.is_empty() {
        let numbers: Vec<String> = uncut.iter().map(|p| p.number.to_string()).collect();
        let words = format!(
            "Marked, not cut, because less than {LEAST_FELT_MM} mm of felt would be left to the stitches or to an opening: hole {}. Move the \
             cables inward, or lead them through the seam.",
            numbers.join(", ")
        );
        remarks.push(Remark::at(uncut.iter().map(|p| p.at), words));
    }
    if cutting.kerf_mm > 0.0 {
        let kerf_mm = cutting.kerf_mm;
        let words = format!(
            "Lines that a machine cuts are moved by half a kerf of {kerf_mm} mm, rims outward, holes inward: the pieces come out at their size. The pattern on \
             paper is not changed."
        );
        remarks.push(words.into());
        let narrow: Vec<&Passage> =
            piece.passages.iter().filter(|p| p.is_cut && 2.0 * p.radius_mm <= kerf_mm).collect();
        if !narrow.is_empty() {
            let numbers: Vec<String> = narrow.iter().map(|p| p.number.to_string()).collect();
            let words = format!(
                "Marked, not cut, because they are no wider than the kerf of {kerf_mm} mm: hole {}. Punch them.",
                numbers.join(", ")
            );
            remarks.push(Remark::at(narrow.iter().map(|p| p.at), words));
        }
    }
    remarks
}
