//! The logs in `assets/logs`: made here, and judged as their README says.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test it example_logs` writes them anew.

use crate::cli::json;
use crate::log_formats::{ndi, plan, readings};
use centrode_core::model::orientation::quaternion_from_euler;
use centrode_core::record::Entry;
use centrode_core::record::log::mcap::write as mcap;
use std::fmt::Write;
use std::path::Path;

/// The readings of the preset `bench` from a time to another (s), ten milliseconds apart.
fn part(from: f64, to: f64) -> Vec<Entry> {
    readings(&plan()).into_iter().filter(|entry| (from..to).contains(&entry.time)).collect()
}

fn mm(entry: &Entry) -> [f64; 3] {
    (entry.reading.position * 1e3).into()
}

/// A log as one would like to have it.
fn clean() -> String {
    let mut text = "time [s],x [mm],y [mm],z [mm],azimuth [deg],elevation [deg],roll [deg],theta_l [deg],delta [deg],\
                    tau_1 [N],tau_2 [N],tau_3 [N]\n"
        .to_owned();
    for entry in part(2.5, 8.5) {
        let ([x, y, z], [a, e, r]) = (mm(&entry), entry.reading.angles.map(f64::to_degrees));
        let theta_l = entry.configuration.theta_l().to_degrees();
        let tau = entry.tau_lc;
        writeln!(
            text,
            "{:.2},{x:.4},{y:.4},{z:.4},{a:.4},{e:.4},{r:.4},{theta_l:.4},0,{:.4},{:.4},{:.4}",
            entry.time, tau.x, tau.y, tau.z
        )
        .expect("a text");
    }
    text
}

/// The same as a rig in a hurry writes it.
fn dirty() -> String {
    let mut text = "\u{feff}# Prüfstand 2, Versuch 7\r\n\
                    Zeit;Tx (mm);Ty (mm);Tz (mm);q0;qx;qy;qz;theta_l [deg];quality\r\n"
        .to_owned();
    for (k, entry) in part(2.5, 8.5).iter().enumerate() {
        let [x, y, z] = mm(entry).map(|part| format!("{part:.3}").replace('.', ","));
        let q = quaternion_from_euler(&entry.reading.angles).map(|part| format!("{part:.6}").replace('.', ","));
        let theta_l = format!("{:.4}", entry.configuration.theta_l().to_degrees()).replace('.', ",");
        // The clock jitters, and once it steps back.
        let time = entry.time + if k % 3 == 1 { 0.0004 } else { 0.0 } - if k == 200 { 0.3 } else { 0.0 };
        let time = format!("{time:.4}").replace('.', ",");
        let quality = u8::from(k % 83 != 40);
        let row = match k {
            // The tracker's line of sight was blocked for a fifth of a second.
            455..475 => format!("{time};;;;;;;;{theta_l};1"),
            300 => format!("{time};NaN;{y};{z};{};{};{};{};{theta_l};1", q[0], q[1], q[2], q[3]),
            _ => format!("{time};{x};{y};{z};{};{};{};{};{theta_l};{quality}", q[0], q[1], q[2], q[3]),
        };
        text += &row;
        text += "\r\n";
        match k {
            // Sent twice.
            120 => text += &format!("{row}\r\n"),
            121 => text += "\r\n",
            _ => {}
        }
    }
    text + "8,5000;1,2"
}

fn trajectory() -> String {
    let mut text = "# timestamp tx ty tz qx qy qz qw\n".to_owned();
    for entry in part(2.5, 8.5) {
        let [w, x, y, z] = quaternion_from_euler(&entry.reading.angles);
        let p = entry.reading.position;
        writeln!(text, "{:.2} {:.7} {:.7} {:.7} {x:.7} {y:.7} {z:.7} {w:.7}", entry.time, p.x, p.y, p.z)
            .expect("a text");
    }
    text
}

/// As a data set has it: nanoseconds since 1970, and a velocity behind that nobody asked for.
fn euroc() -> String {
    let mut text = "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z [],\
                    v_RS_R_x [m s^-1]\n"
        .to_owned();
    for entry in part(0.0, 7.5) {
        let [w, x, y, z] = quaternion_from_euler(&entry.reading.angles);
        let p = entry.reading.position;
        let stamp = 1_403_636_580_838_555_648_u64 + (entry.time * 1e9).round() as u64;
        writeln!(text, "{stamp},{:.7},{:.7},{:.7},{w:.7},{x:.7},{y:.7},{z:.7},0", p.x, p.y, p.z).expect("a text");
    }
    text
}

