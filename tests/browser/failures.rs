//! Whatever goes wrong, the page stays readable and says what to do.

use crate::harness::host::{Host, build_of, built};
use crate::harness::{Area, Options, Page, Renderer};
use crate::lost;
use serde_json::Value;

fn notice(page: &mut Page) -> Option<String> {
    let open = page.eval("document.getElementById('notice')?.open") == true;
    open.then(|| page.text("#notice-list"))
}

/// Waits until the page shows this face, and gives its text.
#[track_caller]
pub fn wait_for(page: &mut Page, face: &str) -> String {
    page.wait(face, |page| (page.shown() == face).then_some(()));
    let text = page.text(&format!("#{face}"));
    assert!(page.picture().colours(Area::ALL) > 8, "the page is blank");
    assert_eq!(page.eval(&format!("document.querySelector('#{face} button.reload').checkVisibility()")), true);
    text
}

#[test]
fn without_a_gpu_it_says_what_to_do() {
    for options in [Options::default(), Options::phone()] {
        it_says_what_to_do_without_a_gpu(&mut Page::visit(Renderer::Neither, "?test", options));
    }
}

#[track_caller]
pub fn it_says_what_to_do_without_a_gpu(page: &mut Page) {
    let text = wait_for(page, "no-gpu");
    for word in ["WebGPU", "WebGL", "settings", "Update"] {
        assert!(text.contains(word), "{word} in {text}");
    }
    let detail = page.eval("document.getElementById('no-gpu-detail').textContent");
    assert!(detail.as_str().is_some_and(|detail| detail.contains("webgl:")), "{detail}");
    assert_eq!(page.eval("document.activeElement.className"), "reload");
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
    const NO_WEBGL: &str =
        "HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, {
      apply: (get, canvas, [kind, ...how]) => (kind === 'webgl2' ? null : get.call(canvas, kind, ...how)),
    });";
    for (before, renderer, wanted, got) in
        [("", Renderer::WebGl, "webgpu", "webgl"), (NO_WEBGL, Renderer::WebGpu, "webgl", "webgpu")]
    {
        let query = format!("?test&renderer={wanted}");
        let mut page = Page::visit_after(before, renderer, &query, Options::default());
        page.wait(&format!("a page drawn with {got}"), |page| {
            (page.data("renderer").as_deref() == Some(got)).then_some(())
        });
        let text = page.wait("a notice", notice);
        assert!(text.contains(wanted) && text.contains(&format!("draws with {got} instead")), "{text}");
    }
}

#[test]
fn graphics_that_never_answer_are_told_while_it_starts() {
    // Until the advice is taken, what waits for a time waits a thousandth of it.
    let never = "if (navigator.gpu) navigator.gpu.requestAdapter = () => new Promise(() => { globalThis.asked = true; }); \
         if (!location.search.includes('renderer')) { \
           const later = setTimeout; \
           globalThis.setTimeout = (then, time, ...rest) => later(then, time / 1000, ...rest); \
         }";
    let mut page = Page::visit_after(never, Renderer::Both, "?test#preset=paper", Options::default());
    page.wait("words that it is late", |page| page.text("#loading-late").contains("longer than usual").then_some(()));
    assert_eq!((page.eval("globalThis.asked"), page.shown()), (Value::Bool(true), "loading".to_owned()));
    page.eval("document.querySelector('#loading-late a').click()");
    page.wait("the page to run", |page| (page.shown() == "running").then_some(()));
    assert_eq!(page.eval("new URLSearchParams(location.search).get('renderer') + location.hash"), "webgl#preset=paper");
}

#[test]
fn a_refused_device_falls_back_to_webgl() {
    let refuse =
        "if (self.GPUAdapter) GPUAdapter.prototype.requestDevice = () => Promise.reject(new Error('refused'));";
    let mut page = Page::visit_after(refuse, Renderer::Both, "?test", Options::default());
    page.wait("the page to run", |page| (page.shown() == "running").then_some(()));
    assert_eq!(page.data("renderer").as_deref(), Some("webgl"));
}

#[test]
fn a_panic_shows_its_message_and_keeps_what_is_set() {
    a_panic_keeps_what_is_set(&mut Page::open(Renderer::WebGl, lost::STATE, Options::default()));
}

/// Presses a button of the page that tells of a failure, and waits until it runs again.
#[track_caller]
fn reload_by(page: &mut Page, button: &str) {
    page.eval(&format!("(window.before = true, document.querySelector('#failed {button}').click())"));
    page.wait("the reloaded page", |page| {
        let anew = page.eval("typeof window.before") == "undefined";
        (anew && page.shown() == "running" && page.data("ready").as_deref() == Some("true")).then_some(())
    });
}

