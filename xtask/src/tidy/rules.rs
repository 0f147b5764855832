//! The rules that neither Cargo nor clippy can keep.
//!
//! What a package may know stands in its `Cargo.toml`, which clocks, files, threads and functions it may use in its
//! `clippy.toml`.

const LONGEST_FILE: usize = 500;

/// Names of other rooms and packages that the files of one room of `src/` do not use.
const ROOMS: [(&str, &[&str]); 5] = [
    ("scene", &["centrode_core", "show", "render", "app", "web", "cli", "egui", "eframe", "egui_wgpu", "wgpu"]),
    ("show", &["render", "app", "web", "cli", "egui", "eframe", "egui_wgpu", "wgpu"]),
    ("render", &["centrode_core", "show", "app", "web", "cli", "egui", "eframe", "egui_wgpu"]),
    ("app", &["web", "cli", "web_sys"]),
    // The scene lends its colours to figures on paper.
    ("cli", &["render", "app", "web"]),
];

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
        rooms(inside, text, &mut found);
    }
    found
}

/// The rules about rooms, for the file `inside` of `src/`.
fn rooms(inside: &str, text: &str, found: &mut Vec<(usize, String)>) {
    let room = inside.split(['/', '.']).next().unwrap_or_default();
    let others = ROOMS.iter().find(|(name, _)| *name == room).map_or(&[][..], |(_, others)| others);
    for (line, content) in numbered(text) {
        // Addresses in texts are cut short as well: no path is lost with them.
        let code = content.split("//").next().unwrap_or_default();
        if !matches!(room, "web" | "lib") && contains_word(code, "target_arch") {
            found.push((line, "target_arch stands in web.rs and lib.rs only".into()));
        }
        for name in others.iter().filter(|name| uses(code, name)) {
            found.push((line, format!("{room} does not know {name}")));
        }
    }
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
        bad("src/app/state.rs", "use web_sys::window;", "does not know web_sys");
        bad("src/app/state.rs", "use crate::web;", "does not know web");
        bad("src/cli/run.rs", "use crate::app::App;", "does not know app");
        good("src/show/robot.rs", "use centrode_core::model::Pose;");
        good("src/render/mesh.rs", "use crate::scene::Scene;\nuse wgpu::Device;");
        good("src/app/state.rs", "use crate::{scene::{A, web}, render};\nuse egui::Ui;");
        good("src/show/robot.rs", "use crate::show::rendered::A;\nlet a = show.render; // crate::app and egui::Ui");
    }

    #[test]
    fn the_platform_stands_in_two_files() {
        bad("src/app/state.rs", "#[cfg(target_arch = \"wasm32\")]", "target_arch");
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
