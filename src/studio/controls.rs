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