#[track_caller]
pub fn a_panic_keeps_what_is_set(page: &mut Page) {
    let link = page.eval("location.href");
    page.eval("centrode.fail_on_purpose()");
    let text = wait_for(page, "failed");
    assert!(text.contains("a test asked for this panic") && text.contains("src/web.rs"), "{text}");
    page.eval("(navigator.clipboard.writeText = async (text) => { window.copied = text; }, 1)");
    page.eval("document.getElementById('copy-report').click()");
    let report = page.wait("a report", |page| page.eval("window.copied ?? null").as_str().map(str::to_owned));
    let heads: Vec<&str> = report.lines().filter_map(|line| line.split([' ', ':']).next()).collect();
    assert!(report.contains("a test asked for this panic") && report.contains(env!("CARGO_PKG_VERSION")), "{report}");
    for (head, said) in [
        ("Browser", page.eval("navigator.userAgent")),
        ("Renderer", page.data("renderer").into()),
        ("Link", link.clone()),
    ] {
        let line = format!("{head}: {}", said.as_str().unwrap_or_default());
        assert!(heads.contains(&head) && report.lines().any(|own| own == line), "{line} in {report}");
    }
    reload_by(page, ".reload");
    assert_eq!(page.eval("location.href"), link);
    assert_eq!((page.widget("Slider", "Contact disk").number, page.number("time")), (Some(3.0), Some(6.27)));
    page.eval("centrode.fail_on_purpose()");
    wait_for(page, "failed");
    reload_by(page, "#afresh");
    let address = page.eval("location.href");
    assert_eq!(address.as_str().and_then(|address| address.split('#').nth(1)).unwrap_or_default(), "");
}

/// Loses the first context as its first shader is made.
const LOSE_EARLY: &str = "const { prototype } = WebGL2RenderingContext; const make = prototype.createShader; \
    globalThis.lost = 0; \
    prototype.createShader = function (kind) { \
      if (lost++ === 0) this.getExtension('WEBGL_lose_context').loseContext(); \
      return make.call(this, kind); };";

#[test]
fn a_context_lost_while_the_page_starts_comes_back() {
    let mut page = Page::visit_after(LOSE_EARLY, Renderer::WebGl, "?test", Options::default());
    page.wait("the page on a fresh canvas", |page| match page.shown().as_str() {
        "running" => (page.eval("lost > 1 && centrode.is_drawing()") == true).then_some(()),
        "loading" => None,
        other => panic!("the page shows {other:?}: {}", page.text(&format!("#{other}"))),
    });
    page.frames();
    assert!(page.picture().colours(Area(0.3, 0.2, 0.7, 0.6)) > 8, "the middle of the page is blank");
}

#[test]
fn a_lost_context_comes_back() {
    lost::lost_graphics_come_back(&mut Page::open(Renderer::WebGl, lost::STATE, Options::default()));
}

/// What a browser does whose storage is full, refused, or holds what another version kept.
const STORAGES: [(&str, &str); 4] = [
    ("full", "Storage.prototype.setItem = () => { throw new DOMException('full', 'QuotaExceededError'); };"),
    (
        "refused",
        "for (const name of ['localStorage', 'sessionStorage', 'caches', 'indexedDB']) \
        Object.defineProperty(globalThis, name, { get() { throw new DOMException('no', 'SecurityError'); } }); \
        Object.defineProperty(Navigator.prototype, 'serviceWorker', { get() { throw new DOMException('no', 'SecurityError'); } });",
    ),
    (
        "nonsense",
        "if (location.protocol !== 'about:') localStorage.setItem('centrode.progress', '{\"tour\":\"\\u0000\",\"met\":7');",
    ),
    (
        "of another version",
        "if (location.protocol !== 'about:') \
        localStorage.setItem('centrode.progress', '{\"version\":99,\"tour\":900,\"done\":[-1],\"met\":[\"gone\"]}');",
    ),
];

#[test]
fn storage_never_stops_the_page() {
    for (what, script) in STORAGES {
        let mut page = Page::visit_after(script, Renderer::WebGl, "?test#tour=1", Options::default());
        page.wait(what, |page| match page.shown().as_str() {
            "failed" => panic!("storage that is {what} stops the page: {}", page.text("#failed")),
            "running" => Some(()),
            _ => None,
        });
        page.frames();
        assert_eq!(page.shown(), "running", "{what}");
        assert_eq!(page.problems(), Vec::<String>::new(), "{what}");
    }
}

#[test]
fn a_program_that_does_not_arrive_is_told() {
    for (file, word) in [
        ("centrode_bg.wasm", "404"),
        ("centrode.js", "centrode.js"),
        ("loader.js", "did not arrive"),
        ("shaders.js", "webgl.js"),
    ] {
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
fn shaders_translated_from_another_text_are_not_drawn_with() {
    let mut files = built();
    let name = format!("{}/shaders.js", build_of(&files));
    let shaders = files.get_mut(&name).expect("translated shaders");
    let text = String::from_utf8(std::mem::take(shaders)).expect("text");
    *shaders = text.replace("\"sum\":", "\"sum\":1").into_bytes();
    assert_ne!(shaders.len(), text.len());
    let host = Host::of(files);
    let mut page = Page::blank(Renderer::WebGl, Options::default());
    page.go(&host.address);
    let told = wait_for(&mut page, "failed");
    assert!(told.contains("another shader of the name"), "{told}");
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