/// Joint values and load cells beside the trajectory.
fn commands() -> String {
    let plan = plan();
    let mut text = "time [ms],q1 [mm],q2 [mm],q3 [mm],tau_1 [N],tau_2 [N],tau_3 [N]\n".to_owned();
    for entry in part(2.5, 8.5) {
        let q = centrode_core::model::joints::joints(plan.segment().pitch_radius, &entry.configuration) * 1e3;
        let tau = entry.tau_lc;
        let ms = entry.time * 1e3;
        writeln!(text, "{ms:.0},{:.6},{:.6},{:.6},{:.4},{:.4},{:.4}", q.x, q.y, q.z, tau.x, tau.y, tau.z)
            .expect("a text");
    }
    text
}

/// Three trackers on the preset `two-contacts`.
fn chain() -> String {
    let rig = &crate::chain_logs::RIG;
    let names = ["x", "y", "z", "azimuth", "elevation", "roll", "theta_l", "delta"];
    let mut text = String::from("time [s]");
    for disk in 1..=3 {
        for (place, name) in names.iter().enumerate() {
            write!(text, ",{name}_{disk} [{}]", if place < 3 { "mm" } else { "deg" }).expect("a text");
        }
    }
    text.push('\n');
    for at in (4000..=7600).step_by(10) {
        write!(text, "{:.2}", rig.times[at]).expect("a text");
        for (readings, told) in rig.readings.iter().zip(&rig.told) {
            let (reading, told) = (readings.as_ref().expect("a tracker")[at], told[at].configuration);
            reading.position.iter().for_each(|part| write!(text, ",{:.4}", part * 1e3).expect("a text"));
            let angles = reading.angles.into_iter().chain([told.theta_l(), told.delta()]);
            angles.for_each(|part| write!(text, ",{:.4}", part.to_degrees()).expect("a text"));
        }
        text.push('\n');
    }
    text
}

fn container() -> Vec<u8> {
    let plan = plan();
    let mut out = Vec::new();
    mcap::begin(&mut out);
    for (k, entry) in part(4.5, 7.0).iter().enumerate() {
        mcap::pose(&mut out, k as u32, entry);
        mcap::state(&mut out, k as u32, entry, plan.segment().pitch_radius);
    }
    mcap::end(&mut out);
    out
}

#[test]
fn the_example_logs_are_made_here() {
    let ndi = ndi(&readings(&plan())[..751]);
    for (name, content) in [
        ("clean.csv", clean().into_bytes()),
        ("dirty.csv", dirty().into_bytes()),
        ("trajectory.tum", trajectory().into_bytes()),
        ("commands.csv", commands().into_bytes()),
        ("euroc.csv", euroc().into_bytes()),
        ("ndi.csv", ndi.into_bytes()),
        ("ros.mcap", container()),
        ("chain.csv", chain().into_bytes()),
    ] {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/logs").join(name);
        if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
            std::fs::write(&file, &content).expect(name);
        }
        let stored = std::fs::read(&file).unwrap_or_default();
        assert!(stored == content, "{name} is out of date: UPDATE_SNAPSHOTS=1 cargo test --test it example_logs");
    }
}

#[test]
fn each_example_shows_the_contact() {
    for args in [
        &["clean.csv"][..],
        &["dirty.csv", "--map", "time=Zeit"],
        &["trajectory.tum", "--commands", "assets/logs/commands.csv"],
        &["trajectory.tum"],
        &["euroc.csv", "--commands", "motion"],
        &["ndi.csv", "--tool", "TIP", "--commands", "motion", "--fit-frame"],
        &["ros.mcap"],
    ] {
        let log = format!("assets/logs/{}", args[0]);
        let report = json(&[&["analyze", &log, "--preset", "bench", "--json"], &args[1..]].concat());
        let time = report["detection"]["time"].as_f64().unwrap_or_else(|| panic!("{args:?} detects nothing"));
        // 6.26 s in the run itself; readings here are rounded, late, or lack a command.
        assert!((time - 6.26).abs() < 0.08, "{args:?}: {time}");
    }
}
