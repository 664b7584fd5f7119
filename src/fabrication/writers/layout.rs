//! Guides laid out on A4 pages.

use crate::fabrication::font;
use crate::fabrication::guide::{Block, Guide};
use crate::fabrication::sheet::{Anchor, BLACK, Entity, GREY, Group, Sheet, Style};
use crate::outline::Point;

const PAGE_MM: [f64; 2] = [210.0, 297.0];
const MARGIN_MM: f64 = 18.0;
const WIDTH_MM: f64 = PAGE_MM[0] - 2.0 * MARGIN_MM;
/// Heights of words, and of lines over those.
const TITLE_MM: f64 = 8.0;
const HEADING_MM: f64 = 5.5;
const TEXT_MM: f64 = 3.7;
const SMALL_MM: f64 = 3.2;
const LEADING: f64 = 1.45;
const SPACE_MM: f64 = 3.5;
/// Space left of steps for their numbers, and around the fields of a table, mm.
const INDENT_MM: f64 = 7.0;
const PAD_MM: f64 = 1.5;
/// Largest height of a figure, mm.
const FIGURE_MM: f64 = 165.0;
/// Two figures of this height have room on a page, below a heading and with their captions, mm; those that are higher by a fifth at most are drawn so high.
const HALF_MM: f64 = 112.0;
const SHRUNK: f64 = 1.2;

/// The pages of a guide.
pub(super) fn pages(guide: &Guide) -> Vec<Sheet> {
    let mut layout = Layout { title: &guide.title, pages: Vec::new(), row: 0.0 };
    layout.page();
    layout.lines(&guide.title, TITLE_MM, 0.0, WIDTH_MM);
    for (i, block) in guide.blocks.iter().enumerate() {
        if let (Block::Heading(_), Some(Block::Figure { sheet, .. })) = (block, guide.blocks.get(i + 1)) {
            // A heading is not alone at the foot of a page.
            layout.need(LEADING * (HEADING_MM + 2.0 * SMALL_MM) + 3.0 * SPACE_MM + scale(sheet) * sheet.height_mm);
        }
        layout.block(block);
    }
    layout.pages
}

/// Pages that are filled from their top; `row` is the next line's upper edge.
struct Layout<'a> {
    title: &'a str,
    pages: Vec<Sheet>,
    row: f64,
}

impl Layout<'_> {
    fn page(&mut self) {
        let number = self.pages.len() + 1;
        let mut words = Group::new("words", Style::filled(BLACK));
        words.text([MARGIN_MM, 0.5 * MARGIN_MM], SMALL_MM, Anchor::Start, format!("{}, page {number}", self.title));
        let lines = Group::new("lines", Style::line(GREY, 0.3));
        let title = format!("{}, page {number}", self.title);
        self.pages.push(Sheet { title, width_mm: PAGE_MM[0], height_mm: PAGE_MM[1], groups: vec![words, lines] });
        self.row = PAGE_MM[1] - MARGIN_MM;
    }

    /// Goes to another page where what comes is higher than what is left.
    fn need(&mut self, height: f64) {
        if self.row - height < MARGIN_MM && self.row < PAGE_MM[1] - MARGIN_MM {
            self.page();
        }
    }

    fn groups(&mut self) -> &mut Vec<Group> {
        let last = self.pages.len() - 1;
        &mut self.pages[last].groups
    }

    /// A paragraph at an indent; each line goes where there is room.
    fn lines(&mut self, text: &str, size: f64, indent: f64, width: f64) {
        for line in font::lines(text, size, width) {
            self.need(LEADING * size);
            let at = [MARGIN_MM + indent, self.row - size];
            self.groups()[0].text(at, size, Anchor::Start, line);
            self.row -= LEADING * size;
        }
    }

    fn block(&mut self, block: &Block) {
        match block {
            Block::Heading(text) => {
                self.row -= SPACE_MM;
                // Not alone at the foot of a page.
                self.need(HEADING_MM * LEADING + 4.0 * TEXT_MM * LEADING);
                self.lines(text, HEADING_MM, 0.0, WIDTH_MM);
            }
            Block::Text(text) => self.lines(text, TEXT_MM, 0.0, WIDTH_MM),
            Block::Steps(steps) => {
                for (i, step) in steps.iter().enumerate() {
                    self.need(LEADING * TEXT_MM);
                    let at = [MARGIN_MM, self.row - TEXT_MM];
                    self.groups()[0].text(at, TEXT_MM, Anchor::Start, format!("{}.", i + 1));
                    self.lines(step, TEXT_MM, INDENT_MM, WIDTH_MM - INDENT_MM);
                    self.row -= 0.3 * SPACE_MM;
                }
            }
            Block::Rows { names, rows } => self.table(names, rows),
            Block::Figure { sheet, caption } => self.figure(sheet, caption),
            Block::Page => self.page(),
        }
        self.row -= SPACE_MM;
    }

    fn table(&mut self, names: &[String], rows: &[Vec<String>]) {
        let widths = widths(names, rows);
        // The names are not alone at the foot of a page.
        self.need(3.0 * (LEADING * SMALL_MM + PAD_MM));
        for row in std::iter::once(names).chain(rows.iter().map(Vec::as_slice)) {
            let cells: Vec<Vec<String>> = row
                .iter()
                .zip(&widths)
                .map(|(cell, width)| font::lines(cell, SMALL_MM, width - 2.0 * PAD_MM))
                .collect();
            let count = cells.iter().map(Vec::len).max().unwrap_or(1);
            let height = count as f64 * LEADING * SMALL_MM + PAD_MM;
            self.need(height);
            let (mut x, top) = (MARGIN_MM, self.row);
            for (cell, width) in cells.into_iter().zip(&widths) {
                for (i, line) in cell.into_iter().enumerate() {
                    let at = [x + PAD_MM, top - 0.5 * PAD_MM - SMALL_MM - LEADING * SMALL_MM * i as f64];
                    self.groups()[0].text(at, SMALL_MM, Anchor::Start, line);
                }
                let ring = vec![[x, top], [x + width, top], [x + width, top - height], [x, top - height]];
                self.groups()[1].entities.push(Entity::Polygon(ring));
                x += width;
            }
            self.row -= height;
        }
    }

    /// As large as the page is wide, no larger than its sheet.
    fn figure(&mut self, sheet: &Sheet, caption: &str) {
        let scale = scale(sheet);
        let height = scale * sheet.height_mm;
        self.need(height + 2.0 * LEADING * SMALL_MM);
        let corner = [MARGIN_MM, self.row - height];
        let place = |p: Point| [corner[0] + scale * p[0], corner[1] + scale * p[1]];
        for group in &sheet.groups {
            let entities = group.entities.iter().map(|e| e.placed(place, scale)).collect();
            let style = Style { stroke_mm: group.style.stroke_mm * scale.max(0.5), ..group.style };
            let clip = group.clip.map(|corners| corners.map(place));
            self.groups().push(Group { entities, style, clip, ..group.clone() });
        }
        self.row -= height + 1.0;
        self.lines(caption, SMALL_MM, 0.0, WIDTH_MM);
    }
}

