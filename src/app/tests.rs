//! What commands come to, without anything drawn.

use super::*;
use centrode_core::scenario::{Method, Threshold};
use centrode_core::study::tuning::watch::Rule;

fn page() -> (egui::Context, App) {
    let ctx = egui::Context::default();
    let app = App::new(&ctx, None, Host::default());
    (ctx, app)
}

fn noted(commands: Vec<Command>) -> Vec<(&'static str, String)> {
    let (ctx, mut app) = page();
    let before = app.state.scenario.clone();
    app.apply(&ctx, &mut { commands });
    assert_eq!(app.state.scenario, before, "a refused change changes nothing");
    app.notes.into_iter().collect()
}

#[test]
fn a_refused_recommendation_is_noted_at_the_control_refused() {
    let take = |rule, threshold, length| noted(vec![Command::Take { rule, threshold, length }]);
    for (notes, key, said) in [
        (take(Rule::Fcd, 0.005, Some(99_999_999)), "filter.length", "Filter length N 99999999: a whole number from 1"),
        (take(Rule::Fcd, -1.0, Some(100)), "detection.xi2", "ξ2 (centrode) −1000.0 mm: a finite number, 0 mm"),
        (take(Rule::Jfd, -1.0, None), "detection.xi1", "ξ1 (joint force) −1000.0 mN·m: a finite number"),
    ] {
        assert_eq!(notes.len(), 1);
        assert!(notes[0].0 == key && notes[0].1.starts_with(said), "{notes:?}");
    }
}

#[test]
fn a_refused_touch_on_the_map_is_noted_at_the_control_refused() {
    let touch = |arc_length, bend| noted(vec![Command::Touch { arc_length, bend }]);
    for (notes, key, said) in [
        (touch(0.015, 7.0), "contact.time", "Contact bend 401"),
        (touch(0.050, 0.5), "contact.disk", "Contact place 50 mm: a number from 0 mm to robot.length = 30 mm"),
    ] {
        assert_eq!(notes.len(), 1);
        assert!(notes[0].0 == key && notes[0].1.starts_with(said), "{notes:?}");
    }
}

#[test]
fn a_threshold_that_is_switched_off_is_remembered_in_one_place() {
    let (ctx, mut app) = page();
    let xi2 = controls::table::control("detection.xi2").expect("a row");
    // Set and switched off where no plot has been drawn.
    app.apply(&ctx, &mut vec![Command::SetThreshold(Method::Fcd, Threshold::On(0.0045)), Command::Switch(xi2, false)]);
    assert_eq!(app.state.scenario.detection.xi2, Threshold::OFF);
    app.apply(&ctx, &mut vec![Command::Fold("Motion")]);
    let base = app.base.clone();
    assert_eq!(app.state.otherwise_si("detection.xi2", &base), 0.0045, "what the plot goes back to");
    app.apply(&ctx, &mut vec![Command::Switch(xi2, true)]);
    assert_eq!(app.state.scenario.detection.xi2, Threshold::On(0.0045), "what the control goes back to");
}

#[test]
fn plots_go_back_to_what_the_page_remembers() {
    let (ctx, mut app) = page();
    let xi2 = controls::table::control("detection.xi2").expect("a row");
    app.apply(&ctx, &mut vec![Command::Set(xi2, 3.5), Command::Switch(xi2, false)]);
    // Nothing is painted: its textures are dropped.
    ctx.run_ui(egui::RawInput::default(), |ui| app.ui(ui)).textures_delta.clear();
    assert_eq!(app.plots.otherwise[&Method::Fcd], 0.0035);
}
