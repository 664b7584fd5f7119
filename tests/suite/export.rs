//! The blueprint, read back with other parsers and compared with closed forms.

use crate::support::{Random, rectangle, rigged};
use plushwright::design::{Design, Easing, Keyframe, MaterialPoint, Network, Tendon, animation};
use plushwright::fabrication::{self, ExportError, Manifest, Options, Remark, SheetSize, Topic, blueprint, export};
use plushwright::files::folder::FolderError;
use plushwright::motion::{MotionError, Plan, TooFast, winch_labels};
use roxmltree::{Document, Node};
use sha2::{Digest, Sha256};
use std::f64::consts::PI;
use std::fs;
use std::path::Path;

/// A sheet that is large enough for all pieces of anything.
fn on_one_sheet() -> Options {
    Options { too_fast: TooFast::Stretch, sheet: SheetSize { size_mm: [1e4; 2] }, ..Options::default() }
}

/// A file of a blueprint as text; motions that no motor can follow are stretched.
fn text(design: &Design, name: &str) -> String {
    let (files, _) = blueprint(design, &on_one_sheet()).expect("a blueprint");
    let file = files.into_iter().find(|f| f.name == name).expect(name);
    String::from_utf8(file.bytes).expect("text")
}

fn group<'a>(svg: &'a Document, id: &str) -> Node<'a, 'a> {
    svg.descendants().find(|n| n.attribute("id") == Some(id)).unwrap_or_else(|| panic!("no group {id}"))
}

fn figure(node: Node, name: &str) -> f64 {
    node.attribute(name).and_then(|v| v.parse().ok()).unwrap_or_else(|| panic!("{name} of {node:?}"))
}

/// Points of a path of straight lines, and whether it is closed.
fn path(node: Node) -> (Vec<[f64; 2]>, bool) {
    let d = node.attribute("d").expect("a path");
    let numbers: Vec<f64> =
        d.split(['M', 'L', 'Z', ' ']).filter(|s| !s.is_empty()).map(|s| s.parse().expect("a number")).collect();
    (numbers.chunks(2).map(|p| [p[0], p[1]]).collect(), d.ends_with('Z'))
}

/// The elements of a layer of all pieces.
fn layer<'a>(svg: &'a Document, name: &str) -> Vec<Node<'a, 'a>> {
    let ids = ["front", "back"].map(|piece| format!("{piece}-{name}"));
    let of_layer = |n: &Node| n.attribute("id").is_some_and(|id| ids.iter().any(|own| own == id));
    svg.descendants().filter(of_layer).flat_map(|group| group.children().filter(Node::is_element)).collect()
}

fn lines(elements: Vec<Node>) -> Vec<(Vec<[f64; 2]>, bool)> {
    elements.into_iter().filter(|n| n.has_tag_name("path")).map(path).collect()
}

fn paths(group: Node) -> Vec<(Vec<[f64; 2]>, bool)> {
    group.children().filter(|n| n.has_tag_name("path")).map(path).collect()
}

fn area(p: &[[f64; 2]]) -> f64 {
    let n = p.len();
    (0..n).map(|i| 0.5 * (p[i][0] * p[(i + 1) % n][1] - p[(i + 1) % n][0] * p[i][1])).sum::<f64>().abs()
}

fn length(p: &[[f64; 2]]) -> f64 {
    p.windows(2).map(|s| (s[1][0] - s[0][0]).hypot(s[1][1] - s[0][1])).sum()
}

fn words(group: Node) -> String {
    group.descendants().filter_map(|n| n.text()).collect::<Vec<_>>().join("|")
}

#[test]
fn sheets_are_in_mm_with_a_reference_line() {
    for name in ["pattern.svg", "routing-front.svg", "routing-back.svg", "stuffed.svg", "winch-1.svg"] {
        let xml = text(&rigged(), name);
        let svg = Document::parse(&xml).expect("XML");
        let root = svg.root_element();
        let view: Vec<f64> =
            root.attribute("viewBox").expect("a view box").split(' ').map(|v| v.parse().unwrap()).collect();
        let mm = |name| root.attribute(name).and_then(|v| v.strip_suffix("mm")).and_then(|v| v.parse().ok());
        assert_eq!(view, [0.0, 0.0, mm("width").expect("mm"), mm("height").expect("mm")]);
        let lines = paths(group(&svg, "reference"));
        assert_eq!(lines.len(), 1);
        let (line, closed) = &lines[0];
        assert!(!closed && line.len() == 2 && line[0][1] == line[1][1]);
        assert_eq!(line[1][0] - line[0][0], 100.0);

        // The same with usvg, which works in pixels of 1/96 inch.
        let tree = usvg::Tree::from_str(&xml, &usvg::Options::default()).expect("SVG");
        let px_per_mm = 96.0 / 25.4;
        assert!((f64::from(tree.size().width()) / px_per_mm - view[2]).abs() < 1e-3);
        let Some(usvg::Node::Group(reference)) = tree.node_by_id("reference") else { panic!("no reference group") };
        let width = f64::from(reference.abs_bounding_box().width()) / px_per_mm;
        assert!((width - 100.0).abs() < 1e-3, "{width} mm");
        let all = tree.root().abs_bounding_box();
        assert!(all.left() >= 0.0 && all.top() >= 0.0);
        assert!(all.right() <= tree.size().width() && all.bottom() <= tree.size().height(), "{name} leaves its sheet");
    }
}

