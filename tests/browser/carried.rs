//! The page carried anywhere: without a network, as a single file, and fenced in by its policy.

use crate::harness::host::{Host, build_of, built, dist, rebuilt};
use crate::harness::{Area, Options, Page, Renderer};

/// Waits until the page runs, and gives the build that it runs.
#[track_caller]
fn running(page: &mut Page) -> String {
    page.wait("the page to run", |page| match page.shown().as_str() {
        "running" => Some(()),
        "loading" => None,
        other => panic!("the page shows {other:?}: {}", page.text(&format!("#{other}"))),
    });
    let loader = page.eval("document.querySelector('script[data-wasm-bytes]').getAttribute('src')");
    loader.as_str().and_then(|source| source.split('/').next()).expect("a build").to_owned()
}

#[test]
fn without_a_network_the_last_build_runs_and_with_one_the_hosts() {
    let first = built();
    let (one, two) = (build_of(&first), "build-00000000000000b2");
    let host = Host::of(first.clone());
    let mut page = Page::blank(Renderer::WebGl, Options::default());
    page.go(&format!("{}?test", host.address));
    assert_eq!(running(&mut page), one);
    page.eval("navigator.serviceWorker.ready.then(() => 1)");

    host.set(None);
    // Another fragment alone would load nothing.
    page.browse("about:blank");
    page.go(&format!("{}?test#contact.disk=1", host.address));
    assert_eq!(running(&mut page), one);
    assert_eq!(page.widget("Slider", "Contact disk").number, Some(1.0));
    assert_eq!(page.eval("fetch('theory.html').then(r => r.status)"), 200);

    // The host has a new build: it is shown at once, and kept.
    host.set(Some(rebuilt(&first, two)));
    page.go(&format!("{}?test", host.address));
    assert_eq!(running(&mut page), two);
    page.wait("the new build to be kept", |page| {
        let kept = page.eval(&format!("caches.open('centrode {two}').then(c => c.keys()).then(k => k.length)"));
        let active = page.eval(
            "navigator.serviceWorker.getRegistration().then(r => Boolean(r.active) && !r.installing && !r.waiting)",
        );
        (kept.as_u64().is_some_and(|kept| kept > 10) && active == true).then_some(())
    });
    host.set(None);
    page.go(&format!("{}?test", host.address));
    assert_eq!(running(&mut page), two);
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn each_part_is_asked_for_once() {
    let host = Host::of(built());
    let mut page = Page::blank(Renderer::WebGl, Options::default());
    page.go(&format!("{}?test", host.address));
    running(&mut page);
    for part in ["index.html", "centrode_bg.wasm", "/centrode.js", "loader.js"] {
        assert_eq!(host.asked(part), 1, "{part}");
    }
}

#[test]
fn a_single_file_opens_from_a_disk() {
    let file = dist().join("centrode.html");
    let address = format!("file://{}", file.display());
    let mut page = Page::blank(Renderer::WebGl, Options::default());
    page.go(&format!("{address}?test#preset=disk-3&view=tuning&repeats=3"));
    page.wait("the page to run", |page| match page.shown().as_str() {
        "running" => Some(()),
        "loading" => None,
        other => panic!("the page shows {other:?}: {}", page.text(&format!("#{other}"))),
    });
    // Its worker comes out of the file, too.
    page.wait("a study by the worker", |page| {
        let study: serde_json::Value = serde_json::from_str(&page.data("tuning")?).ok()?;
        (study["done"] == study["of"]).then(|| assert_eq!(study["helper"], true, "{study}"))
    });
    page.click("Tab", "Robot");
    page.frames();
    assert!(page.picture().colours(Area(0.3, 0.2, 0.7, 0.6)) > 8, "the middle of the page is blank");
    assert_eq!(page.problems(), Vec::<String>::new());

    page.browse(&format!("{address}?theory#eq-19"));
    page.wait("the theory", |page| (page.eval("document.querySelectorAll('math').length > 150") == true).then_some(()));
    assert_eq!(
        page.eval("document.fonts.ready.then(fonts => [...fonts].some(font => font.status === 'loaded'))"),
        true
    );
    page.wait("the equation of the address", |page| {
        let seen = page.eval("document.getElementById('eq-19').getBoundingClientRect().top");
        seen.as_f64().is_some_and(|top| (-1.0..800.0).contains(&top)).then_some(())
    });
    let links = page.eval("[...document.querySelectorAll('a')].map(a => a.href).filter(h => h.includes('#preset='))");
    let links: Vec<String> = serde_json::from_value(links).expect("links");
    assert!(links.len() > 5 && links.iter().all(|link| link.starts_with(&format!("{address}?#"))), "{links:?}");

    page.browse(&format!("{address}?licences"));
    page.wait("the licences", |page| {
        (page.eval("document.querySelectorAll('details pre').length > 50") == true).then_some(())
    });
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn the_policy_lets_nothing_foreign_run_or_be_fetched() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    let ran = page.eval(
        "(() => { const script = document.createElement('script'); script.textContent = 'globalThis.foreign = 1'; \
         document.body.append(script); return typeof foreign; })()",
    );
    assert_eq!(ran, "undefined");
    let fetched = page.eval("fetch('http://127.0.0.1:9/').then(() => 'fetched', () => 'refused')");
    assert_eq!(fetched, "refused");
    let problems = page.problems();
    assert!(
        problems.len() >= 2 && problems.iter().all(|said| said.contains("Content Security Policy")),
        "{problems:?}"
    );
}
