//! The challenges, as data: where each begins, what is to be reached, a hint, and a worked answer.

pub mod card;
pub mod check;

use super::tour::{Focus, and, at, pick, set};
use crate::app::charts::notation::number;
use crate::app::command::Command;
use crate::app::controls::table;
use centrode_core::detect::Method;
use centrode_core::scenario::Scenario;
use check::{Outcome, Tally};

/// One challenge.
pub struct Challenge {
    /// Its name where progress is kept.
    pub key: &'static str,
    /// Its title.
    pub title: &'static str,
    /// What is the matter.
    pub text: &'static str,
    /// What is to be reached, measurably.
    pub goal: &'static str,
    /// What helps.
    pub hint: &'static str,
    /// Why the worked answer works.
    pub answer: &'static str,
    /// Keys, or groups of keys ending with a point, that may be changed.
    pub free: &'static [&'static str],
    /// Keys of the controls that matter.
    pub controls: &'static [&'static str],
    /// What is looked at, where there is no room for all.
    pub focus: Focus,
    /// How many seeds are tried, from 1.
    pub seeds: u64,
    /// What runs are made with each of them.
    pub runs: Runs,
    /// Puts the page, as it opens, where it begins.
    pub begin: fn() -> Vec<Command>,
    /// Does what the answer says.
    pub show: fn() -> Vec<Command>,
    /// Whether the goal is met, and what was measured, in words: now, and as it began.
    pub judge: fn(&Tally, &Tally) -> (bool, String),
}

/// What runs a challenge is judged by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Runs {
    /// As it is set.
    AsSet,
    /// As it is set, and without contact.
    Both,
    /// As it is set, and a flat beam in place of the clamp.
    Touched,
}

/// How soon a contact is to be found, s.
const SOON: f64 = 0.5;

fn enter(key: &str, text: &str) -> Option<Command> {
    table::control(key).map(|control| Command::Enter(control, text.into()))
}

/// In how many of some runs something holds.
fn count(outcomes: &[Outcome], holds: impl Fn(&Outcome) -> bool) -> usize {
    outcomes.iter().filter(|outcome| holds(outcome)).count()
}

fn soon(outcome: &Outcome) -> bool {
    outcome.delay(Method::Fcd).is_some_and(|delay| (0.0..=SOON).contains(&delay))
}

fn alarms(outcomes: &[Outcome]) -> usize {
    count(outcomes, |outcome| outcome.first(Method::Fcd).is_some())
}

/// Mean of what all have; none when one lacks it.
fn mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let all: Option<Vec<f64>> = values.collect();
    all.filter(|all| !all.is_empty()).map(|all| all.iter().sum::<f64>() / all.len() as f64)
}

fn mean_delay(tally: &Tally) -> Option<f64> {
    mean(tally.set.iter().map(|outcome| outcome.delay(Method::Fcd).filter(|delay| *delay >= 0.0)))
}

fn seconds(value: Option<f64>) -> String {
    value.map_or_else(|| "undefined".into(), |value| format!("{} s", number(value, 2)))
}

/// “3 false alarms”.
fn false_alarms(count: usize) -> String {
    match count {
        0 => "no false alarm".into(),
        1 => "1 false alarm".into(),
        more => format!("{more} false alarms"),
    }
}

/// What opens the challenge of this name.
#[must_use]
pub fn named(name: &str) -> Option<super::Wish> {
    CHALLENGES.iter().position(|of| of.key == name).map(super::Wish::Challenge)
}

