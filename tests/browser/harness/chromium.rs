//! One Chromium process and its DevTools connection.
//!
//! The connection is a pair of pipes (`--remote-debugging-pipe`: the browser reads descriptor 3 and writes 4), so there is no
//! port to find, and the browser ends when this process does.

use serde_json::{Value, json};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// An answer that takes longer than this will not come.
const ANSWER: Duration = Duration::from_secs(120);

/// What the browser can draw with, all in software.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Renderer {
    /// WebGL 2 alone.
    WebGl,
    /// WebGPU alone.
    WebGpu,
    /// WebGPU and WebGL 2, to see which is taken. In this mix the software WebGPU soon loses its device, so draw with WebGL.
    Both,
    /// Nothing.
    Neither,
}

impl Renderer {
    fn flags(self) -> &'static [&'static str] {
        match self {
            Self::WebGl => &["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
            Self::WebGpu => &[
                "--enable-unsafe-webgpu",
                "--use-webgpu-adapter=swiftshader",
                "--enable-features=Vulkan",
                "--use-vulkan=swiftshader",
                "--use-angle=vulkan",
            ],
            Self::Both => &[
                "--enable-unsafe-webgpu",
                "--use-webgpu-adapter=swiftshader",
                "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader",
            ],
            Self::Neither => &["--disable-gpu", "--disable-software-rasterizer"],
        }
    }
}

/// A running browser with one page attached.
pub struct Chromium {
    process: Child,
    input: ChildStdin,
    messages: Receiver<Value>,
    /// Messages of the browser that answer no call, in order.
    pub events: Vec<Value>,
    /// The status with which requests that were paused by `Fetch` are answered.
    pub block: Option<u16>,
    profile: PathBuf,
    last_id: u64,
    session: Option<String>,
}

