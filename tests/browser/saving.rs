//! Files that the page saves: the drawing has the command's bytes, and its pixels the page's font.

use crate::harness::{Area, Options, Page, Picture, Renderer};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::process::Command;

/// Looks at what would become a download: its name, and its bytes in base64. The page's policy lets nobody fetch what was made of them.
pub const LOOK: &str = "(() => { window.saved = null; const made = new Map(); const make = URL.createObjectURL; \
    URL.createObjectURL = (blob) => { const url = make.call(URL, blob); made.set(url, blob); return url; }; \
    HTMLAnchorElement.prototype.click = async function () { \
    const bytes = new Uint8Array(await made.get(this.href).arrayBuffer()); \
    let text = ''; for (const byte of bytes) text += String.fromCharCode(byte); \
    window.saved = [this.download, btoa(text)]; }; })()";

/// Hands no font on.
const NO_FONTS: &str = "{ const Real = Blob; \
    window.Blob = function (parts, options) { return new Real(options?.type === 'font/otf' ? [] : parts, options); }; } 1";

/// Picks an entry of a card's menu; gives name and bytes of what is saved.
#[track_caller]
pub fn saved(page: &mut Page, menu: &str, entry: &str) -> (String, Vec<u8>) {
    page.eval("window.saved = null");
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
    assert_eq!([shown.width, shown.height], [2560, 1280]);
    assert_eq!([drawn.width, drawn.height], [2560, 1280]);
    // Edges differ by the renderer, letters by the font: without its own the browser takes another.
    let apart = shown.changed(&drawn, Area::ALL);
    page.eval(NO_FONTS);
    let (_, bare) = saved(&mut page, "Save figure 4", "PNG (2×)");
    let other = Picture::decode(&bare).changed(&drawn, Area::ALL);
    assert!(2 * apart < other, "{apart} pixels differ from the command's, and {other} with another font");
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn the_3d_view_is_saved_with_and_without_its_background() {
    let pictures = [Renderer::WebGl, Renderer::WebGpu].map(|renderer| {
        let mut page = Page::open(renderer, "?test#preset=bench&t=6", Options::default());
        page.eval(LOOK);
        let (name, png) = saved(&mut page, "Save 3D view", "PNG (2×)");
        assert_eq!(name, "robot-bench.png");
        assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"), "{renderer:?}");
        let picture = Picture::decode(&png);
        let [.., width, height] = page.widget("Canvas", "3D view").bounds.expect("a place");
        let size = [width, height].map(|side| (2.0 * side).round() as usize);
        assert_eq!([picture.width, picture.height], size, "{renderer:?}");
        assert!(picture.colours(Area::ALL) > 500, "{renderer:?}: {} colours", picture.colours(Area::ALL));
        let (_, clear) = saved(&mut page, "Save 3D view", "PNG (2×), transparent");
        let mut reader = png::Decoder::new(std::io::Cursor::new(clear)).read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut bytes).expect("pixels");
        let opaque = bytes.chunks_exact(4).filter(|pixel| pixel[3] == 255).count();
        assert!(bytes[3] == 0 && opaque > bytes.len() / 4 / 100, "{renderer:?}: {opaque} pixels of the robot");
        assert_eq!(page.problems(), Vec::<String>::new());
        picture
    });
    let apart = pictures[0].changed(&pictures[1], Area::ALL);
    assert!(apart < 1000, "{apart} pixels differ between WebGL2 and WebGPU");
}
