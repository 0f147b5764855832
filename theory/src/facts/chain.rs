//! Numbers of segments in series.

use super::Facts;
use crate::figures::chains::{MET, ON, against, buckles, deviations, example, found, rods, run};
use anyhow::{Context, Result};
use centrode_core::detect::chain::ChainEstimate;
use centrode_core::model::chain::{Torsion, settle};

pub(super) fn facts(facts: &mut Facts) -> Result<()> {
    blame(facts)?;
    one(facts)?;
    two(facts)?;
    torsion(facts)?;
    buckling(facts)
}

/// What a beam at the middle of the third segment does.
fn blame(facts: &mut Facts) -> Result<()> {
    let rods = rods(Torsion::Ratio(5.0))?;
    let settled = against(&rods, (2, 0.5 * rods[2].length), MET + ON).context("a shape")?;
    let moved = deviations(&rods, &settled, MET + ON);
    facts.put("blame-length", 1e3 * rods[0].length, 0, "mm");
    facts.degrees("blame-met", MET, 0);
    facts.degrees("blame-on", ON, 0);
    facts.put("blame-own", 1e3 * moved[2], 2, "mm");
    facts.put("blame-below", 1e3 * moved[1], 2, "mm");
    Ok(())
}

/// Which disk alarms first of a beam on another segment.
fn one(facts: &mut Facts) -> Result<()> {
    let run = run("three-segments")?;
    let contact = run.plan.scenario().contacts.first().context("a contact")?;
    let found = found(&run)?;
    let first = found.first().context("an alarm")?;
    facts.put("one-segment", (contact.segment + 1) as f64, 0, "");
    facts.put("one-first", (first.raised_by + 1) as f64, 0, "");
    Ok(())
}

/// Where two beams are found.
fn two(facts: &mut Facts) -> Result<()> {
    let run = run("two-contacts")?;
    let found = found(&run)?;
    let known: Vec<&ChainEstimate> = found.iter().filter_map(|found| found.estimates.first()).collect();
    let [first, second] = known[..] else { anyhow::bail!("{} contacts are placed instead of two", known.len()) };
    facts.put("first-met", run.plan.path().happened().first().context("a contact")?.time, 1, "s");
    let names = [(first, "first-segment", "first-place"), (second, "second-segment", "second-place")];
    for (estimate, segment, place) in names {
        facts.put(segment, (estimate.segment + 1) as f64, 0, "");
        facts.put(place, 1e3 * estimate.place.mean, 2, "mm");
    }
    facts.put("first-probability", 100.0 * first.probabilities[first.segment], 0, "%");
    facts.put("first-low-end", 1e3 * first.place.low, 2, "mm");
    facts.put("first-high-end", 1e3 * first.place.high, 2, "mm");
    let contacts = &run.plan.scenario().contacts;
    anyhow::ensure!(contacts.iter().all(|contact| contact.at == contacts[0].at), "the text says that they are alike");
    facts.put("both-at", 1e3 * contacts[0].at, 0, "mm");
    Ok(())
}

/// How far torsion moves the last end disk of the example.
fn torsion(facts: &mut Facts) -> Result<()> {
    let setup = example()?;
    let settled = |torsion| settle(&rods(torsion)?, &setup.configurations, &setup.contacts).context("a shape");
    let tip = |torsion| -> Result<_> { Ok(settled(torsion)?.disks.last().context("a disk")?.pose.position) };
    let rigid = tip(Torsion::Rigid)?;
    for (name, ratio) in [("torsion-5", 5.0), ("torsion-20", 20.0)] {
        facts.put(name, 1e3 * (tip(Torsion::Ratio(ratio))? - rigid).norm(), 2, "mm");
    }
    let forces = settled(Torsion::Ratio(5.0))?.forces;
    for (name, force) in ["torsion-force-1", "torsion-force-2"].into_iter().zip(forces) {
        facts.put(name, force, 1, "N");
    }
    Ok(())
}

/// At which bends the figure's chain buckles.
fn buckling(facts: &mut Facts) -> Result<()> {
    let [soft, rigid] = [rods(Torsion::Ratio(5.0))?, rods(Torsion::Rigid)?];
    for (name, rods, segment) in [
        ("buckles-2", &soft, 1),
        ("buckles-3", &soft, 2),
        ("buckles-2-rigid", &rigid, 1),
        ("buckles-3-rigid", &rigid, 2),
    ] {
        facts.degrees(name, buckles(rods, segment)?.context("it buckles")?, 0);
    }
    anyhow::ensure!(buckles(&soft, 0)?.is_none() && buckles(&rigid, 0)?.is_none(), "the text says that it never does");
    Ok(())
}
