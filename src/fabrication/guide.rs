//! A guide in words and pictures, before a writer gives it a file format.

use super::sheet::Sheet;

/// Headings, paragraphs, lists, tables and figures in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Guide {
    pub title: String,
    pub blocks: Vec<Block>,
}

/// A part of a guide.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    Heading(String),
    Text(String),
    /// Numbered from 1.
    Steps(Vec<String>),
    /// A line of names, and rows of as many fields.
    Rows {
        names: Vec<String>,
        rows: Vec<Vec<String>>,
    },
    /// A picture, no larger than its sheet.
    Figure {
        sheet: Sheet,
        caption: String,
    },
    /// What follows begins on a new page.
    Page,
}

impl Guide {
    pub fn heading(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Heading(text.into()));
    }

    pub fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    pub fn figure(&mut self, sheet: Sheet, caption: impl Into<String>) {
        self.blocks.push(Block::Figure { sheet, caption: caption.into() });
    }
}
