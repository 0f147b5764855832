//! What is filled into `index.html`, and what the page may load.

use super::Files;
use anyhow::{Context, Result, bail};
use base64::{Engine, engine::general_purpose::STANDARD};
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// Where scripts and workers come from besides those inside the page.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum From {
    /// Beside the page.
    Host,
    /// Out of the page itself, which is a single file.
    Itself,
}

const POLICY: &str = "POLICY";

/// Puts each value in the place of its `@NAME@`, and leaves none behind but the policy's, which comes last.
pub fn fill(text: &str, values: &[(&str, &str)]) -> Result<String> {
    let mut filled = text.to_owned();
    for (name, value) in values {
        filled = filled.replace(&format!("@{name}@"), value);
    }
    let mut words = filled.split('@').skip(1).peekable();
    while let Some(word) = words.next() {
        if is_name(word) && word != POLICY && words.peek().is_some() {
            bail!("@{word}@ is not filled in");
        }
    }
    Ok(filled)
}

/// What stands between these comments is there where the page has files beside it.
const BESIDE: [&str; 2] = ["    <!-- beside -->\n", "    <!-- /beside -->\n"];

/// The page without the marks of what needs files beside it, and without that itself where there are none.
pub fn beside(html: &str, from: From) -> Result<String> {
    let mut parts = html.split(BESIDE[0]);
    let mut kept = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (inside, after) = part.split_once(BESIDE[1]).context("a part for files beside the page does not end")?;
        if from == From::Host {
            kept += inside;
        }
        kept += after;
    }
    Ok(kept)
}

fn is_name(word: &str) -> bool {
    word.len() > 2 && word.bytes().all(|byte| byte.is_ascii_uppercase() || byte == b'_')
}

/// The page with its policy: only what stands in it now may run in it or dress it.
pub fn secured(html: &str, from: From) -> Result<String> {
    let scripts = hashes(html, "script")?;
    let styles = hashes(html, "style")?;
    let (script, style, worker, connect, font) = match from {
        From::Host => ("'self'", styles.trim_start(), "'self'", "'self'", ""),
        // It shows the theory in its own place, which brings a font, and whose equations are dressed one by one.
        From::Itself => ("blob:", "'unsafe-inline'", "blob:", "blob:", " font-src data:;"),
    };
    let policy = format!(
        "default-src 'none'; script-src {script} 'wasm-unsafe-eval'{scripts}; style-src {style}; img-src 'self' data: blob:; \
         connect-src {connect};{font} worker-src {worker}; manifest-src 'self'; base-uri 'none'; form-action 'none'"
    );
    Ok(html.replace("@POLICY@", &policy))
}

/// A document with its policy: its own styles and nothing else.
pub fn dressed(html: &str) -> Result<String> {
    let styles = hashes(html, "style")?;
    let policy = format!("default-src 'none'; style-src{styles}; base-uri 'none'; form-action 'none'");
    Ok(html.replace("@POLICY@", &policy))
}

/// The hashes of what stands between the tags of an element, where it is to be run or applied.
fn hashes(html: &str, element: &str) -> Result<String> {
    let mut list = String::new();
    for rest in html.split(&format!("<{element}")).skip(1) {
        let (attributes, rest) = rest.split_once('>').with_context(|| format!("<{element} does not end"))?;
        let (inside, _) =
            rest.split_once(&format!("</{element}>")).with_context(|| format!("<{element}> stays open"))?;
        let data = attributes.contains("type=\"application/");
        if !inside.is_empty() && !data {
            write!(list, " 'sha256-{}'", STANDARD.encode(Sha256::digest(inside)))?;
        }
    }
    Ok(list)
}

/// Files as text.
pub fn text<'a>(files: &'a Files, name: &str) -> Result<&'a str> {
    let bytes = files.get(name).with_context(|| format!("there is no {name}"))?;
    std::str::from_utf8(bytes).with_context(|| format!("{name} is no text"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_stands_in_the_page_may_run() {
        let html = "<meta content=\"@POLICY@\"><style>a{}</style><script>1</script><script src=\"x\"></script>\
                    <script type=\"application/json\">[]</script>";
        let page = secured(html, From::Host).unwrap();
        // printf 1 | openssl dgst -sha256 -binary | base64
        assert!(page.contains("'sha256-a4ayc/80/OGda4BO/1o/V0etpOqiLx1JwB5S3beHW0s='"), "{page}");
        assert_eq!(page.matches("sha256-").count(), 2);
        assert!(page.contains("script-src 'self' 'wasm-unsafe-eval' 'sha256-"));
        assert!(!page.contains("unsafe-inline") && !page.contains("@POLICY@"));
    }

    #[test]
    fn a_single_file_has_nothing_beside_it() {
        let html = "a\n    <!-- beside -->\n    b\n    <!-- /beside -->\nc\n";
        assert_eq!(beside(html, From::Host).unwrap(), "a\n    b\nc\n");
        assert_eq!(beside(html, From::Itself).unwrap(), "a\nc\n");
        assert!(beside("    <!-- beside -->\nb", From::Host).is_err());
    }

    #[test]
    fn nothing_stays_to_be_filled_in() {
        assert_eq!(fill("a @B@ c", &[("B", "x")]).unwrap(), "a x c");
        assert!(fill("a @B@ @NAME@", &[("B", "x")]).unwrap_err().to_string().contains("@NAME@"));
        assert!(fill("you@example.org and me@example.org", &[]).is_ok());
    }
}
