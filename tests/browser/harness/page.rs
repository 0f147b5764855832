//! The page as a person uses it: look, click, drag, type. Widgets are found by their names.

use super::chromium::{Chromium, Renderer};
use super::driven::{Driven, Engine};
use super::picture::Picture;
use base64::Engine as _;
use serde::Deserialize;
use serde_json::{Value, json};
use std::thread;
use std::time::{Duration, Instant};

/// Software rendering gives a few frames a second, and a cold start compiles megabytes of wasm.
const PATIENCE: Duration = Duration::from_secs(150);

/// How the page is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Width and height in CSS pixels.
    pub size: [u32; 2],
    /// Device pixels per CSS pixel of the screen.
    pub scale: f64,
    /// The same as developer tools emulate it, on a screen that has `scale`.
    pub emulated: Option<f64>,
    /// A phone: touch, and its viewport rules.
    pub phone: bool,
    /// The person prefers dark colours.
    pub dark: bool,
    /// The person prefers less motion.
    pub still: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { size: [1280, 800], scale: 1.0, emulated: None, phone: false, dark: false, still: false }
    }
}

impl Options {
    /// A phone held upright.
    pub fn phone() -> Self {
        Self { size: [390, 844], scale: 2.0, phone: true, ..Self::default() }
    }
}

/// A widget of the interface, as accessibility tools see it. Bounds in CSS pixels.
#[derive(Clone, Debug, Deserialize)]
pub struct Widget {
    /// `Slider`, `SpinButton`, `Button`, `CheckBox`, `Label`, …
    pub role: String,
    #[serde(default)]
    pub label: String,
    #[serde(default)]
    pub value: String,
    pub number: Option<f64>,
    pub min: Option<f64>,
    pub max: Option<f64>,
    pub on: Option<bool>,
    #[serde(default)]
    pub disabled: bool,
    #[serde(default)]
    pub focused: bool,
    /// x, y, width, height
    pub bounds: Option<[f64; 4]>,
}

/// All widgets as JSON, for JavaScript.
pub const WIDGETS: &str = "((canvas) => centrode.widgets(canvas.getBoundingClientRect().width / canvas.width))(document.getElementById('canvas'))";

/// Who shows the page.
pub(super) enum Browser {
    Chromium(Box<Chromium>),
    Driven(Driven),
}

/// The page in a browser of its own.
pub struct Page {
    pub(super) browser: Browser,
    options: Options,
}

impl Page {
    /// Opens the page with `query` (such as `"?test"`) and waits until it shows a picture.
    #[track_caller]
    pub fn open(renderer: Renderer, query: &str, options: Options) -> Self {
        let mut page = Self::visit(renderer, query, options);
        page.wait("the page to be ready", |page| match page.shown().as_str() {
            "running" => (page.data("ready").as_deref() == Some("true")).then_some(()),
            "loading" => None,
            other => panic!("the page shows {other:?}: {}", page.text(&format!("#{other}"))),
        });
        page
    }

    /// Opens the page and waits for nothing.
    #[track_caller]
    pub fn visit(renderer: Renderer, query: &str, options: Options) -> Self {
        let (mut page, address) = Self::start(renderer, options);
        page.go(&format!("{address}{query}"));
        page
    }

    /// The same with a script that runs before those of the page.
    #[track_caller]
    pub fn visit_after(script: &str, renderer: Renderer, query: &str, options: Options) -> Self {
        let (mut page, address) = Self::start(renderer, options);
        page.before_scripts(script);
        page.go(&format!("{address}{query}"));
        page
    }

    /// Opens a document beside the page, such as `theory.html`, and waits until all of it is there.
    #[track_caller]
    pub fn read(document: &str, options: Options) -> Self {
        let (mut page, address) = Self::start(Renderer::WebGl, options);
        page.browse(&format!("{address}{document}"));
        page
    }

    /// A browser that looks as the options say, and the page's address.
    #[track_caller]
    fn start(renderer: Renderer, options: Options) -> (Self, String) {
        let address = std::env::var("CENTRODE_PAGE")
            .expect("CENTRODE_PAGE names no page: these tests are run by `cargo xtask test browser`");
        (Self::blank(renderer, options), address)
    }

    /// A browser that looks as the options say, on no page yet.
    #[track_caller]
    pub fn blank(renderer: Renderer, options: Options) -> Self {
        let browser = Browser::Chromium(Box::new(Chromium::start(renderer, options.scale)));
        let mut page = Self { browser, options };
        page.resize(options.size);
        let preference = |name, on, yes, no| json!({ "name": name, "value": if on { yes } else { no } });
        page.chromium().call(
            "Emulation.setEmulatedMedia",
            json!({ "features": [
                preference("prefers-color-scheme", options.dark, "dark", "light"),
                preference("prefers-reduced-motion", options.still, "reduce", "no-preference"),
            ]}),
        );
        if options.phone {
            page.chromium().call("Emulation.setTouchEmulationEnabled", json!({ "enabled": true, "maxTouchPoints": 2 }));
        }
        page
    }

