//! What a host page may ask of the page in its frame, and what it is told: see docs/EMBED.md.
//!
//! A request comes in by [`App::request`]; answers and events go out as [`Effect::Post`]. Values are read by the table of
//! keys and as a link has them, in SI, and all of a request is taken or nothing.

use serde_json::{Map, Value as Json, json};

use super::App;
use crate::app::link::{self, Effect};
use crate::app::words::story::Phase;
use crate::app::{memo, state};
use centrode_core::detect::Event;
use centrode_core::run::Run;
use centrode_core::scenario::keys::allowed::Limit;
use centrode_core::scenario::keys::{self, Allowed, Key, Quantity, Units, Value};
use centrode_core::scenario::link::{Link, PAGE_KEYS, Page, no_key, read_text};
use centrode_core::scenario::{Refused, Scenario, ScenarioError, preset};

/// The way of speaking that is understood here, `centrode` in each message.
pub const VERSION: u64 = 1;
/// What can be asked for, as `do` in a request.
pub const REQUESTS: [&str; 5] = ["set", "get", "play", "pause", "seek"];

/// What the host was told of the run.
#[derive(Debug, Default)]
pub struct Listener {
    version: Option<u64>,
    result: Json,
}

/// One thing in a request that was not taken.
struct Refusal {
    key: String,
    value: Json,
    allowed: String,
    message: String,
}

impl Refusal {
    /// Of what is no key: part of the request itself.
    fn part(key: &str, value: &Json, allowed: &str) -> Self {
        let message = match value {
            Json::Null => format!("{key} is missing: {allowed}"),
            value => format!("{key} = {value} is not allowed: {allowed}"),
        };
        Self { key: key.into(), value: value.clone(), allowed: allowed.into(), message }
    }
}

impl From<ScenarioError> for Refusal {
    fn from(error: ScenarioError) -> Self {
        let message = error.to_string();
        let (key, value, allowed) = match error {
            ScenarioError::Value(refused) => {
                let Refused { key, quantity, value, allowed } = *refused;
                (key, json_of(&value), allowed.words(quantity, Units::Si))
            }
            ScenarioError::UnknownKey { key, known } => (key, Json::Null, known),
            ScenarioError::UnknownPreset { name, known } => ("preset".into(), name.into(), known),
            _ => (String::new(), Json::Null, String::new()),
        };
        Self { key, value, allowed, message }
    }
}

impl App {
    /// A request of the host page, JSON. It is answered, and refused whole when a part of it is.
    pub fn request(&mut self, text: &str) {
        let request = serde_json::from_str::<Json>(text).unwrap_or_default();
        let answer = match self.obey(&request) {
            Ok(asked) => {
                self.memo.update(&self.state.scenario);
                let mut picture = self.picture();
                if !asked.is_empty() {
                    picture.insert("asked".into(), asked.into());
                }
                said("answer", picture)
            }
            Err(refused) => {
                let message = refused.iter().map(|refusal| refusal.message.as_str()).collect::<Vec<_>>().join("; ");
                let list = refused.into_iter().map(|Refusal { key, value, allowed, message }| {
                    json!({ "key": key, "value": value, "allowed": allowed, "message": message })
                });
                said("error", fields(json!({ "message": message, "refused": list.collect::<Vec<_>>() })))
            }
        };
        let echo = ["id", "do"].into_iter().filter_map(|name| Some((name.to_owned(), request.get(name)?.clone())));
        self.post(answer.into_iter().chain(echo).collect());
        self.tell_host();
    }

    /// Tells the host that it can ask from now on, and what the page is.
    pub fn ready(&mut self) {
        self.tell_host();
        let mut picture = self.picture();
        picture.insert("version".into(), env!("CARGO_PKG_VERSION").into());
        self.post(said("ready", picture));
    }

