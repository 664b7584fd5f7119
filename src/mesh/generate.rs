//! Outline to triangle mesh: what can be asked for, and the refusal of what cannot be.

use super::quality::MeshQuality;
use super::search::{Pool, Subject, Thoroughness};
use super::symmetry::{self, Axis};
use super::{Mesh, MeshError};
use crate::outline::{Outline, Point};
use serde::{Deserialize, Serialize};

/// Most muscle fibres that are meshed: far beyond what a pose could be solved with.
pub const MAX_FIBERS: usize = 200_000;
/// Steps taken upward from the edges that good angles need alone, to find a count that smoothing and the search reach as well:
/// the first by a twelfth, each by a 36th more than the one before, three times in all.
const NEAREST_STEPS: usize = 8;
/// Fewest fibres that are looked for below a count that has a mesh, as a part of it, and how often that interval is halved:
/// to 2 %.
const FEWER: f64 = 0.7;
const HALVINGS: usize = 4;
/// Counts above this are not improved upon: one mesh alone takes a tenth of a second and more.
const LARGE: usize = 5000;
/// Largest multiple of the asked count that is looked for instead, at first.
const NEAREST_MOST: usize = 10;

/// Size, tracks and symmetry that a mesh is to have.
#[derive(Clone, Debug)]
pub struct MeshSpec {
    pub size: Size,
    /// Polylines inside the body, mm, along which edges shall run, so that a thread can follow them.
    pub tracks: Vec<Vec<Point>>,
    /// Whether an outline that is its own mirror image gets a mesh that is one too.
    pub mirror: bool,
}

/// How fine a mesh is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Size {
    /// Number of edges: the muscle fibres.
    Fibers(usize),
    /// Typical length of an edge, mm.
    EdgeMm(f64),
}

impl MeshSpec {
    pub fn fibers(fibers: usize) -> Self {
        Self { size: Size::Fibers(fibers), tracks: Vec::new(), mirror: true }
    }
}

/// A mesh and how it came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Meshed {
    pub mesh: Mesh,
    pub quality: MeshQuality,
    /// The axis about which the mesh is its own mirror image, if it was made so.
    pub axis: Option<Axis>,
}

/// A mesh of the outline with `fibers` edges: exactly so, or within 3 % where nothing comes out even.
///
/// Boundary nodes lie on the outline and its corners are nodes; area is kept within 1 %, the boundary within 0.5 % of the
/// height where there are fibres enough, and triangles are as near to equilateral as the outline permits. A symmetric
/// outline gives a symmetric mesh. The same outline gives the same bits. About n log n in the number of fibres.
///
/// # Errors
/// [`MeshError::Unreachable`] names the least count found possible where the outline needs more edges than asked for, or the
/// one below it that has a mesh where none above was found;
/// [`MeshError::TooFine`] where there is none, [`MeshError::TooIntricate`] where none was found within a bound on work.
pub fn generate(outline: &Outline, fibers: usize) -> Result<Mesh, MeshError> {
    build(outline, &MeshSpec::fibers(fibers)).map(|meshed| meshed.mesh)
}

/// The mesh that is asked for. See [`generate()`].
///
/// # Errors
/// As [`build_or_finer`], and [`MeshError::Unreachable`] for a count that the outline does not allow; a size in mm that is too
/// coarse for it gives the coarsest mesh there is instead.
pub fn build(outline: &Outline, spec: &MeshSpec) -> Result<Meshed, MeshError> {
    match (spec.size, build_or_finer(outline, spec)?) {
        (Size::Fibers(asked), (_, nearest)) if nearest != asked => Err(MeshError::Unreachable { asked, nearest }),
        (_, (meshed, _)) => Ok(meshed),
    }
}

