//! What leaves the page and comes in: its state as a link, files, and what is copied.
//!
//! The page keeps its address up to date and tells its surroundings how: a deliberate step (a preset, a view, a released
//! slider, a typed value) is one to go back to, a passing one (where playback stands) takes the place of the last. While
//! a pointer is down nothing is told. The surroundings fetch [`App::take_effects`] after each frame and hand in what
//! comes by [`App::go`] and [`App::opened`].

use egui::Ui;

use super::App;
use crate::app::chain::ChainState;
use crate::app::command::Share;
use crate::app::embed::Embed;
use crate::app::lesson::challenge::{self, CHALLENGES};
use crate::app::lesson::{At, Wish};
use crate::app::log::file::{File, is_log};
use crate::app::memo;
use crate::app::panels::notice::Notice;
use crate::app::stages::stage::{Section, Stage};
use crate::app::state::{self, State, Tuning};
use crate::app::theme::ThemeChoice;
use crate::app::words::{self, refusal};
use crate::render::Pixels;
use centrode_core::scenario::chain::ChainDraft;
use centrode_core::scenario::link::{ChainLink, Link, Page};
use centrode_core::scenario::preset;
use centrode_core::scenario::text::Draft;
use centrode_core::scenario::{ChainScenario, Scenario, ScenarioError};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::symbols::Symbol;

/// No scenario file is larger than this, bytes.
pub const MAX_FILE: usize = 1 << 20;
/// The theory, from this page.
const THEORY: &str = "theory.html";
/// Whose work the page is made of, from this page.
const LICENCES: &str = "licences.html";
/// How long something said in passing is shown, s.
const SAID: f64 = 2.5;

/// What the page wants of its surroundings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Effect {
    /// The address has this fragment from now on.
    Address {
        /// Without `#`.
        fragment: String,
        /// Whether one can go back to what was before.
        step: bool,
    },
    /// A file is to be saved.
    Save {
        /// Its name.
        name: String,
        /// What kind of file it is, as browsers call it.
        kind: &'static str,
        /// What it holds.
        bytes: Vec<u8>,
    },
    /// A drawing is to be saved as pixels.
    Picture {
        /// Name of the file.
        name: String,
        /// The drawing, which names the page's font.
        svg: String,
        /// Pixels to a point.
        scale: u32,
    },
    /// A picture is to be saved as PNG.
    Pixels {
        /// Name of the file.
        name: String,
        /// The picture.
        pixels: Pixels,
    },
    /// A page beside this one is to be opened in a tab of its own: its address from this one.
    Open(String),
    /// The person is to choose a file, which comes in by [`App::opened`].
    Choose,
    /// How far the person has come in the lessons is to be kept on this machine; see [`Host::progress`](super::Host::progress).
    Keep(String),
    /// The host page is to be told this, JSON; see [`App::request`].
    Post(String),
    /// The person is to choose a log, which comes in by [`App::log_chosen`].
    ChooseLog,
    /// The bytes of a file of this number are wanted, by [`App::log_fetched`].
    Fetch(u32),
}

/// What is known of the world outside.
#[derive(Debug)]
pub struct Sharing {
    /// The page's address, without its fragment.
    pub(super) address: String,
    /// What the address says, as far as this page knows.
    told: (String, Scenario, Page),
    effects: Vec<Effect>,
    /// Whether the person knows that what is set is too long for an address.
    too_long: bool,
    /// What lies over the page to be read.
    pub(super) notice: Option<Notice>,
    /// Said in passing, and until when (s).
    said: Option<(String, Option<f64>)>,
    /// Key of the slider moved since the address was last told, and then.
    pub(super) slid: Option<&'static str>,
    slid_before: Option<&'static str>,
}

impl Sharing {
    /// At an address (without its fragment) that says what a state is.
    #[must_use]
    pub fn new(address: String, state: &State) -> Self {
        Self {
            address,
            told: (state.preset.clone(), state.scenario.clone(), page(state, state.time)),
            effects: Vec::new(),
            too_long: false,
            notice: None,
            said: None,
            slid: None,
            slid_before: None,
        }
    }

    /// What is said in passing, as long as it is to be shown.
    pub(super) fn said(&mut self, ui: &Ui) -> Option<&str> {
        let now = ui.input(|input| input.time);
        let (_, until) = self.said.as_mut()?;
        let left = *until.get_or_insert(now + SAID) - now;
        if left <= 0.0 {
            self.said = None;
        } else {
            ui.ctx().request_repaint_after_secs(left as f32);
        }
        self.said.as_ref().map(|(text, _)| text.as_str())
    }

