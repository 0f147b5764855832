//! The controls of segments in series: which segment, its motion, what touches, trackers and detectors, and what is common to all.

use crate::app::chain::Chain;
use crate::app::chain::apply::{Wish, all_detectors, alone, judging, path};
use crate::app::chain::own::{self, Of, Own};
use crate::app::command::Command;
use crate::app::controls::control::{Control, Group};
use crate::app::controls::row::{self, Asked, Context, Row};
use crate::app::controls::table::GROUPS;
use crate::app::controls::{LEAST, header};
use crate::app::layout;
use crate::app::mirror;
use crate::app::panels::sheet;
use crate::app::state::State;
use crate::app::theme::Theme;
use crate::app::widgets::button::{button, named};
use crate::app::widgets::rail::Rail;
use crate::app::widgets::segmented::{segmented, several};
use crate::app::widgets::{finger, text};
use crate::app::{controls, panels};
use centrode_core::detect::chain::ChainMethod;
use centrode_core::scenario::ChainScenario;
use centrode_core::scenario::chain::{Stands, Tracked};
use egui::{Frame, Margin, Rect, Sense, Ui, UiBuilder, pos2, vec2};

/// Groups that are of segments in series alone, and whether they are folded until someone opens them.
pub const OWN: [(&str, bool); 5] =
    [("Segment motion", false), ("Contacts", false), ("Trackers", false), ("Detectors", false), ("Segment body", true)];
/// Groups of one segment that hold for segments in series as they are.
const COMMON: [&str; 6] = ["Sensors", "Filter", "Thresholds", "Tracker", "Calibration errors", "Calibration filter"];
/// So many segments or contacts stand in a row.
const IN_A_ROW: usize = 6;

/// What the panel needs to know.
pub struct Inputs<'a> {
    /// What is set.
    pub state: &'a State,
    /// The run, the preset and what was refused.
    pub chain: &'a Chain,
    /// Whether rows are to be large enough for a finger.
    pub touch: bool,
}

/// A panel being shown.
struct Panel<'a> {
    inputs: &'a Inputs<'a>,
    scenario: &'a ChainScenario,
    base: &'a ChainScenario,
    /// The chosen segment and contact, from 0.
    segment: usize,
    contact: usize,
}

/// Whether segments in series have a control, by its key.
#[must_use]
pub fn has(key: &str) -> bool {
    let alone = ["contact.", "load.", "load_cells.", "detection.xi1", "detection.detectors", "robot.disks"];
    !alone.iter().any(|start| key.starts_with(start))
}

/// Shows the controls.
pub fn controls(ui: &mut Ui, inputs: &Inputs<'_>, out: &mut Vec<Command>) {
    let set = &inputs.state.chain;
    let (Ok(scenario), Some(base)) = (set.draft.scenario(), inputs.chain.base()) else { return };
    let panel = Panel {
        inputs,
        segment: set.segment.min(scenario.segments.len() - 1),
        contact: set.contact.min(scenario.contacts.len().saturating_sub(1)),
        scenario: &scenario,
        base,
    };
    let edge = if inputs.touch { 4.0 } else { 10.0 };
    let mut scrolled = ui.max_rect();
    if scrolled.height() > LEAST {
        let (above, foot) = scrolled.split_top_bottom_at_y(scrolled.bottom() - 52.0);
        layout::inside(ui, "reset", foot.shrink2(vec2(16.0, edge)), |ui| {
            let name = panels::title::name(set.preset());
            controls::reset_button(ui, panel.scenario != base, &name, out);
        });
        scrolled = above;
    }
    let mut ui = ui.new_child(UiBuilder::new().max_rect(scrolled));
    sheet::scrolled(&mut ui, |ui| {
        Frame::new().inner_margin(Margin { left: 16, right: 16, top: 6, bottom: 6 }).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            if let Some(refusal) = inputs.chain.memo.as_ref().and_then(|memo| memo.refusal()) {
                row::refusal(ui, &format!("{refusal}. What is shown is the last run that was possible."));
            }
            if inputs.chain.logs.shown.is_some() {
                row::note(ui, "A log is shown. What is set here judges it; motions that it holds itself, contacts and sensors are those of simulations.");
            }
            panel.segments(ui, out);
            for (name, _) in OWN {
                panel.own(ui, name, out);
            }
            for group in GROUPS.iter().filter(|group| COMMON.contains(&group.name)) {
                panel.common(ui, group, out);
            }
        });
    });
}

