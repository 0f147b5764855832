//! Writes pictures of the page: desk and phone, light and dark. Run by `cargo xtask shot --out DIR`.

#[expect(dead_code, unused_imports, reason = "the tests use the rest")]
mod harness;

use harness::{Options, Page, Renderer};
use std::path::PathBuf;

fn main() {
    let mut arguments = std::env::args_os().skip(1);
    let out = PathBuf::from(arguments.next().expect("a folder for the pictures"));
    let at: f64 = arguments
        .next()
        .and_then(|text| text.to_str()?.parse().ok())
        .unwrap_or(7.0);
    let desk = Options {
        size: [1440, 900],
        ..Options::default()
    };
    for (name, options) in [("desk", desk), ("phone", Options::phone())] {
        for (shade, dark) in [("light", false), ("dark", true)] {
            let mut page = Page::open(Renderer::WebGl, "?test", Options { dark, ..options });
            page.wait("the time of the picture", |page| {
                page.number("time").filter(|time| *time >= at)
            });
            let file = out.join(format!("{name}-{shade}.png"));
            std::fs::write(&file, page.png()).expect("the picture is written");
            println!("{}", file.display());
            for problem in page.problems() {
                println!("  console: {problem}");
            }
        }
    }
}