impl Chromium {
    /// Starts a browser that has an empty profile of its own. `scale`: device pixels per CSS pixel.
    pub fn start(renderer: Renderer, scale: f64) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let profile = std::env::temp_dir().join(format!(
            "centrode-browser-{}-{}",
            std::process::id(),
            COUNT.fetch_add(1, Ordering::Relaxed)
        ));
        std::fs::create_dir_all(&profile).expect("a folder for the browser's profile");
        let log = File::create(profile.join("stderr.log")).expect("the browser's log");
        let browser = std::env::var("CENTRODE_BROWSER").unwrap_or_else(|_| "chromium".into());
        let mut process = Command::new("sh")
            // The shell gives the two pipes the numbers that the browser expects.
            .args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 </dev/null 1>&2", &browser])
            .args(["--headless", "--remote-debugging-pipe", "--no-sandbox", "--disable-quic", "--no-first-run"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .args(["--disable-dev-shm-usage", "--hide-scrollbars", "--force-color-profile=srgb"])
            .args(["--disable-renderer-backgrounding", "--disable-backgrounding-occluded-windows"])
            // Another machine, for all that the browser knows.
            .arg("--host-resolver-rules=MAP page.test 127.0.0.1")
            .args(renderer.flags())
            .arg(format!("--force-device-scale-factor={scale}"))
            .arg(format!("--user-data-dir={}", profile.display()))
            .arg("about:blank")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(log)
            .spawn()
            .unwrap_or_else(|error| panic!("cannot start {browser}: {error}"));
        let input = process.stdin.take().expect("piped");
        let output = process.stdout.take().expect("piped");
        let (sender, messages) = channel();
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            let mut bytes = Vec::new();
            while output.read_until(0, &mut bytes).is_ok_and(|count| count > 0) {
                bytes.pop();
                if let Ok(message) = serde_json::from_slice(&bytes)
                    && sender.send(message).is_err()
                {
                    break;
                }
                bytes.clear();
            }
        });
        let mut chromium =
            Self { process, input, messages, events: Vec::new(), block: None, profile, last_id: 0, session: None };
        chromium.attach();
        chromium
    }

    fn attach(&mut self) {
        let start = Instant::now();
        let target = loop {
            let targets = self.call("Target.getTargets", json!({}));
            let pages = targets["targetInfos"].as_array().into_iter().flatten();
            if let Some(page) = pages.into_iter().find(|target| target["type"] == "page") {
                break page["targetId"].clone();
            }
            assert!(start.elapsed() < ANSWER, "the browser opened no page");
            thread::sleep(Duration::from_millis(50));
        };
        let session = self.call("Target.attachToTarget", json!({ "targetId": target, "flatten": true }));
        self.session = session["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log"] {
            self.call(&format!("{domain}.enable"), json!({}));
        }
    }

    /// Calls a method of the protocol and waits for its result.
    #[track_caller]
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        match self.try_call(method, parameters) {
            Ok(result) => result,
            Err(error) => panic!("{method}: {error}\n{}", self.log()),
        }
    }

    /// Evaluates in the page. Where one page gives way to the next just then, the next is asked.
    #[track_caller]
    pub fn evaluate(&mut self, parameters: &Value) -> Value {
        let start = Instant::now();
        loop {
            match self.try_call("Runtime.evaluate", parameters.clone()) {
                Ok(result) => return result,
                Err(error) if error.contains("navigated or closed") && start.elapsed() < ANSWER => {
                    thread::sleep(Duration::from_millis(50));
                }
                Err(error) => panic!("Runtime.evaluate: {error}\n{}", self.log()),
            }
        }
    }

    fn send(&mut self, method: &str, parameters: Value) -> Result<(), String> {
        self.last_id += 1;
        let mut message = json!({ "id": self.last_id, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = session.as_str().into();
        }
        let mut bytes = message.to_string().into_bytes();
        bytes.push(0);
        self.input
            .write_all(&bytes)
            .and_then(|()| self.input.flush())
            .map_err(|error| format!("the browser does not listen: {error}"))
    }

    fn try_call(&mut self, method: &str, parameters: Value) -> Result<Value, String> {
        self.send(method, parameters)?;
        let id = self.last_id;
        let start = Instant::now();
        loop {
            let left = ANSWER.saturating_sub(start.elapsed());
            match self.messages.recv_timeout(left) {
                Ok(mut answer) if answer["id"] == id => {
                    if let Some(error) = answer.get("error") {
                        return Err(error.to_string());
                    }
                    return Ok(answer["result"].take());
                }
                Ok(event) => self.take_in(event),
                Err(RecvTimeoutError::Timeout) => {
                    return Err(format!("no answer in {} s", ANSWER.as_secs()));
                }
                Err(RecvTimeoutError::Disconnected) => return Err("the browser ended".into()),
            }
        }
    }

    /// Takes in what the browser has said meanwhile.
    pub fn listen(&mut self) {
        while let Ok(event) = self.messages.try_recv() {
            self.take_in(event);
        }
    }

    fn take_in(&mut self, event: Value) {
        if let (Some("Fetch.requestPaused"), Some(status)) = (event["method"].as_str(), self.block) {
            let answer = json!({ "requestId": event["params"]["requestId"], "responseCode": status });
            // A page that was left meanwhile needs no answer.
            self.send("Fetch.fulfillRequest", answer).ok();
        }
        self.events.push(event);
    }

    /// The last lines that the browser wrote about itself.
    fn log(&self) -> String {
        let text = read(&self.profile.join("stderr.log"));
        let lines: Vec<&str> = text.lines().collect();
        lines[lines.len().saturating_sub(20)..].join("\n")
    }
}

fn read(path: &Path) -> String {
    std::fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default()
}

impl Drop for Chromium {
    fn drop(&mut self) {
        // Asked first, so that its own helper processes end with it.
        self.session = None;
        self.try_call("Browser.close", json!({})).ok();
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(10) {
            if self.process.try_wait().is_ok_and(|status| status.is_some()) {
                break;
            }
            thread::sleep(Duration::from_millis(20));
        }
        self.process.kill().ok();
        self.process.wait().ok();
        // Its helpers may still be writing for a moment.
        for _ in 0..20 {
            if std::fs::remove_dir_all(&self.profile).is_ok() {
                break;
            }
            thread::sleep(Duration::from_millis(50));
        }
    }
}
