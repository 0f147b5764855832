//! The keyboard.

use egui::{Key, Modifiers, Ui};

use crate::app::App;
use crate::app::command::{Command, Mark};
use crate::app::saving::Subject;
use crate::app::stages::stage::Stage;
use crate::app::state::Tab;

/// Who has the keyboard.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holder {
    /// Nothing on the page: all keys are heard.
    Nobody,
    /// The 3D view, which keeps what turns it.
    View,
    /// A button, a slider or the like, which keeps what it is worked with.
    Widget,
    /// A field, or what lies open over the page: nothing is heard.
    All,
}

impl App {
    /// Whether something lies over the page until it is closed.
    pub(super) fn is_covered(&self) -> bool {
        self.state.help || self.state.keys || self.sharing.notice.is_some() || self.logs.form.is_some()
    }

    pub(super) fn holder(&self, ui: &Ui) -> Holder {
        if self.is_covered() || egui::Popup::is_any_open(ui.ctx()) || ui.ctx().text_edit_focused() {
            Holder::All
        } else if ui.memory(|memory| memory.focused().is_none()) {
            Holder::Nobody
        } else if self.view.has_focus() {
            Holder::View
        } else {
            Holder::Widget
        }
    }
}

/// Reads the keys that play, mark and save, as far as whoever has the keyboard leaves them.
pub fn read(ui: &Ui, end: f64, stage: Stage, holder: Holder, out: &mut Vec<Command>) {
    if holder == Holder::All {
        return;
    }
    ui.input_mut(|input| {
        let mut taken = |modifiers, key| input.count_and_consume_key(modifiers, key) as i32;
        letters(&mut taken, stage, out);
        if holder != Holder::Widget && taken(Modifiers::NONE, Key::Space) % 2 == 1 {
            out.push(Command::TogglePlay);
        }
        if holder == Holder::Nobody {
            steps(&mut taken, end, out);
        }
    });
}

fn steps(taken: &mut impl FnMut(Modifiers, Key) -> i32, end: f64, out: &mut Vec<Command>) {
    // With Shift first: a key without modifiers is consumed with them, too.
    let big = taken(Modifiers::SHIFT, Key::ArrowRight) - taken(Modifiers::SHIFT, Key::ArrowLeft);
    let small = taken(Modifiers::NONE, Key::ArrowRight) - taken(Modifiers::NONE, Key::ArrowLeft);
    let steps = 10 * big + small;
    if steps != 0 {
        out.push(Command::Step(steps));
    }
    if taken(Modifiers::NONE, Key::Delete) + taken(Modifiers::NONE, Key::Backspace) > 0 {
        out.extend([Mark::A, Mark::B].map(|mark| Command::Mark(mark, None)));
    }
    if taken(Modifiers::NONE, Key::Home) > 0 {
        out.push(Command::Seek(0.0));
    }
    if taken(Modifiers::NONE, Key::End) > 0 {
        out.push(Command::Pause);
        out.push(Command::Seek(end));
    }
}

/// What no button or slider is worked with.
fn letters(taken: &mut impl FnMut(Modifiers, Key) -> i32, stage: Stage, out: &mut Vec<Command>) {
    let plots = taken(Modifiers::SHIFT, Key::S) > 0;
    if plots {
        out.push(Command::ShowTab(Tab::Plots));
        out.push(Command::OfferToSave(Subject::Plots));
    }
    if taken(Modifiers::NONE, Key::S) > 0 && !plots {
        out.extend(Subject::on(stage).map(Command::OfferToSave));
    }
    for (key, mark) in [(Key::A, Mark::A), (Key::B, Mark::B)] {
        if taken(Modifiers::NONE, key) > 0 {
            out.push(Command::MarkHere(mark));
        }
    }
    if taken(Modifiers::NONE, Key::C) > 0 {
        out.push(Command::CopyMarks);
    }
    if taken(Modifiers::NONE, Key::M) % 2 == 1 {
        out.push(Command::ToggleSound);
    }
    if taken(Modifiers::NONE, Key::Questionmark) > 0 {
        out.push(Command::ToggleKeys);
    }
}
