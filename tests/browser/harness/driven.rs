//! A browser that is not Chromium, on a screen of its own, driven by WebDriver's commands.
//!
//! Neither Firefox nor WebKit draws with WebGL when headless, so each gets an X server (Xvfb), which draws in software.

use super::chromium::Renderer;
use super::wire::{Command as Do, Wire};
use base64::Engine as _;
use serde_json::{Value, json};
use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// A browser that takes longer to start does not start.
const START: Duration = Duration::from_secs(60);

/// Whose browser it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Engine {
    /// Mozilla's, in Firefox.
    Firefox,
    /// WebKitGTK's, in its MiniBrowser.
    WebKit,
}

/// Firefox as nobody has set it, without what it asks and fetches by itself.
const FIREFOX: &str = "user_pref('marionette.port', 0);\n\
    user_pref('app.normandy.enabled', false);\n\
    user_pref('app.update.disabledForTesting', true);\n\
    user_pref('browser.aboutwelcome.enabled', false);\n\
    user_pref('browser.shell.checkDefaultBrowser', false);\n\
    user_pref('browser.startup.homepage_override.mstone', 'ignore');\n\
    user_pref('datareporting.policy.dataSubmissionEnabled', false);\n";

/// A running browser with one window.
pub struct Driven {
    wire: Wire,
    processes: Vec<Child>,
    folder: PathBuf,
}

impl Driven {
    /// Starts a browser that keeps nothing of earlier ones.
    pub fn start(engine: Engine, renderer: Renderer) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("centrode-{engine:?}-{}-{count}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder for the browser");
        let (screen, display) = screen();
        let mut processes = vec![screen];
        let mut wire = match engine {
            Engine::Firefox => {
                processes.push(firefox(&folder, &display, renderer));
                Wire::socket(announced(&folder)).expect("Firefox listens")
            }
            Engine::WebKit => {
                let port = free_port();
                processes.push(webkit(&folder, &display, port));
                Wire::http(port)
            }
        };
        let capabilities = capabilities(engine, renderer);
        wire.begin(&capabilities)
            .unwrap_or_else(|error| panic!("{engine:?} does not start: {error}\n{}", log(&folder)));
        Self { wire, processes, folder }
    }

    #[track_caller]
    fn call(&mut self, command: Do, parameters: Value) -> Value {
        self.wire
            .call(command, parameters)
            .unwrap_or_else(|error| panic!("{command:?}: {error}\n{}", log(&self.folder)))
    }

    /// Goes to an address and waits for nothing.
    #[track_caller]
    pub fn go(&mut self, address: &str) {
        self.call(Do::Go, json!({ "url": address }));
    }

    /// Evaluates an expression, awaiting promises. Where one page gives way to the next just then, the next is asked.
    #[track_caller]
    pub fn eval(&mut self, script: &str) -> Value {
        let script = format!(
            "const done = arguments[arguments.length - 1]; \
             (async () => (\n{script}\n))().then((value) => done({{ value }}), (error) => done({{ error: String(error?.stack ?? error) }}))"
        );
        let start = Instant::now();
        let mut answer = loop {
            match self.wire.call(Do::Run, json!({ "script": script, "args": [] })) {
                Ok(answer) => break answer,
                Err(error) if start.elapsed() > START => panic!("{script}: {error}\n{}", log(&self.folder)),
                Err(error) if is_between_pages(&error) => thread::sleep(Duration::from_millis(50)),
                Err(error) => panic!("{script}: {error}\n{}", log(&self.folder)),
            }
        };
        assert!(answer["error"].is_null(), "{script}: {}", answer["error"]);
        answer["value"].take()
    }

    /// What a mouse does, one thing after the other.
    #[track_caller]
    pub fn mouse(&mut self, actions: &[Value]) {
        let source =
            json!({ "type": "pointer", "id": "mouse", "parameters": { "pointerType": "mouse" }, "actions": actions });
        self.call(Do::Act, json!({ "actions": [source] }));
    }

    /// Presses and releases keys, each a character of WebDriver's.
    #[track_caller]
    pub fn keys(&mut self, keys: impl IntoIterator<Item = String>) {
        let stroke =
            |key: String| [json!({ "type": "keyDown", "value": key }), json!({ "type": "keyUp", "value": key })];
        let actions: Vec<Value> = keys.into_iter().flat_map(stroke).collect();
        self.call(Do::Act, json!({ "actions": [{ "type": "key", "id": "keyboard", "actions": actions }] }));
    }

    /// Gives the page a size, in CSS pixels.
    #[track_caller]
    pub fn resize(&mut self, size: [u32; 2]) {
        // The window is larger than the page by its bars.
        let bars = self.eval("[outerWidth - innerWidth, outerHeight - innerHeight]");
        let [w, h] = [0, 1].map(|i| f64::from(size[i]) + bars[i].as_f64().unwrap_or_default());
        self.call(Do::Place, json!({ "x": 0, "y": 0, "width": w, "height": h }));
    }

    /// What the page looks like now, as a PNG file.
    #[track_caller]
    pub fn png(&mut self) -> Vec<u8> {
        let shot = self.call(Do::Shoot, json!({ "full": false, "hash": false }));
        let engine = base64::engine::general_purpose::STANDARD;
        engine.decode(shot.as_str().unwrap_or_default()).expect("the browser sends base64")
    }
}

