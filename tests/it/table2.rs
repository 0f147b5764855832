//! The paper's Table II and the simulated one.

use centrode_core::detect::Method;
use centrode_core::run::simulate;
use centrode_core::scenario::Threshold;
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{ContactKind, Scenario};
use centrode_core::study::Job;
use centrode_core::study::table2::{MAX_REPEATS, Outcome, PRESETS, Row, Table2Job};

fn preset(name: &str) -> Scenario {
    find(name).and_then(|preset| preset.scenario()).expect(name)
}

fn finished(base: &Scenario, repeats: usize) -> Table2Job {
    let mut job = Table2Job::new(base, repeats).expect("valid");
    job.finish();
    job
}

#[test]
fn the_first_experiments_are_the_presets() {
    let job = finished(&preset("bench"), 1);
    assert_eq!(job.rows().len(), 3);
    for (row, name) in job.rows().iter().zip(PRESETS) {
        let run = simulate(&preset(name)).expect(name);
        let detection = run.detection().expect(name);
        assert_eq!((row.detection_time, row.theta_l), (detection.time, detection.theta_l), "{name}");
        assert_eq!(row.location, detection.location, "{name}");
        let disk = &job.table().simulated[row.disk as usize - 1];
        assert_eq!(Some(disk.contact_time), run.contact_time(), "{name}");
    }
}

#[test]
fn a_table_can_be_read_before_it_is_complete() {
    let mut job = Table2Job::new(&preset("bench"), 2).expect("valid");
    assert!(job.table().simulated.iter().all(|disk| disk.repeats == 0 && disk.location.mean.is_nan()));
    (0..4).for_each(|_| job.step());
    let table = job.table();
    assert_eq!(table.simulated.map(|disk| disk.repeats), [2, 1, 1]);
    assert!(table.simulated[1].location.mean > 0.0 && table.simulated[1].location.deviation.is_nan());
    job.finish();
    assert_eq!(job.rows()[..], finished(&preset("bench"), 3).rows()[..6], "repeats do not depend on their number");
    job.step();
    assert_eq!(job.rows().len(), 6);
}

#[test]
fn beside_the_scenario_s_kind_of_contact_stands_another() {
    let (bench, mut flat) = (preset("bench"), preset("bench"));
    flat.contact.kind = ContactKind::Plane;
    let (clamped, touched) = (finished(&bench, 2), finished(&flat, 2));
    // What was missed is NaN, which equals nothing.
    let text = |own: &[Row], other: &[Row]| format!("{own:?} {other:?}");
    assert_eq!(text(clamped.rows(), clamped.other_rows()), text(touched.other_rows(), touched.rows()));
    let table = clamped.table();
    assert_eq!((table.kind, table.other_kind), (ContactKind::Clamp, ContactKind::Plane));
    let third = &table.other[2];
    assert!(third.found == 2 && third.detection_time.mean > table.simulated[2].detection_time.mean);
    // A round beam keeps its radius.
    let mut round = preset("cylinder");
    let rows = finished(&round, 1).rows().to_vec();
    round.contact.rounding = 0.001;
    assert_ne!(rows, finished(&round, 1).rows());
}

#[test]
fn means_and_deviations_are_those_of_the_rows() {
    let job = finished(&preset("bench"), 4);
    for disk in job.table().simulated {
        let rows: Vec<_> =
            job.rows().iter().filter(|row| row.disk == disk.disk && row.outcome == Outcome::Found).collect();
        assert_eq!((disk.found, disk.repeats), (rows.len(), 4));
        let count = rows.len() as f64;
        let sum: f64 = rows.iter().map(|row| row.location).sum();
        let squares: f64 = rows.iter().map(|row| row.location * row.location).sum();
        let deviation = ((squares - sum * sum / count) / (count - 1.0)).sqrt();
        assert!((disk.location.mean - sum / count).abs() < 1e-15);
        assert!((disk.location.deviation - deviation).abs() < 1e-9 && deviation > 1e-5, "{deviation}");
        assert!((disk.bias - (sum / count - disk.arc_length)).abs() < 1e-15);
        assert!((disk.delay.mean - (disk.detection_time.mean - disk.contact_time)).abs() < 1e-12);
        assert!((disk.delay.deviation - disk.detection_time.deviation).abs() < 1e-12);
    }
}

