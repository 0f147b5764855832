//! The dialog in which a person says how a log is to be read.

use egui::{ComboBox, Grid, Id, Modal, Rect, RichText, ScrollArea, Ui, pos2, vec2};

use crate::app::command::{Command, LogWish};
use crate::app::fonts;
use crate::app::log::form::{Edit, Form};
use crate::app::theme::Theme;
use crate::app::widgets::button::button;
use crate::app::widgets::finger;
use crate::app::widgets::text;
use centrode_core::record::log::{Format, Role};

/// Quantities by what they are about.
const GROUPS: [(&str, &[Role]); 6] = [
    ("Time and position", &[Role::Time, Role::X, Role::Y, Role::Z]),
    ("Orientation: Euler angles, a quaternion or a rotation vector", &Role::ORIENTATION),
    ("Command: θL or bend, and δ", &[Role::ThetaL, Role::Bend, Role::Delta]),
    ("or joint values", &[Role::Q1, Role::Q2, Role::Q3]),
    ("Load cells", &[Role::Tau1, Role::Tau2, Role::Tau3]),
    ("Quality of the reading", &[Role::Quality]),
];
/// Columns of the file that are shown at most.
const SHOWN: usize = 40;
/// What is said of a column, or of a quantity, of which nothing is made.
const NOT_USED: &str = "not used";

/// Shows the dialog.
pub fn columns(ui: &mut Ui, form: &Form, out: &mut Vec<Command>) {
    let theme = Theme::of(ui);
    let screen = ui.ctx().content_rect();
    let modal = Modal::new(Id::unique("log form")).backdrop_color(egui::Color32::from_black_alpha(110));
    let frame = egui::Frame::popup(ui.style()).inner_margin(18).corner_radius(12);
    let name = &form.parts.file.name;
    let shown = modal.frame(frame).show(ui.ctx(), |ui| {
        let width = (screen.width() - 64.0).min(640.0);
        ui.set_width(width);
        let title = if form.why.is_some() { format!("{name} was not read") } else { format!("How {name} is read") };
        ui.label(RichText::new(title).font(fonts::strong(18.0)).color(theme.ink));
        if let Some(why) = &form.why {
            ui.add(egui::Label::new(RichText::new(format!("{why}.")).size(13.5).color(theme.error)).wrap());
        }
        // As high as it may be at once: it would grow frame by frame, and its buttons would move away from the pointer.
        let height = (screen.height() - 220.0).max(80.0);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            ui.set_width(width - 10.0);
            ui.add_space(4.0);
            preview(ui, form, &theme);
            format(ui, form, &theme, out);
            if form.format() == Format::Csv {
                quantities(ui, form, &theme, out);
            }
            commands(ui, form, &theme, out);
        });
        ui.add_space(10.0);
        let (bar, _) = ui.allocate_exact_size(vec2(width, finger::at_least(ui, 32.0)), egui::Sense::hover());
        let [wide, narrow] = ["Read log", "Cancel"].map(|word| text::width(ui, word, fonts::strong(12.5)) + 28.0);
        let read = Rect::from_min_max(pos2(bar.right() - wide, bar.top()), bar.max);
        let left = read.left() - 8.0;
        if button(ui, read, "Read log", &theme) {
            out.push(Command::Log(LogWish::Read));
        }
        button(ui, Rect::from_min_max(pos2(left - narrow, bar.top()), pos2(left, bar.bottom())), "Cancel", &theme)
    });
    if shown.inner || shown.should_close() {
        out.push(Command::Log(LogWish::LeaveForm));
    }
}

fn heading(ui: &mut Ui, words: &str, theme: &Theme) {
    ui.add_space(10.0);
    ui.label(text::rich(words, 13.0, theme.ink));
}

fn edit(out: &mut Vec<Command>, edit: Edit) {
    out.push(Command::Log(LogWish::Edit(edit)));
}

/// The first rows, under what their columns are taken for.
fn preview(ui: &mut Ui, form: &Form, theme: &Theme) {
    if form.rows.is_empty() {
        return;
    }
    heading(ui, "The first rows, and what their columns are taken for", theme);
    let cell = |ui: &mut Ui, said: &str, ink| {
        let short: String = said.chars().take(18).collect();
        ui.label(RichText::new(short).size(12.0).color(ink));
    };
    ScrollArea::horizontal().id_salt("first rows").show(ui, |ui| {
        Grid::new("first rows").spacing(vec2(14.0, 3.0)).show(ui, |ui| {
            for place in 0..form.headers.len().min(SHOWN) {
                let role = form.chosen.iter().find(|(_, (at, _))| *at == place);
                match role {
                    Some((role, (_, unit))) if *unit == "1" => cell(ui, role.key(), theme.accent),
                    Some((role, (_, unit))) => cell(ui, &format!("{} [{unit}]", role.key()), theme.accent),
                    None => cell(ui, NOT_USED, theme.dim),
                }
            }
            ui.end_row();
            for row in &form.rows {
                row.iter().take(SHOWN).for_each(|text| cell(ui, text, theme.ink));
                ui.end_row();
            }
        });
    });
}

/// A choice with its name at the left; gives the place of what was picked.
fn choice(ui: &mut Ui, (name, tip): (&str, &str), shown: &str, width: f32, options: &[String]) -> Option<usize> {
    let label = ui.label(text::rich(name, 13.0, Theme::of(ui).ink)).on_hover_text(tip);
    let mut picked = None;
    let combo = ComboBox::from_id_salt(name).width(width).selected_text(shown).show_ui(ui, |ui| {
        for (place, option) in options.iter().enumerate() {
            if ui.selectable_label(option == shown, option).clicked() {
                picked = Some(place);
            }
        }
    });
    combo.response.labelled_by(label.id);
    picked
}

