//! The widgets of the last frame as JSON, read from egui's accessibility tree.
//!
//! eframe drops that tree in the browser, so a plugin picks it up ([`super::mirror`]).

use crate::app::mirror::name;
use egui::accesskit::{Node, NodeId, Toggled, TreeUpdate};
use serde_json::{Value, json};
use std::cell::RefCell;
use std::collections::HashMap;

thread_local! {
    static LAST: RefCell<Option<(TreeUpdate, f64)>> = const { RefCell::new(None) };
}

/// Keeps the accessibility tree of the last frame, and how many pixels of the canvas a point is.
pub fn keep(update: TreeUpdate, scale: f64) {
    LAST.set(Some((update, scale)));
}

/// `[{ id, role, label, value, number, min, max, step, on, disabled, focused, bounds: [x, y, width, height] }]`, bounds where they
/// are seen, in CSS pixels: a pixel of the canvas is `pixel` of them. What a widget does not have is left out.
pub fn to_json(pixel: f64) -> String {
    LAST.with_borrow(|last| {
        let Some((update, pixels)) = last else {
            return "[]".to_owned();
        };
        let scale = pixels * pixel;
        let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
        let list: Vec<Value> =
            update.nodes.iter().map(|(id, node)| describe(*id, node, &nodes, update.focus, scale)).collect();
        Value::Array(list).to_string()
    })
}

fn describe(id: NodeId, node: &Node, nodes: &HashMap<NodeId, &Node>, focus: NodeId, scale: f64) -> Value {
    let mut all = json!({
        "id": id.0.to_string(),
        "role": format!("{:?}", node.role()),
        "label": name(node, nodes),
        "value": node.value(),
        "number": node.numeric_value(),
        "min": node.min_numeric_value(),
        "max": node.max_numeric_value(),
        "step": node.numeric_value_step(),
        "on": node.toggled().map(|toggled| toggled == Toggled::True),
        "disabled": node.is_disabled().then_some(true),
        "focused": (id == focus).then_some(true),
        "bounds": node.bounds().map(|b| [b.x0 * scale, b.y0 * scale, b.width() * scale, b.height() * scale]),
    });
    if let Some(map) = all.as_object_mut() {
        map.retain(|_, value| !value.is_null());
    }
    all
}
