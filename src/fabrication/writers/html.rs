//! Guides as one HTML page: pictures are drawn in it, nothing is fetched from elsewhere.

use super::svg::{self, escaped};
use crate::fabrication::guide::{Block, Guide};
use crate::fabrication::product::Content;

const STYLE: &str = "body{font-family:Ubuntu,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;line-height:1.45}\
table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #999;padding:.25em .6em;text-align:left;vertical-align:top}\
figure{margin:1.5em 0}figure svg{max-width:100%;height:auto;border:1px solid #ccc}figcaption{color:#444}";

/// The bytes of an HTML file.
pub(super) fn write(content: &Content) -> Option<Vec<u8>> {
    match content {
        Content::Guide(guide) => Some(html(guide).into_bytes()),
        _ => None,
    }
}

fn html(guide: &Guide) -> String {
    let title = escaped(&guide.title);
    let blocks: Vec<String> = guide.blocks.iter().enumerate().map(|(i, block)| element(i, block)).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"UTF-8\"/>\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
         <h1>{title}</h1>\n{}</body>\n</html>\n",
        blocks.concat()
    )
}

fn element(number: usize, block: &Block) -> String {
    match block {
        Block::Heading(text) => format!("<h2>{}</h2>\n", escaped(text)),
        Block::Text(text) => format!("<p>{}</p>\n", escaped(text)),
        Block::Steps(steps) => {
            let items: Vec<String> = steps.iter().map(|step| format!("<li>{}</li>\n", escaped(step))).collect();
            format!("<ol>\n{}</ol>\n", items.concat())
        }
        Block::Rows { names, rows } => {
            let line = |cells: &[String], tag: &str| {
                let cells: Vec<String> = cells.iter().map(|c| format!("<{tag}>{}</{tag}>", escaped(c))).collect();
                format!("<tr>{}</tr>\n", cells.concat())
            };
            let body: Vec<String> = rows.iter().map(|row| line(row, "td")).collect();
            format!("<table>\n{}{}</table>\n", line(names, "th"), body.concat())
        }
        Block::Figure { sheet, caption } => {
            // The names of groups are unique on a sheet, not on a page of several.
            let mut sheet = sheet.clone();
            for group in &mut sheet.groups {
                group.name = format!("figure-{number}-{}", group.name);
                group.piece = group.piece.as_ref().map(|piece| format!("figure-{number}-{piece}"));
            }
            format!("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n", svg::element(&sheet), escaped(caption))
        }
        Block::Page => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::sheet::{Group, RED, Sheet, Style};

    #[test]
    fn a_page_is_well_formed_and_holds_its_pictures() {
        let mut guide = Guide { title: "a < b".into(), ..Guide::default() };
        guide.heading("Parts & more");
        guide.blocks.push(Block::Rows { names: vec!["part".into()], rows: vec![vec!["felt".into()]] });
        let group = || vec![Group::new("cut", Style::hairline(RED))];
        for _ in 0..2 {
            guide.figure(Sheet { title: "t".into(), width_mm: 10.0, height_mm: 10.0, groups: group() }, "one");
        }
        let page = html(&guide);
        let document = roxmltree::Document::parse(page.trim_start_matches("<!DOCTYPE html>\n")).expect("XML");
        let count = |tag: &str| document.descendants().filter(|n| n.tag_name().name() == tag).count();
        assert_eq!((count("svg"), count("td"), count("h2")), (2, 1, 1));
        let mut ids: Vec<_> = document.descendants().filter_map(|n| n.attribute("id")).collect();
        ids.dedup();
        assert_eq!(ids.len(), 2);
    }
}
