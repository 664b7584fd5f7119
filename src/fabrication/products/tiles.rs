//! Large sheets on the pages of an office printer: at their size, with marks where pages meet.

use crate::fabrication::font;
use crate::fabrication::sheet::{
    Anchor, BLACK, Color, Entity, GREY, Group, REFERENCE_MM, Sheet, Style, WHITE, reference_square,
};
use crate::outline::Point;
use crate::outline::polygon::{self, bounding_box};

/// A kind of paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paper {
    pub name: &'static str,
    pub title: &'static str,
    pub size_mm: [f64; 2],
}

pub const PAPERS: [Paper; 2] = [
    Paper { name: "a4", title: "A4", size_mm: [210.0, 297.0] },
    Paper { name: "letter", title: "Letter", size_mm: [215.9, 279.4] },
];

/// Rim of the paper that printers leave white, mm.
const WHITE_MM: f64 = 10.0;
/// How far a page shows beyond its frame, mm: what neighbours have in common is twice this wide, and marks fit into it.
const BEYOND_MM: f64 = 6.0;
/// Half the width of a match mark, and the height of its letter, mm.
const MARK_MM: f64 = 4.0;
const LETTER_MM: f64 = 4.0;
const FRAME: Style = Style { stroke: Some(GREY), stroke_mm: 0.3, fill: None, dash: &[1.0, 2.0] };
const LIGHT: Color = Color(200, 200, 200);
const WORDS_MM: f64 = 4.0;

/// The pages of some sheets, a map of them first.
#[derive(Clone, Debug, PartialEq)]
pub struct Tiles {
    pub pages: Vec<Sheet>,
}

/// A sheet cut into frames.
struct Cut<'a> {
    sheet: &'a Sheet,
    columns: usize,
    rows: usize,
    /// Width and height of a frame, mm.
    step: [f64; 2],
    /// The number of the page of each frame, from the lower left, row by row; none where there is nothing to see.
    numbers: Vec<Option<usize>>,
    /// The number of the first letter of its marks.
    letters: usize,
    turned: bool,
}

/// Most frames that a sheet is cut into: more paper than anybody glues.
const MOST_FRAMES: f64 = 400.0;

impl Tiles {
    /// None where that would be hundreds of pages.
    pub fn new(name: &str, sheets: &[Sheet], paper: &Paper) -> Option<Self> {
        let frame = paper.size_mm[0] * paper.size_mm[1];
        if sheets.iter().any(|sheet| sheet.width_mm * sheet.height_mm > MOST_FRAMES * frame) {
            return None;
        }
        let mut cuts: Vec<Cut> = Vec::new();
        let (mut first, mut letters) = (2, 0);
        for sheet in sheets {
            let cut = Cut::new(sheet, paper, first, letters);
            first += cut.numbers.iter().flatten().count();
            letters += cut.joints();
            cuts.push(cut);
        }
        let mut pages = vec![map(name, &cuts, paper, first - 1)];
        for cut in &cuts {
            for row in (0..cut.rows).rev() {
                let shown = (0..cut.columns).filter(|&column| cut.number(column, row).is_some());
                pages.extend(shown.map(|column| cut.page(column, row, paper, first - 1)));
            }
        }
        Some(Self { pages })
    }
}

impl<'a> Cut<'a> {
    /// On upright paper or on paper that lies, whichever takes fewer pages.
    fn new(sheet: &'a Sheet, paper: &Paper, first: usize, letters: usize) -> Self {
        let cut = |turned: bool| {
            let [w, h] = size(paper, turned);
            let step = [w - 2.0 * (WHITE_MM + BEYOND_MM), h - 2.0 * (WHITE_MM + BEYOND_MM)];
            let count = |side: f64, step: f64| ((side - 1e-9) / step).ceil().max(1.0) as usize;
            let (columns, rows) = (count(sheet.width_mm, step[0]), count(sheet.height_mm, step[1]));
            Self { sheet, columns, rows, step, numbers: Vec::new(), letters, turned }.numbered(first)
        };
        let (upright, lying) = (cut(false), cut(true));
        let pages = |cut: &Self| cut.numbers.iter().flatten().count();
        if pages(&lying) < pages(&upright) { lying } else { upright }
    }