#[test]
fn false_alarms_and_misses_are_counted_apart() {
    let noisy = finished(&preset("static-resolution"), 3).table();
    for disk in noisy.simulated {
        assert_eq!(disk.false_alarms.map(|alarms| alarms + disk.found), Some(3), "disk {}", disk.disk);
        assert!(disk.false_alarms >= Some(2), "disk {}", disk.disk);
    }
    let mut free = preset("static-resolution");
    // Armed before any contact, noise alone raises every alarm.
    free.detection.armed_from = 3.0;
    for disk in finished(&free, 2).table().simulated {
        assert_eq!((disk.false_alarms, disk.found), (Some(2), 0), "disk {}", disk.disk);
        assert!(disk.detection_time.mean.is_nan() && disk.bias.is_nan());
    }
    let mut off = preset("bench");
    off.detection.xi2 = Threshold::OFF;
    for disk in finished(&off, 2).table().simulated {
        assert_eq!((disk.false_alarms, disk.found, disk.repeats), (Some(0), 0, 2));
    }
    // Without noise disk 1 is out of reach of 7 mm, and the others give one answer each time.
    let quiet = finished(&preset("paper"), 2).table();
    assert_eq!(quiet.simulated.map(|disk| disk.found), [0, 2, 2]);
    assert_eq!(quiet.simulated[1].location.deviation, 0.0);
}

#[test]
fn the_simulation_finds_disks_2_and_3_when_the_paper_does() {
    let table = finished(&preset("bench"), 20).table();
    for k in [1, 2] {
        let (paper, ours) = (&table.paper[k], &table.simulated[k]);
        let apart = (paper.detection_time.mean - ours.detection_time.mean).abs();
        assert!(apart < 0.04, "disk {}: {apart} s", paper.disk);
        assert_eq!(ours.found, 20);
    }
    // Nearer the tip is found sooner and placed worse.
    let delays = table.simulated.map(|disk| disk.delay.mean);
    assert!(delays[2] < delays[1] && delays[1] < delays[0], "{delays:?}");
    assert!(table.simulated[2].bias < 2.0 * table.simulated[1].bias && table.simulated[1].bias < 0.0);
}

#[test]
fn beside_the_paper_s_method_stands_the_calibration_filter_s() {
    let with_cusum = |name| {
        let mut scenario = preset(name);
        scenario.detection.detectors.set(Method::Cusum, true);
        scenario
    };
    // Whether or not it is switched on.
    let job = finished(&preset("bench"), 3);
    let (table, rows) = (job.table(), job.our_rows().expect("cusum has a threshold"));
    let ours = table.ours.expect("cusum has a threshold");
    assert_eq!(rows.len(), 9);
    // The first experiments are the presets.
    for (row, name) in rows.iter().zip(PRESETS) {
        let run = simulate(&with_cusum(name)).expect(name);
        let alarm = run.judged.first(Method::Cusum).expect(name).raised;
        assert_eq!(row.row.detection_time, alarm, "{name}");
        let placed = run.judged.estimates(&run.recording, Method::Cusum, &[0.5]);
        assert_eq!(row.place, placed.first().map(|estimate| estimate.location), "{name}");
    }
    for (ours, paper) in ours.iter().zip(&table.simulated) {
        assert_eq!((ours.disk.repeats, ours.disk.found, ours.placed, ours.disk.false_alarms), (3, 3, 3, Some(0)));
        // For disk 1 half a second does not tell the two kinds of contact apart, which leaves a millimetre.
        assert!(ours.disk.delay.mean < 0.15 && ours.disk.bias.abs() < 1.5e-3 && ours.covered > 0.3, "{ours:?}");
        assert!(!paper.delay.mean.is_finite() || ours.disk.delay.mean < 0.5 * paper.delay.mean, "{ours:?}");
    }
    let mut without = preset("bench");
    without.detection.cusum = Threshold::OFF;
    let plain = finished(&without, 3);
    assert!(plain.table().ours.is_none() && plain.our_rows().is_none());
    // What was missed is NaN, which equals nothing.
    assert_eq!(format!("{:?}", plain.rows()), format!("{:?}", job.rows()), "the paper's rows do not depend on it");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let base = preset("bench");
    for repeats in [0, MAX_REPEATS + 1] {
        let error = Table2Job::new(&base, repeats).expect_err("refused").to_string();
        assert!(error.contains("repeats") && error.contains("100000"), "{error}");
    }
    let mut short = preset("free");
    short.robot.disks = vec![0.01, 0.02];
    let error = Table2Job::new(&short, 5).expect_err("refused").to_string();
    assert!(error.contains("robot.disks") && error.contains("three"), "{error}");
    let mut bad = base;
    bad.loop_rate = -1.0;
    assert!(Table2Job::new(&bad, 5).expect_err("refused").to_string().contains("loop_rate"));
}

