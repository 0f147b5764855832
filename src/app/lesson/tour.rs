//! The tour, as data: from the instantaneous centre of rotation to what the best detector knows, and to segments in series.

use super::apply::Seen;
use crate::app::chain::apply::Wish;
use crate::app::command::Command;
use crate::app::controls::control::{Choice, Control};
use crate::app::controls::table::{self, GROUPS};
use crate::app::state::Tab;
use crate::app::words::story::Phase;
use centrode_core::detect::Method;
use centrode_core::scenario::preset;
use centrode_core::scenario::{Place, Xi1Rule};

/// How many steps there are.
pub const STEPS: usize = 13;

/// One step.
pub struct Step {
    /// What it is about.
    pub title: &'static str,
    /// Its one idea.
    pub text: &'static str,
    /// The one thing to do.
    pub task: &'static str,
    /// What is said once that is done.
    pub noticed: &'static str,
    /// What is looked at, where there is no room for all.
    pub focus: Focus,
    /// Keys of the controls that it takes, shown beside the text where they are not on the page.
    pub controls: &'static [&'static str],
    /// Puts the page, as it opens, where the step begins.
    pub begin: fn() -> Vec<Command>,
    /// Whether the thing is done.
    pub done: fn(&Seen<'_>) -> bool,
}

/// What a step looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Focus {
    /// The moving plate, in place of everything else.
    Plate,
    /// The robot in space.
    Robot,
    /// The plots.
    Plots,
}

/// Loads a preset, stops at a time (s), and shows the plots where there is room for one thing only.
pub(super) fn at(name: &str, time: f64) -> Vec<Command> {
    // The names stand in this file, and a test takes every step.
    let chosen = preset::find(name).ok().map(Command::Choose);
    let settled = [Command::Pause, Command::Seek(time), Command::ShowTab(Tab::Plots)];
    chosen.into_iter().chain(settled).collect()
}

/// Loads a preset with several segments and stops at a time (s).
fn several(name: &str, time: f64) -> Vec<Command> {
    let chosen = preset::find_chain(name).map(|preset| Command::Chain(Wish::Choose(preset)));
    let settled = [Command::Pause, Command::Seek(time), Command::ShowTab(Tab::Result)];
    chosen.into_iter().chain(settled).collect()
}

/// Sets a key that has a control, SI.
pub(super) fn set(key: &str, si: f64) -> Option<Command> {
    table::control(key).map(|control| Command::Set(control, control.quantity().shown(si)))
}

/// Picks the option of a choice that is written as this word.
pub(super) fn pick(key: &str, word: &str) -> Option<Command> {
    let choice = choice(key)?;
    let words = if choice.of.is_words() { choice.of.any_of() } else { choice.of.words() };
    words.iter().position(|option| *option == word).map(|option| Command::Pick(choice, option))
}

/// The choice of a key.
#[must_use]
pub fn choice(key: &str) -> Option<&'static Choice> {
    GROUPS.iter().flat_map(|group| group.choices).find(|choice| choice.of.path == key)
}

/// The control of a key.
#[must_use]
pub fn control(key: &str) -> Option<&'static Control> {
    table::control(key)
}

pub(super) fn and(mut commands: Vec<Command>, more: impl IntoIterator<Item = Option<Command>>) -> Vec<Command> {
    commands.extend(more.into_iter().flatten());
    commands
}

