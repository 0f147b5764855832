//! Tabs, where there is room for one view only.

use egui::{Rect, Ui};

use crate::app::command::Command;
use crate::app::state::Tab;
use crate::app::widgets::segmented::segmented;

const TABS: [Tab; 3] = [Tab::Result, Tab::Plots, Tab::Plane];

/// Shows the tabs of a run of one segment, or of several.
pub fn tabs(ui: &mut Ui, rect: Rect, (shown, several): (Tab, bool), out: &mut Vec<Command>) {
    let names = ["Result", "Plots", if several { "Backbone" } else { "Bending plane" }];
    let chosen = TABS.iter().position(|tab| *tab == shown).unwrap_or(0);
    if let Some(picked) = segmented(ui, rect, "Views", &names, chosen) {
        out.push(Command::ShowTab(TABS[picked]));
    }
}
