//! The pairs of lines that a DXF file is made of, and the entities they make.

use super::place::Point3;

/// The pairs of a file: a code and a value, each on a line of its own.
pub(super) struct Tags<'a> {
    lines: std::str::Lines<'a>,
    pushed: Option<(i32, &'a str)>,
}

impl<'a> Tags<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { lines: text.lines(), pushed: None }
    }

    /// The next pair, or none at the end of the file.
    ///
    /// # Errors
    /// What is wrong with the line.
    pub fn next_tag(&mut self) -> Result<Option<(i32, &'a str)>, &'static str> {
        if let Some(tag) = self.pushed.take() {
            return Ok(Some(tag));
        }
        let Some(code) = self.lines.next() else { return Ok(None) };
        if code.trim().is_empty() && self.lines.clone().all(|line| line.trim().is_empty()) {
            return Ok(None);
        }
        let code = code.trim().parse().map_err(|_| "a group code is not a number")?;
        let value = self.lines.next().ok_or("the file ends early")?;
        Ok(Some((code, value.trim())))
    }

    fn push_back(&mut self, tag: (i32, &'a str)) {
        self.pushed = Some(tag);
    }
}

/// An entity: its kind, its pairs, and the vertices that follow an old polyline.
pub(super) struct Entity<'a> {
    pub kind: &'a str,
    pub tags: Vec<(i32, &'a str)>,
    pub vertices: Vec<Entity<'a>>,
}

impl<'a> Entity<'a> {
    pub fn text(&self, code: i32) -> Option<&'a str> {
        self.tags.iter().find(|tag| tag.0 == code).map(|tag| tag.1)
    }

    pub fn number(&self, code: i32) -> Option<f64> {
        self.text(code)?.parse().ok().filter(|v: &f64| v.is_finite())
    }

    /// The point whose x has this code, and y and z that plus ten and twenty.
    pub fn point(&self, code: i32) -> Point3 {
        [code, code + 10, code + 20].map(|code| self.number(code).unwrap_or(0.0))
    }

    /// The extrusion direction, z where none is stated.
    pub fn normal(&self) -> Point3 {
        [(210, 0.0), (220, 0.0), (230, 1.0)].map(|(code, usual)| self.number(code).unwrap_or(usual))
    }

    /// Whether its points are in the coordinates of its own plane; those of all others are the world's.
    pub fn is_flat(&self) -> bool {
        match self.kind {
            "CIRCLE" | "ARC" | "LWPOLYLINE" | "SOLID" | "TRACE" | "INSERT" | "HATCH" => true,
            // Flag 8: a polyline in space.
            "POLYLINE" => !self.has_flag(8),
            _ => false,
        }
    }

    pub fn has_flag(&self, bit: i64) -> bool {
        self.number(70).is_some_and(|flags| flags as i64 & bit != 0)
    }

    /// All numbers with a code.
    pub fn numbers(&self, code: i32) -> Vec<f64> {
        let of = self.tags.iter().filter(|tag| tag.0 == code);
        of.filter_map(|tag| tag.1.parse().ok()).filter(|v: &f64| v.is_finite()).collect()
    }

    /// All points whose x has this code.
    pub fn points(&self, code: i32) -> Vec<Point3> {
        let mut points: Vec<Point3> = Vec::new();
        for &(at, value) in &self.tags {
            let Some(value) = value.parse().ok().filter(|v: &f64| v.is_finite()) else { continue };
            match (at - code, points.last_mut()) {
                (0, _) => points.push([value, 0.0, 0.0]),
                (10, Some(last)) => last[1] = value,
                (20, Some(last)) => last[2] = value,
                _ => {}
            }
        }
        points
    }
}

/// The pairs after `0 kind`, up to the next `0`.
pub(super) fn one<'a>(tags: &mut Tags<'a>, kind: &'a str) -> Result<Entity<'a>, &'static str> {
    let mut entity = Entity { kind, tags: Vec::new(), vertices: Vec::new() };
    while let Some(tag) = tags.next_tag()? {
        if tag.0 == 0 {
            tags.push_back(tag);
            break;
        }
        entity.tags.push(tag);
    }
    Ok(entity)
}

/// The entities up to `0 end`; an end of file will do. Entities on paper (code 67) are left out.
pub(super) fn read<'a>(tags: &mut Tags<'a>, end: &str) -> Result<Vec<Entity<'a>>, &'static str> {
    let mut entities: Vec<Entity<'a>> = Vec::new();
    // Block names and the like stand before the first entity.
    while let Some((code, value)) = tags.next_tag()? {
        if code != 0 {
            continue;
        }
        if value == end || value == "ENDSEC" || value == "EOF" {
            break;
        }
        let entity = one(tags, value)?;
        match entities.last_mut() {
            Some(last) if value == "VERTEX" && last.kind == "POLYLINE" => last.vertices.push(entity),
            _ if entity.number(67) == Some(1.0) => {}
            _ => entities.push(entity),
        }
    }
    Ok(entities)
}
