//! The guide: a list of parts, and the steps from felt to a plushie that moves.

use super::skin::{self, FACES};
use super::threading::threads;
use super::{routing, winches};
use crate::defaults::CABLE_MM;
use crate::design::Design;
use crate::fabrication::catalogue::{Fit, Kind, Motor};
use crate::fabrication::error::ExportError;
use crate::fabrication::guide::{Block, Guide};
use crate::fabrication::preset::Preset;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::sheet::Sheet;
use crate::fabrication::winch::{housing, housing_solid, spool};
use crate::motion::winch_labels;
use crate::numbers;
use crate::outline::polygon::{bounding_box, length, signed_area};

/// Sewing thread over the length of the seam: a back stitch by hand.
const THREAD_PER_SEAM: f64 = 3.0;
/// Stuffing in a litre of a toy, g. Unconfirmed: polyester fibre, firmly stuffed.
const STUFFING_G_PER_L: f64 = 35.0;
/// Grams of plastic in a cubic millimetre: PLA.
const PLASTIC_G_PER_MM3: f64 = 1.24e-3;
/// Space around a piece on its picture, mm.
const MARGIN_MM: f64 = 5.0;

/// The guide `assembly`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let mut guide = Guide { title: format!("{}: parts and assembly", source.design.name), blocks: Vec::new() };
    let motor = source.options.motors.choice(source.demands(), source.design.fabrication.spool_radius_mm);
    parts(&mut guide, source, motor);
    if !source.remarks.is_empty() {
        guide.heading("Watch out");
        guide.blocks.push(Block::Steps(source.remarks.iter().map(|remark| remark.text.clone()).collect()));
    }
    guide.heading("Steps");
    guide.blocks.push(Block::Steps(steps(source, motor)));
    pictures(&mut guide, source, motor);
    mounting(&mut guide, source, motor);
    wiring(&mut guide, source, motor);
    let text = "  Parts list, steps, pictures, mounting and wiring, to be read on a screen or printed.\n";
    Ok(Part {
        products: vec![Product::new("assembly", Content::Guide(guide))],
        guide: text.into(),
        remarks: Vec::new(),
    })
}

fn parts(guide: &mut Guide, source: &Source<'_>, motor: &Motor) {
    let (design, piece) = (source.design, source.piece());
    let (low, high) = bounding_box(&piece.rim);
    let cut: f64 = piece.cut_outs.iter().map(|ring| signed_area(ring).abs()).sum();
    let felt_cm2 = 2.0 * (signed_area(&piece.rim).abs() - cut) / 100.0;
    let seam = |line: &[[f64; 2]]| line.windows(2).map(|s| length(s[0], s[1])).sum::<f64>();
    let inner: f64 = piece.inner_seams.iter().map(|ring| crate::outline::polygon::perimeter(ring)).sum();
    let seam_m = (seam(&piece.seam.stitches) + seam(&piece.seam.gap) + inner) / 1000.0;
    let line_m = threads(source.skin).iter().map(|t| 2.0 * t.cut_mm).sum::<f64>() / 1000.0;
    let winches = design.networks.len();
    let spools: f64 = design.networks.iter().map(|n| spool(design, n, motor.shaft_mm).volume_mm3()).sum();
    let housings = winches as f64 * housing_solid(&housing(design), motor).volume_mm3();
    let stuffing_l = source.stuffed().volume_mm3 / 1e6;
    let row = |what: &str, much: String, note: String| vec![what.to_owned(), much, note];
    let rows = vec![
        row(
            "Felt, 2 to 3 mm",
            format!("{felt_cm2:.0} cm^2"),
            format!("two pieces of {:.0} x {:.0} mm, front and mirrored back", high[0] - low[0], high[1] - low[1]),
        ),
        row(
            "Sewing thread",
            format!("{:.1} m", THREAD_PER_SEAM * seam_m),
            format!("a seam of {seam_m:.2} m in back stitch"),
        ),
        row(
            "Stuffing",
            format!("{:.0} g", STUFFING_G_PER_L * stuffing_l),
            format!("{stuffing_l:.2} l, firmly stuffed"),
        ),
        row(
            "Braided fishing line",
            format!("{line_m:.1} m"),
            format!("{CABLE_MM} mm; {} threads, lengths in threading.csv", 2 * threads(source.skin).len()),
        ),
        row(
            "Printed spools",
            winches.to_string(),
            format!("winch-N-spool, {:.0} g of PLA in all", PLASTIC_G_PER_MM3 * spools),
        ),
        row(
            "Printed housings",
            winches.to_string(),
            format!("winch-housing, {:.0} g of PLA in all", PLASTIC_G_PER_MM3 * housings),
        ),
        row("Motors", winches.to_string(), motors(source, motor)),
        row("Set screws M3 x 6", winches.to_string(), "clamp the spools on their shafts".into()),
        row("Motor screws", (motor.screws * winches).to_string(), screws(motor)),
        row("Control", "1".into(), control(motor).into()),
        row(
            "Tools",
            String::new(),
            "blunt large-eyed needle, sewing needle, pins, scissors, a stick to turn and stuff with".into(),
        ),
    ];
    guide.heading("Parts");
    let names = ["part", "how much", "what"].map(String::from).to_vec();
    guide.blocks.push(Block::Rows { names, rows });
}

