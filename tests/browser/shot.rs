//! Writes pictures of the page: desk and phone, light and dark. Run by `cargo xtask shot --out DIR`.

#![allow(clippy::disallowed_methods, clippy::disallowed_types, reason = "a tool writes files and waits for a browser")]

#[expect(dead_code, unused_imports, reason = "the tests use the rest")]
mod harness;

use harness::{Options, Page, Renderer};
use std::path::{Path, PathBuf};

fn main() {
    let mut arguments = std::env::args_os().skip(1);
    let out = PathBuf::from(arguments.next().expect("a folder for the pictures"));
    let at: f64 = arguments.next().and_then(|text| text.to_str()?.parse().ok()).unwrap_or(7.0);
    let desk = Options { size: [1440, 900], ..Options::default() };
    for (name, options) in [("desk", desk), ("phone", Options::phone())] {
        for (shade, dark) in [("light", false), ("dark", true)] {
            let options = Options { dark, ..options };
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

fn wait_for(page: &mut Page, face: &str) {
    page.wait(face, |page| (page.shown() == face).then_some(()));
}

fn write(page: &mut Page, out: &Path, name: &str) {
    let file = out.join(format!("{name}.png"));
    std::fs::write(&file, page.png()).expect("the picture is written");
    println!("{}", file.display());
}