    /// Numbers from `first` on for the frames that show something, from the upper left.
    fn numbered(mut self, first: usize) -> Self {
        self.numbers = vec![None; self.columns * self.rows];
        let mut next = first;
        for row in (0..self.rows).rev() {
            for column in 0..self.columns {
                if self.shows(column, row) {
                    self.numbers[row * self.columns + column] = Some(next);
                    next += 1;
                }
            }
        }
        self
    }

    fn shows(&self, column: usize, row: usize) -> bool {
        let low = self.corner(column, row);
        let meets = |(a, b): (Point, Point)| (0..2).all(|k| a[k] <= low[k] + self.step[k] && b[k] >= low[k]);
        let touches = |entity: &Entity| match entity {
            Entity::Polygon(points) => polygon::sides(points).any(|(a, b)| meets(bounding_box(&[a, b]))),
            Entity::Polyline(points) => points.windows(2).any(|side| meets(bounding_box(side))),
            _ => meets(extent(entity)),
        };
        self.sheet.groups.iter().flat_map(|group| &group.entities).any(touches)
    }

    fn number(&self, column: usize, row: usize) -> Option<usize> {
        self.numbers[row * self.columns + column]
    }

    /// Pairs of frames that meet.
    fn joints(&self) -> usize {
        (self.columns - 1) * self.rows + self.columns * (self.rows - 1)
    }

    fn corner(&self, column: usize, row: usize) -> Point {
        [column as f64 * self.step[0], row as f64 * self.step[1]]
    }

    /// A page of the sheet, its frame and its marks.
    fn page(&self, column: usize, row: usize, paper: &Paper, count: usize) -> Sheet {
        let [width_mm, height_mm] = size(paper, self.turned);
        let corner = self.corner(column, row);
        let inset = WHITE_MM + BEYOND_MM;
        let place = |p: Point| [p[0] - corner[0] + inset, p[1] - corner[1] + inset];
        let window = [[WHITE_MM; 2], [width_mm - WHITE_MM, height_mm - WHITE_MM]];
        let shown = |e: &Entity| {
            let (low, high) = extent(e);
            (0..2).all(|k| low[k] <= window[1][k] && high[k] >= window[0][k])
        };
        let mut groups: Vec<Group> = Vec::new();
        for group in &self.sheet.groups {
            let entities: Vec<Entity> = group.entities.iter().map(|e| e.placed(place, 1.0)).filter(shown).collect();
            if !entities.is_empty() {
                groups.push(Group { entities, clip: Some(window), piece: None, ..group.clone() });
            }
        }
        let mut frame = Group::new("frame", FRAME);
        let far = [inset + self.step[0], inset + self.step[1]];
        // Each side from its lower or left end, so that the dashes of neighbours lie on each other.
        for along in [0, 1] {
            for across in [inset, far[1 - along]] {
                let mut ends = [[across; 2]; 2];
                (ends[0][along], ends[1][along]) = (inset, far[along]);
                frame.entities.push(Entity::Polyline(ends.to_vec()));
            }
        }
        let mut words = Group::new("page", Style::filled(BLACK));
        let number = self.number(column, row).unwrap_or(0);
        let (across, down) = (column + 1, self.rows - row);
        let text =
            format!("{}: page {number} of {count}, column {across}, row {down}; print at 100 %", self.sheet.title);
        words.text([WHITE_MM, 0.4 * WHITE_MM], 3.0, Anchor::Start, text);
        groups.push(frame);
        groups.push(self.marks(column, row, place));
        groups.push(words);
        Sheet { title: format!("{}, page {number}", self.sheet.title), width_mm, height_mm, groups }
    }

