//! What is saved as a file: every card that shows something, in each format that it has.
//!
//! Drawings and numbers are the bytes that the command writes of the same scenario; their captions end in its link.

use std::borrow::Cow;

use super::App;
use crate::app::link::Effect;
use crate::app::stages::stage::Stage;
use crate::app::stages::studies::{Found, REPEATS};
use crate::app::words;
use crate::show::paper;
use centrode_core::chart::Chart;
use centrode_core::chart::csv::csv;
use centrode_core::scenario::Scenario;
use centrode_core::scenario::link::Page;
use centrode_core::study::chain::figure::over_time;
use centrode_core::study::course::between;
use centrode_core::study::export::{name, signed};
use centrode_core::study::figure::Number;
use centrode_core::study::report::Report;
use centrode_core::study::table2::chart::{made, with_words};
use centrode_core::study::table2::export as table2;
use centrode_core::study::{Job, channels, compare, map, timeline};

/// What is saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// A figure of the paper.
    Figure(Number),
    /// Table II.
    Table,
    /// The map.
    Map,
    /// The pictures of the tuning view.
    Tuning,
    /// The detectors held against each other.
    Detectors,
    /// The live plots, and the run that they show.
    Plots,
    /// The 3D view.
    View,
    /// The plots of several segments, and their run.
    Chain,
}

/// How something is saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Vectors.
    Svg,
    /// Pixels, twice as many as points.
    Png,
    /// The same without a background.
    Clear,
    /// Numbers, separated by commas.
    Csv,
    /// A table for LaTeX.
    Latex,
    /// Numbers from the time A to the time B.
    Between,
    /// What a run comes to.
    Json,
}

impl Format {
    /// What it is called in a menu, and what it holds of a subject.
    #[must_use]
    pub fn words(self, subject: Subject) -> (&'static str, &'static str) {
        match (self, subject) {
            (Self::Svg, Subject::Table) => ("SVG", "Each estimate against the truth, as vectors"),
            (Self::Svg, _) => ("SVG", "Vectors, with caption and link"),
            (Self::Png, Subject::View) => ("PNG (2×)", "The robot as it is shown, without labels and legend"),
            (Self::Clear, _) => ("PNG (2×), transparent", "The same without background and floor"),
            (Self::Png, _) => ("PNG (2×)", "The same as pixels, two to a point"),
            (Self::Csv, Subject::Plots) => ("CSV", "Every channel of the run at loop rate, in SI units"),
            (Self::Csv, Subject::Table) => ("CSV", "All tables, in SI units"),
            (Self::Csv, Subject::Detectors) => ("CSV", "Every threshold, bound and place, in SI units"),
            (Self::Between, _) => ("CSV, A to B", "The same between the two marked times"),
            (Self::Csv, _) => ("CSV", "The numbers, in SI units"),
            (Self::Latex, _) => ("LaTeX", "Both tables as a plain tabular"),
            (Self::Json, _) => ("JSON", "Scenario, crossings, events and detection, in SI units"),
        }
    }

    /// The end of a file's name, and the kind of file that a browser is told.
    #[must_use]
    fn file(self) -> (&'static str, &'static str) {
        match self {
            Self::Svg => ("svg", "image/svg+xml"),
            Self::Png | Self::Clear => ("png", "image/png"),
            Self::Csv | Self::Between => ("csv", "text/csv"),
            Self::Latex => ("tex", "application/x-tex"),
            Self::Json => ("json", "application/json"),
        }
    }
}

impl Subject {
    /// What is on a stage and can be saved.
    #[must_use]
    pub fn on(stage: Stage) -> Option<Self> {
        match stage {
            Stage::Robot | Stage::Chain => Some(Self::View),
            Stage::Table2 => Some(Self::Table),
            Stage::Map => Some(Self::Map),
            Stage::Tuning => Some(Self::Tuning),
            Stage::Detectors => Some(Self::Detectors),
            figure => figure.figure().map(Self::Figure),
        }
    }

