//! What the study says, in sentences.

use crate::app::charts::notation::number;
use crate::app::stages::tuner::{LATE, Tuner};
use crate::app::stages::tuning::{Named, View};
use centrode_core::scenario::{Place, Thresholds};
use centrode_core::study::tuning::rate::Share;
use centrode_core::study::tuning::recommend::Verdict;
use centrode_core::study::tuning::tally::Found;
use centrode_core::study::tuning::watch::Rule;

/// A share in %, with as many digits as matter.
pub fn percent(share: f64) -> String {
    let decimals = if share > 0.0 && share < 0.0995 { 1 } else { 0 };
    number(share * 100.0, decimals)
}

/// A share that was chosen, in %.
pub fn wished(share: f64) -> String {
    number(share * 100.0, 0)
}

/// `1.0 to 8.5 %`.
pub fn interval(rate: &Share) -> String {
    format!("{} to {} %", percent(rate.low), percent(rate.high))
}

fn place(view: &View<'_>) -> String {
    match view.study.cells()[0].scenario.contact.place {
        Place::Nowhere => "nowhere".into(),
        Place::Disk(disk) => format!("on disk {disk}"),
        Place::ArcLength(s) => format!("at {} mm", number(s * 1e3, 1)),
    }
}

/// What the thresholds that are set achieve.
pub fn now(view: &View<'_>) -> String {
    let named = Named::of(view.tuning.rule, view.study);
    let (Some(point), Some(threshold)) = (view.own(), view.setting()) else {
        return format!("{} is off, so nothing is detected.", named.symbol);
    };
    let mut setting = setting(&named, threshold);
    if point.threshold != threshold {
        let counted = digits(&named, point.threshold);
        setting += format!(" (counted at {counted} {})", named.unit).replace(" )", ")").as_str();
    }
    let alarms = &point.false_alarms.rate;
    if alarms.of == 0 {
        return "Making the first runs …".into();
    }
    let mut text = format!(
        "Now, {setting}{}, N = {}: {} of {} runs without contact gave a false alarm ({}).",
        view.derived.beside.set,
        view.study.cells()[0].scenario.filter.length,
        if alarms.count == 0 { "none".into() } else { alarms.count.to_string() },
        alarms.of,
        interval(alarms),
    );
    match point.detection {
        // The first run says whether the robot reaches the beam.
        Some(seen) if seen.early.of == 0 => {}
        Some(_) if view.study.contact_time(0).is_none() => text += " The robot never reaches the beam.",
        Some(seen) => text += &found(&seen, &place(view)),
        None => text += " There is no contact to detect.",
    }
    text
}

fn found(seen: &Found, place: &str) -> String {
    let Share { count, of, .. } = seen.detected;
    if of == 0 {
        return " Every run gave an alarm before the contact.".into();
    }
    let mut text = match (count, seen.median.is_nan()) {
        (0, _) => format!(" Contact {place} is never detected within {} s.", LATE),
        (_, true) => format!(
            " Contact {place} is detected in only {count} of {of} runs, after {} s on average.",
            number(seen.mean, 2)
        ),
        (_, false) if count == of => format!(" Contact {place} is detected after {} s", number(seen.median, 2)),
        (_, false) => {
            format!(" Contact {place} is detected in {count} of {of} runs, after {} s", number(seen.median, 2))
        }
    };
    if !seen.median.is_nan() {
        text += " (median";
        if !seen.ninety.is_nan() {
            text += &format!("; 90 % within {} s", number(seen.ninety, 2));
        }
        text += ").";
    }
    if seen.early.count > 0 {
        let runs = if seen.early.count == 1 { "run" } else { "runs" };
        text += &format!(" {} {runs} gave an alarm before the contact.", seen.early.count);
    }
    text
}

/// The thresholds that a rule holds beside its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Beside {
    /// As they are set, and with which it was counted where that was another; empty for a rule of one detector.
    pub set: String,
    /// With which it was counted, as a sentence; empty where they are set like that.
    pub counted: String,
}

/// What a rule holds beside its own threshold. While one of these is on its way, the counts are those of the one before.
pub fn beside(tuner: &Tuner, rule: Rule) -> Beside {
    let (mut set, mut was) = (String::new(), String::new());
    for &detector in rule.fixed() {
        let (Some(counted), now) = (tuner.counted_with(rule), tuner.thresholds()) else { continue };
        let alone = Rule::ALL.iter().find(|rule| rule.fixed().is_empty() && rule.swept() == detector);
        let told = |thresholds: &Thresholds| {
            let named = Named::by(alone.copied().unwrap_or(rule), thresholds.xi1_rule);
            match detector.setting(thresholds) {
                Some(threshold) => setting(&named, threshold),
                None => format!("{} off", named.symbol),
            }
        };
        let (now, counted) = (told(now), told(counted));
        set += &format!(", {now}");
        if now != counted {
            set += &format!(" (counted with {counted})");
            was += &format!(" This is counted with {counted}.");
        }
    }
    Beside { set, counted: was }
}

fn setting(named: &Named, threshold: f64) -> String {
    format!("{} = {} {}", named.symbol, digits(named, threshold), named.unit).trim_end().to_owned()
}

/// A threshold with as many digits as it has, no fewer than usual.
pub fn digits(named: &Named, threshold: f64) -> String {
    let shown = threshold * named.scale;
    let decimals = (named.decimals..6).find(|&decimals| {
        let power = 10f64.powi(decimals as i32);
        ((shown * power).round() / power - shown).abs() < 1e-9 * shown.abs()
    });
    number(shown, decimals.unwrap_or(6))
}

/// What to take, and its level and filter length; or why nothing.
pub fn advice(view: &View<'_>) -> (String, Option<(usize, u64)>) {
    let wish = wished(view.tuning.wish);
    let named = Named::of(view.tuning.rule, view.study);
    let text = match &view.derived.verdict {
        Verdict::Take { cell, level, point } => {
            let length = view.study.cells()[*cell].scenario.filter.length;
            let delay = point.detection.map_or(f64::NAN, |seen| seen.median);
            let filter = if view.tuning.rule == Rule::Jfd { String::new() } else { format!(", N = {length}") };
            let text = format!(
                "Soonest with at most {wish} % false alarms: {}{filter} detects it after {} s, and {} of {} runs without contact gave a false alarm ({}).",
                setting(&named, point.threshold),
                number(delay, 2),
                point.false_alarms.rate.count,
                point.false_alarms.rate.of,
                interval(&point.false_alarms.rate),
            );
            return (text, Some((*level, length)));
        }
        Verdict::TooFewRuns { needed } => format!(
            "No threshold can be shown to give at most {wish} % false alarms: that takes at least {needed} runs, even when none of them gives one."
        ),
        Verdict::NoneQuiet { lowest } => {
            format!("No threshold gives at most {wish} % false alarms: the best may give up to {} %.", percent(*lowest))
        }
        Verdict::NoneFinds { best } => format!(
            "No threshold with at most {wish} % false alarms detects half of the contacts in time; the best detects {} %.",
            percent(*best)
        ),
        Verdict::NoContact => "Set a contact to get a recommendation.".into(),
    };
    (text, None)
}
