//! Carrying out what is asked of segments in series.

use crate::app::App;
use crate::app::apply::switched_off;
use crate::app::chain::ChainState;
use crate::app::chain::memo::lead_in;
use crate::app::chain::own::{Of, Own};
use crate::app::controls::control::Control;
use crate::app::stages::stage::Stage;
use crate::app::words::refusal;
use centrode_core::detect::chain::ChainMethod;
use centrode_core::scenario::chain::{ChainDraft, Change, Stands};
use centrode_core::scenario::keys::{KEYS, Key, Value};
use centrode_core::scenario::preset::Preset;
use centrode_core::scenario::{ChainScenario, Scenario};
use toml::{Table, Value as Toml};

/// What is asked of segments in series.
#[derive(Debug, Clone)]
pub enum Wish {
    /// Take a preset, and show it.
    Choose(&'static Preset),
    /// Look at a segment, from 0.
    Segment(usize),
    /// Look at a contact, from 0.
    Contact(usize),
    /// Set a number, in the unit it shows.
    Set(&'static Own, f64),
    /// Set a number from what a person typed.
    Enter(&'static Own, String),
    /// Switch a number off or on.
    Switch(&'static Own, bool),
    /// Give a number the preset's value.
    Reset(&'static Own),
    /// Put the chosen contact on a segment, from 0.
    PutOn(usize),
    /// Let the chosen contact hold the backbone, or only touch it.
    Clamp(bool),
    /// Let something else touch the chosen segment.
    AddContact,
    /// Take the chosen contact away.
    RemoveContact,
    /// Let a detector judge, or no longer.
    Detector(ChainMethod),
    /// Put trackers on every end disk, or on the last alone.
    TrackAll(bool),
    /// Let the plots show every segment, or all of the chosen one.
    PlotAll(bool),
    /// Which of what a run has to show they show then.
    Plot(usize),
}

/// Something that is refused: the path beside which it is told, and why.
type Refused = (String, String);

impl App {
    pub(in crate::app) fn wish_of_chain(&mut self, wish: Wish) {
        let chain = &mut self.state.chain;
        match wish {
            Wish::Choose(preset) => {
                self.state.stage = Stage::Chain;
                self.load_chain(ChainState { all: self.state.chain.all, ..ChainState::of(preset) });
            }
            Wish::Segment(segment) => chain.segment = segment,
            Wish::Contact(contact) => chain.contact = contact,
            Wish::PlotAll(all) => chain.all = all,
            Wish::Plot(shown) => chain.shown = shown,
            Wish::Set(own, value) => {
                self.sharing.slid = Some(own.key);
                self.set_own(own, Ok(Some(own.quantity.si(value))));
            }
            Wish::Enter(own, text) => self.set_own(own, own.read(&text)),
            Wish::Switch(own, on) => self.switch_own(own, on),
            Wish::Reset(own) => {
                let place = self.place_of(own);
                let path = own.path(place);
                let base = ChainDraft::of(self.state.chain.preset());
                let back = |path: String| {
                    let change = base.get(&path).cloned();
                    change.map_or_else(|| Change::Remove(path.clone()), |base| Change::Set(path.clone(), base))
                };
                let instead = instead(own, place).filter(|instead| base.get(instead).is_some());
                self.change_draft(&path, [path.clone()].into_iter().chain(instead).map(back));
            }
            Wish::PutOn(segment) => self.put_on(segment),
            Wish::Clamp(clamp) => self.clamp(clamp),
            Wish::AddContact => self.add_contact(),
            Wish::RemoveContact => {
                let path = format!("contact[{}]", chain.contact + 1);
                self.change_draft(&path, [Change::Remove(path.clone())]);
                let left = self.state.chain.draft.scenario().map_or(0, |scenario| scenario.contacts.len());
                self.state.chain.contact = self.state.chain.contact.min(left.saturating_sub(1));
                // What was refused there is of another contact now.
                self.chain.notes.retain(|path, _| !path.starts_with("contact"));
            }
            Wish::Detector(method) => self.toggle_detector(method),
            Wish::TrackAll(all) => {
                let value = Toml::String(if all { "all" } else { "tip" }.into());
                self.change_draft("tracker.disks", [Change::Set("tracker.disks".into(), value)]);
            }
        }
    }

    /// Shows an experiment with several segments from its beginning.
    pub(in crate::app) fn load_chain(&mut self, mut chain: ChainState) {
        self.chain.notes.clear();
        self.chain.remembered.clear();
        if let Ok(scenario) = chain.draft.scenario() {
            self.state.time = lead_in(&scenario);
            // What was looked at may be of a longer robot.
            chain.segment = chain.segment.min(scenario.segments.len().saturating_sub(1));
            chain.contact = chain.contact.min(scenario.contacts.len().saturating_sub(1));
        }
        self.state.chain = chain;
    }

    /// The segment or contact, from 0, whose number is meant.
    fn place_of(&self, own: &Own) -> usize {
        match own.of {
            Of::Segment => self.state.chain.segment,
            Of::Contact => self.state.chain.contact,
            Of::All => 0,
        }
    }

    /// Changes the text if what comes of it can be read; else says why not beside a path, and changes nothing.
    fn change_draft(&mut self, path: &str, changes: impl IntoIterator<Item = Change>) {
        match self.state.chain.draft.with(changes) {
            Ok(draft) => {
                self.chain.notes.remove(path);
                self.state.chain.draft = draft;
            }
            Err(refused) => {
                let why = refusal::of_chain(&refused);
                self.chain.notes.insert(path.into(), format!("{why}. Nothing was changed."));
            }
        }
    }

    fn set_own(&mut self, own: &'static Own, value: Result<Option<f64>, String>) {
        let place = self.place_of(own);
        let path = own.path(place);
        match value {
            Ok(Some(value)) => {
                let mut changes = vec![Change::Set(path.clone(), Toml::Float(value))];
                changes.extend(instead(own, place).map(Change::Remove));
                self.change_draft(&path, changes);
            }
            Ok(None) => self.switch_own(own, false),
            Err(note) => drop(self.chain.notes.insert(path, format!("{note}. Nothing was changed."))),
        }
    }

    fn switch_own(&mut self, own: &'static Own, on: bool) {
        let Some(off) = own.off else { return };
        let place = self.place_of(own);
        let path = own.path(place);
        let now = self.state.chain.draft.scenario().ok().and_then(|scenario| own.value(&scenario, place));
        if let Some(now) = now {
            self.chain.remembered.insert(path.clone(), now);
        }
        let otherwise = || self.chain.remembered.get(&path).copied().or_else(|| own.value(self.chain.base()?, place));
        let value =
            if on { Toml::Float(own.quantity.si(otherwise().unwrap_or(5.0))) } else { Toml::String(off.into()) };
        self.change_draft(&path, [Change::Set(path.clone(), value)]);
    }

    fn put_on(&mut self, segment: usize) {
        let Ok(scenario) = self.state.chain.draft.scenario() else { return };
        let (contact, place) = (self.state.chain.contact, self.state.chain.contact + 1);
        let (Some(now), Some(next)) = (scenario.contacts.get(contact), scenario.segments.get(segment)) else { return };
        // As far up the one as it was on the other.
        let length = |segment: usize| scenario.segments[segment].alone.scenario().robot.length;
        let at = (now.at / length(now.segment)).min(1.0) * next.alone.scenario().robot.length;
        let path = format!("contact[{place}].segment");
        let mut changes = vec![
            Change::Set(path.clone(), Toml::Integer(segment as i64 + 1)),
            Change::Set(format!("contact[{place}].at"), Toml::Float(at)),
            Change::Remove(format!("contact[{place}].disk")),
        ];
        if let Stands::From { time, .. } | Stands::Clamped { time } = now.stands {
            changes.push(Change::Set(format!("contact[{place}].time"), Toml::Float(time)));
            changes.push(Change::Remove(format!("contact[{place}].bend")));
        }
        self.change_draft(&path, changes);
    }

    fn clamp(&mut self, clamp: bool) {
        let place = self.state.chain.contact + 1;
        let path = format!("contact[{place}].kind");
        let kind = Toml::String(if clamp { "clamp" } else { "plane" }.into());
        let mut changes = vec![Change::Set(path.clone(), kind)];
        changes.extend(clamp.then(|| Change::Remove(format!("contact[{place}].tilt"))));
        self.change_draft(&path, changes);
    }

    fn add_contact(&mut self) {
        let Ok(scenario) = self.state.chain.draft.scenario() else { return };
        let segment = self.state.chain.segment.min(scenario.segments.len() - 1);
        let (at, time) = free_place(&scenario, segment);
        let table = Table::from_iter([
            ("segment".to_owned(), Toml::Integer(segment as i64 + 1)),
            ("at".to_owned(), Toml::Float(at)),
            ("time".to_owned(), Toml::Float(time)),
        ]);
        let before = scenario.contacts.len();
        self.change_draft("contact", [Change::Add("contact", table)]);
        if self.state.chain.draft.scenario().is_ok_and(|scenario| scenario.contacts.len() > before) {
            self.state.chain.contact = before;
        }
    }

    fn toggle_detector(&mut self, method: ChainMethod) {
        let Ok(scenario) = self.state.chain.draft.scenario() else { return };
        let judged = judging(&scenario);
        let keys = all_detectors().filter(|other| judged.contains(other) != (*other == method));
        let list = keys.map(|method| Toml::String(method.key().into())).collect();
        self.change_draft("detection.detectors", [Change::Set("detection.detectors".into(), Toml::Array(list))]);
    }

    /// Changes what controls (`asked`, by key) set of the chosen segment or of all: as [`App::change`] does for one segment.
    pub(in crate::app) fn change_chain(
        &mut self,
        asked: &[&'static str],
        change: impl FnOnce(&mut Scenario) -> Result<(), String>,
    ) {
        let first = asked.first().copied().unwrap_or_default();
        let chain = &self.state.chain;
        let path = path(first, chain.segment);
        let made = chain.draft.scenario().map_err(|refused| (path.clone(), refusal::of_chain(&refused))).and_then(
            |scenario| {
                let before = alone(&scenario, chain.segment, first);
                let mut after = before.clone();
                change(&mut after).map_err(|note| (path.clone(), note))?;
                let changes: Vec<Change> = KEYS
                    .iter()
                    .filter(|key| !key.agrees(before, &after))
                    .map(|key| written(key, &after, chain.segment))
                    .collect();
                let drafted = chain.draft.with(changes);
                let drafted = drafted.map_err(|refused| -> Refused { (path.clone(), refusal::of_chain(&refused)) })?;
                Ok((drafted, switched_off(before, &after).collect::<Vec<_>>()))
            },
        );
        match made {
            Ok((draft, off)) => {
                let segment = self.state.chain.segment;
                let off = off.into_iter().map(|(key, value)| (self::path(key, segment), value));
                self.chain.remembered.extend(off);
                self.chain.notes.remove(&path);
                self.state.chain.draft = draft;
            }
            Err((path, why)) => drop(self.chain.notes.insert(path, format!("{why}. Nothing was changed."))),
        }
    }

    /// What a control that is switched off goes back to, in the unit shown.
    pub(in crate::app) fn otherwise_of_chain(&self, control: &Control) -> Option<f64> {
        let chain = &self.state.chain;
        let remembered = self.chain.remembered.get(&path(control.key, chain.segment)).copied();
        let base = self.chain.base().and_then(|base| control.value(alone(base, chain.segment, control.key)));
        remembered.or(base).or_else(|| control.value(&Scenario::default()))
    }
}

/// The path of what else can stand in the place of a value: a place can be given as a disk, a time as a bend.
fn instead(own: &Own, place: usize) -> Option<String> {
    let key = match (own.of, own.key) {
        (Of::Contact, "at") => "disk",
        (Of::Contact, "time") => "bend",
        _ => return None,
    };
    Some(format!("contact[{}].{key}", place + 1))
}

/// The detectors that an experiment with several segments can have.
pub fn all_detectors() -> impl Iterator<Item = ChainMethod> {
    use centrode_core::detect::Method;
    let single = Method::ALL.iter().copied().filter(|method| *method != Method::Jfd).map(ChainMethod::Of);
    single.chain([ChainMethod::Smd])
}

/// Those that judge.
#[must_use]
pub fn judging(scenario: &ChainScenario) -> Vec<ChainMethod> {
    let single = scenario.common().detection.detectors.iter().map(ChainMethod::Of);
    single.chain(scenario.smd.map(|_| ChainMethod::Smd)).collect()
}

/// Whether a key is of a segment rather than of all of them.
fn is_of_segment(key: &str) -> bool {
    key.starts_with("robot.") || key.starts_with("motion.") && key != "motion.end"
}

/// The path of a key in the text, for the chosen segment (from 0).
#[must_use]
pub fn path(key: &str, segment: usize) -> String {
    if key == "motion.end" {
        return "end".into();
    }
    match key.strip_prefix("robot.") {
        Some(own) => format!("segment[{}].{own}", segment + 1),
        None if is_of_segment(key) => format!("segment[{}].{key}", segment + 1),
        None => key.into(),
    }
}

/// The experiment in which a key is looked up: with the chosen segment alone, or what is common to all.
#[must_use]
pub fn alone<'s>(scenario: &'s ChainScenario, segment: usize, key: &str) -> &'s Scenario {
    let own = scenario.segments.get(segment).filter(|_| is_of_segment(key));
    own.map_or_else(|| scenario.common(), |own| own.alone.scenario())
}

/// A key's value as a change of the text.
fn written(key: &'static Key, scenario: &Scenario, segment: usize) -> Change {
    let path = path(key.path, segment);
    let number = |value: f64| Toml::Float(value);
    let word = |word: &str| Toml::String(word.into());
    match key.get(scenario) {
        None => Change::Remove(path),
        Some(value) => Change::Set(
            path,
            match value {
                Value::Number(value) => number(value),
                Value::Whole(value) => i64::try_from(value).map_or_else(|_| number(value as f64), Toml::Integer),
                Value::Word(text) | Value::Off(text) => word(text),
                Value::Words(words) => Toml::Array(words.into_iter().map(word).collect()),
                Value::List(values) => Toml::Array(values.into_iter().map(number).collect()),
                Value::Other(text) => word(&text),
            },
        ),
    }
}

/// An arc length on a segment (m) where nothing touches yet, the middle first, and a time during its motion at which nothing else begins, s.
fn free_place(scenario: &ChainScenario, segment: usize) -> (f64, f64) {
    let own = &scenario.segments[segment];
    let length = own.alone.scenario().robot.length;
    let taken = |at: f64| {
        scenario.contacts.iter().any(|contact| contact.segment == segment && (contact.at - at).abs() < 0.02 * length)
    };
    let shares = [0.5, 0.75, 0.25, 0.9, 0.6, 0.4, 0.1, 0.8, 0.3, 0.7, 0.2, 0.65, 0.35];
    let share = shares.into_iter().find(|share| !taken(share * length)).unwrap_or(0.55);
    let motion = own.motion();
    let last = scenario.contacts.iter().filter_map(|contact| match contact.stands {
        Stands::From { time, .. } | Stands::Clamped { time } => Some(time),
        Stands::Always { .. } => None,
    });
    let middle = 0.5 * (motion.start + motion.finish);
    let after = last.fold(f64::NEG_INFINITY, f64::max) + 1.0;
    let time = if after > middle && after < motion.finish { after } else { middle };
    (share * length, (time.clamp(0.0, motion.end) * 100.0).round() / 100.0)
}
