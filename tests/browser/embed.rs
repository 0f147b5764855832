//! The page in the frame of another page: the example host page, what it asks and hears, and whose wheel it is.

use crate::harness::{Options, Page, Renderer};
use serde_json::{Value, json};
use std::process::Command;

/// Keeps what a host page is told.
const HEAR: &str = "globalThis.heard = []; addEventListener('message', ({ data }) => heard.push(data));";

/// The example host page; gives the address of the page in its frame, too.
fn host(options: Options) -> (Page, String) {
    let mut page = Page::visit(Renderer::WebGl, "?test", options);
    let base = page.eval("location.origin + location.pathname");
    let base = base.as_str().expect("an address").to_owned();
    page.before_scripts(HEAR);
    page.browse(&format!("{base}examples/embed.html"));
    (page, base)
}

/// What was told since the page was opened, of a kind.
fn heard(page: &mut Page, event: &str) -> Vec<Value> {
    let all: Vec<Value> = serde_json::from_value(page.eval("heard")).expect("messages");
    all.into_iter().filter(|told| told["event"] == event).collect()
}

#[track_caller]
fn wait_for(page: &mut Page, event: &str) -> Value {
    page.wait(event, |page| heard(page, event).pop())
}

/// Asks, as the host page does, and gives what comes back.
#[track_caller]
fn ask(page: &mut Page, request: &Value) -> Value {
    let id = page.eval(&format!("ask({request})"));
    page.wait(&format!("an answer to {request}"), |page| {
        let told: Vec<Value> = serde_json::from_value(page.eval("heard")).expect("messages");
        told.into_iter().find(|told| told["id"] == id)
    })
}

