//! Writes `theory.html`: the model in words, its equations as MathML, and figures made by the same code as the page's.
//!
//! `cargo xtask build` runs it with the path of the file to write. The texts are in `text/`, and [`page`] says how they are written.

#![allow(clippy::disallowed_methods, reason = "it writes a file")]

mod code;
mod equations;
mod facts;
mod figures;
mod math;
mod misprints;
mod page;
mod states;
mod symbols;
#[cfg(test)]
mod tests;

use anyhow::{Context, Result};

fn main() -> Result<()> {
    let path = std::env::args_os().nth(1).context("name the file to write")?;
    let html = page::page(&facts::facts()?)?;
    std::fs::write(&path, html).with_context(|| format!("cannot write {}", path.display()))
}