    /// Another browser than Chromium, on no page yet.
    #[track_caller]
    pub fn driven(engine: Engine, renderer: Renderer) -> Self {
        let options = Options::default();
        let mut page = Self { browser: Browser::Driven(Driven::start(engine, renderer)), options };
        page.resize(options.size);
        page
    }

    /// Chromium's own connection, for what only Chromium is asked for.
    #[track_caller]
    pub(super) fn chromium(&mut self) -> &mut Chromium {
        match &mut self.browser {
            Browser::Chromium(chromium) => chromium,
            Browser::Driven(_) => panic!("only Chromium is asked for this"),
        }
    }

    /// Goes to an address and waits for nothing.
    #[track_caller]
    pub fn go(&mut self, address: &str) {
        self.navigate(address);
        self.wait("the document", |page| {
            (page.eval("document.readyState") != "loading" && !page.shown().is_empty()).then_some(())
        });
    }

    /// Goes to an address that need not be that of the page, and waits until all of it is there.
    #[track_caller]
    pub fn browse(&mut self, address: &str) {
        self.navigate(address);
        self.wait("the document", |page| (page.eval("document.readyState") == "complete").then_some(()));
    }

    #[track_caller]
    fn navigate(&mut self, address: &str) {
        match &mut self.browser {
            Browser::Chromium(chromium) => {
                let result = chromium.call("Page.navigate", json!({ "url": address }));
                assert!(result.get("errorText").is_none(), "{address}: {result}");
            }
            Browser::Driven(driven) => driven.go(address),
        }
    }

    /// Loads the page anew, as it is, and waits until it runs.
    #[track_caller]
    pub fn reload(&mut self) {
        self.eval("window.before = true; setTimeout(() => location.reload(), 0); 1");
        self.wait("the page anew", |page| {
            (page.eval("typeof window.before") == "undefined" && page.data("ready").as_deref() == Some("true"))
                .then_some(())
        });
    }

    /// Gives the page another size, in CSS pixels.
    pub fn resize(&mut self, size: [u32; 2]) {
        self.options.size = size;
        if let Browser::Driven(driven) = &mut self.browser {
            return driven.resize(size);
        }
        let Options { emulated, phone, .. } = self.options;
        self.chromium().call(
            "Emulation.setDeviceMetricsOverride",
            json!({
                "width": size[0], "height": size[1],
                // 0: as the browser was started.
                "deviceScaleFactor": emulated.unwrap_or(0.0), "mobile": phone,
            }),
        );
    }

    /// Emulates another number of device pixels per CSS pixel.
    pub fn emulate(&mut self, ratio: f64) {
        self.options.emulated = Some(ratio);
        self.resize(self.options.size);
    }

    /// Asks until there is an answer; `what` is for the failure's message.
    #[track_caller]
    pub fn wait<T>(&mut self, what: &str, mut ask: impl FnMut(&mut Self) -> Option<T>) -> T {
        let start = Instant::now();
        loop {
            if let Some(answer) = ask(self) {
                return answer;
            }
            if start.elapsed() > PATIENCE {
                let (shown, mirror, problems) = (self.shown(), self.mirror(), self.problems());
                let far = if shown == "loading" { self.text("#loading-text") } else { String::new() };
                panic!("waited in vain for {what}\nshown: {shown} {far}\nmirror: {mirror}\nconsole: {problems:#?}");
            }
            thread::sleep(Duration::from_millis(50));
        }
    }

    /// Evaluates JavaScript, awaiting promises.
    #[track_caller]
    pub fn eval(&mut self, script: &str) -> Value {
        let chromium = match &mut self.browser {
            Browser::Chromium(chromium) => chromium,
            Browser::Driven(driven) => return driven.eval(script),
        };
        let parameters = json!({ "expression": script, "returnByValue": true, "awaitPromise": true });
        let mut result = chromium.evaluate(&parameters);
        if let Some(exception) = result.get("exceptionDetails") {
            panic!("{script}: {exception}");
        }
        result["result"]["value"].take()
    }

    /// Runs this script at the start of every page visited from now on.
    pub fn before_scripts(&mut self, script: &str) {
        self.chromium().call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": script }));
    }

