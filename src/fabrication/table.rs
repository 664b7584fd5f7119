//! A table of figures by columns.

/// Columns of the same length, and what was set when they were made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names and values.
    pub settings: Vec<(&'static str, String)>,
    pub columns: Vec<Column>,
}

/// A column; units stand in its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub name: String,
    pub values: Values,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Without the characters that separate fields.
    Words(Vec<String>),
    Counts(Vec<i64>),
    /// Written with six decimals.
    Figures(Vec<f64>),
}

impl Column {
    pub fn new(name: impl Into<String>, values: Values) -> Self {
        Self { name: name.into(), values }
    }
}

impl Values {
    pub fn len(&self) -> usize {
        match self {
            Self::Words(values) => values.len(),
            Self::Counts(values) => values.len(),
            Self::Figures(values) => values.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
