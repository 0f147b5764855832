//! The theory beside the page: rendered by the browser alone, readable on a desk, on a phone and on paper, and linked both ways.

use crate::harness::{Options, Page, Renderer};
use serde_json::Value;

/// Sizes of everything that a selector finds: width and height.
const SIZES: &str = "(selector) => [...document.querySelectorAll(selector)].map(e => { \
    const { width, height } = e.getBoundingClientRect(); return [width, height]; })";

#[track_caller]
fn sizes(page: &mut Page, selector: &str) -> Vec<[f64; 2]> {
    let found = page.eval(&format!("({SIZES})({selector:?})"));
    serde_json::from_value(found).expect("sizes")
}

/// The width of the document and that of the window.
#[track_caller]
fn widths(page: &mut Page) -> [f64; 2] {
    let found = page.eval("[document.documentElement.scrollWidth, document.documentElement.clientWidth]");
    serde_json::from_value(found).expect("widths")
}

#[test]
fn its_mathematics_has_layout_and_its_figures_fit() {
    for (options, shown, hidden) in [(Options::default(), "wide", "narrow"), (Options::phone(), "narrow", "wide")] {
        let mut page = Page::read("theory.html", options);
        page.eval("document.fonts.ready.then(() => 1)");
        let maths = sizes(&mut page, "math");
        assert!(maths.len() > 150, "{} of them", maths.len());
        assert!(maths.iter().all(|[width, height]| *width > 3.0 && *height > 5.0), "{maths:?}");
        // Brackets and matrices grow where the browser lays mathematics out.
        let [_, tall] = sizes(&mut page, "#eq-8 math")[0];
        assert!(tall > 150.0, "Eq. 8 is {tall} high");
        let window = f64::from(options.size[0]);
        let figures = sizes(&mut page, &format!("svg.{shown}"));
        assert!(figures.iter().all(|[width, height]| *width > 300.0 && *width <= window && *height > 150.0));
        assert!(sizes(&mut page, &format!("svg.{hidden}")).iter().all(|size| *size == [0.0, 0.0]));
        let [whole, visible] = widths(&mut page);
        assert!(whole <= visible && visible <= window, "{whole} of {visible}");
        assert_eq!(page.problems(), Vec::<String>::new());
    }
}

#[test]
fn it_follows_dark_and_light_and_can_be_read_in_both() {
    // WCAG's contrast of the text of each element with the ground of the page.
    const CONTRAST: &str = "(() => { \
        const light = (css) => { const [r, g, b] = css.match(/[\\d.]+/g).map(Number) \
            .map(v => v / 255).map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4); \
            return 0.2126 * r + 0.7152 * g + 0.0722 * b; }; \
        const ground = (e) => { const css = e ? getComputedStyle(e).backgroundColor : 'rgb(255, 255, 255)'; \
            return css === 'rgba(0, 0, 0, 0)' ? ground(e.parentElement) : css; }; \
        const all = [...document.querySelectorAll('p, a, h1, h2, h3, li, th, td, code, dt, dd, figcaption, math')]; \
        return Math.min(...all.filter(e => e.getClientRects().length).map(e => { \
            const [a, b] = [light(getComputedStyle(e).color), light(ground(e))]; \
            return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05); })); })()";
    for dark in [false, true] {
        let mut page = Page::read("theory.html", Options { dark, ..Options::default() });
        let ground = page.eval("getComputedStyle(document.body).backgroundColor");
        let bright = ground.as_str().is_some_and(|css| css.contains("255"));
        assert_eq!(bright, !dark, "{ground}");
        let contrast = page.eval(CONTRAST).as_f64().expect("a number");
        assert!(contrast >= 4.5, "{contrast} where dark is {dark}");
    }
}

#[test]
fn its_landmarks_and_names_are_there() {
    let mut page = Page::read("theory.html", Options::default());
    let count = |page: &mut Page, selector: &str| sizes(page, selector).len();
    for (selector, wanted) in [("html[lang=en]", 1), ("main", 1), ("nav[aria-label]", 1), ("h1", 1), ("header", 1)] {
        assert_eq!(count(&mut page, selector), wanted, "{selector}");
    }
    assert_eq!(count(&mut page, ".equation[aria-label]"), 24);
    assert_eq!(count(&mut page, "svg:not([role=img])"), 0);
    let untitled =
        page.eval("[...document.querySelectorAll('svg')].filter(e => !e.querySelector('title')?.textContent).length");
    assert_eq!(untitled, Value::from(0));
}

#[test]
fn a_figure_s_link_opens_the_state_it_names() {
    let mut page = Page::read("theory.html", Options::default());
    let address = page.eval("document.querySelector('a.open[href*=\"preset=disk-3&\"]').href");
    let address = address.as_str().expect("an address").to_owned();
    assert!(address.contains("/deep/path/#preset=disk-3"), "{address}");
    page.go(&address);
    page.wait("the state", |page| (page.number("time") == Some(5.61)).then_some(()));
    assert_eq!(page.eval("document.getElementById('notice').open"), false);
}

#[test]
fn a_symbol_of_the_page_opens_its_place_in_the_theory() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.eval("window.open = (address) => { window.opened = String(address); return null; }; 1");
    let name = "Theory: ξ2, threshold of the centrode deviation";
    page.click("Link", name);
    let address = page.wait("a tab", |page| page.eval("window.opened ?? null").as_str().map(str::to_owned));
    assert!(address.ends_with("/deep/path/theory.html#sym-xi2"), "{address}");
    assert_eq!(page.problems(), Vec::<String>::new());
    page.browse(&address);
    let [[width, height]] = sizes(&mut page, "tr:target")[..] else { panic!("no such row") };
    assert!(width > 300.0 && height > 15.0);
}
