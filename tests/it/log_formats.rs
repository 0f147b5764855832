//! Logs as trackers, data sets and ROS write them, made from one simulated experiment.

use crate::cli::{centrode, json};
use crate::logs::Scratch;
use centrode_core::model::orientation::{from_euler, quaternion_from_euler, to_euler};
use centrode_core::model::{Mat3, Vec3};
use centrode_core::record::log::mcap::{container, write as mcap};
use centrode_core::record::log::{Log, Options, write};
use centrode_core::record::{Entry, Recorder};
use centrode_core::scenario::Plan;
use centrode_core::scenario::preset::find;
use centrode_core::sensors::tracker::refresh;
use serde_json::Value;
use std::fmt::Write;

/// The experiment behind every file here.
pub fn plan() -> Plan {
    Plan::new(&find("bench").and_then(|preset| preset.scenario()).expect("bench")).expect("bench")
}

/// What the loop stored, at each new reading of the tracker.
pub fn readings(plan: &Plan) -> Vec<Entry> {
    let mut last = None;
    let rate = plan.scenario().tracker.rate;
    let fresh = |entry: &Entry| last.replace(refresh(rate, entry.time)) != Some(refresh(rate, entry.time));
    Recorder::new(plan).map(|(entry, _)| entry).filter(fresh).collect()
}

/// When the contact was detected.
#[track_caller]
fn detected(args: &[&str]) -> f64 {
    let report = json(&[&["analyze"], args, &["--preset", "bench", "--json"]].concat());
    report["detection"]["time"].as_f64().unwrap_or_else(|| panic!("{args:?} detects nothing: {report:#}"))
}

/// When the simulated run detects it.
const DETECTED: f64 = 6.26;

/// A tracker's frame: R(angles) p + shift brings what it reads into {B}.
const ANGLES: [f64; 3] = [0.5, -0.3, 1.1];
const SHIFT: [f64; 3] = [0.2, -0.4, 1.5];

/// A reading in that frame, with a marker that is turned on its disk.
fn elsewhere(entry: &Entry, marker: &Mat3) -> (Vec3, [f64; 3]) {
    let back = from_euler(&ANGLES).transpose();
    let position = back * (entry.reading.position - Vec3::from(SHIFT));
    (position, to_euler(&(back * from_euler(&entry.reading.angles) * marker.transpose())))
}

#[test]
fn a_euroc_trajectory_is_read_with_its_epoch() {
    let mut text = "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v [m s^-1]\n".to_owned();
    for entry in readings(&plan()) {
        let [w, x, y, z] = quaternion_from_euler(&entry.reading.angles);
        let p = entry.reading.position;
        let stamp = 1_403_636_580_838_555_648u64 + (entry.time * 1e9).round() as u64;
        writeln!(text, "{stamp},{},{},{},{w},{x},{y},{z},0", p.x, p.y, p.z).expect("a text");
    }
    let log = Scratch::new("data.csv", text.as_bytes());
    let time = detected(&[log.path(), "--commands", "motion"]);
    assert!((time - DETECTED).abs() < 0.002, "{time}");
    let report = json(&["analyze", log.path(), "--preset", "bench", "--commands", "motion", "--json"]);
    assert_eq!(report["log"]["format"], "euroc");
    assert!((report["log"]["start"].as_f64().expect("s") - 1_403_636_580.838_555_6).abs() < 1e-6);
}

/// An NDI file with a reference in front of the tool; the tool has two markers, and is missing now and then.
pub fn ndi(entries: &[Entry]) -> String {
    let mut text =
        "#Tools,ToolInfo,Frame#,PortHandle,Face#,TransformStatus,Q0,Qx,Qy,Qz,Tx,Ty,Tz,Error,Markers,State,Tx,Ty,Tz\n"
            .to_owned();
    for (k, entry) in entries.iter().enumerate() {
        let (position, angles) = elsewhere(entry, &Mat3::identity());
        let [w, x, y, z] = quaternion_from_euler(&angles);
        let p = position * 1e3;
        let frame = 5000 + k;
        write!(text, "2,REF s/n:1,{frame},Port:1,0,OK,1,0,0,0,0,0,-1000,0.1,1,OK,1,2,3,").expect("a text");
        if k % 97 == 50 {
            writeln!(text, "TIP s/n:2,{frame},Port:2,0,Missing,,,,,,,,,0").expect("a text");
        } else {
            writeln!(
                text,
                "TIP s/n:2,{frame},Port:2,0,OK,{w:.6},{x:.6},{y:.6},{z:.6},{:.4},{:.4},{:.4},0.05,2,OK,1,2,3,Missing,,,",
                p.x, p.y, p.z
            )
            .expect("a text");
        }
    }
    text
}

