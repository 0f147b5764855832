//! The rules that neither Cargo nor clippy can keep.
//!
//! What a package may know stands in its `Cargo.toml`, which clocks, files, threads and functions it may use in its
//! `clippy.toml`.

const LONGEST_FILE: usize = 500;

/// Names of other rooms and packages that the files of one room of `src/` do not use.
const ROOMS: [(&str, &[&str]); 6] = [
    ("scene", &["centrode_core", "show", "render", "app", "web", "cli", "egui", "eframe", "egui_wgpu", "wgpu"]),
    ("show", &["render", "app", "web", "cli", "egui", "eframe", "egui_wgpu", "wgpu"]),
    ("render", &["centrode_core", "show", "app", "web", "cli", "egui", "eframe", "egui_wgpu"]),
    ("app", &["web", "cli"]),
    // The scene lends its colours to figures on paper.
    ("cli", &["render", "app", "web"]),
    ("main", &["render", "app", "web"]),
];

/// The same for `core/src/`: what is told goes from the model to the studies, and a chart is drawn of what it is given.
const CORE_ROOMS: [(&str, &[&str]); 8] = [
    ("model", &["scenario", "plant", "sensors", "record", "detect", "run", "study", "chart", "fingerprints"]),
    ("scenario", &["plant", "sensors", "record", "detect", "run", "study", "chart", "fingerprints"]),
    ("plant", &["sensors", "record", "detect", "run", "study", "chart", "fingerprints"]),
    ("sensors", &["record", "detect", "run", "study", "chart", "fingerprints"]),
    ("record", &["detect", "run", "study", "chart", "fingerprints"]),
    ("detect", &["plant", "run", "study", "chart", "fingerprints"]),
    ("run", &["study", "chart", "fingerprints"]),
    ("chart", &["model", "scenario", "plant", "sensors", "record", "detect", "run", "study", "fingerprints"]),
];

/// What knows the browser or asks which platform this is.
const PLATFORM: [&str; 5] = ["target_arch", "target_family", "web_sys", "js_sys", "wasm_bindgen"];

// Put together here, so that this file does not offend itself.
const UNFINISHED: [&str; 5] = [
    concat!("TO", "DO"),
    concat!("FIX", "ME"),
    concat!("todo", "!"),
    concat!("unimplemented", "!"),
    concat!("#[ign", "ore"),
];

/// Every offence of the file `name` (its path from the root), as line and rule.
pub fn offences(name: &str, text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let length = text.lines().count();
    if length > LONGEST_FILE {
        found.push((length, format!("{length} lines; a file has one topic and at most {LONGEST_FILE} lines")));
    }
    for (line, content) in numbered(text) {
        for mark in UNFINISHED {
            if contains_word(content, mark) {
                found.push((line, format!("unfinished work is no part of the house: {mark}")));
            }
        }
    }
    if let Some(inside) = name.strip_prefix("src/").filter(|name| name.ends_with(".rs")) {
        let room = room(inside);
        rooms(room, &ROOMS, text, &mut found);
        if !matches!(room, "web" | "lib") {
            platform(text, &mut found);
        }
    }
    if let Some(inside) = name.strip_prefix("core/src/").filter(|name| name.ends_with(".rs")) {
        rooms(room(inside), &CORE_ROOMS, text, &mut found);
        platform(text, &mut found);
        if room(inside) == "detect" {
            for (line, _) in
                codes(text).filter(|(_, code)| ["truth", "Truth"].iter().any(|word| contains_word(code, word)))
            {
                found.push((line, "detect does not look at the truth".into()));
            }
        }
    }
    found
}

/// The room of a file inside a package's `src/`.
fn room(inside: &str) -> &str {
    inside.split(['/', '.']).next().unwrap_or_default()
}

/// Who may import whom, for a file of `room`.
fn rooms(room: &str, rules: &[(&str, &[&str])], text: &str, found: &mut Vec<(usize, String)>) {
    let others = rules.iter().find(|(name, _)| *name == room).map_or(&[][..], |(_, others)| others);
    for (line, code) in codes(text) {
        for name in others.iter().filter(|name| uses(code, name)) {
            found.push((line, format!("{room} does not know {name}")));
        }
    }
}

/// Nothing about the platform stands in this file.
fn platform(text: &str, found: &mut Vec<(usize, String)>) {
    for (line, code) in codes(text) {
        for name in PLATFORM.iter().filter(|name| contains_word(code, name)) {
            found.push((line, format!("{name} stands in src/web.rs and src/lib.rs only")));
        }
    }
}

/// The lines without comments. Addresses in texts are cut short as well: no path is lost with them.
fn codes(text: &str) -> impl Iterator<Item = (usize, &str)> {
    numbered(text).map(|(line, content)| (line, content.split("//").next().unwrap_or_default()))
}

