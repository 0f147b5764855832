//! The headless command; see [`centrode::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    centrode::cli::main()
}
