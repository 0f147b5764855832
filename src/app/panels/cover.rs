//! Who had the keyboard before something came to lie over the page, and has it again after.

use egui::{Event, Id, Ui};

/// What is remembered of it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Cover {
    covered: bool,
    before: Option<Id>,
}

impl Cover {
    /// Takes in whether the page is covered now; returns whether a key has just covered it, and what covers it is to take the keyboard.
    pub fn update(&mut self, ui: &Ui, covered: bool) -> bool {
        if ui.ctx().current_pass_index() > 0 || covered == self.covered {
            return false;
        }
        self.covered = covered;
        if covered {
            self.before = ui.memory(|memory| memory.focused());
            let by_key =
                |event: &Event| matches!(event, Event::Key { pressed: true, .. } | Event::AccessKitActionRequest(_));
            return self.before.is_some() || ui.input(|input| input.events.iter().any(by_key));
        }
        if let Some(before) = self.before.take() {
            ui.memory_mut(|memory| memory.request_focus(before));
        }
        false
    }
}