    pub(super) fn say(&mut self, text: impl Into<String>) {
        self.said = Some((text.into(), None));
    }

    /// Asks something of the surroundings.
    pub(super) fn hand_out(&mut self, effect: Effect) {
        self.effects.push(effect);
    }

    fn address(&mut self, fragment: String, step: bool) {
        // What nobody has fetched yet is not worth going back to.
        if !step && let Some(Effect::Address { fragment: last, .. }) = self.effects.last_mut() {
            *last = fragment;
        } else {
            self.effects.push(Effect::Address { fragment, step });
        }
    }
}

/// What a link says of the page in a state with its cursor (s).
pub(super) fn page(state: &State, cursor: f64) -> Page {
    Page {
        view: state.stage.key(),
        time: (!state.playing).then(|| stood(state, cursor)),
        speed: state.speed,
        looping: state.looping,
        rule: state.tuning.rule.name(),
        false_alarms: state.tuning.wish,
        repeats: state.tuning.repeats as u64,
        compare: state.tuning.compare,
        tour: None,
        challenge: None,
        theme: state.theme.key(),
        chain: chain(state),
    }
}

/// What a link says of several segments, where they are looked at.
fn chain(state: &State) -> Option<ChainLink> {
    let seen = state.stage == Stage::Chain;
    seen.then(|| ChainLink::new(&state.chain.preset, state.chain.draft.clone())).flatten()
}

/// Where the cursor stands in a link, s.
fn stood(state: &State, cursor: f64) -> f64 {
    match state.stage {
        // Its run may end before its scenario does.
        Stage::Chain => (cursor * 1e4).floor() / 1e4,
        // A log may be longer than the scenario, whose address this is.
        _ => rounded(cursor, state.scenario.motion.end),
    }
}

/// A time in a link, s: short, and not beyond the end, which may have more decimals.
fn rounded(cursor: f64, end: f64) -> f64 {
    ((cursor.min(end) * 1e4).round() / 1e4).min(end)
}

impl App {
    /// What the page wants of its surroundings since this was last asked.
    pub fn take_effects(&mut self) -> Vec<Effect> {
        std::mem::take(&mut self.sharing.effects)
    }

    /// What lies over the page to be read.
    #[must_use]
    pub fn notice(&self) -> Option<&Notice> {
        self.sharing.notice.as_ref()
    }

    /// Goes where a link says (an address, or its fragment): at the start, back, forward, or as the person edited it.
    /// What cannot be read is told.
    pub fn go(&mut self, link: &str) {
        let (read, broken) = Link::read_if(link, memo::check);
        self.leave_lesson();
        self.load_link(&read);
        if let Some(time) = read.page.time {
            self.state.time = time;
            self.state.playing = false;
        }
        if !broken.is_empty() {
            self.sharing.notice = Some(words::link::notice(link, &broken));
        }
        self.memo.update(&self.state.scenario);
        self.sharing.told = self.current();
        // A frame has no room for it.
        let Page { tour, challenge, .. } = read.page;
        let step = tour.and_then(|step| usize::try_from(step).ok()?.checked_sub(1)).map(Wish::Tour);
        self.lesson.due = step.or_else(|| challenge.and_then(challenge::named)).filter(|_| self.embed.is_none());
        (self.sharing.told.2.tour, self.sharing.told.2.challenge) = match self.lesson.due {
            Some(Wish::Tour(_)) => (tour, None),
            Some(_) => (None, challenge),
            None => (None, None),
        };
    }

    /// Opens the theory, at a symbol or at its beginning.
    pub(super) fn theory(&mut self, symbol: Option<&Symbol>) {
        let at = symbol.map_or_else(String::new, |symbol| format!("#{}", symbol.anchor()));
        self.sharing.hand_out(Effect::Open(format!("{THEORY}{at}")));
    }

    /// Opens the list of whose work the page is made of.
    pub(super) fn licences(&mut self) {
        self.sharing.hand_out(Effect::Open(LICENCES.into()));
    }

    pub(super) fn load_link(&mut self, link: &Link) {
        let changed = link.preset().name != self.state.preset || *link.scenario() != self.state.scenario;
        if changed {
            self.state.preset = link.preset().name.into();
            self.base = state::shipped(link.preset());
            self.load(link.scenario().clone());
            if self.state.playing {
                self.state.time = state::lead_in(link.scenario());
            }
        }
        let Page { view, time: _, speed, looping, rule, false_alarms, repeats, compare, theme, .. } = link.page;
        if let Some(chain) = &link.page.chain {
            self.link_chain(chain);
        }
        self.state.theme = theme.and_then(ThemeChoice::named).unwrap_or(self.state.theme);
        self.state.stage = Stage::ALL.into_iter().find(|stage| stage.key() == view).unwrap_or_default();
        if let Some(only) = self.embed.and_then(Embed::stage) {
            self.state.stage = only;
        }
        if self.state.stage.section() == Section::Paper {
            self.state.paper = self.state.stage;
        }
        (self.state.speed, self.state.looping) = (speed, looping);
        let rule = Rule::ALL.iter().copied().find(|known| known.name() == rule).unwrap_or(Rule::Fcd);
        let repeats = usize::try_from(repeats).unwrap_or(Tuning::default().repeats);
        self.state.tuning = Tuning { rule, wish: false_alarms, repeats, compare };
    }

