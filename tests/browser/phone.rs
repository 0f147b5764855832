//! The page in a hand: drawn to the pixel at every size, nothing off the screen, and a finger does what it is meant to.

use crate::harness::{Area, Options, Page, Renderer, Widget};
use serde_json::json;

const SIZES: [[u32; 2]; 4] = [[360, 640], [390, 844], [844, 390], [768, 1024]];
/// What has its place on every page, and is not scrolled to.
const FIXED: [&str; 9] =
    ["Help", "Share", "Learn", "Play", "Step back", "Step forward", "Loop", "Time", "Height of the sheet"];

fn open(options: Options, query: &str) -> Page {
    // Who wants less motion is met by a page that stands still.
    Page::open(Renderer::WebGl, query, Options { phone: true, still: true, ..options })
}

/// Leaves a picture to be looked at in the folder `CENTRODE_SHOTS`, if there is one.
fn keep(page: &mut Page, name: &str) {
    if let Some(folder) = std::env::var_os("CENTRODE_SHOTS") {
        let file = std::path::Path::new(&folder).join(format!("{name}.png"));
        std::fs::write(file, page.png()).expect("the picture is written");
    }
}

/// The canvas has a pixel for each of the screen's, and what stands on it is on the screen.
#[track_caller]
fn is_whole(page: &mut Page, size: [u32; 2], ratio: f64) {
    let wanted = size.map(|side| f64::from(side) * ratio);
    page.wait("the canvas to have its pixels", |page| {
        let canvas = page.eval("(c => [c.width, c.height])(document.getElementById('canvas'))");
        (canvas == json!(wanted.map(|side| side as u32))).then_some(())
    });
    assert_eq!(page.eval("devicePixelRatio"), json!(ratio as u32));
    assert_eq!(page.eval("[document.scrollingElement.scrollWidth, scrollX, scrollY]"), json!([size[0], 0, 0]));
    // What is told of widgets is that of the frame before.
    (0..4).for_each(|_| page.frames());
    page.wait("all widgets to be on the screen", |page| {
        let widgets = page.widgets();
        let placed = |widget: &&Widget| widget.bounds.is_some() && widget.role != "Window" && !widget.label.is_empty();
        let [width, height] = size.map(f64::from);
        let off: Vec<_> = widgets
            .iter()
            .filter(placed)
            .filter(|widget| {
                let [x, y, wide, high] = widget.bounds.unwrap_or_default();
                let down = FIXED.contains(&widget.label.as_str()) && y + high > height + 0.5;
                x < -0.5 || x + wide > width + 0.5 || y < -0.5 && FIXED.contains(&widget.label.as_str()) || down
            })
            .collect();
        // And the page reaches to its edge.
        let last = widgets.iter().find(|widget| widget.label == "Help").and_then(|widget| widget.bounds);
        let wide = last.is_some_and(|[x, _, wide, _]| x + wide > width - 16.0);
        (off.is_empty() && wide).then_some(())
    });
    // A canvas of another size is blank until it has been painted.
    let picture = page.wait("a picture", |page| Some(page.picture()).filter(|picture| picture.colours(Area::ALL) > 99));
    assert_eq!([picture.width, picture.height], wanted.map(|side| side as usize));
    page.frames();
}

/// Where the button of the help is seen, CSS pixels, once the page has come to rest.
fn help(page: &mut Page) -> [f64; 4] {
    (0..4).for_each(|_| page.frames());
    page.widget("Button", "Help").bounds.expect("a place")
}

