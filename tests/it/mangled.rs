//! Mangled files thrown at every reader of logs: no panic, and no more memory than the file's size allows.

use crate::log_formats::{container, ndi, plan, readings};
use centrode_core::record::Recorder;
use centrode_core::record::log::assemble::MAX_ENTRIES;
use centrode_core::record::log::chain::{self, ChainLog, ChainOptions, Expected};
use centrode_core::record::log::{Commands, Format, Log, Options, Rate, Reader, Setup, assemble, write};
use centrode_core::scenario::Scenario;
use centrode_core::scenario::preset::find_chain;
use proptest::prelude::*;
use std::sync::LazyLock;

/// A sound file of each format, of a few rows.
static SOUND: LazyLock<Vec<(Format, Vec<u8>)>> = LazyLock::new(|| {
    let plan = plan();
    let readings = readings(&plan);
    let (mut csv, mut tum) = (write::csv_header(), write::tum_header().to_owned());
    Recorder::new(&plan).skip(5900).take(30).for_each(|(entry, _)| write::csv_row(&mut csv, &entry));
    readings.iter().take(30).for_each(|entry| write::tum_row(&mut tum, entry));
    let euroc = "#timestamp [ns], p_x, p_y, p_z, q_w, q_x, q_y, q_z\n".to_owned()
        + &"1403636580838555648,0.1,0.2,0.3,1,0,0,0\n1403636580848555648,0.1,0.2,0.3,1,0,0,0\n".repeat(8);
    vec![
        (Format::Csv, csv.into_bytes()),
        (Format::Tum, tum.into_bytes()),
        (Format::Euroc, euroc.into_bytes()),
        (Format::Ndi, ndi(&readings[..20]).into_bytes()),
        (Format::Mcap, container(&plan)[..20_000].to_vec()),
    ]
});

/// One way to spoil a file, at places given as shares of its length.
#[derive(Debug, Clone)]
enum Spoil {
    Byte(f64, u8),
    Insert(f64, Vec<u8>),
    Remove(f64, usize),
    Repeat(f64, usize),
    Cut(f64),
}

fn spoil() -> impl Strategy<Value = Spoil> {
    let place = || 0.0..1.0;
    prop_oneof![
        (place(), any::<u8>()).prop_map(|(at, byte)| Spoil::Byte(at, byte)),
        (
            place(),
            prop_oneof![
                proptest::collection::vec(any::<u8>(), 0..20),
                prop::sample::select(vec![
                    "\n",
                    "\r\n",
                    ",",
                    ";",
                    "\"",
                    "#",
                    "nan",
                    "inf",
                    "1e308",
                    "-1e9",
                    "99999999999999999999",
                    "\u{feff}"
                ])
                .prop_map(|text| text.as_bytes().to_vec()),
            ]
        )
            .prop_map(|(at, bytes)| Spoil::Insert(at, bytes)),
        (place(), 1..200usize).prop_map(|(at, count)| Spoil::Remove(at, count)),
        (place(), 1..200usize).prop_map(|(at, count)| Spoil::Repeat(at, count)),
        place().prop_map(Spoil::Cut),
    ]
}

fn spoilt(bytes: &[u8], spoils: &[Spoil]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for spoil in spoils {
        let place = |at: f64, bytes: &[u8]| ((at * bytes.len() as f64) as usize).min(bytes.len());
        match spoil {
            Spoil::Byte(at, byte) => {
                let at = place(*at, &bytes);
                if let Some(old) = bytes.get_mut(at) {
                    *old = *byte;
                }
            }
            Spoil::Insert(at, more) => {
                let at = place(*at, &bytes);
                bytes.splice(at..at, more.iter().copied());
            }
            Spoil::Remove(at, count) => {
                let at = place(*at, &bytes);
                let end = (at + count).min(bytes.len());
                bytes.drain(at..end);
            }
            Spoil::Repeat(at, count) => {
                let at = place(*at, &bytes);
                let part = bytes[at..(at + count).min(bytes.len())].to_vec();
                bytes.splice(at..at, part);
            }
            Spoil::Cut(at) => bytes.truncate(place(*at, &bytes)),
        }
    }
    bytes
}

