//! Logs of several trackers: written by the command, read back, and read as rigs and simulators write them.

use crate::cli::{centrode, json};
use crate::log_formats::json_mcap;
use crate::logs::Scratch;
use centrode_core::model::Vec3;
use centrode_core::model::chain::joints::joints;
use centrode_core::model::orientation::{from_euler, quaternion_from_euler, to_euler};
use centrode_core::record::chain::ChainRecording;
use centrode_core::record::log::write;
use centrode_core::scenario::ChainPlan;
use centrode_core::scenario::preset::find_chain;
use serde_json::Value;
use std::fmt::Write;
use std::sync::LazyLock;

/// The preset `two-contacts`, simulated once.
pub static RIG: LazyLock<ChainRecording> = LazyLock::new(|| {
    let scenario = find_chain("two-contacts").expect("a preset").chain(&[]).expect("valid");
    ChainRecording::simulated(&ChainPlan::new(&scenario).expect("stable"))
});
/// What its run comes to.
static RUN: LazyLock<Value> = LazyLock::new(|| json(&["run", "--json", "--preset", "two-contacts"]));

const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];

/// A value of the rig by name, disk (from 0) and instant; lengths in m.
fn value(name: &str, disk: usize, at: usize) -> f64 {
    let told = RIG.told[disk][at].configuration;
    let reading = RIG.readings[disk].as_ref().expect("a tracker")[at];
    let quaternion = || quaternion_from_euler(&reading.angles);
    let place = |names: &[&str]| names.iter().position(|other| *other == name).expect(name);
    match name {
        "time" => RIG.times[at],
        "x" | "y" | "z" => reading.position[place(&["x", "y", "z"])],
        "azimuth" | "elevation" | "roll" => reading.angles[place(&["azimuth", "elevation", "roll"])],
        "qw" | "qx" | "qy" | "qz" => quaternion()[place(&QUATERNION)],
        // The second tracker was hidden for a fifth of a second.
        "quality" => f64::from(u8::from(!(disk == 1 && (3400..3600).contains(&at)))),
        "theta_l" => told.theta_l(),
        "bend" => told.bend(),
        "delta" => told.delta(),
        "q1" | "q2" | "q3" => {
            let configurations: Vec<_> = RIG.told[..=disk].iter().map(|told| told[at].configuration).collect();
            let offsets = [0.0, 0.698_131_700_797_731_8, 1.396_263_401_595_463_6];
            joints(0.003, &offsets[..=disk], &configurations)[disk][place(&["q1", "q2", "q3"])]
        }
        other => panic!("{other}"),
    }
}

/// The instants of a log with a row for each reading of the tracker.
fn instants() -> impl Iterator<Item = usize> {
    (0..RIG.times.len()).step_by(10)
}

/// A CSV file with a set of columns for each disk; `header` names one of them.
fn wide(names: &[&str], scale: f64, header: impl Fn(&str, usize) -> String) -> String {
    let mut text = String::from("time [s]");
    for disk in 0..3 {
        names.iter().for_each(|name| write!(text, ",{}", header(name, disk + 1)).expect("a text"));
    }
    text.push('\n');
    for at in instants() {
        write!(text, "{}", RIG.times[at]).expect("a text");
        for disk in 0..3 {
            for name in names {
                let scale = if ["x", "y", "z"].contains(name) { scale } else { 1.0 };
                write!(text, ",{}", value(name, disk, at) * scale).expect("a text");
            }
        }
        text.push('\n');
    }
    text
}

fn analyzed(args: &[&str]) -> Value {
    json(&[&["analyze", "--preset", "two-contacts", "--json"], args].concat())
}

