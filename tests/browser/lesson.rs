//! The tour and the challenges in a browser: linked to, noticed, reloaded, and kept.

use crate::harness::{Options, Page, Renderer};

/// Whether what a widget says begins so.
fn says(page: &mut Page, start: &str) -> bool {
    page.widgets().iter().any(|widget| widget.label.starts_with(start) || widget.value.starts_with(start))
}

#[track_caller]
fn wait_for(page: &mut Page, start: &str) {
    page.wait(start, |page| says(page, start).then_some(()));
}

fn address(page: &mut Page) -> String {
    page.eval("location.href").as_str().unwrap_or_default().to_owned()
}

#[test]
fn a_step_is_linked_to_noticed_and_kept_over_a_reload() {
    let mut page = Page::open(Renderer::WebGl, "?test#preset=disk-3&seed=7&tour=5", Options::default());
    wait_for(&mut page, "Step 5 of 13");
    wait_for(&mut page, "To do: ");
    page.type_number("ξ2 (centrode)", "1.1");
    wait_for(&mut page, "Done. That is a false alarm");
    page.click("Button", "Next");
    wait_for(&mut page, "Step 6 of 13");
    page.wait("the step in the address", |page| address(page).ends_with("#preset=disk-3&seed=7&tour=6").then_some(()));
    page.reload();
    wait_for(&mut page, "Step 6 of 13");
    assert_eq!(page.eval("JSON.parse(localStorage['centrode.progress']).tour"), 6);
    page.click("Button", "Leave tour");
    page.wait("what was set", |page| (page.widget("Slider", "Seed").number == Some(7.0)).then_some(()));
    page.reload();
    page.click("Button", "Learn");
    wait_for(&mut page, "Resume step 6");
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_challenge_is_measured_and_stays_met() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.click("Button", "Learn");
    page.click("MenuItem", "Challenges");
    page.click("Button", "A clamp that looks like a touch");
    wait_for(&mut page, "Goal: ");
    page.type_number("Contact disk", "12 mm");
    page.wait("the goal to be met", |page| {
        page.widgets()
            .iter()
            .any(|widget| widget.label.starts_with("Goal: ") && widget.label.contains("Met. "))
            .then_some(())
    });
    page.wait("progress", |page| {
        (page.eval("JSON.parse(localStorage['centrode.progress'] ?? '{}').met?.[0]") == "clamp").then_some(())
    });
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_browser_that_keeps_nothing_says_so_and_goes_on() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.before_scripts(
        "Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('no', 'SecurityError'); } });",
    );
    page.reload();
    page.click("Button", "Learn");
    page.click("MenuItem", "Challenges");
    wait_for(&mut page, "Progress is not kept here.");
    page.click("Button", "Leave challenges");
    page.click("Button", "Learn");
    page.click("MenuItem", "Tour");
    wait_for(&mut page, "Step 1 of 13");
    assert_eq!(page.problems(), Vec::<String>::new());
}