    /// Takes what a link says of several segments, and stays at the time where playback stands.
    fn link_chain(&mut self, link: &ChainLink) {
        let now = &self.state.chain;
        if (now.preset.as_str(), &now.draft) == (link.preset(), &link.draft) {
            return;
        }
        let stands = (!self.state.playing).then_some(self.state.time);
        self.take_chain(link);
        self.state.time = stands.unwrap_or(self.state.time);
    }

    /// Shows several segments from the beginning, with what is looked at of them where they are of the same preset.
    fn take_chain(&mut self, link: &ChainLink) {
        let now = &self.state.chain;
        let mut chain = preset::find_chain(link.preset()).map(ChainState::of).unwrap_or_default();
        chain.segment = if chain.preset == now.preset { now.segment } else { chain.segment };
        self.load_chain(ChainState { draft: link.draft.clone(), all: now.all, shown: now.shown, ..chain });
    }

    /// Opens a file with several segments: it goes back to the preset from which the least differs.
    fn open_chain(&mut self, bytes: &[u8]) -> Result<(), String> {
        let draft = ChainDraft::from_bytes(bytes).map_err(|refused| refusal::of_chain_file(&refused))?;
        self.leave_lesson();
        self.state.stage = Stage::Chain;
        self.take_chain(&ChainLink::nearest(draft, None));
        Ok(())
    }

    /// A file has come in, chosen or dropped; or why it could not be read.
    pub fn opened(&mut self, name: &str, bytes: Result<Vec<u8>, String>) {
        let bytes = match bytes {
            Ok(bytes) if is_log(name, &bytes) => return self.log_chosen(File::here(name, bytes)),
            Ok(bytes) if bytes.len() <= MAX_FILE && ChainScenario::is_of(&bytes) => {
                match self.open_chain(&bytes) {
                    Ok(()) => self.sharing.say(format!("{name} opened")),
                    Err(why) => self.sharing.notice = Some(words::link::not_opened(name, &why)),
                }
                return;
            }
            bytes => bytes,
        };
        let read = bytes.and_then(|bytes| {
            if bytes.len() > MAX_FILE {
                return Err("It is larger than 1 MiB, so it is no scenario".into());
            }
            let scenario = Draft::from_bytes(&bytes).and_then(Draft::finish);
            let scenario = scenario.and_then(|scenario| memo::check(&scenario).map(|()| scenario));
            let scenario = scenario.map_err(|refused| refusal::told(&refused))?;
            Link::nearest(
                &scenario,
                page(&State { playing: true, theme: self.state.theme, ..self.own().0.clone() }, 0.0),
            )
            .map_err(|refused| refused.to_string())
        });
        match read {
            Ok(link) => {
                self.leave_lesson();
                let own = self.state.stage.own_preset();
                self.load_link(&link);
                // Whoever opens a scenario wants to see it: a figure would go on showing its own.
                if own.is_some_and(|own| own != link.preset().name) || self.state.stage == Stage::Chain {
                    self.state.stage = Stage::Robot;
                }
                self.sharing.say(format!("{name} opened"));
            }
            Err(why) => self.sharing.notice = Some(words::link::not_opened(name, &why)),
        }
    }

    fn current(&self) -> (String, Scenario, Page) {
        let own = self.own().0;
        (own.preset.clone(), own.scenario.clone(), self.own_page())
    }

    /// What the address says of the page: what the person has set, and the step of the tour or the challenge above it.
    fn own_page(&self) -> Page {
        let (own, cursor) = self.own();
        let (tour, challenge) = match self.state.lesson {
            Some(At::Tour(step)) => (Some(step as u64 + 1), None),
            Some(At::Challenge(which)) => (None, Some(CHALLENGES[which].key)),
            _ => (None, None),
        };
        Page { tour, challenge, theme: self.state.theme.key(), ..page(own, cursor) }
    }

    /// The link to what the address says.
    fn own_link(&self) -> Result<Link, ScenarioError> {
        let own = self.own().0;
        Link::new(own.preset(), &own.scenario, self.own_page())
    }

