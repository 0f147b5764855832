//! The paper on the page: what the browser works out is what the core works out natively.

use crate::harness::{Options, Page, Renderer};
use centrode_core::scenario::preset::{PRESETS, find};
use centrode_core::study::Job;
use centrode_core::study::figure::{FigureJob, Number};
use centrode_core::study::table2::Table2Job;

/// Picks something of the paper.
fn show(page: &mut Page, name: &str) {
    page.click("Tab", "Paper");
    page.click("RadioButton", name);
}

/// Waits for a widget whose name has all the parts.
fn named(page: &mut Page, parts: &[&str]) -> String {
    page.wait(&format!("a widget named {parts:?}"), |page| {
        // What is only read has its text as value, not as name.
        let texts = page.widgets().into_iter().flat_map(|widget| [widget.label, widget.value]);
        texts.into_iter().find(|text| parts.iter().all(|part| text.contains(part)))
    })
}

#[test]
fn table_ii_is_worked_out_in_the_page_as_natively() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.click("Button", "Pause");
    show(&mut page, "Table II");
    let mut job = Table2Job::new(&PRESETS[0].scenario().expect("valid"), 20).expect("valid");
    job.finish();
    let table = job.table();
    for (kind, disks) in [("a beam that clamps", table.simulated), ("a flat beam that touches", table.other)] {
        for disk in disks {
            let found = format!("{} / {}", disk.found, disk.repeats);
            let time = format!("{:.3} ± {:.3}", disk.detection_time.mean, disk.detection_time.deviation);
            named(&mut page, &[&format!("Simulated: {kind}, disk {}", disk.disk), &found, &time]);
        }
    }
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_figure_has_a_scenario_of_its_own_and_a_click_on_the_map_brings_the_contact() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.click("Button", "Pause");
    show(&mut page, "Figure 8");
    let mut job =
        FigureJob::new(Number::Eight, &find("figure-8").and_then(|p| p.scenario()).expect("valid")).expect("valid");
    job.finish();
    let figure = job.chart();
    named(&mut page, &[&figure.title, &figure.caption]);
    page.click("Button", "Use this scenario");
    page.wait("the scenario", |page| page.widgets().iter().all(|w| w.label != "Use this scenario").then_some(()));
    let before = page.number("detectionTime").expect("figure 8 shows detections");

    page.click("Tab", "Map");
    let map = named(&mut page, &["Map of the largest ξ2"]);
    // The middle: 15 mm at 45°, which the motion reaches before the contact of the figure.
    page.click("Figure", &map);
    page.wait("the live run to follow the map", |page| page.number("detectionTime").filter(|&time| time < before));
    assert_eq!(page.problems(), Vec::<String>::new());
}