#[test]
fn an_ndi_file_is_read_tool_by_tool_and_its_frame_is_fitted() {
    let log = Scratch::new("ndi.csv", ndi(&readings(&plan())).as_bytes());
    let output = centrode(&["analyze", log.path(), "--preset", "bench", "--commands", "motion"]);
    let message = String::from_utf8(output.stderr).expect("UTF-8");
    for part in ["2 tools", "1 (REF s/n:1", "2 (TIP s/n:2", "--tool"] {
        assert!(message.contains(part), "{message}");
    }
    for tool in ["2", "TIP", "Port:2"] {
        let args = [
            "analyze",
            log.path(),
            "--preset",
            "bench",
            "--commands",
            "motion",
            "--tool",
            tool,
            "--fit-frame",
            "--json",
        ];
        let report = json(&args);
        let time = report["detection"]["time"].as_f64().expect("detected");
        assert!((time - DETECTED).abs() < 0.05, "{tool}: {time}");
        let fit = &report["log"]["frame"];
        assert!(fit["marker"].is_null(), "{fit}");
        for (k, shift) in SHIFT.iter().enumerate() {
            assert!((fit["frame"]["position"][k].as_f64().expect("m") - shift).abs() < 2e-3, "{fit}");
            assert!((fit["frame"]["angles"][k].as_f64().expect("rad") - ANGLES[k]).abs() < 2e-3, "{fit}");
        }
        assert!(
            fit["position_rms"].as_f64().expect("m") < 2e-4 && fit["orientation_rms"].as_f64().expect("rad") < 2e-3
        );
        let counts = report["log"]["report"]["counts"].as_array().expect("counts");
        assert!(counts.iter().any(|count| count["what"] == "bad-quality" && count["count"] == 10), "{counts:?}");
    }
}

/// A CSV in another frame, with the marker turned on its disk.
fn turned(marker: &Mat3, orientation: bool) -> String {
    let mut text =
        "time [s],x [mm],y [mm],z [mm],azimuth [deg],elevation [deg],roll [deg],bend [rad],delta [rad]\n".to_owned();
    for (entry, _) in Recorder::new(&plan()) {
        let (p, angles) = elsewhere(&entry, marker);
        let [azimuth, elevation, roll] = angles.map(|angle| if orientation { angle.to_degrees() } else { f64::NAN });
        let (bend, delta) = (entry.configuration.bend(), entry.configuration.delta());
        writeln!(
            text,
            "{},{},{},{},{azimuth},{elevation},{roll},{bend},{delta}",
            entry.time,
            p.x * 1e3,
            p.y * 1e3,
            p.z * 1e3
        )
        .expect("a text");
    }
    if orientation { text } else { text.replace("azimuth [deg],elevation [deg],roll [deg]", "a,b,c") }
}