#[test]
fn the_pattern_has_two_pieces_in_the_order_of_the_laser() {
    let design = rigged();
    let xml = text(&design, "pattern.svg");
    let svg = Document::parse(&xml).expect("XML");
    let groups: Vec<_> =
        svg.root_element().children().filter(|n| n.has_tag_name("g")).filter_map(|n| n.attribute("id")).collect();
    assert_eq!(groups, ["front", "back", "reference"], "a group a piece");
    for piece in ["front", "back"] {
        let own = group(&svg, piece);
        let layers: Vec<_> = own.children().filter_map(|n| n.attribute("id")).collect();
        assert_eq!(layers[..3], ["holes", "cut", "stitch"].map(|layer| format!("{piece}-{layer}")));
        let cut = group(&svg, &format!("{piece}-cut"));
        assert_eq!((cut.attribute("stroke"), cut.attribute("fill")), (Some("#FF0000"), Some("none")));
        assert_eq!(figure(cut, "stroke-width"), 0.01);
        assert_eq!(group(&svg, &format!("{piece}-stitch")).attribute("stroke"), Some("#0000FF"));
        // Seven nodes carry cables; two of them are winches, with openings. Every hole is cut before the rim.
        let kinds: Vec<_> = group(&svg, &format!("{piece}-holes"))
            .children()
            .filter(Node::is_element)
            .map(|n| (n.tag_name().name(), figure(n, "r")))
            .collect();
        assert_eq!(kinds.iter().filter(|k| **k == ("circle", 0.75)).count(), 5);
        assert_eq!((kinds.iter().filter(|k| **k == ("circle", 4.0)).count(), kinds.len()), (2, 7));
    }
    let holes: Vec<Node> = layer(&svg, "holes").into_iter().filter(|n| n.has_tag_name("circle")).collect();

    // The outline grows by Steiner's formula: A + P a + pi a^2.
    let outlines = lines(layer(&svg, "cut"));
    assert_eq!(outlines.len(), 2);
    let allowance = design.fabrication.seam_allowance_mm;
    let grown = 120.0 * 80.0 + 400.0 * allowance + PI * allowance * allowance;
    for (points, closed) in &outlines {
        assert!(*closed && (area(points) - grown).abs() < 1.0, "{} instead of {grown}", area(points));
    }

    // The seam is the silhouette itself, less the turning gap.
    let seams = lines(layer(&svg, "stitch"));
    assert_eq!(seams.len(), 2);
    for (points, closed) in &seams {
        assert!(!closed && (length(points) - 350.0).abs() < 0.01, "{}", length(points));
        assert!((area(points) - 120.0 * 80.0).abs() < 0.1);
        let bottom = points.iter().map(|p| p[1]).fold(0.0, f64::max);
        assert!((points[0][1] - bottom).abs() < 1e-9 && (points[points.len() - 1][1] - bottom).abs() < 1e-9);
    }

    // Front: a hole lies where its point of the body is. Back: its mirror image.
    let low = |points: &[[f64; 2]], k: usize| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
    let high = |points: &[[f64; 2]], k: usize| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
    let (front, back) = (&seams[0].0, &seams[1].0);
    for (i, [x, y]) in fabrication::holes(&design).into_iter().enumerate() {
        let (a, b) = (holes[i], holes[i + 7]);
        assert!((figure(a, "cx") - low(front, 0) - x).abs() < 1e-3);
        assert!((high(back, 0) - figure(b, "cx") - x).abs() < 1e-3);
        assert!((high(front, 1) - figure(a, "cy") - y).abs() < 1e-3);
        assert_eq!(figure(a, "cy"), figure(b, "cy"));
    }
    let words = words(group(&svg, "front-note")) + &words(group(&svg, "back-note"));
    for word in ["FRONT", "BACK (mirrored)", "pin 1", "leave 50 mm open", "7"] {
        assert!(words.contains(word), "{words}");
    }
}

#[test]
fn inner_holes_are_sewn_and_cut_smaller_before_the_outline() {
    let mut design = rigged();
    design.outline.holes = vec![vec![[40.0, 20.0], [40.0, 60.0], [80.0, 60.0], [80.0, 20.0]]];
    let xml = text(&design, "pattern.svg");
    let svg = Document::parse(&xml).expect("XML");
    let cut_outs: Vec<f64> = lines(layer(&svg, "cut-outs")).iter().map(|(p, _)| area(p)).collect();
    let rims: Vec<f64> = lines(layer(&svg, "cut")).iter().map(|(p, _)| area(p)).collect();
    assert_eq!((cut_outs.len(), rims.len()), (2, 2));
    assert!(cut_outs.iter().all(|a| (a - 24.0 * 24.0).abs() < 0.01) && rims.iter().all(|a| *a > 12800.0));
    let order: Vec<_> = group(&svg, "front").children().filter_map(|n| n.attribute("id")).collect();
    let at = |id: &str| order.iter().position(|o| *o == id).expect(id);
    assert!(at("front-cut-outs") < at("front-cut"));
    assert_eq!(lines(layer(&svg, "stitch")).iter().filter(|(p, closed)| *closed && area(p) == 1600.0).count(), 2);
}

