//! The engines besides Chromium in which the page is tested, and the table of what came of it.

use crate::run::target;
use crate::tools;
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::{Path, PathBuf};

/// What draws and drives them: a program by which to know that it is there, if it has one, and the Debian package that brings it.
const NEEDS: [(Option<&str>, &str); 6] = [
    (Some("Xvfb"), "xvfb"),
    (Some("firefox-esr"), "firefox-esr"),
    (Some("WebKitWebDriver"), "webkit2gtk-driver"),
    (None, "libgl1-mesa-dri"),
    (None, "libegl-mesa0"),
    (None, "libgles2"),
];

/// Engine and renderer of each row, as the tests name them and as people do.
const ROWS: [([&str; 2], &str); 8] = [
    (["Chromium", "WebGl"], "WebGL2"),
    (["Chromium", "WebGpu"], "WebGPU"),
    (["Chromium", "Neither"], "neither"),
    (["Firefox", "WebGl"], "WebGL2"),
    (["Firefox", "WebGpu"], "WebGPU"),
    (["Firefox", "Neither"], "neither"),
    (["WebKit", "WebGl"], "WebGL2"),
    (["WebKit", "Neither"], "neither"),
];

/// Installs what is missing of Firefox, WebKit and the screens that they draw on.
pub fn install() -> Result<()> {
    // WebGPU draws by Vulkan.
    tools::software_gpu()?;
    let missing: Vec<&str> = NEEDS.iter().filter(|need| is_missing(need)).map(|(_, package)| *package).collect();
    if missing.is_empty() {
        return Ok(());
    }
    tools::install(&missing).context("the page is tested in Firefox and in WebKit, too, on screens of Xvfb")
}

fn is_missing((program, package): &(Option<&str>, &str)) -> bool {
    match program {
        Some(program) => tools::on_path(&[*program]).is_none(),
        None => tools::is_debian() && !tools::has_package(package),
    }
}

/// An empty folder for what comes of the rows.
pub fn rows() -> Result<PathBuf> {
    let folder = target().join("engines");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    Ok(folder)
}

/// Prints what came of each engine and renderer. A row that is not there is an error, unless only some tests were asked for.
pub fn table(folder: &Path, some: bool) -> Result<()> {
    println!("\n{HEAD}");
    let mut absent = Vec::new();
    for ([engine, renderer], words) in ROWS {
        let text = fs::read_to_string(folder.join(format!("{engine} {renderer}")));
        let text = text.unwrap_or_else(|_| {
            absent.push(format!("{engine} on {words}"));
            "not run\t".into()
        });
        println!("{}", line(engine, words, &text));
    }
    if !some && !absent.is_empty() {
        bail!("nothing came of {}", absent.join(", "));
    }
    Ok(())
}

const HEAD: &str = "engine    renderer    time  result";

fn line(engine: &str, renderer: &str, text: &str) -> String {
    let (result, time) = text.split_once('\t').unwrap_or((text, ""));
    format!("{engine:<9} {renderer:<8} {time:>7}  {result}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_that_is_not_there_is_named() {
        let folder = std::env::temp_dir().join(format!("centrode-rows-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        for ([engine, renderer], _) in &ROWS[1..] {
            fs::write(folder.join(format!("{engine} {renderer}")), "ok\t12 s").unwrap();
        }
        let error = table(&folder, false).unwrap_err().to_string();
        assert_eq!(error, "nothing came of Chromium on WebGL2");
        assert!(table(&folder, true).is_ok());
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn columns_stand_below_their_heads() {
        let line = line("Firefox", "WebGPU", "ok\t12 s");
        for (head, cell) in [("renderer", "WebGPU"), ("result", "ok")] {
            assert_eq!(HEAD.find(head), line.find(cell), "{line}");
        }
    }
}
