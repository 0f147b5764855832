//! What a widget is in HTML.

use egui::accesskit::{Node, Role};
use egui::{Id, Ui};
use serde::Serialize;

use super::Element;

/// What an element is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A part of the page with a name and a heading.
    Region,
    /// Options of which one holds.
    Radios,
    /// Options of which one is shown.
    Tabs,
    /// A menu of things to do.
    Menu,
    /// A list of which one is chosen.
    List,
    /// What lies over the page until it is closed.
    Dialog,
    /// Anything else that belongs together.
    Group,
    /// A button.
    Button,
    /// A button that opens a list.
    Opener,
    /// A box to tick.
    Check,
    /// One of several.
    Radio,
    /// One of several views.
    Tab,
    /// A slider.
    Slider,
    /// A field for text.
    Field,
    /// A field for a number.
    Number,
    /// An entry of a list.
    Choice,
    /// An entry of a menu.
    Item,
    /// A link.
    Link,
    /// A title.
    Heading,
    /// Words.
    Text,
    /// A picture that is told in words.
    Picture,
    /// A view that takes keys of its own.
    View,
    /// How far something has come.
    Progress,
}

impl Kind {
    /// What a group is that holds these: a menu holds nothing but its entries, a list nothing but its choices.
    pub(super) fn holding(self, elements: &[Element]) -> Self {
        let all = |kind| elements.iter().all(|element| element.kind == kind);
        let any = |kind| elements.iter().any(|element| element.kind == kind);
        match self {
            Self::Menu | Self::List if all(Self::Item) => Self::Menu,
            Self::Menu | Self::List if all(Self::Choice) => Self::List,
            Self::Menu | Self::List => Self::Group,
            Self::Group if all(Self::Radio) => Self::Radios,
            Self::Group if all(Self::Tab) => Self::Tabs,
            Self::Group if any(Self::Item) && all(Self::Item) => Self::Menu,
            Self::Group if any(Self::Choice) && all(Self::Choice) => Self::List,
            kind => kind,
        }
    }
}

/// How a node is read.
pub(super) enum Sort {
    /// It is left out with all that is in it.
    Nothing,
    /// What is in it stands in its place.
    Through,
    /// It is an element.
    Leaf(Kind),
    /// It is an element of this name with others in it.
    Group(Kind, String),
}

/// What a part of the interface is to assistive technology.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A part of the page.
    Region,
    /// What belongs together.
    Group,
}

const REGION: &str = "region:";
const GROUP: &str = "group:";
const DIGITS: &str = "digits";

/// Says of a field that a keyboard of digits will do for it.
pub fn mark_digits(ui: &Ui, field: Id) {
    ui.ctx().accesskit_node_builder(field, |node| node.set_author_id(DIGITS));
}

/// Whether a keyboard of digits will do.
pub(super) fn takes_digits(node: &Node) -> bool {
    node.author_id() == Some(DIGITS)
}

/// Says of an `Ui` what it holds, in a few words. Names of elements are for those who look for widgets by name; this is none.
pub fn mark(ui: &Ui, part: Part, name: &str) {
    let prefix = match part {
        Part::Region => REGION,
        Part::Group => GROUP,
    };
    ui.ctx().accesskit_node_builder(ui.unique_id(), |node| node.set_author_id(format!("{prefix}{name}")));
}

pub(super) fn sort(node: &Node) -> Sort {
    if let Some(id) = node.author_id() {
        if let Some(name) = id.strip_prefix(REGION) {
            return Sort::Group(Kind::Region, name.to_owned());
        }
        if let Some(name) = id.strip_prefix(GROUP) {
            return Sort::Group(Kind::Group, name.to_owned());
        }
    }
    let named = || node.label().unwrap_or_default().to_owned();
    match node.role() {
        Role::Tooltip | Role::TextRun => Sort::Nothing,
        Role::Dialog | Role::AlertDialog => Sort::Group(Kind::Dialog, named()),
        Role::Menu => Sort::Group(Kind::Menu, named()),
        Role::ListBox => Sort::Group(Kind::List, named()),
        Role::Button | Role::DefaultButton => Sort::Leaf(Kind::Button),
        Role::ComboBox => Sort::Leaf(Kind::Opener),
        Role::CheckBox | Role::Switch => Sort::Leaf(Kind::Check),
        Role::RadioButton => Sort::Leaf(Kind::Radio),
        Role::Tab => Sort::Leaf(Kind::Tab),
        Role::Slider => Sort::Leaf(Kind::Slider),
        Role::TextInput | Role::MultilineTextInput | Role::SearchInput => Sort::Leaf(Kind::Field),
        Role::SpinButton | Role::NumberInput => Sort::Leaf(Kind::Number),
        Role::ListBoxOption => Sort::Leaf(Kind::Choice),
        Role::MenuItem => Sort::Leaf(Kind::Item),
        Role::Link => Sort::Leaf(Kind::Link),
        Role::Heading => Sort::Leaf(Kind::Heading),
        Role::Label | Role::Status | Role::Paragraph => Sort::Leaf(Kind::Text),
        Role::Figure | Role::Image => Sort::Leaf(Kind::Picture),
        Role::Canvas => Sort::Leaf(Kind::View),
        Role::ProgressIndicator => Sort::Leaf(Kind::Progress),
        _ => Sort::Through,
    }
}