#[test]
fn a_frame_and_a_marker_are_fitted_and_what_remains_is_told() {
    let marker = from_euler(&[0.7, 0.2, -0.4]);
    let log = Scratch::new("turned.csv", turned(&marker, true).as_bytes());
    let wrong = json(&["analyze", log.path(), "--preset", "bench", "--json"]);
    assert!(wrong["detection"]["time"].as_f64().is_none_or(|time| (time - DETECTED).abs() > 0.1), "it is elsewhere");
    let report = json(&["analyze", log.path(), "--preset", "bench", "--fit-frame", "--json"]);
    let fit = &report["log"]["frame"];
    for (k, shift) in SHIFT.iter().enumerate() {
        assert!((fit["frame"]["position"][k].as_f64().expect("m") - shift).abs() < 5e-3, "{fit}");
        assert!((fit["frame"]["angles"][k].as_f64().expect("rad") - ANGLES[k]).abs() < 2e-3, "{fit}");
    }
    // Readings err by 0.05 mm: of a frame 1.5 m away the place by the robot is known better than its origin.
    assert!(fit["position_rms"].as_f64().expect("m") < 1e-4 && fit["orientation_rms"].as_f64().expect("rad") < 1e-3);
    let turned = fit["marker"].as_array().expect("a marker");
    let turned: Vec<f64> = turned.iter().map(|angle| angle.as_f64().expect("rad")).collect();
    let rest = from_euler(&[turned[0], turned[1], turned[2]]) - marker;
    assert!(rest.norm() < 5e-3, "{fit}");
    let time = report["detection"]["time"].as_f64().expect("detected");
    assert!((time - DETECTED).abs() < 0.02, "{time}");
    // The same frame given by hand; a marker that is turned does not matter to the centrode.
    let frame = [SHIFT, ANGLES].concat().iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let given = detected(&[log.path(), "--frame", &frame]);
    assert!((given - DETECTED).abs() < 0.02, "{given}");
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let refused = |args: &[&str]| {
        let output = centrode(&[&["analyze"], args].concat());
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        String::from_utf8(output.stderr).expect("UTF-8")
    };
    let log = Scratch::new("places.csv", turned(&Mat3::identity(), false).as_bytes());
    let still = refused(&[log.path(), "--preset", "bench", "--fit-frame", "--set", "detection.armed_from=2"]);
    assert!(still.contains("does not move enough") && still.contains("detection.armed_from = 2 s"), "{still}");
    let few = refused(&[log.path(), "--preset", "bench", "--fit-frame", "--set", "detection.armed_from=0"]);
    assert!(few.contains("fewer than three"), "{few}");
    assert!(refused(&[log.path(), "--frame", "1,2,3"]).contains("x,y,z,azimuth,elevation,roll"));
    let fitted = json(&["analyze", log.path(), "--preset", "bench", "--fit-frame", "--json"]);
    assert!(fitted["log"]["frame"]["orientation_rms"].is_null());
    assert_eq!(fitted["log"]["detectors"][0]["why"], "no orientation: FCD needs it");
}

/// An MCAP file of the experiment, as the command writes it.
pub fn container(plan: &Plan) -> Vec<u8> {
    let mut out = Vec::new();
    mcap::begin(&mut out);
    let (mut last, mut readings, rate) = (None, 0, plan.scenario().tracker.rate);
    for (k, (entry, _)) in Recorder::new(plan).enumerate() {
        if last.replace(refresh(rate, entry.time)) != Some(refresh(rate, entry.time)) {
            mcap::pose(&mut out, readings, &entry);
            readings += 1;
        }
        mcap::state(&mut out, k as u32, &entry, plan.segment().pitch_radius);
    }
    mcap::end(&mut out);
    out
}

#[test]
fn an_mcap_file_holds_what_was_stored() {
    let log = Scratch::new("run.mcap", b"");
    let ran = json(&["run", "--preset", "bench", "--log", log.path(), "--json"]);
    assert_eq!(log.bytes(), container(&plan()));
    let report = json(&["analyze", log.path(), "--preset", "bench", "--json"]);
    let of = |report: &Value, detector: &str| {
        let events = report["events"].as_array().expect("events").clone();
        events.into_iter().find(|event| event["detector"] == detector).expect("an event")
    };
    assert_eq!(of(&ran, "jfd"), of(&report, "jfd"), "command and load cells keep every bit");
    assert_eq!(of(&ran, "fcd")["raised"], of(&report, "fcd")["raised"]);
    // A reader of its own agrees.
    let bytes = log.bytes();
    let messages: Vec<_> = ::mcap::MessageStream::new(&bytes).expect("MCAP").map(|m| m.expect("a message")).collect();
    assert_eq!(messages.len(), 10_001 + 1001);
    assert_eq!(messages[0].channel.topic, "/tracker/pose");
    assert_eq!(messages[0].channel.schema.as_ref().expect("a schema").name, "geometry_msgs/msg/PoseStamped");
}