/// Whether a line of code uses the room or package `name`: a path that begins with it, from the crate's root, upwards, or, in
/// a `use`, as a package. rustfmt puts no more than one `use` on a line.
fn uses(code: &str, name: &str) -> bool {
    let imports = code.trim_start().trim_start_matches("pub ").strip_prefix("use ");
    let begins = |path: &str| path.strip_prefix(name).is_some_and(|rest| !rest.starts_with(is_name));
    if imports.is_some_and(begins) {
        return true;
    }
    code.match_indices(name).any(|(i, _)| {
        let (before, after) = (&code[..i], &code[i + name.len()..]);
        let from_root = ["crate::", "centrode::", "super::"].iter().any(|root| before.ends_with(root));
        // In `crate::{a, b::{c}}` the names at the first depth.
        let listed = before.rfind("crate::{").is_some_and(|k| {
            let inside = &before[k + "crate::{".len()..];
            let first_depth = inside.matches('{').count() == inside.matches('}').count();
            first_depth && (inside.is_empty() || inside.trim_end().ends_with(','))
        });
        let package = after.starts_with("::") && !before.ends_with(is_name) && !before.ends_with("::");
        (from_root || listed || package) && begins(&code[i..])
    })
}

fn numbered(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().map(|(i, line)| (i + 1, line))
}

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn contains_word(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(i, _)| {
        let goes_on_before = word.starts_with(is_name) && line[..i].ends_with(is_name);
        let goes_on_after = word.ends_with(is_name) && line[i + word.len()..].starts_with(is_name);
        !goes_on_before && !goes_on_after
    })
}

#[cfg(test)]
mod tests {
    use super::offences;

    fn rules(name: &str, text: &str) -> Vec<String> {
        offences(name, text).into_iter().map(|(line, rule)| format!("{line}: {rule}")).collect()
    }

    /// Each bad line breaks exactly one rule, in that line.
    #[track_caller]
    fn bad(name: &str, line: &str, words: &str) {
        let found = rules(name, &format!("// a first line\n{line}\n"));
        assert_eq!(found.len(), 1, "{name}: {line}: {found:?}");
        assert!(found[0].starts_with("2: ") && found[0].contains(words), "{found:?}");
    }

    #[track_caller]
    fn good(name: &str, text: &str) {
        assert_eq!(rules(name, text), Vec::<String>::new(), "{name}: {text}");
    }

    #[test]
    fn rooms_import_downwards_only() {
        bad("src/show/robot.rs", "use crate::render::Run;", "does not know render");
        bad("src/show/robot.rs", "use crate::{render::Run};", "does not know render");
        bad("src/show/robot.rs", "use crate::{scene::{A, B}, render};", "does not know render");
        bad("src/show/robot.rs", "let a = super::super::render::run();", "does not know render");
        bad("src/show.rs", "    pub use egui::Ui;", "does not know egui");
        bad("src/render/mesh.rs", "use centrode_core::model::Pose;", "does not know centrode_core");
        bad("src/scene/arc.rs", "let a = centrode_core::run::simulate(b);", "does not know centrode_core");
        bad("src/scene/camera.rs", "use wgpu::Device;", "does not know wgpu");
        bad("src/render/mesh.rs", "use egui::Rect;", "does not know egui");
        bad("src/app/state.rs", "use web_sys::window;", "web_sys");
        bad("src/app/state.rs", "use crate::web;", "does not know web");
        bad("src/cli/run.rs", "use crate::app::App;", "does not know app");
        bad("core/src/model/arc.rs", "use crate::scenario::Plan;", "does not know scenario");
        bad("core/src/chart/svg.rs", "use crate::{scenario::Plan};", "does not know scenario");
        bad("core/src/detect/judge.rs", "use crate::plant::Plant;", "does not know plant");
        bad("core/src/detect/judge.rs", "let contact = &recording.truth;", "does not look at the truth");
        good("core/src/detect/judge.rs", "use crate::record::Recording; // never the truth");
        good("core/src/study/map.rs", "use crate::run::Run;\nlet shape = recording.truth;");
        good("src/show/robot.rs", "use centrode_core::model::Pose;");
        good("src/render/mesh.rs", "use crate::scene::Scene;\nuse wgpu::Device;");
        good("src/app/state.rs", "use crate::{scene::{A, web}, render};\nuse egui::Ui;");
        good("src/show/robot.rs", "use crate::show::rendered::A;\nlet a = show.render; // crate::app and egui::Ui");
    }

    #[test]
    fn the_platform_stands_in_two_files() {
        bad("src/app/state.rs", "#[cfg(target_arch = \"wasm32\")]", "target_arch");
        bad("core/src/study/map.rs", "#[cfg(target_arch = \"wasm32\")]", "target_arch");
        bad("core/src/lib.rs", "#[cfg(not(target_family = \"wasm\"))]", "target_family");
        bad("src/show.rs", "use wasm_bindgen::prelude::*;", "wasm_bindgen");
        good("src/web.rs", "#[cfg(target_arch = \"wasm32\")]");
        good("src/web/widgets.rs", "#[cfg(target_arch = \"wasm32\")]");
        good("src/lib.rs", "#[cfg(target_arch = \"wasm32\")]");
    }

    #[test]
    fn nothing_is_left_unfinished_or_too_long() {
        bad("core/src/model/arc.rs", concat!("// TO", "DO: more"), "unfinished");
        bad("web/loader.js", concat!("// FIX", "ME"), "unfinished");
        bad("src/app/state.rs", concat!("todo", "!()"), "unfinished");
        bad("tests/it/main.rs", concat!("#[ign", "ore = \"slow\"]"), "unfinished");
        good("core/src/model/arc.rs", concat!("let not_", "todo", "s = 1;"));
        let long = "a\n".repeat(501);
        assert!(rules("src/app/state.rs", &long)[0].contains("501 lines"));
        good("src/app/state.rs", &"a\n".repeat(500));
    }
}
