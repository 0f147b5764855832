//! Whatever goes wrong, the page stays readable and says what to do.

use crate::harness::{Area, Options, Page, Renderer};
use serde_json::Value;

fn notice(page: &mut Page) -> Option<String> {
    let open = page.eval("document.getElementById('notice')?.open") == true;
    open.then(|| page.text("#notice-list"))
}

/// Waits until the page shows this face, and gives its text.
#[track_caller]
fn wait_for(page: &mut Page, face: &str) -> String {
    page.wait(face, |page| (page.shown() == face).then_some(()));
    let text = page.text(&format!("#{face}"));
    assert!(page.picture().colours(Area::ALL) > 8, "the page is blank");
    assert_eq!(page.eval(&format!("document.querySelector('#{face} button.reload').checkVisibility()")), true);
    text
}

#[test]
fn without_a_gpu_it_says_what_to_do() {
    for options in [Options::default(), Options::phone()] {
        let mut page = Page::visit(Renderer::Neither, "?test", options);
        let text = wait_for(&mut page, "no-gpu");
        for word in ["WebGPU", "WebGL", "settings", "Update"] {
            assert!(text.contains(word), "{word} in {text}");
        }
        let detail = page.eval("document.getElementById('no-gpu-detail').textContent");
        assert!(detail.as_str().is_some_and(|detail| detail.contains("webgl:")), "{detail}");
        assert_eq!(page.eval("document.activeElement.className"), "reload");
    }
}

#[test]
fn a_wrong_parameter_is_named_and_the_page_goes_on() {
    let cases: [(&str, &[&str]); 8] = [
        ("?test&renderer=bogus", &["bogus", "webgpu", "webgl"]),
        ("?test&renderer=", &["renderer", "nothing", "webgpu"]),
        ("?test&renderer=webgl&renderer=webgl", &["2 times"]),
        ("?test&embed=bogus", &["embed=bogus", "all was used", "robot, plots, tuning, all"]),
        ("?test&embed&origins=example.org", &["example.org in origins", "https://example.org"]),
        ("?test&origins=https://a.example,https://b.example/page", &["https://b.example/page in origins"]),
        ("?test&rendrer=webgl", &["rendrer", "Known", "renderer"]),
        ("?test&renderer=%E0%A4%A&%3Cb%3E=%zz%00", &["renderer=", "“<b>”"]),
    ];
    let mut page = Page::visit(Renderer::WebGl, "?test", Options::default());
    let base = page.eval("location.origin + location.pathname");
    let base = base.as_str().expect("an address").to_owned();
    for (query, words) in cases {
        page.go(&format!("{base}{query}"));
        let text = page.wait("a notice", notice);
        for word in words {
            assert!(text.contains(word), "{query}: {word} in {text}");
        }
        page.wait("the page behind it to go on", |page| (page.shown() == "running").then_some(()));
        page.eval("document.querySelector('#notice button').click()");
        assert_eq!(notice(&mut page), None);
    }
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn a_link_with_somebody_elses_parameters_is_fine() {
    let mut page = Page::open(Renderer::WebGl, "?test&utm_source=mail&fbclid=1", Options::default());
    page.frames();
    assert_eq!(notice(&mut page), None);
}

#[test]
fn a_renderer_that_is_not_there_is_replaced() {
    let mut page = Page::open(Renderer::WebGl, "?test&renderer=webgpu", Options::default());
    assert_eq!(page.data("renderer").as_deref(), Some("webgl"));
    let text = page.wait("a notice", notice);
    assert!(text.contains("webgpu") && text.contains("webgl"), "{text}");
}

#[test]
fn a_refused_device_falls_back_to_webgl() {
    let mut page = Page::visit(Renderer::Both, "?test", Options::default());
    page.before_scripts(
        "if (self.GPUAdapter) GPUAdapter.prototype.requestDevice = () => Promise.reject(new Error('refused'));",
    );
    let address = page.eval("location.href");
    page.go(address.as_str().expect("an address"));
    page.wait("the page to run", |page| (page.shown() == "running").then_some(()));
    assert_eq!(page.data("renderer").as_deref(), Some("webgl"));
}

#[test]
fn a_panic_shows_its_message() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.eval("centrode.fail_on_purpose()");
    let text = wait_for(&mut page, "failed");
    assert!(text.contains("a test asked for this panic") && text.contains("src/web.rs"), "{text}");
    page.eval("document.querySelector('#failed button').click()");
    page.wait("the reloaded page", |page| {
        (page.shown() == "running" && page.data("ready").as_deref() == Some("true")).then_some(())
    });
}

#[test]
fn a_lost_context_offers_to_reload() {
    let mut page = Page::open(Renderer::WebGl, "?test", Options::default());
    page.eval(
        "document.getElementById('canvas').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()",
    );
    let text = wait_for(&mut page, "failed");
    assert!(text.contains("lost its graphics"), "{text}");
}

#[test]
fn a_program_that_does_not_arrive_is_told() {
    for (file, word) in [("centrode_bg.wasm", "404"), ("centrode.js", "centrode.js"), ("loader.js", "did not arrive")] {
        let mut page = Page::visit(Renderer::WebGl, "?test", Options::default());
        // The address of a part that is not there any more, as after an update of the site in mid-load.
        page.block(file, 404);
        let address = page.eval("location.href");
        page.go(address.as_str().expect("an address"));
        let text = wait_for(&mut page, "failed");
        assert!(text.contains(word), "{file}: {word} in {text}");
    }
}

#[test]
fn bytes_are_counted_without_their_length_and_compressed() {
    let mut page = Page::visit(Renderer::WebGl, "?test", Options::default());
    page.before_scripts(
        "globalThis.told = []; const fetched = fetch; \
         globalThis.fetch = async (...a) => { \
           const r = await fetched(...a); \
           const zipped = r.body.pipeThrough(new CompressionStream('gzip')).pipeThrough(new DecompressionStream('gzip')); \
           return new Response(zipped, { headers: { 'Content-Length': '1234' } }); }; \
         new MutationObserver(() => { const t = document.getElementById('loading-text')?.textContent; if (t) told.push(t); }) \
           .observe(document, { subtree: true, childList: true, characterData: true });",
    );
    let address = page.eval("location.href");
    page.go(address.as_str().expect("an address"));
    page.wait("the page to run", |page| (page.shown() == "running").then_some(()));
    let told: Vec<String> = serde_json::from_value::<Vec<Value>>(page.eval("told"))
        .expect("texts")
        .iter()
        .filter_map(|text| text.as_str().map(str::to_owned))
        .collect();
    assert!(told.iter().any(|text| text.contains(" of ")), "{told:?}");
    assert_eq!(told.last().map(String::as_str), Some("Starting"));
}
