//! The keyboard.

use egui::{Key, Modifiers, Ui};

use crate::app::command::{Command, Mark};
use crate::app::saving::Subject;
use crate::app::stages::stage::Stage;
use crate::app::state::Tab;

/// Reads the keys that play, mark and save. Whatever has the focus keeps its keys, and so does what lies open over the page.
pub fn read(ui: &Ui, end: f64, stage: Stage, covered: bool, out: &mut Vec<Command>) {
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
    });
}
