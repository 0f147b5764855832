//! The view of detectors, headless: their pictures, what is advised, and the same numbers as the command's.

use crate::saving::{file, saved, written};
use crate::stages::show;
use crate::support::{DESK, LOW, PHONE, Page, TABLET, app, finish, fits, page_of, slide, texts};
use centrode::app::stages::stage::Stage;
use centrode_core::detect::Method;
use egui::accesskit::Role;
use egui::vec2;
use egui_kittest::kittest::{NodeT, Queryable};

/// What the page is set to: a loop as fast as the tracker, and as many repeats as show 5 %.
pub const LINK: &str =
    "preset=bench&loop_rate=100&filter.length=50&estimation.estimators=marginal&view=detectors&repeats=74";

const DELAYS: &str = "Delay against false alarms, by detector";

/// A page that compares a few detectors.
pub fn go(page: &mut Page, link: &str) {
    page.state_mut().as_mut().expect("built").go(link);
    page.run_steps(2);
    assert!(app(page).notice().is_none(), "{:?}", app(page).notice());
    assert_eq!(app(page).state().stage, Stage::Detectors);
}

/// A page that has compared three detectors in so many runs, with a cheap estimate of the place or with the posterior.
fn compared(repeats: &str, estimator: &str) -> Page {
    let mut page = page_of(DESK);
    let link = LINK.replace("repeats=74", &format!("repeats={repeats}")).replace("marginal", estimator);
    go(&mut page, &format!("{link}&estimation.plants=clamp&compare=fcd,fcd-velocity,cusum"));
    finish(&mut page);
    page
}

#[test]
fn one_picture_has_every_method_and_what_no_test_can_beat() {
    let mut page = page_of(DESK);
    go(&mut page, &LINK.replace("repeats=74", "repeats=3"));
    finish(&mut page);
    for title in [DELAYS, "Error of the place since contact", "How often the interval holds the place"] {
        let figure = page.get_by_label_contains(title).rect();
        let least = if title == DELAYS { 150.0 } else { 80.0 };
        assert!(figure.width() > 300.0 && figure.height() > least, "{title}: {figure}");
    }
    let said = texts(&page, DELAYS).concat();
    for name in ["FCD", "JFD", "Consistent", "Velocity", "CUSUM", "GLR"] {
        let label = format!("Compare {name}");
        let wanted = page.get_by_role_and_label(Role::CheckBox, &label);
        assert_eq!(wanted.accesskit_node().toggled(), Some(egui::accesskit::Toggled::True), "{name}");
        assert!(said.contains(name) || ["FCD", "JFD"].contains(&name), "{name}: {said}");
    }
    assert!(said.contains("no test can beat 0.0"), "{said}");
    assert!(!texts(&page, "nothing can be shown with fewer than 73 runs").is_empty());
    // A detector that is left out has no curve.
    page.get_by_role_and_label(Role::CheckBox, "Compare GLR").click();
    page.run_steps(2);
    finish(&mut page);
    assert!(!texts(&page, DELAYS).concat().contains("GLR"));
    let compared = app(&page).comparer().shown().expect("a comparison").1.detectors.len();
    assert_eq!(compared, 5);
}

#[test]
fn advice_sets_the_threshold_of_its_detector_and_switches_it_on() {
    let mut page = compared("74", "eq24");
    let advice = |page: &Page| {
        let (_, comparison, _) = app(page).comparer().shown().expect("a comparison");
        comparison.advice().map(|(method, point)| (method, point.threshold)).expect("an advice")
    };
    let set = |page: &Page, method: Method| {
        let detection = &app(page).state().scenario.detection;
        (detection.detectors.has(method), detection.of(method).value())
    };
    let (method, threshold) = advice(&page);
    assert_eq!(method, Method::Cusum);
    assert!(!set(&page, Method::Cusum).0 && set(&page, Method::Cusum).1 != Some(threshold));
    assert!(!texts(&page, "Soonest with at most 5").concat().is_empty());
    page.get_by_role_and_label(Role::Button, "Take it").click();
    page.run_steps(2);
    assert_eq!(set(&page, Method::Cusum), (true, Some(threshold)));
    finish(&mut page);
    // High enough that the lines of all detectors are in sight.
    page.set_size(vec2(1440.0, 1900.0));
    page.run_steps(2);
    let velocity = app(&page).comparer().shown().expect("a comparison").1.detectors[1].taken().expect("one").threshold;
    page.get_by_role_and_label(Role::Button, "Take the threshold of Velocity").click();
    page.run_steps(2);
    assert_eq!(set(&page, Method::FcdVelocity), (true, Some(velocity)));
    // What no place depends on costs no run.
    assert!(!app(&page).is_working());
    assert!(set(&page, Method::Fcd).0, "the others stay as they were");
}

