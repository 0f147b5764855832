//! Prints one hash for each thing that the program computes, as JSON: the same on every machine, to the last bit.
//!
//! `cargo run --release --package centrode-core --example fingerprints`

use centrode_core::fingerprints::fingerprints;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{}", serde_json::to_string_pretty(&fingerprints()?)?);
    Ok(())
}
