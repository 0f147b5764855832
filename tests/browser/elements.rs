//! The page without a pointer and without a picture: real elements in step with the canvas, for keyboards and screen readers.

use crate::harness::{Options, Page, Renderer};

fn open() -> Page {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    // Nothing else to draw: software is slow.
    let pause = page.element("button", "Pause");
    page.eval(&format!("{pause}.click()"));
    page.element("button", "Play");
    page
}

/// Waits until the element that JavaScript finds by `script` has this value of an attribute or property.
#[track_caller]
fn wait_for(page: &mut Page, script: &str, property: &str, value: impl Into<serde_json::Value>) {
    let value = value.into();
    page.wait(&format!("{property} of {script} to be {value}"), |page| {
        (page.eval(&format!("{script}.{property}")) == value).then_some(())
    });
}

#[test]
fn elements_and_canvas_follow_each_other() {
    let mut page = open();
    let slider = page.element("slider", "Contact disk");
    assert_eq!(page.eval(&format!("{slider}.min + ' ' + {slider}.step")), "0 1");
    assert_eq!(page.eval(&format!("{slider}.closest('section').querySelector('h2').textContent")), "Controls");
    // What a screen reader does with a slider.
    page.eval(&format!(
        "(() => {{ {slider}.value = 0; {slider}.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()"
    ));
    page.wait("no detection", |page| page.data("detectionTime").is_none().then_some(()));
    assert_eq!(page.widget("Slider", "Contact disk").number, Some(0.0));
    // And what a mouse does comes back.
    page.drag("Slider", "Contact disk", 0.05, 0.98);
    page.wait("a detection", |page| page.number("detectionTime"));
    let number = page.widget("Slider", "Contact disk").number.expect("a number");
    wait_for(&mut page, &slider, "value", number.to_string());
    page.wait("a value in words", |page| {
        (page.eval(&format!("{slider}.getAttribute('aria-valuetext')")) == number.to_string().as_str()).then_some(())
    });

    let check = page.element("check", "ξ2 (centrode) on");
    assert_eq!(page.eval(&format!("{check}.checked")), true);
    page.eval(&format!("{check}.click()"));
    wait_for(&mut page, &check, "checked", false);
    let tab = page.element("tab", "Paper");
    page.eval(&format!("{tab}.click()"));
    wait_for(&mut page, &tab, "ariaSelected", "true");
    let figure = page.element("radio", "Figure 4");
    page.eval(&format!("{figure}.click()"));
    wait_for(&mut page, &figure, "checked", true);
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_keyboard_alone_tunes_a_threshold_and_copies_a_link() {
    let mut page = open();
    page.eval("navigator.clipboard.writeText = (text) => { globalThis.copied = text; return Promise.resolve(); }");
    page.tab_to("Tab", "field", "ξ2 (centrode) value");
    let field = page.element("field", "ξ2 (centrode) value");
    page.eval("document.activeElement.select()");
    page.insert("2.5");
    page.key("Enter");
    let slider = page.element("slider", "ξ2 (centrode)");
    wait_for(&mut page, &slider, "value", "2.5");
    assert_eq!(page.focused(), ("field".into(), "ξ2 (centrode) value".into()), "the keyboard stays");
    page.wait("the field to show it", |page| {
        page.eval(&format!("{field}.value")).as_str()?.parse().is_ok_and(|value: f64| value == 2.5).then_some(())
    });
    let before = page.number("detectionTime");
    page.tab_to("Tab", "slider", "ξ2 (centrode)");
    page.key("PageUp");
    page.key("ArrowRight");
    page.wait("the slider to move", |page| {
        let value: f64 = page.eval(&format!("{slider}.value")).as_str()?.parse().ok()?;
        (value > 2.6).then_some(())
    });
    page.wait("another detection", |page| (page.number("detectionTime") != before).then_some(()));
    page.wait("the focus on the canvas to be the same", |page| {
        page.widgets().iter().any(|w| w.focused && w.role == "Slider" && w.label == "ξ2 (centrode)").then_some(())
    });

    page.tab_to("ShiftTab", "button", "Share");
    page.key("Enter");
    page.wait("the menu to take the keyboard", |page| (page.focused().0 == "item").then_some(()));
    page.key("ArrowDown");
    page.wait("the next entry", |page| page.focused().1.starts_with("Copy command").then_some(()));
    page.key("Escape");
    page.wait("the keyboard back", |page| (page.focused() == ("button".into(), "Share".into())).then_some(()));
    page.key("Enter");
    page.wait("the menu again", |page| page.focused().1.starts_with("Copy link").then_some(()));
    page.key("Enter");
    let copied = page.wait("a link", |page| page.eval("globalThis.copied ?? null").as_str().map(str::to_owned));
    assert!(copied.contains("xi2=") || copied.contains("#"), "{copied}");
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn states_are_said_as_they_begin() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.eval(
        "globalThis.heard = []; new MutationObserver(() => heard.push(document.getElementById('said').textContent))\
         .observe(document.getElementById('said'), { childList: true }); 1",
    );
    let heard = page.wait("contact and detection to be said", |page| {
        let heard: Vec<String> = serde_json::from_value(page.eval("heard")).ok()?;
        heard.iter().any(|said| said.starts_with("Detected at")).then_some(heard)
    });
    assert!(heard[0].starts_with("In contact since") && heard.len() == 2, "{heard:?}");
    assert_eq!(page.eval("document.getElementById('said').ariaLive"), "polite");
}

#[test]
fn a_run_is_heard_only_while_it_plays() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    let sound = |page: &mut Page| page.eval("document.documentElement.dataset.sound").as_str().map(str::to_owned);
    assert_eq!(sound(&mut page).as_deref(), Some("off"), "at first it is not");
    page.key("m");
    page.wait("sound", |page| (sound(page).as_deref() == Some("on")).then_some(()));
    page.key(" ");
    page.wait("silence", |page| (sound(page).as_deref() == Some("off")).then_some(()));
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn tab_goes_through_the_page_and_out_at_both_ends() {
    let mut page = open();
    for key in ["Tab", "ShiftTab"] {
        page.eval("document.activeElement.blur()");
        let mut seen = std::collections::HashSet::new();
        let mut out = false;
        for _ in 0..400 {
            page.press(key);
            let focused = page.focused();
            if focused.0.is_empty() {
                out = true;
                break;
            }
            seen.insert(focused);
        }
        assert!(out && seen.len() > 40, "{key}: {} elements, out: {out}", seen.len());
    }
}

#[test]
fn a_pointer_and_a_keyboard_share_the_focus() {
    let mut page = open();
    page.click("Button", "Step forward");
    assert_eq!(page.eval("document.activeElement.id"), "canvas");
    // From the canvas Tab comes to the elements.
    page.key("Tab");
    assert!(!page.focused().0.is_empty());
    page.tab_to("Tab", "button", "Help");
    page.key("Enter");
    page.wait("the help to take the keyboard", |page| (page.focused().1 == "Close help").then_some(()));
    assert_eq!(page.eval("document.querySelector('#elements [data-kind=slider]').closest('[inert]') !== null"), true);
    page.key("Escape");
    page.wait("the keyboard back", |page| (page.focused().1 == "Help").then_some(()));
    page.key("?");
    page.wait("the list of keys", |page| (page.focused().1 == "Close keys").then_some(()));
    page.key("Enter");
    page.wait("the keyboard back", |page| (page.focused().1 == "Help").then_some(()));
    assert_eq!(page.problems(), Vec::<String>::new());
}
