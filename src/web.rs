//! The shell in the browser: starts the interface on a canvas and tells the page what happens.
//!
//! The page (`index.html` and `web/loader.js`) owns the document; this file only calls the hooks that it was given.
//! Nothing starts by itself: a worker may import the same module and use the exported functions alone.

mod logs;
mod messages;
mod mirror;
mod outside;
mod widgets;
mod worker;

use crate::app::embed::Embed;
use crate::app::helper::Helper;
use crate::app::widgets::finger;
use crate::app::{App, Host};
use centrode_core::run::simulate;
use centrode_core::scenario::Scenario;
use centrode_core::scenario::link::Link;
use eframe::wgpu;
use std::cell::{Cell, RefCell};
use std::sync::Arc;
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

#[wasm_bindgen]
extern "C" {
    /// How to start, an object `{ reducedMotion, test, worker, address, fragment, embed, progress, hosted }`.
    pub type Options;
    /// The person asked for less motion.
    #[wasm_bindgen(method, getter, js_name = reducedMotion)]
    fn reduced_motion(this: &Options) -> bool;
    /// Opened by a test: keep the list of widgets and obey [`fail_on_purpose`].
    #[wasm_bindgen(method, getter)]
    fn test(this: &Options) -> bool;
    /// Whether studies are made in a worker.
    #[wasm_bindgen(method, getter)]
    fn worker(this: &Options) -> bool;
    /// The page's address, without its fragment.
    #[wasm_bindgen(method, getter)]
    fn address(this: &Options) -> String;
    /// The fragment of the address, without `#`.
    #[wasm_bindgen(method, getter)]
    fn fragment(this: &Options) -> String;
    /// What of the page is shown, by the name of an `app::embed::Embed`; anything else for all of it.
    #[wasm_bindgen(method, getter)]
    fn embed(this: &Options) -> String;
    /// How far the person had come in the lessons; undefined where that cannot be kept.
    #[wasm_bindgen(method, getter)]
    fn progress(this: &Options) -> Option<String>;
    /// Whether a host page listens to [`Hooks::post`].
    #[wasm_bindgen(method, getter)]
    fn hosted(this: &Options) -> bool;

    /// What the page wants to hear of.
    pub type Hooks;
    /// The state changed; `json` is `App::report`.
    #[wasm_bindgen(method)]
    fn report(this: &Hooks, json: &str);
    /// A study is wanted from the worker (JSON), or none any more.
    #[wasm_bindgen(method)]
    fn study(this: &Hooks, request: Option<String>);
    /// Another worker is to take the place of the one that makes studies; whether one does.
    #[wasm_bindgen(method, js_name = replaceWorker)]
    fn replace_worker(this: &Hooks) -> bool;
    /// The address has this fragment from now on; whether one can go back to what was before.
    #[wasm_bindgen(method)]
    fn address(this: &Hooks, fragment: &str, step: bool);
    /// A file of a kind (as MIME has it) is to be saved.
    #[wasm_bindgen(method)]
    fn save(this: &Hooks, name: &str, kind: &str, bytes: &[u8]);
    /// An SVG is to be saved as PNG, `scale` pixels to a point, with both weights of the page's font; see [`outside::save_failed`].
    #[wasm_bindgen(method)]
    fn picture(this: &Hooks, name: &str, svg: &str, scale: u32, regular: &[u8], strong: &[u8]);
    /// A picture is to be saved as PNG: rows from the top, red, green, blue and alpha of each pixel.
    #[wasm_bindgen(method)]
    fn pixels(this: &Hooks, name: &str, width: u32, height: u32, rgba: &[u8]);
    /// How far the person has come in the lessons is to be kept; see [`outside::progress_not_kept`].
    #[wasm_bindgen(method)]
    fn keep(this: &Hooks, progress: &str);
    /// A page at this address, from this one, is to be opened in a tab of its own.
    #[wasm_bindgen(method)]
    fn open(this: &Hooks, page: &str);
    /// The person is to choose a file, see [`outside::file_opened`].
    #[wasm_bindgen(method)]
    fn choose(this: &Hooks);
    /// The host page is to be told this, JSON.
    #[wasm_bindgen(method)]
    fn post(this: &Hooks, json: &str);
    /// The person is to choose a log, see [`logs::log_chosen`].
    #[wasm_bindgen(method, js_name = chooseLog)]
    fn choose_log(this: &Hooks);
    /// A log is to be read by the worker (JSON), or none any more.
    #[wasm_bindgen(method, js_name = readLog)]
    fn read_log(this: &Hooks, request: Option<String>);
    /// The bytes of a log are wanted, see [`logs::log_fetched`].
    #[wasm_bindgen(method, js_name = fetchLog)]
    fn fetch_log(this: &Hooks, number: u32);
    /// The elements that stand for the interface; `json` is an `app::mirror::Mirror`.
    #[wasm_bindgen(method)]
    fn mirror(this: &Hooks, json: &str);
    /// The program panicked and will not go on.
    #[wasm_bindgen(method)]
    fn panicked(this: &Hooks, message: &str);
    /// The graphics device is gone and will not come back: [`set_aside`], and [`start`] on a fresh canvas.
    #[wasm_bindgen(method)]
    fn lost(this: &Hooks, message: &str);
}

