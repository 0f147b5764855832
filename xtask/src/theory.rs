//! The theory beside the page: made by a package of its own, so that neither page nor command carries it.

use crate::run::{cargo, run, target};
use anyhow::{Context, Result, ensure};
use std::fs;

/// Its name in the page.
pub const NAME: &str = "theory.html";
/// It is no larger, bytes: a page with sixteen drawings and a font.
const LARGEST: usize = 1_000_000;

/// What begins its policy.
const POLICY: &str = "<meta http-equiv=\"Content-Security-Policy\" content=\"";

/// What is made of it.
pub struct Made {
    /// The theory.
    pub html: String,
    /// The picture that the page shows while the program loads, an SVG.
    pub poster: String,
}

/// Makes it.
pub fn make() -> Result<Made> {
    let paths = [NAME, "poster.svg"].map(|name| target().join(name));
    run(cargo().args(["run", "--quiet", "--package", "centrode-theory", "--"]).args(&paths))?;
    let [html, poster] =
        paths.map(|path| fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display())));
    Ok(Made { html: html?, poster: poster? })
}

/// Checks that it is whole and small, and needs no script and nothing from elsewhere.
pub fn check(html: &str) -> Result<()> {
    ensure!(html.starts_with("<!doctype html>") && html.trim_end().ends_with("</html>"), "{NAME} is not whole");
    ensure!(html.len() <= LARGEST, "{NAME} has {} bytes, and at most {LARGEST} are allowed", html.len());
    ensure!(html.contains("<math") && html.contains("<svg"), "{NAME} has no equations or no figures");
    let policy = html.split_once(POLICY).and_then(|(_, rest)| rest.split_once('"')).map(|(policy, _)| policy);
    let strict = policy.is_some_and(|policy| policy.starts_with("default-src 'none';") && !policy.contains("script"));
    ensure!(strict, "{NAME} has no policy that forbids scripts");
    for word in ["<script", "<link rel=\"stylesheet\"", " src=", "=\"http", "url(http"] {
        ensure!(!html.contains(word), "{NAME} has {word:?}: it needs no script and nothing from elsewhere");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{POLICY, check};

    #[test]
    fn what_needs_a_script_or_another_place_is_refused() {
        let head = format!("<!doctype html>\n<html>{POLICY}default-src 'none'; img-src data:\">");
        let page = |inside: &str| format!("{head}<math></math><svg></svg>{inside}</html>\n");
        assert!(check(&page("")).is_ok());
        for inside in ["<script>1</script>", "<img src=\"a.png\">", "<a href=\"https://example.org\">a</a>"] {
            assert!(check(&page(inside)).is_err(), "{inside}");
        }
        assert!(check(&page(&"a".repeat(1_000_000))).is_err());
        for policy in ["default-src 'none'; script-src 'self'\">", "img-src data:\">", ""] {
            let other = page("").replace("default-src 'none'; img-src data:\">", policy);
            assert!(check(&other).unwrap_err().to_string().contains("policy"), "{policy}");
        }
        assert!(check(&page("").replace("</html>", "")).is_err());
        assert!(check("<!doctype html><html></html>").is_err());
    }
}
