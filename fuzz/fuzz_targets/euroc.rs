#![no_main]

use centrode_core::record::log::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| centrode_fuzz::read(Format::Euroc, bytes));
