//! A page that plays and is tuned for long takes no more memory than one that was for a while.

use crate::harness::{Options, Page, Renderer};
use serde_json::{Value, json};

/// By so much the program's memory may have grown, bytes: on WebGL it was 2 MiB, at once. A run kept for each thing done would take many
/// times as much.
const MOST: u64 = 4 << 20;

/// Counts what WebGL is asked to make and not to delete.
const COUNT: &str = "globalThis.objects = {}; \
    for (const name of Object.getOwnPropertyNames(WebGL2RenderingContext.prototype)) { \
      const [, act, kind] = /^(create|delete)([A-Z]\\w+)$/.exec(name) ?? []; \
      if (!act) continue; \
      const does = WebGL2RenderingContext.prototype[name]; \
      WebGL2RenderingContext.prototype[name] = function (...given) { \
        if (act === 'create' || given[0]) objects[kind] = (objects[kind] ?? 0) + (act === 'create' ? 1 : -1); \
        return does.apply(this, given); }; }";

/// No larger than it need be: software draws slowly.
const SIZE: [u32; 2] = [1000, 640];

/// A round of what a person does: contacts, a filter, thresholds, another preset, a seed, while the run plays.
const ROUND: [&str; 8] = [
    "preset=bench&contact.disk=1",
    "preset=bench&contact.disk=3&seed=7",
    "preset=bench&filter.length=250",
    "preset=bench&filter.length=600&detection.xi1=5",
    "preset=disk-3",
    "preset=bench&contact.disk=0",
    "preset=bench&view=tuning&repeats=3",
    "preset=bench&seed=3",
];

/// Goes through so many rounds, two frames for each thing; in each the window is made smaller, and as large as before.
#[track_caller]
fn rounds(page: &mut Page, count: usize) {
    for _ in 0..count {
        for link in ROUND {
            page.eval(&format!("(centrode.go({}), 1)", json!(link)));
            page.frames();
        }
        for size in [[900, 600], SIZE] {
            page.resize(size);
            page.frames();
        }
    }
}

/// Bytes of the program's memory, and objects of WebGL by kind.
fn taken(page: &mut Page) -> (u64, Value) {
    page.frames();
    let bytes = page.eval("centrode.memory.buffer.byteLength").as_u64().expect("a size");
    (bytes, page.eval("globalThis.objects ?? {}"))
}

#[track_caller]
fn stays_as_large(renderer: Renderer, round: usize) {
    let mut page = Page::visit_after(COUNT, renderer, "?test", Options { size: SIZE, ..Options::default() });
    page.wait("the page", |page| page.data("ready").filter(|ready| ready == "true"));
    rounds(&mut page, round);
    let (before, made) = taken(&mut page);
    rounds(&mut page, 2 * round);
    let (after, kept) = taken(&mut page);
    println!("{before} bytes, then {after}; {made}, then {kept}");
    assert!(after <= before + MOST, "{before} bytes have become {after}");
    if renderer == Renderer::WebGl {
        assert!(made["Buffer"].as_u64() > Some(0) && made["Texture"].as_u64() > Some(0), "{made}");
        assert_eq!(kept, made, "objects of WebGL");
    }
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_page_at_work_stays_as_large_on_webgl() {
    stays_as_large(Renderer::WebGl, 2);
}

#[test]
fn a_page_at_work_stays_as_large_on_webgpu() {
    stays_as_large(Renderer::WebGpu, 1);
}