/// The longest press that is a click in a page opened by a test, s.
const TEST_CLICK: f64 = 600.0;

/// The interface while nothing draws it, with what egui remembers of it.
type Aside = (App, egui::Memory);

thread_local! {
    static ASIDE: RefCell<Option<Aside>> = const { RefCell::new(None) };
    /// Which device draws, counted from the first: what is heard of an earlier one is of no concern.
    static DEVICE: Cell<u32> = const { Cell::new(0) };
    static RUNNER: RefCell<Option<eframe::WebRunner>> = const { RefCell::new(None) };
    static HOOKS: RefCell<Option<Hooks>> = const { RefCell::new(None) };
    static TEST: Cell<bool> = const { Cell::new(false) };
    static FAIL: Cell<bool> = const { Cell::new(false) };
    /// For a test: the scenario of the run that is shown, and the run's fingerprint.
    static SHOWN: RefCell<Option<(Scenario, u64)>> = const { RefCell::new(None) };
    static CONTEXT: RefCell<Option<egui::Context>> = const { RefCell::new(None) };
}

fn with_hooks(call: impl FnOnce(&Hooks)) {
    // A panic inside a hook must not lead to a second panic here.
    HOOKS.with(|hooks| {
        if let Ok(hooks) = hooks.try_borrow()
            && let Some(hooks) = hooks.as_ref()
        {
            call(hooks);
        }
    });
}

/// Starts the interface on `canvas`, drawing with WebGPU or what stands in its place (`web/webgl.js`).
///
/// # Errors
/// Rejects with a message when that cannot be had. The canvas may then be bound to a context already: try again on a fresh one.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement, options: Options, hooks: Hooks) -> Result<(), JsValue> {
    HOOKS.set(Some(hooks));
    let runner = RUNNER.with_borrow_mut(|runner| runner.get_or_insert_with(install).clone());
    let helper = options.worker().then(|| Box::new(worker::Worker) as Box<dyn Helper>);
    let log_helper = options.worker().then(|| Box::new(logs::Clerk) as Box<dyn Helper>);
    let host = Host {
        log_helper,
        prefers_reduced_motion: options.reduced_motion(),
        helper,
        address: options.address(),
        fragment: options.fragment(),
        embed: Embed::named(&options.embed()),
        hosted: options.hosted(),
        progress: options.progress(),
    };
    let test = options.test();
    let create = move |cc: &eframe::CreationContext<'_>| {
        cc.egui_ctx.enable_accesskit();
        cc.egui_ctx.add_plugin(mirror::Plugin::default());
        CONTEXT.set(Some(cc.egui_ctx.clone()));
        TEST.set(test);
        if let Some(state) = &cc.wgpu_render_state {
            watch(state);
        }
        let app = match ASIDE.take() {
            Some(aside) => taken_up(aside, cc),
            None => App::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), host),
        };
        if TEST.get() {
            // On a busy machine a frame may come between press and release that takes longer than any hand.
            cc.egui_ctx.options_mut(|options| options.input_options.max_click_duration = TEST_CLICK);
        }
        Ok(Box::new(Shell { app: Some(app), last_report: String::new() }) as Box<dyn eframe::App>)
    };
    runner.start(canvas, web_options(), Box::new(create)).await
}

/// The interface that was set aside, as it was.
fn taken_up((mut app, memory): Aside, cc: &eframe::CreationContext<'_>) -> App {
    cc.egui_ctx.memory_mut(|fresh| *fresh = memory);
    app.go_on_in(&cc.egui_ctx, cc.wgpu_render_state.as_ref());
    app
}

/// Puts the interface aside, for what draws it is gone. The next [`start`] shows it again as it was.
#[wasm_bindgen]
pub fn set_aside() {
    DEVICE.set(DEVICE.get() + 1);
    let Some(runner) = RUNNER.with_borrow(Clone::clone) else { return };
    let app = runner.app_mut::<Shell>().and_then(|mut shell| shell.app.take());
    let memory = CONTEXT.with_borrow(|ctx| ctx.as_ref().map(|ctx| ctx.memory(Clone::clone)));
    if let Some(aside) = app.zip(memory) {
        ASIDE.set(Some(aside));
    }
    CONTEXT.set(None);
    runner.destroy();
}

/// Panics to the page, log lines to the console. Once per page.
fn install() -> eframe::WebRunner {
    std::panic::set_hook(Box::new(|info| {
        let message = info.to_string();
        with_hooks(|hooks| hooks.panicked(&message));
    }));
    // Fails only when a logger is there already, which is as good.
    let _ = eframe::WebLogger::init(log::LevelFilter::Warn);
    eframe::WebRunner::new()
}

