//! A log of several trackers in place of the simulation of segments in series. The scenario stays what it is judged by.

use std::rc::Rc;

use crate::app::App;
use crate::app::command::LogWish;
use crate::app::link::Effect;
use crate::app::log::file::{File, Kept};
use crate::app::memo::MAX_SAMPLES;
use crate::app::panels::log::Banner;
use crate::app::words;
use centrode_core::record::log::chain::{ChainAssembled, ChainLog, ChainOptions, Expected, assemble, read};
use centrode_core::record::log::{Commands, LogError, Setup};
use centrode_core::scenario::ChainScenario;
use centrode_core::scenario::link::Link;

/// No log of several trackers is larger than this, bytes: it is read within a frame.
const MAX_FILE: u64 = 64 << 20;

/// A log that was read.
#[derive(Debug)]
pub struct Opened {
    /// Name of its file.
    pub name: String,
    log: ChainLog,
}

impl Opened {
    /// Reads a file for an experiment.
    ///
    /// # Errors
    /// When it cannot be read so: where, and why.
    pub fn read(name: &str, bytes: Vec<u8>, scenario: &ChainScenario) -> Result<Self, LogError> {
        let mut log = ChainLog::new(scenario.segments.len());
        log.take(read(name, bytes, &Expected::of(scenario), &ChainOptions::default())?, "")?;
        Ok(Self { name: name.into(), log })
    }

    /// The recording, as an experiment's scenario takes it. Where the file holds no commands they are those of the scenario's motions.
    ///
    /// # Errors
    /// When the two do not fit.
    pub fn assembled(&self, scenario: &ChainScenario) -> Result<ChainAssembled, LogError> {
        if self.log.logs.len() != scenario.segments.len() {
            let (log, set) = (self.log.logs.len(), scenario.segments.len());
            return Err(LogError::file(format!("was read for {log} segments, and {set} are set: open it again")));
        }
        let setup = Setup { most: Some(MAX_SAMPLES), commands: self.commands(), ..Setup::default() };
        assemble(self.log.clone(), scenario, &setup)
    }

    /// Where the commands have to come from, as the file holds none.
    fn commands(&self) -> Option<Commands> {
        (!self.log.logs.iter().any(|log| log.has_commands())).then_some(Commands::Motion)
    }
}

/// The log that is shown, and a file whose bytes are on their way.
#[derive(Debug, Default)]
pub struct Logs {
    /// Shown in place of the simulation.
    pub shown: Option<Rc<Opened>>,
    awaited: Option<(u32, String)>,
}

impl App {
    /// A log was chosen or dropped while segments in series are looked at.
    pub(in crate::app) fn chain_log_chosen(&mut self, file: &File) {
        if file.size > MAX_FILE {
            let why = words::log::too_large(file.size, MAX_FILE);
            self.sharing.notice = Some(words::log::not_read(&file.name, &why));
            return;
        }
        match &file.kept {
            Kept::Here(bytes) => self.open_chain_log(&file.name, bytes.to_vec()),
            Kept::There(number) => {
                self.chain.logs.awaited = Some((*number, file.name.clone()));
                self.sharing.hand_out(Effect::Fetch(*number));
            }
        }
    }

    /// The bytes that came under a number are taken, if they are of a log that was wanted here; else given back.
    pub(in crate::app) fn chain_log_fetched(
        &mut self,
        number: u32,
        bytes: Result<Vec<u8>, String>,
    ) -> Option<Result<Vec<u8>, String>> {
        let Some((_, name)) = self.chain.logs.awaited.take_if(|(wanted, _)| *wanted == number) else {
            return Some(bytes);
        };
        match bytes {
            Ok(bytes) => self.open_chain_log(&name, bytes),
            Err(why) => self.sharing.notice = Some(words::log::not_read(&name, &why)),
        }
        None
    }

    fn open_chain_log(&mut self, name: &str, bytes: Vec<u8>) {
        let Ok(scenario) = self.state.chain.draft.scenario() else { return };
        let opened =
            Opened::read(name, bytes, &scenario).and_then(|opened| opened.assembled(&scenario).map(|_| opened));
        match opened {
            Ok(opened) => {
                self.leave_lesson();
                self.chain.logs.shown = Some(Rc::new(opened));
                self.state.time = 0.0;
                self.sharing.say(format!("{name} opened"));
            }
            Err(error) => self.sharing.notice = Some(words::log::not_read(name, &error.without_flags())),
        }
    }

    /// The command that judges the log that is shown by the scenario of a link.
    pub(in crate::app) fn chain_log_command(&self, link: &Link) -> Option<String> {
        let log = self.chain.logs.shown.as_ref()?;
        let motion: &[&str] = if log.commands().is_some() { &["--commands", "motion"] } else { &[] };
        Some(link.analyze(&log.name, &motion.iter().map(ToString::to_string).collect::<Vec<_>>()))
    }

    /// Carries out what is wished of such a log.
    pub(in crate::app) fn wish_of_chain_log(&mut self, wish: &LogWish) {
        match wish {
            LogWish::Close => {
                self.chain.logs.shown = None;
                if let Ok(scenario) = self.state.chain.draft.scenario() {
                    self.state.time = super::memo::lead_in(&scenario);
                }
            }
            LogWish::Cancel => self.chain.logs.awaited = None,
            LogWish::Report => {
                let about = self.chain.memo.as_ref().and_then(|memo| memo.about());
                if let (Some(log), Some(about)) = (&self.chain.logs.shown, about) {
                    self.sharing.notice = Some(words::log::chain_report(&log.name, about));
                }
            }
            // Columns are told apart by their names alone.
            LogWish::Form | LogWish::Edit(_) | LogWish::Read | LogWish::LeaveForm => {}
        }
    }
}

impl super::Chain {
    /// What the banner says; none while there is nothing to say.
    #[must_use]
    pub fn banner(&self) -> Option<Banner> {
        if let Some((_, name)) = &self.logs.awaited {
            return Some(Banner::Reading(name.clone(), 0.0));
        }
        let (log, about) = self.logs.shown.as_ref().zip(self.memo.as_ref()?.about())?;
        let facts = words::log::facts_of(about.format, about.rows, about.loop_rate);
        Some(Banner::Shown { name: log.name.clone(), facts, missing: String::new(), columns: false })
    }
}
