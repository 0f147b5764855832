//! The icons of the installed page are the drawn one, in pixels. `cargo xtask renew icons` stores them anew.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};
use std::path::Path;

const SIDES: [u32; 3] = [180, 192, 512];

#[test]
fn icons_in_pixels_are_the_drawn_one() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/icons");
    let drawn = std::fs::read_to_string(folder.join("icon.svg")).expect("the icon");
    let tree = Tree::from_str(&drawn, &Options::default()).expect("an SVG");
    for side in SIDES {
        let scale = side as f32 / tree.size().width();
        let mut pixels = Pixmap::new(side, side).expect("a size");
        resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
        let path = folder.join(format!("icon-{side}.png"));
        if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
            pixels.save_png(&path).expect("stored");
        }
        let stored = Pixmap::load_png(&path).expect("stored");
        assert!(stored.data() == pixels.data(), "{} is out of date: cargo xtask renew icons", path.display());
    }
}
