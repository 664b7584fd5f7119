//! Spools and housings to print, their drawings, and which motors fit.

use crate::defaults::CABLE_MM;
use crate::fabrication::buildable::places_of;
use crate::fabrication::catalogue::{Fit, Motor};
use crate::fabrication::demand::{Demand, TOO_FINE};
use crate::fabrication::error::ExportError;
use crate::fabrication::product::{Content, Part, Product, Source};
use crate::fabrication::remark::Remark;
use crate::fabrication::sheet::Sheet;
use crate::fabrication::table::{Column, Table, Values};
use crate::fabrication::winch::{Housing, Spool, drawing, housing, housing_solid, spool, spool_solid};
use crate::motion::winch_labels;

/// Most grooves of a spool: longer ones break, and fit in no body.
const MOST_GROOVES: usize = 60;

/// The solids `winch-1-spool` and so on, the housing and the drawings `winch-1` of each winch, and the table `motors`.
pub(super) fn make(source: &Source<'_>) -> Result<Part, ExportError> {
    let design = source.design;
    let radius = design.fabrication.spool_radius_mm;
    let demands = source.demands();
    let motor = source.options.motors.choice(demands, radius);
    let housing = housing(design);
    let names = winch_labels(design);
    let mut products = Vec::new();
    for (i, (network, sheet)) in design.networks.iter().zip(drawings(source, motor)).enumerate() {
        let spool = spool(design, network, motor.shaft_mm);
        if spool.grooves.len() <= MOST_GROOVES {
            products.push(Product::new(format!("winch-{}-spool", i + 1), Content::Solid(spool_solid(&spool))));
        }
        products.push(Product::new(format!("winch-{}", i + 1), Content::Sheet(sheet)));
    }
    products.push(Product::new("winch-housing", Content::Solid(housing_solid(&housing, motor))));
    products.push(Product::new("motors", Content::Table(table(source, &names))));
    let remarks = remarks(source, &names, &housing);
    Ok(Part { products, guide: guide(&housing, motor), remarks })
}

/// The drawing of each winch.
pub fn drawings(source: &Source<'_>, motor: &Motor) -> Vec<Sheet> {
    let design = source.design;
    let (names, housing) = (winch_labels(design), housing(design));
    let winches = design.networks.iter().zip(names).zip(source.demands()).enumerate();
    winches
        .map(|(i, ((network, name), demand))| {
            let spool = spool(design, network, motor.shaft_mm);
            let own = format!("winch {}", i + 1);
            let called = if name == own { own } else { format!("{own}, {name}") };
            drawing(&format!("{}: {called}", design.name), &words(&spool, demand, motor), &spool, &housing)
        })
        .collect()
}

fn guide(housing: &Housing, motor: &Motor) -> String {
    format!(
        "  Spools and housings for a printer, in mm: a spool a winch, upright with its hub on the bed; as many housings as winches. Two grooves a
  tendon, front and back. The bore is {shaft} mm, for {motor}; an M3 screw through the hub clamps the shaft. Threads of {CABLE_MM} mm lie in one layer,
  their middle at the radius that the tracks are counted with. Knot each thread into the slit of its groove. A housing is {span:.0} mm wide over
  its ears and gets through an opening that is {flat:.0} mm wide when it lies flat; sew it in by the holes of the ears, its outlets to front and
  back. motors.csv: what each winch asks for, and which motors of the catalogue can do it.
",
        shaft = motor.shaft_mm,
        motor = motor.name,
        span = housing.span_mm(),
        flat = housing.flat_mm()
    )
}

fn words(spool: &Spool, demand: &Demand, motor: &Motor) -> Vec<String> {
    let grooves = spool.grooves.iter().enumerate().map(|(i, g)| {
        let face = if g.back { "back" } else { "front" };
        format!("{} tendon {} {face} \u{d8} {:.2}, {:.1} wide", i + 1, g.tendon + 1, 2.0 * g.radius_mm, g.width_mm)
    });
    let grooves: Vec<String> = grooves.collect();
    let mut lines: Vec<String> = vec![format!(
        "Winds up to {:.1} mm ({:.0} degrees), pulls {:.1} N ({:.0} N mm), turns at {:.0} rpm at most.",
        demand.wound_mm, demand.turn_degrees, demand.pull_n, demand.torque_nmm, demand.speed_rpm
    )];
    lines.push(format!("Bore for {}. Grooves from the hub outward:", motor.name));
    lines.extend(grooves.chunks(2).map(|pair| pair.join("; ")));
    lines
}