    /// Tells the host when another result follows from what is set.
    pub(super) fn tell_host(&mut self) {
        let version = self.memo.version();
        let Some(listener) = self.listener.as_mut().filter(|listener| listener.version != Some(version)) else {
            return;
        };
        let result = result(self.memo.run());
        let first = listener.version.replace(version).is_none();
        if listener.result != result {
            listener.result = result.clone();
            if !first {
                self.post(said("result", fields(json!({ "result": result }))));
            }
        }
    }

    /// Tells the host of alarms that playback passes on its way from one time (s) to another.
    pub(super) fn pass(&mut self, from: f64, to: f64) {
        let run = self.memo.run();
        // A log stays on this device.
        if self.listener.is_none() || run.is_recorded() {
            return;
        }
        let within = |time: &f64| (from < *time || from == 0.0 && *time == 0.0) && *time <= to;
        let raised = run.events().iter().filter(|event| within(&event.raised)).map(|event| (event.raised, event, true));
        let cleared = run.events().iter().filter_map(|event| Some((event.cleared.filter(within)?, event, false)));
        let mut passed: Vec<_> = raised.chain(cleared).collect();
        passed.sort_by(|one, other| one.0.total_cmp(&other.0));
        let told: Vec<_> = passed.into_iter().map(|(time, event, raised)| alarm(run, time, event, raised)).collect();
        told.into_iter().for_each(|told| self.post(said("event", told)));
    }

    fn post(&mut self, message: Map<String, Json>) {
        self.sharing.hand_out(Effect::Post(Json::Object(message).to_string()));
    }

    /// Does what is asked, and gives what was asked for by key.
    fn obey(&mut self, request: &Json) -> Result<Map<String, Json>, Vec<Refusal>> {
        let part = |name: &str| request.get(name).unwrap_or(&Json::Null);
        if part("centrode").as_u64() != Some(VERSION) {
            return Err(vec![Refusal::part(
                "centrode",
                part("centrode"),
                &format!("{VERSION}, the version spoken here"),
            )]);
        }
        match part("do").as_str().unwrap_or_default() {
            "set" => self.set(&wishes(request)?)?,
            "get" => return self.asked(request),
            "play" if !self.state.playing => self.toggle_play(),
            "play" => {}
            "pause" => self.state.playing = false,
            "seek" => self.seek(part("time"))?,
            _ => return Err(vec![Refusal::part("do", part("do"), &format!("one of {}", REQUESTS.join(", ")))]),
        }
        Ok(Map::new())
    }

    fn seek(&mut self, time: &Json) -> Result<(), Vec<Refusal>> {
        // The end of a log is no host's business.
        let end = self.memo.plan().scenario().motion.end;
        let allowed = Allowed::Range(Limit::At(0.0), Limit::Key("motion.end", Some(end)));
        let given = time.as_f64().filter(|given| allowed.has(*given));
        self.state.time =
            given.ok_or_else(|| vec![Refusal::part("time", time, &allowed.words(Quantity::Time, Units::Si))])?;
        Ok(())
    }

    /// Gives keys values, all of them or none.
    fn set(&mut self, wishes: &Map<String, Json>) -> Result<(), Vec<Refusal>> {
        let mut refused = Vec::new();
        let (mut chosen, mut scenario) = (self.state.preset(), self.state.scenario.clone());
        let mut page = link::page(&self.state, self.cursor());
        // A preset comes first: the other keys change it.
        if let Some(name) = wishes.get("preset") {
            match preset::find(&text(name)).and_then(|preset| Ok((preset, preset.scenario()?))) {
                Ok(found) => (chosen, scenario) = found,
                Err(error) => refused.push(error.into()),
            }
        }
        for (name, value) in wishes.iter().filter(|(name, _)| *name != "preset") {
            if let Err(error) = wish(name, value, wishes, (&mut scenario, &mut page)) {
                refused.push(error.into());
            }
        }
        for (name, asked) in [("tour", page.tour.is_some()), ("challenge", page.challenge.is_some())] {
            if asked {
                let asked = wishes.get(name).unwrap_or(&Json::Null);
                refused.push(Refusal::part(name, asked, &format!("a {name} is open in a page of its own only")));
            }
        }
        if let Some(embed) = self.embed
            && !embed.views().contains(&page.view)
        {
            let allowed = Allowed::Words(embed.views()).words(Quantity::Word, Units::Si);
            refused.push(Refusal::part("view", &page.view.into(), &format!("{allowed} in this frame")));
        }
        if !wishes.contains_key("t") {
            page.time = page.time.map(|time| time.min(scenario.motion.end));
        }
        if !refused.is_empty() {
            return Err(refused);
        }
        let one = |error: ScenarioError| vec![Refusal::from(error)];
        memo::check(&scenario).map_err(one)?;
        let link = Link::new(chosen, &scenario, page).map_err(one)?;
        if wishes.contains_key("preset") {
            self.state.preset = chosen.name.into();
            self.base = state::shipped(chosen);
            self.load(scenario);
        } else {
            self.remember(&scenario);
            self.notes.clear();
            self.state.scenario = scenario;
        }
        self.load_link(&link);
        if let Some(time) = link.page.time.filter(|_| wishes.contains_key("t")) {
            (self.state.time, self.state.playing) = (time, false);
        }
        Ok(())
    }

