//! Files that the command writes: whole or not at all, and as open to others as the files that they replace.

use crate::cli::{centrode, scratch};
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// An empty folder that no other test uses.
fn folder(name: &str) -> PathBuf {
    let folder = scratch(name);
    fs::create_dir(&folder).expect("a new folder");
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).expect("a file").permissions().mode() & 0o777
}

/// Sends a signal to a command once it has begun to write its file.
pub fn interrupted(mut child: Child, folder: &Path, signal: &str, later: Duration) -> Output {
    while !names(folder).iter().any(|name| name.ends_with(".part")) {
        assert!(child.try_wait().expect("its state").is_none(), "it ended before it was interrupted");
        sleep(Duration::from_millis(5));
    }
    sleep(later);
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().expect("kill");
    assert!(sent.success());
    child.wait_with_output().expect("it ends")
}

#[test]
fn an_interrupt_leaves_no_part_of_a_file() {
    for (k, (args, signal)) in [
        (&["run", "--set", "motion.end=90000", "--csv", "x.csv"][..], "-INT"),
        (&["run", "--json", "--set", "motion.end=90000", "--csv", "x.csv"], "-TERM"),
        (&["figure", "8", "--set", "motion.end=90000", "--out", "x.svg"], "-INT"),
        (&["map", "--rows", "1000", "--columns", "1000", "--out", "x.png"], "-INT"),
        (&["table2", "--repeats", "100000", "--csv", "x.csv"], "-TERM"),
    ]
    .into_iter()
    .enumerate()
    {
        let folder = folder(&format!("interrupted-{k}"));
        let target = args.last().expect("a file");
        fs::write(folder.join(target), "precious").expect("written");
        let mut command = Command::new(env!("CARGO_BIN_EXE_centrode"));
        command.args(args).current_dir(&folder).stdout(Stdio::piped()).stderr(Stdio::piped());
        let output = interrupted(command.spawn().expect("it starts"), &folder, signal, Duration::ZERO);
        let line = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!((output.status.code(), line.trim_end()), (Some(130), "centrode: interrupted"), "{args:?}");
        assert_eq!(names(&folder), [*target], "{args:?}");
        assert_eq!(fs::read(folder.join(target)).expect("a file"), b"precious", "{args:?}");
        fs::remove_dir_all(&folder).expect("removed");
    }
}

#[test]
fn a_hangup_ends_no_command_that_was_started_to_ignore_it() {
    let folder = folder("hung-up");
    let run = "trap '' HUP && exec \"$0\" run --set motion.end=2000 --csv x.csv";
    let mut command = Command::new("sh");
    command.args(["-c", run, env!("CARGO_BIN_EXE_centrode")]).current_dir(&folder);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
    let output = interrupted(child, &folder, "-HUP", Duration::ZERO);
    assert!(output.status.success(), "{}: {}", output.status, String::from_utf8_lossy(&output.stderr));
    assert_eq!(names(&folder), ["x.csv"]);
    let text = fs::read_to_string(folder.join("x.csv")).expect("a file");
    assert_eq!(text.lines().count(), 1 + 2_000_001);
    fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn a_replaced_file_keeps_its_mode_and_a_new_one_has_the_usual() {
    let folder = folder("modes");
    let [replaced, new, link] = ["replaced.csv", "new.csv", "link.csv"].map(|name| folder.join(name));
    fs::write(&replaced, "old").expect("written");
    std::os::unix::fs::symlink(&replaced, &link).expect("a link");
    for wanted in [0o640, 0o604, 0o444] {
        fs::set_permissions(&replaced, Permissions::from_mode(wanted)).expect("a mode");
        assert!(centrode(&["run", "--csv", link.to_str().expect("path")]).status.success());
        assert_eq!(mode(&replaced), wanted);
    }
    assert!(fs::symlink_metadata(&link).expect("a link").is_symlink());
    assert!(centrode(&["run", "--csv", new.to_str().expect("path")]).status.success());
    assert_eq!(fs::read(&replaced).expect("a file"), fs::read(&new).expect("a file"));
    let usual = folder.join("usual");
    fs::write(&usual, "").expect("written");
    assert_eq!(mode(&new), mode(&usual));
    fs::remove_dir_all(&folder).expect("removed");
}
