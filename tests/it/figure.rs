//! `centrode figure` and the drawings of `centrode map`, as files.

use centrode_core::chart::Chart;
use centrode_core::scenario::preset::find;
use centrode_core::study::Job;
use centrode_core::study::figure::{FigureJob, Number};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

fn centrode(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_centrode")).args(args).output().expect("the command starts")
}

/// A folder that no other test uses, empty.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("centrode-{}-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Runs a command that writes `file` into a folder of its own, in which nothing else may be left.
fn written(name: &str, args: &[&str], file: &str) -> Vec<u8> {
    let folder = folder(name);
    let path = folder.join(file);
    let output = centrode(&[args, &["--out", path.to_str().expect("a path")]].concat());
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    let bytes = fs::read(&path).expect("written");
    assert_eq!(fs::read_dir(&folder).expect("listed").count(), 1, "nothing else is left");
    fs::remove_dir_all(&folder).expect("removed");
    bytes
}

pub fn figure(number: Number) -> Chart {
    let scenario = find(number.preset()).and_then(|preset| preset.scenario()).expect("its preset");
    let mut job = FigureJob::new(number, &scenario).expect("valid");
    job.finish();
    job.chart()
}

/// Width, height, and share of pixels that are not white.
fn picture(bytes: &[u8]) -> (u32, u32, f64) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("pixels");
    let inked = pixels.chunks(info.color_type.samples()).filter(|pixel| pixel.iter().any(|&value| value < 200)).count();
    (info.width, info.height, inked as f64 / f64::from(info.width * info.height))
}

