//! axe-core finds nothing wrong for assistive technology: on the page, with each view, and in the theory.

use crate::harness::{Options, Page, Renderer};

/// What axe-core finds, a line for each element.
#[track_caller]
fn found(page: &mut Page) -> Vec<String> {
    let path =
        std::env::var("CENTRODE_AXE").expect("CENTRODE_AXE names no script: `cargo xtask test browser` brings it");
    let script = std::fs::read_to_string(path).expect("the script of axe-core");
    page.eval(&format!("{script}; 1"));
    let lines = page.eval(
        // It takes a header that is a formula for an empty one: it does not read MathML.
        "axe.run(document, { rules: { 'empty-table-header': { enabled: false } } }).then(({ violations }) => violations.flatMap(({ id, help, nodes }) => \
         nodes.map(({ html, failureSummary }) => `${id} (${help}): ${html} ${failureSummary}`)))",
    );
    serde_json::from_value(lines).expect("a list of lines")
}

#[test]
fn axe_finds_nothing_in_any_view() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    let mut all = Vec::new();
    for view in ["Robot", "Paper", "Map", "Tuning"] {
        let tab = page.element("tab", view);
        page.eval(&format!("{tab}.click()"));
        page.wait(view, |page| (page.eval(&format!("{tab}.ariaSelected")) == "true").then_some(()));
        all.extend(found(&mut page).into_iter().map(|line| format!("{view}: {line}")));
    }
    for (kind, opener, inside) in
        [("opener", "Preset: Bench", "choice"), ("button", "Share", "item"), ("button", "Help", "dialog")]
    {
        let button = page.element(kind, opener);
        page.eval(&format!("{button}.focus(); {button}.click()"));
        page.wait(inside, |page| {
            (page.eval(&format!("document.querySelector('[data-kind={inside}]') !== null")) == true).then_some(())
        });
        all.extend(found(&mut page).into_iter().map(|line| format!("{opener}: {line}")));
        page.key("Escape");
    }
    assert_eq!(all, Vec::<String>::new());
}

#[test]
fn axe_finds_nothing_on_a_phone() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options { dark: true, ..Options::phone() });
    assert_eq!(found(&mut page), Vec::<String>::new());
}

#[test]
fn axe_finds_nothing_in_the_documents() {
    for (document, dark) in
        [("theory.html", false), ("theory.html", true), ("licences.html", false), ("licences.html", true)]
    {
        let mut page = Page::read(document, Options { dark, ..Options::default() });
        assert_eq!(found(&mut page), Vec::<String>::new(), "{document}");
        assert_eq!(page.problems(), Vec::<String>::new(), "{document}");
    }
}

#[test]
fn axe_finds_nothing_where_there_is_no_gpu() {
    let mut page = Page::visit(Renderer::Neither, "?test", Options::default());
    page.wait("the page to say so", |page| (page.shown() == "no-gpu").then_some(()));
    assert_eq!(found(&mut page), Vec::<String>::new());
}
