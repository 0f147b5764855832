//! The rules themselves.

use super::source::{code, paths, without_tests};

const LONGEST_FILE: usize = 500;

/// One of the house's rooms: the core, or a folder or file of `src/`.
struct Room {
    name: &'static str,
    /// Rooms it must not import: all that stand above it.
    closed: &'static [&'static str],
    /// It knows no interface, no web, no clock, no files, no threads.
    pure: bool,
    /// It gives the same bits on every machine.
    exact: bool,
}

const ROOMS: [Room; 6] = [
    // What stands above the core is another package, so Cargo keeps it out.
    Room { name: "core", closed: &[], pure: true, exact: true },
    Room { name: "scene", closed: &["centrode_core", "show", "render", "app", "web", "cli"], pure: true, exact: false },
    Room { name: "show", closed: &["render", "app", "web", "cli"], pure: true, exact: false },
    Room { name: "render", closed: &["centrode_core", "show", "app", "web", "cli"], pure: false, exact: false },
    Room { name: "app", closed: &["web", "cli"], pure: false, exact: false },
    // The scene lends its colours to figures on paper.
    Room { name: "cli", closed: &["render", "app", "web"], pure: false, exact: false },
];

/// What a pure room must not import.
const WORLD: [&str; 17] = [
    "egui",
    "eframe",
    "egui_wgpu",
    "egui_plot",
    "wgpu",
    "web_sys",
    "js_sys",
    "wasm_bindgen",
    "web_time",
    "rayon",
    "std::fs",
    "std::time",
    "std::thread",
    "std::env",
    "std::process",
    "std::net",
    "std::os",
];

/// Functions that each machine's library rounds in its own way. `libm` has them all.
const INEXACT: [&str; 27] = [
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh",
    "exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "powf", "powi", "cbrt", "hypot", "mul_add",
];

/// Functions of nalgebra that call such ones.
const INEXACT_INSIDE: [&str; 6] =
    ["from_axis_angle", "from_scaled_axis", "from_euler_angles", "euler_angles", "from_polar", "slerp"];

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
    if name.ends_with(".rs") {
        if let Some(inside) = name.strip_prefix("src/") {
            imports(inside, &code(text), &mut found);
        } else if name.starts_with("core/src/") {
            imports(name, &code(text), &mut found);
        }
    }
    found.sort();
    found.dedup();
    found
}

/// The rules about rooms, for the file `inside` of `src/`.
fn imports(inside: &str, code: &str, found: &mut Vec<(usize, String)>) {
    let of_web = inside == "web.rs" || inside.starts_with("web/");
    if !of_web && inside != "lib.rs" {
        for (line, content) in numbered(code) {
            if contains_word(content, "target_arch") {
                found.push((line, "target_arch stands in web.rs and lib.rs only".into()));
            }
        }
    }
    let room = inside.split(['/', '.']).next().unwrap_or_default();
    let Some(room) = ROOMS.iter().find(|other| other.name == room) else {
        return;
    };
    let product = without_tests(code);
    for (line, path) in paths(&product) {
        if let Some(closed) = room.closed.iter().find(|closed| reaches(&path, closed)) {
            found.push((line, format!("{} does not import {closed}: {path}", room.name)));
        }
        if room.pure
            && let Some(world) = WORLD.iter().find(|world| begins(&path, world))
        {
            found.push((line, format!("{} is pure and does not know {world}: {path}", room.name)));
        }
        if room.name == "render" && ["egui", "eframe"].iter().any(|ui| begins(&path, ui)) {
            found.push((line, format!("render does not know egui: {path}")));
        }
        if room.name == "app" && begins(&path, "web_sys") {
            found.push((line, format!("app does not know the browser: {path}")));
        }
        if room.exact {
            let mut parts = path.rsplit("::");
            let last = parts.next().unwrap_or_default();
            let of = parts.next().unwrap_or_default();
            if (matches!(of, "f64" | "f32") && INEXACT.contains(&last)) || INEXACT_INSIDE.contains(&last) {
                found.push((line, inexact(room, last)));
            }
        }
    }
    if room.exact {
        for (line, content) in numbered(&product) {
            for function in INEXACT {
                if calls_method(content, function) {
                    found.push((line, inexact(room, function)));
                }
            }
        }
    }
}

fn inexact(room: &Room, function: &str) -> String {
    format!("{} gives the same bits everywhere, so libm and not the machine's own {function}()", room.name)
}

fn numbered(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().map(|(i, line)| (i + 1, line))
}

/// `path` is `start` or lies in it.
fn begins(path: &str, start: &str) -> bool {
    path.strip_prefix(start).is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
}

/// `path` leads to the room `name`, from the crate's root or upwards.
fn reaches(path: &str, name: &str) -> bool {
    if begins(path, name) {
        return true;
    }
    let inside = path.strip_prefix("crate::").or_else(|| path.strip_prefix("centrode::"));
    let inside = inside.or_else(|| {
        let up = path.trim_start_matches("super::");
        (up.len() < path.len()).then_some(up)
    });
    inside.is_some_and(|inside| begins(inside, name))
}

