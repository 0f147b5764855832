//! What is true of every repeat of a scenario, whatever the noise.

use crate::plant::Plant;
use crate::scenario::Plan;

/// The first sample in contact, if there is one.
///
/// The motion does not turn back: what holds at its end began once, and what does not hold then held from the start or never.
#[must_use]
pub fn contact_sample(plan: &Plan) -> Option<usize> {
    let plant = Plant::new(plan);
    let holds = |k: usize| plant.held(&plant.command(plan.time(k)).0).is_some();
    let last = plan.samples() - 1;
    if holds(0) {
        return Some(0);
    }
    if !holds(last) {
        return None;
    }
    let (mut before, mut after) = (0, last);
    while after - before > 1 {
        let middle = before + (after - before) / 2;
        if holds(middle) { after = middle } else { before = middle }
    }
    Some(after)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Simulation;
    use crate::scenario::preset::find;

    #[test]
    fn contact_begins_when_the_run_says() {
        for (name, sets) in [
            ("bench", &[][..]),
            ("disk-1", &[]),
            ("letting-go", &[]),
            ("free", &[]),
            ("bench", &["motion.theta_start=0", "motion.theta_end=1.5"]),
            ("bench", &["contact.bend=1.57079632679489"]),
            ("bench", &["contact.bend=1.7"]),
            ("bench", &["contact.bend=-0.1", "motion.theta_end=2.5"]),
        ] {
            let mut draft = find(name).and_then(|preset| preset.draft()).expect(name);
            sets.iter().for_each(|set| draft.set(set).expect(set));
            let plan = Plan::new(&draft.finish().expect(name)).expect(name);
            let mut simulation = Simulation::new(&plan);
            simulation.by_ref().for_each(drop);
            let ours = contact_sample(&plan).map(|k| plan.time(k));
            assert_eq!(ours, simulation.contact_time(), "{name} {sets:?}");
        }
    }
}
