//! Hysteresis: an event is raised once a value is above its threshold, and cleared once it has stayed low for a while.

/// What a look came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turn {
    /// The event begins.
    Raised,
    /// It ends.
    Cleared,
}

/// The state of one detector.
#[derive(Debug, Clone, Default)]
pub struct Latch {
    above: bool,
    standing: bool,
    /// Since when the value has been low, s.
    low_since: Option<f64>,
}

impl Latch {
    /// The value is not known: nobody can say that it has stayed low.
    pub fn unknown(&mut self) {
        self.low_since = None;
    }

    /// Looks at a value at a time (s): whether it is above the threshold, and whether it is low. An event ends after `hold` (s) of low
    /// values. Whether the threshold was crossed upward, and what becomes of the event.
    pub fn look(&mut self, time: f64, above: bool, low: bool, hold: f64) -> (bool, Option<Turn>) {
        let was = std::mem::replace(&mut self.above, above);
        let crossed = above && !was;
        if !self.standing {
            (self.standing, self.low_since) = (above, None);
            return (crossed, above.then_some(Turn::Raised));
        }
        self.low_since = low.then(|| self.low_since.unwrap_or(time));
        let over = self.low_since.is_some_and(|since| time - since >= hold);
        self.standing = !over;
        (crossed, over.then_some(Turn::Cleared))
    }
}