/// That both contacts are told and placed as in the simulated run: within a reading of the tracker, and a sixth of what its intervals allow.
#[track_caller]
fn same_contacts(report: &Value, name: &str) {
    let (found, run) = (report["found"].as_array().expect("found"), RUN["found"].as_array().expect("found"));
    assert_eq!(found.len(), run.len(), "{name}: {report}");
    let near = |a: &Value, b: &Value, most: f64| (a.as_f64().expect(name) - b.as_f64().expect(name)).abs() < most;
    for (ours, theirs) in found.iter().zip(run) {
        assert!(near(&ours["alarm"], &theirs["alarm"], 0.0101), "{name}: {ours}");
        let last = |of: &Value| of["estimates"].as_array().and_then(|all| all.last().cloned()).expect("placed");
        let (ours, theirs) = (last(ours), last(theirs));
        assert_eq!(ours["segment"], theirs["segment"], "{name}");
        for key in ["at", "low", "high", "along"] {
            assert!(near(&ours[key], &theirs[key], 5e-5), "{name}: {key} {} {}", ours[key], theirs[key]);
        }
    }
}

/// Whether two reports are the same but for the last digits of numbers.
fn near(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| near(a, b)),
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| near(a, b)))
        }
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().expect("a number"), b.as_f64().expect("a number"));
            (a - b).abs() <= 1e-5 * a.abs().max(1e-3)
        }
        (a, b) => a == b,
    }
}

#[test]
fn a_log_read_back_gives_the_same_answers() {
    for preset in ["two-contacts", "reopened", "tip-only"] {
        let log = Scratch::new("chain.csv", b"");
        let ran = json(&["run", "--preset", preset, "--json", "--log", log.path()]);
        let judged = json(&["analyze", log.path(), "--preset", preset, "--json"]);
        assert!(!ran["events"].as_array().expect("events").is_empty(), "{preset}");
        for key in ["events", "found", "segments", "detector", "end"] {
            // Rates are differences of commands in a log: that is all that differs.
            assert!(near(&ran[key], &judged[key]), "{preset}: {key}: {} {}", ran[key], judged[key]);
        }
        assert_eq!((&judged["contacts"], &judged["plant_events"]), (&Value::Array(vec![]), &Value::Array(vec![])));
        assert_eq!(judged["log"]["commands"], Value::from(vec!["log"; 3]), "{preset}");
        assert!(ran.get("log").is_none());
    }
}

#[test]
fn where_a_segment_turns_about_its_rate_is_a_difference_of_its_commands() {
    let log = Scratch::new("turning.csv", b"");
    let args = ["--preset", "three-segments", "--set", "segment[2].motion.delta_end=0.9", "--json"];
    let ran = json(&[&["run", "--log", log.path()][..], &args].concat());
    let judged = json(&[&["analyze", log.path()][..], &args].concat());
    assert!(near(&ran["found"], &judged["found"]), "{} {}", ran["found"], judged["found"]);
    let times = |report: &Value| -> Vec<(String, f64)> {
        let each = report["events"].as_array().expect("events").iter();
        each.map(|event| (format!("{} {}", event["detector"], event["segment"]), event["raised"].as_f64().expect("s")))
            .collect()
    };
    let (ran, judged) = (times(&ran), times(&judged));
    assert_eq!(ran.len(), judged.len());
    assert!(ran.iter().zip(&judged).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 0.0021), "{ran:?} {judged:?}");
}