/// The scale of a figure.
fn scale(sheet: &Sheet) -> f64 {
    let scale = (WIDTH_MM / sheet.width_mm).min(FIGURE_MM / sheet.height_mm).min(1.0);
    let height_mm = scale * sheet.height_mm;
    if (HALF_MM..=SHRUNK * HALF_MM).contains(&height_mm) { HALF_MM / sheet.height_mm } else { scale }
}

/// Widths of columns by their longest fields, together as wide as the page.
fn widths(names: &[String], rows: &[Vec<String>]) -> Vec<f64> {
    let wish = |k: usize| {
        let fields = rows.iter().filter_map(|row| row.get(k)).chain(names.get(k));
        fields.map(|field| font::width_mm(field, SMALL_MM) + 2.0 * PAD_MM + 0.5).fold(0.0, f64::max)
    };
    let wishes: Vec<f64> = (0..names.len()).map(wish).collect();
    let sum: f64 = wishes.iter().sum();
    if sum <= WIDTH_MM {
        return wishes;
    }
    // Narrow columns keep what they wish for; the wide ones share the rest.
    let fair = WIDTH_MM / names.len().max(1) as f64;
    let (narrow, wide): (Vec<f64>, Vec<f64>) = wishes.iter().copied().partition(|&w| w <= fair);
    let left = WIDTH_MM - narrow.iter().sum::<f64>();
    let wide: f64 = wide.iter().sum();
    wishes.into_iter().map(|w| if w <= fair { w } else { left * w / wide }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_on_pages_and_within_their_margins() {
        let mut guide = Guide { title: "x".into(), ..Guide::default() };
        let words = "word ".repeat(300);
        for _ in 0..6 {
            guide.heading("Heading");
            guide.text(words.clone());
            let rows = vec![vec!["a".into(), words.clone()], vec!["b".into(), "short".into()]];
            guide.blocks.push(Block::Rows { names: vec!["one".into(), "two".into()], rows });
            guide.figure(Sheet { title: "t".into(), width_mm: 400.0, height_mm: 300.0, groups: Vec::new() }, "picture");
        }
        let pages = pages(&guide);
        assert!(pages.len() > 6, "{}", pages.len());
        let mut count = 0;
        for entity in pages.iter().flat_map(|p| &p.groups).flat_map(|g| &g.entities) {
            let Entity::Text { at, size_mm, text, .. } = entity else { continue };
            count += text.split(' ').filter(|w| *w == "word").count();
            assert!(at[0] >= MARGIN_MM && at[0] + font::width_mm(text, *size_mm) <= PAGE_MM[0] - MARGIN_MM + 0.1);
            assert!(at[1] >= 0.5 * MARGIN_MM && at[1] <= PAGE_MM[1] - MARGIN_MM);
        }
        assert_eq!(count, 6 * 2 * 300);
    }

    #[test]
    fn two_figures_share_a_page_below_a_heading() {
        let mut guide = Guide { title: "guide".into(), blocks: vec![Block::Page] };
        guide.heading("winches");
        for _ in 0..4 {
            guide.figure(Sheet { title: "t".into(), width_mm: 170.0, height_mm: 130.0, groups: Vec::new() }, "picture");
        }
        // The title's own, and two of two.
        assert_eq!(pages(&guide).len(), 3);
    }
}