    /// A diamond with a letter in the middle of every side where another page meets, the same on both, and crosses at the corners.
    fn marks(&self, column: usize, row: usize, place: impl Fn(Point) -> Point) -> Group {
        let mut marks = Group::new("marks", Style { fill: Some(WHITE), ..Style::line(BLACK, 0.3) });
        let upright = |column: usize, row: usize| row * (self.columns - 1) + column;
        let lying = |column: usize, row: usize| (self.columns - 1) * self.rows + row * self.columns + column;
        let [x, y] = self.corner(column, row);
        let [w, h] = self.step;
        let mut sides: Vec<(usize, Point)> = Vec::new();
        let is_page = |column: usize, row: usize| self.number(column, row).is_some();
        if column > 0 && is_page(column - 1, row) {
            sides.push((upright(column - 1, row), [x, y + 0.5 * h]));
        }
        if column + 1 < self.columns && is_page(column + 1, row) {
            sides.push((upright(column, row), [x + w, y + 0.5 * h]));
        }
        if row > 0 && is_page(column, row - 1) {
            sides.push((lying(column, row - 1), [x + 0.5 * w, y]));
        }
        if row + 1 < self.rows && is_page(column, row + 1) {
            sides.push((lying(column, row), [x + 0.5 * w, y + h]));
        }
        for (joint, at) in sides {
            let [x, y] = place(at);
            let (r, text) = (MARK_MM, super::skin::letter(self.letters + joint));
            marks.entities.push(Entity::Polygon(vec![[x - r, y], [x, y - r], [x + r, y], [x, y + r]]));
            marks.text([x, y - 0.36 * LETTER_MM], LETTER_MM, Anchor::Middle, text);
        }
        for corner in [[x, y], [x + w, y], [x, y + h], [x + w, y + h]].map(place) {
            for [dx, dy] in [[MARK_MM, 0.0], [0.0, MARK_MM]] {
                let ends = vec![[corner[0] - dx, corner[1] - dy], [corner[0] + dx, corner[1] + dy]];
                marks.entities.push(Entity::Polyline(ends));
            }
        }
        marks
    }
}

fn size(paper: &Paper, turned: bool) -> [f64; 2] {
    let [w, h] = paper.size_mm;
    if turned { [h, w] } else { [w, h] }
}