/// What `centrode run --link` reports.
fn replayed(link: &str) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
    let output = command.args(["run", "--json", "--link", link]).output().expect("the command starts");
    assert!(output.status.success(), "{link}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Points the frame elsewhere, and forgets what was heard.
fn point(page: &mut Page, address: &str) {
    page.eval(&format!("heard.length = 0; document.getElementById('frame').src = {}; 1", json!(address)));
}

#[test]
fn a_host_page_asks_and_is_told_what_the_command_says() {
    let (mut page, base) = host(Options::default());
    let ready = wait_for(&mut page, "ready");
    assert_eq!((&ready["preset"], &ready["values"]), (&json!("bench"), &json!({})));
    let history = page.eval("history.length");
    let answer = ask(&mut page, &json!({ "do": "set", "values": { "contact.disk": 3, "detection.xi2": 0.0055 } }));
    assert_eq!(answer["event"], "answer", "{answer}");
    let link = answer["link"].as_str().expect("a link");
    assert!(link.starts_with(&format!("{base}#preset=bench&contact.disk=3&detection.xi2=0.0055")), "{link}");
    let report = replayed(link);
    for part in ["detection", "contact", "events"] {
        assert_eq!(answer["result"][part], report[part], "{part}");
    }
    assert!(report["detection"]["time"].is_f64());
    assert_eq!(wait_for(&mut page, "result")["result"], answer["result"]);
    // Refused, by the example's own button.
    page.eval("document.getElementById('wrong').click(); 1");
    let error = wait_for(&mut page, "error");
    assert_eq!((&error["refused"][0]["key"], &error["refused"][0]["value"]), (&json!("contact.disk"), &json!(9)));
    assert!(error["refused"][0]["allowed"].as_str().is_some_and(|allowed| allowed.contains("1 to 3")), "{error}");
    let still = ask(&mut page, &json!({ "do": "get", "key": "contact.disk" }));
    assert_eq!((&still["asked"], &still["result"]), (&json!({ "contact.disk": 3 }), &answer["result"]));
    // Playback passes both alarms.
    ask(&mut page, &json!({ "do": "seek", "time": 5.9 }));
    ask(&mut page, &json!({ "do": "play" }));
    page.wait("an alarm", |page| heard(page, "event").into_iter().find(|told| told["detector"] == "fcd"));
    // The frame's address is kept up, and the host's history is left alone.
    page.wait("the frame's address", |page| {
        let address = page.eval("document.getElementById('frame').contentWindow.location.href");
        address
            .as_str()
            .is_some_and(|address| address.contains("?embed=robot#") && address.contains("contact.disk=3"))
            .then_some(())
    });
    assert_eq!(page.eval("history.length"), history);
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn an_origin_that_is_not_listed_is_not_heard() {
    let (mut page, base) = host(Options::default());
    wait_for(&mut page, "ready");
    point(&mut page, &format!("{base}?embed=robot&origins=https://other.example"));
    page.wait("the frame", |page| {
        // The page that the frame leaves is ready, too.
        let shown = "(w => w.location.search.includes('origins') && w.document.getElementById('mirror')?.dataset.ready)\
             (document.getElementById('frame').contentWindow)";
        (page.eval(shown) == "true").then_some(())
    });
    // Heard in the frame after the frame's own listener, and answered by nobody.
    page.eval(
        "window.arrived = 0; document.getElementById('frame').contentWindow.addEventListener('message', () => (arrived += 1)); \
         heard.length = 0; ask({ do: 'set', key: 'contact.disk', value: 3 }); 1",
    );
    page.wait("the request to arrive", |page| (page.eval("arrived") == 1).then_some(()));
    page.frames();
    assert_eq!(page.eval("heard"), json!([]));
    let address = page.eval("document.getElementById('frame').contentWindow.location.href");
    assert!(address.as_str().is_some_and(|address| !address.contains("contact.disk")), "{address}");
    assert!(page.problems().iter().all(|problem| !problem.contains("xception")), "{:?}", page.problems());
}

#[test]
fn a_host_of_another_origin_is_heard_when_it_is_listed() {
    let (mut page, base) = host(Options::default());
    let elsewhere = base.replace("127.0.0.1", "localhost");
    assert_ne!(elsewhere, base);
    page.browse(&format!("{elsewhere}examples/embed.html"));
    // The example's own frame: were it still starting, its "ready" would be taken for that of the frame that follows.
    wait_for(&mut page, "ready");
    let origin = page.eval("location.origin");
    point(&mut page, &format!("{base}?embed=plots&origins=https://a.example,{}", origin.as_str().expect("an origin")));
    wait_for(&mut page, "ready");
    let answer = ask(&mut page, &json!({ "do": "set", "key": "contact.disk", "value": 3 }));
    assert_eq!(answer["values"], json!({ "contact.disk": 3 }));
    assert_eq!(answer["result"]["detection"], replayed(answer["link"].as_str().expect("a link"))["detection"]);
    assert_eq!(page.problems(), Vec::<String>::new());
}

#[test]
fn the_wheel_is_the_hosts_until_the_frame_is_clicked() {
    let (mut page, _) = host(Options::default());
    wait_for(&mut page, "ready");
    let place = |page: &mut Page, element: &str, height: f64| {
        let script = format!(
            "(r => [r.x + r.width / 2, r.y + {height} * r.height])(document.querySelector('{element}').getBoundingClientRect())"
        );
        serde_json::from_value::<[f64; 2]>(page.eval(&script)).expect("a place")
    };
    assert_eq!(page.eval("document.activeElement.tagName"), "BODY", "the keyboard is the host's");
    let scrolls = |page: &mut Page, what: &str| {
        let at = place(page, "#frame", 0.3);
        page.wheel(at, 200.0);
        page.wait(what, |page| page.eval("scrollY").as_f64().filter(|scrolled| *scrolled > 0.0));
        page.eval("scrollTo(0, 0); 1");
        page.wait("the top", |page| (page.eval("scrollY") == 0.0).then_some(()));
    };
    scrolls(&mut page, "the host to scroll");
    let at = place(&mut page, "#frame", 0.3);
    page.mouse("mouseMoved", at);
    page.mouse("mousePressed", at);
    page.mouse("mouseReleased", at);
    page.wait("the frame to have the keyboard", |page| {
        (page.eval("document.activeElement.id") == "frame").then_some(())
    });
    page.eval(
        "window.wheels = []; document.getElementById('frame').contentWindow.addEventListener('wheel', \
         (event) => setTimeout(() => wheels.push(event.defaultPrevented)), true); 1",
    );
    page.wheel(at, 200.0);
    let wheels = page
        .wait("the frame to hear the wheel", |page| Some(page.eval("wheels")).filter(|wheels| wheels[0].is_boolean()));
    assert_eq!((wheels, page.eval("scrollY").as_f64()), (json!([true]), Some(0.0)));
    let beside = place(&mut page, "h1", 0.5);
    page.mouse("mousePressed", beside);
    page.mouse("mouseReleased", beside);
    page.wait("the host to have the keyboard", |page| {
        (page.eval("document.activeElement.tagName") == "BODY").then_some(())
    });
    scrolls(&mut page, "the host to scroll again");
    assert_eq!(page.problems(), Vec::<String>::new());
}