#[test]
fn a_narrow_notch_is_remarked() {
    let mut design = rigged();
    // A slot of 10 mm between two legs, wider at its end: the allowances of 8 mm meet over it.
    design.outline.outer = vec![
        [0.0, 0.0],
        [55.0, 0.0],
        [55.0, 30.0],
        [40.0, 30.0],
        [40.0, 60.0],
        [80.0, 60.0],
        [80.0, 30.0],
        [65.0, 30.0],
        [65.0, 0.0],
        [120.0, 0.0],
        [120.0, 80.0],
        [0.0, 80.0],
    ];
    let (_, manifest) = blueprint(&design, &Options::default()).expect("a blueprint");
    assert!(manifest.remarks.iter().any(|r| r.contains("narrow notch")), "{:?}", manifest.remarks);
    // And snipped, on both pieces; what is left of the slot's end is cut out, as it is wider than 2 mm.
    let xml = text(&design, "pattern.svg");
    let svg = Document::parse(&xml).expect("XML");
    assert!(lines(layer(&svg, "snips")).len() >= 2);
}

#[test]
fn holes_on_the_seam_are_remarked() {
    let mut design = rigged();
    let (_, manifest) = blueprint(&design, &Options::default()).expect("a blueprint");
    assert!(!manifest.remarks.iter().any(|r| r.contains("from the seam")), "{:?}", manifest.remarks);
    design.networks[0].tendons[0].routing = MaterialPoint::through([10, 0]);
    let (_, manifest) = blueprint(&design, &Options::default()).expect("a blueprint");
    let told = |r: &&Remark| r.contains("tendon 1: hole 1 from the winch is 0.0 mm from the seam");
    assert_eq!(manifest.remarks.iter().filter(told).count(), 1, "{:?}", manifest.remarks);
    // Such a hole is marked, not cut.
    assert!(manifest.remarks.iter().any(|r| r.starts_with("Marked, not cut")), "{:?}", manifest.remarks);
    let xml = text(&design, "pattern.svg");
    let svg = Document::parse(&xml).expect("XML");
    let seams = lines(layer(&svg, "stitch"));
    for hole in layer(&svg, "holes") {
        let at = [figure(hole, "cx"), figure(hole, "cy")];
        let near = seams.iter().flat_map(|(line, _)| line.windows(2)).map(|s| away(s[0], s[1], at));
        assert!(near.fold(f64::INFINITY, f64::min) - figure(hole, "r") >= 3.0 - 1e-3);
    }
}