/// The first page: how the others lie, and a square to measure.
fn map(name: &str, cuts: &[Cut], paper: &Paper, count: usize) -> Sheet {
    let [width_mm, height_mm] = paper.size_mm;
    let mut words = Group::new("words", Style::filled(BLACK));
    let mut top = height_mm - 2.0 * WHITE_MM;
    words.text([2.0 * WHITE_MM, top], 6.0, Anchor::Start, format!("{name}: pattern on {} paper", paper.title));
    let text = format!(
        "{count} pages. Print at 100 %, without scaling, and measure the square below. Cut along the grey frames where pages meet, lay the \
         crosses over each other, match the letters, and glue."
    );
    for line in font::lines(&text, WORDS_MM, width_mm - 4.0 * WHITE_MM) {
        top -= 1.5 * WORDS_MM;
        words.text([2.0 * WHITE_MM, top], WORDS_MM, Anchor::Start, line);
    }
    let bottom = 2.0 * WHITE_MM;
    let square = reference_square([0.5 * (width_mm - REFERENCE_MM), bottom]);
    // The maps side by side in what is left.
    let (low, high) = (bottom + REFERENCE_MM + WHITE_MM, top - WHITE_MM);
    let room =
        (width_mm - 4.0 * WHITE_MM - (cuts.len().saturating_sub(1)) as f64 * WHITE_MM) / cuts.len().max(1) as f64;
    let mut small = Group::new("pieces", Style::line(LIGHT, 0.3));
    let mut grid = Group::new("grid", Style::line(BLACK, 0.3));
    for (i, cut) in cuts.iter().enumerate() {
        let [w, h] = [cut.step[0] * cut.columns as f64, cut.step[1] * cut.rows as f64];
        let scale = (room / w).min((high - low - 8.0) / h);
        let left = 2.0 * WHITE_MM + i as f64 * (room + WHITE_MM);
        let place = |p: Point| [left + scale * p[0], low + scale * p[1]];
        let lines = cut
            .sheet
            .groups
            .iter()
            .flat_map(|g| &g.entities)
            .filter(|e| matches!(e, Entity::Polygon(_) | Entity::Polyline(_)));
        small.entities.extend(lines.map(|e| e.placed(place, scale)));
        for row in 0..cut.rows {
            for column in 0..cut.columns {
                let Some(number) = cut.number(column, row) else { continue };
                let [x, y] = cut.corner(column, row);
                let ring = [[x, y], [x + cut.step[0], y], [x + cut.step[0], y + cut.step[1]], [x, y + cut.step[1]]];
                grid.entities.push(Entity::Polygon(ring.map(place).to_vec()));
                let middle = place([x + 0.5 * cut.step[0], y + 0.5 * cut.step[1]]);
                words.text([middle[0], middle[1] - 2.0], 5.0, Anchor::Middle, number.to_string());
            }
        }
        let title = cut.sheet.title.rsplit(": ").next().unwrap_or_default();
        words.text([left, place([0.0, h])[1] + 2.0], WORDS_MM, Anchor::Start, title);
    }
    Sheet { title: format!("{name}: map of the pages"), width_mm, height_mm, groups: vec![small, grid, words, square] }
}

/// The box around an entity, mm; that of a text is generous.
fn extent(entity: &Entity) -> (Point, Point) {
    match entity {
        Entity::Polygon(points) | Entity::Polyline(points) => bounding_box(points),
        Entity::Circle { center: [x, y], radius: r } => ([x - r, y - r], [x + r, y + r]),
        Entity::Text { at: [x, y], size_mm, text, .. } => {
            let width = font::room_mm(text, *size_mm);
            ([x - width, y - size_mm], [x + width, y + size_mm])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_of_a_sheet_is_on_a_page_and_neighbours_agree() {
        let mut group = Group::new("cut", Style::line(BLACK, 0.3));
        let dots = (0..40).flat_map(|i| (0..30).map(move |j| [10.0 * f64::from(i), 10.0 * f64::from(j)]));
        group.entities.extend(dots.map(|center| Entity::Circle { center, radius: 0.5 }));
        let sheet = Sheet { title: "x: FRONT".into(), width_mm: 391.0, height_mm: 291.0, groups: vec![group] };
        for paper in &PAPERS {
            let tiles = Tiles::new("x", std::slice::from_ref(&sheet), paper).expect("some pages");
            let cut = Cut::new(&sheet, paper, 2, 0);
            assert_eq!(tiles.pages.len(), 1 + cut.numbers.iter().flatten().count());
            let mut seen = std::collections::BTreeSet::new();
            for row in 0..cut.rows {
                for column in 0..cut.columns {
                    let Some(number) = cut.number(column, row) else { continue };
                    let page = &tiles.pages[number - 1];
                    let corner = cut.corner(column, row);
                    let inset = WHITE_MM + BEYOND_MM;
                    for entity in page.groups.iter().filter(|g| g.name == "cut").flat_map(|g| &g.entities) {
                        let Entity::Circle { center, .. } = entity else { panic!("a dot") };
                        let on_sheet = [0, 1].map(|k| center[k] + corner[k] - inset);
                        seen.insert(on_sheet.map(|v| v.round() as i64));
                        assert!(on_sheet.iter().all(|v| (v / 10.0 - (v / 10.0).round()).abs() < 1e-9));
                    }
                }
            }
            assert_eq!(seen.len(), 1200, "{}", paper.title);
        }
    }
}
