//! A static file server on this machine, for development and tests.
//!
//! Each connection has a thread and one answer. A browser opens several at once and keeps them: threads that are shared out among
//! connections that are kept may all be taken, and the next one waits for nobody.

use crate::build::{self, Which};
use anyhow::{Context, Result, bail};
use std::fs;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::thread::{self, JoinHandle};
use std::time::Duration;

const DEFAULT_PORT: u16 = 8080;
/// Bytes of the longest request.
const LONGEST: u64 = 64 << 10;
/// Whoever sends or takes nothing for so long is gone.
const PATIENCE: Duration = Duration::from_secs(60);

/// `cargo xtask serve`.
pub fn command(port: Option<u16>, dev: bool, dist: Option<PathBuf>) -> Result<()> {
    // Before the build, so that a taken port does not cost a build.
    let listener = listen(port)?;
    let dist = match dist {
        Some(dist) if dist.join("index.html").is_file() => dist,
        Some(dist) => bail!("--dist {}: there is no index.html in it", dist.display()),
        None => build::build(Which::dev(dev))?,
    };
    let address = listener.local_addr()?;
    let served = serve(listener, &dist, "/");
    println!("\nCentrode is at http://{address}/ (Ctrl-C ends it)");
    served.join().map_err(|_| anyhow::anyhow!("the server stopped"))
}

/// Serves `dist` under the path `prefix` on any free port; gives the address of the page.
pub fn background(dist: &Path, prefix: &str) -> Result<String> {
    let listener = listen(Some(0))?;
    let address = listener.local_addr()?;
    serve(listener, dist, prefix);
    Ok(format!("http://{address}{prefix}"))
}

fn listen(port: Option<u16>) -> Result<TcpListener> {
    let bind = |port: u16| TcpListener::bind(("127.0.0.1", port));
    match port {
        Some(port) => bind(port).with_context(|| {
            format!("cannot listen on port {port} (choose another with --port, or 0 for any free one)")
        }),
        None => (DEFAULT_PORT..DEFAULT_PORT + 20)
            .find_map(|port| bind(port).ok())
            .context("no port from 8080 to 8099 is free (choose one with --port, or 0 for any free one)"),
    }
}

fn serve(listener: TcpListener, dist: &Path, prefix: &str) -> JoinHandle<()> {
    let (dist, prefix) = (dist.to_owned(), prefix.to_owned());
    thread::spawn(move || {
        for stream in listener.incoming() {
            let (dist, prefix) = (dist.clone(), prefix.clone());
            // A browser that went away is none of our concern.
            let served =
                stream.and_then(|stream| thread::Builder::new().spawn(move || answer(stream, &dist, &prefix).ok()));
            if served.is_err() {
                // Neither a connection nor a thread is to be had: others end.
                thread::sleep(Duration::from_millis(100));
            }
        }
    })
}

fn answer(mut stream: TcpStream, dist: &Path, prefix: &str) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut request = BufReader::new(stream.try_clone()?.take(LONGEST)).lines();
    let first = request.next().transpose()?.unwrap_or_default();
    let whole = loop {
        match request.next().transpose()? {
            Some(line) if line.is_empty() => break true,
            Some(_) => {}
            None => break false,
        }
    };
    let mut words = first.split(' ');
    let method = words.next().unwrap_or_default();
    let with_body = method != "HEAD";
    let refused = |mut stream: TcpStream, status: &str| {
        send(&mut stream, status, "text/plain; charset=utf-8", status.as_bytes(), with_body)?;
        // Who still sends would hear of a broken connection instead of the answer.
        stream.shutdown(Shutdown::Write)?;
        io::copy(&mut stream.take(LONGEST), &mut io::sink()).map(drop)
    };
    if !whole {
        return refused(stream, "400 Bad Request");
    }
    if !["GET", "HEAD"].contains(&method) {
        return refused(stream, "405 Method Not Allowed");
    }
    let path = words.next().and_then(|url| locate(dist, prefix, url));
    match path.and_then(|path| Some((fs::read(&path).ok()?, path))) {
        Some((bytes, path)) => send(&mut stream, "200 OK", mime(&path), &bytes, with_body),
        None => refused(stream, "404 Not Found"),
    }
}

fn send(stream: &mut TcpStream, status: &str, kind: &str, body: &[u8], with_body: bool) -> io::Result<()> {
    let length = body.len();
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n"
    );
    stream.write_all(head.as_bytes())?;
    if with_body { stream.write_all(body) } else { Ok(()) }
}

