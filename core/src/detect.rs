//! What is concluded from a recording: filter, detectors, events, and the place of the contact.
//!
//! Reading order: [`filter`], [`nominal`] (what the tracker would read at the command), [`evidence`] (what is computed
//! at each instant before any threshold), [`statistic`] (what each detector holds against its threshold, and whether it counts),
//! [`alarm`] (crossings and events), [`judge`](mod@judge) (all of it), [`estimates`]
//! (where the contact is, after an alarm), [`force`] (how hard it presses), [`chain`] (all that for segments in series).
//!
//! Nothing here knows whether a recording was simulated.

pub mod alarm;
pub mod calibration;
pub mod chain;
pub mod estimates;
pub mod evidence;
pub mod filter;
pub mod force;
pub mod judge;
pub mod latch;
pub mod nominal;
pub mod outlook;
pub mod statistic;

pub use alarm::{Crossing, Detection, Event};
pub use evidence::{Evidence, Judgement};
pub use judge::{Judged, Settings, judge};
pub use statistic::{Method, Standing, Statistic};
