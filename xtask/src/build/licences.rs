//! `licences.html`: whose work the page is made of, with the text of each licence. A document of its own, which the page's help opens.

use super::index;
use super::linked::Part;
use crate::licence::{self, Expression};
use crate::metadata::Package;
use crate::run::root;
use anyhow::{Context, Result, bail, ensure};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// Its name in the page.
pub const NAME: &str = "licences.html";
/// It is no larger, bytes.
const LARGEST: usize = 500_000;

/// The fonts: name, and the file with their licence.
const FONTS: [(&str, &str); 2] = [
    ("Inter 4.0, the page's typeface", "assets/fonts/OFL.txt"),
    ("STIX Two Math 2.12, in the theory", "theory/font/OFL.txt"),
];

/// Words in the name of a file that hold a licence, and words of its text.
const TEXTS: [(&str, &str, &str); 8] = [
    ("MIT", "MIT", "Permission is hereby granted, free of charge"),
    ("Apache-2.0", "APACHE", "Apache License"),
    ("Apache-2.0 WITH LLVM-exception", "APACHE", "LLVM"),
    ("Zlib", "ZLIB", "provided 'as-is'"),
    ("BSD-3-Clause", "BSD", "Redistribution and use"),
    ("BSD-2-Clause", "BSD", "Redistribution and use"),
    ("ISC", "ISC", "Permission to use, copy, modify"),
    ("Unicode-3.0", "UNICODE", "UNICODE LICENSE V3"),
];

/// A licence's text, and who gives what by it.
type Given = BTreeMap<(String, String), BTreeSet<String>>;

/// The document.
pub fn page(parts: &[Part]) -> Result<String> {
    let allowed = licence::allowed()?;
    let mut given = Given::new();
    let others = parts.iter().filter(|part| part.is_linked && !part.package.is_ours());
    let others: Vec<&Package> = others.map(|part| &part.package).collect();
    for package in &others {
        let stated = package.licence.as_deref().with_context(|| format!("{} states no licence", package.name))?;
        let taken = Expression::read(stated)?.taken(&allowed);
        for name in taken.with_context(|| format!("{}: {stated} is not allowed", package.name))? {
            let text = text(package, &name).with_context(|| format!("the licence {name} of {}", package.name))?;
            given.entry((name, text)).or_default().insert(format!("{} {}", package.name, package.version));
        }
    }
    let apache = fs::read_to_string(root().join("LICENSE-APACHE"))?;
    given.entry(("Apache-2.0".into(), tidy(&apache))).or_default().insert("The standard library of Rust".into());
    for (font, file) in FONTS {
        let text = fs::read_to_string(root().join(file)).with_context(|| file.to_owned())?;
        given.entry(("OFL-1.1".into(), tidy(&text))).or_default().insert(font.into());
    }
    let page = index::dressed(&html(&given, others.len()))?;
    check(&page)?;
    Ok(page)
}

/// The text of one of a package's licences, as it brings it. One that brings none has the usual text, with its authors.
fn text(package: &Package, licence: &str) -> Result<String> {
    let (_, word, phrase) = TEXTS.iter().find(|(name, ..)| *name == licence).context("its text is not known")?;
    let mut files: Vec<String> = Vec::new();
    for entry in fs::read_dir(&package.folder).with_context(|| package.folder.display().to_string())? {
        files.push(entry?.file_name().to_string_lossy().into_owned());
    }
    files.sort();
    let upper = |name: &String| name.to_uppercase();
    let is_licence =
        |name: &&String| ["LICEN", "COPYING", "UNLICEN"].iter().any(|begins| upper(name).starts_with(begins));
    // The file that is called so comes before one that may hold several.
    let (so, other): (Vec<&String>, Vec<&String>) =
        files.iter().filter(is_licence).partition(|name| upper(name).contains(word));
    for name in so.into_iter().chain(other) {
        let text = fs::read_to_string(package.folder.join(name)).unwrap_or_default();
        if text.contains(phrase) {
            return Ok(with_notice(package, &files, licence, tidy(&text)));
        }
    }
    usual(package, licence)
}

/// Apache's licence asks for a notice to be handed on.
fn with_notice(package: &Package, files: &[String], licence: &str, text: String) -> String {
    let notice = files.iter().find(|name| licence.starts_with("Apache") && name.to_uppercase().starts_with("NOTICE"));
    let notice = notice.and_then(|name| fs::read_to_string(package.folder.join(name)).ok());
    notice.map_or(text.clone(), |notice| format!("{}\n\n{text}", tidy(&notice)))
}