fn contains_word(line: &str, word: &str) -> bool {
    let name = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(i, _)| {
        let goes_on_before = word.starts_with(name) && line[..i].ends_with(name);
        let goes_on_after = word.ends_with(name) && line[i + word.len()..].starts_with(name);
        !goes_on_before && !goes_on_after
    })
}

/// `line` calls `.function(`.
fn calls_method(line: &str, function: &str) -> bool {
    line.match_indices(function)
        .any(|(i, _)| line[..i].trim_end().ends_with('.') && line[i + function.len()..].trim_start().starts_with('('))
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
    fn pure_rooms_know_no_outside_world() {
        bad("core/src/model/arc.rs", "use egui::Vec2;", "does not know egui");
        bad("core/src/experiment/run.rs", "use std::{fmt, time::Instant};", "std::time");
        bad("core/src/study/mod.rs", "let a = std::thread::spawn(b);", "std::thread");
        bad("core/src/record/csv.rs", "use std::fs;", "std::fs");
        bad("src/scene/camera.rs", "use wgpu::Device;", "wgpu");
        bad("core/src/study.rs", "use rayon::prelude::*;", "rayon");
        good("src/cli/run.rs", "use std::fs;");
        good("core/src/model/arc.rs", "// egui and std::fs\nlet a = \"wgpu\"; let egui_like = 1;");
        good("core/src/model/arc.rs", "#[cfg(test)]\nmod tests { use std::fs; }");
    }

    #[test]
    fn rooms_import_downwards_only() {
        bad("src/show/robot.rs", "use crate::render::Run;", "does not import render");
        bad("src/show/robot.rs", "use crate::{render::Run};", "does not import render");
        bad("src/show/robot.rs", "let a = super::super::render::run();", "does not import render");
        bad("src/render/mesh.rs", "use centrode_core::model::Pose;", "does not import centrode_core");
        bad("src/scene/arc.rs", "let a = centrode_core::run::simulate(b);", "does not import centrode_core");
        bad("src/render/mesh.rs", "use egui::Rect;", "does not know egui");
        bad("src/app/mod.rs", "use web_sys::window;", "does not know the browser");
        bad("src/app/mod.rs", "use crate::web;", "does not import web");
        bad("src/cli/run.rs", "use crate::app::App;", "does not import app");
        good("src/show/robot.rs", "use centrode_core::model::Pose;");
        good("src/render/mesh.rs", "use crate::scene::Scene;\nuse wgpu::Device;");
        good("src/app/mod.rs", "use crate::{experiment, scene, render};\nuse egui::Ui;");
        good("src/show/robot.rs", "use crate::show::rendered::A;");
    }

    #[test]
    fn exact_rooms_use_libm() {
        bad("core/src/model/arc.rs", "let a = x.sin();", "sin()");
        bad("core/src/model/arc.rs", "let a = (x * y) . powi (2);", "powi()");
        bad("core/src/experiment/run.rs", "let a = f64::exp(x);", "exp()");
        bad("core/src/study/mod.rs", "let a = x.map(f64::ln);", "ln()");
        bad("core/src/model/pose.rs", "let r = Rotation3::from_axis_angle(&a, b);", "from_axis_angle");
        good("core/src/model/arc.rs", "let a = libm::sin(x).sqrt().abs(); self.exp; Pose::exp(t); a.sinc();");
        good("core/src/model/arc.rs", "#[cfg(test)]\nmod tests { fn a() { x.sin(); } }");
        good("src/scene/camera.rs", "let a = x.sin();");
    }

    #[test]
    fn the_platform_stands_in_two_files() {
        bad("src/app/mod.rs", "#[cfg(target_arch = \"wasm32\")]", "target_arch");
        good("src/web.rs", "#[cfg(target_arch = \"wasm32\")]");
        good("src/web/widgets.rs", "#[cfg(target_arch = \"wasm32\")]");
        good("src/lib.rs", "#[cfg(target_arch = \"wasm32\")]");
    }

    #[test]
    fn nothing_is_left_unfinished_or_too_long() {
        bad("core/src/model/arc.rs", concat!("// TO", "DO: more"), "unfinished");
        bad("web/loader.js", concat!("// FIX", "ME"), "unfinished");
        bad("src/app/mod.rs", concat!("todo", "!()"), "unfinished");
        bad("tests/it/main.rs", concat!("#[ign", "ore = \"slow\"]"), "unfinished");
        good("core/src/model/arc.rs", concat!("let not_", "todo", "s = 1;"));
        let long = "a\n".repeat(501);
        assert!(rules("src/app/mod.rs", &long)[0].contains("501 lines"));
        good("src/app/mod.rs", &"a\n".repeat(500));
    }
}