impl Drop for Driven {
    fn drop(&mut self) {
        self.wire.call(Do::End, json!({})).ok();
        // The browser before the screen that it draws on.
        for process in self.processes.iter_mut().rev() {
            Command::new("kill").arg(process.id().to_string()).status().ok();
            let start = Instant::now();
            while process.try_wait().is_ok_and(|status| status.is_none()) && start.elapsed() < Duration::from_secs(10) {
                thread::sleep(Duration::from_millis(20));
            }
            process.kill().ok();
            process.wait().ok();
        }
        fs::remove_dir_all(&self.folder).ok();
    }
}

fn is_between_pages(error: &str) -> bool {
    ["javascript error: Document was unloaded", "no such window", "no such frame", "unknown error"]
        .iter()
        .any(|words| error.starts_with(words))
}

/// A screen in memory, and its name.
fn screen() -> (Child, String) {
    let mut server = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", "1600x1100x24", "+extension", "GLX", "-nolisten", "tcp"])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap_or_else(|error| panic!("cannot start Xvfb: {error}"));
    let mut name = String::new();
    BufReader::new(server.stdout.take().expect("piped")).read_line(&mut name).expect("Xvfb names its screen");
    (server, format!(":{}", name.trim()))
}

/// A program on a screen, with its words in the log of `folder`.
fn on_screen(program: &str, display: &str, folder: &Path) -> Command {
    let log = File::create(folder.join("browser.log")).expect("the browser's log");
    let mut command = Command::new(program);
    command
        .env("DISPLAY", display)
        // Nobody else on this machine is to be talked with.
        .envs([("DBUS_SESSION_BUS_ADDRESS", "disabled:"), ("NO_AT_BRIDGE", "1"), ("MOZ_CRASHREPORTER_DISABLE", "1")])
        .stdin(Stdio::null())
        .stdout(log.try_clone().expect("the same log"))
        .stderr(log);
    command
}

fn firefox(folder: &Path, display: &str, renderer: Renderer) -> Child {
    let choice = match renderer {
        Renderer::WebGpu => "user_pref('dom.webgpu.enabled', true);\nuser_pref('gfx.webgpu.ignore-blocklist', true);\n",
        Renderer::Neither => "user_pref('webgl.disabled', true);\n",
        Renderer::WebGl | Renderer::Both => "",
    };
    fs::write(folder.join("user.js"), format!("{FIREFOX}{choice}")).expect("the browser's settings");
    let program = std::env::var("CENTRODE_FIREFOX").unwrap_or_else(|_| "firefox-esr".into());
    on_screen(&program, display, folder)
        .args(["--marionette", "--no-remote", "--profile"])
        .arg(folder)
        .arg("about:blank")
        .spawn()
        .unwrap_or_else(|error| panic!("cannot start {program}: {error}"))
}

/// The port that Firefox writes into its profile once it listens there.
fn announced(folder: &Path) -> u16 {
    let start = Instant::now();
    loop {
        let text = fs::read_to_string(folder.join("MarionetteActivePort")).unwrap_or_default();
        if let Ok(port) = text.trim().parse() {
            return port;
        }
        assert!(start.elapsed() < START, "Firefox does not listen\n{}", log(folder));
        thread::sleep(Duration::from_millis(20));
    }
}

fn webkit(folder: &Path, display: &str, port: u16) -> Child {
    let program = std::env::var("CENTRODE_WEBKIT").unwrap_or_else(|_| "WebKitWebDriver".into());
    let driver = on_screen(&program, display, folder)
        .args(["--host=127.0.0.1", &format!("--port={port}")])
        .spawn()
        .unwrap_or_else(|error| panic!("cannot start {program}: {error}"));
    let start = Instant::now();
    while std::net::TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(start.elapsed() < START, "{program} does not listen\n{}", log(folder));
        thread::sleep(Duration::from_millis(20));
    }
    driver
}

fn free_port() -> u16 {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    listener.local_addr().expect("an address").port()
}

fn capabilities(engine: Engine, renderer: Renderer) -> Value {
    let mut wanted = json!({ "pageLoadStrategy": "none", "timeouts": { "script": 120_000, "pageLoad": 120_000 } });
    if engine == Engine::WebKit {
        let arguments = match renderer {
            Renderer::Neither => vec!["--automation", "--features=-webgl"],
            _ => vec!["--automation"],
        };
        wanted["webkitgtk:browserOptions"] = json!({ "args": arguments });
    }
    wanted
}

/// The last lines that the browser wrote about itself.
fn log(folder: &Path) -> String {
    let text = fs::read(folder.join("browser.log")).unwrap_or_default();
    let text = String::from_utf8_lossy(&text).into_owned();
    let lines: Vec<&str> = text.lines().collect();
    lines[lines.len().saturating_sub(20)..].join("\n")
}
