//! Building, serving and testing: everything that is not the product.
//!
//! Run as `cargo xtask COMMAND`.

mod build;
mod engines;
mod foreign;
mod fuzz;
mod licence;
#[cfg(test)]
mod light;
mod metadata;
mod package;
mod renew;
mod reproduce;
mod run;
mod serve;
mod shot;
#[cfg(test)]
mod supply;
mod test;
mod theory;
mod tidy;
mod tools;
mod transfer;

use anyhow::Result;
use build::Which;
use clap::{Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

#[derive(Parser)]
#[command(name = "cargo xtask", about = "Builds, serves and tests Centrode")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Build the page into dist/
    Build {
        /// Fast to build, large to load
        #[arg(long)]
        dev: bool,
        /// Also as a single file, dist/centrode.html, that opens from a disk or a mail
        #[arg(long, conflicts_with = "dev")]
        single_file: bool,
    },
    /// Build the page and serve it on this machine
    Serve {
        /// Port on 127.0.0.1, 0 for any free one [default: 8080, or the next free one]
        #[arg(long)]
        port: Option<u16>,
        /// Fast to build, large to load
        #[arg(long)]
        dev: bool,
        /// Serve this directory, which is built already, and build nothing
        #[arg(long, value_name = "DIR", conflicts_with = "dev")]
        dist: Option<PathBuf>,
    },
    /// Run the tests: all of them, or the stages named
    Test(test::Options),
    /// Throw made-up input at what reads, and at whole experiments
    Fuzz(fuzz::Options),
    /// Replace what tests compare with by what they find now
    Renew {
        /// What to replace
        stored: renew::Stored,
    },
    /// Check the rules of the house: who may import whom, and more
    Tidy,
    /// Write pictures of the page
    Shot(shot::Options),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match obey(arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn obey(command: Command) -> Result<()> {
    match command {
        Command::Build { single_file: true, .. } => build::build(Which::WithSingle).map(drop),
        Command::Build { dev, .. } => build::build(Which::dev(dev)).map(drop),
        Command::Serve { port, dev, dist } => serve::command(port, dev, dist),
        Command::Test(options) => test::command(&options),
        Command::Fuzz(options) => fuzz::command(&options),
        Command::Renew { stored } => renew::command(stored),
        Command::Tidy => tidy::command(),
        Command::Shot(options) => shot::command(&options),
    }
}