    /// The values of the keys that are asked for by name, whether they differ from the preset or not.
    fn asked(&self, request: &Json) -> Result<Map<String, Json>, Vec<Refusal>> {
        let one = request.get("key").into_iter();
        let several = request.get("keys").map(|keys| keys.as_array().cloned().unwrap_or_else(|| vec![keys.clone()]));
        let names: Vec<Json> = one.cloned().chain(several.into_iter().flatten()).collect();
        let page = link::page(&self.state, self.cursor());
        let (mut values, mut refused) = (Map::new(), Vec::new());
        for name in names.iter().map(text) {
            let of_page = PAGE_KEYS.iter().find(|key| key.name == name);
            match (keys::find(&name), of_page) {
                (Some(key), _) => drop(values.insert(name, held(key.get(&self.state.scenario)))),
                (None, Some(key)) => drop(values.insert(name, held(key.get(&page)))),
                (None, None) if name == "preset" => drop(values.insert(name, self.state.preset.as_str().into())),
                (None, None) => refused.push(no_key(&name, "").into()),
            }
        }
        if refused.is_empty() { Ok(values) } else { Err(refused) }
    }

    /// What the page is: what differs from its preset, where playback stands, the link to all that, and the result.
    fn picture(&self) -> Map<String, Json> {
        let (run, time) = (self.memo.run(), self.cursor());
        let link = self.link().ok();
        let changes = link.as_ref().map(Link::changes).unwrap_or_default();
        let values: Map<String, Json> = changes.iter().map(|(key, value)| (key.path.into(), json_of(value))).collect();
        let address = link.as_ref().and_then(|link| link.at(&self.sharing.address).or_else(|_| link.fragment()).ok());
        fields(json!({
            "preset": self.state.preset,
            "values": values,
            "state": {
                "phase": (!run.is_recorded()).then(|| Phase::at(run, time).words().to_lowercase()),
                "time": time,
                "end": (!run.is_recorded()).then(|| self.end()),
                "playing": self.state.playing,
                "speed": self.state.speed,
                "loop": self.state.looping,
                "view": self.state.stage.key(),
            },
            "link": address,
            "result": result(run),
        }))
    }
}

/// A message with its kind.
fn said(event: &str, mut fields: Map<String, Json>) -> Map<String, Json> {
    fields.insert("centrode".into(), VERSION.into());
    fields.insert("event".into(), event.into());
    fields
}

/// The fields of an object.
fn fields(object: Json) -> Map<String, Json> {
    match object {
        Json::Object(fields) => fields,
        _ => Map::new(),
    }
}