/// Which motor, and whether it does.
fn motors(source: &Source<'_>, motor: &Motor) -> String {
    let radius_mm = source.design.fabrication.spool_radius_mm;
    let fits = source.demands().iter().filter(|d| matches!(motor.fit(d, radius_mm), Fit::Fits(_))).count();
    match source.demands().len() - fits {
        0 => format!("{}, or another one that fits (motors.csv)", motor.name),
        misfits => format!(
            "{} is the strongest of the catalogue, and not enough for {misfits} of {} winches (see below): what is drawn here is made for it",
            motor.name,
            source.demands().len()
        ),
    }
}

fn screws(motor: &Motor) -> String {
    match motor.screws {
        0 => "none: the motor is held by its own ears".into(),
        _ => format!("M{} on a circle of {} mm", motor.screw_mm, motor.screw_circle_mm),
    }
}

/// Whether servos of a kind are told over a serial line, by their names.
fn is_on_bus(motor: &Motor) -> bool {
    motor.name.to_lowercase().contains("bus")
}

fn control(motor: &Motor) -> &'static str {
    match motor.kind {
        Kind::Gearmotor => "a position controller with an encoder input for each motor, and its supply",
        Kind::Servo if is_on_bus(motor) => {
            "a serial adapter for the bus of these servos, and the supply that their data sheet names"
        }
        Kind::Servo => {
            "a microcontroller (and a servo driver such as the PCA9685 for more than a few), and a supply of 5 to 6 V"
        }
        Kind::Stepper => "a board with GRBL or the like and a driver for each motor, and its supply",
    }
}

fn steps(source: &Source<'_>, motor: &Motor) -> Vec<String> {
    let piece = source.piece();
    let gap = piece.seam.gap_mm;
    let mut steps = vec![
        "Cut front and back (pattern). Lasers cut the holes first; from paper, mark them with a pen through the felt and punch them.".to_owned(),
        "Lay the two pieces on each other, outer sides facing, so that the short marks on their rims meet. Pin them.".to_owned(),
        format!("Sew along the stitch line, and leave {gap:.0} mm open where it is marked."),
    ];
    if !piece.closed.is_empty() {
        steps.push(format!(
            "Snip the allowance along the dotted lines ({} places with letters), to 2 mm before the stitches, or the corners will pucker.",
            piece.closed.len()
        ));
    }
    steps.extend([
        "Turn the skin through the opening, and push out every limb with the stick.".to_owned(),
        format!("Print spools and housings. Screw each housing to its motor ({}), set the spool on the shaft, and clamp it.", motor.name),
        "Cut the threads (threading.csv) and knot one end of each into the slit of its groove; wind one turn and a half. Every second groove is for \
         the back."
            .to_owned(),
        "Put the motors in through the opening, each with its outlets to the two openings in the felt, and sew the ears to the felt of both sides. Lead \
         the wires out through the opening in the seam."
            .to_owned(),
        "Lead each thread out of its winch's opening and through its holes, over and under the felt in turn (routing), front and back alike. Do not \
         knot it yet."
            .to_owned(),
        "Stuff limb by limb, firmly around the housings, so that nothing rattles. Close the seam by hand around the wires.".to_owned(),
        zero(source.design).to_owned(),
        "Send setup once, then motion as often as you like; stop before you let go (README).".to_owned(),
    ]);
    steps
}

/// How threads are when the motors are at zero.
fn zero(design: &Design) -> &'static str {
    if design.networks.iter().flat_map(|network| &network.tendons).any(|tendon| tendon.slack_mm != 0.0) {
        "Pull each thread just straight, with all motors at rest, let it out again by its slack (in the list of threads below), and knot it at its last \
         hole. This is the zero of the motors: a thread with slack pulls later than the others of its winch."
    } else {
        "Pull each thread just straight, with all motors at rest, and knot it at its last hole. This is the zero of the motors."
    }
}

