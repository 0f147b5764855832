//! A host of the page that a test holds: it serves one build, then another, or is gone. What serves a folder to people and to most tests is
//! `xtask/src/serve.rs`.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::thread;

/// Files by their path.
pub type Files = BTreeMap<String, Vec<u8>>;

#[derive(Default)]
struct Desk {
    /// None while there is no network.
    files: Option<Files>,
    /// Who asked for what: path and referrer.
    asked: Vec<[String; 2]>,
}

/// The host.
pub struct Host {
    desk: Arc<Mutex<Desk>>,
    /// Where it is.
    pub address: String,
}

/// The folder of the built page.
pub fn dist() -> PathBuf {
    std::env::var_os("CENTRODE_DIST")
        .expect("CENTRODE_DIST names no folder: these tests are run by `cargo xtask test browser`")
        .into()
}

/// Its files.
pub fn built() -> Files {
    let mut files = Files::new();
    let (root, mut folders) = (dist(), vec![dist()]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(&root).expect("inside").to_string_lossy().replace('\\', "/");
                files.insert(name, std::fs::read(&path).expect("a file"));
            }
        }
    }
    files
}

/// The folder in which a build keeps its parts.
pub fn build_of(files: &Files) -> String {
    let name = files.keys().find(|name| name.starts_with("build-")).expect("a build");
    name.split('/').next().expect("a folder").to_owned()
}

/// The same page as another build.
pub fn rebuilt(files: &Files, other: &str) -> Files {
    let own = build_of(files);
    let renamed = |(name, bytes): (&String, &Vec<u8>)| {
        let bytes = match String::from_utf8(bytes.clone()) {
            Ok(text) => text.replace(&own, other).into_bytes(),
            Err(binary) => binary.into_bytes(),
        };
        (name.replace(&own, other), bytes)
    };
    files.iter().map(renamed).collect()
}

/// Keeps in `problems` what a browser's console would show as an error, and in `devices` what the page may draw with on WebGPU, from
/// before the page's own scripts.
const LISTENER: &str = "globalThis.problems = [];
const tell = (kind, what) => problems.push(`${kind}: ${what}`);
for (const kind of ['error', 'assert']) {
  const spoken = console[kind];
  console[kind] = (...words) => {
    if (kind === 'error' || !words[0]) tell(`console.${kind}`, words.map((word) => word?.stack ?? word).join(' '));
    spoken.apply(console, words);
  };
}
// Captured: an element that does not load says so to itself alone.
addEventListener('error', (event) => tell('error', event.error?.stack ?? event.message ?? event.target?.src ?? event.target?.href), true);
addEventListener('unhandledrejection', (event) => tell('rejection', event.reason?.stack ?? event.reason));
if (globalThis.GPUAdapter) {
  globalThis.devices = [];
  const request = GPUAdapter.prototype.requestDevice;
  GPUAdapter.prototype.requestDevice = async function (...wish) {
    const device = await request.apply(this, wish);
    devices.push(device);
    return device;
  };
}
document.addEventListener('securitypolicyviolation', (event) => tell('policy', `${event.violatedDirective} ${event.blockedURI}`));
";

/// The same files with one more, which hears what goes wrong in the page: not every browser lets its console be read.
pub fn heard(mut files: Files) -> Files {
    let index = files.get_mut("index.html").expect("a page");
    let text = String::from_utf8(std::mem::take(index)).expect("text");
    *index = text.replacen("<script", "<script src=\"listener.js\"></script>\n    <script", 1).into_bytes();
    files.insert("listener.js".into(), LISTENER.into());
    files
}

impl Host {
    /// A host that serves these files.
    pub fn of(files: Files) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let address = format!("http://{}/", listener.local_addr().expect("an address"));
        let desk = Arc::new(Mutex::new(Desk { files: Some(files), asked: Vec::new() }));
        let shared = Arc::clone(&desk);
        thread::spawn(move || {
            for stream in listener.incoming().map_while(Result::ok) {
                let desk = Arc::clone(&shared);
                // A browser that went away is none of our concern.
                thread::spawn(move || answer(stream, &desk).ok());
            }
        });
        Self { desk, address }
    }

    /// Serves other files, or nothing at all.
    pub fn set(&self, files: Option<Files>) {
        self.desk.lock().expect("no panic").files = files;
    }

    /// How often a file was asked for by the page itself, not by what keeps it.
    pub fn asked(&self, file: &str) -> usize {
        let desk = self.desk.lock().expect("no panic");
        let by_page = |[path, referrer]: &&[String; 2]| path.ends_with(file) && !referrer.ends_with("-worker.js");
        desk.asked.iter().filter(by_page).count()
    }
}

fn answer(stream: TcpStream, desk: &Mutex<Desk>) -> std::io::Result<()> {
    let mut lines = BufReader::new(stream.try_clone()?).lines();
    let first = lines.next().transpose()?.unwrap_or_default();
    let mut referrer = String::new();
    for line in lines.map_while(Result::ok).take_while(|line| !line.is_empty()) {
        if let Some((name, value)) = line.split_once(": ")
            && name.eq_ignore_ascii_case("referer")
        {
            value.clone_into(&mut referrer);
        }
    }
    let path = first.split([' ', '?']).nth(1).unwrap_or_default().trim_start_matches('/').to_owned();
    let path = if path.is_empty() { "index.html".to_owned() } else { path };
    let found = {
        let mut desk = desk.lock().expect("no panic");
        let Some(files) = &desk.files else { return Ok(()) };
        let found = files.get(&path).cloned();
        desk.asked.push([path.clone(), referrer]);
        found
    };
    let (status, body) = match &found {
        Some(body) => ("200 OK", body.as_slice()),
        None => ("404 Not Found", &b"not found"[..]),
    };
    let mut stream = stream;
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n",
        kind(Path::new(&path)),
        body.len()
    )?;
    stream.write_all(body)
}

fn kind(path: &Path) -> &'static str {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("webmanifest") => "application/manifest+json",
        _ => "application/octet-stream",
    }
}