/// Distance of a point from a segment.
fn away(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let (d, w) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let t = ((d[0] * w[0] + d[1] * w[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
    (w[0] - t * d[0]).hypot(w[1] - t * d[1])
}

#[test]
fn what_no_hand_can_sew_is_remarked_the_worst_first_and_counted() {
    let mut design = rigged();
    design.sewing.lead_mm = 0.0;
    let remarks = |design: &Design| {
        let (_, manifest) = blueprint(design, &Options::default()).expect("a blueprint");
        manifest.remarks.into_iter().filter(|r| r.starts_with("Hard to sew: ")).collect::<Vec<_>>()
    };
    // The one tendon turns by 90 degrees at node 11.
    assert_eq!(
        remarks(&design),
        ["Hard to sew: right, tendon 1: turns by 90.0 degrees at hole 1 from the winch, more than 75.0."]
    );
    design.sewing.hole_to_seam_mm = 30.0;
    let told = remarks(&design);
    let holes = design.networks.iter().flat_map(|n| &n.tendons).map(|t| t.routing.len()).sum::<usize>() - 1;
    assert_eq!(told.len(), 6);
    let breaches = design.breaches().len();
    assert!(breaches > 6 && breaches <= holes + 1, "{breaches}");
    assert_eq!(told[5].text, format!("Hard to sew: {} more places break a rule.", breaches - 5));
    design.sewing.turn_degrees = 180.0;
    design.sewing.hole_to_seam_mm = 0.0;
    assert_eq!(remarks(&design), [""; 0]);
}

#[test]
fn routings_are_drawn_and_tabled() {
    let mut design = rigged();
    design.networks[1].tendons[0].slack_mm = 2.5;
    let csv = text(&design, "routing.csv");
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], "winch,tendon,length_mm,points");
    assert_eq!(lines[1], "left,1,40.000000,60.000000 20.000000;40.000000 20.000000;20.000000 20.000000");
    let fields: Vec<Vec<&str>> = lines[1..].iter().map(|l| l.split(',').collect()).collect();
    assert_eq!(fields.iter().map(|f| (f[0], f[1])).collect::<Vec<_>>(), [("left", "1"), ("left", "2"), ("right", "1")]);
    for f in &fields {
        let points: Vec<[f64; 2]> = f[3]
            .split(';')
            .map(|p| p.split_once(' ').expect("x y"))
            .map(|(x, y)| [x.parse().expect("x"), y.parse().expect("y")])
            .collect();
        let slack = if f[0] == "right" { 2.5 } else { 0.0 };
        assert!((length(&points) + slack - f[2].parse::<f64>().expect("a length")).abs() < 1e-5);
    }

    let xml = text(&design, "routing-front.svg");
    let svg = Document::parse(&xml).expect("XML");
    let tendons = ["tendon-1-1", "tendon-1-2", "tendon-2-1"].map(|id| group(&svg, id));
    let mut colors: Vec<_> = tendons.iter().filter_map(|g| g.attribute("stroke")).collect();
    colors.dedup();
    assert_eq!(colors.len(), 3);
    // Over the felt to the first hole, under it to the second.
    for id in ["tendon-1-1", "tendon-1-1-under"] {
        assert!((length(&paths(group(&svg, id))[0].0) - 20.0).abs() < 1e-3, "{id}");
    }
    let winches: Vec<Node> = group(&svg, "winch").children().filter(|n| n.has_tag_name("circle")).collect();
    assert_eq!((winches.len(), group(&svg, "winch").attribute("fill")), (2, Some("#FFD400")));
    // Five holes beside the openings of the winches, and two rings at each of three knots.
    assert_eq!(group(&svg, "holes").children().filter(|n| n.has_tag_name("circle")).count(), 5 + 6);
    assert!(words(group(&svg, "note")).contains("1: 40.0 mm, holes 1-2-3"), "{}", words(group(&svg, "note")));
}

/// Comment settings, header and rows of `tracks.csv`.
fn tracks(csv: &str) -> (Vec<f64>, Vec<String>, Vec<Vec<String>>) {
    let settings = ["encoder_lines", "gear_ratio", "spool_radius_mm"]
        .iter()
        .zip(csv.lines())
        .map(|(key, line)| line.strip_prefix(&format!("# {key}=")).expect(key).parse().expect("a number"))
        .collect();
    let mut rows = csv.lines().skip(3).map(|l| l.split(',').map(String::from).collect());
    (settings, rows.next().expect("a header"), rows.collect())
}

#[test]
fn tracks_follow_the_plan_and_the_counts_formula() {
    let mut design = rigged();
    design.controller.gear_ratio = 43.2;
    design.fabrication.spool_radius_mm = 9.75;
    let (settings, header, rows) = tracks(&text(&design, "tracks.csv"));
    assert_eq!(settings, [512.0, 43.2, 9.75]);
    assert_eq!(header, ["time_s", "left_mm", "left_counts", "right_mm", "right_counts"]);
    assert_eq!(rows.len(), 77, "50 steps of 0.02 s to the keyframe at 1 s, 26 shorter ones to that at 1.51 s");
    let plan = Plan::of(&design, TooFast::Refuse).expect("slow enough");
    for (i, row) in rows.iter().enumerate() {
        let time: f64 = row[0].parse().expect("a time");
        let expected = if i <= 50 { i as f64 / 50.0 } else { 1.0 + 0.51 * (i - 50) as f64 / 26.0 };
        assert!((time - expected).abs() < 1e-6);
        // The first section is a straight line: its corners are rounded.
        let activations = if i < 50 { plan.at(expected) } else { animation::activations_at(&design, expected) };
        for winch in 0..2 {
            let printed = &row[1 + 2 * winch];
            assert_eq!(printed.split_once('.').expect("decimals").1.len(), 6);
            let mm: f64 = printed.parse().expect("a length");
            assert!((mm - activations[winch]).abs() < 1e-6);
            let counts = 4.0 * 512.0 * 43.2 * mm / (2.0 * PI * 9.75);
            assert_eq!(row[2 + 2 * winch].parse::<i64>().expect("integer counts"), counts.round() as i64);
        }
    }
    assert_eq!(rows[0][1..], ["0.000000", "0", "0.000000", "0"], "slack is zero");
    assert_eq!(rows[50][1], "10.000000");
}

#[test]
fn without_keyframes_the_tracks_rest() {
    let mut design = rigged();
    design.keyframes.clear();
    let (_, _, rows) = tracks(&text(&design, "tracks.csv"));
    assert_eq!(rows, [["0.000000", "0.000000", "0", "0.000000", "0"]]);
}

/// A program as (node, command, argument).
fn commands(program: &str) -> Vec<(usize, &str, Option<i64>)> {
    assert!(program.ends_with('\r') && !program.contains('\n') && program.is_ascii());
    program
        .trim_end_matches('\r')
        .split('\r')
        .map(|line| {
            let letters = line.find(|c: char| !c.is_ascii_digit()).expect("a command");
            let argument = line.rfind(|c: char| c.is_ascii_alphabetic()).expect("a command") + 1;
            let value = (argument < line.len()).then(|| line[argument..].parse().expect("a number"));
            (line[..letters].parse().expect("a node"), &line[letters..argument], value)
        })
        .collect()
}

#[test]
fn the_controller_programs_are_valid_commands_for_one_node_a_winch() {
    let design = rigged();
    let setup = text(&design, "controller-ascii-setup.txt");
    let counts = |mm: f64| (4.0 * 512.0 * 43.0 * mm / (2.0 * PI * 10.0)).round() as i64;
    for (node, farthest) in [(1, counts(10.0)), (2, counts(4.0))] {
        let own: Vec<_> =
            commands(&setup).into_iter().filter(|c| c.0 == node).map(|(_, name, value)| (name, value)).collect();
        let limits = [("LL", Some(farthest + 1)), ("LL", Some(-1)), ("APL", Some(1))];
        let currents = [("LPC", Some(500)), ("LCC", Some(500))];
        assert_eq!(own[..4], [("DI", None), ("ANSW", Some(2)), ("ENCRES", Some(2048)), ("HO", Some(0))]);
        assert_eq!(own[4..], [&limits[..], &currents].concat());
    }
    let (_, _, rows) = tracks(&text(&design, "tracks.csv"));
    let motion = text(&design, "controller-ascii-motion.txt");
    let motion = commands(&motion);
    let on = |node| [(node, "AC", Some(30_000)), (node, "DEC", Some(30_000)), (node, "EN", None)];
    assert_eq!(motion[..6], [on(1), on(2)].concat());
    // Every step: the speed and the target of its end for all nodes in order, then their starts.
    let steps = &motion[6..];
    assert_eq!(steps.len(), 6 * (rows.len() - 1));
    for (step, pair) in steps.chunks(6).zip(rows.windows(2)) {
        let at = |row: &[String], node: usize| row[2 * node].parse::<i64>().expect("counts");
        for node in [1, 2] {
            let [speed, target] = [step[2 * node - 2], step[2 * node - 1]];
            let seconds: f64 = pair[1][0].parse::<f64>().expect("a time") - pair[0][0].parse::<f64>().expect("a time");
            let needed = 60.0 * (at(&pair[1], node) - at(&pair[0], node)).abs() as f64 / 2048.0 / seconds;
            assert!(
                (speed.0, speed.1) == (node, "SP")
                    && (needed - 0.1..needed + 1.1).contains(&(speed.2.expect("rpm") as f64))
                    || speed.2 == Some(1)
            );
            assert_eq!(target, (node, "LA", Some(at(&pair[1], node))));
        }
        assert_eq!(step[4..], [(1, "M", None), (2, "M", None)]);
    }
    let stop = text(&design, "controller-ascii-stop.txt");
    let stop = commands(&stop);
    assert!(stop.contains(&(1, "LA", Some(0))) && stop.contains(&(2, "LA", Some(0))));
    assert_eq!(stop[stop.len() - 2..], [(1, "DI", None), (2, "DI", None)]);
    for sent_again in [&motion, &stop] {
        assert!(sent_again.iter().all(|c| c.1 != "HO"), "zero is set once");
    }
}

/// A drive of the classic family: a trapezoid of speed with SP, AC and DEC, planned anew at every M. Written apart from the tool's own
/// simulation. Counts, seconds.
#[derive(Default)]
struct Drive {
    at: f64,
    speed: f64,
    top: f64,
    acceleration: f64,
    loaded: f64,
    goal: f64,
    highest: f64,
}

impl Drive {
    const RESOLUTION: f64 = 2048.0;

    /// Takes a command; whether it begins a move.
    fn obeys(&mut self, name: &str, value: Option<i64>) -> bool {
        let value = value.unwrap_or(0) as f64;
        match name {
            "SP" => self.top = value / 60.0 * Self::RESOLUTION,
            "AC" | "DEC" => self.acceleration = value * Self::RESOLUTION,
            "LA" => self.loaded = value,
            "M" => self.goal = self.loaded,
            _ => {}
        }
        name == "M"
    }

    /// Lets time pass; `look` is given the part of it that is over, and where the drive is.
    fn passes(&mut self, seconds: f64, mut look: impl FnMut(f64, f64)) {
        let ticks = (seconds / 1e-4).ceil().max(1.0);
        let dt = seconds / ticks;
        for k in 0..ticks as usize {
            let rest = self.goal - self.at;
            let most = self.top.min((2.0 * self.acceleration * rest.abs()).sqrt()).min(rest.abs() / dt.max(1e-9));
            let change = self.acceleration * dt;
            self.speed += (rest.signum() * most - self.speed).clamp(-change, change);
            self.at += self.speed * dt;
            self.highest = self.highest.max(self.at);
            look((k + 1) as f64 / ticks, self.at);
        }
    }
}

/// How drives follow a motion. Returns for each node the largest distance to the track and the largest position, counts.
fn followed(motion: &str, rows: &[Vec<String>], nodes: usize) -> Vec<(f64, f64)> {
    let at = |row: usize, column: usize| rows[row][column].parse::<f64>().expect("a figure");
    let all = commands(motion);
    let of = |node: usize| {
        let (mut drive, mut lag, mut step) = (Drive::default(), 0.0_f64, 0);
        for &(_, name, value) in all.iter().filter(|c| c.0 == node) {
            if drive.obeys(name, value) {
                let next = (step + 1).min(rows.len() - 1);
                let (from, to) = (at(step, 2 * node), at(next, 2 * node));
                drive.passes(at(next, 0) - at(step, 0), |part, x| {
                    lag = lag.max((x - (from + (to - from) * part)).abs())
                });
                step = next;
            }
        }
        (lag, drive.highest)
    };
    (1..=nodes).map(of).collect()
}

/// The largest position of a node's drive whose motion breaks off after so many lines, and is sent from its beginning once the drive rests.
fn sent_again(motion: &str, rows: &[Vec<String>], node: usize, lines: usize) -> f64 {
    let time = |row: usize| rows[row.min(rows.len() - 1)][0].parse::<f64>().expect("a figure");
    let all = commands(motion);
    let mut drive = Drive::default();
    for sent in [&all[..lines.min(all.len())], &all] {
        let mut step = 0;
        for &(_, name, value) in sent.iter().filter(|c| c.0 == node) {
            if drive.obeys(name, value) {
                drive.passes(time(step + 1) - time(step), |_, _| ());
                step += 1;
            }
        }
        drive.passes(1.0, |_, _| ());
    }
    drive.highest
}

#[test]
fn a_drive_that_plays_the_motion_stays_on_its_track_however_often_it_is_sent() {
    for bundled in plushwright::design::bundled::ALL {
        let design = bundled.design().expect("a sound design");
        let options = Options { too_fast: TooFast::Stretch, ..Options::default() };
        let (files, _) = blueprint(&design, &options).expect("a blueprint");
        let read = |name: &str| {
            let file = files.iter().find(|f| f.name == name).expect(name);
            String::from_utf8(file.bytes.clone()).expect("text")
        };
        let (_, _, rows) = tracks(&read("tracks.csv"));
        let motion = read("controller-ascii-motion.txt");
        let counts_per_mm =
            4.0 * 512.0 * design.controller.gear_ratio / (2.0 * PI * design.fabrication.spool_radius_mm);
        for (winch, (lag, highest)) in followed(&motion, &rows, design.networks.len()).into_iter().enumerate() {
            let most = rows.iter().map(|row| row[2 + 2 * winch].parse::<f64>().expect("counts")).fold(0.0, f64::max);
            let least_mm = f64::max(1.0, 0.02 * most / counts_per_mm);
            assert!(lag / counts_per_mm <= least_mm, "{}: {:.2} mm", bundled.name, lag / counts_per_mm);
            assert!(highest <= most + 0.5, "{}: beyond the track", bundled.name);
            // Broken off anywhere, it does not go beyond it when it is sent again.
            let lines = commands(&motion).len();
            for broken in (0..lines).step_by(lines / 12 + 1) {
                let highest = sent_again(&motion, &rows, winch + 1, broken);
                assert!(highest <= most + 0.5, "{} after {broken} lines: beyond the track", bundled.name);
            }
            // The limits that were set up hold whatever is sent.
            let limits = commands(&read("controller-ascii-setup.txt"))
                .into_iter()
                .filter(|c| c.0 == winch + 1 && c.1 == "LL")
                .map(|c| c.2)
                .collect::<Vec<_>>();
            assert_eq!(limits, [Some(most as i64 + 1), Some(-1)]);
        }
    }
}

#[test]
fn winch_names_cannot_break_a_table() {
    let mut design = rigged();
    let tendon = Tendon { routing: MaterialPoint::through([3, 4]), ratio: 1.0, slack_mm: 0.0 };
    design.networks = ["left", "left", " a,b\"c|d;#é ", "", "-1+cmd", "left (2)"]
        .map(|name| Network::new(name, vec![tendon.clone()]))
        .to_vec();
    design.keyframes.clear();
    design.sewing.housing_mm = 0.0;
    let labels = winch_labels(&design);
    assert_eq!(labels, ["left", "left (2)", "a_b_c_d__é", "winch 4", "1_cmd", "left (2) (2)"]);
    let (_, header, rows) = tracks(&text(&design, "tracks.csv"));
    assert_eq!((header.len(), rows[0].len()), (13, 13));
    design.name = "</svg> & \"friends\"".into();
    for name in ["pattern.svg", "routing-front.svg", "routing-back.svg"] {
        Document::parse(&text(&design, name)).expect("names are escaped");
    }
}

#[test]
fn what_cannot_be_made_is_refused() {
    let fails = |spoil: &dyn Fn(&mut Design)| {
        let mut design = rigged();
        spoil(&mut design);
        blueprint(&design, &Options::default()).map(drop).expect_err("refused")
    };
    let key = |time_s, mm| Keyframe { time_s, activations_mm: vec![mm; 2], pose: None, easing: Easing::Linear };
    let none = fails(&|d| {
        d.networks.clear();
        d.keyframes.clear();
    });
    assert!(matches!(none, ExportError::NoNetworks) && none.is_input());
    assert!(matches!(fails(&|d| d.pins[0].stiffness = -1.0), ExportError::Invalid(_)));
    assert!(matches!(fails(&|d| d.keyframes.push(key(1e300, 0.0))), ExportError::Motion(MotionError::TooLong { .. })));
    assert!(matches!(fails(&|d| d.keyframes.push(key(2.0, 1e9))), ExportError::Motion(MotionError::TooFar { .. })));
    assert!(matches!(
        fails(&|d| d.controller.encoder_lines = 16384),
        ExportError::Motion(MotionError::EncoderTooFine { lines: 16384 })
    ));
    let many = fails(&|d| {
        d.keyframes.clear();
        d.networks = vec![d.networks[0].clone(); 256];
        d.sewing.housing_mm = 0.0;
    });
    assert!(matches!(many, ExportError::Motion(MotionError::TooManyWinches { winches: 256 })));
}

fn listing(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(dir).expect("a folder").flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn the_manifest_lists_every_other_file() {
    let parent = tempfile::tempdir().expect("a folder");
    let dir = parent.path().join("new/blueprint");
    let manifest = export(&rigged(), &dir, &Options::default()).expect("exported");
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(dir.join("manifest.json")).expect("a manifest")).expect("JSON");
    assert_eq!(serde_json::from_value::<Manifest>(json.clone()).expect("a manifest"), manifest);
    let mut listed = vec!["manifest.json".to_string()];
    for file in json["files"].as_array().expect("a list") {
        let name = file["name"].as_str().expect("a name");
        let bytes = fs::read(dir.join(name)).expect(name);
        assert_eq!(file["bytes"].as_u64(), Some(bytes.len() as u64));
        let digest: String = Sha256::digest(&bytes).iter().map(|b| format!("{b:02x}")).collect();
        assert_eq!(file["sha256"].as_str(), Some(digest.as_str()));
        listed.push(name.into());
    }
    listed.sort();
    assert_eq!(listing(&dir), listed);
    for name in [
        "pattern.svg",
        "pattern.dxf",
        "pattern-a4.pdf",
        "routing-front.svg",
        "routing-back.svg",
        "routing.csv",
        "tracks.csv",
        "controller-ascii-motion.txt",
    ] {
        assert!(listed.contains(&name.to_string()), "{name} is missing");
    }
    // The check value of the SHA-256 standard (FIPS 180-2, "abc").
    let abc = plushwright::fabrication::sha256(b"abc");
    assert_eq!(abc, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

#[test]
fn the_folder_appears_whole_or_not_at_all() {
    let parent = tempfile::tempdir().expect("a folder");
    let dir = parent.path().join("blueprint");
    let mut design = rigged();
    design.networks[0].tendons[0].routing = MaterialPoint::through([10, 10]);
    assert!(export(&design, &dir, &Options::default()).is_err());
    assert!(listing(parent.path()).is_empty(), "a refused design leaves nothing");

    let design = rigged();
    export(&design, &dir, &Options::default()).expect("exported");
    let first = fs::read(dir.join("tracks.csv")).expect("tracks");
    let mut slower = design.clone();
    slower.controller.track_rate_hz = 10.0;
    export(&slower, &dir, &Options::default()).expect("an earlier export is replaced");
    assert_ne!(fs::read(dir.join("tracks.csv")).expect("tracks"), first);
    export(&design, &dir, &Options::default()).expect("and again");
    assert_eq!(fs::read(dir.join("tracks.csv")).expect("tracks"), first, "the same design gives the same bytes");
    assert_eq!(listing(parent.path()), ["blueprint"]);

    fs::write(dir.join("my notes.txt"), "mine").expect("written");
    let refused = export(&design, &dir, &Options::default()).expect_err("somebody's file is in it");
    assert!(
        matches!(&refused, ExportError::Folder(FolderError::NotOurs { found, .. }) if found == "my notes.txt"),
        "{refused}"
    );
    assert_eq!(fs::read_to_string(dir.join("my notes.txt")).expect("still there"), "mine");

    let other = parent.path().join("other");
    fs::create_dir(&other).expect("a folder");
    export(&design, &other, &Options::default()).expect("an empty folder is fine");
    let file = parent.path().join("file");
    fs::write(&file, "text").expect("written");
    assert!(export(&design, &file, &Options::default()).is_err_and(|e| e.is_input()));
    assert!(export(&design, &file.join("below"), &Options::default()).is_err());
    assert_eq!(listing(parent.path()), ["blueprint", "file", "other"]);
}

#[test]
fn any_valid_design_makes_a_blueprint() {
    let mut random = Random(11);
    for _ in 0..30 {
        let mut design = rectangle(random.between(10.0, 600.0), random.between(10.0, 600.0), 4, 3);
        let size = design.outline.outer.iter().flatten().copied().fold(0.0, f64::max);
        design.fabrication.seam_allowance_mm = random.between(0.0, 0.1 * size);
        design.fabrication.turning_gap_mm = random.between(0.0, 200.0);
        design.networks = (0..1 + random.below(6)).map(|_| random.network(&design.mesh)).collect();
        // Winches at random may be in one place.
        design.sewing.housing_mm = 0.0;
        design.keyframes = (0..random.below(4))
            .map(|i| {
                let activations_mm = design.networks.iter().map(|_| random.between(0.0, 50.0)).collect();
                Keyframe {
                    time_s: i as f64 + random.between(0.0, 0.9),
                    activations_mm,
                    pose: None,
                    easing: Easing::Smooth,
                }
            })
            .collect();
        let (files, _) = blueprint(&design, &on_one_sheet()).expect("a blueprint");
        for name in ["pattern.svg", "routing-front.svg", "routing-back.svg"] {
            let file = files.iter().find(|file| file.name == name).expect(name);
            let xml = std::str::from_utf8(&file.bytes).expect("text");
            assert!(!xml.contains("NaN") && !xml.contains("inf"), "{name}");
            Document::parse(xml).expect("XML");
        }
    }
}

#[test]
fn the_bundled_outlines_make_good_patterns() {
    for name in ["e", "pig", "puppy", "robot", "s", "squid"] {
        let svg = fs::read(format!("assets/{name}.svg")).expect(name);
        let outline = plushwright::outline::svg::read(&svg, Some(250.0)).expect(name);
        let mesh = plushwright::mesh::generate(&outline, 300).expect(name);
        let mut design = Design::new(name, outline, mesh);
        let mut random = Random(5);
        design.networks = vec![random.network(&design.mesh), random.network(&design.mesh)];
        design.sewing.housing_mm = 0.0;
        let xml = text(&design, "pattern.svg");
        let svg = Document::parse(&xml).expect("XML");
        let outlines = lines(layer(&svg, "cut"));
        let largest = outlines.iter().map(|(p, _)| area(p)).fold(0.0, f64::max);
        assert!(largest > design.outline.area(), "{name}");
        let seams = lines(layer(&svg, "stitch"));
        let (first, last) = (seams[0].0[0], *seams[0].0.last().expect("points"));
        let opening = (last[0] - first[0]).hypot(last[1] - first[1]);
        assert!((49.0..50.001).contains(&opening), "{name}: the gap's ends are {opening} mm apart");
        if let Ok(dir) = std::env::var("PLUSHWRIGHT_KEEP_BLUEPRINTS") {
            export(&design, &Path::new(&dir).join(name), &Options::default()).expect("exported");
        }
    }
}

#[test]
fn two_winches_in_one_hole_are_refused_by_name() {
    let mut design = rigged();
    design.networks[1].tendons[0].routing = MaterialPoint::through([10, 11, 18]);
    let refused = blueprint(&design, &Options::default()).expect_err("one hole").to_string();
    assert!(refused.contains("\"left\" and \"right\" are 0.0 mm apart"), "{refused}");
    // Cables that are pulled by hand have no housings.
    design.sewing.housing_mm = 0.0;
    blueprint(&design, &Options::default()).expect("pulled by hand");
}

#[test]
fn parts_are_chosen_and_the_readme_is_always_there() {
    let only = |topics: Vec<Topic>| {
        let options = Options { only: topics.into(), ..Options::default() };
        let (files, manifest) = blueprint(&rigged(), &options).expect("a blueprint");
        assert_eq!(manifest.files.len() + 1, files.len());
        files.into_iter().map(|f| f.name).collect::<Vec<_>>()
    };
    assert_eq!(only(vec![]), ["README.txt", "manifest.json"]);
    let laser = only(vec![Topic::Laser]);
    assert!(laser.contains(&"pattern.dxf".to_owned()) && !laser.iter().any(|n| n.starts_with("routing")), "{laser:?}");
    let winches = only(vec![Topic::Winches]);
    for name in ["winch-1-spool.stl", "winch-2-spool.3mf", "winch-housing.stl", "winch-1.pdf", "motors.csv"] {
        assert!(winches.contains(&name.to_owned()), "{winches:?}");
    }
    assert!(only(vec![Topic::Guide]).contains(&"assembly.html".to_owned()));
    assert!(only(vec![Topic::Print]).contains(&"pattern-letter.pdf".to_owned()));
}

#[test]
fn sheets_are_as_large_as_asked_for_and_pieces_share_them() {
    let sheets = |size_mm| {
        let options = Options { sheet: SheetSize { size_mm }, ..Options::default() };
        let (files, manifest) = blueprint(&rigged(), &options).expect("a blueprint");
        let names: Vec<String> = files.into_iter().map(|f| f.name).filter(|n| n.ends_with(".svg")).collect();
        let patterns: Vec<String> = names.into_iter().filter(|n| n.starts_with("pattern")).collect();
        (patterns, manifest.remarks.iter().any(|r| r.contains("does not fit on a sheet")))
    };
    // Pieces are 136 x 96 mm.
    assert_eq!(sheets([229.0, 305.0]), (vec!["pattern.svg".to_owned()], false));
    assert_eq!(sheets([165.0, 150.0]).0, ["pattern-1.svg", "pattern-2.svg"]);
    assert_eq!(sheets([150.0, 150.0]), (vec!["pattern-1.svg".to_owned(), "pattern-2.svg".to_owned()], true));
}