#[test]
fn every_size_is_drawn_to_the_pixel_and_nothing_is_off_the_screen() {
    let mut page = open(Options { size: SIZES[0], dark: true, ..Options::default() }, "?test#preset=bench&t=6.4");
    for size @ [width, height] in SIZES {
        page.resize(size);
        // A browser that draws in software takes seconds for each frame of more.
        let ratios: &[f64] = if size == SIZES[0] { &[1.0, 2.0, 3.0, 1.0] } else { &[1.0] };
        let mut placed = Vec::new();
        for &ratio in ratios {
            page.emulate(ratio);
            is_whole(&mut page, size, ratio);
            keep(&mut page, &format!("{width}x{height}-{ratio}-dark"));
            // To take a picture, the browser goes to the ratio of its screen and comes back.
            placed.push(help(&mut page));
            is_whole(&mut page, size, ratio);
        }
        let apart = |place: &[f64; 4]| (0..4).any(|side| (place[side] - placed[0][side]).abs() > 1.0);
        assert!(!placed.iter().any(apart), "the help moves with the pixels: {placed:?} at {ratios:?}");
    }
    assert_eq!(page.problems(), Vec::<String>::new());
    // A screen that has these pixels, and does not only say so.
    let size = [390, 844];
    let mut page = open(Options { size, scale: 2.0, ..Options::default() }, "?test#preset=bench&t=6.4");
    is_whole(&mut page, size, 2.0);
    keep(&mut page, "390x844-true-2-light");
    assert_eq!(page.problems(), Vec::<String>::new());
}

fn tap(page: &mut Page, role: &str, label: &str) {
    let at = page.widget(role, label).at(0.5);
    page.tap(at);
    page.frames();
}

/// The middle of the 3D view.
fn view(page: &mut Page) -> [f64; 2] {
    let [x, y, width, height] = page.widget("Canvas", "3D view").bounds.expect("a place");
    [x + 0.4 * width, y + 0.6 * height]
}

fn top(page: &mut Page, role: &str, label: &str) -> f64 {
    page.widget(role, label).bounds.expect("a place")[1]
}

