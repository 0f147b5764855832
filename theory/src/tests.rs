//! The page as a whole.

use crate::facts::{Facts, facts};
use crate::figures::NAMES;
use crate::page::{CHAPTERS, page};
use crate::states::{STATES, find};
use centrode_core::scenario::link::Link;
use centrode_core::symbols::SYMBOLS;
use std::sync::LazyLock;

/// The page, made once.
static PAGE: LazyLock<(Facts, String)> = LazyLock::new(|| {
    let facts = facts().expect("numbers");
    let page = page(&facts).expect("a page");
    (facts, page)
});

/// What stands between `before` and the next `"`, everywhere.
fn attributes<'a>(text: &'a str, before: &'a str) -> Vec<&'a str> {
    text.split(before).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn every_equation_and_every_symbol_has_an_anchor() {
    let ids = attributes(&PAGE.1, " id=\"");
    for number in 2..=24 {
        assert!(ids.contains(&format!("eq-{number}").as_str()), "Eq. {number}");
    }
    for symbol in SYMBOLS {
        assert!(ids.contains(&symbol.anchor().as_str()), "{}", symbol.id);
    }
    for name in NAMES {
        assert!(ids.contains(&format!("fig-{name}").as_str()), "figure {name}");
    }
    let mut once = ids.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), ids.len(), "an anchor is there twice");
}

#[test]
fn links_within_the_page_lead_somewhere() {
    let ids = attributes(&PAGE.1, " id=\"");
    let links = attributes(&PAGE.1, "href=\"#");
    assert!(links.len() > 60);
    for link in links {
        assert!(ids.contains(&link), "#{link}");
    }
}

#[test]
fn links_into_centrode_open_the_state_they_name() {
    let links: Vec<String> = attributes(&PAGE.1, "href=\"./#").iter().map(|link| link.replace("&amp;", "&")).collect();
    assert!(links.len() >= NAMES.len());
    for state in STATES {
        let named = state.link().expect(state.name);
        let address = state.address().expect(state.name);
        let fragment = address.strip_prefix("./#").expect("a link");
        assert!(links.iter().any(|link| link == fragment), "nothing opens {}", state.name);
        let (read, broken) = Link::read(fragment);
        assert!(broken.is_empty(), "{}: {broken:?}", state.name);
        assert_eq!(read, named, "{}", state.name);
    }
    assert!(links.iter().all(|link| STATES.iter().any(|state| state.address().is_ok_and(|a| a[3..] == **link))));
    assert!(find("nothing").is_err());
}

#[test]
fn numbers_and_figures_are_all_used() {
    let texts: String = CHAPTERS.iter().map(|(.., text)| *text).collect();
    for name in PAGE.0.names() {
        assert!(texts.contains(&format!("{{{{fact {name}}}}}")), "{name} is computed for nothing");
    }
    for name in NAMES {
        assert!(texts.contains(&format!("{{{{fig {name} |")), "{name}");
    }
}

#[test]
fn the_page_needs_no_script_and_nothing_from_elsewhere() {
    let page = &PAGE.1;
    for word in ["<script", "javascript:", "src=", "@import", "onclick", "{{", "@STYLE@", "NaN"] {
        assert!(!page.contains(word), "{word}");
    }
    let addresses = attributes(page, "href=\"");
    assert!(
        addresses.iter().all(|address| address.starts_with(['#', '.']) || address.starts_with("data:image/svg+xml;")),
        "{addresses:?}"
    );
    assert!(page.matches("url(").all(|_| true) && page.matches("url(data:").count() == page.matches("url(").count());
    assert!(page.starts_with("<!doctype html>\n<html lang=\"en\">") && page.matches("<h1").count() == 1);
    let drawings = page.matches("<svg ").count();
    assert_eq!(drawings, 2 * NAMES.len());
    assert_eq!(page.matches("role=\"img\"").count(), drawings);
    assert!(page.matches("<title>").count() > drawings);
}
