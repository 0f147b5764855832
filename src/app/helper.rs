//! Somebody who works elsewhere, such as a worker of the page, and how a study has its parts made by one.

pub mod lent;
#[cfg(test)]
pub mod near;

use centrode_core::study::Progress;
use centrode_core::study::remote::{Answer, Found, Request, Work};

/// Somebody who makes studies, or reads logs, elsewhere.
pub trait Helper: std::fmt::Debug {
    /// Makes this request (JSON of [`Request`]) from now on, and nothing asked before; `None` for nothing at all.
    fn ask(&mut self, request: Option<&str>);

    /// The answers (see [`Answer`]) that have come since this was last called.
    fn take(&mut self) -> Vec<Vec<u8>>;

    /// Why it can no longer be relied on, if so. The rest is made here then.
    fn failure(&self) -> Option<String>;

    /// Has another take its place, who knows of no request yet; false where there is no other, or not another one more.
    fn replace(&mut self) -> bool {
        false
    }
}

/// Who has a study made: by a helper, while there is one that can be relied on.
#[derive(Debug)]
pub struct Asking {
    helper: Option<Box<dyn Helper>>,
    request: u32,
    asked: bool,
    held: bool,
    trouble: Option<String>,
}

/// What there is to do now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turn {
    /// Nothing: the study is complete or held, or the helper makes it.
    Wait,
    /// Parts are to be made here.
    Make,
}

impl Asking {
    /// Nothing is asked yet.
    #[must_use]
    pub fn new(helper: Option<Box<dyn Helper>>) -> Self {
        Self { helper, request: 0, asked: false, held: false, trouble: None }
    }

    /// Ends what the helper does. What it may still answer belongs to a request of the past.
    pub fn rest(&mut self) {
        self.request += 1;
        if std::mem::take(&mut self.asked)
            && let Some(helper) = &mut self.helper
        {
            helper.ask(None);
        }
    }

    /// Stops, or goes on.
    pub fn hold(&mut self, held: bool) {
        self.held = held;
        if held {
            self.rest();
        }
    }

    /// Hands what has come of the request to `add`, which says whether it fits.
    ///
    /// # Errors
    /// Why the helper can no longer be relied on.
    pub fn take(&mut self, mut add: impl FnMut(Found) -> bool) -> Result<(), String> {
        let Some(helper) = &mut self.helper else { return Ok(()) };
        let mut failure = None;
        for answer in helper.take() {
            match Answer::from_bytes(&answer) {
                // What answers a request of the past is no longer of use.
                Ok(Answer { id, found }) if id == self.request => {
                    if !add(found) {
                        failure = Some("its answer belongs to another study".into());
                    }
                }
                Ok(_) => {}
                Err(error) => failure = Some(format!("its answer cannot be read: {error}")),
            }
        }
        helper.failure().or(failure).map_or(Ok(()), Err)
    }

    /// Asks for what is missing of a study that is so far, unless that is done already.
    ///
    /// # Errors
    /// Why the helper can no longer be relied on.
    pub fn ask(&mut self, progress: Progress, work: impl FnOnce() -> Work) -> Result<Turn, String> {
        if self.held || progress.is_complete() {
            return Ok(Turn::Wait);
        }
        let Some(helper) = &mut self.helper else { return Ok(Turn::Make) };
        if !self.asked {
            self.request += 1;
            let request = Request { id: self.request, work: work() };
            let request = serde_json::to_string(&request).map_err(|error| format!("it cannot be asked: {error}"))?;
            helper.ask(Some(&request));
            self.asked = true;
        }
        Ok(Turn::Wait)
    }

    /// Has another take the helper's place, or does without from now on.
    pub fn give_up(&mut self, why: String) {
        self.rest();
        if self.helper.as_mut().is_some_and(|helper| helper.replace()) {
            return;
        }
        self.helper = None;
        self.trouble = Some(why);
    }

    /// Whether there is a helper.
    #[must_use]
    pub fn has_helper(&self) -> bool {
        self.helper.is_some()
    }

    /// Whether the study was stopped.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.held
    }

    /// Why the helper was given up, if it was.
    #[must_use]
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }
}