/// The file that `url` means, if it lies in `dist`.
fn locate(dist: &Path, prefix: &str, url: &str) -> Option<PathBuf> {
    let path = url.split(['?', '#']).next()?.strip_prefix(prefix)?;
    let relative = Path::new(path);
    // The page's names need no escapes; what has any, or climbs, is not ours.
    if path.contains('%') || !relative.components().all(|c| matches!(c, Component::Normal(_))) {
        return None;
    }
    let mut file = dist.join(relative);
    if fs::metadata(&file).ok()?.is_dir() {
        file.push("index.html");
    }
    Some(file)
}

fn mime(path: &Path) -> &'static str {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("json") => "application/json",
        Some("webmanifest") => "application/manifest+json",
        Some("toml" | "csv" | "txt") => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(name: &str) -> PathBuf {
        let dist = std::env::temp_dir().join(format!("centrode-serve-{name}-{}", std::process::id()));
        fs::create_dir_all(dist.join("build")).unwrap();
        fs::write(dist.join("index.html"), "<p>page").unwrap();
        fs::write(dist.join("build/a.wasm"), [0; 70_000]).unwrap();
        dist
    }

    /// The answer to a request, without what every request has.
    fn ask(address: &str, request: &str) -> String {
        let host = address.trim_start_matches("http://").split('/').next().unwrap();
        let mut stream = TcpStream::connect(host).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        write!(stream, "{request} HTTP/1.1\r\nHost: x\r\n\r\n").unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        String::from_utf8_lossy(&answer).into_owned()
    }

    fn get(address: &str, path: &str) -> String {
        ask(address, &format!("GET {path}"))
    }

    #[test]
    fn serves_a_page_under_a_path_and_nothing_beside_it() {
        let dist = page("path");
        let address = background(&dist, "/deep/path/").unwrap();
        assert!(address.ends_with("/deep/path/"));
        let index = get(&address, "/deep/path/?renderer=webgl");
        assert!(index.starts_with("HTTP/1.1 200") && index.ends_with("<p>page"));
        assert!(index.contains("Content-Type: text/html") && index.contains("no-store"));
        let wasm = get(&address, "/deep/path/build/a.wasm");
        assert!(wasm.contains("Content-Type: application/wasm"));
        assert!(wasm.contains("Content-Length: 70000"));
        for path in ["/", "/deep/path/none", "/deep/path/../x", "/deep/path//etc/passwd", "/deep/path/%2e%2e/x"] {
            assert!(get(&address, path).starts_with("HTTP/1.1 404"), "{path}");
        }
        fs::remove_dir_all(dist).unwrap();
    }

    #[test]
    fn connections_that_are_kept_or_say_nothing_keep_nobody_waiting() {
        let dist = page("silent");
        let address = background(&dist, "/").unwrap();
        let host = address.trim_start_matches("http://").trim_end_matches('/');
        let connected = || (0..24).map(|_| TcpStream::connect(host).unwrap()).collect::<Vec<_>>();
        let (silent, mut asking) = (connected(), connected());
        // As a browser does that means to keep them.
        asking.iter_mut().for_each(|stream| write!(stream, "GET / HTTP/1.1\r\nHost: x\r\n\r\n").unwrap());
        for stream in &mut asking {
            stream.set_read_timeout(Some(PATIENCE)).unwrap();
            let mut first = [0; 12];
            stream.read_exact(&mut first).unwrap();
            assert_eq!(&first, b"HTTP/1.1 200");
        }
        drop(silent);
        fs::remove_dir_all(dist).unwrap();
    }

    #[test]
    fn what_asks_for_the_head_gets_it_and_what_is_no_request_for_a_file_is_refused() {
        let dist = page("head");
        let address = background(&dist, "/").unwrap();
        let head = ask(&address, "HEAD /build/a.wasm");
        assert!(head.contains("Content-Length: 70000") && head.ends_with("\r\n\r\n"), "{head}");
        assert!(ask(&address, "HEAD /none").ends_with("\r\n\r\n"));
        assert!(ask(&address, "POST /").starts_with("HTTP/1.1 405"));
        assert!(ask(&address, "").starts_with("HTTP/1.1 405"));
        assert!(ask(&address, &format!("GET /{}", "a".repeat(LONGEST as usize + 100))).starts_with("HTTP/1.1 400"));
        fs::remove_dir_all(dist).unwrap();
    }

    #[test]
    fn a_taken_port_is_named() {
        let taken = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = taken.local_addr().unwrap().port();
        let error = listen(Some(port)).unwrap_err().to_string();
        assert!(error.contains(&port.to_string()) && error.contains("--port"), "{error}");
    }
}