    /// The link to what the page shows.
    pub(super) fn link(&self) -> Result<Link, ScenarioError> {
        Link::new(self.state.preset(), &self.state.scenario, page(&self.state, self.cursor()))
    }

    /// Brings the address up to date, unless a pointer is still at it.
    pub(super) fn tell(&mut self, ui: &Ui) {
        let (down, released) = ui.input(|input| (input.pointer.any_down(), input.pointer.any_released()));
        let (preset, scenario, page_told) = &self.sharing.told;
        let page = self.own_page();
        let own = self.own().0;
        let same = *preset == own.preset && *scenario == own.scenario;
        if down {
            return;
        }
        let slid = self.sharing.slid.take();
        if same && *page_told == page {
            return;
        }
        let passing =
            Page { time: page.time, speed: page.speed, looping: page.looping, theme: page.theme, ..page_told.clone() };
        // A key held down on a slider is one step, not one for every repeat.
        let again = slid.is_some() && slid == self.sharing.slid_before && !released;
        let step = !(again || same && passing == page);
        if !same || step {
            self.sharing.slid_before = slid;
        }
        match self.own_link().map(|link| link.fragment()) {
            Ok(Ok(fragment)) => {
                self.sharing.address(fragment, step);
                self.sharing.too_long = false;
            }
            Ok(Err(_)) if !std::mem::replace(&mut self.sharing.too_long, true) => {
                self.sharing.notice.get_or_insert_with(words::link::not_held);
            }
            // An impossible scenario is told beside its control.
            Ok(Err(_)) | Err(_) => {}
        }
        self.sharing.told = self.current();
    }

    /// Hands something out, or asks for something to come in.
    pub(super) fn share(&mut self, ctx: &egui::Context, what: Share) {
        match what {
            Share::CopyLink => {
                let here = |mut link: Link| {
                    // What one sees, also while it moves.
                    if self.state.lesson.is_none() {
                        link.page.time = Some(stood(&self.state, self.cursor()));
                    }
                    if self.sharing.address.is_empty() {
                        return link.fragment().map(|fragment| format!("#{fragment}")).map_err(|why| why.to_string());
                    }
                    link.at(&self.sharing.address).map_err(|why| why.to_string())
                };
                match self.own_link().map_err(|why| why.to_string()).and_then(here) {
                    Ok(text) => {
                        ctx.copy_text(text);
                        self.sharing.say("Link copied");
                    }
                    Err(why) => self.sharing.notice = Some(words::link::no_link(&why)),
                }
            }
            Share::CopyCommand => match self.command() {
                Ok(text) => {
                    ctx.copy_text(text);
                    self.sharing.say("Command copied");
                }
                Err(why) => self.sharing.notice = Some(words::link::no_link(&why.to_string())),
            },
            Share::Save => {
                let (preset, text) = match self.state.stage {
                    Stage::Chain => (&self.state.chain.preset, self.state.chain.draft.to_toml()),
                    _ => (&self.state.preset, self.state.scenario.to_toml()),
                };
                let name = format!("centrode-{preset}.toml");
                let text = format!("{}{text}", words::link::FILE_HEAD);
                self.sharing.hand_out(Effect::Save { name, kind: "application/toml", bytes: text.into_bytes() });
            }
            Share::OwnPage => match self
                .link()
                .map_err(|why| why.to_string())
                .and_then(|link| link.at(&self.sharing.address).map_err(|why| why.to_string()))
            {
                Ok(address) => ctx.open_url(egui::OpenUrl::new_tab(address)),
                Err(why) => self.sharing.notice = Some(words::link::no_link(&why)),
            },
            Share::Open => self.sharing.hand_out(Effect::Choose),
            Share::OpenLog => self.sharing.hand_out(Effect::ChooseLog),
        }
    }

    /// The command that computes what is on the stage: a figure's own scenario where that is what it shows.
    fn command(&self) -> Result<String, ScenarioError> {
        let own = self.source.as_ref().filter(|source| !source.taken);
        let link = match own {
            Some(own) => {
                let page = Page { time: None, ..page(&self.state, 0.0) };
                Link::new(own.preset, &own.scenario, page)?
            }
            None => self.link()?,
        };
        let of_log = self.log_command(&link).filter(|_| self.state.stage == Stage::Robot);
        Ok(of_log.unwrap_or_else(|| link.command()))
    }

    pub(super) fn copy_notice(&mut self, ctx: &egui::Context) {
        if let Some(notice) = &self.sharing.notice {
            ctx.copy_text(notice.details.clone());
            self.sharing.say("Details copied");
        }
    }
}