#[test]
fn table_ii_is_drawn_with_every_estimate() {
    let folder = folder("table2-svg");
    let path = folder.join("estimates.svg");
    let output = centrode(&["table2", "--repeats", "2", "--svg", path.to_str().expect("a path")]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let svg = fs::read_to_string(&path).expect("written");
    fs::remove_dir_all(&folder).expect("removed");
    for word in ["Disk 1", "Disk 3", ">true place of the disk<", "standard deviation", "2 repeats", "Distance"] {
        assert!(svg.contains(word), "it lacks {word:?}");
    }
    // 15 rows of the paper, the experiments and 6 means, and what stands for them in the legend.
    let marks = svg.matches("<circle ").count() + svg.matches("paint-order").count();
    assert!(svg.contains("</svg>") && !svg.contains("NaN") && marks >= 15 + 2 + 6 + 3, "{marks}");
    let output = centrode(&["table2", "--svg", "a.gif"]);
    assert!(!output.status.success() && String::from_utf8_lossy(&output.stderr).contains("--svg a.gif"));
}

#[test]
fn every_figure_is_written_as_a_drawing_and_as_numbers() {
    for number in Number::ALL {
        let (digit, chart) = (number.to_string(), figure(number));
        // Figure 4 shows two kinds of contact.
        assert_eq!(chart.panels.len(), if number == Number::Four { 2 } else { 1 }, "figure {digit}");
        let figure = &chart.panels[0];
        let name = |kind: &str| format!("figure-{digit}-{kind}");
        let svg = String::from_utf8(written(&name("svg"), &["figure", &digit], "f.svg")).expect("text");
        assert!(svg.trim_end().ends_with("</svg>") && !svg.contains("NaN"), "figure {digit}");
        let count = |part: &str| svg.matches(part).count();
        assert!(count("<text ") > 15 && count("<text ") == count("textLength=") && count("<text ") == count("</text>"));
        for word in ["Simulated", figure.x.unit, figure.y.unit, chart.title.split(' ').next().expect("a word")] {
            assert!(svg.contains(word), "figure {digit} lacks {word:?}");
        }
        let (width, height, inked) = picture(&written(&name("png"), &["figure", &digit], "f.PNG"));
        assert_eq!((width, height), if chart.panels.len() == 1 { (2400, 1640) } else { (2560, 1280) });
        assert!((0.005..0.4).contains(&inked), "figure {digit}: {inked} of it is drawn on");

        let text = String::from_utf8(written(&name("csv"), &["figure", &digit], "f.csv")).expect("text");
        let mut rows = csv::Reader::from_reader(text.as_bytes());
        let header = rows.headers().expect("a header").clone();
        assert!(header[3].contains(&format!("[{}]", figure.x.si_unit)), "{header:?}");
        let rows: Vec<_> = rows.records().map(|row| row.expect("a row")).collect();
        let points: Vec<_> = figure.series.iter().flat_map(|series| &series.points).collect();
        let all = chart.panels.iter().map(|panel| {
            let points: usize = panel.series.iter().map(|series| series.points.len()).sum();
            points + panel.verticals.len() + 2 * panel.spans.len()
        });
        // A second panel has a header of its own.
        assert_eq!(rows.len(), all.sum::<usize>() + chart.panels.len() - 1);
        for (row, point) in rows.iter().zip(points) {
            let read = |k: usize| row[k].parse().unwrap_or(f64::NAN);
            for (k, value) in [(3, point[0]), (4, point[1])] {
                assert!(read(k) == value || (value.is_nan() && row[k].is_empty()), "figure {digit}: {row:?}");
            }
        }
    }
}

#[test]
fn a_figure_follows_its_overrides() {
    let caption = |args: &[&str]| String::from_utf8(written("override", args, "f.svg")).expect("text");
    let shown = caption(&["figure", "8", "--set", "filter.length=250"]);
    assert_ne!(shown, caption(&["figure", "8"]));
}

#[test]
fn captions_say_what_was_set_and_hold_the_link() {
    let sets = ["--set", "contact.disk=3", "--set", "detection.armed_from=4.5"];
    let svg = |name: &str, args: &[&str], flag: &str| {
        let folder = folder(name);
        let path = folder.join("f.svg");
        let output = centrode(&[args, &sets, &[flag, path.to_str().expect("a path")]].concat());
        assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
        let svg = fs::read_to_string(&path).expect("written");
        fs::remove_dir_all(&folder).expect("removed");
        svg
    };
    for (name, args, flag, view) in [
        ("caption-figure", &["figure", "8"][..], "--out", "preset=figure-8&amp;contact.disk=3&amp;detection.armed"),
        (
            "caption-run",
            &["run", "--preset", "bench"],
            "--figure",
            "preset=bench&amp;contact.disk=3&amp;detection.armed",
        ),
        ("caption-table2", &["table2", "--repeats", "1"], "--svg", "view=table2"),
        ("caption-map", &["map", "--columns", "5", "--rows", "5"], "--out", "view=map"),
        ("caption-study", &["study", "--repeats", "2"], "--svg", "view=tuning"),
    ] {
        let svg = svg(name, args, flag);
        assert!(svg.contains("Centrode #preset=") && svg.contains(view), "{name}: {svg}");
        // An underscore of a key lowers nothing.
        assert!(svg.contains("detection.armed_from=4.5"), "{name}");
    }
}

#[test]
fn a_run_is_drawn_over_time_as_vectors_and_pixels() {
    let folder = folder("run-figure");
    let file = |name: &str| folder.join(name).to_str().expect("a path").to_owned();
    for name in ["run.svg", "run.png"] {
        let output = centrode(&["run", "--preset", "bench", "--figure", &file(name)]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(String::from_utf8_lossy(&output.stdout).contains("detected"), "the table is still printed");
    }
    let svg = fs::read_to_string(file("run.svg")).expect("written");
    for word in ["Centrode deviation", "Joint force deviation", "Tangent angle", "raised", "not armed", "contact"] {
        assert!(svg.contains(word), "it lacks {word:?}");
    }
    assert!(!svg.contains("NaN"));
    let (width, height, inked) = picture(&fs::read(file("run.png")).expect("written"));
    assert_eq!((width, height), (2400, 2520));
    assert!((0.01..0.5).contains(&inked), "{inked}");
    fs::remove_dir_all(&folder).expect("removed");
    let output = centrode(&["run", "--figure", "a.csv"]);
    assert!(!output.status.success() && String::from_utf8_lossy(&output.stderr).contains("--figure a.csv"));
}

#[test]
fn table_ii_is_written_for_latex() {
    let folder = folder("latex");
    let path = folder.join("table.tex");
    let output = centrode(&["table2", "--repeats", "2", "--latex", path.to_str().expect("a path")]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = fs::read_to_string(&path).expect("written");
    fs::remove_dir_all(&folder).expect("removed");
    assert!(text.contains("% Centrode #preset=bench&view=table2\n"), "{text}");
    assert!(text.contains("2 repeats") && text.ends_with("\\end{tabular}\n"), "{text}");
}

#[test]
fn the_map_is_drawn() {
    let args = ["map", "--columns", "20", "--rows", "15"];
    let svg = String::from_utf8(written("map-svg", &args, "m.svg")).expect("text");
    assert!(svg.contains("Bend at contact") && svg.trim_end().ends_with("</svg>"));
    let (width, height, inked) = picture(&written("map-png", &args, "m.png"));
    assert_eq!((width, height), (2560, 1280));
    assert!(inked > 0.3, "{inked}");
}

#[test]
fn bad_input_is_one_line_and_leaves_no_file() {
    let folder = folder("bad");
    let file = |name: &str| folder.join(name).to_str().expect("a path").to_owned();
    let (svg, gif, bare, lost) = (file("f.svg"), file("f.gif"), file("f"), file("no/such/f.svg"));
    let cases: [(&[&str], &[&str]); 9] = [
        (&["figure", "5", "--out", &svg], &["\"5\"", "3, 4, 6, 7, 8"]),
        (&["figure", "three", "--out", &svg], &["three", "3, 4, 6, 7, 8"]),
        (&["figure", "3", "--out", &gif], &["f.gif", ".gif", ".svg, .png, .csv"]),
        (&["figure", "3", "--out", &bare], &["extension is missing"]),
        (&["figure", "3", "--out", &lost], &["no/such/f.svg"]),
        (&["figure", "8", "--set", "contact.disk=9", "--out", &svg], &["contact.disk", "9", "1 to 3"]),
        (&["figure", "8"], &["--out"]),
        (&["map", "--out", &gif], &["f.gif", ".svg, .png, .csv"]),
        (&["map", "--rows", "1", "--out", &svg], &["--rows", "1"]),
    ];
    for (args, parts) in cases {
        let output = centrode(args);
        let message = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(2), "{args:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(parts.iter().all(|part| message.contains(part)), "{args:?}: {message:?} lacks one of {parts:?}");
    }
    assert_eq!(fs::read_dir(&folder).expect("listed").count(), 0, "something is left behind");
    fs::remove_dir_all(&folder).expect("removed");
}
