//! Logs of several trackers that are refused, and how.

use crate::chain_logs::refused;
use crate::cli::scratch;
use crate::logs::Scratch;

#[test]
fn what_is_wrong_is_named_with_line_column_and_disk() {
    let head = "time [s],x_1,y_1,z_1,azimuth_1,elevation_1,roll_1,theta_l_1,delta_1";
    let three = format!("{head},{},{}", head[9..].replace("_1", "_2"), head[9..].replace("_1", "_3"));
    let row = |time: &str, cell: &str| {
        format!("{time},0,0,0.03,0,0,0,1.5,0,0,{cell},0.06,0,0,0,1.5,0,0,0,0.09,0,0,0,1.5,0\n")
    };
    let good = format!("{three}\n{}{}", row("0", "0"), row("0.1", "0"));
    for (text, parts) in [
        (format!("{good}{}", row("0.2", "one")), &["disk 2", "line 4, column 11 (y_2)", "\"one\""][..]),
        (good.replacen("x_2", "x_5", 1), &["line 1, column 10 (x_5)", "disk 5", "3 segments"]),
        (good.replacen("x_2", "a", 1), &["y_2", "without x", "disk 2"]),
        (good.replace("_3", ""), &["disk 3 has no readings", "there are 2"]),
        (format!("{}\n", head.replace("_1", "")), &["column 2 (x)", "does not say which disk"]),
        (good.replacen("theta_l_2", "theta_l", 1), &["no command of segment 2", "theta_l_2"]),
        (
            good.replacen("azimuth_3", "a", 1).replacen("elevation_3", "b", 1).replacen("roll_3", "c", 1),
            &["disk 3", "orientation"],
        ),
        ("t,a,b\n0,1,2\n".into(), &["no column tells of a disk", "--map x_1=column"]),
        (
            format!("{head}\n0,0,0,0.03,0,0,0,1.5,0\n0.1,0,0,0.03,0,0,0,1.5,0\n"),
            &["disks 2, 3 have no readings", "there are 1"],
        ),
        (format!("{head},x_1\n"), &["could both be x", "--map x_1=column"]),
        (
            "time,disk,x,y,z,azimuth,elevation,roll\n0,4,0,0,0,0,0,0\n0,1,0,0,0,0,0,0\n".into(),
            &["line 2, column 2 (disk)", "\"4\"", "3 segments"],
        ),
        (
            "time,disk,x,y,z,azimuth,elevation,roll\n0,1,0,0,0,0,0,0\n0,,0,0,0,0,0,0\n".into(),
            &["line 3, column 2 (disk)", "tells no disk"],
        ),
    ] {
        let log = Scratch::new("wrong.csv", text.as_bytes());
        let message = refused(&["analyze", log.path(), "--preset", "two-contacts"]);
        for part in parts {
            assert!(message.contains(part), "{message:?} lacks {part:?}");
        }
    }
    let log = Scratch::new("right.csv", good.as_bytes());
    for (args, parts) in [
        (&["--map", "x_4=x_1"][..], &["--map", "disk 4"][..]),
        (&["--map", "x_1=nothing"], &["no column \"nothing\""]),
        (&["--figure", "a.svg"], &["--figure", "several segments"]),
        (&["--detectors", "jfd"], &["detection.detectors", "smd"]),
        (&["--detector", "glr"], &["--detector", "does not judge here"]),
    ] {
        let message = refused(&[&["analyze", log.path(), "--preset", "two-contacts"], args].concat());
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
    let message = refused(&["analyze", log.path(), log.path(), "--preset", "bench"]);
    assert!(message.contains("one segment"), "{message}");
    let out = scratch("chain.tum");
    let message = refused(&["run", "--preset", "two-contacts", "--log", out.to_str().expect("UTF-8")]);
    assert!(message.contains(".csv") && !out.exists(), "{message}");
}

#[test]
fn keys_of_a_segment_s_tubes_are_those_of_its_table() {
    for (set, parts) in [
        (
            "segment[1].primary.inner_diameter=0.01",
            &["segment[1].primary.inner_diameter", "below primary.outer_diameter"][..],
        ),
        ("segment[2].disks=[0.05]", &["segment[2].disks[0]", "0.03 m"]),
    ] {
        let message = refused(&["run", "--preset", "two-contacts", "--set", set]);
        assert!(parts.iter().all(|part| message.contains(part)) && !message.contains("robot."), "{message}");
    }
}
