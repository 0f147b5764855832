//! Logs: written by the command, read back, and read as rigs write them.

use crate::cli::{centrode, json, scratch};
use centrode_core::record::log::{Log, Options, Setup, assemble};
use centrode_core::scenario::Scenario;
use serde_json::Value;
use std::path::PathBuf;

/// A file that is gone at the end of its test.
pub struct Scratch(PathBuf);

impl Scratch {
    pub fn new(name: &str, content: &[u8]) -> Self {
        let path = scratch(name);
        std::fs::write(&path, content).expect("written");
        Self(path)
    }

    pub fn path(&self) -> &str {
        self.0.to_str().expect("a path in UTF-8")
    }

    pub fn bytes(&self) -> Vec<u8> {
        std::fs::read(&self.0).expect("a file")
    }

    pub fn text(&self) -> String {
        std::fs::read_to_string(&self.0).expect("a text")
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// What a command refuses to do, in its own words.
#[track_caller]
fn refused(args: &[&str]) -> String {
    let output = centrode(args);
    let message = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!((output.status.code(), message.lines().count()), (Some(2), 1), "{args:?}: {message}");
    message
}

#[test]
fn a_log_read_back_gives_the_same_answers_to_the_last_bit() {
    for (preset, sets) in [
        ("bench", &[][..]),
        ("bench", &["tracker.latency=0.02", "load_cells.noise=0.05", "motion.delta=0.7", "seed=9"]),
        ("gimbal-lock", &["tracker.orientation_noise=0.002"]),
        ("static-resolution", &[]),
        ("letting-go", &["filter.averaging=rotations"]),
        ("bench", &["loop_rate=730", "tracker.rate=97"]),
    ] {
        let log = Scratch::new("same.csv", b"");
        let mut common: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        common.extend(["--preset", preset, "--json"]);
        let ran = json(&[&["run", "--log", log.path()][..], &common].concat());
        let judged = json(&[&["analyze", log.path()][..], &common].concat());
        for key in ["events", "crossings", "peak", "scenario", "samples"] {
            assert_eq!(ran[key], judged[key], "{preset} {sets:?}: {key}");
        }
        assert!(!ran["events"].as_array().expect("events").is_empty(), "{preset}");
        for key in ["time", "theta_l", "location", "distance"] {
            assert_eq!(ran["detection"][key], judged["detection"][key], "{preset} {sets:?}: {key}");
        }
        assert_eq!((&judged["contact"], &judged["detection"]["delay"]), (&Value::Null, &Value::Null));
    }
}

#[test]
fn every_channel_of_a_log_read_back_is_the_same() {
    let (log, ran, judged) = (Scratch::new("c.csv", b""), Scratch::new("r.csv", b""), Scratch::new("j.csv", b""));
    assert!(centrode(&["run", "--preset", "bench", "--log", log.path(), "--csv", ran.path()]).status.success());
    assert!(centrode(&["analyze", log.path(), "--preset", "bench", "--csv", judged.path()]).status.success());
    let (ran, judged) = (ran.text(), judged.text());
    let header: Vec<&str> = ran.lines().next().expect("a header").split(',').collect();
    // The truth is not in the log, nor is the commanded rate, which is a difference of its commands.
    let compared = |name: &str| !name.starts_with("in_contact") && !name.starts_with("theta_l_rate");
    for (k, (a, b)) in ran.lines().zip(judged.lines()).enumerate() {
        for ((a, b), name) in a.split(',').zip(b.split(',')).zip(&header) {
            assert!(a == b || !compared(name), "line {}: {name}: {a} {b}", k + 1);
        }
    }
    assert_eq!(ran.lines().count(), judged.lines().count());
}

#[test]
fn a_trajectory_is_judged_with_the_scenario_s_motion_or_an_estimate() {
    let log = Scratch::new("t.tum", b"");
    let ran = json(&["run", "--preset", "bench", "--log", log.path(), "--json"]);
    let time = |report: &Value| report["detection"]["time"].as_f64().expect("detected");
    let text = log.text();
    assert_eq!(text.lines().filter(|line| !line.starts_with('#')).count(), 1001, "one row for each refresh");
    let motion = json(&["analyze", log.path(), "--preset", "bench", "--commands", "motion", "--json"]);
    assert!((time(&motion) - time(&ran)).abs() < 0.002, "{} {}", time(&motion), time(&ran));
    assert_eq!(motion["log"]["commands"], "motion");
    assert_eq!(motion["log"]["detectors"][1]["works"], false, "no load cells");
    let estimated = json(&["analyze", log.path(), "--preset", "bench", "--json"]);
    assert!((time(&estimated) - time(&ran)).abs() < 0.05, "{} {}", time(&estimated), time(&ran));
    assert_eq!(estimated["log"]["commands"], "estimated");
    // A second file with the commands.
    let full = Scratch::new("full.csv", b"");
    assert!(centrode(&["run", "--preset", "bench", "--log", full.path()]).status.success());
    let both = json(&["analyze", log.path(), "--preset", "bench", "--commands", full.path(), "--json"]);
    assert!((time(&both) - time(&ran)).abs() < 0.002);
    assert_eq!(both["events"].as_array().map(Vec::len), Some(2), "with the load cells of the second file");
}

/// A log of the robot at rest with a header and rows.
fn rows(header: &str, rows: &[&str]) -> Vec<u8> {
    format!("{header}\n{}\n", rows.join("\n")).into_bytes()
}

#[test]
fn what_is_wrong_is_named_by_line_and_column() {
    for (content, parts) in [
        (&b""[..], &["is empty"][..]),
        (b"\xff\xfea\0", &["UTF-16", "UTF-8"]),
        (
            &rows("time [s],x [mm],y [mm],z [mm]", &["0,1,2,3", "1,1,abc,3"]),
            &["line 3", "column 3 (y [mm])", "\"abc\"", "a finite number"],
        ),
        (&rows("time [s],x [mm],y [mm],z [mm]", &["0,1,2,inf"]), &["line 2", "column 4", "not finite"]),
        (&rows("time [s],x [mm],y [mm],z [mm]", &["0,1,2,3", "0,1,2"]), &["line 3", "3 cells", "header has 4"]),
        (&rows("time [s],x [mm],y [mm],z [mm]", &["0,1,2,3,4"]), &["line 2", "5 cells"]),
        (&rows("time [s];x [mm];y [mm];z [mm]", &["0;1,5;2;3", "1;1.5;2;3"]), &["line 3", "decimal point", "line 2"]),
        (&rows("time [s],x [inch],y [mm],z [mm]", &["0,1,2,3"]), &["line 1", "column 2", "inch", "m, mm"]),
        (&rows("time [s],x [mm],y [mm]", &["0,1,2"]), &["line 1", "without z"]),
        (&rows("x,y,z", &["0,1,2"]), &["line 1", "time"]),
        (&rows("a,b,c", &["0,1,2"]), &["line 1", "--map"]),
        (&rows("1,2,3", &["0,1,2"]), &["line 1", "header", "--map time=#1"]),
        (&rows("time,qx,qy,qz,qw", &["0,1,2,3,4"]), &["no position"]),
        (&rows("time,bend", &["0,0", "30000,0"]), &["3000001 instants", "2 values", "unit of the time"]),
        (&rows("time,bend [rad]", &["0,0", "1,99"]), &["line 3", "99", "is the unit right?"]),
        (&rows("time,x,y,z", &["0,1,2,3"]), &["no command", "--commands"]),
        (&rows("time,bend", &["0,0", "1e9,0"]), &["instants", "loop_rate"]),
        (&rows("time,bend", &["nan,0"]), &["no row", "1 were read"]),
        (&rows("time,x,y,z,bend,quality", &["0,1,2,3,0,perhaps"]), &["line 2", "column 6", "perhaps"]),
        (&rows("time,x [m],y,z,bend", &["0,1e9,2,3,0"]), &["line 2", "column 2", "too large"]),
    ] {
        let log = Scratch::new("wrong.csv", content);
        let message = refused(&["analyze", log.path(), "--set", "loop_rate=100"]);
        for part in [log.path()].iter().chain(parts) {
            assert!(message.contains(part), "{message:?} lacks {part:?}");
        }
        // The page has no flags.
        let scenario = Scenario { loop_rate: 100.0, ..Scenario::default() };
        let read = Log::read("wrong.csv", content.to_vec(), &Options::default());
        let refused = read.and_then(|log| assemble(&log, &scenario, &Setup::default())).expect_err("refused");
        assert!(!refused.without_flags().contains("--"), "{}", refused.without_flags());
    }
    let log = Scratch::new("sound.csv", &rows("time,bend", &["0,0", "0.01,0", "0.02,0"]));
    for (flags, parts) in [
        (&["--detectors", "fcd"][..], &["no readings", "FCD"][..]),
        (&["--detectors", "none"], &["none", "fcd, jfd"]),
        (&["--map", "x"], &["--map", "name=column"]),
        (&["--map", "x=no"], &["no column \"no\""]),
        (&["--commands", "no-such-file"], &["cannot read no-such-file"]),
        (&["--figure", "x.bmp"], &["--figure", ".svg, .png"]),
        (&["--hold=-1"], &["--hold"]),
        (&["--preset", "no"], &["no", "bench"]),
    ] {
        let message = refused(&[&["analyze", log.path()], flags].concat());
        for part in parts {
            assert!(message.contains(part), "{message:?} lacks {part:?}");
        }
    }
    assert!(refused(&["run", "--log", "x.mp3"]).contains(".mp3"));
}

#[test]
fn what_is_wrong_with_the_commands_names_their_file() {
    let log = Scratch::new("places.csv", &rows("time,x,y,z", &["0,0,0,0.03", "0.01,0,0,0.03"]));
    let far = Scratch::new("far.csv", &rows("time,bend", &["0,0", "0.01,99"]));
    let args = |commands| ["analyze", log.path(), "--set", "loop_rate=100", "--commands", commands];
    let message = refused(&args(far.path()));
    assert!(message.contains(&format!("line 3 ({})", far.path())), "{message}");
    let back = Scratch::new("back.csv", &rows("time,bend", &["0,0", "0.01,0", "0,0"]));
    let output = centrode(&args(back.path()));
    let table = String::from_utf8(output.stdout).expect("UTF-8");
    let counted = format!("1 row lies before an earlier one: dropped (line 4 ({}))", back.path());
    assert!(table.contains(&counted), "{table}");
}

#[test]
fn what_has_no_subject_gets_one_where_no_name_stands_before_it() {
    for (content, said) in [(&b""[..], "The file is empty"), (b"# a\n", "The file holds comments alone")] {
        let refused = Log::read("a.csv", content.to_vec(), &Options::default()).expect_err("refused");
        assert_eq!(refused.without_flags(), said);
    }
}

#[test]
fn dirt_is_counted_and_nothing_is_made_up() {
    let text = "\u{feff}# a rig\r\ntime [ms];x [mm];y [mm];z [mm];qx;qy;qz;qw;theta_l [deg];quality\r\n\
                0;0;0;30,5;0;0;0;1;90;1\r\n\r\n\
                10;0;0;30;0;0;0;1;90;1\r\n\
                10;0;0;30;0;0;0;1;90;1\r\n\
                5;0;0;30;0;0;0;1;90;1\r\n\
                20;0;;30;0;0;0;1;90;1\r\n\
                30;0;0;30;0;0;0;0;90;1\r\n\
                40;0;0;30;0;0;0;1,2;90;0\r\n\
                50;0;0;30;0;0;0;1,2;;1\r\n\
                400;0;0;30;0;0;0;1;90;1\r\n\
                410;0;0;30;0;0";
    let log = Scratch::new("dirty.csv", text.as_bytes());
    let report = json(&["analyze", log.path(), "--hold", "0.05", "--json"]);
    let counts = report["log"]["report"]["counts"].as_array().expect("counts");
    let count = |what: &str| {
        counts.iter().find(|count| count["what"] == what).map(|count| (&count["count"], &count["first"]["line"]))
    };
    for (what, many, line) in [
        ("repeated-time", 1, Some(6)),
        ("step-back", 1, Some(7)),
        ("undefined-reading", 2, Some(8)),
        ("bad-quality", 1, Some(10)),
        ("normalised", 1, Some(11)),
        ("undefined-command", 1, Some(11)),
        ("cut", 1, Some(13)),
        // From 0 to 0.4 s at 100 Hz are 41 instants, four of them with a reading; of the others 0.05 s after each are held.
        ("held-reading", 8, None),
        ("gap-in-readings", 29, None),
    ] {
        let line = line.map_or(Value::Null, Value::from);
        assert_eq!(count(what), Some((&many.into(), &line)), "{what} of {counts:?}");
    }
    assert_eq!((&report["log"]["loop_rate"], &report["log"]["rows"]), (&100.0.into(), &10.into()));
    assert_eq!(report["samples"], 41);
    let table = centrode(&["analyze", log.path()]);
    let table = String::from_utf8(table.stdout).expect("UTF-8");
    for part in ["decimal commas", "semicolons", "1 row lies before an earlier one: dropped (line 7)", "no load cells"]
    {
        assert!(table.contains(part), "{table} lacks {part}");
    }
}