/// All steps.
pub static TOUR: [Step; STEPS] = [
    Step {
        title: "The centre of a motion",
        text: "At every instant a body that moves in a plane turns about one point, its instantaneous centre of rotation. Each point of \
               the body moves at right angles to its line to that centre. Two velocities therefore give it away: draw the perpendicular \
               to each, and the centre is where they meet.",
        task: "Turn the arrow at B until the centre lies in the ring.",
        noticed: "The plate now turns about the ring. If both arrows were parallel, it would turn about nothing: its centre would be infinitely far away.",
        focus: Focus::Plate,
        controls: &[],
        begin: || at("free", 4.0),
        done: |seen| seen.plate.is_met(),
    },
    Step {
        title: "A segment that bends freely",
        text: "The end disk of a bending segment turns, too: about an axis in space. The point of that axis nearest to the base is called the fixed \
               centrode. A model of the shape predicts it (blue triangle); a tracker on the end disk measures it (green dot). While nothing \
               touches, both stay together.",
        task: "Play, or move the time, until the segment has bent beyond 60°.",
        noticed: "Both centrodes moved over several millimetres, and they moved together.",
        focus: Focus::Robot,
        controls: &[],
        begin: || at("free", 3.6),
        done: |seen| std::f64::consts::FRAC_PI_2 - seen.run.sample_at(seen.time).theta_l > 60_f64.to_radians(),
    },
    Step {
        title: "Contact moves the centrode",
        text: "A beam now stops disk 2. The part of the segment below it no longer moves; only the part above goes on bending, and the \
               end disk turns about another axis. The orange circle is where the model puts the centrode of a segment held there: about half the \
               distance from the base to the beam away from the blue triangle.",
        task: "Step past 5.8 s and stop while the state says “In contact”.",
        noticed: "The true centrode has jumped. The measured one follows only slowly, because the readings are averaged.",
        focus: Focus::Robot,
        controls: &[],
        begin: || at("bench", 5.7),
        done: |seen| !seen.state.playing && Phase::at(seen.run, seen.time) == Phase::Contact,
    },
    Step {
        title: "One number to watch",
        text: "The distance ‖c_m − c_s‖ from the model's centrode to the measured one is small while the segment moves freely, and grows after a contact. \
               The first plot shows it over time. Contact is detected when it exceeds the threshold ξ2, the line that bears its name.",
        task: "Put the time where the curve crosses ξ2: click there in the plot, or step with the arrow keys.",
        noticed: "Here the contact is detected. The time since the contact is the delay, and the rest of the tour is about making it short.",
        focus: Focus::Plots,
        controls: &[],
        begin: || at("bench", 5.0),
        done: |seen| {
            !seen.state.playing && seen.detection().is_some_and(|detection| (seen.time - detection).abs() <= 0.05)
        },
    },
    Step {
        title: "What a low threshold costs",
        text: "A lower threshold ξ2 is crossed sooner. But the deviation is never zero: noise and the delay of the average keep it above a floor even when \
               nothing touches. A threshold below that floor alarms without a contact.",
        task: "Lower ξ2 step by step until the alarm comes before the contact.",
        noticed: "That is a false alarm: nothing touches yet. The threshold must stay above whatever a free motion shows.",
        focus: Focus::Plots,
        controls: &["detection.xi2"],
        begin: || at("bench", 6.3),
        done: |seen| match (seen.detection(), seen.run.contact_time()) {
            (Some(alarm), Some(contact)) => alarm < contact,
            _ => false,
        },
    },
    Step {
        title: "A filter trades noise for time",
        text: "The tracker's readings are averaged over the last N steps of the loop, one each millisecond. A long average is quiet and late; a short one \
               is early and restless. Most of the delay is the average filling up with motion from after the contact.",
        task: "Shorten the filter until the contact is detected at least 0.2 s sooner.",
        noticed: "Sooner, and the free part of the curve is rougher. Make it much shorter, and noise alone crosses ξ2.",
        focus: Focus::Plots,
        controls: &["filter.length"],
        begin: || at("bench", 6.3),
        done: |seen| {
            let contact = seen.run.contact_time();
            let sooner = seen.detection().zip(seen.began).is_some_and(|(now, before)| now <= before - 0.2);
            sooner && seen.detection() > contact
        },
    },
    Step {
        title: "Listening to the joints",
        text: "A contact also changes the forces that drive the backbones. The joint force deviation Θ is the part of them that the model does not explain. \
               Errors of the load cells alone can make it as large as ε_c, which grows as the segment bends. A constant threshold ξ1 has to \
               stay above the largest ε_c; one that follows the shape need not.",
        task: "Let ξ1 follow the shape.",
        noticed: "The threshold now rises with the bend, starts lower, and Θ crosses it sooner. No filter delays it.",
        focus: Focus::Plots,
        controls: &["detection.xi1_rule"],
        begin: || and(at("bench", 6.3), [pick("detection.detectors", "fcd")]),
        done: |seen| seen.state.scenario.detection.xi1_rule == Xi1Rule::Bound && seen.found_by(Method::Jfd).is_some(),
    },
    Step {
        title: "Where it touches",
        text: "Every place of contact would put the centrode somewhere else. Equation 24 turns this around: the place whose centrode lies nearest to \
               the measured one is the estimate, the vermilion diamond on the backbone. On disk 2 it is close to the beam.",
        task: "Put the contact on disk 3, and see where the estimate lies.",
        noticed: "It is several millimetres too low. When the alarm is raised, half of the average still holds free motion, and the measured centrode is only on its way.",
        focus: Focus::Robot,
        controls: &["contact.disk"],
        begin: || at("bench", 7.0),
        done: |seen| {
            seen.state.scenario.contact.place == Place::disk(3)
                && seen.detection().is_some_and(|detection| detection <= seen.time)
        },
    },
    Step {
        title: "A model is never exact",
        text: "The method trusts its model and its tracker. If the tracker's frame is off by some millimetres, so is the measured centrode, from the start \
               and without any contact. The threshold cannot tell one from the other. Nothing touches in this run, and ξ2 is 3 mm.",
        task: "Shift the tracker's frame along z until the centrode raises a false alarm.",
        noticed: "A threshold can only be as low as the calibration is good.",
        focus: Focus::Plots,
        controls: &["calibration.frame[2]"],
        begin: || {
            let quiet =
                [set("detection.xi2", 0.003), set("detection.min_speed", 0.3), pick("detection.detectors", "jfd")];
            and(at("free", 6.0), quiet)
        },
        done: |seen| seen.run.contact_time().is_none() && seen.detection().is_some(),
    },
    Step {
        title: "What the best detector knows",
        text: "CUSUM estimates the errors of calibration while the segment moves, and adds up how much more likely each reading is with a \
               contact than without. It needs no average, so it is quick. It also says how sure it is: the band on the backbone holds the place \
               of contact with 95 % probability.",
        task: "Play, or move the time, past the alarm of CUSUM until the band has become narrow.",
        noticed: "The frame is off, the length is wrong, and still the contact is found within some hundredths of a second and placed with its uncertainty. A chapter on segments in series follows.",
        focus: Focus::Robot,
        controls: &[],
        begin: || and(at("miscalibrated", 5.7), [pick("detection.detectors", "fcd-consistent")]),
        done: |seen| seen.placed && seen.found_by(Method::Cusum).is_some_and(|alarm| seen.time >= alarm + 0.3),
    },
    Step {
        title: "Which segment to blame",
        text: "Segments in series carry one another. A beam that touches segment 2 bends segment 1 as well, often more than the touched segment itself: the \
               first disk to deviate tells little. But segments beyond the last contact go on as if nothing had happened, seen from the disk below \
               them. So the most distal disk that deviates carries the contact.",
        task: "Play, or move the time, past the first alarm until the contact is placed.",
        noticed: "Disks 1 and 2 deviate, disk 3 does not: segment 2 is touched. At 6.8 s a second beam touches segment 3, and is told apart from the first.",
        focus: Focus::Robot,
        controls: &[],
        begin: || several("two-contacts", 5.0),
        done: |seen| {
            let Some(memo) = seen.chain else { return false };
            let first = memo.told().first().filter(|told| told.found.deviating.len() > 1);
            first
                .and_then(|told| told.at(seen.time))
                .is_some_and(|estimate| estimate.segment == 1 && estimate.after > 0.0)
        },
    },
    Step {
        title: "Why torsion matters",
        text: "A beam that stands aslant pushes a segment out of its bending plane, and its force twists what is below. How far depends on the stiffness in \
               torsion. With GJ = 5 EI the last disk of three segments stands 1 to 13 mm from where a chain that cannot twist would have it: more than \
               a threshold. In one plane there is no twist at all.",
        task: "Play, or move the time, until the end disk is half a millimetre out of its bending plane.",
        noticed: "The joints still turn in one plane; the robot does not. The place is estimated with all directions of the beam in mind.",
        focus: Focus::Robot,
        controls: &[],
        begin: || several("oblique", 4.0),
        done: |seen| seen.chain.is_some_and(|memo| memo.aside(seen.time) > 0.0005),
    },
    Step {
        title: "What buckling looks like",
        text: "A contact far out presses the segments below it together, as a hand presses a ruler. Up to a point they only bend on. Beyond it the shape in \
               the plane is no longer stable: the smallest push sends the robot sideways, and it comes back only at a smaller bend. The stability margin \
               says how near that is; at 0 the run ends.",
        task: "Play, or move the time, to the end of the run, and watch the stability margin.",
        noticed: "Here it buckles. A rig would snap aside, and what a model of the plane says of it is no longer true. You have seen it all: try the challenges.",
        focus: Focus::Plots,
        controls: &[],
        // What it shows last is its margin.
        begin: || {
            let margin = [Command::ShowTab(Tab::Plots), Command::Chain(Wish::Plot(usize::MAX))];
            and(several("buckling", 4.0), margin.map(Some))
        },
        done: |seen| seen.chain.is_some_and(|memo| memo.gives_way() && seen.time >= memo.end() - 0.02),
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_can_name_every_step_and_a_text_is_short() {
        assert_eq!(STEPS as u64, centrode_core::scenario::link::page::TOUR_STEPS);
        for step in &TOUR {
            let sentences = step.text.matches(". ").count() + step.text.matches(": ").count() / 2 + 1;
            assert!((2..=5).contains(&sentences), "{}: {sentences}", step.title);
            assert!(step.text.len() < 420 && step.task.len() < 110, "{}", step.title);
            assert!(!(step.begin)().is_empty(), "{}", step.title);
            for key in step.controls {
                assert!(control(key).is_some() || choice(key).is_some(), "{key}");
            }
        }
    }

    #[test]
    fn a_word_of_a_choice_is_picked_by_name() {
        assert!(matches!(pick("detection.xi1_rule", "bound"), Some(Command::Pick(_, 1))));
        assert!(pick("detection.xi1_rule", "nonsense").is_none() && pick("seed", "1").is_none());
    }
}
