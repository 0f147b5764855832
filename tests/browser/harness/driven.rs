//! A browser that is not Chromium, on a screen of its own, driven by WebDriver's commands.
//!
//! Neither Firefox nor WebKit draws with WebGL when headless, so each gets an X server (Xvfb), which draws in software.

use super::chromium::Renderer;
use super::wire::{Command as Do, Wire};
use base64::Engine as _;
use serde_json::{Value, json};
use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// A browser that takes longer to start does not start.
const START: Duration = Duration::from_secs(60);

/// WebDriver's character for it.
const CONTROL: &str = "\u{E009}";

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

/// How often a browser may fail to start before that is a failure: a busy machine starts one too late, or has given its port away.
const STARTS: usize = 3;

/// A running browser with one window.
pub struct Driven {
    wire: Wire,
    processes: Processes,
}

/// What runs for a browser, and the folder of what it writes: both go with it.
struct Processes {
    list: Vec<Child>,
    folder: PathBuf,
}

impl Driven {
    /// Starts a browser that keeps nothing of earlier ones.
    pub fn start(engine: Engine, renderer: Renderer) -> Self {
        let mut errors = Vec::new();
        while errors.len() < STARTS {
            match Self::begun(engine, renderer) {
                Ok(driven) => return driven,
                Err(error) => errors.push(error),
            }
        }
        panic!("{engine:?} does not start: {errors:#?}");
    }

    fn begun(engine: Engine, renderer: Renderer) -> Result<Self, String> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("centrode-{engine:?}-{}-{count}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder for the browser");
        let mut processes = Processes { list: Vec::new(), folder: folder.clone() };
        let display = screen(&mut processes)?;
        let wire = match engine {
            Engine::Firefox => {
                processes.list.push(firefox(&folder, &display, renderer));
                let port = announced(&mut processes)?;
                Wire::socket(port).map_err(|error| format!("its socket: {error}"))
            }
            Engine::WebKit => {
                let port = free_port();
                processes.list.push(webkit(&folder, &display, port));
                listens(&mut processes, port).map(|()| Wire::http(port))
            }
        };
        let begun = wire.and_then(|mut wire| wire.begin(&capabilities(engine, renderer)).map(|()| wire));
        match begun {
            Ok(wire) => Ok(Self { wire, processes }),
            Err(error) => Err(format!("{error}\n{}", log(&folder))),
        }
    }

    #[track_caller]
    fn call(&mut self, command: Do, parameters: Value) -> Value {
        self.wire
            .call(command, parameters)
            .unwrap_or_else(|error| panic!("{command:?}: {error}\n{}", log(&self.processes.folder)))
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
                Err(error) if start.elapsed() > START => panic!("{script}: {error}\n{}", log(&self.processes.folder)),
                Err(error) if is_between_pages(&error) => thread::sleep(Duration::from_millis(50)),
                Err(error) => panic!("{script}: {error}\n{}", log(&self.processes.folder)),
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

    /// Selects all of the text that the keyboard is in.
    #[track_caller]
    pub fn select_all(&mut self) {
        let actions: Vec<Value> = [("keyDown", CONTROL), ("keyDown", "a"), ("keyUp", "a"), ("keyUp", CONTROL)]
            .map(|(what, key)| json!({ "type": what, "value": key }))
            .into();
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
    }
}

impl Processes {
    /// Waits until the last one is ready, as `ask` says, unless it ends before or takes too long.
    fn wait<T>(&mut self, what: &str, mut ask: impl FnMut(&Path) -> Option<T>) -> Result<T, String> {
        let start = Instant::now();
        loop {
            if let Some(answer) = ask(&self.folder) {
                return Ok(answer);
            }
            let ended = self.list.last_mut().and_then(|process| process.try_wait().ok().flatten());
            if let Some(status) = ended {
                return Err(format!("{what}: it ended with {status}\n{}", log(&self.folder)));
            }
            if start.elapsed() > START {
                return Err(format!("{what}: waited in vain\n{}", log(&self.folder)));
            }
            thread::sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Processes {
    fn drop(&mut self) {
        // The browser before the screen that it draws on.
        for process in self.list.iter_mut().rev() {
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

/// Starts a screen in memory, and gives its name.
fn screen(processes: &mut Processes) -> Result<String, String> {
    let mut server = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", "1600x1100x24", "+extension", "GLX", "-nolisten", "tcp"])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap_or_else(|error| panic!("cannot start Xvfb: {error}"));
    let said = server.stdout.take().expect("piped");
    processes.list.push(server);
    let mut name = String::new();
    match BufReader::new(said).read_line(&mut name) {
        Ok(length) if length > 0 => Ok(format!(":{}", name.trim())),
        // Two that start at once may both want one number.
        other => Err(format!("Xvfb names no screen: {other:?}")),
    }
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
fn announced(processes: &mut Processes) -> Result<u16, String> {
    processes.wait("Firefox listens", |folder| {
        fs::read_to_string(folder.join("MarionetteActivePort")).unwrap_or_default().trim().parse().ok()
    })
}

fn webkit(folder: &Path, display: &str, port: u16) -> Child {
    let program = std::env::var("CENTRODE_WEBKIT").unwrap_or_else(|_| "WebKitWebDriver".into());
    on_screen(&program, display, folder)
        .args(["--host=127.0.0.1", &format!("--port={port}")])
        .spawn()
        .unwrap_or_else(|error| panic!("cannot start {program}: {error}"))
}

fn listens(processes: &mut Processes, port: u16) -> Result<(), String> {
    processes.wait("the driver listens", |_| TcpStream::connect(("127.0.0.1", port)).ok().map(drop))
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