    /// Answers every request for a file of this name with `status` from now on.
    pub fn block(&mut self, file: &str, status: u16) {
        self.chromium().block = Some(status);
        // What keeps the page for when there is no network would hand out what it has.
        self.chromium().call("Network.enable", json!({}));
        self.chromium().call("Network.setBypassServiceWorker", json!({ "bypass": true }));
        self.chromium().call("Fetch.enable", json!({ "patterns": [{ "urlPattern": format!("*/{file}") }] }));
    }

    /// Which face the page shows: `loading`, `running`, `no-gpu` or `failed`.
    pub fn shown(&mut self) -> String {
        let page = self.eval("document.documentElement?.dataset.page ?? ''");
        page.as_str().unwrap_or_default().to_owned()
    }

    /// The visible text of the first element that `selector` finds.
    pub fn text(&mut self, selector: &str) -> String {
        let script = format!("document.querySelector({})?.innerText ?? ''", json!(selector));
        self.eval(&script).as_str().unwrap_or_default().to_owned()
    }

    /// The mirror's attribute `data-key`, written in camel case (`detectionTime`).
    pub fn data(&mut self, key: &str) -> Option<String> {
        self.mirror()[key].as_str().map(str::to_owned)
    }

    /// The mirror's attribute as a number.
    pub fn number(&mut self, key: &str) -> Option<f64> {
        self.data(key)?.parse().ok()
    }

    /// All of the mirror's attributes.
    pub fn mirror(&mut self) -> Value {
        self.eval("({ ...document.getElementById('mirror')?.dataset })")
    }

    /// All widgets. The page must have been opened with `?test`.
    #[track_caller]
    pub fn widgets(&mut self) -> Vec<Widget> {
        let json = self.eval(WIDGETS);
        serde_json::from_str(json.as_str().unwrap_or_default()).expect("a list of widgets")
    }

    /// The widget of this role and name; waits until it is there.
    #[track_caller]
    pub fn widget(&mut self, role: &str, label: &str) -> Widget {
        self.wait(&format!("a {role} named {label:?}"), |page| {
            let mut widgets = page.widgets().into_iter();
            widgets.find(|widget| widget.role == role && widget.label == label)
        })
    }

    /// Waits for the next two frames, in which the interface has taken in what was done.
    pub fn frames(&mut self) {
        let frames = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))";
        if let Browser::Chromium(_) = self.browser {
            self.eval(frames);
        } else {
            // Firefox drops a frame that was asked for just as a canvas on WebGPU went; who waits for a state asks again anyway.
            self.eval(&format!("Promise.race([{frames}, new Promise(done => setTimeout(done, 3000, 0))])"));
        }
    }

    /// What the page looks like now, in device pixels.
    pub fn picture(&mut self) -> Picture {
        Picture::decode(&self.png())
    }

    /// What the page looks like now, as a PNG file.
    pub fn png(&mut self) -> Vec<u8> {
        let chromium = match &mut self.browser {
            Browser::Chromium(chromium) => chromium,
            Browser::Driven(driven) => return driven.png(),
        };
        let shot = chromium.call("Page.captureScreenshot", json!({ "format": "png" }));
        let data = shot["data"].as_str().unwrap_or_default();
        let engine = base64::engine::general_purpose::STANDARD;
        engine.decode(data).expect("the browser sends base64")
    }

    /// Errors that the console has shown so far, and exceptions that nobody caught.
    pub fn problems(&mut self) -> Vec<String> {
        match &mut self.browser {
            Browser::Chromium(chromium) => {
                chromium.listen();
                chromium.events.iter().filter_map(problem).collect()
            }
            // What `host::heard` has put into the page listens.
            Browser::Driven(driven) => {
                serde_json::from_value(driven.eval("globalThis.problems ?? []")).expect("a list of texts")
            }
        }
    }
}

impl Widget {
    /// A place inside, at this fraction of the width and half the height.
    #[track_caller]
    pub fn at(&self, fraction: f64) -> [f64; 2] {
        let [x, y, width, height] = self.bounds.expect("a widget that can be seen");
        [x + fraction * width, y + height / 2.0]
    }
}

fn problem(event: &Value) -> Option<String> {
    let parameters = &event["params"];
    match event["method"].as_str()? {
        "Runtime.exceptionThrown" => Some(parameters["exceptionDetails"].to_string()),
        "Runtime.consoleAPICalled" if matches!(parameters["type"].as_str(), Some("error" | "assert")) => {
            let words = parameters["args"].as_array()?.iter();
            let words = words.map(|arg| arg["value"].as_str().map_or(arg.to_string(), str::to_owned));
            Some(words.collect::<Vec<_>>().join(" "))
        }
        "Log.entryAdded" if parameters["entry"]["level"] == "error" => Some(parameters["entry"].to_string()),
        _ => None,
    }
}
