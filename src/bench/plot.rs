//! Plots as SVG, drawn by the `plotters` library.

use super::BenchError;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

/// Size of a plot, px; a legend adds to its width what its line and a letter take.
const SIZE: (u32, u32) = (640, 440);
const LEGEND_LINE: u32 = 44;
const LEGEND_LETTER: u32 = 7;
/// Labels on an axis, at most.
const LABELS: usize = 6;
/// Colours that stay apart for the colour-blind (Okabe and Ito 2008), without the yellow that white paper swallows.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(60, 60, 60),
];

/// Curves over one pair of axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// Name of the file, without the extension.
    pub name: String,
    pub title: String,
    pub x_label: String,
    pub y_label: String,
    /// Logarithmic axes leave out what is not positive.
    pub log_x: bool,
    pub log_y: bool,
    pub series: Vec<Series>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    pub label: String,
    pub points: Vec<(f64, f64)>,
    /// Markers alone, without a line between them.
    pub scattered: bool,
}

impl Series {
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, scattered: false }
    }

    pub fn scatter(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, scattered: true }
    }
}

impl Plot {
    /// The plot as an SVG document.
    ///
    /// # Errors
    /// [`BenchError::Plot`] with what the plotting library says.
    pub fn svg(&self) -> Result<String, BenchError> {
        let x = self.range(self.log_x, |p| p.0);
        let y = self.range(self.log_y, |p| p.1);
        match (self.log_x, self.log_y) {
            (true, true) => self.draw((x.0..x.1).log_scale(), (y.0..y.1).log_scale()),
            (true, false) => self.draw((x.0..x.1).log_scale(), RangedCoordf64::from(y.0..y.1)),
            (false, true) => self.draw(RangedCoordf64::from(x.0..x.1), (y.0..y.1).log_scale()),
            (false, false) => self.draw(RangedCoordf64::from(x.0..x.1), RangedCoordf64::from(y.0..y.1)),
        }
    }

    fn shown(&self, (x, y): (f64, f64)) -> bool {
        x.is_finite() && y.is_finite() && (x > 0.0 || !self.log_x) && (y > 0.0 || !self.log_y)
    }

    /// The range of an axis with a little space at both ends; a linear axis begins at zero where it can.
    fn range(&self, log: bool, of: impl Fn(&(f64, f64)) -> f64) -> (f64, f64) {
        let values = self.series.iter().flat_map(|s| &s.points).filter(|p| self.shown(**p)).map(of);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        match (low.is_finite(), log) {
            (false, _) => (1.0, 10.0),
            (true, true) => (low / 1.3, high * 1.3),
            (true, false) => {
                let low = low.min(0.0);
                (low, high + 0.05 * (high - low).max(f64::MIN_POSITIVE))
            }
        }
    }

    fn draw<X, Y>(&self, x: X, y: Y) -> Result<String, BenchError>
    where
        X: AsRangedCoord<Value = f64>,
        Y: AsRangedCoord<Value = f64>,
        X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let mut svg = String::new();
        self.draw_into(&mut svg, x, y).map_err(|e| BenchError::Plot(e.to_string()))?;
        Ok(svg)
    }

    fn draw_into<X, Y>(&self, svg: &mut String, x: X, y: Y) -> Result<(), Box<dyn std::error::Error>>
    where
        X: AsRangedCoord<Value = f64>,
        Y: AsRangedCoord<Value = f64>,
        X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let letters = self.series.iter().map(|s| s.label.chars().count() as u32).max().unwrap_or(0);
        let legend = if self.series.len() > 1 { LEGEND_LINE + LEGEND_LETTER * letters } else { 0 };
        let root = SVGBackend::with_string(svg, (SIZE.0 + legend, SIZE.1)).into_drawing_area();
        root.fill(&WHITE)?;
        let (area, margin) = root.split_horizontally(SIZE.0);
        let mut chart = ChartBuilder::on(&area)
            .caption(&self.title, ("sans-serif", 18))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(64)
            .build_cartesian_2d(x, y)?;
        let label = |v: &f64| tick(*v);
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .x_labels(LABELS)
            .y_labels(LABELS)
            .bold_line_style(BLACK.mix(0.15))
            .x_desc(&self.x_label)
            .y_desc(&self.y_label)
            .x_label_formatter(&label)
            .y_label_formatter(&label)
            .axis_desc_style(("sans-serif", 15))
            .label_style(("sans-serif", 13))
            .draw()?;
        for (k, series) in self.series.iter().enumerate() {
            let colour = COLOURS[k % COLOURS.len()];
            let points: Vec<(f64, f64)> = series.points.iter().copied().filter(|p| self.shown(*p)).collect();
            if !series.scattered {
                chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?;
            }
            chart.draw_series(points.iter().map(|p| EmptyElement::at(*p) + marker(k, (0, 0), colour)))?;
            if legend > 0 {
                let y = 50 + 20 * k as i32;
                margin.draw(&PathElement::new([(4, y), (24, y)], colour.stroke_width(2)))?;
                margin.draw(&marker(k, (14, y), colour))?;
                margin.draw(&Text::new(series.label.as_str(), (32, y - 6), ("sans-serif", 13)))?;
            }
        }
        root.present()?;
        Ok(())
    }
}

/// A number beside an axis: three digits without idle zeros.
fn tick(value: f64) -> String {
    let text = super::figures::significant(value);
    match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// The marker of series `k`: a shape of its own for every round through the colours.
fn marker<'a>(k: usize, at: (i32, i32), colour: RGBColor) -> DynElement<'static, SVGBackend<'a>, (i32, i32)> {
    match (k / COLOURS.len()) % 3 {
        0 => Circle::new(at, 3, colour.filled()).into_dyn(),
        1 => TriangleMarker::new(at, 5, colour.filled()).into_dyn(),
        _ => Cross::new(at, 4, colour.stroke_width(2)).into_dyn(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_of_axes_gives_well_formed_svg() {
        for (log_x, log_y) in [(false, false), (false, true), (true, false), (true, true)] {
            let series = vec![
                Series::line("a < b", vec![(1.0, 2.0), (10.0, 30.0), (0.0, f64::NAN)]),
                Series::scatter("c", vec![(2.0, 1e-9), (3.0, 0.0)]),
            ];
            let plot = Plot { title: "T & U".into(), log_x, log_y, series, ..Default::default() };
            let svg = plot.svg().unwrap();
            let document = roxmltree::Document::parse(&svg).unwrap();
            assert!(document.descendants().any(|n| n.text().is_some_and(|t| t.contains("a < b"))));
            let circles = document.descendants().filter(|n| n.has_tag_name("circle")).count();
            // Two markers in the legend, and the points that the axes can show.
            assert_eq!(circles, if log_y { 5 } else { 6 });
        }
    }

    #[test]
    fn ticks_have_no_idle_zeros() {
        assert_eq!([10.0, 0.1, 1000.0, 2.5, 0.0].map(tick), ["10", "0.1", "1000", "2.5", "0"]);
    }

    #[test]
    fn an_empty_plot_is_no_failure() {
        assert!(Plot { log_x: true, log_y: true, ..Default::default() }.svg().is_ok());
        let one = Series::line("", vec![(0.0, 0.0)]);
        assert!(Plot { series: vec![one], ..Default::default() }.svg().is_ok());
    }
}