impl Panel<'_> {
    fn note(&self, path: &str) -> Option<&str> {
        self.inputs.chain.notes.get(path).map(String::as_str)
    }

    /// What stands in rows of at most six, the chosen one raised; what was clicked.
    fn pick(&self, ui: &mut Ui, (label, word): (&str, &str), count: usize, chosen: usize) -> Option<usize> {
        let names: Vec<String> = match count {
            1..=3 => (1..=count).map(|k| format!("{word} {k}")).collect(),
            _ => (1..=count).map(|k| k.to_string()).collect(),
        };
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let mut picked = None;
        for (line, row) in names.chunks(IN_A_ROW).enumerate() {
            let size = vec2(ui.available_width(), finger::at_least(ui, 28.0));
            let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
            let name = if line == 0 { label.to_owned() } else { format!("{label}, row {}", line + 1) };
            let first = line * IN_A_ROW;
            let here = chosen.checked_sub(first).filter(|at| *at < row.len()).unwrap_or(usize::MAX);
            picked = segmented(ui, rect, &name, row, here).map(|at| first + at).or(picked);
            ui.add_space(3.0);
        }
        picked
    }

    fn segments(&self, ui: &mut Ui, out: &mut Vec<Command>) {
        ui.add_space(4.0);
        let picked = self.pick(ui, ("Segment", "Segment"), self.scenario.segments.len(), self.segment);
        out.extend(picked.map(|segment| Command::Chain(Wish::Segment(segment))));
    }

    fn own(&self, ui: &mut Ui, name: &'static str, out: &mut Vec<Command>) {
        let touch = self.inputs.touch;
        if !header(ui, name, !self.inputs.state.folded.contains(name), touch, out) {
            return;
        }
        ui.push_id(name, |ui| {
            mirror::mark(ui, mirror::Part::Group, name);
            match name {
                "Segment motion" => self.motion(ui, out),
                "Contacts" => self.contacts(ui, out),
                "Trackers" => self.trackers(ui, out),
                "Detectors" => self.detectors(ui, out),
                _ => self.body(ui, out),
            }
        });
    }

    fn motion(&self, ui: &mut Ui, out: &mut Vec<Command>) {
        for key in ["motion.theta_start", "motion.theta_end", "motion.start", "motion.finish", "motion.delta"] {
            self.by_key(ui, key, out);
        }
        for row in &own::TURN {
            self.row(ui, row, self.segment, out);
        }
        self.by_key(ui, "motion.end", out);
    }

    fn body(&self, ui: &mut Ui, out: &mut Vec<Command>) {
        let group = GROUPS.iter().find(|group| group.name == "Robot");
        for control in group.into_iter().flat_map(|group| group.controls) {
            self.control(ui, control, out);
        }
        for row in &own::BODY {
            self.row(ui, row, self.segment, out);
        }
    }

    fn contacts(&self, ui: &mut Ui, out: &mut Vec<Command>) {
        let count = self.scenario.contacts.len();
        if count == 0 {
            self.said(ui, "Nothing touches the robot.");
        } else {
            let picked = self.pick(ui, ("Contact", "Contact"), count, self.contact);
            out.extend(picked.map(|contact| Command::Chain(Wish::Contact(contact))));
            self.contact(ui, out);
        }
        let theme = Theme::of(ui);
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), finger::at_least(ui, 32.0)), Sense::hover());
        let half = 0.5 * (rect.width() - 8.0);
        let left = Rect::from_min_max(rect.min, pos2(rect.left() + half, rect.bottom())).shrink2(vec2(0.0, 1.0));
        if button(ui, left, "Add a contact", &theme) {
            out.push(Command::Chain(Wish::AddContact));
        }
        let right = left.translate(vec2(half + 8.0, 0.0));
        let name = format!("Remove contact {}", self.contact + 1);
        if count > 0 && named(ui, right, ("Remove", &name), &theme) {
            out.push(Command::Chain(Wish::RemoveContact));
        }
        if let Some(note) = self.note("contact").or_else(|| self.note(&format!("contact[{}]", self.contact + 1))) {
            row::refusal(ui, note);
        }
        ui.add_space(6.0);
    }

    /// The chosen contact.
    fn contact(&self, ui: &mut Ui, out: &mut Vec<Command>) {
        let Some(contact) = self.scenario.contacts.get(self.contact) else { return };
        let of = |key: &str| format!("contact[{}].{key}", self.contact + 1);
        self.said(ui, "On segment");
        let picked = self.pick(ui, ("On segment", "Segment"), self.scenario.segments.len(), contact.segment);
        out.extend(picked.map(|segment| Command::Chain(Wish::PutOn(segment))));
        if let Some(note) = self.note(&of("segment")) {
            row::refusal(ui, note);
        }
        self.row(ui, &own::AT, self.contact, out);
        match contact.stands {
            Stands::Always { normal, .. } => {
                let [x, y, z] = <[f64; 3]>::from(normal).map(|part| crate::app::charts::notation::number(part, 2));
                self.said(ui, &format!("A plane that always stands there, its normal ({x}, {y}, {z})."));
                self.row(ui, &own::OFFSET, self.contact, out);
            }
            Stands::From { .. } | Stands::Clamped { .. } => {
                let clamps = matches!(contact.stands, Stands::Clamped { .. });
                let size = vec2(ui.available_width(), finger::at_least(ui, 28.0));
                let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
                let picked = segmented(ui, rect, "What it is", &["Plane", "Clamp"], usize::from(clamps));
                out.extend(picked.map(|picked| Command::Chain(Wish::Clamp(picked == 1))));
                if let Some(note) = self.note(&of("kind")) {
                    row::refusal(ui, note);
                }
                ui.add_space(5.0);
                self.row(ui, &own::TIME, self.contact, out);
                if !clamps {
                    self.row(ui, &own::TILT, self.contact, out);
                }
            }
        }
    }

    fn trackers(&self, ui: &mut Ui, out: &mut Vec<Command>) {
        let size = vec2(ui.available_width(), finger::at_least(ui, 28.0));
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let tip = self.scenario.tracked == Tracked::Tip;
        let picked = segmented(ui, rect, "Trackers on", &["Every end disk", "Last end disk"], usize::from(tip));
        out.extend(picked.map(|picked| Command::Chain(Wish::TrackAll(picked == 0))));
        if let Some(note) = self.note("tracker.disks") {
            row::refusal(ui, note);
        }
        ui.add_space(6.0);
    }

    fn detectors(&self, ui: &mut Ui, out: &mut Vec<Command>) {
        let all: Vec<ChainMethod> = all_detectors().collect();
        let names: Vec<&str> = all.iter().map(|method| name(*method)).collect();
        let rows = names.len().div_ceil(2) as f32;
        let size = vec2(ui.available_width(), rows * (finger::at_least(ui, 28.0) + 2.0));
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let judged = judging(self.scenario);
        let picked = several(ui, rect, "Detectors", (&names, 2), |at| judged.contains(&all[at]));
        out.extend(picked.map(|at| Command::Chain(Wish::Detector(all[at]))));
        if let Some(note) = self.note("detection.detectors") {
            row::refusal(ui, note);
        }
        ui.add_space(5.0);
        if self.scenario.smd.is_some() {
            for row in &own::SCREW {
                self.row(ui, row, 0, out);
            }
        }
    }

    /// A group that is that of one segment.
    fn common(&self, ui: &mut Ui, group: &'static Group, out: &mut Vec<Command>) {
        let open = !self.inputs.state.folded.contains(group.name);
        if !header(ui, group.name, open, self.inputs.touch, out) {
            return;
        }
        ui.push_id(group.name, |ui| {
            mirror::mark(ui, mirror::Part::Group, group.name);
            let common = self.scenario.common();
            let shown = |control: &&Control| has(control.key) && control.only.is_none_or(|only| only(common));
            for control in group.controls.iter().filter(shown) {
                self.control(ui, control, out);
            }
            for choice in group.choices.iter().filter(|choice| has(choice.of.path)) {
                let note = self.note(choice.of.path);
                let (scenario, base) = (common, self.base.common());
                let touch = self.inputs.touch;
                row::choice(ui, choice, &Context { scenario, base, note, remembered: None, touch }, out);
            }
        });
    }

    fn by_key(&self, ui: &mut Ui, key: &str, out: &mut Vec<Command>) {
        if let Some(control) = controls::table::control(key) {
            self.control(ui, control, out);
        }
    }

    /// A control of one segment, for the chosen one or for all.
    fn control(&self, ui: &mut Ui, control: &'static Control, out: &mut Vec<Command>) {
        let scenario = alone(self.scenario, self.segment, control.key);
        let base = alone(self.base, self.segment, control.key);
        let path = path(control.key, self.segment);
        let remembered = self.inputs.chain.remembered.get(&path).copied().or_else(|| control.value(base));
        let touch = self.inputs.touch;
        row::number(ui, control, &Context { scenario, base, note: self.note(&path), remembered, touch }, out);
    }

    /// A number that only segments in series have.
    fn row(&self, ui: &mut Ui, own: &'static Own, place: usize, out: &mut Vec<Command>) {
        let path = own.path(place);
        let value = own.value(self.scenario, place);
        let base = own.value(self.base, place);
        let (shown, unit) = own.text(value);
        let known = match own.of {
            Of::Segment => place < self.base.segments.len(),
            Of::Contact => place < self.base.contacts.len(),
            Of::All => true,
        };
        let rail = Rail { range: own.rail(self.scenario, place), scale: own.scale };
        let asked = row::row(
            ui,
            &Row {
                key: own.key,
                label: own.label,
                tip: own.tip,
                differs: known && base != value,
                shown: (&shown, unit),
                digits: rail.range.0 >= 0.0 && own.off.is_none(),
                value,
                remembered: self.inputs.chain.remembered.get(&path).copied().or(base),
                rail,
                notch: base.filter(|_| known),
                switch: own.off.map(|_| "given"),
                note: self.note(&path),
                touch: self.inputs.touch,
            },
        );
        out.extend(asked.map(|asked| {
            Command::Chain(match asked {
                Asked::Reset => Wish::Reset(own),
                Asked::Typed(text) => Wish::Enter(own, text),
                Asked::Switch(on) => Wish::Switch(own, on),
                Asked::Slid(value) => Wish::Set(own, value),
            })
        }));
    }

    fn said(&self, ui: &mut Ui, said: &str) {
        let theme = Theme::of(ui);
        ui.add_space(3.0);
        ui.add(egui::Label::new(text::rich(said, 12.5, theme.dim)).wrap());
        ui.add_space(3.0);
    }
}

/// What a detector is called on a switch.
fn name(method: ChainMethod) -> &'static str {
    use centrode_core::detect::Method;
    match method {
        ChainMethod::Of(Method::Fcd) => "Centrode",
        ChainMethod::Of(Method::FcdConsistent) => "Consistent",
        ChainMethod::Of(Method::FcdVelocity) => "Velocity",
        ChainMethod::Of(Method::Jfd) => "Joint force",
        ChainMethod::Of(Method::Cusum) => "CUSUM",
        ChainMethod::Of(Method::Glr) => "GLR",
        ChainMethod::Smd => "Screw motion",
    }
}