/// All of them.
pub static CHALLENGES: [Challenge; 6] = [
    Challenge {
        key: "disk-1",
        title: "Find disk 1",
        text: "A beam stops disk 1, next to the base. The centrode moves by less than 4 mm, so ξ2\u{a0}=\u{a0}7 mm is never exceeded by the contact itself, only by noise as \
               the motion comes to rest.",
        goal: "The centrode finds the contact within 0.5 s in 8 of 8 runs, and raises no alarm in 8 runs without contact.",
        hint: "A lower ξ2 finds it. Then look at where the free runs alarm: late, where the segment hardly turns and the measured centrode is nothing but noise. There is a floor for the speed, under Tracker.",
        answer: "ξ2\u{a0}=\u{a0}2.5 mm lies between the floor of a free motion and what disk 1 gives. A speed floor of 0.5 rad/s keeps the method silent while the segment turns too slowly for a centrode to mean anything.",
        free: &["detection.", "filter."],
        controls: &["detection.xi2", "detection.min_speed"],
        focus: Focus::Plots,
        seeds: 8,
        runs: Runs::Both,
        begin: || at("disk-1", 7.0),
        show: || and(Vec::new(), [set("detection.xi2", 0.0025), set("detection.min_speed", 0.5)]),
        judge: |now, _| {
            let (found, alarms) = (count(&now.set, soon), alarms(&now.other));
            let of = now.set.len();
            let said = format!(
                "Found within 0.5 s in {found} of {of} runs; {} in {} runs without contact.",
                false_alarms(alarms),
                now.other.len()
            );
            (found == of && alarms == 0, said)
        },
    },
    Challenge {
        key: "half",
        title: "Halve the delay",
        text: "On the bench, the centrode finds a contact on disk 2 almost half a second after it began. Anyone can be faster by crying wolf.",
        goal: "The mean delay of the centrode over 8 runs is at most half of what it was, with no more false alarms than before in 8 runs without contact.",
        hint: "Most of the delay is the average filling up. A shorter one is noisier, and the noise matters most where the segment turns slowly.",
        answer: "N\u{a0}=\u{a0}200 more than halves the delay. What it adds in false alarms comes as the motion ends; a speed floor of 0.5 rad/s takes them away.",
        free: &["detection.", "filter."],
        controls: &["filter.length", "detection.xi2", "detection.min_speed"],
        focus: Focus::Plots,
        seeds: 8,
        runs: Runs::Both,
        begin: || at("bench", 6.3),
        show: || and(Vec::new(), [set("filter.length", 200.0), set("detection.min_speed", 0.5)]),
        judge: |now, start| {
            let ([delay, before], [alarms, allowed]) =
                ([now, start].map(mean_delay), [now, start].map(|tally| alarms(&tally.other)));
            let halved = delay.zip(before).is_some_and(|(now, before)| now <= 0.5 * before);
            let said = format!(
                "Mean delay {}, at first {}; {} in {} runs without contact, at first {allowed}.",
                seconds(delay),
                seconds(before),
                false_alarms(alarms),
                now.other.len(),
            );
            (halved && alarms <= allowed, said)
        },
    },
    Challenge {
        key: "blind",
        title: "Make the joint forces blind",
        text: "Joint forces notice the contact on disk 2 before the centrode does. Their threshold ξ1 follows the shape: it is a multiple of ε_c, the largest \
               deviation that errors of the load cells can cause.",
        goal: "Joint forces notice the contact in none of 8 runs, the centrode in all. Only the load cells may be changed.",
        hint: "ξ1 grows with ε_c. If all cells are wrong by the same share, a preload cancels out of it. If each is wrong by itself, it does not.",
        answer: "With independent errors of 50 % and a preload of 10 N, the bound is so large that no contact exceeds it. The centrode does not ask the load cells: the two methods fail differently, which is why the paper has both.",
        free: &["load_cells."],
        controls: &["load_cells.epsilon_tau", "load_cells.preload", "load_cells.errors"],
        focus: Focus::Plots,
        seeds: 8,
        runs: Runs::AsSet,
        begin: || and(at("bench", 6.3), [pick("detection.xi1_rule", "bound")]),
        show: || {
            let changes = [
                pick("load_cells.errors", "independent"),
                set("load_cells.preload", 10.0),
                set("load_cells.epsilon_tau", 0.5),
            ];
            and(Vec::new(), changes)
        },
        judge: |now, _| {
            let of = now.set.len();
            let heard = count(&now.set, |outcome| outcome.first(Method::Jfd).is_some());
            let seen = count(&now.set, |outcome| outcome.delay(Method::Fcd).is_some_and(|delay| delay >= 0.0));
            let said = format!("Joint forces notice it in {heard} of {of} runs, the centrode in {seen}.");
            (heard == 0 && seen == of, said)
        },
    },
    Challenge {
        key: "clamp",
        title: "A clamp that looks like a touch",
        text: "A flat beam that only touches disk 2 lets the part below it give way, and the centrodes part less than with a clamp there. A detector sees nothing \
               but the deviation. Which clamp would give the same one?",
        goal: "With a clamp, the deviation stays within 0.1 mm (root mean square, until 7.5 s) of that of a flat beam on disk 2 from 5.8 s on.",
        hint: "The deviation of a clamp is about half its distance from the base. The touch gives a fifth less. The field “Contact disk” takes an arc length, too.",
        answer: "A clamp at 12 mm, a fifth lower than the disk at 15 mm. Who takes every contact for a clamp places this touch 3 mm too low.",
        free: &["contact."],
        controls: &["contact.disk"],
        focus: Focus::Plots,
        seeds: 1,
        runs: Runs::Touched,
        begin: || and(at("touch-2", 6.6), [pick("contact.kind", "clamp")]),
        show: || and(Vec::new(), [enter("contact.disk", "12 mm")]),
        judge: |now, _| match mean(now.set.iter().map(|outcome| outcome.unlike)) {
            Some(unlike) => (unlike <= 1e-4, format!("The deviations differ by {} mm.", number(unlike * 1e3, 2))),
            None => (false, "There is no clamp to compare.".into()),
        },
    },
    Challenge {
        key: "disk-3",
        title: "Disk 3 and its 9 mm",
        text: "Contact on disk 3, at 22.5 mm, is found soonest and placed worst: the estimate at the alarm is 8 to 9 mm too low, in the paper as here. \
               The model of the contact is exact in this simulation. So what is wrong?",
        goal: "The estimate at the alarm is off by at most 2.5 mm on average, and the contact is still found within 0.5 s in 8 of 8 runs. Only filter and detection may be changed.",
        hint: "The estimate is made at the instant of the alarm. What does the average hold at that instant?",
        answer: "The average: at the alarm it still holds mostly free motion, so the measured centrode is only part of the way. A later alarm (ξ2\u{a0}=\u{a0}10 mm) from a shorter average (N\u{a0}=\u{a0}200) waits until it has arrived, and is even sooner than before.",
        free: &["detection.", "filter."],
        controls: &["filter.length", "detection.xi2"],
        focus: Focus::Robot,
        seeds: 8,
        runs: Runs::AsSet,
        begin: || at("disk-3", 6.0),
        show: || and(Vec::new(), [set("filter.length", 200.0), set("detection.xi2", 0.010)]),
        judge: |now, _| {
            let (found, of) = (count(&now.set, soon), now.set.len());
            let off = mean(now.set.iter().map(|outcome| outcome.off));
            let far = off.map_or_else(
                || "Not placed".into(),
                |off| format!("Placed {} mm off on average", number(off * 1e3, 1)),
            );
            (
                found == of && off.is_some_and(|off| off <= 0.0025),
                format!("{far}; found within 0.5 s in {found} of {of} runs."),
            )
        },
    },
    Challenge {
        key: "best",
        title: "Break the best detector",
        text: "CUSUM reckons with errors of calibration: it knows how large they usually are, and takes smaller ones into account. Nothing touches in this run, and \
               it is silent.",
        goal: "CUSUM raises a false alarm in at least 4 of 8 runs without contact. Only errors of calibration may be changed.",
        hint: "It trusts its prior: one standard deviation of the frame's offset is a millimetre. You can type more than the slider shows.",
        answer: "A frame that is off by 10 mm along z is ten standard deviations away from what CUSUM thinks possible. It explains the readings by the next best thing it knows: a contact. A detector is as good as what it takes for granted.",
        free: &["calibration."],
        controls: &["calibration.frame[2]"],
        focus: Focus::Plots,
        seeds: 8,
        runs: Runs::AsSet,
        begin: || and(at("free", 6.0), ["cusum", "fcd", "jfd"].map(|detector| pick("detection.detectors", detector))),
        show: || and(Vec::new(), [set("calibration.frame[2]", 0.010)]),
        judge: |now, _| {
            let alarms = count(&now.set, |outcome| outcome.contact.is_none() && outcome.first(Method::Cusum).is_some());
            let of = now.set.len();
            (2 * alarms >= of, format!("CUSUM raises a false alarm in {alarms} of {of} runs without contact."))
        },
    },
];

impl Challenge {
    /// What of a scenario may not differ from how it began and does, by its path.
    #[must_use]
    pub fn forbidden(&self, start: &Scenario, now: &Scenario) -> Option<&'static str> {
        let may = |path: &str| {
            path == "seed"
                || self.free.iter().any(|free| if free.ends_with('.') { path.starts_with(free) } else { path == *free })
        };
        let keys = centrode_core::scenario::keys::KEYS.iter();
        keys.filter(|key| !may(key.path)).find(|key| !key.agrees(start, now)).map(|key| key.path)
    }
}