fn format(ui: &mut Ui, form: &Form, theme: &Theme, out: &mut Vec<Command>) {
    heading(ui, "File", theme);
    let guess = format!("guessed: {}", form.format().name());
    let asked = form.parts.asked.options.format;
    let options: Vec<String> =
        std::iter::once("guess".to_owned()).chain(Format::ALL.map(|format| format.name().to_owned())).collect();
    ui.horizontal(|ui| {
        let shown = asked.map_or_else(|| guess.clone(), |format| format.name().to_owned());
        if let Some(picked) = choice(ui, ("Format", "How the file is written"), &shown, 150.0, &options) {
            edit(out, Edit::Format(picked.checked_sub(1).and_then(|place| Format::ALL.get(place).copied())));
        }
    });
    if form.format() == Format::Ndi {
        ui.horizontal(|ui| {
            let label = ui.label(text::rich("Tool", 13.0, theme.ink));
            let mut tool = form.parts.asked.options.tool.clone().unwrap_or_default();
            let field = egui::TextEdit::singleline(&mut tool).desired_width(120.0).hint_text("number or name");
            if ui.add(field).labelled_by(label.id).changed() {
                edit(out, Edit::Tool(tool));
            }
        });
    }
    topics(ui, form, false, out);
}

/// The topics of the log or of the second file.
fn topics(ui: &mut Ui, form: &Form, second: bool, out: &mut Vec<Command>) {
    let asked = &form.parts.asked;
    let chosen = if second { &asked.second_topics } else { &asked.options.topics };
    for topic in &form.parts.topics[usize::from(second)] {
        let mut read = chosen.contains(&topic.name);
        let said = format!("{} ({}, {} messages)", topic.name, topic.schema, topic.messages);
        if ui.checkbox(&mut read, said).changed() {
            edit(out, Edit::Topic(topic.name.clone(), second, read));
        }
    }
}

fn quantities(ui: &mut Ui, form: &Form, theme: &Theme, out: &mut Vec<Command>) {
    let columns: Vec<String> = ["as guessed".to_owned(), NOT_USED.to_owned()]
        .into_iter()
        .chain(form.headers.iter().enumerate().map(|(place, header)| format!("{}: {header}", place + 1)))
        .collect();
    let wide = (ui.available_width() - 190.0).clamp(90.0, 260.0);
    for (name, roles) in GROUPS {
        heading(ui, name, theme);
        Grid::new(name).num_columns(3).spacing(vec2(8.0, 4.0)).show(ui, |ui| {
            for role in roles {
                let key = role.key();
                let known = form.chosen.get(role);
                let none = if form.guessed.contains_key(role) { NOT_USED } else { "none" };
                let shown = known.and_then(|(place, _)| columns.get(place + 2)).map_or(none, String::as_str);
                match choice(ui, (key, role.sentence()), shown, wide, &columns) {
                    Some(1) => edit(out, Edit::Unused(*role)),
                    Some(picked) => edit(out, Edit::Column(*role, picked.checked_sub(2))),
                    None => {}
                }
                if let Some((_, unit)) = known {
                    unit_of(ui, *role, unit, out);
                }
                ui.end_row();
            }
        });
    }
}

fn unit_of(ui: &mut Ui, role: Role, unit: &'static str, out: &mut Vec<Command>) {
    let names: Vec<&str> = role.dimension().names().split(", ").collect();
    if names.len() < 2 {
        return;
    }
    let combo = ComboBox::from_id_salt((role.key(), "unit")).width(58.0).selected_text(unit).show_ui(ui, |ui| {
        for name in names {
            if ui.selectable_label(name == unit, name).clicked()
                && let Some(known) = role.dimension().unit(name)
            {
                edit(out, Edit::Unit(role, known.name));
            }
        }
    });
    let said = format!("{} unit", role.key());
    combo.response.widget_info(|| {
        let mut info = egui::WidgetInfo::labeled(egui::Role::ComboBox, true, &said);
        info.current_text_value = Some(unit.to_owned());
        info
    });
}

fn commands(ui: &mut Ui, form: &Form, theme: &Theme, out: &mut Vec<Command>) {
    heading(ui, "Commands", theme);
    let asked = &form.parts.asked;
    let second = form.parts.commands.as_ref();
    if ui.radio(!asked.motion && second.is_none(), "the log's own; without them the bend is estimated").clicked() {
        edit(out, Edit::Motion(false));
    }
    if ui.radio(asked.motion, "the scenario's motion").clicked() {
        edit(out, Edit::Motion(true));
    }
    let words = second.map_or("a second file …".to_owned(), |file| format!("a second file: {}", file.name));
    if ui.radio(second.is_some() && !asked.motion, words).clicked() {
        edit(out, Edit::Second);
    }
    if second.is_some() && !asked.motion {
        topics(ui, form, true, out);
    }
    heading(ui, "Frame and loop", theme);
    let mut fit = asked.fit_frame;
    if ui.checkbox(&mut fit, "Fit the frame to the readings before alarms are armed").changed() {
        edit(out, Edit::FitFrame(fit));
    }
    let mut own = asked.own_rate;
    if ui.checkbox(&mut own, "The spacing of the rows says how fast the loop ran, not the scenario").changed() {
        edit(out, Edit::OwnRate(own));
    }
}