#[test]
fn a_click_on_a_curve_takes_its_threshold() {
    let mut page = compared("12", "eq24");
    let before = app(&page).state().scenario.detection.clone();
    let figure = page.get_by_label_contains(DELAYS).rect();
    let (_, comparison, _) = app(&page).comparer().shown().expect("a comparison");
    let thresholds: Vec<(Method, f64)> = comparison
        .detectors
        .iter()
        .flat_map(|compared| compared.curve.iter().map(|point| (compared.method(), point.threshold)))
        .collect();
    // Somewhere on the way down a curve is met.
    for k in 0..20 {
        let at = figure.lerp_inside(vec2(0.3, 0.05 * k as f32));
        page.drag_at(at);
        page.run_steps(1);
        page.drop_at(at);
        page.run_steps(2);
        if app(&page).state().scenario.detection != before {
            break;
        }
    }
    let now = &app(&page).state().scenario.detection;
    let taken = |(method, threshold): &&(Method, f64)| now.of(*method).value() == Some(*threshold);
    let (method, _) = thresholds.iter().find(taken).expect("a threshold of a curve");
    assert!(now.detectors.has(*method) && *now != before);
}

#[test]
fn a_comparison_between_frames_has_the_command_s_bytes() {
    let mut page = compared("9", "marginal");
    let args = |flag: &'static str| {
        let sets = [
            "loop_rate=100",
            "filter.length=50",
            "estimation.estimators=[\"marginal\"]",
            "estimation.plants=[\"clamp\"]",
        ];
        let sets = sets.into_iter().flat_map(|set| ["--set", set]);
        let end = ["--repeats", "9", "--detectors", "fcd,fcd-velocity,cusum", "--rate", "0.05", flag];
        ["study", "--preset", "bench"].into_iter().chain(sets).chain(end).collect::<Vec<_>>()
    };
    let (name, kind, svg) = file(saved(&mut page, "Save detectors", "SVG"));
    assert_eq!((name.as_str(), kind), ("detectors-bench.svg", "image/svg+xml"));
    assert!(svg.contains("view=detectors") && svg.contains("No test can beat") && !svg.contains("NaN"), "{svg}");
    assert!(svg == written(&args("--svg"), "svg"), "another drawing");
    let (name, _, numbers) = file(saved(&mut page, "Save detectors", "CSV"));
    assert_eq!(name, "detectors-bench.csv");
    assert!(numbers == written(&args("--csv"), "csv"), "other numbers");
}

#[test]
fn it_fits_in_every_size_and_says_what_cannot_be_compared() {
    let mut page = page_of(DESK);
    go(&mut page, &LINK.replace("repeats=74", "repeats=2"));
    page.run_steps(4);
    for done in [false, true] {
        for size in [PHONE, LOW, TABLET, DESK] {
            page.set_size(size);
            page.run_steps(2);
            fits(&page, size, "the comparison");
        }
        if !done {
            finish(&mut page);
        }
    }
    slide(&mut page, "Contact disk", 0.0);
    finish(&mut page);
    assert!(!texts(&page, "set a contact that the motion reaches").is_empty());
    show(&mut page, "Tuning");
    assert!(page.query_by_role_and_label(Role::CheckBox, "Compare GLR").is_none());
}