fn pictures(guide: &mut Guide, source: &Source<'_>, motor: &Motor) {
    guide.heading("The skin");
    for face in &FACES {
        let piece = source.piece();
        let (low, high) = bounding_box(&piece.rim);
        let (side, left) = if face.mirrored { (-1.0, high[0]) } else { (1.0, -low[0]) };
        let place = |p: [f64; 2]| [side * p[0] + left + MARGIN_MM, p[1] - low[1] + MARGIN_MM];
        let sheet = Sheet {
            title: face.title.into(),
            width_mm: high[0] - low[0] + 2.0 * MARGIN_MM,
            height_mm: high[1] - low[1] + 2.0 * MARGIN_MM,
            groups: skin::drawn(source.skin, piece, face, &Preset::paper(), place),
        };
        guide.figure(sheet, format!("{}: thick lines are cut, dashed ones sewn, dotted ones snipped.", face.title));
    }
    guide.heading("The threads");
    for back in [false, true] {
        let sheet = routing::sheet(source.skin, source.piece(), back);
        guide.figure(sheet, "Threads over the felt are thick, those under it thin; the dot is the knot.");
    }
    let names = ["winch", "tendon", "groove front, back", "at rest (mm)", "of it slack (mm)", "cut (mm)", "way"];
    let rows = threads(source.skin).into_iter().map(|t| {
        let grooves = format!("{}, {}", t.groove(false), t.groove(true));
        let [rest, slack] = [t.length_mm, t.slack_mm].map(|mm| numbers::plain(mm, 1));
        vec![t.winch.clone(), t.tendon.to_string(), grooves, rest, slack, format!("{:.0}", t.cut_mm), t.way()]
    });
    guide.blocks.push(Block::Rows { names: names.map(String::from).to_vec(), rows: rows.collect() });
    guide.heading("The winches");
    for sheet in winches::drawings(source, motor) {
        guide.figure(sheet, "Spool and housing; dimensions in mm.");
    }
}

fn mounting(guide: &mut Guide, source: &Source<'_>, motor: &Motor) {
    let housing = housing(source.design);
    guide.heading("Mounting motors in a plush");
    guide.text(format!(
        "A motor in stuffing turns itself instead of its spool unless something holds it. Here that is the housing: its ears lie between the two sheets \
         of felt, one to either side of the winch's opening, and are sewn to both with five stitches a hole. The housing with {} is {:.0} mm wide over the \
         ears and {:.0} mm thick; the motor behind it lies along the body.",
        motor.name,
        housing.span_mm(),
        2.0 * housing.outer_radius_mm
    ));
    guide.blocks.push(Block::Steps(vec![
        "Let the axis lie in the plane of the felt, the open end towards most of the holes. One outlet looks at the front, the other at the back.".into(),
        "A servo without a screw circle is held by its own ears: screw them to a plate of 3 mm plywood as wide as the housing's ears, glue the housing's \
         floor to it, and set the spool on the servo's horn."
            .into(),
        "Push stuffing firmly behind the motor before the seam is closed: it must not tip when you pull a thread with two fingers.".into(),
        "Wrap wires where they leave the body, leave them a hand's breadth longer than the body bends, and knot them inside as a strain relief.".into(),
        "A motor that stalls gets hot: felt and stuffing do not let the heat out. Set the current limit, and stop when it smells.".into(),
    ]));
}

fn wiring(guide: &mut Guide, source: &Source<'_>, motor: &Motor) {
    guide.heading("Wiring");
    let kind = match motor.kind {
        Kind::Gearmotor => {
            "Each motor and its encoder go to a controller; the controllers share the supply and, on a network, the serial line. Give each its node \
             number before they are on one line."
        }
        Kind::Servo if is_on_bus(motor) => {
            "The servos share one line to the adapter and a supply of their own. Give each its number before they are on one line."
        }
        Kind::Servo => {
            "Signal wires go to the channels below; plus and minus to a supply of their own, not to the microcontroller's 5 V. Join the minus of both."
        }
        Kind::Stepper => {
            "Each motor goes to the driver of an axis of the board. Set its current to what the motor is rated for."
        }
    };
    guide.text(kind);
    let rows = winch_labels(source.design).into_iter().zip(source.demands()).enumerate().map(|(i, (name, demand))| {
        let axis = ["X", "Y", "Z", "A", "B", "C"].get(i).map_or_else(|| "-".to_owned(), |a| (*a).to_owned());
        let wound = format!("{:.1} mm, {:.0} degrees", demand.wound_mm, demand.turn_degrees);
        vec![name, (i + 1).to_string(), i.to_string(), axis, wound, format!("{:.0} N mm", demand.torque_nmm)]
    });
    let names = ["winch", "node", "servo channel", "axis", "winds", "torque"].map(String::from).to_vec();
    guide.blocks.push(Block::Rows { names, rows: rows.collect() });
}
