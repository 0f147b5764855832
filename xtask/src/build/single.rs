//! The page as one file that opens from a disk or a mail: its parts are packed inside, and unpacked by the browser.

use super::index::{self, From, text};
use super::{Files, PROGRAM};
use crate::theory;
use anyhow::{Result, bail, ensure};
use base64::{Engine, engine::general_purpose::STANDARD};
use flate2::{Compression, write::GzEncoder};
use std::collections::BTreeMap;
use std::io::Write;

/// Its name in `dist/`.
pub const NAME: &str = "centrode.html";
/// It stays under this, bytes.
const LARGEST: usize = 4_000_000;
/// Unpacks the program and the modules, and starts the loader; or shows the theory.
const UNPACK: &str = include_str!("unpack.js");

/// Makes it of `index.html` as it stands in the repository, what is filled into that, the parts, and the theory.
pub fn page(html: &str, values: &[(&str, &str)], parts: &Files, theory: &str) -> Result<Vec<u8>> {
    let icon = format!("data:image/svg+xml;base64,{}", STANDARD.encode(text(parts, "icon.svg")?));
    let html = index::beside(html, From::Itself)?
        .replace("@BUILD@/icon.svg", &icon)
        .replace(&format!("href=\"{}\"", theory::NAME), "href=\"?theory\"");
    let program = &parts[PROGRAM];
    let modules = serde_json::to_vec(&ordered(parts)?)?;
    // Its links to the page lead back to this file, whatever it is called.
    let theory = theory.replace("href=\"./", "href=\"?");
    let mut inside = String::new();
    for (name, bytes) in [("program", program), ("modules", &modules), ("theory", &theory.into_bytes())] {
        inside += &format!("    <script type=\"application/gzip\" id=\"packed-{name}\">{}</script>\n", packed(bytes)?);
    }
    inside += &format!("    <script data-wasm-bytes=\"{}\">\n{UNPACK}    </script>\n", program.len());
    let html = index::fill(&html, values)?.replace("  </body>", &(inside + "  </body>"));
    let page = index::secured(&html, From::Itself)?;
    ensure!(page.len() < LARGEST, "{NAME} has {} bytes, and fewer than {LARGEST} are allowed", page.len());
    Ok(page.into_bytes())
}

fn packed(bytes: &[u8]) -> Result<String> {
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    packer.write_all(bytes)?;
    Ok(STANDARD.encode(packer.finish()?))
}

/// The modules with their names, each after those that it imports.
fn ordered(parts: &Files) -> Result<Vec<(&str, &str)>> {
    let mut left: BTreeMap<&str, &str> = BTreeMap::new();
    for name in parts.keys().filter(|name| name.ends_with(".js")) {
        ensure!(!name.contains('/'), "{name} lies in a folder, which a single file does not have");
        left.insert(name, text(parts, name)?);
    }
    let mut modules = Vec::new();
    while !left.is_empty() {
        let free = |(_, source): &(&&str, &&str)| !imports(source).any(|other| left.contains_key(other));
        let Some((&name, &source)) = left.iter().find(free) else {
            bail!("{} import each other", left.into_keys().collect::<Vec<_>>().join(", "));
        };
        left.remove(name);
        modules.push((name, source));
    }
    Ok(modules)
}

/// The modules that one imports.
fn imports(source: &str) -> impl Iterator<Item = &str> {
    source.split("\"./").skip(1).filter_map(|rest| rest.split('"').next()).filter(|name| name.ends_with(".js"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(a: &str) -> Files {
        [
            ("a.js", a),
            ("b.js", "import { c } from \"./c.js\";"),
            ("c.js", "1"),
            ("icon.svg", "<svg/>"),
            (PROGRAM, "wasm"),
        ]
        .into_iter()
        .map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()))
        .collect()
    }

    #[test]
    fn a_module_comes_after_those_that_it_imports() {
        let known = parts("await import(\"./b.js\")");
        let names: Vec<&str> = ordered(&known).unwrap().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["c.js", "b.js", "a.js"]);
        let round = parts("import \"./a.js\"");
        assert!(ordered(&round).unwrap_err().to_string().contains("a.js"));
        let folder = Files::from([("snippets/a.js".into(), Vec::new())]);
        assert!(ordered(&folder).unwrap_err().to_string().contains("snippets/a.js"));
    }

    #[test]
    fn the_file_needs_nothing_beside_it() {
        let html = std::fs::read_to_string(crate::run::root().join("index.html")).unwrap();
        let values = [("STYLE", ""), ("POSTER", ""), ("WASM_BYTES", "4"), ("BUILD", "build")];
        let page = page(&html, &values, &parts("1"), "<a href=\"./#seed=3\">").unwrap();
        let page = String::from_utf8(page).unwrap();
        for beside in ["build/", "src=", "href=\"theory", "manifest.webmanifest", "preload"] {
            assert!(!page.contains(beside), "{beside}");
        }
        assert!(page.contains("href=\"?theory\"") && page.contains("id=\"packed-program\""));
    }
}
