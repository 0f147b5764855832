//! Where a slider's handle stands when the scenario says it in another way.

use centrode_core::model::configuration::bend_from_theta_l;
use centrode_core::scenario::Scenario;
use centrode_core::scenario::motion::command;
use centrode_core::scenario::{Place, Start};

/// The contact's place counted in disks: between two disks a fraction, 0 for none.
#[must_use]
pub fn disk(scenario: &Scenario) -> f64 {
    match scenario.contact.place {
        Place::Nowhere => 0.0,
        Place::Disk(disk) => disk.get() as f64,
        Place::ArcLength(s) => {
            let (mut count, mut below) = (0.0, 0.0);
            for &disk in &scenario.robot.disks {
                if s <= disk {
                    return count + ((s - below) / (disk - below)).clamp(0.0, 1.0);
                }
                (count, below) = (count + 1.0, disk);
            }
            count
        }
    }
}

/// When the contact starts, s; for one given by its bend, when the command passes that bend.
#[must_use]
pub fn contact_start(scenario: &Scenario) -> f64 {
    let bend = match scenario.contact.start {
        Start::Time(time) => return time,
        Start::Bend(bend) => bend,
    };
    let motion = &scenario.motion;
    let bend_at = |time: f64| bend_from_theta_l(command(motion, time).0);
    let rising = bend_at(motion.finish) > bend_at(motion.start);
    let (mut early, mut late) = (motion.start, motion.finish);
    // The motion is monotone; 50 halvings of a run are far below a sample.
    for _ in 0..50 {
        let middle = f64::midpoint(early, late);
        if (bend_at(middle) < bend) == rising { early = middle } else { late = middle }
    }
    f64::midpoint(early, late)
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_core::model::configuration::bend_from_theta_l;

    #[test]
    fn an_arc_length_lies_between_its_disks() {
        let mut scenario = Scenario::default();
        for (s, disks) in [(0.0, 0.0), (0.0075, 1.0), (0.018, 2.4), (0.0225, 3.0), (0.03, 3.0)] {
            scenario.contact.place = Place::ArcLength(s);
            assert!((disk(&scenario) - disks).abs() < 1e-9, "{s}");
        }
    }

    #[test]
    fn a_bend_is_passed_when_the_command_says() {
        let mut scenario = Scenario::default();
        let bend = bend_from_theta_l(command(&scenario.motion, 5.8).0);
        scenario.contact.start = Start::Bend(bend);
        assert!((contact_start(&scenario) - 5.8).abs() < 1e-9);
        std::mem::swap(&mut scenario.motion.theta_start, &mut scenario.motion.theta_end);
        let time = contact_start(&scenario);
        assert!((bend_from_theta_l(command(&scenario.motion, time).0) - bend).abs() < 1e-9);
    }
}
