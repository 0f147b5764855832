//! A log in place of the simulation: how it comes in, is read, shown and put away.
//!
//! The file is read by a helper elsewhere, such as a worker of the page, which has it by its number; without one its bytes are
//! fetched and read between frames. A log is no part of the page's address, which stays that of the scenario.

pub mod file;
pub mod form;
pub mod reading;

use std::rc::Rc;

use super::App;
use crate::app::command::LogWish;
use crate::app::helper::Helper;
use crate::app::link::Effect;
use crate::app::memo::recorded::Recorded;
use crate::app::panels::log::Banner;
use crate::app::stages::stage::{Section, Stage};
use crate::app::words;
use centrode_core::record::log::Log;
use centrode_core::scenario::link::Link;
use centrode_core::scenario::text::number;
use file::{File, Parts};
use form::{Edit, Form};
use reading::{Desk, Refused};

/// No log file on the page is larger than this, bytes: a log of a million rows with all their digits is half as large.
pub const MAX_FILE: u64 = 512 << 20;

/// The log that is shown, and the one that is being read.
#[derive(Debug, Default)]
pub struct Logs {
    desk: Desk,
    shown: Option<Parts>,
    /// How one is to be read, while a person fills it in.
    pub(super) form: Option<Form>,
}

impl Logs {
    /// None yet; `helper` reads them, if there is one.
    #[must_use]
    pub fn new(helper: Option<Box<dyn Helper>>) -> Self {
        Self { desk: Desk::new(helper), shown: None, form: None }
    }

    /// What the banner says; none while there is nothing to say.
    #[must_use]
    pub fn banner(&self, recorded: Option<&Recorded>) -> Option<Banner> {
        if let Some((name, share)) = self.desk.progress() {
            return Some(Banner::Reading(name.into(), share));
        }
        let (parts, recorded) = self.shown.as_ref().zip(recorded)?;
        Some(Banner::Shown {
            name: parts.file.name.clone(),
            facts: words::log::facts(recorded),
            missing: words::log::missing(recorded),
        })
    }
}

impl App {
    /// The name of the log that is shown in place of the simulation.
    #[must_use]
    pub fn log(&self) -> Option<&str> {
        self.logs.shown.as_ref().map(|parts| parts.file.name.as_str())
    }

    /// How a log is to be read, while a person fills it in.
    #[must_use]
    pub fn log_form(&self) -> Option<&Form> {
        self.logs.form.as_ref()
    }

    /// A file that is a log was chosen or dropped.
    pub fn log_chosen(&mut self, file: File) {
        if file.size > MAX_FILE {
            let why = words::log::too_large(file.size, MAX_FILE);
            self.sharing.notice = Some(words::log::not_read(&file.name, &why));
            return;
        }
        if let Some(form) = self.logs.form.as_mut().filter(|form| form.awaits) {
            form.second(file);
            return;
        }
        self.logs.form = None;
        self.read_log(Parts::new(file));
    }

    /// The bytes of a file that were asked for by [`Effect::Fetch`], or why they cannot be had.
    pub fn log_fetched(&mut self, number: u32, bytes: Result<Vec<u8>, String>) {
        self.logs.desk.fetched(number, bytes);
    }

    fn read_log(&mut self, parts: Parts) {
        let frame_rate = self.memo.plan().scenario().tracker.rate;
        self.logs.desk.read(parts, frame_rate);
    }

    /// Reads on; returns whether the next frame should come at once for it.
    pub(super) fn work_log(&mut self) -> bool {
        if let Some((parts, outcome)) = self.logs.desk.work() {
            let shown = outcome.and_then(|log| self.show_log(&parts, log));
            match shown {
                Ok(()) => self.logs.shown = Some(parts),
                Err(refused) => self.logs.form = Some(Form::new(parts, Some(refused.why))),
            }
        }
        if let Some(number) = self.logs.desk.wanted() {
            self.sharing.hand_out(Effect::Fetch(number));
        }
        self.logs.desk.is_busy()
    }

    /// The person chose no file after all.
    pub fn none_chosen(&mut self) {
        if let Some(form) = &mut self.logs.form {
            form.awaits = false;
        }
    }

    fn show_log(&mut self, parts: &Parts, log: Log) -> Result<(), Refused> {
        self.leave_lesson();
        self.memo.open(Rc::new(log), parts.setup())?;
        self.notes.clear();
        self.state.time = self.memo.lead_in();
        // Whoever opens a log wants to see it: a figure would go on showing its own.
        if matches!(self.state.stage.section(), Section::Paper | Section::Chain) {
            self.state.stage = Stage::Robot;
        }
        self.sharing.say(format!("{} opened", parts.file.name));
        Ok(())
    }

    /// Carries out what is wished of a log.
    pub(super) fn wish_of_log(&mut self, wish: LogWish) {
        match wish {
            LogWish::Report => {
                if let (Some(parts), Some(recorded)) = (&self.logs.shown, self.memo.recorded()) {
                    self.sharing.notice = Some(words::log::report(&parts.file.name, recorded));
                }
            }
            LogWish::Close => {
                self.logs.shown = None;
                self.memo.close();
                self.state.time = self.memo.lead_in();
            }
            LogWish::Cancel => self.logs.desk.cancel(),
            LogWish::Form => {
                self.logs.form = self.logs.shown.clone().map(|parts| Form::new(parts, None));
            }
            LogWish::Edit(edit) => {
                if edit == Edit::Second {
                    self.sharing.hand_out(Effect::ChooseLog);
                }
                if let Some(form) = &mut self.logs.form {
                    form.edit(edit);
                }
            }
            LogWish::Read => {
                if let Some(form) = self.logs.form.take() {
                    self.read_log(form.filled());
                }
            }
            LogWish::LeaveForm => self.logs.form = None,
        }
    }

    /// The command that judges the log that is shown by the scenario of a link.
    pub(super) fn log_command(&self, link: &Link) -> Option<String> {
        let (parts, recorded) = self.logs.shown.as_ref().zip(self.memo.recorded())?;
        Some(link.analyze(&parts.file.name, &parts.flags(&number(recorded.about.loop_rate))))
    }
}