    /// Its name in a sentence.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Figure(number) => format!("figure {number}"),
            Self::Table => "Table II".into(),
            Self::Map => "map".into(),
            Self::Tuning => "tuning".into(),
            Self::Detectors => "detectors".into(),
            Self::Plots => "plots".into(),
            Self::View => "3D view".into(),
            Self::Chain => "plots".into(),
        }
    }

    /// Its formats, in the order offered; `marked` says whether there are two times A and B.
    #[must_use]
    pub fn formats(self, marked: bool) -> &'static [Format] {
        match self {
            Self::Plots if marked => &[Format::Svg, Format::Png, Format::Csv, Format::Between, Format::Json],
            Self::Figure(_) | Self::Map | Self::Tuning | Self::Detectors => &[Format::Svg, Format::Png, Format::Csv],
            Self::Table => &[Format::Svg, Format::Png, Format::Csv, Format::Latex],
            Self::Plots => &[Format::Svg, Format::Png, Format::Csv, Format::Json],
            Self::View => &[Format::Png, Format::Clear],
            Self::Chain => &[Format::Svg, Format::Png, Format::Csv, Format::Json],
        }
    }

    /// The view of a page that shows it, and what its files are called.
    fn keys(self) -> (&'static str, &'static str) {
        match self {
            Self::Figure(number) => (number.preset(), number.preset()),
            Self::Table => (Stage::Table2.key(), Stage::Table2.key()),
            Self::Map => (Stage::Map.key(), Stage::Map.key()),
            Self::Tuning => (Stage::Tuning.key(), Stage::Tuning.key()),
            Self::Detectors => (Stage::Detectors.key(), Stage::Detectors.key()),
            Self::Plots => (Stage::Robot.key(), "run"),
            Self::View => (Stage::Robot.key(), Stage::Robot.key()),
            Self::Chain => (Stage::Chain.key(), "run"),
        }
    }
}

const UNDONE: &str = "It is still being computed. Save it when the line above it has reached the end";

impl App {
    /// Hands a file out, or says why there is none.
    pub(super) fn save(&mut self, subject: Subject, format: Format) {
        let (extension, kind) = format.file();
        let what = match (subject, format, self.log()) {
            (Subject::Plots, Format::Between, Some(_)) => "log-a-to-b",
            (Subject::Plots, _, Some(_)) => "log",
            (_, Format::Between, None) => "run-a-to-b",
            _ => subject.keys().1,
        };
        let name = name(what, self.made_of(subject).0, extension);
        if subject == Subject::View {
            if !self.view.save(name.clone(), format == Format::Clear) {
                self.not_saved(&name, "There is no 3D view here: it needs WebGPU or WebGL2");
            }
            return;
        }
        match self.written(subject, format) {
            Ok(text) => {
                self.sharing.say(format!("Saving {name}"));
                self.sharing.hand_out(match format {
                    Format::Png => Effect::Picture { name, svg: text, scale: paper::PIXELS },
                    _ => Effect::Save { name, kind, bytes: text.into_bytes() },
                });
            }
            Err(why) => self.not_saved(&name, &why),
        }
    }

    /// Copies both marked times and what the plots show there.
    pub(super) fn copy_marks(&mut self, ctx: &egui::Context) {
        if let [Some(a), Some(b)] = self.state.marks {
            ctx.copy_text(between::table(self.memo.run(), [a, b]));
            self.sharing.say("A, B and their difference copied");
        }
    }

    /// Hands the picture of the 3D view out that was asked for, once it is there.
    pub(super) fn take_picture(&mut self, ctx: &egui::Context) {
        match self.view.saved(ctx) {
            Some((name, Ok(pixels))) => {
                self.sharing.say(format!("Saving {name}"));
                self.sharing.hand_out(Effect::Pixels { name, pixels });
            }
            Some((name, Err(_))) => self.not_saved(&name, "The graphics device gave no picture back"),
            None => {}
        }
    }

    /// Tells that a file could not be saved.
    pub fn not_saved(&mut self, name: &str, why: &str) {
        self.sharing.notice = Some(words::link::not_saved(name, why));
    }

    /// Name of the preset or log, and the scenario, that something is made of.
    fn made_of(&self, subject: Subject) -> (&str, Cow<'_, Scenario>) {
        match (&self.source, subject, self.log()) {
            (Some(source), Subject::Figure(_) | Subject::Table, _) => {
                (source.preset.name, Cow::Borrowed(&source.scenario))
            }
            (_, Subject::Plots | Subject::View, Some(log)) => {
                let stem = log.rsplit_once('.').map_or(log, |(stem, _)| stem);
                // As the command has it: what judges the log, with the contact that is set and does nothing to it.
                let contact = self.memo.plan().scenario().contact;
                (stem, Cow::Owned(Scenario { contact, ..self.memo.run().plan.scenario().clone() }))
            }
            (_, Subject::Chain, _) => (&self.state.chain.preset, Cow::Borrowed(self.memo.plan().scenario())),
            // A log that is shown changes neither map nor tuning.
            _ => (&self.state.preset, Cow::Borrowed(self.memo.plan().scenario())),
        }
    }

