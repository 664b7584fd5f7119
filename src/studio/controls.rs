//! What can be seen and pressed, told line by line to a program that drives the window: `--controls`, for `scripts/tour`.

use eframe::egui::accesskit::{Node, NodeId, Toggled};
use eframe::egui::{Context, FullOutput, Plugin, Rect};
use serde::Serialize;
use std::collections::HashMap;
use std::io::Write;

/// Writes a line of JSON whenever the controls change: all of them, by the names that a screen reader says.
pub struct Controls<W> {
    out: W,
    told: String,
}

impl<W: Write + Send + Sync + 'static> Controls<W> {
    pub fn new(out: W) -> Self {
        Self { out, told: String::new() }
    }
}

#[derive(Serialize)]
struct Control {
    role: String,
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    on: Option<bool>,
    enabled: bool,
    /// Left, top, right, bottom, in pixels of the screen.
    rect: [i32; 4],
    /// The part that can be pressed now: not scrolled away, and with nothing over its middle.
    #[serde(skip_serializing_if = "Option::is_none")]
    seen: Option<[i32; 4]>,
}

impl<W: Write + Send + Sync + 'static> Plugin for Controls<W> {
    fn debug_name(&self) -> &'static str {
        "controls"
    }

    fn setup(&mut self, ctx: &Context) {
        ctx.enable_accesskit();
    }

    fn output_hook(&mut self, ctx: &Context, output: &mut FullOutput) {
        // Whoever asks for the tree next gets it as well.
        ctx.enable_accesskit();
        let Some(update) = &output.platform_output.accesskit_update else { return };
        let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
        let seen = seen(ctx);
        let scale = ctx.pixels_per_point();
        let mut controls: Vec<Control> =
            update.nodes.iter().filter_map(|(id, node)| control(node, &nodes, scale, seen.get(id).copied())).collect();
        controls.sort_by(|a, b| (a.rect[1], a.rect[0], &a.name).cmp(&(b.rect[1], b.rect[0], &b.name)));
        let line = serde_json::to_string(&controls).unwrap_or_default();
        if line != self.told {
            // Whoever reads no further has seen enough.
            let _ = writeln!(self.out, "{line}").and_then(|()| self.out.flush());
            self.told = line;
        }
    }
}

fn control(node: &Node, nodes: &HashMap<NodeId, &Node>, scale: f32, seen: Option<Rect>) -> Option<Control> {
    let bounds = node.bounds()?;
    let pixels = |rect: [f64; 4]| rect.map(|points| (points * f64::from(scale)).round() as i32);
    let words = |node: &Node| node.label().or(node.value()).map(str::to_owned);
    let labels = node.labelled_by().iter().filter_map(|id| words(nodes.get(id)?));
    let name = node.label().map_or_else(|| labels.collect::<Vec<_>>().join(" "), str::to_owned);
    let (name, value) = match (name.is_empty(), node.value()) {
        // A text says itself.
        (true, Some(value)) => (value.to_owned(), None),
        (_, value) => (name, value.map(str::to_owned).or_else(|| node.numeric_value().map(|value| value.to_string()))),
    };
    if name.is_empty() {
        return None;
    }
    Some(Control {
        role: format!("{:?}", node.role()),
        name,
        value,
        on: node.toggled().map(|toggled| toggled == Toggled::True),
        enabled: !node.is_disabled(),
        rect: pixels([bounds.x0, bounds.y0, bounds.x1, bounds.y1]),
        seen: seen.map(|rect| pixels([rect.left(), rect.top(), rect.right(), rect.bottom()].map(f64::from))),
    })
}

/// Where widgets can be pressed.
fn seen(ctx: &Context) -> HashMap<NodeId, Rect> {
    let places: Vec<_> = ctx.viewport(|viewport| {
        let layers = viewport.prev_pass.widgets.layers();
        let widgets = layers.flat_map(|(layer, widgets)| widgets.iter().map(|widget| (*layer, widget)));
        let placed = widgets.filter(|(_, widget)| widget.visible && widget.interact_rect.is_positive());
        placed.map(|(layer, widget)| (layer, widget.id.accesskit_id(), widget.interact_rect)).collect()
    });
    let on_top = |(layer, _, rect): &(_, NodeId, Rect)| ctx.layer_id_at(rect.center()).is_none_or(|top| top == *layer);
    places.into_iter().filter(on_top).map(|(_, id, rect)| (id, rect)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui;
    use serde_json::Value;
    use std::sync::{Arc, Mutex};

    #[derive(Clone, Default)]
    struct Read(Arc<Mutex<Vec<u8>>>);

    impl Write for Read {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.lock().map_or(Ok(0), |mut read| read.write(bytes))
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn controls_are_told_with_names_values_and_what_is_seen_of_them_when_they_change() {
        let ctx = Context::default();
        let read = Read::default();
        ctx.add_plugin(Controls::new(read.clone()));
        let mut speed = 3.0;
        let mut frame = |dialog: bool| {
            let screen_rect = Some(Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(400.0, 300.0)));
            let input = egui::RawInput { screen_rect, ..Default::default() };
            let _ = ctx.run_ui(input, |ui| {
                let _ = ui.button("Press");
                let label = ui.label("Speed");
                ui.add(egui::DragValue::new(&mut speed)).labelled_by(label.id);
                egui::ScrollArea::vertical().max_height(40.0).show(ui, |ui| {
                    ui.add_space(100.0);
                    let _ = ui.button("Below");
                });
                if dialog {
                    egui::Modal::new(egui::Id::unique("dialog")).show(ui.ctx(), |ui| ui.button("Answer"));
                }
            });
        };
        (0..3).for_each(|_| frame(false));
        (0..3).for_each(|_| frame(true));
        let text = String::from_utf8(read.0.lock().unwrap().clone()).unwrap();
        let lines: Vec<Vec<Value>> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert!(lines.len() >= 2 && lines.windows(2).all(|pair| pair[0] != pair[1]));
        let find = |line: &[Value], name: &str, role: &str| {
            line.iter().find(|c| c["name"] == name && c["role"] == role).cloned().unwrap_or_default()
        };
        let (alone, covered) =
            (&lines[lines.iter().position(|l| !find(l, "Press", "Button").is_null()).unwrap()], lines.last().unwrap());
        assert!(
            find(alone, "Press", "Button")["seen"].is_array() && find(covered, "Press", "Button")["seen"].is_null()
        );
        assert!(find(covered, "Answer", "Button")["seen"].is_array());
        let below = find(alone, "Below", "Button");
        assert!(below["rect"].is_array() && below["seen"].is_null());
        assert_eq!(find(alone, "Speed", "SpinButton")["value"], "3");
    }
}
