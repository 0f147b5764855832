//! A static file server on this machine, for development and tests.

use crate::build::{self, Which};
use anyhow::{Context, Result, bail};
use std::fs::{self, File};
use std::io;
use std::net::TcpListener;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use std::thread;
use tiny_http::{Header, Method, Request, Response, Server};

const DEFAULT_PORT: u16 = 8080;
const THREADS: usize = 4;

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
    let threads = serve(listener, &dist, "/")?;
    println!("\nCentrode is at http://{address}/ (Ctrl-C ends it)");
    for thread in threads {
        thread.join().ok();
    }
    Ok(())
}

/// Serves `dist` under the path `prefix` on any free port; gives the address of the page.
pub fn background(dist: &Path, prefix: &str) -> Result<String> {
    let listener = listen(Some(0))?;
    let address = listener.local_addr()?;
    serve(listener, dist, prefix)?;
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

fn serve(listener: TcpListener, dist: &Path, prefix: &str) -> Result<Vec<thread::JoinHandle<()>>> {
    let server = Arc::new(Server::from_listener(listener, None).map_err(|error| anyhow::anyhow!("{error}"))?);
    let threads = (0..THREADS).map(|_| {
        let (server, dist, prefix) = (Arc::clone(&server), dist.to_owned(), prefix.to_owned());
        thread::spawn(move || {
            for request in server.incoming_requests() {
                // A browser that went away is none of our concern.
                answer(request, &dist, &prefix).ok();
            }
        })
    });
    Ok(threads.collect())
}

fn answer(request: Request, dist: &Path, prefix: &str) -> io::Result<()> {
    if !matches!(request.method(), Method::Get | Method::Head) {
        return request.respond(text("method not allowed", 405));
    }
    let Some(path) = locate(dist, prefix, request.url()) else {
        return request.respond(text("not found", 404));
    };
    let Ok(file) = File::open(&path) else {
        return request.respond(text("not found", 404));
    };
    let mut response = Response::from_file(file).with_chunked_threshold(usize::MAX);
    response.add_header(header("Content-Type", mime(&path)));
    response.add_header(header("Cache-Control", "no-store"));
    request.respond(response)
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

fn text(message: &str, status: u16) -> Response<io::Cursor<Vec<u8>>> {
    Response::from_string(message).with_status_code(status)
}

fn header(name: &str, value: &str) -> Header {
    Header::from_bytes(name, value).expect("a plain header")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read, Write};
    use std::net::TcpStream;

    fn page() -> PathBuf {
        let dist = std::env::temp_dir().join(format!("centrode-serve-{}", std::process::id()));
        fs::create_dir_all(dist.join("build")).unwrap();
        fs::write(dist.join("index.html"), "<p>page").unwrap();
        fs::write(dist.join("build/a.wasm"), [0; 70_000]).unwrap();
        dist
    }

    fn get(address: &str, path: &str) -> String {
        let host = address.trim_start_matches("http://").split('/').next().unwrap();
        let mut stream = TcpStream::connect(host).unwrap();
        write!(stream, "GET {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n").unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        String::from_utf8_lossy(&answer).into_owned()
    }

    #[test]
    fn serves_a_page_under_a_path_and_nothing_beside_it() {
        let dist = page();
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
    fn a_taken_port_is_named() {
        let taken = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = taken.local_addr().unwrap().port();
        let error = listen(Some(port)).unwrap_err().to_string();
        assert!(error.contains(&port.to_string()) && error.contains("--port"), "{error}");
    }
}
