//! Tables as CSV: settings as comments, then a line of names and a line for every row.

use crate::fabrication::product::Content;
use crate::fabrication::table::{Table, Values};
use std::fmt::Write;

/// The text of a CSV file.
pub(super) fn write(content: &Content) -> Option<Vec<u8>> {
    match content {
        Content::Table(table) => Some(csv(table).into_bytes()),
        _ => None,
    }
}

fn csv(table: &Table) -> String {
    let mut csv = String::new();
    for (name, value) in &table.settings {
        csv += &format!("# {name}={value}\n");
    }
    let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
    csv += &names.join(",");
    csv.push('\n');
    let rows = table.columns.iter().map(|column| column.values.len()).min().unwrap_or(0);
    for row in 0..rows {
        for (k, column) in table.columns.iter().enumerate() {
            if k > 0 {
                csv.push(',');
            }
            // Writing to a string cannot fail.
            let _ = match &column.values {
                Values::Words(values) => write!(csv, "{}", values[row]),
                Values::Counts(values) => write!(csv, "{}", values[row]),
                Values::Figures(values) => write!(csv, "{:.6}", values[row]),
            };
        }
        csv.push('\n');
    }
    csv
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::table::Column;

    #[test]
    fn golden_text() {
        let columns = vec![
            Column::new("winch", Values::Words(vec!["left".into(), "right".into()])),
            Column::new("counts", Values::Counts(vec![-3, 40])),
            Column::new("length_mm", Values::Figures(vec![0.5, 1.0 / 3.0])),
        ];
        let table = Table { settings: vec![("gear_ratio", "43".into())], columns };
        let expected = "# gear_ratio=43\nwinch,counts,length_mm\nleft,-3,0.500000\nright,40,0.333333\n";
        assert_eq!(csv(&table), expected);
    }
}