/// Winch by winch and motor by motor: what is asked for and whether it fits.
fn table(source: &Source<'_>, names: &[String]) -> Table {
    let radius = source.design.fabrication.spool_radius_mm;
    let motors = source.options.motors.motors();
    let pairs = || names.iter().zip(source.demands()).flat_map(|(n, d)| motors.iter().map(move |m| (n, d, m)));
    let figures = |f: &dyn Fn(&Demand) -> f64| Values::Figures(pairs().map(|(_, d, _)| f(d)).collect());
    let said = |motor: &Motor, demand: &Demand| match motor.fit(demand, radius) {
        Fit::Fits(margin) if margin.is_finite() => format!("fits {margin:.1} times"),
        Fit::Fits(_) => "fits".into(),
        Fit::TooWeak(missing) => format!("too weak by {missing:.0} N mm"),
        Fit::TooSlow(missing) => format!("too slow by {missing:.0} rpm"),
        Fit::TurnsTooLittle(radius) => format!("turns too little: a spool of {radius:.1} mm radius would do"),
    };
    let columns = vec![
        Column::new("winch", Values::Words(pairs().map(|(n, ..)| n.clone()).collect())),
        Column::new("torque_nmm", figures(&|d| d.torque_nmm)),
        Column::new("speed_rpm", figures(&|d| d.speed_rpm)),
        Column::new("turn_degrees", figures(&|d| d.turn_degrees)),
        Column::new("motor", Values::Words(pairs().map(|(.., m)| m.name.clone()).collect())),
        Column::new("fit", Values::Words(pairs().map(|(_, d, m)| said(m, d)).collect())),
    ];
    Table { settings: vec![("spool_radius_mm", radius.to_string())], columns }
}

fn remarks(source: &Source<'_>, names: &[String], housing: &Housing) -> Vec<Remark> {
    let radius = source.design.fabrication.spool_radius_mm;
    let motors = source.options.motors.motors();
    let mut remarks = Vec::new();
    for (winch, (name, demand)) in names.iter().zip(source.demands()).enumerate() {
        let fits = motors.iter().filter(|m| matches!(m.fit(demand, radius), Fit::Fits(_))).count();
        if fits == 0 {
            let words = format!(
                "No motor of the catalogue fits winch {name:?}: it asks for {:.0} N mm at {:.0} rpm. Give its cables fewer turns, move its keyframes \
                 apart, use a smaller spool, or add a stronger motor to the table.",
                demand.torque_nmm, demand.speed_rpm
            );
            remarks.push(Remark::at(places_of(source.design, [winch]), words));
        }
    }
    if source.design.mesh.triangles.len() > TOO_FINE {
        remarks.push(
            "The mesh is too fine to simulate the pull of the cables here: the torques of motors.csv are 0.".into(),
        );
    }
    let networks = source.design.networks.iter().zip(names).enumerate();
    let crowded = networks.filter(|(_, (network, _))| 2 * network.tendons.len() > MOST_GROOVES);
    let (winches, crowded): (Vec<usize>, Vec<&str>) = crowded.map(|(winch, (_, name))| (winch, name.as_str())).unzip();
    if !crowded.is_empty() {
        let words = format!("More than {MOST_GROOVES} threads, too many for a spool to print: {}.", crowded.join(", "));
        remarks.push(Remark::at(places_of(source.design, winches), words));
    }
    let short = |m: &&Motor| {
        let fit = |d: &Demand| matches!(m.fit(d, radius), Fit::TurnsTooLittle(_));
        source.demands().iter().any(fit)
    };
    let servos: Vec<&str> = motors.iter().filter(short).map(|m| m.name.as_str()).collect();
    let farthest = source.demands().iter().map(|d| d.turn_degrees).fold(0.0, f64::max);
    if !servos.is_empty() {
        let least = motors.iter().filter(short).filter_map(|m| m.turn_degrees).fold(f64::INFINITY, f64::min);
        let words = format!(
            "Winches turn by up to {farthest:.0} degrees, which these cannot: {}. A spool of {:.1} mm radius would do.",
            servos.join(", "),
            radius * farthest / least
        );
        remarks.push(words.into());
    }
    let (wide, rule) = (2.0 * housing.outer_radius_mm, source.design.sewing.housing_mm);
    if rule > 0.0 && wide > rule + 0.05 {
        let words = format!(
            "The housing around a spool of {radius} mm radius is {wide:.1} mm wide, wider than the {rule:.1} mm that the rules of sewing count on: set \
             sewing.housing_mm to that, or make the spool smaller."
        );
        remarks.push(words.into());
    }
    remarks
}