/// The mesh that is asked for or, where the outline needs more fibres, the one with the fewest that were found possible;
/// and the number of fibres that it was made for.
///
/// # Errors
/// As [`generate()`], but [`MeshError::Unreachable`] only for more than [`MAX_FIBERS`], or where there is only a mesh with fewer.
/// [`MeshError::BadTrack`] for one that is not finite, [`MeshError::IntricateTracks`] where there is a mesh only without the
/// tracks.
pub fn build_or_finer(outline: &Outline, spec: &MeshSpec) -> Result<(Meshed, usize), MeshError> {
    check(outline)?;
    if !spec.tracks.iter().flatten().flatten().all(|v| v.is_finite()) {
        return Err(MeshError::BadTrack);
    }
    let fibers = match spec.size {
        Size::Fibers(fibers) => fibers,
        Size::EdgeMm(length) => fibers_of_length(outline, length),
    };
    if fibers > MAX_FIBERS {
        return Err(MeshError::Unreachable { asked: fibers, nearest: MAX_FIBERS });
    }
    let mirror = spec.mirror && spec.tracks.is_empty();
    let axis = if mirror { symmetry::axis(outline) } else { None };
    let half = axis.and_then(|(axis, off)| Some((axis, off, symmetry::half(outline, axis)?)));
    let half_pool = half.as_ref().map(|(_, _, half)| Pool::of(&half.outline));
    let half = half.as_ref().zip(half_pool.as_ref());
    let half = half.map(|((axis, off, half), pool)| (*axis, Subject::half(outline, half, pool, (*axis, *off), fibers)));
    let pool = Pool::of(outline);
    let whole = Subject::whole(outline, &pool, &spec.tracks, fibers);
    // One half and its image, unless the whole gives better angles.
    let at = |fibers: usize, effort: Thoroughness| {
        let even = whole.even(fibers);
        let mirrored = half.as_ref().and_then(|(axis, subject)| {
            let (mesh, quality) = subject.mesh(even, fibers, effort)?;
            Some(Meshed { mesh, quality, axis: Some(*axis) })
        });
        mirrored.filter(|m| m.quality.below_20_deg == m.quality.corners_below_20_deg).or_else(|| {
            let (mesh, quality) = whole.mesh(even, fibers, effort)?;
            Some(Meshed { mesh, quality, axis: None })
        })
    };
    for lenient in [false, true] {
        if lenient {
            whole.relax();
            half.iter().for_each(|(_, subject)| subject.relax());
        }
        if let Some(meshed) = at(fibers, Thoroughness::Full) {
            return Ok((meshed, fibers));
        }
        if let Some(found) = finer(&whole, fibers, at) {
            return Ok(found);
        }
    }
    // Features that no mesh with so many fibres may round off, one with few fibres does.
    if let Some((meshed, count)) = finer(&whole, 0, at) {
        return if count > fibers {
            Ok((meshed, count))
        } else {
            Err(MeshError::Unreachable { asked: fibers, nearest: count })
        };
    }
    Err(refusal(outline, spec, whole.has_given_up()))
}

/// Why there is no mesh. Whether the tracks are the cause is tried out: without them it takes about as long as a mesh does.
fn refusal(outline: &Outline, spec: &MeshSpec, has_given_up: bool) -> MeshError {
    let bare = MeshSpec { tracks: Vec::new(), ..spec.clone() };
    if !spec.tracks.is_empty() && build_or_finer(outline, &bare).is_ok() {
        MeshError::IntricateTracks
    } else if has_given_up {
        MeshError::TooIntricate
    } else {
        MeshError::TooFine { most: MAX_FIBERS }
    }
}

/// About how many edges a mesh with edges of this length has.
fn fibers_of_length(outline: &Outline, length: f64) -> usize {
    let triangles = outline.area() / (0.25 * 3.0_f64.sqrt() * length * length);
    let count = 0.5 * (3.0 * triangles + outline.perimeter() / length);
    if count.is_finite() { (count.round() as usize).max(3) } else { usize::MAX }
}

fn check(outline: &Outline) -> Result<(), MeshError> {
    let finite = outline.polygons().flatten().flatten().all(|v| v.is_finite());
    let sound = outline.polygons().all(|ring| ring.len() >= 3);
    if finite && sound && outline.area() > 0.0 { Ok(()) } else { Err(MeshError::BadOutline) }
}

