//! Writes pictures of the page: desk and phone, light and dark. Run by `cargo xtask shot --out DIR`.
//!
//! With fragments of an address (`tour=4`, `preset=bench&theme=projector`), of what each of them opens, at rest.

#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "a tool writes files and waits for a browser")]

#[expect(dead_code, unused_imports, reason = "the tests use the rest")]
mod harness;

use harness::{Options, Page, Renderer};
use std::path::{Path, PathBuf};

fn main() {
    let mut arguments = std::env::args_os().skip(1);
    let out = PathBuf::from(arguments.next().expect("a folder for the pictures"));
    let at: f64 = arguments.next().and_then(|text| text.to_str()?.parse().ok()).unwrap_or(7.0);
    let fragments: Vec<String> = arguments.filter_map(|text| text.into_string().ok()).collect();
    let desk = Options { size: [1440, 900], ..Options::default() };
    for (name, options) in [("desk", desk), ("phone", Options::phone())] {
        for (shade, dark) in [("light", false), ("dark", true)] {
            let options = Options { dark, ..options };
            if !fragments.is_empty() {
                linked(&fragments, options, &out, &format!("{name}-{shade}"));
                continue;
            }
            let mut page = Page::open(Renderer::WebGl, "?test", options);
            page.wait("the time of the picture", |page| page.number("time").filter(|time| *time >= at));
            write(&mut page, &out, &format!("{name}-{shade}"));
            for problem in page.problems() {
                println!("  console: {problem}");
            }
            page.click("Tab", "Tuning");
            page.wait("the study", |page| {
                let study: serde_json::Value = serde_json::from_str(&page.data("tuning")?).ok()?;
                (study["done"] == study["of"]).then_some(())
            });
            page.frames();
            write(&mut page, &out, &format!("{name}-{shade}-tuning"));
            page.eval("centrode.fail_on_purpose()");
            wait_for(&mut page, "failed");
            write(&mut page, &out, &format!("{name}-{shade}-failed"));

            let mut page = Page::visit(Renderer::Neither, "?test", options);
            wait_for(&mut page, "no-gpu");
            write(&mut page, &out, &format!("{name}-{shade}-no-gpu"));
        }
    }
}

/// Pictures of what these fragments open, one after the other on the same page.
fn linked(fragments: &[String], options: Options, out: &Path, name: &str) {
    let mut page = Page::open(Renderer::WebGl, "?test", Options { still: true, ..options });
    for fragment in fragments {
        page.eval(&format!("centrode.go({})", serde_json::json!(fragment)));
        // What a study finds comes bit by bit.
        let mut before = Vec::new();
        page.wait("the page to rest", |page| {
            (0..4).for_each(|_| page.frames());
            let now = page.png();
            let rests = now == before;
            before = now;
            rests.then_some(())
        });
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '.' { c } else { '-' };
        write(&mut page, out, &format!("{name}-{}", fragment.chars().map(plain).collect::<String>()));
    }
    for problem in page.problems() {
        println!("  console: {problem}");
    }
}

fn wait_for(page: &mut Page, face: &str) {
    page.wait(face, |page| (page.shown() == face).then_some(()));
}

fn write(page: &mut Page, out: &Path, name: &str) {
    let file = out.join(format!("{name}.png"));
    std::fs::write(&file, page.png()).expect("the picture is written");
    println!("{}", file.display());
}
