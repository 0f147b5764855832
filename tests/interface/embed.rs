//! The page in a frame: what it shows, what a host page can ask, and what it is told.

use crate::support::{Page, app, click, finish, fits};
use centrode::app::embed::Embed;
use centrode::app::link::Effect;
use centrode::app::stages::stage::Stage;
use centrode::app::{App, Host};
use centrode_core::run::simulate;
use centrode_core::scenario::link::Link;
use centrode_core::scenario::{Scenario, Threshold};
use egui::accesskit::Role;
use egui::{OutputCommand, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use serde_json::{Value, json};

const ADDRESS: &str = "https://example.org/centrode/";

/// A page in a frame of a size, with a host that listens.
fn framed(size: Vec2, embed: Embed, fragment: &'static str) -> Page {
    let ui = move |ui: &mut egui::Ui, app: &mut Option<App>| {
        let host = || Host {
            prefers_reduced_motion: true,
            address: ADDRESS.into(),
            fragment: fragment.into(),
            embed: Some(embed),
            hosted: true,
            ..Host::default()
        };
        app.get_or_insert_with(|| App::new(ui.ctx(), None, host())).ui(ui);
    };
    let builder = Harness::builder().with_size(size).with_step_dt(0.1).with_theme(egui::Theme::Dark);
    builder.with_context_setup(centrode::app::theme::install).build_ui_state(ui, None)
}

fn handle(page: &mut Page) -> &mut App {
    page.state_mut().as_mut().expect("built")
}

/// What the host was told since this was last asked.
fn told(page: &mut Page) -> Vec<Value> {
    let effects = handle(page).take_effects().into_iter();
    let posts = effects.filter_map(|effect| match effect {
        Effect::Post(json) => Some(serde_json::from_str(&json).expect("JSON")),
        _ => None,
    });
    posts.collect()
}

/// Sends a request of version 1, and gives the answer; what else is told is given beside it.
fn ask(page: &mut Page, mut request: Value) -> (Value, Vec<Value>) {
    told(page);
    request["centrode"] = 1.into();
    request["id"] = "mine".into();
    handle(page).request(&request.to_string());
    let mut told = told(page);
    let answer = told.remove(0);
    assert_eq!((&answer["centrode"], &answer["id"], &answer["do"]), (&json!(1), &json!("mine"), &request["do"]));
    (answer, told)
}

fn shown(page: &Page, label: &str) -> bool {
    page.query_by_label(label).is_some()
}

#[test]
fn a_frame_shows_what_was_asked_for() {
    for size in [vec2(640.0, 360.0), vec2(390.0, 844.0), vec2(1440.0, 900.0), vec2(300.0, 150.0)] {
        for embed in Embed::ALL {
            let mut page = framed(size, embed, "preset=bench&t=6.27");
            page.run_steps(2);
            if embed == Embed::Tuning {
                finish(&mut page);
            }
            let all = embed == Embed::All;
            let small = size.y < 240.0;
            assert_eq!(app(&page).state().stage, embed.stage(Stage::default()));
            assert!(!shown(&page, "Preset") && !shown(&page, "Share") && !shown(&page, "Help"), "{embed:?}");
            assert!(shown(&page, "Open in a page of its own"), "{embed:?} at {size}");
            assert_eq!(shown(&page, "Play"), embed != Embed::Tuning && (all || !small), "{embed:?} at {size}");
            let tabs = page.query_by_role_and_label(Role::Tab, "Map").is_some();
            assert_eq!(tabs, all, "{embed:?} at {size}");
            if !small {
                fits(&page, size, embed.name());
            }
        }
    }
    let mut page = framed(vec2(640.0, 360.0), Embed::All, "");
    page.run_steps(2);
    click(&mut page, "Controls");
    assert!(page.query_by_role_and_label(Role::Slider, "Contact disk").is_some(), "the sheet of controls");
}

#[test]
fn a_frame_keeps_its_one_view_and_opens_as_a_page_of_its_own() {
    let mut page = framed(vec2(640.0, 360.0), Embed::Robot, "preset=bench&contact.disk=3&view=map&t=6.27");
    page.run_steps(2);
    assert_eq!(app(&page).state().stage, Stage::Robot);
    page.get_by_label("Open in a page of its own").click();
    let opened = (0..4).find_map(|_| {
        page.step();
        page.output().platform_output.commands.iter().find_map(|command| match command {
            OutputCommand::OpenUrl(open) => Some((open.url.clone(), open.new_tab)),
            _ => None,
        })
    });
    assert_eq!(opened, Some((format!("{ADDRESS}#preset=bench&contact.disk=3&t=6.27"), true)));
    let (refused, _) = ask(&mut page, json!({ "do": "set", "key": "view", "value": "map" }));
    assert_eq!((&refused["event"], &refused["refused"][0]["key"]), (&json!("error"), &json!("view")));
    let mut page = framed(vec2(640.0, 360.0), Embed::All, "preset=bench&view=map&t=1");
    let (answer, _) = ask(&mut page, json!({ "do": "set", "key": "view", "value": "tuning" }));
    assert_eq!(answer["state"]["view"], "tuning");
}

#[test]
fn a_frame_shows_several_segments_where_its_link_names_them() {
    for embed in [Embed::Robot, Embed::Plots] {
        let size = vec2(640.0, 360.0);
        let mut page = framed(size, embed, "view=chain&chain=two-contacts&t=8");
        page.run_steps(2);
        finish(&mut page);
        assert_eq!(app(&page).state().stage, Stage::Chain);
        fits(&page, size, embed.name());
        assert!(app(&page).notice().is_none());
    }
}

#[test]
fn a_host_sets_keys_and_has_the_result_of_the_run() {
    let mut page = framed(vec2(640.0, 360.0), Embed::Robot, "preset=bench&t=6.27");
    page.run_steps(2);
    handle(&mut page).ready();
    let ready = told(&mut page).pop().expect("ready");
    assert_eq!((&ready["event"], &ready["preset"], &ready["values"]), (&json!("ready"), &json!("bench"), &json!({})));
    let request = json!({ "do": "set", "values": { "contact.disk": 3, "detection.xi2": 0.0055, "seed": "7" } });
    let (answer, rest) = ask(&mut page, request);
    assert_eq!(answer["event"], "answer");
    assert_eq!(answer["values"], json!({ "contact.disk": 3, "detection.xi2": 0.0055, "seed": 7 }));
    assert_eq!(rest.len(), 1, "{rest:?}");
    assert_eq!((&rest[0]["event"], &rest[0]["result"]), (&json!("result"), &answer["result"]));
    let (link, broken) = Link::read(answer["link"].as_str().expect("a link"));
    assert!(broken.is_empty() && link.scenario() == &app(&page).state().scenario);
    let run = simulate(link.scenario()).expect("possible");
    let detection = run.detection().expect("detected");
    assert_eq!(answer["result"]["detection"]["time"], json!(detection.time));
    assert_eq!(answer["result"]["detection"]["location"], json!(detection.location));
    assert_eq!(answer["result"]["contact"]["time"], json!(run.contact_time()));
    assert_eq!(answer["result"]["events"], json!(run.events()));
    page.run_steps(2);
    assert_eq!(told(&mut page), Vec::<Value>::new(), "nothing is told twice");
    // The other of two keys, a list, a word, a switch, and a preset before all that changes it.
    let values = json!({ "contact.arc_length": 0.011, "robot.disks": [0.01, 0.02], "filter.averaging": "rotations",
        "detection.xi2": "off", "preset": "disk-3", "loop": "off", "speed": 0.5 });
    let (answer, _) = ask(&mut page, json!({ "do": "set", "values": values }));
    assert_eq!((&answer["preset"], &answer["state"]["loop"]), (&json!("disk-3"), &json!(false)));
    let scenario = &app(&page).state().scenario;
    assert_eq!((scenario.seed, scenario.detection.xi2, scenario.robot.disks.len()), (1, Threshold::OFF, 2));
    let (answer, _) =
        ask(&mut page, json!({ "do": "get", "keys": ["filter.length", "speed", "contact.disk", "preset"] }));
    let length = scenario_of(&page).filter.length;
    let asked = json!({ "filter.length": length, "speed": 0.5, "contact.disk": null, "preset": "disk-3" });
    assert_eq!(answer["asked"], asked);
}

fn scenario_of(page: &Page) -> &Scenario {
    &app(page).state().scenario
}

#[test]
fn what_is_refused_is_named_and_changes_nothing() {
    let mut page = framed(vec2(640.0, 360.0), Embed::All, "preset=bench&seed=5&t=6.27");
    page.run_steps(2);
    let before = app(&page).state().clone();
    for (request, key, said) in [
        (json!({ "do": "set", "key": "contact.disk", "value": 9 }), "contact.disk", "a disk from 1 to 3"),
        (json!({ "do": "set", "key": "contact.dsk", "value": 1 }), "contact.dsk", "disk, arc_length"),
        (json!({ "do": "set", "key": "bogus", "value": 1 }), "bogus", "preset, loop_rate, seed"),
        (json!({ "do": "set", "key": "contact", "value": { "disk": 3 } }), "contact", "arc_length"),
        (json!({ "do": "set", "key": "filter.length", "value": 2.5 }), "filter.length", "a whole number"),
        (json!({ "do": "set", "key": "filter.length", "value": null }), "filter.length", "a whole number"),
        (json!({ "do": "set", "key": "filter.length", "value": true }), "filter.length", "a whole number"),
        (json!({ "do": "set", "key": "load.force", "value": [1, "x", 2] }), "load.force[1]", "a number"),
        (json!({ "do": "set", "key": "load.force", "value": [1] }), "load.force", "three numbers"),
        (json!({ "do": "set", "key": "motion.end", "value": 300 }), "motion.end", "200000 samples"),
        (json!({ "do": "set", "key": "speed", "value": 99 }), "speed", "from 0.1"),
        (json!({ "do": "set", "key": "preset", "value": "bensh" }), "preset", "bench, paper"),
        (json!({ "do": "set", "key": "t", "value": 11 }), "t", "motion.end"),
        (
            json!({ "do": "set", "values": { "seed": 6, "contact.disk": 1, "contact.arc_length": 0.01 } }),
            "contact.",
            "not both",
        ),
        (json!({ "do": "set", "values": [1] }), "values", "an object"),
        (json!({ "do": "set", "key": "seed" }), "value", "a number"),
        (json!({ "do": "set", "key": 3, "value": 3 }), "key", "the name of a key"),
        (json!({ "do": "set" }), "key", "a key and a value"),
        (json!({ "do": "get", "keys": ["seed", "bogus"] }), "bogus", "preset, loop_rate"),
        (json!({ "do": "get", "keys": 3 }), "3", "preset, loop_rate"),
        (json!({ "do": "seek", "time": 10.5 }), "time", "motion.end = 10 s"),
        (json!({ "do": "seek", "time": "soon" }), "time", "a number"),
        (json!({ "do": "seek" }), "time", "a number"),
        (json!({ "do": "stop" }), "do", "set, get, play, pause, seek"),
    ] {
        let (answer, rest) = ask(&mut page, request.clone());
        assert_eq!(answer["event"], "error", "{request}: {answer}");
        let refused = &answer["refused"][0];
        let (named, message) =
            (refused["key"].as_str().unwrap_or_default(), answer["message"].as_str().unwrap_or_default());
        assert!(named.starts_with(key) && message.contains(said), "{request}: {answer}");
        assert!(refused["allowed"].as_str().is_some_and(|allowed| !allowed.is_empty()), "{request}: {answer}");
        assert!(rest.is_empty(), "{request}: {rest:?}");
        assert_eq!(app(&page).state(), &before, "{request}");
    }
    // Each that is wrong is named, and what was right beside it is not taken either.
    let values = json!({ "seed": 6, "filter.length": 0.5, "bogus": 1 });
    let (answer, _) = ask(&mut page, json!({ "do": "set", "values": values }));
    assert_eq!(answer["refused"].as_array().map(Vec::len), Some(2), "{answer}");
    assert_eq!(app(&page).state(), &before);
    for text in ["", "3", "{\"centrode\":2,\"do\":\"get\"}", "{\"do\":\"get\"}"] {
        handle(&mut page).request(text);
        let answer = told(&mut page).pop().expect("an answer");
        assert_eq!((&answer["event"], &answer["refused"][0]["key"]), (&json!("error"), &json!("centrode")), "{text}");
    }
}

#[test]
fn playback_is_asked_for_and_tells_the_alarms_that_it_passes() {
    let mut page = framed(vec2(640.0, 360.0), Embed::Robot, "preset=bench&t=5.9");
    page.run_steps(2);
    let (answer, _) = ask(&mut page, json!({ "do": "play" }));
    assert_eq!((&answer["state"]["playing"], &answer["state"]["time"]), (&json!(true), &json!(5.9)));
    let mut alarms = Vec::new();
    for _ in 0..6 {
        page.step();
        alarms.extend(told(&mut page).into_iter().filter(|told| told["event"] == "event"));
    }
    let expected: Vec<Value> = app(&page)
        .run()
        .events()
        .iter()
        .map(|event| {
            json!({ "centrode": 1, "event": "event", "alarm": "raised", "detector": event.detector.key(),
                "time": event.raised, "value": event.value, "threshold": event.threshold })
        })
        .collect();
    assert_eq!(expected.len(), 2);
    assert_eq!(alarms, expected);
    let (answer, _) = ask(&mut page, json!({ "do": "pause" }));
    assert_eq!(answer["state"]["playing"], false);
    let (answer, rest) = ask(&mut page, json!({ "do": "seek", "time": 6.5 }));
    assert_eq!((&answer["state"]["time"], rest.len()), (&json!(6.5), 0), "a leap passes nothing");
    page.run_steps(2);
    assert_eq!(app(&page).state().time, 6.5);
}

#[test]
fn what_the_person_changes_is_told() {
    let mut page = framed(vec2(1440.0, 900.0), Embed::All, "preset=bench&t=6.27");
    page.run_steps(2);
    handle(&mut page).ready();
    told(&mut page);
    crate::support::slide(&mut page, "Contact disk", 3.0);
    let told = told(&mut page);
    let results: Vec<_> = told.iter().filter(|told| told["event"] == "result").collect();
    assert_eq!(results.len(), 1, "{told:?}");
    let detection = app(&page).run().detection().expect("detected");
    assert_eq!(results[0]["result"]["detection"]["time"], json!(detection.time));
}

#[test]
fn a_log_is_no_business_of_the_host() {
    let mut page = framed(vec2(900.0, 700.0), Embed::All, "preset=bench");
    page.run_steps(3);
    handle(&mut page).ready();
    let log = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/logs/clean.csv")).expect("a log");
    told(&mut page);
    handle(&mut page).opened("clean.csv", Ok(log));
    page.run_steps(12);
    assert_eq!(app(&page).log(), Some("clean.csv"));
    assert!(!app(&page).run().events().is_empty());
    ask(&mut page, json!({ "do": "seek", "time": 5.9 }));
    let (answer, mut all) = ask(&mut page, json!({ "do": "play" }));
    assert_eq!(
        (&answer["result"], &answer["state"]["phase"], &answer["state"]["end"]),
        (&Value::Null, &Value::Null, &Value::Null)
    );
    // Over both alarms.
    for _ in 0..400 {
        page.step();
        if app(&page).state().time > 6.3 {
            break;
        }
    }
    assert!(app(&page).state().time > 6.3, "{}", app(&page).state().time);
    all.extend(told(&mut page));
    for message in all {
        assert!(message["event"] != "event" && message["result"].is_null(), "{message}");
    }
}

#[test]
fn a_frame_has_the_theme_that_its_link_or_its_host_gives_it() {
    let mut page = framed(vec2(640.0, 360.0), Embed::Robot, "preset=bench&t=6.27&theme=light");
    page.run_steps(2);
    assert_eq!(page.ctx.theme(), egui::Theme::Light);
    let (answer, _) = ask(&mut page, json!({ "do": "set", "key": "theme", "value": "dark" }));
    assert_eq!(answer["event"], "answer", "{answer}");
    assert!(answer["link"].as_str().is_some_and(|link| link.ends_with("&theme=dark")), "{answer}");
    page.run_steps(2);
    assert_eq!(page.ctx.theme(), egui::Theme::Dark);
    let (answer, _) = ask(&mut page, json!({ "do": "get", "key": "theme" }));
    assert_eq!(answer["asked"]["theme"], "dark", "{answer}");
    let (answer, _) = ask(&mut page, json!({ "do": "set", "key": "theme", "value": "pink" }));
    assert_eq!((&answer["event"], &answer["refused"][0]["key"]), (&json!("error"), &json!("theme")), "{answer}");
    let (answer, _) = ask(&mut page, json!({ "do": "set", "key": "challenge", "value": "clamp" }));
    assert_eq!((&answer["event"], &answer["refused"][0]["key"]), (&json!("error"), &json!("challenge")), "{answer}");
}
