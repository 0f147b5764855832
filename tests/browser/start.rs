//! The page starts, draws, moves and listens, on every renderer and screen.

use crate::harness::{Area, Options, Page, Picture, Renderer};

/// The middle of the window, away from its panels.
const MIDDLE: Area = Area(0.3, 0.2, 0.7, 0.6);

/// Waits until the picture differs from `before`.
#[track_caller]
fn wait_for_motion(page: &mut Page, before: &Picture) {
    page.wait("the picture to move", |page| (page.picture().changed(before, Area::ALL) > 100).then_some(()));
}

#[track_caller]
pub fn draws_and_moves(page: &mut Page, name: &str) {
    assert_eq!(page.data("renderer").as_deref(), Some(name));
    let before = page.picture();
    assert!(before.colours(MIDDLE) > 8, "the middle of the page is blank");
    wait_for_motion(page, &before);
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn draws_and_moves_on_webgl() {
    draws_and_moves(&mut Page::open(Renderer::WebGl, "?test", Options::default()), "webgl");
}

#[test]
fn draws_and_moves_on_webgpu() {
    draws_and_moves(&mut Page::open(Renderer::WebGpu, "?test", Options::default()), "webgpu");
}

#[test]
fn the_renderer_can_be_chosen() {
    // Where WebGPU would be the choice by itself, and where it was asked for.
    for (renderer, name) in [(Renderer::Both, "webgl"), (Renderer::WebGpu, "webgpu")] {
        let query = format!("?test&renderer={name}");
        let mut page = Page::open(renderer, &query, Options::default());
        assert_eq!(page.data("renderer").as_deref(), Some(name));
        assert_eq!(page.eval("document.getElementById('notice').open"), false);
    }
}

#[test]
fn draws_by_plain_http_from_another_machine() {
    let mut page = Page::visit(Renderer::Both, "?test", Options::default());
    let address = page.eval("location.href.replace(location.hostname, 'page.test')");
    page.go(address.as_str().expect("an address"));
    page.wait("the page to be ready", |page| (page.data("ready").as_deref() == Some("true")).then_some(()));
    // No browser gives WebGPU there.
    assert_eq!(page.eval("isSecureContext"), false);
    draws_and_moves(&mut page, "webgl");
}

#[test]
fn both_renderers_draw_the_same_picture() {
    let [webgl, webgpu] = [Renderer::WebGl, Renderer::WebGpu].map(|renderer| {
        let options = Options { still: true, ..Options::default() };
        let mut page = Page::open(renderer, "?test#preset=bench&t=6.5&loop=off", options);
        assert_eq!(page.data("renderer"), Some(format!("{renderer:?}").to_lowercase()));
        let mut before = page.picture();
        page.wait("a picture that stays", |page| {
            (0..4).for_each(|_| page.frames());
            let last = std::mem::replace(&mut before, page.picture());
            (before.changed(&last, Area::ALL) == 0).then_some(())
        });
        before
    });
    let apart = webgl.changed(&webgpu, Area::ALL);
    println!("pixels that differ between WebGL2 and WebGPU: {apart}");
    // Edges are rounded one way or the other; a body turned inside out or a shadow that is missing is thousands.
    assert!(apart < 1000, "{apart} pixels differ");
}

#[test]
fn says_its_state_in_words() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    let first = page.number("time").expect("a time");
    page.wait("time to go on", |page| page.number("time").filter(|time| *time != first));
    let state = page.data("state").expect("a state");
    assert!(["free", "in contact", "detected"].contains(&state.as_str()), "{state}");
    let words = page.eval("document.getElementById('mirror').textContent");
    assert!(words.as_str().is_some_and(|words| !words.is_empty()));
}

#[test]
fn a_slider_obeys_mouse_and_keyboard() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.type_number("Contact disk", "0");
    page.wait("no detection", |page| page.data("detectionTime").is_none().then_some(()));
    assert_eq!(page.widget("Slider", "Contact disk").number, Some(0.0));
    page.drag("Slider", "Contact disk", 0.05, 0.98);
    page.wait("a detection", |page| page.number("detectionTime"));
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn fills_a_phone_and_turns_with_it() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::phone());
    for size in [[390, 844], [844, 390]] {
        page.resize(size);
        page.wait("the canvas to fill the window", |page| {
            let canvas = page.eval(
                "(() => { const r = document.getElementById('canvas').getBoundingClientRect(); \
                 const c = document.getElementById('canvas'); \
                 return [r.width, r.height, c.width, c.height, document.documentElement.scrollWidth]; })()",
            );
            let [w, h] = size.map(f64::from);
            let wanted = [w, h, 2.0 * w, 2.0 * h, w].map(Some);
            let found: Vec<Option<f64>> = canvas.as_array().into_iter().flatten().map(|v| v.as_f64()).collect();
            (found == wanted).then_some(())
        });
        let picture = page.picture();
        assert!(picture.colours(Area::ALL) > 8);
    }
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn an_emulated_pixel_ratio_reaches_the_canvas() {
    let phone = Options { scale: 1.0, emulated: Some(3.0), ..Options::phone() };
    let mut page = Page::open(Renderer::WebGl, "?test", phone);
    for ratio in [3.0, 2.625, 2.0, 1.0] {
        page.emulate(ratio);
        let wanted = [390.0, 844.0].map(|side: f64| (side * ratio).round());
        page.wait(&format!("a canvas of {wanted:?} pixels"), |page| {
            let canvas = page.eval("(({ width, height }) => [width, height])(document.getElementById('canvas'))");
            let canvas: [f64; 2] = serde_json::from_value(canvas).ok()?;
            // Halves of a pixel are rounded one way or the other.
            canvas.iter().zip(wanted).all(|(ours, wanted)| (ours - wanted).abs() <= 1.0).then_some(())
        });
        // Everything is drawn for the window that there is, not for one a few times smaller.
        page.wait("the bar of views in its place", |page| {
            let [x, y, width, _] = page.widget("Tab", "Tuning").bounds?;
            (x > 250.0 && x + width < 390.0 && y < 100.0).then_some(())
        });
    }
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn follows_dark_and_light() {
    for dark in [false, true] {
        let options = Options { dark, ..Options::default() };
        let mut page = Page::open(Renderer::WebGl, "?test", options);
        let brightness = page.picture().brightness(Area::ALL);
        assert_eq!(brightness < 128.0, dark, "brightness {brightness}");
    }
}

#[test]
fn exports_what_runs_without_a_canvas() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    let one = page.eval("centrode.fingerprint('')");
    assert!(one.as_str().is_some_and(|hash| !hash.is_empty()));
    assert_eq!(one, page.eval("centrode.fingerprint('')"));
}

#[test]
fn a_visitor_gets_no_test_doors() {
    let mut page = Page::open(Renderer::WebGl, "", Options::default());
    assert_eq!(page.eval("typeof centrode"), "undefined");
}
