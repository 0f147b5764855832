//! Files that the page saves: the drawing has the command's bytes, and its pixels the page's font.

use crate::harness::{Area, Options, Page, Picture, Renderer};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::process::Command;

/// Looks at what would become a download: its name, and its bytes in base64.
const LOOK: &str = "window.saved = null; HTMLAnchorElement.prototype.click = async function () { \
    const { download, href } = this; \
    const bytes = new Uint8Array(await (await fetch(href)).arrayBuffer()); \
    let text = ''; for (const byte of bytes) text += String.fromCharCode(byte); \
    window.saved = [download, btoa(text)]; }; 1";

/// Picks an entry of a card's menu; gives name and bytes of what is saved.
#[track_caller]
fn saved(page: &mut Page, menu: &str, entry: &str) -> (String, Vec<u8>) {
    page.eval("window.saved = null; 1");
    page.click("Button", menu);
    page.wait("the menu", |page| page.widgets().into_iter().find(|widget| widget.label == entry));
    page.click("MenuItem", entry);
    let saved = page.wait("a file", |page| Some(page.eval("window.saved")).filter(|saved| saved.is_array()));
    let bytes = STANDARD.decode(saved[1].as_str().expect("base64")).expect("base64");
    (saved[0].as_str().expect("a name").to_owned(), bytes)
}

/// What `centrode figure 4` writes to a file of this kind.
fn written(extension: &str) -> Vec<u8> {
    let path = std::env::temp_dir().join(format!("centrode-browser-{}.{extension}", std::process::id()));
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    let output = command.args(["figure", "4", "--out"]).arg(&path).output().expect("the command starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let bytes = std::fs::read(&path).expect("written");
    std::fs::remove_file(&path).expect("removed");
    bytes
}

#[test]
fn a_figure_is_saved_as_the_command_draws_it() {
    let mut page = Page::open(Renderer::WebGl, "?test#preset=bench&view=figure-4&t=6", Options::default());
    page.eval(LOOK);
    page.wait("the figure", |page| {
        page.widgets().into_iter().find(|widget| widget.role == "Figure" && widget.label.contains("centrodes with"))
    });
    let (name, svg) = page.wait("a drawing", |page| {
        // Until the figure is complete the page says that it is not.
        if page.widgets().iter().any(|widget| widget.label == "Go on") {
            page.click("Button", "Go on");
            return None;
        }
        Some(saved(page, "Save figure 4", "SVG"))
    });
    assert_eq!(name, "figure-4.svg");
    assert!(svg == written("svg"), "other bytes than the command's: {} of them", svg.len());

    let (name, png) = saved(&mut page, "Save figure 4", "PNG (2×)");
    assert_eq!(name, "figure-4.png");
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n") && png.len() > 20_000, "{} bytes", png.len());
    let (shown, drawn) = (Picture::decode(&png), Picture::decode(&written("png")));
    assert_eq!([shown.width, shown.height], [2400, 1640]);
    assert_eq!([drawn.width, drawn.height], [2400, 1640]);
    let apart = shown.changed(&drawn, Area::ALL);
    assert!(apart < 20_000, "another font would differ in more pixels than these: {apart}");
    assert_eq!(page.problems(), Vec::<String>::new());
}
