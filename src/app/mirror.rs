//! The interface as a list of elements, from which the page makes real ones for screen readers and keyboards.
//!
//! egui tells assistive technology of its widgets by a tree. Here that becomes what HTML knows: buttons, fields, lists, groups,
//! landmarks, in reading order, each inside another one that came before it.

mod kind;

use std::collections::HashMap;

use egui::accesskit::{Action, Node, NodeId, Toggled, TreeUpdate};
use serde::Serialize;

pub use kind::{Kind, Part, mark, mark_digits};
use kind::{Sort, sort, takes_digits};

/// One element.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Element {
    /// Which widget it is, as [`id`] reads it.
    pub id: String,
    /// The element it is in; none at the top.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within: Option<String>,
    /// What it is.
    pub kind: Kind,
    /// Its name; of a text what it says.
    pub name: String,
    /// What more there is to say of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Its value as it is shown, with the unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// Its value as a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub number: Option<f64>,
    /// The least number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// The greatest number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// From one number to the next; none where they do not lie evenly.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<f64>,
    /// Whether it is switched on or chosen, where it can be.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<bool>,
    /// Whether what it folds away is shown, where it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub open: Option<bool>,
    /// Whether it does nothing for now.
    #[serde(skip_serializing_if = "is_false")]
    pub disabled: bool,
    /// Whether a keyboard of digits will do for it.
    #[serde(skip_serializing_if = "is_false")]
    pub digits: bool,
    /// Whether it takes the keyboard.
    #[serde(skip_serializing_if = "is_false")]
    pub focusable: bool,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_false(value: &bool) -> bool {
    !value
}

/// The whole page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mirror {
    /// The element that has the keyboard; the id of none when none has.
    pub focus: String,
    /// All elements in reading order, each after the one that it is in.
    pub elements: Vec<Element>,
}

/// The widget of an element, as egui is asked for it; none for what is no number.
#[must_use]
pub fn id(element: &str) -> Option<NodeId> {
    element.parse().ok().map(NodeId)
}

/// A widget's name: its own label, or the texts of the widgets that label it.
#[must_use]
pub fn name(node: &Node, nodes: &HashMap<NodeId, &Node>) -> Option<String> {
    if let Some(label) = node.label() {
        return Some(label.to_owned());
    }
    let texts: Vec<&str> =
        node.labelled_by().iter().filter_map(|id| nodes.get(id)).filter_map(|by| by.label().or(by.value())).collect();
    (!texts.is_empty()).then(|| texts.join(" "))
}

impl Mirror {
    /// Reads egui's tree.
    #[must_use]
    pub fn of(update: &TreeUpdate) -> Self {
        let nodes: HashMap<NodeId, &Node> = update.nodes.iter().map(|(id, node)| (*id, node)).collect();
        let mut reader = Reader { nodes, elements: Vec::new() };
        if let Some(tree) = &update.tree {
            reader.children(tree.root, None);
        }
        Self { focus: update.focus.0.to_string(), elements: reader.elements }
    }
}

struct Reader<'a> {
    nodes: HashMap<NodeId, &'a Node>,
    elements: Vec<Element>,
}

impl Reader<'_> {
    fn children(&mut self, of: NodeId, within: Option<&str>) {
        let Some(node) = self.nodes.get(&of).copied() else { return };
        for child in node.children() {
            self.node(*child, within);
        }
    }

    fn node(&mut self, id: NodeId, within: Option<&str>) {
        let Some(node) = self.nodes.get(&id).copied() else { return };
        match sort(node) {
            Sort::Nothing => {}
            Sort::Through => self.children(id, within),
            Sort::Leaf(kind) => {
                let name = match kind {
                    Kind::Text | Kind::Heading => node.value().or(node.label()).map(str::to_owned),
                    _ => name(node, &self.nodes),
                };
                if let Some(name) = name.filter(|name| !name.trim().is_empty()) {
                    self.elements.push(describe(id, node, kind, name, within));
                }
                // A menu hangs on its button, and stands after it.
                self.children(id, within);
            }
            Sort::Group(kind, name) => {
                let at = self.elements.len();
                let own = id.0.to_string();
                self.elements.push(describe(id, node, kind, name, within));
                self.children(id, Some(&own));
                self.elements[at].kind = kind.holding(&self.elements[at + 1..]);
                if self.elements.len() == at + 1 {
                    self.elements.pop();
                }
            }
        }
    }
}

fn describe(id: NodeId, node: &Node, kind: Kind, name: String, within: Option<&str>) -> Element {
    Element {
        id: id.0.to_string(),
        within: within.map(str::to_owned),
        kind,
        name,
        description: node.description().map(str::to_owned),
        value: node.value().filter(|_| !matches!(kind, Kind::Text | Kind::Heading)).map(str::to_owned),
        number: node.numeric_value().filter(|number| number.is_finite()),
        min: node.min_numeric_value().filter(|number| number.is_finite()),
        max: node.max_numeric_value().filter(|number| number.is_finite()),
        step: node.numeric_value_step().filter(|number| number.is_finite()),
        on: node.toggled().map(|toggled| toggled == Toggled::True),
        open: node.is_expanded(),
        disabled: node.is_disabled(),
        digits: takes_digits(node),
        focusable: node.supports_action(Action::Focus),
    }
}

#[cfg(test)]
mod tests;
