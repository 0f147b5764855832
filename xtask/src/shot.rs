//! Pictures of the page for people to look at.

use crate::build::{self, Which};
use crate::run::{cargo, root, run};
use crate::{serve, tools};
use anyhow::Result;
use clap::Args;
use std::path::PathBuf;

/// Options of `cargo xtask shot`.
#[derive(Args)]
pub struct Options {
    /// Where the PNG files go
    #[arg(long, value_name = "DIR", default_value = "target/shots")]
    out: PathBuf,
    /// Of the page that is fast to build
    #[arg(long)]
    dev: bool,
    /// Of the page in this directory, which is built already
    #[arg(long, value_name = "DIR", conflicts_with = "dev")]
    dist: Option<PathBuf>,
    /// Seconds of the page's own time to wait for before the picture
    #[arg(long, value_name = "SECONDS", default_value_t = 7.0)]
    at: f64,
    /// What is shown, as in a link (tour=4, preset=bench&theme=projector); without any, the page as it opens, and where it fails
    #[arg(value_name = "FRAGMENT")]
    fragments: Vec<String>,
}

/// Builds the page, serves it, and has every picture taken.
pub fn command(options: &Options) -> Result<()> {
    let browser = tools::browser()?;
    let dist = match &options.dist {
        Some(dist) => dist.clone(),
        None => build::build(Which::dev(options.dev))?,
    };
    let page = serve::background(&dist, "/")?;
    std::fs::create_dir_all(&options.out)?;
    run(cargo()
        .args(["run", "--quiet", "--example", "shot", "--"])
        .arg(std::path::absolute(&options.out)?)
        .arg(options.at.to_string())
        .args(&options.fragments)
        .env("CENTRODE_PAGE", page)
        .env("CENTRODE_BROWSER", browser)
        .current_dir(root()))
}
