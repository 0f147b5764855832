//! What the documents show of the command's output is what the command prints, and their drawings are what it draws.
//!
//! `cargo xtask renew drawings` stores drawings anew.

use crate::cli::{centrode, scratch};
use std::path::{Path, PathBuf};
use std::process::Output;

#[test]
fn the_page_on_the_paper_shows_what_the_command_prints() {
    compare(include_str!("../../docs/PAPER.md"), 20);
}

#[test]
fn the_page_on_tuning_shows_what_the_command_prints() {
    compare(include_str!("../../docs/TUNING.md"), 15);
}

#[test]
fn the_page_on_logs_shows_what_the_command_prints() {
    compare(include_str!("../../docs/LOGS.md"), 8);
}

#[test]
fn the_page_on_touch_shows_what_the_command_prints() {
    compare(include_str!("../../docs/TOUCH.md"), 40);
}

#[test]
fn the_page_on_detection_shows_what_the_command_prints() {
    compare(include_str!("../../docs/DETECTION.md"), 25);
}

#[test]
fn the_page_on_chains_shows_what_the_command_prints() {
    compare(include_str!("../../docs/CHAIN.md"), 10);
}

#[test]
fn the_drawing_of_the_page_on_touch_is_the_commands() {
    let command = "centrode figure 4 --out docs/touch-figure-4.svg";
    assert!(include_str!("../../docs/TOUCH.md").contains(&format!("`{command}`")));
    assert!(performed(command).status.success());
}

/// Runs every command of a document and looks for its lines; there are more than `least`.
fn compare(page: &str, least: usize) {
    let mut shown = 0;
    for block in page.split("```console\n").skip(1) {
        let (block, _) = block.split_once("```").expect("a block ends");
        let mut lines = block.lines();
        let command = lines.next().and_then(|line| line.strip_prefix("$ ")).expect("a command");
        let output = performed(command);
        assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        // A block may leave lines out, but neither change one nor turn their order.
        let mut printed = text.lines();
        for line in lines {
            assert!(printed.any(|other| other == line), "{command} does not print {line:?} there:\n{text}");
            shown += 1;
        }
    }
    assert!(shown > least, "{shown} lines");
}

/// Runs a command of a document. A drawing among those of the documents that it would write must be stored as it writes it.
fn performed(command: &str) -> Output {
    let words = command.strip_prefix("centrode ").expect(command).split(' ');
    let mut drawings: Vec<(&str, PathBuf)> = Vec::new();
    let args: Vec<String> = words
        .map(|word| match word.strip_prefix("docs/").filter(|name| name.ends_with(".svg")) {
            Some(name) => {
                let fresh = scratch(name);
                drawings.push((word, fresh.clone()));
                fresh.to_str().expect("UTF-8").to_owned()
            }
            None => word.to_owned(),
        })
        .collect();
    let output = centrode(&args.iter().map(String::as_str).collect::<Vec<_>>());
    for (stored, fresh) in drawings {
        let drawn = std::fs::read_to_string(&fresh).expect("written");
        std::fs::remove_file(fresh).expect("removed");
        let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join(stored);
        if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
            std::fs::write(&stored, &drawn).expect("stored");
        }
        let known = std::fs::read_to_string(&stored).unwrap_or_default();
        assert!(known == drawn, "{} is out of date: cargo xtask renew drawings", stored.display());
    }
    output
}