/// The records of a file in chunks of one compression.
fn chunked(bytes: &[u8], compression: &str, compress: impl Fn(&[u8]) -> Vec<u8>) -> Vec<u8> {
    let start = container::MAGIC.len();
    let mut at = start;
    let mut out = container::MAGIC.to_vec();
    let put = |out: &mut Vec<u8>, op: u8, body: &[u8]| {
        out.push(op);
        out.extend((body.len() as u64).to_le_bytes());
        out.extend(body);
    };
    let flush = |out: &mut Vec<u8>, from: usize, to: usize| {
        let (plain, stored) = (&bytes[from..to], compress(&bytes[from..to]));
        let mut body = [0u64.to_le_bytes(), 0u64.to_le_bytes(), (plain.len() as u64).to_le_bytes()].concat();
        body.extend(crc32fast::hash(plain).to_le_bytes());
        body.extend((compression.len() as u32).to_le_bytes());
        body.extend(compression.as_bytes());
        body.extend((stored.len() as u64).to_le_bytes());
        body.extend(stored);
        put(out, container::op::CHUNK, &body);
    };
    let mut from = start;
    while let Some(record) = container::record(bytes, at) {
        if record.op == container::op::DATA_END {
            break;
        }
        at = record.body.end;
        if at - from > 300_000 {
            flush(&mut out, from, at);
            from = at;
        }
    }
    flush(&mut out, from, at);
    mcap::end(&mut out);
    out
}

#[test]
fn chunks_are_read_however_they_are_compressed() {
    let plain = container(&plan());
    let read = |bytes: Vec<u8>| Log::read("x.mcap", bytes, &Options::default());
    let whole = read(plain.clone()).expect("a log");
    let lz4 = |bytes: &[u8]| {
        let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
        std::io::Write::write_all(&mut encoder, bytes).expect("lz4");
        encoder.finish().expect("lz4")
    };
    let zstd = |bytes: &[u8]| ruzstd::encoding::compress_to_vec(bytes, ruzstd::encoding::CompressionLevel::Fastest);
    for bytes in [chunked(&plain, "", <[u8]>::to_vec), chunked(&plain, "lz4", lz4), chunked(&plain, "zstd", zstd)] {
        assert!(read(bytes).expect("a log") == whole);
    }
    for (bytes, part) in [
        (chunked(&plain, "brotli", <[u8]>::to_vec), "compressed by \"brotli\"; allowed: none, zstd, lz4"),
        (chunked(&plain, "zstd", <[u8]>::to_vec), "no zstd"),
        (chunked(&plain, "lz4", <[u8]>::to_vec), "no lz4"),
        (chunked(&plain, "", |bytes| [&bytes[1..], &[0]].concat()), "checksum"),
    ] {
        let message = read(bytes).expect_err("refused").to_string();
        assert!(message.contains(part), "{message}");
    }
    // A file cut anywhere gives what came before.
    let cut = read(plain[..plain.len() / 2].to_vec()).expect("a log");
    assert!(cut.readings.len() < whole.readings.len() && cut.report.sentences().any(|line| line.contains("cut")));
}

/// A file of JSON messages on given topics, with a channel of its own for each message where `apart`.
pub fn json_mcap(messages: &[(&str, &str, String)]) -> Vec<u8> {
    channelled(messages, false)
}

fn channelled(messages: &[(&str, &str, String)], apart: bool) -> Vec<u8> {
    let mut out = std::io::Cursor::new(Vec::new());
    let mut writer = ::mcap::WriteOptions::new().compression(None).create(&mut out).expect("MCAP");
    for (k, (topic, schema, data)) in messages.iter().enumerate() {
        let schema = writer.add_schema(schema, "jsonschema", b"{}").expect("a schema");
        // Channels that differ in their metadata are different ones.
        let publisher = std::collections::BTreeMap::from([("publisher".to_owned(), k.to_string())]);
        let metadata = if apart { publisher } else { std::collections::BTreeMap::new() };
        let channel = writer.add_channel(schema, topic, "json", &metadata).expect("a channel");
        let time = k as u64 * 10_000_000;
        let header = ::mcap::records::MessageHeader {
            channel_id: channel,
            sequence: k as u32,
            log_time: time,
            publish_time: time,
        };
        writer.write_to_known_channel(&header, data.as_bytes()).expect("written");
    }
    writer.finish().expect("finished");
    drop(writer);
    out.into_inner()
}