fn web_options() -> eframe::WebOptions {
    let mut setup = egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    // In a page that is not secure, too, where the browser has no WebGPU and `web/webgl.js` is in its place.
    setup.instance_descriptor.backends = wgpu::Backends::BROWSER_WEBGPU;
    setup.device_descriptor = Arc::new(|adapter| wgpu::DeviceDescriptor {
        label: Some("centrode device"),
        // What WebGL2 gives everywhere, with the textures as large as this device allows:
        // eframe's fixed 8192 is refused by some phones.
        required_limits: wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits()),
        ..Default::default()
    });
    eframe::WebOptions {
        wgpu_options: egui_wgpu::WgpuConfiguration { wgpu_setup: setup.into(), ..Default::default() },
        ..Default::default()
    }
}

/// Listens for the end of the device and for its late errors.
fn watch(state: &egui_wgpu::RenderState) {
    let device = DEVICE.get();
    state.device.set_device_lost_callback(move |_, message| {
        if DEVICE.get() == device {
            with_hooks(|hooks| hooks.lost(&message));
        }
    });
    state.device.on_uncaptured_error(Arc::new(|error| log::error!("WebGPU: {error}")));
}

/// Whether the interface is on a canvas.
#[wasm_bindgen]
#[must_use]
pub fn is_drawing() -> bool {
    CONTEXT.with_borrow(Option::is_some)
}

/// Asks for another frame.
fn repaint() {
    CONTEXT.with_borrow(|ctx| {
        if let Some(ctx) = ctx {
            ctx.request_repaint();
        }
    });
}

/// Paints the page once more.
#[wasm_bindgen]
pub fn paint() {
    repaint();
}

struct Shell {
    /// None once it was set aside.
    app: Option<App>,
    last_report: String,
}

impl eframe::App for Shell {
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(&mut *self)
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        assert!(!FAIL.get(), "a test asked for this panic");
        let Some(app) = &mut self.app else { return };
        outside::take_in(app);
        logs::take_in(app);
        app.ui(ui);
        app.take_effects().into_iter().for_each(outside::hand_out);
        if TEST.get() {
            remember(app);
        }
        let report = app.report();
        if report != self.last_report {
            with_hooks(|hooks| hooks.report(&report));
            self.last_report = report;
        }
    }
}

/// Keeps the fingerprint of the run that is shown.
fn remember(app: &App) {
    SHOWN.with_borrow_mut(|shown| {
        let run = app.run();
        if shown.as_ref().is_none_or(|(scenario, _)| scenario != run.plan.scenario()) {
            *shown = Some((run.plan.scenario().clone(), run.fingerprint()));
        }
    });
}

/// The version of the program.
#[wasm_bindgen]
#[must_use]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// Whether a finger that comes down at a place of the canvas, CSS pixels from its corner, is for what the page shows there, whichever
/// way it goes. Elsewhere the page around a frame may scroll.
#[wasm_bindgen]
#[must_use]
pub fn wants_finger(x: f32, y: f32) -> bool {
    CONTEXT.with_borrow(|ctx| {
        ctx.as_ref().is_some_and(|ctx| finger::is_claimed(ctx, egui::pos2(x, y) / ctx.zoom_factor()))
    })
}

/// Every widget on the page as a JSON array, see [`widgets::to_json`]; `pixel` is how wide a pixel of the canvas is shown, CSS pixels. Empty
/// unless opened by a test.
#[wasm_bindgen]
pub fn widgets(pixel: f64) -> String {
    widgets::to_json(pixel)
}

/// Panics in the next frame, so that a test can see what a person would. Does nothing unless opened by a test.
#[wasm_bindgen]
pub fn fail_on_purpose() {
    if TEST.get() {
        FAIL.set(true);
        repaint();
    }
}

/// A hash of every channel of the run that this scenario (TOML) gives, to be compared with the native one.
/// An invalid scenario gives its error message instead.
#[wasm_bindgen]
#[must_use]
pub fn fingerprint(scenario_toml: &str) -> String {
    match Scenario::from_toml(scenario_toml).and_then(|scenario| simulate(&scenario)) {
        Ok(run) => format!("{:016x}", run.fingerprint()),
        Err(error) => error.to_string(),
    }
}

/// The same of the scenario of a link. A link that cannot be read whole gives what is wrong with it instead.
#[wasm_bindgen]
#[must_use]
pub fn link_fingerprint(link: &str) -> String {
    let (link, broken) = Link::read(link);
    match broken.first() {
        Some(broken) => broken.to_string(),
        None => fingerprint(&link.scenario().to_toml()),
    }
}

/// The hash of every channel of the run that the page shows. Empty unless opened by a test.
#[wasm_bindgen]
#[must_use]
pub fn shown_fingerprint() -> String {
    SHOWN.with_borrow(|shown| shown.as_ref().map_or_else(String::new, |(_, hash)| format!("{hash:016x}")))
}

/// The hashes of [`centrode_core::fingerprints`] as a JSON object, to be compared with the stored ones.
#[wasm_bindgen]
#[must_use]
pub fn fingerprints() -> String {
    match centrode_core::fingerprints::fingerprints() {
        Ok(all) => serde_json::json!(all).to_string(),
        Err(error) => error.to_string(),
    }
}
