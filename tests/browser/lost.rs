//! Lost graphics: the picture comes back as it was, until that happens too often.

use crate::failures::wait_for;
use crate::harness::{Area, Page};

/// With a run, an instant and a preset that are not those of the page as it opens.
pub const STATE: &str = "?test#preset=bench&contact.disk=3&t=6.27&loop=off";

/// Takes from the page what it draws with, as a driver would; `devices` are those that it was given.
const LOSE: &str = "(() => { const canvas = window.lost = document.getElementById('canvas'); \
    const gl = canvas.getContext('webgl2'); \
    if (gl) gl.getExtension('WEBGL_lose_context').loseContext(); else devices.at(-1).destroy(); return 1; })()";

/// Slows the page's clock, for it is not the speed of the machine that is tested.
const SLOW: &str = "(() => { const now = performance.now.bind(performance); const from = now(); \
    performance.now = () => from + (now() - from) / 20; return 1; })()";

/// The page on a fresh canvas, or the face that it shows instead.
#[track_caller]
fn lose(page: &mut Page) -> String {
    page.eval(LOSE);
    page.wait("what comes of the loss", |page| {
        let drawn = "document.getElementById('canvas') !== window.lost && centrode.is_drawing()";
        let face = page.shown();
        (face != "running" || page.eval(drawn) == true).then_some(face)
    })
}

/// What is shown and set, besides the picture.
fn state(page: &mut Page) -> [String; 4] {
    let link = page.eval("location.hash").as_str().unwrap_or_default().to_owned();
    let disk = page.widget("Slider", "Contact disk").number;
    [link, format!("{disk:?}"), format!("{:?}", page.number("time")), format!("{:?}", page.number("detectionTime"))]
}

#[track_caller]
pub fn lost_graphics_come_back(page: &mut Page) {
    // A view of one's own, which no link holds.
    page.drag("Canvas", "3D view", 0.35, 0.65);
    // Where nothing is lit by it: nobody knows of the pointer afterwards, until it moves.
    page.mouse("mouseMoved", [860.0, 24.0]);
    // On a busy machine a pointer arrives late: what it lit must be dark again.
    let before = page.wait("a picture that stays", |page| {
        let one = page.picture();
        page.frames();
        let other = page.picture();
        (other.changed(&one, Area::ALL) == 0).then_some(other)
    });
    let was = state(page);
    assert_eq!(lose(page), "running");
    let mut apart = usize::MAX;
    page.wait("the same picture", |page| {
        apart = apart.min(page.picture().changed(&before, Area::ALL));
        (apart < 500).then_some(())
    });
    println!("pixels that differ after the loss: {apart}");
    assert_eq!(state(page), was);
    // And it goes on.
    page.type_number("Contact disk", "0");
    page.wait("no detection", |page| page.data("detectionTime").is_none().then_some(()));
    assert_eq!(page.problems(), Vec::<String>::new());
    page.eval(SLOW);
    // A driver that drops everything again and again is not to be relied on.
    let faces: Vec<String> = (0..6).map_while(|_| (page.shown() == "running").then(|| lose(page))).collect();
    assert_eq!(faces.last().map(String::as_str), Some("failed"), "{faces:?}");
    assert!(faces.len() >= 2, "it gave up after {} losses", faces.len() + 1);
    let text = wait_for(page, "failed");
    assert!(text.contains("lost its graphics") && text.contains("three times"), "{text}");
}