#[test]
fn json_messages_are_read_and_topics_are_chosen() {
    let transform = r#"{"transform":{"translation":{"x":0,"y":0,"z":0.03},"rotation":{"x":0,"y":0,"z":0,"w":1}}}"#;
    let pose = r#"{"pose":{"position":{"x":0,"y":0,"z":0.01},"orientation":{"x":0,"y":0,"z":0,"w":1}}}"#;
    let joints = r#"{"header":{"stamp":{"sec":1,"nanosec":5}},"name":["a","b","c"],"position":[0.001,-0.0005,-0.0005],"effort":[1,2,null]}"#;
    let wrench = r#"{"wrench":{"force":{"x":4,"y":5,"z":6},"torque":{"x":0,"y":0,"z":0}}}"#;
    let bytes = json_mcap(&[
        ("/tip", "geometry_msgs/TransformStamped", transform.into()),
        ("/base", "geometry_msgs/msg/PoseStamped", pose.into()),
        ("/joints", "sensor_msgs/msg/JointState", joints.into()),
        ("/cells", "geometry_msgs/msg/WrenchStamped", wrench.into()),
    ]);
    let read = |topics: &[&str]| {
        let topics = topics.iter().map(|topic| (*topic).into()).collect();
        Log::read("x.mcap", bytes.clone(), &Options { topics, ..Options::default() })
    };
    let message = read(&[]).expect_err("two poses").to_string();
    assert!(
        message.contains("/tip (geometry_msgs/TransformStamped, 1 messages)") && message.contains("--topic"),
        "{message}"
    );
    let one = json_mcap(&[
        ("/tip", "geometry_msgs/TransformStamped", transform.into()),
        ("/joints", "sensor_msgs/msg/JointState", joints.into()),
        ("/others", "sensor_msgs/msg/JointState", joints.into()),
    ]);
    let joints_alone = Options { topics: vec!["/joints".into()], ..Options::default() };
    let log = Log::read("x.mcap", one, &joints_alone).expect("a log");
    assert_eq!((log.readings.len(), log.joints.len()), (1, 1), "a topic of joints leaves the only pose");
    assert!(read(&["/none"]).expect_err("none").to_string().contains("no topic \"/none\""));
    let log = read(&["/tip"]).expect("a log");
    assert_eq!(log.readings.values[0][..3], [0.0, 0.0, 0.03]);
    assert_eq!((log.joints.values[0], log.joints.times[0]), ([0.001, -0.0005, -0.0005], 1.000_000_005));
    assert_eq!(log.forces.values[0][..2], [1.0, 2.0], "efforts come before a wrench");
    let broken = json_mcap(&[("/tip", "geometry_msgs/PoseStamped", r#"{"pose":{"position":{"x":"far"}}}"#.into())]);
    let message = Log::read("x.mcap", broken, &Options::default()).expect_err("broken").to_string();
    assert!(message.contains("line 1 (/tip)") && message.contains("far"), "{message}");
}

#[test]
fn a_topic_with_two_publishers_is_one() {
    let at = |x: f64| {
        format!(r#"{{"pose":{{"position":{{"x":{x},"y":0,"z":0}},"orientation":{{"x":0,"y":0,"z":0,"w":1}}}}}}"#)
    };
    let messages = [0.1, 0.2, 0.3].map(|x| ("/tip", "geometry_msgs/PoseStamped", at(x)));
    let read = |bytes| Log::read("x.mcap", bytes, &Options::default()).expect("a log");
    let log = read(channelled(&messages, true));
    assert_eq!(log.readings.values.iter().map(|value| value[0]).collect::<Vec<_>>(), [0.1, 0.2, 0.3]);
    assert_eq!(log, read(json_mcap(&messages)));
}

#[test]
fn the_least_stamp_that_there_is_does_no_harm() {
    let text = b"time [ns],x,y,z\n-9223372036854775808,0,0,0\n0,0,0,0\n".to_vec();
    assert!(Log::read("x.csv", text, &Options::default()).is_ok_and(|log| log.readings.len() == 2));
    let pose = r#"{"header":{"stamp":{"sec":-9223372036,"nanosec":-854775808}},
        "pose":{"position":{"x":0,"y":0,"z":0},"orientation":{"x":0,"y":0,"z":0,"w":1}}}"#;
    let bytes = json_mcap(&[("/tip", "geometry_msgs/PoseStamped", pose.into())]);
    assert!(Log::read("x.mcap", bytes, &Options::default()).is_ok_and(|log| log.readings.len() == 1));
}

#[test]
fn a_log_of_the_library_is_the_log_of_the_command() {
    let log = Scratch::new("bench.csv", b"");
    assert!(centrode(&["run", "--preset", "bench", "--log", log.path()]).status.success());
    let mut text = write::csv_header();
    Recorder::new(&plan()).for_each(|(entry, _)| write::csv_row(&mut text, &entry));
    assert!(log.text() == text);
}