/// The mesh with the fewest fibres above `asked` that was found, and how many it was made for.
///
/// The angles alone say where to begin; from there upward until a count has a mesh, then the interval to the largest
/// count that had none, or to [`FEWER`] of it, is halved.
fn finer(whole: &Subject, asked: usize, at: impl Fn(usize, Thoroughness) -> Option<Meshed>) -> Option<(Meshed, usize)> {
    let most = (NEAREST_MOST * asked.max(100)).min(MAX_FIBERS);
    let least = whole.least_edges(asked, most).or_else(|| whole.least_edges(most, MAX_FIBERS));
    let mut count = least?.max(asked + 1);
    let mut without = asked;
    let mut found = None;
    for step in 0..NEAREST_STEPS {
        found = if count > MAX_FIBERS { None } else { at(count, Thoroughness::Little).map(|meshed| (meshed, count)) };
        if found.is_some() || whole.is_exhausted() {
            break;
        }
        without = count;
        count += (count * (3 + step) / 36).max(1);
    }
    let (meshed, mut count) = found?;
    // A mesh of thousands takes as long as the search for one of hundreds: it is taken as it is.
    if count > LARGE {
        return Some((meshed, count));
    }
    without = without.max((FEWER * count as f64) as usize);
    for _ in 0..HALVINGS {
        let between = without.midpoint(count);
        if between <= without || whole.is_exhausted() {
            break;
        }
        if at(between, Thoroughness::Little).is_some() {
            count = between;
        } else {
            without = between;
        }
    }
    // The same mesh as for who asks for so many.
    Some((at(count, Thoroughness::Full).unwrap_or(meshed), count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::{Point, polygon};

    fn rectangle(w: f64, h: f64) -> Outline {
        Outline { outer: vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]], holes: Vec::new() }
    }

    fn circle(centre: Point, r: f64, n: usize) -> Vec<Point> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n).map(|i| [centre[0] + r * angle(i).cos(), centre[1] + r * angle(i).sin()]).collect()
    }

    /// A star-shaped polygon with smooth lobes; each seed another.
    fn lobes(seed: u64) -> Outline {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let waves: Vec<(f64, f64, f64)> = (2..7).map(|k| (f64::from(k), 0.13 * random(), 6.3 * random())).collect();
        let outer = circle([0.0; 2], 1.0, 240).into_iter().map(|p| {
            let angle = p[1].atan2(p[0]);
            let r = 100.0 * (1.0 + waves.iter().map(|(k, a, phase)| a * (k * angle + phase).sin()).sum::<f64>());
            [r * p[0], r * p[1]]
        });
        Outline { outer: outer.collect(), holes: Vec::new() }
    }

    fn assert_good(outline: &Outline, fibers: usize, what: &str) {
        let mesh = generate(outline, fibers).unwrap_or_else(|e| panic!("{what}: {e}"));
        let quality = MeshQuality::of(&mesh);
        assert_eq!(mesh.validate(), Ok(()), "{what}");
        assert_eq!((mesh.edges().len(), quality.edges), (fibers, fibers), "{what}");
        assert!(quality.below_20_deg * 1000 <= mesh.triangles.len(), "{what}: {quality:?}");
        assert!((mesh.area() / outline.area() - 1.0).abs() < 0.01, "{what}: {} {}", mesh.area(), outline.area());
        let loops = mesh.boundary();
        assert_eq!(loops.len(), 1 + outline.holes.len(), "{what}");
        for (k, ring) in loops.iter().enumerate() {
            let points: Vec<Point> = ring.iter().map(|&n| mesh.nodes[n]).collect();
            assert_eq!(polygon::signed_area(&points) > 0.0, k == 0, "{what}");
            for p in points {
                assert!(outline.distance(p) < 1e-9, "{what}: {p:?} is off the outline");
            }
        }
    }

    #[test]
    fn counts_are_exact_and_triangles_good_on_random_lobes() {
        for seed in 1..=8 {
            for fibers in [276, 307, 571] {
                assert_good(&lobes(seed), fibers, &format!("lobes {seed}, {fibers}"));
            }
        }
    }

    #[test]
    fn every_count_is_reached() {
        for fibers in 150..180 {
            assert_good(&rectangle(300.0, 60.0), fibers, &format!("bar, {fibers}"));
        }
    }

    #[test]
    fn holes_and_large_meshes_are_good() {
        let mut plate = rectangle(200.0, 150.0);
        plate.holes.push(circle([60.0, 70.0], 25.0, 90).into_iter().rev().collect());
        plate.holes.push(vec![[120.0, 50.0], [120.0, 100.0], [160.0, 100.0], [160.0, 50.0]]);
        for fibers in [400, 1000, 5000] {
            assert_good(&plate, fibers, &format!("plate, {fibers}"));
        }
        assert_good(&lobes(3), 10_000, "lobes, 10000");
    }

    #[test]
    fn corners_are_nodes_and_bars_are_two_triangles_across() {
        let bar = rectangle(300.0, 30.0);
        let mesh = generate(&bar, 200).unwrap();
        for corner in &bar.outer {
            assert!(mesh.nodes.contains(corner));
        }
        assert_eq!(MeshQuality::of(&mesh).bridges, 0);
    }

    #[test]
    fn tracks_are_named_where_they_are_the_cause() {
        let tracked = |track: Vec<Point>| MeshSpec { tracks: vec![track], ..MeshSpec::fibers(60) };
        let along = tracked(vec![[20.0, 30.0], [180.0, 30.0]]);
        for has_given_up in [false, true] {
            let why = refusal(&rectangle(200.0, 60.0), &along, has_given_up);
            assert_eq!(why, MeshError::IntricateTracks);
            assert!(why.to_string().contains("fewer points"), "{why}");
        }
        // Where there is no mesh without them either, or no track at all, it is the outline.
        let none = refusal(&Outline::default(), &along, true);
        assert_eq!(none, MeshError::TooIntricate);
        assert_eq!(refusal(&rectangle(200.0, 60.0), &MeshSpec::fibers(60), true), MeshError::TooIntricate);
    }

    #[test]
    fn the_same_outline_gives_the_same_bits() {
        let outline = lobes(5);
        assert_eq!(generate(&outline, 414), generate(&outline.clone(), 414));
    }

    #[test]
    fn scale_does_not_matter() {
        let scaled = |k: f64| Outline {
            outer: lobes(2).outer.iter().map(|p| [k * p[0], k * p[1]]).collect(),
            holes: Vec::new(),
        };
        for k in [1e-3, 1e3] {
            assert_good(&scaled(k), 414, &format!("scale {k}"));
        }
    }

    #[test]
    fn impossible_counts_name_the_nearest() {
        let comb: Vec<Point> = (0..40)
            .flat_map(|i| {
                let x = 10.0 * f64::from(i);
                [[x, 60.0], [x + 5.0, 60.0], [x + 5.0, 10.0], [x + 10.0, 10.0]]
            })
            .rev()
            .collect();
        let outline = Outline { outer: [vec![[0.0, 0.0], [400.0, 0.0]], comb].concat(), holes: Vec::new() };
        let Err(MeshError::Unreachable { asked: 20, nearest }) = generate(&outline, 20) else { panic!() };
        // A tooth 5 mm wide and 50 mm long takes some 12 boundary edges for angles of 20 degrees and more.
        assert!(nearest > 150 && nearest < 1000, "{nearest}");
        assert!(generate(&outline, nearest).is_ok());
        assert!(matches!(
            generate(&rectangle(1.0, 1.0), usize::MAX),
            Err(MeshError::Unreachable { nearest: MAX_FIBERS, .. })
        ));
        assert_eq!(generate(&Outline::default(), 100), Err(MeshError::BadOutline));
        let flat = Outline { outer: vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], holes: Vec::new() };
        assert_eq!(generate(&flat, 100), Err(MeshError::BadOutline));
    }
}