#[test]
fn every_reading_and_command_of_a_written_log_is_the_same() {
    let mut text = write::chain_csv_header(&RIG);
    (0..RIG.times.len()).for_each(|at| write::chain_csv_row(&mut text, &RIG, at));
    let log = Scratch::new("bits.csv", text.as_bytes());
    let (ran, judged) = (Scratch::new("ran.csv", b""), Scratch::new("judged.csv", b""));
    assert!(centrode(&["run", "--preset", "two-contacts", "--csv", ran.path()]).status.success());
    assert!(centrode(&["analyze", log.path(), "--preset", "two-contacts", "--csv", judged.path()]).status.success());
    let (ran, judged) = (ran.text(), judged.text());
    let header: Vec<&str> = ran.lines().next().expect("a header").split(',').collect();
    assert_eq!(ran.lines().count(), judged.lines().count());
    // What rests on commanded rates, which are differences in a log, differs in its last digits.
    let kept = |name: &str| !["disk_", "force_", "stability", "cusum"].iter().any(|truth| name.starts_with(truth));
    let names: Vec<&str> = judged.lines().next().expect("a header").split(',').collect();
    let place = |name: &str| names.iter().position(|other| *other == name);
    let kept: Vec<(usize, usize)> = header
        .iter()
        .enumerate()
        .filter(|(_, name)| kept(name))
        .filter_map(|(k, name)| Some((k, place(name)?)))
        .collect();
    assert!(kept.len() > 33, "{names:?}");
    for (a, b) in ran.lines().zip(judged.lines()) {
        let (a, b): (Vec<&str>, Vec<&str>) = (a.split(',').collect(), b.split(',').collect());
        assert!(kept.iter().all(|(ours, theirs)| a[*ours] == b[*theirs]), "{a:?} {b:?}");
    }
}

#[test]
fn columns_are_told_apart_by_many_names() {
    let angles = ["x", "y", "z", "azimuth", "elevation", "roll", "theta_l", "delta"];
    let quaternions = ["x", "y", "z", "qw", "qx", "qy", "qz", "theta_l", "delta"];
    let joints = ["x", "y", "z", "qx", "qy", "qz", "qw", "q1", "q2", "q3"];
    type Header = fn(&str, usize) -> String;
    let cases: [(&str, &[&str], f64, Header); 7] = [
        ("suffix", &quaternions, 1e3, |name, disk| {
            let unit = if name.len() == 1 { " [mm]" } else { "" };
            format!("{name}{disk}{unit}")
        }),
        ("group", &angles, 1.0, |name, disk| format!("disk{disk}.{name}")),
        ("segment", &quaternions, 1.0, |name, disk| format!("segment_{disk}_{name}")),
        ("unit before the number", &angles, 1e3, |name, disk| {
            let unit = if name.len() == 1 { "_mm" } else { "" };
            format!("{name}{unit}_{disk}")
        }),
        ("from nought", &quaternions, 1.0, |name, disk| format!("tracker{}/{name}", disk - 1)),
        ("joints of a disk", &joints, 1.0, |name, disk| match name.strip_prefix('q') {
            Some(joint) if joint.parse::<u8>().is_ok() => format!("q{disk}_{joint}"),
            _ => format!("{name}_{disk}"),
        }),
        ("joints, the disk last", &joints, 1.0, |name, disk| format!("{name}_{disk}")),
    ];
    for (case, names, scale, header) in cases {
        let log = Scratch::new("names.csv", wide(names, scale, header).as_bytes());
        let report = analyzed(&[log.path()]);
        same_contacts(&report, case);
        assert_eq!(report["log"]["rows"], 1001, "{case}");
    }
}

#[test]
fn the_long_form_has_a_row_for_each_disk() {
    let names = ["x", "y", "z", "azimuth", "elevation", "roll", "bend", "delta"];
    for (case, column, label) in [
        ("numbers", "disk", ["1", "2", "3"]),
        ("from nought", "segment_id", ["0", "1", "2"]),
        ("floats", "tool", ["1.0", "2.0", "3.0"]),
        ("words", "Segment", ["proximal", "middle", "distal"]),
        ("names", "name", ["aurora A", "aurora B", "aurora C"]),
    ] {
        let mut text = format!("time [s],{column},{}\n", names.join(","));
        for at in instants() {
            for disk in [2, 0, 1] {
                // Names that tell no disk count in the order in which they appear.
                let disk = if case == "names" { (disk + 1) % 3 } else { disk };
                let cells: Vec<String> = names.iter().map(|name| value(name, disk, at).to_string()).collect();
                writeln!(text, "{},{},{}", RIG.times[at], label[disk], cells.join(",")).expect("a text");
            }
        }
        let log = Scratch::new("long.csv", text.as_bytes());
        let report = analyzed(&[log.path()]);
        same_contacts(&report, case);
        assert_eq!(report["log"]["rows"], 3003, "{case}");
    }
}