fn usual(package: &Package, licence: &str) -> Result<String> {
    match licence {
        "Apache-2.0" => Ok(tidy(&fs::read_to_string(root().join("LICENSE-APACHE"))?)),
        "MIT" => {
            let ours = fs::read_to_string(root().join("LICENSE-MIT"))?;
            let (_, permission) = ours.split_once("Permission is hereby").context("our own licence")?;
            let authors: Vec<&str> = package.authors.iter().map(|author| name(author)).collect();
            let authors =
                if authors.is_empty() { format!("the authors of {}", package.name) } else { authors.join(", ") };
            Ok(tidy(&format!("MIT License\n\nCopyright (c) {authors}\n\nPermission is hereby{permission}")))
        }
        _ => bail!("the package brings no text of it"),
    }
}

/// Without the address.
fn name(author: &str) -> &str {
    author.split('<').next().unwrap_or_default().trim()
}

/// Without spaces at the ends of lines, and with one kind of line end.
fn tidy(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    lines.join("\n").trim_matches('\n').to_owned()
}

const STYLE: &str = "
  :root { color-scheme: light dark; --ground: #fff; --ink: #16202a; --line: #d5dce2; --accent: #00609a; }
  @media (prefers-color-scheme: dark) { :root { --ground: #14181d; --ink: #e6ebf0; --line: #34404b; --accent: #6cbcf0; } }
  body { max-width: 46rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; background: var(--ground); color: var(--ink); font: 1rem/1.55 system-ui, sans-serif; }
  a { color: var(--accent); }
  details { border-top: 1px solid var(--line); padding: 0.4rem 0; }
  summary { cursor: pointer; overflow-wrap: anywhere; }
  pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: 0.85rem; }
";

fn html(given: &Given, packages: usize) -> String {
    let mut body = String::new();
    let mut last = "";
    for ((licence, text), names) in given {
        if licence != last {
            body += &format!("<h2>{}</h2>\n", escaped(licence));
            last = licence;
        }
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        body += &format!(
            "<details><summary>{}</summary>\n<pre>{}</pre></details>\n",
            escaped(&names.join(", ")),
            escaped(text)
        );
    }
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"@POLICY@\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Licences · Centrode</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>Whose work Centrode is made of</h1>\n\
         <p>The program of the page holds {packages} packages by others, and two typefaces. Where a package may be used by one of several licences, \
         the one that is taken stands here. Centrode itself is under MIT or Apache-2.0, as you like. <a href=\"./\">Back to the page</a></p>\n\
         {body}</main>\n</body>\n</html>\n"
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Checks that it is small, and needs no script and nothing from elsewhere.
fn check(html: &str) -> Result<()> {
    ensure!(html.len() <= LARGEST, "{NAME} has {} bytes, and at most {LARGEST} are allowed", html.len());
    for word in ["<script", "<link", " src=", "=\"http", "url("] {
        ensure!(!html.contains(word), "{NAME} has {word:?}: it needs no script and nothing from elsewhere");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::linked::parts;
    use super::*;

    #[test]
    fn every_package_of_the_page_stands_there_with_a_text() {
        let parts = parts().unwrap();
        let html = page(&parts).unwrap();
        assert_eq!(html, page(&parts).unwrap());
        for part in parts.iter().filter(|part| !part.package.is_ours()) {
            let name = format!("{} {}", part.package.name, part.package.version);
            let stands = [">", " "]
                .iter()
                .any(|before| [",", "<"].iter().any(|after| html.contains(&format!("{before}{name}{after}"))));
            assert_eq!(stands, part.is_linked, "{name}");
        }
        for word in [
            "Permission is hereby granted",
            "Apache License",
            "SIL OPEN FONT LICENSE",
            "Emil Ernerfeldt",
            "The Inter Project Authors",
        ] {
            assert!(html.contains(word), "{word}");
        }
        assert!(html.contains("default-src 'none'; style-src 'sha256-") && !html.contains("@POLICY@"));
    }

    #[test]
    fn what_is_written_in_a_licence_stays_text() {
        let given = Given::from([(("MIT".into(), "a <b> & c".into()), BTreeSet::from(["x 1".into()]))]);
        assert!(html(&given, 1).contains("<pre>a &lt;b&gt; &amp; c</pre>"));
        assert!(check("<script>").is_err() && check(&"a".repeat(LARGEST + 1)).is_err());
    }
}