#[test]
fn a_finger_turns_the_robot_scrolls_the_controls_and_draws_the_sheet_out() {
    let mut page = open(Options { size: [390, 844], ..Options::default() }, "?test#preset=bench&t=6.4");
    let at = view(&mut page);
    page.frames();
    let before = page.picture();
    page.swipe(at, [at[0] + 90.0, at[1] + 10.0]);
    let turned = page.picture();
    assert!(before.changed(&turned, Area(0.0, 0.15, 1.0, 0.45)) > 2000, "it has been turned");
    assert_eq!(page.eval("scrollY"), json!(0));
    tap(&mut page, "Button", "Controls");
    let row = page.widget("Slider", "Contact time").at(0.5);
    let label = [row[0], row[1] - 44.0];
    let edge = top(&mut page, "Slider", "Height of the sheet");
    page.swipe(label, [label[0], label[1] - 90.0]);
    page.wait("the controls to scroll", |page| (top(page, "Slider", "Contact time") < row[1] - 60.0).then_some(()));
    assert_eq!(top(&mut page, "Slider", "Height of the sheet"), edge);
    let [x, y] = page.widget("Slider", "Height of the sheet").at(0.5);
    page.swipe([x, y + 8.0], [x, y - 250.0]);
    page.wait("the sheet to be drawn out", |page| {
        (page.widget("Slider", "Height of the sheet").number == Some(2.0)).then_some(())
    });
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_field_brings_up_its_keyboard() {
    let mut page = open(Options { size: [390, 844], ..Options::default() }, "?test#preset=bench&t=6.4");
    tap(&mut page, "Button", "Controls");
    page.frames();
    // A time can also be typed as a bend, in words; a count cannot.
    for (field, keyboard) in [("Contact time value", "text"), ("Filter length N value", "decimal")] {
        let at = loop {
            let at = page.widget("TextInput", field).at(0.5);
            if at[1] < 650.0 {
                break at;
            }
            page.swipe([60.0, 600.0], [60.0, 480.0]);
        };
        page.tap(at);
        page.wait(field, |page| {
            let there = page.eval("(({ tagName, inputMode }) => [tagName, inputMode])(document.activeElement)");
            (there == json!(["INPUT", keyboard])).then_some(())
        });
        page.key("Escape");
    }
    assert_eq!(page.problems(), Vec::<String>::new());
}

/// The example host page with a frame that shows this, longer than the screen.
fn host(query: &str, fragment: &str) -> Page {
    let options = Options { size: [390, 844], phone: true, still: true, ..Options::default() };
    let mut page = Page::visit(Renderer::WebGl, "?test", options);
    let base = page.eval("location.origin + location.pathname");
    let base = base.as_str().expect("an address").to_owned();
    page.browse(&format!("{base}examples/embed.html"));
    page.eval(&format!(
        "document.body.style.minHeight = '3000px'; frame.style.cssText = 'width: 100%; height: 600px'; frame.src = {}; 1",
        json!(format!("{base}{query}{fragment}"))
    ));
    page.wait("the frame", |page| {
        let ready = format!(
            "(w => w.location.search === {} && w.document.getElementById('mirror')?.dataset.ready)",
            json!(query)
        );
        (page.eval(&format!("{ready}(frame.contentWindow)")) == "true").then_some(())
    });
    page
}

/// A place inside the frame, by fractions of its sides.
fn inside(page: &mut Page, x: f64, y: f64) -> [f64; 2] {
    let script = format!("(r => [r.x + {x} * r.width, r.y + {y} * r.height])(frame.getBoundingClientRect())");
    serde_json::from_value(page.eval(&script)).expect("a place")
}

/// Taps into the frame, so that it hears what is done there.
fn take(page: &mut Page, x: f64, y: f64) {
    let at = inside(page, x, y);
    page.tap(at);
    page.wait("the frame to be taken", |page| {
        (page.eval("frame.contentDocument.documentElement.classList.contains('taken')") == true).then_some(())
    });
}

fn time(page: &mut Page) -> f64 {
    let time = page.eval("Number(frame.contentDocument.getElementById('mirror').dataset.time)");
    time.as_f64().expect("a time")
}

#[test]
fn a_finger_on_plots_in_a_frame_scrolls_the_host() {
    let mut page = host("?embed=plots&test", "#preset=bench&t=5");
    // Between the handles; nothing there moves up and down.
    let scrolls = |page: &mut Page, what: &str| {
        let at = inside(page, 0.7, 0.28);
        page.swipe(at, [at[0], at[1] - 160.0]);
        page.wait(what, |page| page.eval("scrollY").as_f64().filter(|scrolled| *scrolled > 60.0));
        page.eval("scrollTo(0, 0); 1");
        page.wait("the top", |page| (page.eval("scrollY") == 0).then_some(()));
    };
    scrolls(&mut page, "the host to scroll");
    take(&mut page, 0.5, 0.28);
    let before = time(&mut page);
    scrolls(&mut page, "the host to scroll once the frame is taken");
    assert_eq!(time(&mut page), before, "scrolling scrubs nothing");
    let at = inside(&mut page, 0.3, 0.28);
    page.swipe(at, [at[0] + 120.0, at[1] + 4.0]);
    page.wait("the cursor", |page| (time(page) != before).then_some(()));
    assert_eq!(page.eval("scrollY"), json!(0));
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_finger_in_a_frames_3d_view_turns_the_robot_once_it_was_tapped() {
    let mut page = host("?embed=robot&test", "#preset=bench&t=5");
    let at = inside(&mut page, 0.4, 0.5);
    page.swipe(at, [at[0], at[1] - 160.0]);
    page.wait("the host to scroll", |page| page.eval("scrollY").as_f64().filter(|scrolled| *scrolled > 60.0));
    page.eval("scrollTo(0, 0); 1");
    page.wait("the top", |page| (page.eval("scrollY") == 0).then_some(()));
    take(&mut page, 0.4, 0.5);
    let before = page.picture();
    let at = inside(&mut page, 0.4, 0.5);
    page.swipe(at, [at[0] + 60.0, at[1] - 120.0]);
    let after = page.picture();
    assert!(before.changed(&after, Area::ALL) > 2000, "it has been turned");
    assert_eq!(page.eval("scrollY"), json!(0));
    assert_eq!(page.problems(), Vec::<String>::new());
}
