//! Tabs, where there is room for one view only.

use egui::{Rect, Ui};

use crate::app::command::Command;
use crate::app::state::Tab;
use crate::app::widgets::segmented::segmented;

const TABS: [(Tab, &str); 3] = [(Tab::Result, "Result"), (Tab::Plots, "Plots"), (Tab::Plane, "Bending plane")];

/// Shows the tabs.
pub fn tabs(ui: &mut Ui, rect: Rect, shown: Tab, out: &mut Vec<Command>) {
    let names = TABS.map(|(_, name)| name);
    let chosen = TABS.iter().position(|(tab, _)| *tab == shown).unwrap_or(0);
    if let Some(picked) = segmented(ui, rect, "Views", &names, chosen) {
        out.push(Command::ShowTab(TABS[picked].0));
    }
}
