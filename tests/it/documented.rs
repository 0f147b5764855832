//! What the documents show of the command's output is what the command prints.

use crate::cli::centrode;

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

/// Runs every command of a document and looks for its lines; there are more than `least`.
fn compare(page: &str, least: usize) {
    let mut shown = 0;
    for block in page.split("```console\n").skip(1) {
        let (block, _) = block.split_once("```").expect("a block ends");
        let mut lines = block.lines();
        let command = lines.next().expect("a command");
        let args: Vec<_> = command.strip_prefix("$ centrode ").expect(command).split(' ').collect();
        let output = centrode(&args);
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
