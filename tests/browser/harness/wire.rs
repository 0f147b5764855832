//! The commands of WebDriver, and the two ways they go to a browser: over HTTP to a driver that stands between, or straight to Firefox,
//! whose own socket (Marionette) takes the same commands by names.

use serde_json::{Value, json};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

/// An answer that takes longer than this will not come.
const ANSWER: Duration = Duration::from_secs(150);

/// A command.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Command {
    /// Begins a session.
    Begin,
    /// Ends it.
    End,
    /// Goes to an address.
    Go,
    /// Runs a script that calls its last argument with what comes of it.
    Run,
    /// Does what hands do.
    Act,
    /// Places the window.
    Place,
    /// Takes a picture of what the window shows.
    Shoot,
}

impl Command {
    /// As Firefox names it.
    fn name(self) -> &'static str {
        match self {
            Self::Begin => "WebDriver:NewSession",
            Self::End => "WebDriver:DeleteSession",
            Self::Go => "WebDriver:Navigate",
            Self::Run => "WebDriver:ExecuteAsyncScript",
            Self::Act => "WebDriver:PerformActions",
            Self::Place => "WebDriver:SetWindowRect",
            Self::Shoot => "WebDriver:TakeScreenshot",
        }
    }

    /// Method, and path below the session's.
    fn route(self) -> (&'static str, &'static str) {
        match self {
            Self::Begin => ("POST", ""),
            Self::End => ("DELETE", ""),
            Self::Go => ("POST", "/url"),
            Self::Run => ("POST", "/execute/async"),
            Self::Act => ("POST", "/actions"),
            Self::Place => ("POST", "/window/rect"),
            Self::Shoot => ("GET", "/screenshot"),
        }
    }
}

/// A way to a browser.
pub enum Wire {
    /// To a driver that listens at this port, in this session.
    Http { port: u16, session: String },
    /// To Firefox.
    Socket { stream: BufReader<TcpStream>, last_id: u64 },
}

impl Wire {
    /// To a driver that listens, or will soon.
    pub fn http(port: u16) -> Self {
        Self::Http { port, session: String::new() }
    }

    /// To a Firefox that listens. It speaks first.
    pub fn socket(port: u16) -> io::Result<Self> {
        let stream = TcpStream::connect(("127.0.0.1", port))?;
        stream.set_read_timeout(Some(ANSWER))?;
        let mut stream = BufReader::new(stream);
        packet(&mut stream)?;
        Ok(Self::Socket { stream, last_id: 0 })
    }

    /// Begins a session that wants these capabilities.
    pub fn begin(&mut self, capabilities: &Value) -> Result<(), String> {
        let answer = self.call(Command::Begin, json!({ "capabilities": { "alwaysMatch": capabilities } }))?;
        if let Self::Http { session, .. } = self {
            answer["sessionId"].as_str().ok_or("a session without a name")?.clone_into(session);
        }
        Ok(())
    }

    /// Carries out a command, and gives what comes of it.
    pub fn call(&mut self, command: Command, parameters: Value) -> Result<Value, String> {
        let answer = match self {
            Self::Http { port, session } => by_http(*port, session, command, &parameters),
            Self::Socket { stream, last_id } => {
                *last_id += 1;
                by_socket(stream, *last_id, command, &parameters)
            }
        };
        answer.map_err(|error| format!("the browser does not answer: {error}"))?
    }
}

/// What was answered, or what the browser says is wrong.
type Answer = io::Result<Result<Value, String>>;

fn refusal(error: &Value) -> String {
    format!("{}: {}", error["error"].as_str().unwrap_or_default(), error["message"].as_str().unwrap_or_default())
}

fn by_socket(stream: &mut BufReader<TcpStream>, id: u64, command: Command, parameters: &Value) -> Answer {
    let text = json!([0, id, command.name(), parameters]).to_string();
    write!(stream.get_mut(), "{}:{text}", text.len())?;
    loop {
        let mut answer = packet(stream)?;
        if answer[1] != id {
            continue;
        }
        if !answer[2].is_null() {
            return Ok(Err(refusal(&answer[2])));
        }
        let mut result = answer[3].take();
        // What is a plain value in the standard comes inside an object.
        return Ok(Ok(match result.get_mut("value") {
            Some(value) => value.take(),
            None => result,
        }));
    }
}

/// A message of Firefox: its length, a colon, and that many bytes of JSON.
fn packet(stream: &mut impl BufRead) -> io::Result<Value> {
    let mut length = Vec::new();
    stream.read_until(b':', &mut length)?;
    length.pop();
    let length = str::from_utf8(&length).ok().and_then(|text| text.parse().ok());
    let mut bytes = vec![0; length.ok_or(io::ErrorKind::InvalidData)?];
    stream.read_exact(&mut bytes)?;
    Ok(serde_json::from_slice(&bytes)?)
}

fn by_http(port: u16, session: &str, command: Command, parameters: &Value) -> Answer {
    let (method, below) = command.route();
    let path = if command == Command::Begin { "/session".to_owned() } else { format!("/session/{session}{below}") };
    let body = if method == "POST" { parameters.to_string() } else { String::new() };
    let mut stream = TcpStream::connect(("127.0.0.1", port))?;
    stream.set_read_timeout(Some(ANSWER))?;
    write!(
        stream,
        "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nContent-Type: application/json\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{body}",
        body.len()
    )?;
    let mut stream = BufReader::new(stream);
    let mut status = String::new();
    stream.read_line(&mut status)?;
    let mut length = None;
    for line in stream.by_ref().lines() {
        let line = line?;
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':')
            && name.eq_ignore_ascii_case("content-length")
        {
            length = value.trim().parse().ok();
        }
    }
    let mut bytes = vec![0; length.ok_or(io::ErrorKind::InvalidData)?];
    stream.read_exact(&mut bytes)?;
    let mut answer: Value = serde_json::from_slice(&bytes)?;
    let value = answer["value"].take();
    Ok(if status.contains(" 200 ") { Ok(value) } else { Err(refusal(&value)) })
}
