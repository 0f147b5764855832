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
    let equations = count(&mut page, ".equation");
    assert!(equations > 30, "{equations}");
    assert_eq!(count(&mut page, ".equation[aria-label]"), equations);
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

#[test]
fn a_symbol_of_a_legend_is_named_under_the_pointer_and_leads_to_its_row() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.eval("window.open = (address) => { window.opened = String(address); return null; }; 1");
    let symbol = "centrode that the model expects without contact";
    let [x, y] = page.widget("Link", &format!("Theory: cm, {symbol}")).at(0.5);
    let [left, top, width, height] = page.widget("Canvas", "3D view").bounds.expect("in sight");
    assert!((left..left + width).contains(&x) && (top + 0.5 * height..top + height).contains(&y), "not in the legend");
    let named = |page: &mut Page| page.widgets().iter().any(|widget| widget.value == format!("cm: {symbol} (m)"));
    assert!(!named(&mut page));
    page.mouse("mouseMoved", [x, y]);
    page.wait("its name", |page| named(page).then_some(()));
    page.click("Link", &format!("Theory: cm, {symbol}"));
    let address = page.wait("a tab", |page| page.eval("window.opened ?? null").as_str().map(str::to_owned));
    assert!(address.ends_with("/deep/path/theory.html#sym-c-m"), "{address}");
    assert_eq!(page.problems(), Vec::<String>::new());
    page.browse(&address);
    assert_eq!(sizes(&mut page, "tr#sym-c-m:target").len(), 1);
}

#[test]
fn a_reader_hears_of_each_symbol_once_behind_everything_else() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.element("link", "Theory: ξ2, threshold of the centrode deviation");
    let links = "[...document.querySelectorAll('[data-kind=link]')].filter(e => e.textContent.startsWith('Theory: '))";
    let count = page.eval(&format!("{links}.length")).as_u64().expect("a number");
    assert!((9..30).contains(&count), "{count}");
    assert_eq!(page.eval(&format!("new Set({links}.map(e => e.textContent)).size")), count);
    let regions =
        format!("[...new Set({links}.map(e => e.closest('section').querySelector('h2').textContent))].join()");
    assert_eq!(page.eval(&regions), "Symbols");
    let last = "[...document.querySelectorAll('section > h2')].at(-1).textContent";
    assert_eq!(page.eval(last), "Symbols");
}

#[test]
fn a_tap_names_a_symbol_and_its_note_leads_to_the_theory() {
    let options = Options { size: [390, 844], phone: true, still: true, ..Options::default() };
    let mut page = Page::open(Renderer::WebGl, "?test#preset=bench&t=6.4", options);
    page.eval("window.open = (address) => { window.opened = String(address); return null; }; 1");
    let at = page.widget("RadioButton", "Plots").at(0.5);
    page.tap(at);
    let name = "threshold of the centrode deviation";
    let symbol = page.widget("Link", &format!("Theory: ξ2, {name}")).at(0.5);
    page.tap(symbol);
    page.wait("its name", |page| {
        page.widgets().iter().any(|widget| widget.value.starts_with(&format!("ξ2: {name}"))).then_some(())
    });
    assert_eq!(page.eval("window.opened ?? ''"), "", "a finger is told first");
    let on = page.widget("Button", "Its place in the theory");
    let [_, _, width, height] = on.bounds.expect("in sight");
    assert!(width.min(height) >= 43.9, "{width} × {height}");
    page.tap(on.at(0.5));
    let address = page.wait("a tab", |page| page.eval("window.opened ?? null").as_str().map(str::to_owned));
    assert!(address.ends_with("/deep/path/theory.html#sym-xi2"), "{address}");
    assert_eq!(page.problems(), Vec::<String>::new());
}
