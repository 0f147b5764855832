//! What the interface asks for. Panels and views emit commands; [`crate::app::App`] applies them, and nothing else does.

use crate::app::chain::apply::Wish as ChainWish;
use crate::app::controls::control::{Choice, Control};
use crate::app::layout::sheet::Stop;
use crate::app::lesson::Wish;
use crate::app::log::form::Edit;
use crate::app::saving::{Format, Subject};
use crate::app::stages::stage::Stage;
use crate::app::state::{Tab, Tuning};
use centrode_core::scenario::preset::Preset;
use centrode_core::scenario::{Method, Threshold};
use centrode_core::study::tuning::watch::Rule;
use centrode_core::symbols::Symbol;

/// What leaves the page or comes in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Share {
    /// Copy the link to what the page shows.
    CopyLink,
    /// Copy the command that computes what the page shows.
    CopyCommand,
    /// Save the scenario as a file.
    Save,
    /// Choose a file with a scenario, and open it.
    Open,
    /// Open what a frame shows in a page of its own.
    OwnPage,
    /// Choose a log, and show it in place of the simulation.
    OpenLog,
}

/// One of two times that are held against each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// The first.
    A,
    /// The second.
    B,
}

/// What is wished of a log.
#[derive(Debug, Clone, PartialEq)]
pub enum LogWish {
    /// Tell how it was read.
    Report,
    /// Go back to the simulation.
    Close,
    /// Stop reading it.
    Cancel,
    /// Say how it is to be read.
    Form,
    /// Change what is said.
    Edit(Edit),
    /// Read it so.
    Read,
    /// Leave it as it is.
    LeaveForm,
}

/// One wish.
#[derive(Debug, Clone)]
pub enum Command {
    /// Put the cursor at a time, s.
    Seek(f64),
    /// Stop playing.
    Pause,
    /// Play, or stop playing; at the end, play from the start.
    TogglePlay,
    /// Stop playing and move by this many hundredths of a second.
    Step(i32),
    /// Seconds of the experiment per second.
    SetSpeed(f64),
    /// Start again at the end, or stop there.
    ToggleLoop,
    /// Hold the shape against a beam that only touches against that of a clamp, or no longer.
    ToggleFrozen,
    /// Choose a preset and load its scenario.
    Choose(&'static Preset),
    /// Set the threshold of a detector, SI.
    SetThreshold(Method, Threshold),
    /// Set when alarms are armed, s.
    SetArmedFrom(f64),
    /// Set a control, in the unit it shows.
    Set(&'static Control, f64),
    /// Set a control from what a person typed.
    Enter(&'static Control, String),
    /// Switch a control off or on.
    Switch(&'static Control, bool),
    /// Pick an option.
    Pick(&'static Choice, usize),
    /// Give a control the preset's value.
    Reset(&'static Control),
    /// Give a choice the preset's option.
    ResetChoice(&'static Choice),
    /// Give everything the preset's values.
    ResetAll,
    /// System, light, dark, and again.
    NextTheme,
    /// Fold or unfold a group of controls.
    Fold(&'static str),
    /// Show a tab, where there is room for one only.
    ShowTab(Tab),
    /// Put something on the stage.
    Show(Stage),
    /// Put the contact at an arc length (m), from a bend (rad) on.
    Touch {
        /// Arc length, m.
        arc_length: f64,
        /// Bend at contact, rad.
        bend: f64,
    },
    /// What is looked at while tuning.
    Tune(Tuning),
    /// Take a threshold, ξ2 (m) or ξ1 (N·m, or k where it follows the shape), and a filter length.
    Take {
        /// Whose threshold it is.
        rule: Rule,
        /// The threshold.
        threshold: f64,
        /// The filter length; none leaves it.
        length: Option<u64>,
    },
    /// Take a threshold of a detector, as a study counts it, and switch the detector on.
    TakeDetector {
        /// The detector.
        method: Method,
        /// SI, or k where ξ1 follows the shape.
        threshold: f64,
    },
    /// Stop the study, or go on with it.
    HoldStudy(bool),
    /// Let a small screen's sheet hold the controls, or no longer.
    ToggleSheet,
    /// Draw that sheet out so far.
    DrawSheet(Stop),
    /// Open or close the help.
    ToggleHelp,
    /// Let the run be heard, or no longer.
    ToggleSound,
    /// Open or close the list of keys.
    ToggleKeys,
    /// Open the theory, at a symbol or at its beginning.
    Theory(Option<&'static Symbol>),
    /// Open the list of whose work the page is made of.
    Licences,
    /// Hand something out, or ask for something to come in.
    Share(Share),
    /// Put a mark at a time, s, or take it away.
    Mark(Mark, Option<f64>),
    /// Put a mark where the cursor is.
    MarkHere(Mark),
    /// Copy both marked times and what the plots show there.
    CopyMarks,
    /// Save something as a file.
    Save(Subject, Format),
    /// Open the menu by which something is saved.
    OfferToSave(Subject),
    /// Do something with a log.
    Log(LogWish),
    /// Do something in the tour or a challenge.
    Lesson(Wish),
    /// Do something with segments in series.
    Chain(ChainWish),
    /// Close the notice.
    CloseNotice,
    /// Copy what the notice says.
    CopyNotice,
}