/// The values that a request is to set, by key.
fn wishes(request: &Json) -> Result<Map<String, Json>, Vec<Refusal>> {
    let refused = |name: &str, value: &Json, allowed: &str| Err(vec![Refusal::part(name, value, allowed)]);
    let mut wishes = match request.get("values") {
        None => Map::new(),
        Some(Json::Object(values)) => values.clone(),
        Some(other) => return refused("values", other, "an object that gives keys values"),
    };
    match (request.get("key"), request.get("value")) {
        (Some(Json::String(key)), Some(value)) => drop(wishes.insert(key.clone(), value.clone())),
        (Some(Json::String(_)), None) => return refused("value", &Json::Null, "a number, a list of numbers or a text"),
        (Some(other), _) => return refused("key", other, "the name of a key"),
        (None, _) if wishes.is_empty() => {
            return refused("key", &Json::Null, "set takes a key and a value, or values, an object of them");
        }
        (None, _) => {}
    }
    Ok(wishes)
}

/// Gives one key its value.
fn wish(
    name: &str,
    value: &Json,
    wishes: &Map<String, Json>,
    (scenario, page): (&mut Scenario, &mut Page),
) -> Result<(), ScenarioError> {
    if PAGE_KEYS.iter().any(|key| key.name == name) {
        return page.enter(name, &text(value));
    }
    let key = keys::find(name).ok_or_else(|| no_key(name, &text(value)))?;
    if let Some(other) = key.other().filter(|other| wishes.contains_key(other.path)) {
        return Err(key.refuse(Value::Other(text(value)), Allowed::Without(other.path)));
    }
    key.set(scenario, read(key, value)?)
}

/// Reads a value of a key: a number, several of them, or a text as a link has it.
fn read(key: &'static Key, value: &Json) -> Result<Value, ScenarioError> {
    match value {
        Json::String(text) => read_text(key, text),
        Json::Number(_) => key.read(&toml_of(value)),
        Json::Array(parts) => key.read(&toml::Value::Array(parts.iter().map(toml_of).collect())),
        _ => Err(key.refuse(Value::Other(value.to_string()), key.allowed)),
    }
}

fn toml_of(value: &Json) -> toml::Value {
    match (value.as_i64(), value.as_f64()) {
        (Some(whole), _) => toml::Value::Integer(whole),
        (None, Some(number)) => toml::Value::Float(number),
        (None, None) => toml::Value::String(text(value)),
    }
}

/// A value as a link would have it.
fn text(value: &Json) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

fn held(value: Option<Value>) -> Json {
    value.as_ref().map_or(Json::Null, json_of)
}

fn json_of(value: &Value) -> Json {
    match value {
        Value::Number(number) => json!(number),
        Value::Whole(whole) => json!(whole),
        Value::Word(word) | Value::Off(word) => json!(word),
        Value::Words(words) => json!(words),
        Value::List(numbers) => json!(numbers),
        Value::Other(text) => json!(text),
    }
}

/// What a run comes to, with the names of `centrode run --json`; null for a log, which stays on this device.
fn result(run: &Run) -> Json {
    if run.is_recorded() {
        return Json::Null;
    }
    let contact = run.plan.contact().zip(run.contact_time());
    let contact =
        contact.map(|(contact, time)| json!({ "time": time, "arc_length": contact.arc_length, "bend": contact.bend }));
    let detection = run.detection().map(|detection| {
        let mut found = fields(json!(detection));
        found.insert("delay".into(), json!(run.contact_time().map(|contact| detection.time - contact)));
        found
    });
    json!({ "contact": contact, "detection": detection, "events": run.events() })
}

/// An alarm that is raised, or cleared, at a time (s).
fn alarm(run: &Run, time: f64, event: &Event, raised: bool) -> Map<String, Json> {
    let (detector, thresholds) = (event.detector, &run.judged.settings.thresholds);
    let (value, threshold) = if raised {
        (event.value, Some(event.threshold))
    } else {
        let judgement = run.sample_at(time).judgement;
        (detector.statistic(&judgement, time, thresholds).value, detector.threshold(&judgement, thresholds))
    };
    fields(json!({
        "alarm": if raised { "raised" } else { "cleared" },
        "detector": detector.key(),
        "time": time,
        "value": value,
        "threshold": threshold,
    }))
}
