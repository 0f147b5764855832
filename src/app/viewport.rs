//! Stand-in for the 3D view until it is merged: it only says so.

use egui::{Align2, Ui};

use super::command::Command;
use super::fonts;
use super::theme::Theme;
use crate::experiment::Run;

/// What the view remembers.
#[derive(Debug, Default)]
pub struct ViewState {}

impl ViewState {
    /// A view that draws with this render state.
    #[must_use]
    pub fn new(_render_state: Option<&egui_wgpu::RenderState>) -> Self {
        Self {}
    }
}

/// Shows the 3D view.
pub fn viewport(ui: &mut Ui, _run: &Run, _cursor: f64, _state: &mut ViewState, _out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let rect = ui.max_rect();
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, "3D view", fonts::regular(13.0), theme.dim);
}
