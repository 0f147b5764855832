//! Writes `theory.html`: the model in words, its equations as MathML, and figures made by the same code as the page's; and the picture of the
//! robot that the page shows while its program loads.
//!
//! `cargo xtask build` runs it with the paths of the files to write. The texts are in `text/`, and [`page`] says how they are written.

#![allow(clippy::disallowed_methods, reason = "it writes a file")]

mod code;
mod equations;
mod facts;
mod figures;
mod math;
mod misprints;
mod page;
mod poster;
mod states;
mod symbols;
#[cfg(test)]
mod tests;

use anyhow::{Context, Result};

fn main() -> Result<()> {
    let mut paths = std::env::args_os().skip(1);
    for text in [page::page(&facts::facts()?)?, poster::poster()?] {
        let path = paths.next().context("name the file for the theory, and the one for the poster")?;
        std::fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}