    /// What a file holds; pixels are made of vectors.
    fn written(&self, subject: Subject, format: Format) -> Result<String, String> {
        let run = self.memo.run();
        match (format, subject) {
            (Format::Svg | Format::Png, _) => {
                let page = Page { view: subject.keys().0, ..self.page_made(subject) };
                Ok(paper::svg(&signed(self.chart(subject)?, &self.made_of(subject).1, page)))
            }
            (Format::Json, Subject::Chain) => {
                let memo = self.chained().filter(|memo| !memo.is_working()).ok_or(UNDONE)?;
                let mut report = memo.run().report_of(memo.teller(), &memo.found());
                report.log = memo.about().cloned();
                let text = serde_json::to_string_pretty(&report).map_err(|error| error.to_string())?;
                Ok(text + "\n")
            }
            (Format::Json, _) => {
                let about = self.memo.recorded().map(|recorded| &recorded.about);
                let report = Report::of(run, self.made_of(subject).1.into_owned(), about)
                    .map_err(|refused| refused.to_string())?;
                let text = serde_json::to_string_pretty(&report).map_err(|error| error.to_string())?;
                Ok(text + "\n")
            }
            (Format::Between, _) => match self.state.marks {
                [Some(a), Some(b)] => {
                    let [from, to] = [a.min(b), a.max(b)].map(|time| run.sample_at(time).time);
                    Ok(channels::csv(run, from, to))
                }
                _ => Err("There are no two times A and B".into()),
            },
            (Format::Csv, Subject::Plots) => Ok(channels::csv(run, f64::NEG_INFINITY, f64::INFINITY)),
            (Format::Csv | Format::Latex, Subject::Table) => match self.found()? {
                Found::Table(table, _) if format == Format::Csv => Ok(table2::csv(table)),
                Found::Table(table, _) => Ok(table2::latex(table, &made(&self.made_of(subject).1, REPEATS))),
                _ => Err(UNDONE.into()),
            },
            (Format::Csv, Subject::Map) => match self.found()? {
                Found::Map(map) => Ok(map.csv()),
                _ => Err(UNDONE.into()),
            },
            (Format::Csv, Subject::Detectors) => {
                let (compare, comparison, _) = self.comparer.shown().ok_or(UNDONE)?;
                Ok(compare::export::csv(comparison, !compare.progress().is_complete()))
            }
            _ => Ok(csv(&self.chart(subject)?)),
        }
    }

    /// What a link to something says of the page.
    fn page_made(&self, subject: Subject) -> Page {
        let tuning = self.state.tuning;
        match subject {
            Subject::Chain => Page { chain: self.link().ok().and_then(|link| link.page.chain), ..Page::default() },
            Subject::Tuning => Page {
                rule: tuning.rule.name(),
                false_alarms: tuning.wish,
                repeats: tuning.repeats as u64,
                ..Page::default()
            },
            Subject::Detectors => Page {
                false_alarms: tuning.wish,
                repeats: tuning.repeats as u64,
                compare: tuning.compare,
                ..Page::default()
            },
            _ => Page::default(),
        }
    }

    /// What has been found for the stage, once it is complete.
    fn found(&self) -> Result<&Found, String> {
        match self.studies.found() {
            Some((found, _)) if self.studies.progress().is_none() => Ok(found),
            _ => Err(UNDONE.into()),
        }
    }

    /// Something as a chart with its caption.
    fn chart(&self, subject: Subject) -> Result<Chart, String> {
        let scenario = self.made_of(subject).1;
        match subject {
            Subject::Chain => self.chained().map(|memo| over_time(memo.run())).ok_or_else(|| UNDONE.into()),
            Subject::View => Err("The 3D view is no chart".into()),
            Subject::Plots => Ok(match self.log() {
                Some(name) => timeline::recorded(self.memo.run(), name),
                None => timeline::chart(self.memo.run()),
            }),
            Subject::Tuning => self.stages.tuning(&self.tuner).ok_or_else(|| UNDONE.into()),
            Subject::Detectors => {
                let (compare, comparison, _) = self.comparer.shown().ok_or(UNDONE)?;
                Ok(compare::chart::chart(compare, comparison))
            }
            Subject::Figure(_) | Subject::Table | Subject::Map => match self.found()? {
                Found::Figure(chart) => Ok(chart.clone()),
                Found::Table(table, [own, other]) => Ok(with_words(table, [own, other], (&scenario, REPEATS))),
                Found::Map(found) => Ok(map::chart::chart(found, self.memo.plan())),
            },
        }
    }
}
