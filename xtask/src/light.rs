//! The headless command stays light: no interface and no graphics in what it is built from.

use crate::run::{cargo, output};

const HEAVY: [&str; 8] = ["egui", "eframe", "epaint", "wgpu", "naga", "winit", "web-sys", "accesskit"];

fn tree(features: &[&str]) -> String {
    output(
        cargo()
            .args(["tree", "--package", "centrode", "--edges", "normal,build"])
            .args(["--prefix", "none", "--format", "{p}"])
            .args(features),
    )
    .unwrap()
}

fn heavy(tree: &str) -> Vec<&str> {
    tree.lines()
        .filter_map(|line| line.split(' ').next())
        .filter(|name| HEAVY.iter().any(|heavy| name.starts_with(heavy)))
        .collect()
}

#[test]
fn the_headless_command_has_no_interface() {
    let tree = tree(&[]);
    assert!(tree.contains("clap v"), "the command's own parts are listed");
    assert_eq!(heavy(&tree), Vec::<&str>::new());
}

#[test]
fn the_pure_part_has_neither_interface_nor_command() {
    let tree = tree(&["--no-default-features"]);
    assert!(tree.contains("nalgebra v"));
    assert!(!tree.contains("clap v"));
    assert_eq!(heavy(&tree), Vec::<&str>::new());
}

#[test]
fn the_check_sees_the_interface_where_it_is() {
    assert!(!heavy(&tree(&["--features", "app"])).is_empty());
}