/// An NDI file with a tool for each of these disks (from 0), and none where there is no such disk.
fn ndi(tools: &[Option<usize>]) -> String {
    let mut text =
        "#Tools,ToolInfo,Frame#,PortHandle,Face#,TransformStatus,Q0,Qx,Qy,Qz,Tx,Ty,Tz,Error,Markers\n".to_owned();
    for at in instants() {
        write!(text, "{}", tools.len()).expect("a text");
        for tool in tools {
            let [disk, frame] = [tool.map_or(9, |disk| disk + 1), at / 10];
            write!(text, ",M{disk} s/n:{disk},{frame},Port:{disk},0,OK").expect("a text");
            let (q, p) = match tool {
                Some(disk) => {
                    (QUATERNION.map(|name| value(name, *disk, at)), ["x", "y", "z"].map(|name| value(name, *disk, at)))
                }
                None => ([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
            };
            q.iter().for_each(|part| write!(text, ",{part}").expect("a text"));
            p.iter().for_each(|part| write!(text, ",{}", part * 1e3).expect("a text"));
            text += ",0.1,0";
        }
        text.push('\n');
    }
    text
}

#[test]
fn an_ndi_file_has_a_tool_for_each_disk() {
    let log = Scratch::new("tools.csv", ndi(&[Some(0), Some(1), Some(2)]).as_bytes());
    let report = analyzed(&[log.path(), "--commands", "motion"]);
    same_contacts(&report, "in order");
    assert_eq!(report["log"]["format"], "ndi");
    // With a tool of reference among them they are named.
    let log = Scratch::new("named-tools.csv", ndi(&[Some(2), None, Some(0), Some(1)]).as_bytes());
    let message = refused(&["analyze", log.path(), "--preset", "two-contacts", "--commands", "motion"]);
    assert!(
        message.contains("holds 4 tools") && message.contains("--tool") && message.contains("3 end disks"),
        "{message}"
    );
    let tools = ["--tool", "M1", "--tool", "Port:2", "--tool", "1"];
    same_contacts(&analyzed(&[&[log.path(), "--commands", "motion"][..], &tools].concat()), "named");
}

/// A trajectory of one disk, as TUM or as EuRoC has it.
fn trajectory(disk: usize, euroc: bool) -> String {
    let head = if euroc { "#timestamp [ns], p_x [m], …\n" } else { "# timestamp tx ty tz qx qy qz qw\n" };
    let mut text = head.to_owned();
    for at in instants() {
        let [x, y, z] = ["x", "y", "z"].map(|name| value(name, disk, at));
        let [qw, qx, qy, qz] = QUATERNION.map(|name| value(name, disk, at));
        let time = RIG.times[at];
        if euroc {
            let stamp = 1_700_000_000_000_000_000_i64 + (time * 1e9).round() as i64;
            writeln!(text, "{stamp},{x},{y},{z},{qw},{qx},{qy},{qz}").expect("a text");
        } else {
            writeln!(text, "{time} {x} {y} {z} {qx} {qy} {qz} {qw}").expect("a text");
        }
    }
    text
}

#[test]
fn trajectories_are_a_file_for_each_disk() {
    for euroc in [false, true] {
        let files: Vec<Scratch> =
            (0..3).map(|disk| Scratch::new(&format!("disk-{disk}.txt"), trajectory(disk, euroc).as_bytes())).collect();
        let [one, two, three] = [0, 1, 2].map(|disk: usize| files[disk].path());
        same_contacts(&analyzed(&[one, two, three, "--commands", "motion"]), "in order");
        let [one, two] = [format!("1={one}"), format!("2={two}")];
        same_contacts(&analyzed(&["--log", &two, "--log", three, "--log", &one, "--commands", "motion"]), "numbered");
    }
    let [a, b] = [0, 1].map(|disk| Scratch::new(&format!("of-{disk}.tum"), trajectory(disk, false).as_bytes()));
    let preset = ["--preset", "two-contacts", "--commands", "motion"];
    for (args, parts) in
        [(&[a.path()][..], &["one tracker", "3 end disks"][..]), (&[a.path(), b.path()], &["2 logs", "3 end disks"])]
    {
        let message = refused(&[&["analyze"], args, &preset].concat());
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
}

#[test]
fn an_mcap_file_has_a_topic_for_each_disk() {
    let mut messages: Vec<(&str, &str, String)> = Vec::new();
    let topics = ["/rig/disk3/pose", "/rig/disk1/pose", "/rig/disk2/pose"];
    // A stamp of nought is none.
    for at in instants().skip(1) {
        let nanoseconds = (RIG.times[at] * 1e9).round() as u64;
        let (sec, nanosec) = (nanoseconds / 1_000_000_000, nanoseconds % 1_000_000_000);
        let header = format!(r#""header":{{"stamp":{{"sec":{sec},"nanosec":{nanosec}}}}}"#);
        for (topic, disk) in topics.iter().zip([2, 0, 1]) {
            let [x, y, z] = ["x", "y", "z"].map(|name| value(name, disk, at));
            let [qw, qx, qy, qz] = QUATERNION.map(|name| value(name, disk, at));
            let pose = format!(
                r#"{{{header},"pose":{{"position":{{"x":{x},"y":{y},"z":{z}}},"orientation":{{"x":{qx},"y":{qy},"z":{qz},"w":{qw}}}}}}}"#
            );
            messages.push((topic, "geometry_msgs/msg/PoseStamped", pose));
        }
        let each = |name: &str| (0..3).map(|disk| value(name, disk, at).to_string()).collect::<Vec<_>>().join(",");
        let joints = format!(
            r#"{{{header},"name":["bend_1","bend_2","bend_3","delta_1","delta_2","delta_3"],"position":[{},{}]}}"#,
            each("bend"),
            each("delta")
        );
        messages.push(("/joint_states", "sensor_msgs/msg/JointState", joints));
    }
    let log = Scratch::new("rig.mcap", &json_mcap(&messages));
    let report = analyzed(&[log.path()]);
    same_contacts(&report, "topics");
    let notes = report["log"]["report"]["notes"].to_string();
    assert!(notes.contains("/rig/disk1/pose, /rig/disk2/pose, /rig/disk3/pose"), "{notes}");
    let named = ["--topic", topics[1], "--topic", topics[2], "--topic", topics[0]];
    same_contacts(&analyzed(&[&[log.path()][..], &named].concat()), "named topics");
    let message = refused(&[&["analyze", log.path(), "--preset", "two-contacts"], &named[..4]].concat());
    assert!(message.contains("2 topics") && message.contains("3 end disks"), "{message}");
}

#[test]
fn commands_come_from_a_second_file() {
    let names = ["x", "y", "z", "qx", "qy", "qz", "qw"];
    let header = |name: &str, disk: usize| format!("{name}_{disk}");
    let log = Scratch::new("trackers.csv", wide(&names, 1.0, header).as_bytes());
    let commands = Scratch::new("commands.csv", wide(&["theta_l", "delta"], 1.0, header).as_bytes());
    same_contacts(&analyzed(&[log.path(), "--commands", commands.path()]), "a second file");
    let message = refused(&["analyze", log.path(), "--preset", "two-contacts"]);
    assert!(message.contains("segments 1, 2, 3") && message.contains("--commands"), "{message}");
    // A segment that rests in the scenario needs no command.
    let text = wide(&["x", "y", "z", "qx", "qy", "qz", "qw", "theta_l", "delta"], 1.0, |name, disk| {
        let unsaid = disk == 1 && ["theta_l", "delta"].contains(&name);
        if unsaid { format!("note {name}") } else { format!("{name}_{disk}") }
    });
    let log = Scratch::new("rests.csv", text.replacen("note theta_l,note delta", "a,b", 1).as_bytes());
    let message = refused(&["analyze", log.path(), "--preset", "two-contacts"]);
    assert!(message.contains("segment 1:") && message.contains("theta_l_1"), "{message}");
    let still = ["--set", "segment[1].motion.theta_end=1.5707963267948966"];
    let report = analyzed(&[&[log.path()][..], &still].concat());
    assert_eq!(report["log"]["commands"], Value::from(vec!["motion", "log", "log"]));
}

#[test]
fn a_frame_is_fitted_to_all_trackers_with_each_marker_turned() {
    let (turn, shift) = (from_euler(&[0.4, -0.3, 1.1]), Vec3::new(0.2, -0.1, 0.5));
    let markers = [[0.0, 0.5, 0.0], [1.0, 0.0, -0.4], [-0.7, 0.2, 0.3]].map(|angles| from_euler(&angles));
    let mut text = String::from("time [s]");
    for disk in 1..=3 {
        for name in ["x", "y", "z", "azimuth", "elevation", "roll", "theta_l", "delta"] {
            write!(text, ",{name}_{disk}").expect("a text");
        }
    }
    text.push('\n');
    for at in instants() {
        write!(text, "{}", RIG.times[at]).expect("a text");
        for (disk, marker) in markers.iter().enumerate() {
            let reading = RIG.readings[disk].as_ref().expect("a tracker")[at];
            let position = turn.transpose() * (reading.position - shift);
            let angles = to_euler(&(turn.transpose() * from_euler(&reading.angles) * marker));
            position.iter().chain(&angles).for_each(|part| write!(text, ",{part}").expect("a text"));
            write!(text, ",{},{}", value("theta_l", disk, at), value("delta", disk, at)).expect("a text");
        }
        text.push('\n');
    }
    let log = Scratch::new("moved.csv", text.as_bytes());
    // Nothing touches before 5.2 s.
    let report = analyzed(&[log.path(), "--fit-frame", "--set", "detection.armed_from=5"]);
    let frames = report["log"]["frames"].as_array().expect("fitted");
    assert_eq!(frames.len(), 3);
    for (frame, marker) in frames.iter().zip(&markers) {
        let of = |value: &Value| -> Vec<f64> {
            value.as_array().expect("numbers").iter().map(|part| part.as_f64().expect("a number")).collect()
        };
        let position = of(&frame["frame"]["position"]);
        assert!(position.iter().zip(shift.iter()).all(|(a, b)| (a - b).abs() < 1e-3), "{frame}");
        let fitted = of(&frame["marker"]);
        let rest = from_euler(&[fitted[0], fitted[1], fitted[2]]) * *marker;
        assert!((rest - from_euler(&[0.0; 3])).norm() < 0.01, "{frame}");
    }
    let found = report["found"].as_array().expect("found");
    let segments: Vec<u64> = found
        .iter()
        .map(|found| found["estimates"].as_array().and_then(|all| all.last()?["segment"].as_u64()).expect("placed"))
        .collect();
    assert_eq!(segments, [2, 3], "{found:?}");
    // Without a fit the report says that something is wrong.
    let notes = analyzed(&[log.path()])["log"]["report"]["notes"].to_string();
    assert!(notes.contains("mm from where the model has the disk") && notes.contains("turned by"), "{notes}");
}

#[test]
fn a_marker_on_another_mounting_is_told() {
    let mut text =
        wide(&["x", "y", "z", "qw", "qx", "qy", "qz", "theta_l", "delta"], 1.0, |name, disk| format!("{name}{disk}"));
    let log = Scratch::new("mounted.csv", text.as_bytes());
    let notes = analyzed(&[log.path(), "--set", "tracker.mounting=aligned"])["log"]["report"]["notes"].to_string();
    assert!(notes.contains("segment 1:") && notes.contains("bending-axis"), "{notes}");
    let notes = analyzed(&[log.path()])["log"]["report"]["notes"].to_string();
    assert!(!notes.contains("turned by"), "{notes}");
    text = text.replacen(",z1,", ",z1 [mm],", 1);
    let log = Scratch::new("unit.csv", text.as_bytes());
    let notes = analyzed(&[log.path()])["log"]["report"]["notes"].to_string();
    assert!(notes.contains("segment 1:") && notes.contains("unit"), "{notes}");
}

#[test]
fn what_is_dropped_is_told_with_its_disk_and_gaps_stay_gaps() {
    let text = wide(&["x", "y", "z", "qw", "qx", "qy", "qz", "quality", "theta_l", "delta"], 1.0, |name, disk| {
        format!("{name}_{disk}")
    });
    let log = Scratch::new("gaps.csv", text.as_bytes());
    let report = analyzed(&[log.path()]);
    let counts = report["log"]["report"]["counts"].as_array().expect("counts");
    let bad: Vec<&Value> = counts.iter().filter(|count| count["what"] == "bad-quality").collect();
    assert_eq!(bad.len(), 1, "{counts:?}");
    assert_eq!((&bad[0]["count"], &bad[0]["first"]["name"]), (&Value::from(20), &Value::from("segment 2")));
    assert_eq!(bad[0]["first"]["line"], 342);
    let found = report["found"].as_array().expect("found");
    assert_eq!(found.len(), 2, "a gap is no contact: {found:?}");
    // What the others show in the gap belongs to no other instant of the one that was hidden.
    for (contact, segment) in found.iter().zip([2, 3]) {
        let estimates = contact["estimates"].as_array().expect("estimates");
        let last = estimates.last().expect("placed");
        assert_eq!(last["segment"], segment, "{contact}");
        let [low, high] = ["low", "high"].map(|key| last[key].as_f64().expect("a place"));
        assert!(low <= 0.015 && 0.015 <= high && high - low < 2e-3, "{contact}");
    }
}

/// What a command refuses to do, in its own words.
pub fn refused(args: &[&str]) -> String {
    let output = centrode(args);
    let message = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!((output.status.code(), message.lines().count()), (Some(2), 1), "{args:?}: {message}");
    message
}

#[test]
fn a_tracker_on_the_tip_alone_has_columns_without_a_number() {
    let mut text =
        String::from("time [s],x [mm],y [mm],z [mm],qw,qx,qy,qz,theta_l1,theta_l2,theta_l3,delta1,delta2,delta3\n");
    for at in instants() {
        write!(text, "{}", RIG.times[at]).expect("a text");
        ["x", "y", "z"].iter().for_each(|name| write!(text, ",{}", value(name, 2, at) * 1e3).expect("a text"));
        QUATERNION.iter().for_each(|name| write!(text, ",{}", value(name, 2, at)).expect("a text"));
        for name in ["theta_l", "delta"] {
            (0..3).for_each(|disk| write!(text, ",{}", value(name, disk, at)).expect("a text"));
        }
        text.push('\n');
    }
    let log = Scratch::new("tip.csv", text.as_bytes());
    let tip = ["--set", "tracker.disks=tip"];
    let judged = analyzed(&[&[log.path()][..], &tip].concat());
    let ran = json(&[&["run", "--preset", "two-contacts", "--json"][..], &tip].concat());
    let raised = |report: &Value| -> Vec<f64> {
        report["events"].as_array().expect("events").iter().map(|event| event["raised"].as_f64().expect("s")).collect()
    };
    let (judged, ran) = (raised(&judged), raised(&ran));
    assert_eq!(judged.len(), ran.len());
    assert!(!ran.is_empty() && ran.iter().zip(&judged).all(|(a, b)| (a - b).abs() < 0.0101), "{ran:?} {judged:?}");
    // With trackers on every end disk, their columns would say so.
    let message = refused(&["analyze", log.path(), "--preset", "two-contacts"]);
    assert!(message.contains("tracker.disks = \"tip\""), "{message}");
}