/// Reads a file, and assembles it when it can be read; gives the numbers that the log holds.
fn read(format: Format, bytes: Vec<u8>) -> Option<usize> {
    let options =
        Options { format: Some(format), tool: Some("1".into()), frame_rate: Some(100.0), ..Options::default() };
    let mut reader = Reader::new("x", bytes, &options).ok()?;
    loop {
        match reader.work(7) {
            Ok(progress) if progress.is_done() => break,
            Ok(_) => {}
            Err(error) => {
                assert!(!error.to_string().contains('\n'), "{error}");
                return None;
            }
        }
    }
    let log: Log = reader.finish().ok()?;
    let numbers = 7 * log.readings.len() + 3 * log.commands.len() + 4 * (log.joints.len() + log.forces.len());
    let scenario = Scenario { loop_rate: 100.0, ..Scenario::default() };
    for (rate, commands) in [(Rate::Scenario, None), (Rate::Log, Some(Commands::Motion))] {
        if let Ok(assembled) = assemble(&log, &scenario, &Setup { rate, commands, ..Setup::default() }) {
            let entries = &assembled.recording.entries;
            assert!(!entries.is_empty() && entries.len() <= MAX_ENTRIES);
            assert!(entries.windows(2).all(|pair| pair[0].time < pair[1].time));
        }
    }
    Some(numbers)
}

/// A sound log of three trackers with a set of columns for each, and one with a row for each.
static SEVERAL: LazyLock<[Vec<u8>; 2]> = LazyLock::new(|| {
    let rig = &crate::chain_logs::RIG;
    let mut wide = write::chain_csv_header(rig);
    (5900..5920).for_each(|at| write::chain_csv_row(&mut wide, rig, at));
    let mut long = "time,disk,x,y,z,qw,qx,qy,qz,bend,delta\n".to_owned();
    for row in 0..60 {
        long += &format!("{},{},0.0{row},0,0.1,1,0,0,0,0.{row},0.3\n", f64::from(row / 3) * 0.01, row % 3 + 1);
    }
    [wide.into_bytes(), long.into_bytes()]
});

/// Reads a log of several trackers, and assembles it when it can be read; whether that can be done.
fn read_several(bytes: Vec<u8>) -> bool {
    let scenario = find_chain("two-contacts").and_then(|preset| preset.chain(&[]).ok()).expect("a preset");
    let scenario = scenario.at_rate(100.0).expect("allowed");
    let options =
        ChainOptions { shared: Options { format: Some(Format::Csv), ..Options::default() }, ..ChainOptions::default() };
    let mut log = ChainLog::new(scenario.segments.len());
    let taken = chain::read("x", bytes, &Expected::of(&scenario), &options).and_then(|read| log.take(read, ""));
    if let Err(error) = taken {
        assert!(!error.to_string().contains('\n'), "{error}");
        return false;
    }
    match chain::assemble(log, &scenario, &Setup::default()) {
        Ok(assembled) => {
            let times = &assembled.recording.times;
            assert!(times.len() <= MAX_ENTRIES && times.windows(2).all(|pair| pair[0] < pair[1]));
            true
        }
        Err(error) => {
            assert!(!error.to_string().contains('\n'), "{error}");
            false
        }
    }
}

#[test]
fn sound_logs_of_several_trackers_are_read() {
    assert!(SEVERAL.iter().all(|bytes| read_several(bytes.clone())));
}

#[test]
fn sound_files_are_read() {
    for (format, bytes) in SOUND.iter() {
        assert!(read(*format, bytes.clone()).is_some(), "{format:?}");
    }
}

proptest! {
    #[test]
    fn a_mangled_file_is_read_or_refused(file in 0..5usize, spoils in proptest::collection::vec(spoil(), 1..6)) {
        let (format, bytes) = &SOUND[file];
        let bytes = spoilt(bytes, &spoils);
        let size = bytes.len();
        if let Some(numbers) = read(*format, bytes) {
            // The shortest row is two bytes for each cell, and a cell is a number of eight bytes.
            prop_assert!(numbers <= 8 * size, "{numbers} numbers from {size} bytes");
        }
    }

    #[test]
    fn a_mangled_log_of_several_trackers_is_read_or_refused(file in 0..2usize, spoils in proptest::collection::vec(spoil(), 1..6)) {
        read_several(spoilt(&SEVERAL[file], &spoils));
    }

    #[test]
    fn bytes_that_are_no_log_are_refused_or_read(format in 0..5usize, bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let format = Format::ALL[format];
        let bytes = if format == Format::Mcap { [&b"\x89MCAP0\r\n"[..], &bytes].concat() } else { bytes };
        read(format, bytes);
    }
}
