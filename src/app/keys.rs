//! The keyboard.

use egui::{Key, Modifiers, Ui};

use crate::app::command::Command;

/// Reads the keys that play. Whatever has the focus keeps its keys, and so does what lies open over the page.
pub fn read(ui: &Ui, end: f64, covered: bool, out: &mut Vec<Command>) {
    if covered || ui.memory(|memory| memory.focused().is_some()) {
        return;
    }
    ui.input_mut(|input| {
        let mut taken = |modifiers, key| input.count_and_consume_key(modifiers, key) as i32;
        // With Shift first: a key without modifiers is consumed with them, too.
        let big = taken(Modifiers::SHIFT, Key::ArrowRight) - taken(Modifiers::SHIFT, Key::ArrowLeft);
        let small = taken(Modifiers::NONE, Key::ArrowRight) - taken(Modifiers::NONE, Key::ArrowLeft);
        let steps = 10 * big + small;
        if steps != 0 {
            out.push(Command::Step(steps));
        }
        if taken(Modifiers::NONE, Key::Space) % 2 == 1 {
            out.push(Command::TogglePlay);
        }
        if taken(Modifiers::NONE, Key::Home) > 0 {
            out.push(Command::Seek(0.0));
        }
        if taken(Modifiers::NONE, Key::End) > 0 {
            out.push(Command::Pause);
            out.push(Command::Seek(end));
        }
    });
}
