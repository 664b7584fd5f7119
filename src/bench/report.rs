//! The result of a study: tables of figures, remarks and plots, as aligned text, JSON and CSV.

use super::figures::significant;
use super::plot::Plot;
use crate::files::printable;
use serde_json::{Map, Value, json};

/// Most characters that a column is padded to.
const WIDEST: usize = 200;

/// The findings of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The study by name, with the seed and whatever else repeats it.
    pub title: String,
    pub tables: Vec<Table>,
    /// Sentences that say what the tables show.
    pub remarks: Vec<String>,
    pub plots: Vec<Plot>,
}

/// Rows of figures under headings that carry their units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Name of the CSV file, without the extension.
    pub name: String,
    pub caption: String,
    pub headings: Vec<String>,
    pub rows: Vec<Vec<Cell>>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    Text(String),
    Count(usize),
    Number(f64),
    /// A lower bound, marked `>`.
    AtLeast(f64),
    /// Not measured.
    Missing,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}
impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}
impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}
impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}
impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Missing, Self::Number)
    }
}

impl Cell {
    fn shown(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Count(count) => count.to_string(),
            Self::Number(value) => significant(*value),
            Self::AtLeast(value) => format!("> {}", significant(*value)),
            Self::Missing => "-".into(),
        }
    }

    fn exact(&self) -> String {
        match self {
            Self::Text(text) => quoted(text),
            Self::Number(value) if value.is_finite() => format!("{value}"),
            Self::AtLeast(value) => format!(">{value}"),
            Self::Number(_) | Self::Missing => String::new(),
            Self::Count(count) => count.to_string(),
        }
    }

    fn json(&self) -> Value {
        match self {
            Self::Text(text) => json!(text),
            Self::Count(count) => json!(count),
            Self::Number(value) => json!(value),
            Self::AtLeast(value) => json!({ "at_least": value }),
            Self::Missing => Value::Null,
        }
    }

    fn is_text(&self) -> bool {
        matches!(self, Self::Text(_))
    }
}

/// A text as a cell of a CSV file: one that a spreadsheet would take for a formula gets a mark before it, control characters are
/// written out. Names of files may be anybody's.
fn quoted(text: &str) -> String {
    let text = printable(text);
    let is_formula = text.trim_start().starts_with(['=', '+', '-', '@']) && text != "-";
    let text = if is_formula { format!("'{text}") } else { text };
    if text.contains([',', '"', ';']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}

impl Table {
    pub fn new(name: &str, caption: &str, headings: &[&str]) -> Self {
        let headings = headings.iter().map(|&h| h.to_owned()).collect();
        Self { name: name.into(), caption: caption.into(), headings, rows: Vec::new() }
    }

    pub fn push(&mut self, row: Vec<Cell>) {
        debug_assert_eq!(row.len(), self.headings.len(), "{}", self.name);
        self.rows.push(row);
    }

    /// Aligned: text to the left, figures to the right.
    pub fn text(&self) -> String {
        let shown: Vec<Vec<String>> = self.rows.iter().map(|row| row.iter().map(Cell::shown).collect()).collect();
        let width = |k: usize| {
            let cells = shown.iter().map(|row| row[k].chars().count());
            cells.chain([self.headings[k].chars().count()]).max().unwrap_or(0).min(WIDEST)
        };
        let left = |k: usize| self.rows.iter().all(|row| row[k].is_text());
        let line = |cells: &[String]| {
            let padded = cells.iter().enumerate().map(|(k, cell)| {
                let width = width(k);
                if left(k) { format!("{cell:width$}") } else { format!("{cell:>width$}") }
            });
            padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
        };
        let mut lines = vec![self.caption.clone(), line(&self.headings)];
        lines.extend(shown.iter().map(|row| line(row)));
        lines.join("\n")
    }

    /// Comma-separated values with a heading line.
    pub fn csv(&self) -> String {
        let quoted = |h: &String| Cell::Text(h.clone()).exact();
        let mut lines = vec![self.headings.iter().map(quoted).collect::<Vec<_>>().join(",")];
        lines.extend(self.rows.iter().map(|row| row.iter().map(Cell::exact).collect::<Vec<_>>().join(",")));
        lines.join("\n") + "\n"
    }

    fn json(&self) -> Value {
        let row = |row: &Vec<Cell>| -> Map<String, Value> {
            self.headings.iter().cloned().zip(row.iter().map(Cell::json)).collect()
        };
        json!({ "caption": self.caption, "rows": self.rows.iter().map(row).collect::<Vec<_>>() })
    }
}

impl Report {
    pub fn text(&self) -> String {
        let mut parts = vec![self.title.clone()];
        parts.extend(self.tables.iter().map(Table::text));
        if !self.remarks.is_empty() {
            parts.push(self.remarks.join("\n"));
        }
        parts.join("\n\n")
    }

    pub fn json(&self) -> Value {
        let tables: Map<String, Value> = self.tables.iter().map(|t| (t.name.clone(), t.json())).collect();
        json!({ "title": self.title, "tables": tables, "remarks": self.remarks })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_with_three_digits() {
        let shown = [0.0, 1234.0, 12.345, 0.012_34, 1.234e-7, 1.2e9, -4.0, f64::NAN].map(significant);
        assert_eq!(shown, ["0", "1234", "12.3", "0.0123", "1.23e-7", "1.20e9", "-4.00", "-"]);
    }

    #[test]
    fn a_table_in_all_its_forms() {
        let mut table = Table::new("t", "Times", &["shape", "fibres", "ms, median"]);
        table.push(vec!["pig".into(), 414.into(), 1.25.into()]);
        table.push(vec!["a,b".into(), 10_000.into(), Cell::AtLeast(300.0)]);
        table.push(vec!["e".into(), 5.into(), Cell::Missing]);
        assert_eq!(
            table.text(),
            "Times\nshape  fibres  ms, median\npig       414        1.25\na,b     10000       > 300\ne           5           -"
        );
        assert_eq!(table.csv(), "shape,fibres,\"ms, median\"\npig,414,1.25\n\"a,b\",10000,>300\ne,5,\n");
        let report = Report { title: "T".into(), tables: vec![table], ..Default::default() };
        assert_eq!(
            ["=1+1", "@x", "-1", "-", "a\n=b", "\t=c"].map(quoted),
            ["'=1+1", "'@x", "'-1", "-", "a\\u{a}=b", "\\u{9}=c"]
        );
        assert_eq!(report.json()["tables"]["t"]["rows"][1]["ms, median"]["at_least"], 300.0);
    }
}