#[cfg(feature = "cli")]
mod command {
    use super::{Method, finished, preset};
    use crate::cli::{centrode, json, scratch};

    #[test]
    fn json_is_the_library_s_table() {
        let ours = json(&["table2", "--repeats", "2", "--json", "--set", "detection.detectors=fcd,jfd,cusum"]);
        let mut scenario = preset("bench");
        scenario.detection.detectors.set(Method::Cusum, true);
        let job = finished(&scenario, 2);
        let table = job.table();
        for (k, disk) in table.simulated.iter().enumerate() {
            assert_eq!(ours["simulated"][k]["location"]["mean"].as_f64(), Some(disk.location.mean));
            assert_eq!(ours["simulated"][k]["false_alarms"], 0);
        }
        let own = table.ours.expect("cusum judges")[1];
        assert_eq!(ours["ours"][1]["detection_time"]["mean"].as_f64(), Some(own.disk.detection_time.mean));
        assert_eq!(ours["ours"][1]["covered"].as_f64(), Some(own.covered));
        assert!(ours["paper"][1]["contact_time"].is_null() && ours["paper"][1]["false_alarms"].is_null());
        assert_eq!(ours["rows"]["paper"].as_array().map(Vec::len), Some(15));
        assert_eq!(ours["rows"]["simulated"].as_array().map(Vec::len), Some(6));
        assert_eq!(ours["scenario"]["tracker"]["position_noise"], 0.00005);
    }

    #[test]
    fn csv_holds_all_tables() {
        let path = scratch("table2.csv");
        let output =
            centrode(&["table2", "--csv", path.to_str().expect("path"), "--set", "detection.detectors=fcd,jfd,cusum"]);
        assert!(output.status.success());
        let text = std::fs::read_to_string(&path).expect("a file");
        std::fs::remove_file(&path).expect("removed");
        let rows: Vec<Vec<_>> = text.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(rows.len(), 13);
        assert!(rows.iter().all(|row| row.len() == rows[0].len()));
        let column = |name: &str| rows[0].iter().position(|title| *title == name).expect(name);
        let mean = rows[2][column("location_mean [m]")].parse::<f64>().expect("a number");
        assert_eq!([2, 5, 8, 11].map(|row| rows[row][0]), ["paper", "simulated", "plane", "ours"]);
        assert!((mean - 0.016).abs() < 1e-15, "{mean}");
        assert_eq!(rows[2][column("contact_time [s]")], "", "not known, not 0");
        let words = String::from_utf8(output.stdout).expect("UTF-8");
        assert!(words.contains("16.00 ± 0.71") && words.contains("clamp              plane"), "{words}");
    }

    #[test]
    fn bad_input_is_one_line_and_writes_nothing() {
        let path = scratch("refused-table2.csv");
        let name = path.to_str().expect("path");
        for (args, part) in [
            (&["table2", "--repeats", "0", "--csv", name][..], "from 1 to 100000"),
            (&["table2", "--repeats", "100001", "--csv", name], "from 1 to 100000"),
            (&["table2", "--repeats", "-1", "--csv", name], "-1"),
            (&["table2", "--preset", "free", "--set", "robot.disks=[0.01]", "--csv", name], "three disks"),
            (&["table2", "--csv", "no-such-folder/t.csv"], "no-such-folder"),
        ] {
            let output = centrode(args);
            let message = String::from_utf8(output.stderr).expect("UTF-8");
            assert_eq!(output.status.code(), Some(2), "{args:?}: {message}");
            assert_eq!(message.lines().count(), 1, "{message}");
            assert!(message.contains(part) && output.stdout.is_empty(), "{args:?}: {message}");
        }
        assert!(!path.exists());
    }
}
