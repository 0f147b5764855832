//! How much a visitor downloads.

use crate::build::{licences, sbom, single};
use crate::theory;
use anyhow::{Result, ensure};
use std::collections::BTreeMap;
use std::thread;

/// The page's whole transfer stays under this, bytes.
const LARGEST: usize = 2_000_000;

/// Prints every file's size as it is and brotli-compressed, and the total.
///
/// # Errors
/// When that is too large.
pub fn check(files: &BTreeMap<String, Vec<u8>>) -> Result<()> {
    let mut sizes: Vec<(&str, usize, usize)> = thread::scope(|scope| {
        let jobs: Vec<_> = files
            .iter()
            .map(|(name, bytes)| scope.spawn(move || (name.as_str(), bytes.len(), compressed(bytes))))
            .collect();
        jobs.into_iter().map(|job| job.join().expect("compression does not panic")).collect()
    });
    sizes.sort_by_key(|size| std::cmp::Reverse(size.2));
    println!("{:>10} {:>10}  transfer in bytes", "raw", "brotli");
    for (name, raw, brotli) in &sizes {
        println!("{raw:>10} {brotli:>10}  {name}");
    }
    sizes.retain(|size| visited(size.0));
    let raw: usize = sizes.iter().map(|size| size.1).sum();
    let brotli: usize = sizes.iter().map(|size| size.2).sum();
    println!(
        "{raw:>10} {brotli:>10}  the whole page: {:.2} MB of at most {:.1}",
        megabytes(brotli),
        megabytes(LARGEST)
    );
    ensure!(brotli < LARGEST, "a visitor loads {brotli} bytes, and fewer than {LARGEST} are allowed");
    Ok(())
}

fn megabytes(bytes: usize) -> f64 {
    bytes as f64 / 1e6
}

/// Whether whoever opens the page loads a file: neither the theory, the licences, the list of parts nor the page as a single file, nor icons of
/// an installed page, nor a host page to try it in.
fn visited(name: &str) -> bool {
    ![theory::NAME, licences::NAME, sbom::NAME, single::NAME].contains(&name)
        && !name.ends_with(".png")
        && !name.starts_with("examples/")
}

/// Size after brotli at the level at which static hosts store files.
fn compressed(bytes: &[u8]) -> usize {
    let parameters = brotli::enc::BrotliEncoderParams { quality: 11, lgwin: 22, ..Default::default() };
    let mut out = Vec::new();
    brotli::BrotliCompress(&mut &bytes[..], &mut out, &parameters).expect("writing to memory does not fail");
    out.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_visitor_loads_the_page_and_not_what_lies_beside_it() {
        for name in ["index.html", "build-1/centrode_bg.wasm", "build-1/icon.svg", "offline-worker.js"] {
            assert!(visited(name), "{name}");
        }
        for name in [
            "theory.html",
            "licences.html",
            "sbom.cdx.json",
            "centrode.html",
            "build-1/icon-512.png",
            "examples/embed.html",
        ] {
            assert!(!visited(name), "{name}");
        }
    }

    #[test]
    fn a_page_that_is_too_large_is_refused() {
        // Random enough that nothing repeats.
        let mut state = 1u64;
        let mut byte = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 56) as u8
        };
        let mut page = |size| check(&[("program".to_owned(), (0..size).map(|_| byte()).collect())].into());
        assert!(page(1000).is_ok());
        let refused = page(LARGEST).unwrap_err().to_string();
        assert!(refused.starts_with("a visitor loads 20000") && refused.contains("2000000 are allowed"), "{refused}");
    }

    #[test]
    fn compresses_what_repeats() {
        assert!(compressed(&[7; 100_000]) < 100);
        assert!(compressed(b"") < 10);
    }
}
