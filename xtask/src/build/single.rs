//! The page as one file that opens from a disk or a mail: its parts are packed inside, and unpacked by the browser.

use super::index::{self, From, text};
use super::{Beside, Files, PROGRAM};
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

/// Makes it of `index.html` as it stands in the repository, what is filled into that, the parts, and the documents beside it.
pub(super) fn page(html: &str, values: &[(&str, &str)], parts: &Files, beside: &Beside) -> Result<Vec<u8>> {
    let icon = format!("data:image/svg+xml;base64,{}", STANDARD.encode(text(parts, "icon.svg")?));
    let html = index::beside(html, From::Itself)?
        .replace("@BUILD@/icon.svg", &icon)
        .replace(&format!("href=\"{}\"", theory::NAME), "href=\"?theory\"");
    let program = &parts[PROGRAM];
    let modules = serde_json::to_vec(&ordered(parts)?)?;
    // Its links to the page lead back to this file, whatever it is called.
    let documents =
        [&beside.theory.html, &beside.licences].map(|html| html.replace("href=\"./", "href=\"?").into_bytes());
    let [theory, licences] = &documents;
    let mut inside = String::new();
    for (name, bytes) in [("program", program), ("modules", &modules), ("theory", theory), ("licences", licences)] {
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
    Ok(characters(&packer.finish()?))
}

/// Bytes as text of a script element, seven bits a character. What a parser of HTML, or whatever carries texts, would change is replaced by a
/// letter whose last seven bits are the same. As base64 it
/// would be longer by an eighth.
fn characters(bytes: &[u8]) -> String {
    let (mut text, mut held, mut bits) = (String::with_capacity(bytes.len() * 6 / 5), 0u32, 0);
    let letter = |seven: u32| match seven & 0x7f {
        changed @ (0 | 0x0a | 0x0d | 0x3c) => char::from_u32(changed | 0x180).unwrap_or_default(),
        kept => char::from(kept as u8),
    };
    for byte in bytes {
        held = held << 8 | u32::from(*byte);
        bits += 8;
        while bits >= 7 {
            bits -= 7;
            text.push(letter(held >> bits));
        }
    }
    if bits > 0 {
        text.push(letter(held << (7 - bits)));
    }
    text
}

/// The modules with their names, each after those that it imports.
fn ordered(parts: &Files) -> Result<Vec<(&str, &str)>> {
    let mut left: BTreeMap<&str, &str> = BTreeMap::new();
    for name in parts.keys().filter(|name| name.ends_with(".js")) {
        ensure!(!name.contains('/'), "{name} lies in a folder, which a single file does not have");
        left.insert(name, text(parts, name)?);
    }
    let mut modules = Vec::new();
    for (name, source) in &left {
        for other in imports(source) {
            ensure!(left.contains_key(other), "{name} imports {other}, which is not there");
        }
    }
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

/// The modules that one imports, as `unpack.js` finds them: a name elsewhere is none.
fn imports(source: &str) -> impl Iterator<Item = &str> {
    source.match_indices("\"./").filter_map(|(at, quote)| {
        let before = source[..at].trim_end().trim_end_matches('(').trim_end();
        let name = source[at + quote.len()..].split('"').next()?;
        (name.ends_with(".js") && (before.ends_with("from") || before.ends_with("import"))).then_some(name)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(a: &str) -> Files {
        [
            ("a.js", a),
            ("b.js", "import { c } from \"./c.js\"; const named = { \"./d.js\": c };"),
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
        let lonely = parts("import \"./d.js\"");
        assert_eq!(ordered(&lonely).unwrap_err().to_string(), "a.js imports d.js, which is not there");
        let folder = Files::from([("snippets/a.js".into(), Vec::new())]);
        assert!(ordered(&folder).unwrap_err().to_string().contains("snippets/a.js"));
    }

    #[test]
    fn seven_bits_a_character_and_nothing_that_a_parser_changes() {
        assert_eq!(characters(&[]), "");
        assert_eq!(characters(&[0b1000_0011, 0b0000_1111]), "AC`");
        assert_eq!(characters(&[0]), "\u{180}\u{180}");
        let all: Vec<u8> = (0..=255).chain((0..=255).rev()).collect();
        let text = characters(&all);
        assert_eq!(text.chars().count(), (all.len() * 8).div_ceil(7));
        assert!(!text.contains(['\0', '\n', '\r', '<']));
        // As `unpack.js` reads it.
        let bits: String = text.chars().map(|letter| format!("{:07b}", letter as u32 & 127)).collect();
        let back = (0..all.len()).map(|k| u8::from_str_radix(&bits[8 * k..8 * k + 8], 2).unwrap());
        assert!(back.eq(all.iter().copied()));
    }

    #[test]
    fn the_file_needs_nothing_beside_it() {
        let html = std::fs::read_to_string(crate::run::root().join("index.html")).unwrap();
        let values = [("STYLE", ""), ("POSTER", ""), ("WASM_BYTES", "4"), ("BUILD", "build")];
        let theory = theory::Made { html: "<a href=\"./#seed=3\">".into(), poster: String::new() };
        let beside = Beside { theory, licences: String::new(), sbom: String::new() };
        let page = page(&html, &values, &parts("1"), &beside).unwrap();
        let page = String::from_utf8(page).unwrap();
        for beside in ["build/", "src=", "href=\"theory", "sbom", "manifest.webmanifest", "preload"] {
            assert!(!page.contains(beside), "{beside}");
        }
        assert!(
            page.contains("href=\"?theory\"")
                && page.contains("id=\"packed-program\"")
                && page.contains("id=\"packed-licences\"")
        );
    }
}
